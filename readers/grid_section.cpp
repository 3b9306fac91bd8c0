// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/grid_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "readers/block_centred_grid.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// Cells that a run can number; a file beyond it is damaged or hostile.
constexpr std::int64_t most_cells = 2'000'000'000;

std::string cell_name(const CornerPointGrid& grid, std::size_t cell) {
  const auto ijk = grid.ijk(HostCellId(cell));
  return fmt::format("cell {} {} {}", ijk[0] + 1, ijk[1] + 1, ijk[2] + 1);
}

}  // namespace

void GridSection::set_dimensions(const DeckRecord& record) {
  std::array<std::int64_t, 3> dimensions{};
  std::int64_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    dimensions[axis] = stream_.integer(record, axis).value_or(0);
    if (dimensions[axis] < 1 || dimensions[axis] > most_cells / cells) {
      stream_.fail(
          record.line,
          {fmt::format("three numbers of cells of 1 or more, {} cells in all at most", most_cells),
           record.has(axis) ? quoted_for_message(record.items[axis].text) : fmt::format("no item {}", axis + 1), ""});
    }
    cells *= dimensions[axis];
  }
  if (arrays_.has_dimensions() && arrays_.dimensions() != dimensions) {
    const auto& old = arrays_.dimensions();
    stream_.fail(record.line, {fmt::format("the dimensions given before, {} {} {}", old[0], old[1], old[2]),
                               fmt::format("{} {} {}", dimensions[0], dimensions[1], dimensions[2]),
                               "the files belong to different grids"});
  }
  if (!arrays_.has_dimensions()) arrays_.set_dimensions(dimensions);
}

void GridSection::read_dimensions() { set_dimensions(stream_.next_record(3)); }

void GridSection::read_specgrid() {
  const DeckRecord record = stream_.next_record(5);
  if (stream_.integer(record, 3).value_or(1) != 1)
    stream_.fail(record.line,
                 {"one reservoir (item 4)", quoted_for_message(record.items[3].text), "split the reservoirs"});
  const std::string kind = stream_.word(record, 4).value_or("F");
  if (kind == "T" || kind == ".TRUE.")
    stream_.fail(record.line,
                 {"Cartesian coordinates (F as item 5)", "cylindrical ones (T)", "radial grids are not read"});
  if (kind != "F" && kind != ".FALSE.") stream_.fail(record.line, {"T or F as item 5", quoted_for_message(kind), ""});
  set_dimensions(record);
}

void GridSection::read_coord() {
  arrays_.require_dimensions();
  const auto& n = arrays_.dimensions();
  coord_ = arrays_.read_reals(6 * (n[0] + 1) * (n[1] + 1));
}

void GridSection::read_zcorn() {
  arrays_.require_dimensions();
  zcorn_ = arrays_.read_reals(8 * arrays_.cell_count());
}

void GridSection::read_spacing() {
  arrays_.require_dimensions();
  const auto axis = static_cast<std::size_t>(stream_.keyword().name[1] - 'X');
  spacing_[axis] = arrays_.read_reals(arrays_.dimensions()[axis]);
}

void GridSection::read_mapaxes() {
  // Seven values stand in public decks that simulators run ("3000 0" for "3000.0"): the first six count.
  const DeckRecord record = stream_.next_record(100);
  std::array<double, 6> axes{};
  for (std::size_t item = 0; item < axes.size(); ++item) {
    const auto value = stream_.real(record, item);
    if (!value) {
      stream_.fail(record.line, {"6 numbers", fmt::format("{}", record.items.size()),
                                 "two points on the y axis and one on the x axis, the origin second"});
    }
    axes[item] = *value;
  }
  if (record.items.size() > axes.size())
    stream_.note(record.line, fmt::format("MAPAXES has {} values; the first 6 are taken", record.items.size()));
  mapaxes_ = axes;
}

/// METRES, FEET or CM as item 1, in metres; nothing for a default.
std::optional<double> GridSection::read_length_unit(const DeckRecord& record) const {
  const std::string unit = stream_.word(record, 0).value_or("");
  if (unit.empty()) return std::nullopt;
  if (unit == "METRES" || unit == "METERS") return 1.0;
  if (unit == "FEET") return metre_per_foot;
  if (unit == "CM") return 0.01;
  stream_.fail(record.line, {"METRES, FEET or CM", quoted_for_message(unit), ""});
}

void GridSection::read_grid_unit() {
  const DeckRecord record = stream_.next_record(2);
  if (const auto unit = read_length_unit(record)) metre_per_grid_unit_ = unit;
  const std::string frame = stream_.word(record, 1).value_or("");
  if (!frame.empty() && frame != "MAP")
    stream_.fail(record.line, {"MAP or a blank as item 2", quoted_for_message(frame), ""});
  has_map_coordinates_ = frame == "MAP";
}

void GridSection::read_map_units() { metre_per_map_unit_ = read_length_unit(stream_.next_record(1)).value_or(1.0); }

/// How I, J, K and Z run is seen from the corners themselves; only depths that would be heights matter.
void GridSection::read_grid_orientation() {
  const DeckRecord record = stream_.next_record(5);
  static constexpr std::array<std::array<std::string_view, 2>, 5> options{
      {{"INC", "DEC"}, {"INC", "DEC"}, {"INC", "DEC"}, {"DOWN", "UP"}, {"RIGHT", "LEFT"}}};
  for (std::size_t item = 0; item < options.size(); ++item) {
    const auto word = stream_.word(record, item);
    if (word && *word != options[item][0] && *word != options[item][1])
      stream_.fail(record.line, {fmt::format("{} or {} as item {}", options[item][0], options[item][1], item + 1),
                                 quoted_for_message(*word), ""});
  }
  if (stream_.word(record, 3).value_or("DOWN") == "UP")
    stream_.note(record.line, "GDORIENT says that Z points UP; ZCORN is read as depths, positive down");
}

void GridSection::read_grid_options() {
  const DeckRecord record = stream_.next_record(3);
  arrays_.set_multiplier_regions(stream_.integer(record, 1).value_or(0));
}

void GridSection::fail_missing(const std::string& keyword, ParseError::What what) const {
  throw ParseError({stream_.main_file(), 0, keyword}, std::move(what));
}

CornerPointGrid GridSection::finish() {
  if (!arrays_.has_dimensions())
    fail_missing("SPECGRID",
                 {"the dimensions of a grid (SPECGRID or DIMENS)", "none", "is this a deck or a GRDECL file?"});
  arrays_.begin_section(DeckSection::bare);  // scratch arrays end
  CornerPointGrid grid;
  grid.dimensions = arrays_.dimensions();
  grid.units = units_;
  grid.mapaxes = mapaxes_;
  grid.metre_per_map_unit = metre_per_map_unit_;
  grid.has_map_coordinates = has_map_coordinates_;
  grid.edits = connections_.finish(units_);
  grid.connects_across_pinch = grid.edits.pinch.has_value() || grid.edits.pinchout;
  make_geometry(grid);
  take_active(grid);
  grid.porosity = take_rock_array("PORO", grid);
  grid.net_to_gross = take_rock_array("NTG", grid);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.permeability[axis] = take_rock_array(std::string("PERM") + "XYZ"[axis], grid);
    for (double& k : grid.permeability[axis]) k *= m2_per_millidarcy;
  }
  take_properties(grid);
  validate(grid);
  return grid;
}

void GridSection::make_geometry(CornerPointGrid& grid) {
  const double deck_unit = metre_per_length_unit(units_);
  if (coord_.empty() && zcorn_.empty()) {
    make_block_centred(grid);
    return scale_lengths(grid, deck_unit);
  }
  if (coord_.empty()) fail_missing("COORD", {"COORD beside ZCORN", "none", "the grid has no pillars without it"});
  if (zcorn_.empty()) fail_missing("ZCORN", {"ZCORN beside COORD", "none", "the grid has no depths without it"});
  grid.coord = std::move(coord_);
  grid.zcorn = std::move(zcorn_);
  scale_lengths(grid, metre_per_grid_unit_.value_or(deck_unit));
  for (const char* name : {"DX", "DY", "DZ", "TOPS"}) arrays_.arrays.erase(name);
}

void GridSection::scale_lengths(CornerPointGrid& grid, double metre_per_unit) const {
  if (metre_per_unit == 1.0) return;
  for (double& length : grid.coord) length *= metre_per_unit;
  for (double& depth : grid.zcorn) depth *= metre_per_unit;
}

void GridSection::make_block_centred(CornerPointGrid& grid) {
  std::array<std::vector<double>, 4> values;
  static constexpr std::array names{"DX", "DY", "DZ", "TOPS"};
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (const auto found = arrays_.arrays.find(names[n]); found != arrays_.arrays.end()) {
      values[n] = std::get<std::vector<double>>(std::move(found->second.values));
      arrays_.arrays.erase(found);
      if (n < 3) fill_down(values[n], names[n]);
    } else if (n < 3 && !spacing_[n].empty()) {
      stream_.charge_values(grid.cell_count());
      for (std::int64_t cell = 0; cell < grid.cell_count(); ++cell)
        values[n].push_back(spacing_[n][static_cast<std::size_t>(grid.ijk(HostCellId(cell))[n])]);
    } else {
      fail_missing("COORD",
                   {"COORD and ZCORN, or DX, DY, DZ and TOPS", fmt::format("no {}", n == 0 ? "geometry" : names[n]),
                    "include the file that holds the geometry"});
    }
  }
  stream_.charge_values(8 * grid.cell_count());
  try {
    CornerPoints points = corner_points({grid.dimensions, values[0], values[1], values[2], values[3]});
    grid.coord = std::move(points.coord);
    grid.zcorn = std::move(points.zcorn);
  } catch (const InvalidInput& error) {
    fail_missing("DX", {"a block-centred grid with pillars", error.what(), ""});
  }
}

/// An array that is given for the top layer, and for no cell below it, holds for every layer.
void GridSection::fill_down(std::vector<double>& values, const std::string& name) const {
  const auto& n = arrays_.dimensions();
  const auto layer = static_cast<std::ptrdiff_t>(n[0] * n[1]);
  const auto below = values.begin() + layer;
  if (below == values.end() || !std::all_of(values.begin(), below, [](double v) { return is_given(v); }) ||
      std::any_of(below, values.end(), [](double v) { return is_given(v); }))
    return;
  for (auto at = below; at != values.end(); ++at) *at = *(at - layer);
  stream_.notes.push_back(
      fmt::format("{}: {} is given for the top layer only and holds for those below", stream_.main_file(), name));
}

void GridSection::take_active(CornerPointGrid& grid) {
  const auto count = static_cast<std::size_t>(grid.cell_count());
  const auto found = arrays_.arrays.find("ACTNUM");
  grid.active.assign(count, 1);
  if (found == arrays_.arrays.end()) return;
  const auto& values = std::get<std::vector<std::int32_t>>(found->second.values);
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (values[cell] != unset_integer && values[cell] != 0 && values[cell] != 1)
      throw ParseError(found->second.last_set,
                       {"0 or 1 for every cell", fmt::format("{} for {}", values[cell], cell_name(grid, cell)), ""});
    grid.active[cell] = values[cell] == 0 ? 0 : 1;
  }
  arrays_.arrays.erase(found);
}

std::vector<double> GridSection::take_rock_array(const std::string& name, const CornerPointGrid& grid) {
  const auto found = arrays_.arrays.find(name);
  if (found == arrays_.arrays.end()) return {};
  const CellArrayRule& rule = *find_cell_array(name);
  auto values = std::get<std::vector<double>>(std::move(found->second.values));
  if (!rule.has_default) fill_down(values, name);
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    double& value = values[cell];
    if (std::isnan(value) && !rule.has_default && grid.active[cell] != 0)
      throw ParseError(found->second.last_set,
                       {"a value for every active cell", fmt::format("none for {}", cell_name(grid, cell)),
                        "give it, or make the cell inactive"});
    if (std::isnan(value)) value = rule.default_value;
    if (value < 0.0 || !std::isfinite(value))
      throw ParseError(found->second.last_set,
                       {"a value of 0 or more", fmt::format("{} for {}", value, cell_name(grid, cell)), ""});
  }
  arrays_.arrays.erase(found);
  return values;
}

void GridSection::take_properties(CornerPointGrid& grid) {
  for (auto& [name, array] : arrays_.arrays) {
    const double fallback = find_cell_array(name)->default_value;
    if (auto* reals = std::get_if<std::vector<double>>(&array.values)) {
      std::size_t unset = 0;
      std::vector<std::uint8_t> given(reals->size());
      for (std::size_t cell = 0; cell < reals->size(); ++cell) {
        double& value = (*reals)[cell];
        if (std::isinf(value)) throw ParseError(array.last_set, {"finite values", "one that overflows", ""});
        given[cell] = std::isnan(value) ? 0 : 1;
        if (given[cell] != 0) continue;
        unset += grid.active[cell];
        value = fallback;
      }
      // Simulators take such values from tables or from equilibrium.
      if (unset > 0) grid.property_given.emplace(name, std::move(given));
      if (unset > 0)
        stream_.notes.push_back(fmt::format("{}:{}: {} has no value in {} active cells; {:g} stands there",
                                            array.last_set.file, array.last_set.line, name, unset, fallback));
    } else {
      for (std::int32_t& value : std::get<std::vector<std::int32_t>>(array.values))
        if (value == unset_integer) value = static_cast<std::int32_t>(fallback);
    }
    grid.properties.emplace(name, std::move(array.values));
  }
  arrays_.arrays.clear();
}

}  // namespace wellknit
