// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// FEHM takes a connection's transmissibility as its coefficient times the permeability along the line of centres, of
/// the tensor whose entries are the harmonic means 2 k1 k2 / (k1 + k2) of the two cells'.

#include "writers/write_fehm.h"

#include <fmt/format.h>

#include <algorithm>

#include "writers/fixed_field.h"
#include "writers/text_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

/// A cell beside another one, and the place of what is between them in the list of coefficients, from 1.
struct Entry {
  std::int32_t column;
  std::int32_t coefficient;
};

/// The matrix by rows: neighbours and the diagonal, in order of columns.
struct Rows {
  std::vector<std::int64_t> start;  ///< cells + 1
  std::vector<Entry> entries;
  std::int64_t longest = 0;
};

Rows matrix_rows(const Mesh& mesh) {
  const std::size_t cells = mesh.cells.size();
  Rows out;
  out.start.assign(cells + 1, 0);
  for (const auto& [a, b] : mesh.connections.cells) {
    ++out.start[a.index() + 1];
    ++out.start[b.index() + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) out.start[c + 1] += out.start[c] + 1;  // with the diagonal
  out.entries.resize(static_cast<std::size_t>(out.start.back()));
  std::vector<std::int64_t> next(out.start.begin(), out.start.end() - 1);
  const auto add = [&](std::size_t row, std::size_t column, std::size_t coefficient) {
    out.entries[static_cast<std::size_t>(next[row]++)] = {static_cast<std::int32_t>(column + 1),
                                                          static_cast<std::int32_t>(coefficient + 1)};
  };
  const std::size_t connections = mesh.connections.size();
  for (std::size_t c = 0; c < cells; ++c) add(c, c, connections);  // all diagonals share the last, 0
  for (std::size_t n = 0; n < connections; ++n) {
    const auto& [a, b] = mesh.connections.cells[ConnectionId(n)];
    add(a.index(), b.index(), n);
    add(b.index(), a.index(), n);
  }
  for (std::size_t c = 0; c < cells; ++c) {
    std::sort(out.entries.begin() + out.start[c], out.entries.begin() + out.start[c + 1],
              [](const Entry& a, const Entry& b) { return a.column < b.column; });
    out.longest = std::max(out.longest, out.start[c + 1] - out.start[c]);
  }
  return out;
}

/// Entries of a block, five in a line.
class Block {
 public:
  explicit Block(TextFile& out) : out_(out) {}
  ~Block() {
    if (count_ % 5 != 0) out_.end_line();
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  void add(std::int64_t value) {
    fixed_integer(out_, value);
    step();
  }
  void add(double value) {
    exponential_number(out_, value);
    step();
  }

 private:
  void step() {
    if (++count_ % 5 == 0) out_.end_line();
  }
  TextFile& out_;
  std::int64_t count_ = 0;
};

class FehmFolder {
 public:
  FehmFolder(const Mesh& mesh, std::string folder, std::string shown_path, const FehmOptions& options)
      : mesh_(mesh), folder_(std::move(folder)), shown_path_(std::move(shown_path)), options_(options) {}

  void write() {
    stor();
    coordinates();
    macros();
    TextFile wells = file("wells.csv");
    write_well_table(wells, mesh_, 1);
    wells.close();
  }

  /// What must be said, after write().
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> out;
    if (closed_ > 0)
      out.push_back(fmt::format(
          "{} connections have a transmissibility that no coefficient gives (no permeability on a side); FEHM will "
          "have none there",
          closed_));
    if (options_.areas == AreaKind::raw)
      out.push_back("the coefficients are area over distance: angles and multipliers are not in FEHM's fluxes");
    return out;
  }

 private:
  [[nodiscard]] TextFile file(const std::string& name) const { return {folder_ + "/" + name, shown_path_}; }

  double coefficient(ConnectionId connection) {
    if (options_.areas == AreaKind::raw) return -geometric_factor(mesh_, connection);
    const auto& [a, b] = mesh_.connections.cells[connection];
    const Vec3& k1 = mesh_.cells.permeability[a];
    const Vec3& k2 = mesh_.cells.permeability[b];
    Vec3 mean = Vec3::Zero();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (k1[axis] > 0.0 && k2[axis] > 0.0) mean[axis] = 2.0 * k1[axis] * k2[axis] / (k1[axis] + k2[axis]);
    const double along = permeability_along(mean, centre_line(mesh_, connection).direction);
    const double transmissibility = mesh_.connections.transmissibility[connection];
    if (along > 0.0) return -transmissibility / along;
    closed_ += transmissibility > 0.0 ? 1 : 0;
    return 0.0;
  }

  void stor() {
    const Rows rows = matrix_rows(mesh_);
    const auto cells = static_cast<std::int64_t>(mesh_.cells.size());
    const std::int64_t offset = cells + 1;  // pointers count from the first of the row pointers
    TextFile out = file("mesh.stor");
    out.text("fehmstor ascir8i4 wellknit sparse matrix of connections\n01/01/1980\n");
    for (const std::int64_t value : {static_cast<std::int64_t>(mesh_.connections.size()) + 1, cells,
                                     rows.start.back() + offset, std::int64_t{1}, rows.longest})
      fixed_integer(out, value);
    out.end_line();
    {
      Block volumes(out);
      for (const double volume : mesh_.cells.volume) volumes.add(volume);
    }
    {
      // FEHM reads pointers and columns as one list.
      Block graph(out);
      for (const std::int64_t start : rows.start) graph.add(start + offset);
      for (const Entry& entry : rows.entries) graph.add(static_cast<std::int64_t>(entry.column));
    }
    {
      Block places(out);
      for (const Entry& entry : rows.entries) places.add(static_cast<std::int64_t>(entry.coefficient));
      for (std::int64_t c = 0; c < offset; ++c) places.add(std::int64_t{0});
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) places.add(diagonal(rows, c) + offset + 1);
    }
    {
      Block coefficients(out);
      for (std::size_t n = 0; n < mesh_.connections.size(); ++n) coefficients.add(coefficient(ConnectionId(n)));
      coefficients.add(0.0);
    }
    out.close();
  }

  /// Where the row's own column is among all entries.
  static std::int64_t diagonal(const Rows& rows, std::size_t cell) {
    const auto begin = rows.entries.begin() + rows.start[cell];
    const auto found =
        std::lower_bound(begin, rows.entries.begin() + rows.start[cell + 1], static_cast<std::int32_t>(cell + 1),
                         [](const Entry& entry, std::int32_t column) { return entry.column < column; });
    return rows.start[cell] + (found - begin);
  }

  void coordinates() const {
    TextFile out = file("mesh.fehmn");
    out.print("coor\n{}\n", mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const Vec3& p = mesh_.cells.center[CellId(c)];
      out.integer(static_cast<std::int64_t>(c) + 1);
      out.text(" ");
      out.numbers({p.x(), p.y(), -p.z()});
      out.end_line();
    }
    out.text("\nelem\n4 0\n\nstop\n");  // no elements: the coefficients come from mesh.stor
    out.close();
  }

  /// A line for each node: first, last, step, three numbers.
  template <class Get>
  void macro(const char* name, std::string_view keyword, const Get& get) const {
    TextFile out = file(name);
    out.text(keyword);
    out.end_line();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const auto id = static_cast<std::int64_t>(c) + 1;
      out.integer(id);
      out.text(" ");
      out.integer(id);
      out.text(" 1 ");
      out.point(get(CellId(c)));
      out.end_line();
    }
    out.text("\nstop\n");
    out.close();
  }

  void macros() const {
    macro("perm.macro", "perm", [&](CellId cell) { return mesh_.cells.permeability[cell]; });
    // Density and heat capacity of a common sandstone, to be replaced; pore volume over bulk volume.
    macro("rock.macro", "rock",
          [&](CellId cell) { return Vec3(2650.0, 1000.0, mesh_.cells.pore_volume[cell] / mesh_.cells.volume[cell]); });
  }

  const Mesh& mesh_;
  std::string folder_;
  std::string shown_path_;
  FehmOptions options_;
  std::int64_t closed_ = 0;
};

}  // namespace

std::vector<std::string> write_fehm(const Mesh& mesh, const std::string& path, const FehmOptions& options,
                                    Overwrite overwrite) {
  OutputFile folder(path, overwrite, fehm_contents);
  FehmFolder out(mesh, folder.temporary_path(), path, options);
  out.write();
  folder.commit();
  return out.notes();
}

}  // namespace wellknit
