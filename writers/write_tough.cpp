// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// TOUGH takes a connection's transmissibility as AREAX / (D1 / k1 + D2 / k2), where k is the rock's permeability
/// PER(ISOT) times the element's modifier PMX.

#include "writers/write_tough.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "model/errors.h"
#include "writers/fixed_field.h"
#include "writers/text_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

constexpr int field = 10;               // columns of a number
constexpr double no_flow = 1e-20;       // a modifier for cells without permeability: 0 means "not given"
constexpr double grain_density = 2650;  // kg/m3, of quartz: for runs with heat, to be replaced

/// Names of one length: three letters or digits, a letter first, and a number without leading zeros, which Fortran
/// would turn into blanks.
class ElementNames {
 public:
  explicit ElementNames(int length) : length_(length), first_(power(length - 4)), numbers_(9 * power(length - 4)) {}

  [[nodiscard]] std::int64_t capacity() const { return 26 * 36 * 36 * numbers_; }
  [[nodiscard]] int length() const { return length_; }
  void write(TextFile& out, std::int64_t cell) const {
    constexpr std::string_view signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    const std::int64_t code = cell / numbers_;
    for (const std::int64_t sign : {code / (36 * 36), code / 36 % 36, code % 36})
      out.text(signs.substr(static_cast<std::size_t>(sign), 1));
    out.integer(first_ + cell % numbers_);
  }

 private:
  static std::int64_t power(int exponent) {
    std::int64_t out = 1;
    for (int i = 0; i < exponent; ++i) out *= 10;
    return out;
  }
  int length_;
  std::int64_t first_;    ///< the least number of so many digits
  std::int64_t numbers_;  ///< how many there are
};

constexpr int shortest_name = 5;
constexpr int longest_name = 8;

ElementNames names_for(const Mesh& mesh, int length) {
  if (length != 0 && (length < shortest_name || length > longest_name))
    throw InvalidInput(fmt::format("element names of {} characters: TOUGH has 5 to 8", length));
  int wanted = length == 0 ? shortest_name : length;
  while (ElementNames(wanted).capacity() < static_cast<std::int64_t>(mesh.cells.size())) {
    if (length != 0)
      throw InvalidInput(
          fmt::format("{} cells are more than names of {} characters; take {}", mesh.cells.size(), length, length + 1));
    ++wanted;
  }
  return ElementNames(wanted);
}

struct Rock {
  std::string name;
  double porosity = 0.0;
  Vec3 permeability = Vec3::Zero();  ///< PER, m2
};

/// The rocks, and which one each cell is of.
struct Rocks {
  std::vector<Rock> rocks;
  IdVector<CellId, std::int32_t> of_cell;
};

/// A rock for each value from 0 to 9999 of a property; empty when it is no such property.
std::vector<std::int32_t> region_values(const Mesh& mesh, const std::string& region) {
  const auto found = mesh.cells.properties.find(region);
  if (found == mesh.cells.properties.end()) return {};
  std::vector<std::int32_t> out;
  std::visit(
      [&](const auto& values) {
        for (const auto value : values) {
          if (!(value >= 0 && value <= 9999)) return;
          out.push_back(static_cast<std::int32_t>(value));
        }
      },
      found->second);
  return out.size() == mesh.cells.size() ? out : std::vector<std::int32_t>{};
}

Rocks assign_rocks(const Mesh& mesh, const std::string& region) {
  constexpr std::array<const char*, 4> kinds{"HOST", "REFIN", "TRANS", "RADIA"};
  const std::vector<std::int32_t> values = region_values(mesh, region);
  const auto value_of = [&](std::size_t c) {
    return values.empty() ? static_cast<std::int32_t>(mesh.cells.kind[CellId(c)]) : values[c];
  };
  std::map<std::int32_t, std::int32_t> places;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) places.emplace(value_of(c), 0);
  Rocks out;
  for (auto& [value, place] : places) {
    place = static_cast<std::int32_t>(out.rocks.size());
    const std::string name =
        values.empty() ? std::string(kinds[static_cast<std::size_t>(value)]) : fmt::format("R{:04}", value);
    out.rocks.push_back({name, 0.0, Vec3::Zero()});
  }
  out.of_cell.reserve(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) out.of_cell.push_back(places[value_of(c)]);
  return out;
}

/// With four digits, which every field can hold: the elements' modifiers make up for the rest.
double rounded(double value) { return std::stod(fmt::format("{:.3e}", value)); }

/// Porosities keep each rock's pore volume. PER(1) is the least kx of the rock, so that no modifier is small (iTOUGH2
/// takes those below 1e-4 for permeabilities); the other two are in the proportions of the sums.
void set_rock_figures(Rocks& rocks, const Mesh& mesh) {
  struct Sums {
    double volume = 0.0;
    double pore_volume = 0.0;
    Vec3 permeability = Vec3::Zero();
    double least = std::numeric_limits<double>::infinity();
  };
  std::vector<Sums> sums(rocks.rocks.size());
  const Cells& cells = mesh.cells;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Sums& sum = sums[static_cast<std::size_t>(rocks.of_cell[CellId(c)])];
    sum.volume += cells.volume[CellId(c)];
    sum.pore_volume += cells.pore_volume[CellId(c)];
    sum.permeability += cells.permeability[CellId(c)];
    if (const double kx = cells.permeability[CellId(c)].x(); kx > 0.0) sum.least = std::min(sum.least, kx);
  }
  for (std::size_t r = 0; r < sums.size(); ++r) {
    const Sums& sum = sums[r];
    rocks.rocks[r].porosity = sum.volume > 0.0 ? sum.pore_volume / sum.volume : 0.0;
    if (sum.permeability.x() > 0.0)
      rocks.rocks[r].permeability = (sum.permeability * (sum.least / sum.permeability.x())).unaryExpr(&rounded);
  }
}

Rocks rocks_of(const Mesh& mesh, const std::string& region) {
  Rocks out = assign_rocks(mesh, region);
  set_rock_figures(out, mesh);
  return out;
}

constexpr std::string_view ruler = "----1----*----2----*----3----*----4----*----5----*----6----*----7----*----8\n";

class ToughFolder {
 public:
  ToughFolder(const Mesh& mesh, std::string folder, std::string shown_path, const ToughOptions& options)
      : mesh_(mesh),
        folder_(std::move(folder)),
        shown_path_(std::move(shown_path)),
        options_(options),
        names_(names_for(mesh, options.name_length)),
        rocks_(rocks_of(mesh, options.region)) {}

  void write() {
    TextFile out = file("MESH");
    elements(out);
    connections(out);
    out.close();
    rocks();
    table_of_names();
    TextFile wells = file("wells.csv");
    write_well_table(wells, mesh_, 1);
    wells.close();
  }

  /// What must be said, after write().
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> out;
    if (names_.length() > shortest_name)
      out.push_back(fmt::format("names of elements have {0} characters: set MOP2(2) = {0} in MOMOP (iTOUGH2, TOUGH3)",
                                names_.length()));
    if (closed_ > 0)
      out.push_back(
          fmt::format("{} connections have a transmissibility that no area gives (no permeability on a side, or no "
                      "distance); TOUGH will have none there",
                      closed_));
    if (options_.areas == AreaKind::raw)
      out.push_back("the areas are the faces' own: angles and multipliers are not in TOUGH's transmissibilities");
    if (!options_.region.empty() && region_values(mesh_, options_.region).empty())
      out.push_back(
          fmt::format("no property {} of whole numbers from 0 to 9999 in every cell; the rocks are the "
                      "kinds of cells",
                      options_.region));
    out.push_back("a rock has one porosity, which keeps its pore volume; names.csv has each cell's own");
    return out;
  }

 private:
  [[nodiscard]] TextFile file(const std::string& name) const { return {folder_ + "/" + name, shown_path_}; }

  static void blanks(TextFile& out, int count) { fixed_text(out, "", static_cast<std::size_t>(count)); }

  [[nodiscard]] const Rock& rock_of(CellId cell) const {
    return rocks_.rocks[static_cast<std::size_t>(rocks_.of_cell[cell])];
  }
  /// PMX.
  [[nodiscard]] double modifier(CellId cell) const {
    const double kx = mesh_.cells.permeability[cell].x();
    return kx > 0.0 ? kx / rock_of(cell).permeability.x() : no_flow;
  }

  void elements(TextFile& out) const {
    out.text("ELEME");
    out.text(ruler);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      names_.write(out, static_cast<std::int64_t>(c));
      blanks(out, 15 - names_.length());
      fixed_text(out, rock_of(CellId(c)).name, 5);
      fixed_number(out, mesh_.cells.volume[CellId(c)], field);
      blanks(out, field);  // AHTX
      fixed_number(out, modifier(CellId(c)), field);
      const Vec3& p = mesh_.cells.center[CellId(c)];
      for (const double value : {p.x(), p.y(), -p.z()}) fixed_number(out, value, field);
      out.end_line();
    }
    out.text("\n");
  }

  /// PER(ISOT) times PMX, as TOUGH has it.
  [[nodiscard]] double permeability(CellId cell, Eigen::Index axis) const {
    return mesh_.cells.permeability[cell].x() > 0.0 ? rock_of(cell).permeability[axis] * modifier(cell) : 0.0;
  }

  double area_of(ConnectionId connection, const CentreLine& line, Eigen::Index axis) {
    if (options_.areas == AreaKind::raw) return mesh_.connections.area[connection];
    const auto& [a, b] = mesh_.connections.cells[connection];
    const double transmissibility = mesh_.connections.transmissibility[connection];
    const double area = effective_area(transmissibility, line, permeability(a, axis), permeability(b, axis));
    closed_ += transmissibility > 0.0 && area == 0.0 ? 1 : 0;
    return area;
  }

  void connections(TextFile& out) {
    out.text("CONNE");
    out.text(ruler);
    for (std::size_t n = 0; n < mesh_.connections.size(); ++n) {
      const auto& [a, b] = mesh_.connections.cells[ConnectionId(n)];
      const CentreLine line = centre_line(mesh_, ConnectionId(n));
      Eigen::Index axis = 0;  // the one that the line is closest to
      line.direction.cwiseAbs().maxCoeff(&axis);
      names_.write(out, a.value());
      names_.write(out, b.value());
      blanks(out, 29 - 2 * names_.length());
      out.integer(axis + 1);
      fixed_number(out, line.first_share * line.length, field);
      fixed_number(out, (1.0 - line.first_share) * line.length, field);
      fixed_number(out, area_of(ConnectionId(n), line, axis), field);
      fixed_number(out, line.direction.z(), field);  // down is positive: the first cell is above
      out.end_line();
    }
    out.text("\n");
  }

  /// Density, porosity, permeabilities; heat capacity and conduction of a common sandstone, to be replaced.
  void rocks() const {
    TextFile out = file("ROCKS");
    out.text("ROCKS");
    out.text(ruler);
    for (const Rock& rock : rocks_.rocks) {
      fixed_text(out, rock.name, 10);
      for (const double value : {grain_density, rock.porosity, rock.permeability.x(), rock.permeability.y(),
                                 rock.permeability.z(), 2.0, 1000.0})
        fixed_number(out, value, field);
      out.end_line();
    }
    out.text("SEED\n\n");  // the elements' modifiers count
    out.close();
  }

  void table_of_names() const {
    TextFile out = file("names.csv");
    out.text("cell,name,porosity\n");
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      out.integer(static_cast<std::int64_t>(c) + 1);
      out.text(",");
      names_.write(out, static_cast<std::int64_t>(c));
      out.text(",");
      out.number(mesh_.cells.pore_volume[CellId(c)] / mesh_.cells.volume[CellId(c)]);
      out.end_line();
    }
    out.close();
  }

  const Mesh& mesh_;
  std::string folder_;
  std::string shown_path_;
  ToughOptions options_;
  ElementNames names_;
  Rocks rocks_;
  std::int64_t closed_ = 0;
};

}  // namespace

std::vector<std::string> write_tough(const Mesh& mesh, const std::string& path, const ToughOptions& options,
                                     Overwrite overwrite) {
  OutputFile folder(path, overwrite, tough_contents);
  ToughFolder out(mesh, folder.temporary_path(), path, options);
  out.write();
  folder.commit();
  return out.notes();
}

}  // namespace wellknit
