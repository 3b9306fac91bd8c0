// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/writer_options.h"

#include <array>
#include <utility>

namespace wellknit {

namespace {

/// The entry of this name goes into `chosen`; false where there is none.
template <class Value, std::size_t size>
bool choose(std::string_view text, const std::array<std::pair<std::string_view, Value>, size>& table, Value& chosen) {
  for (const auto& [name, value] : table)
    if (text == name) {
      chosen = value;
      return true;
    }
  return false;
}

using std::pair;
using std::string_view;

constexpr std::array<pair<string_view, AreaKind>, 2> areas{
    {{"effective", AreaKind::effective}, {"raw", AreaKind::raw}}};
constexpr string_view area_values = "effective|raw";
constexpr string_view area_description = "areas from which our transmissibilities follow, or the faces' own";

constexpr std::array<pair<string_view, CellPoint>, 2> cell_points{
    {{"center", CellPoint::center}, {"centroid", CellPoint::centroid}}};
constexpr string_view point_values = "center|centroid";
constexpr string_view point_description = "the cells' points: where the pressure is, or the volumes' own";

constexpr std::array<pair<string_view, FlowFluids>, 2> fluids{
    {{"oil_and_water", FlowFluids::oil_and_water}, {"water", FlowFluids::water}}};

constexpr std::array<pair<string_view, DeckLayoutKind>, 3> layouts{
    {{"row", DeckLayoutKind::row}, {"portable", DeckLayoutKind::portable}, {"nested", DeckLayoutKind::nested}}};
constexpr std::array<pair<string_view, CellOrder>, 3> orders{
    {{"mesh", CellOrder::mesh}, {"layer", CellOrder::layer}, {"rcm", CellOrder::rcm}}};

constexpr std::array<pair<string_view, VtuReader>, 2> vtu_readers{
    {{"paraview", VtuReader::paraview}, {"geos", VtuReader::geos}}};

constexpr std::array vtu_table{
    WriterKey{"for", "paraview|geos", "who reads it: general polyhedra, or the shapes that GEOS takes",
              [](WriterOptions& o, string_view v) { return choose(v, vtu_readers, o.vtu_reader); }},
    WriterKey{"region", "a keyword", "for GEOS: a property of whole numbers, its regions; FIPNUM unless given",
              [](WriterOptions& o, string_view v) {
                o.geos.region = v;
                return !v.empty();
              }},
};
constexpr std::array deck_table{
    WriterKey{"layout", "row|portable|nested", "where the cells stand",
              [](WriterOptions& o, string_view v) { return choose(v, layouts, o.deck.layout); }},
    WriterKey{"order", "mesh|layer|rcm", "of the cells; rcm: reverse Cuthill-McKee",
              [](WriterOptions& o, string_view v) { return choose(v, orders, o.deck.order); }},
    WriterKey{"fluids", "oil_and_water|water", "of the template deck",
              [](WriterOptions& o, string_view v) { return choose(v, fluids, o.deck.fluids); }},
};
constexpr std::array opm_grid_table{
    WriterKey{"point", point_values, point_description,
              [](WriterOptions& o, string_view v) { return choose(v, cell_points, o.opm_grid.cell_point); }},
};
constexpr std::array mrst_table{
    WriterKey{"point", point_values, point_description,
              [](WriterOptions& o, string_view v) {
                CellPoint point{};
                if (!choose(v, cell_points, point)) return false;
                o.mrst.true_centroids = point == CellPoint::centroid;
                return true;
              }},
};
constexpr std::array pflotran_table{
    WriterKey{"areas", area_values, area_description,
              [](WriterOptions& o, string_view v) { return choose(v, areas, o.pflotran.areas); }},
};
constexpr std::array tough_table{
    WriterKey{"areas", area_values, area_description,
              [](WriterOptions& o, string_view v) { return choose(v, areas, o.tough.areas); }},
    WriterKey{"names", "auto|5|6|7|8", "characters of an element's name",
              [](WriterOptions& o, string_view v) {
                if (v == "auto") {
                  o.tough.name_length = 0;
                  return true;
                }
                if (v.size() != 1 || v[0] < '5' || v[0] > '8') return false;
                o.tough.name_length = v[0] - '0';
                return true;
              }},
    WriterKey{"region", "a keyword", "a property of whole numbers whose values are the rocks, such as SATNUM",
              [](WriterOptions& o, string_view v) {
                o.tough.region = v;
                return !v.empty();
              }},
};
constexpr std::array fehm_table{
    WriterKey{"areas", area_values, area_description,
              [](WriterOptions& o, string_view v) { return choose(v, areas, o.fehm.areas); }},
};

}  // namespace

std::span<const WriterKey> writer_keys(std::string_view format) {
  if (format == "vtu") return vtu_table;
  if (format == "deck") return deck_table;
  if (format == "opm_grid") return opm_grid_table;
  if (format == "mrst") return mrst_table;
  if (format == "pflotran" || format == "pflotran_h5") return pflotran_table;
  if (format == "tough") return tough_table;
  if (format == "fehm") return fehm_table;
  return {};
}

}  // namespace wellknit
