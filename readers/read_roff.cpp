// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_roff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "readers/cell_arrays.h"
#include "readers/deck_keywords.h"
#include "readers/roff_tags.h"
#include "readers/text.h"

namespace wellknit {

namespace {

// What stands for "no value".
constexpr double undefined_number = -999.0;
constexpr std::int32_t undefined_byte = 255;

class RoffReader {
 public:
  RoffReader(std::string_view bytes, const std::string& path) : file_(bytes, path) {}
  GridPart read();

 private:
  void take(const RoffKey& key);
  void take_vector(const RoffKey& key, std::string_view suffix, Vec3& vector) const;
  void take_dimension(const RoffKey& key);
  void take_parameter(const RoffKey& key);
  void check_subgrids() const;
  void set_dimensions();
  void make_pillars();
  void make_depths();
  void check_splits() const;
  void set_active();
  void add_parameter(const std::string& name, const RoffKey& key);
  [[nodiscard]] std::size_t cell(std::int64_t i, std::int64_t j, std::int64_t layer) const;
  template <class T>
  [[nodiscard]] std::vector<T> reordered(const std::vector<T>& values) const;
  void note_depths_that_rise();
  void require_finite(const RoffKey& key, const std::vector<double>& values) const;

  RoffTags file_;
  GridPart part_;
  std::array<std::int64_t, 3> dimensions_{};
  Vec3 offset_ = Vec3::Zero();
  Vec3 scale_ = Vec3(1.0, 1.0, -1.0);
  std::optional<RoffKey> subgrids_, corner_lines_, splits_, depths_, active_;
  std::string parameter_name_;
  std::int64_t parameter_number_ = -1;
  std::vector<std::pair<std::string, RoffKey>> parameters_;
  std::vector<std::string> unknown_;
};

GridPart RoffReader::read() {
  while (const auto key = file_.next()) take(*key);
  set_dimensions();
  if (corner_lines_ || depths_) {
    make_pillars();
    make_depths();
    check_subgrids();
  }
  if (active_) set_active();
  for (const auto& [name, key] : parameters_) add_parameter(name, key);
  if (corner_lines_) part_.metre_per_grid_unit = 1.0;
  if (!unknown_.empty())
    part_.notes.push_back(
        fmt::format("{} not understood, and skipped; parameters need the name of a GRDECL keyword", listed(unknown_)));
  return std::move(part_);
}

void RoffReader::take(const RoffKey& key) {
  if (key.tag == "dimensions") return take_dimension(key);
  if (key.tag == "translate") return take_vector(key, "offset", offset_);
  if (key.tag == "scale") return take_vector(key, "scale", scale_);
  if (key.tag == "parameter") return take_parameter(key);
  if (key.tag == "filedata" && key.name == "filetype") {
    const std::string type = file_.text(key);
    if (type != "grid" && type != "parameter")
      file_.fail(key, {"a grid or a parameter", quoted_for_message(type), "surfaces and wells are not read from ROFF"});
  }
  const auto keep = [&](std::string_view tag, std::string_view name, std::optional<RoffKey>& place) {
    if (key.tag == tag && key.name == name) place = key;
  };
  keep("subgrids", "nLayers", subgrids_);
  keep("cornerLines", "data", corner_lines_);
  keep("zvalues", "splitEnz", splits_);
  keep("zvalues", "data", depths_);
  keep("active", "data", active_);
}

void RoffReader::take_dimension(const RoffKey& key) {
  static constexpr std::array names{"nX", "nY", "nZ"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (key.name == names[axis]) dimensions_[axis] = file_.integer(key);
}

/// xoffset, yoffset, zoffset and the like.
void RoffReader::take_vector(const RoffKey& key, std::string_view suffix, Vec3& vector) const {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (key.name != std::string(1, "xyz"[axis]) + std::string(suffix)) continue;
    vector[axis] = file_.real(key);
    if (suffix == "scale" && vector[axis] == 0.0)
      file_.fail(key, {"a scale that is not 0", "0", "the file is damaged"});
  }
}

/// The name stands in front of the data.
void RoffReader::take_parameter(const RoffKey& key) {
  if (key.tag_number != parameter_number_) parameter_name_.clear();
  parameter_number_ = key.tag_number;
  if (key.name == "name") parameter_name_ = file_.text(key);
  if (key.name != "data") return;
  if (parameter_name_.empty()) file_.fail(key, {"the parameter's name before its data", "none", "the file is damaged"});
  parameters_.emplace_back(parameter_name_, key);
}

void RoffReader::set_dimensions() {
  part_.dimensions = checked_dimensions(dimensions_);
  if (!part_.dimensions)
    throw ParseError({file_.path(), 0, "dimensions"},
                     {fmt::format("nX, nY and nZ of 1 or more, {} cells in all at most", most_cells_of_a_file),
                      fmt::format("{} {} {}", dimensions_[0], dimensions_[1], dimensions_[2]),
                      "the file is damaged, or holds no grid"});
}

/// Pillars stand with j running fastest, each from its bottom to its top point.
void RoffReader::make_pillars() {
  if (!corner_lines_)
    throw ParseError({file_.path(), 0, "cornerLines"},
                     {"cornerLines.data beside zvalues", "none", "the file is damaged"});
  const auto [nx, ny, nz] = dimensions_;
  file_.require_count(*corner_lines_, 6 * (nx + 1) * (ny + 1));
  const std::vector<double> lines = file_.reals(*corner_lines_);
  part_.coord.resize(lines.size());
  std::size_t at = 0;
  for (std::int64_t i = 0; i <= nx; ++i) {
    for (std::int64_t j = 0; j <= ny; ++j, at += 6) {
      double* pillar = &part_.coord[static_cast<std::size_t>(6 * (i + (nx + 1) * j))];
      for (std::size_t n = 0; n < 6; ++n) {
        const auto axis = static_cast<Eigen::Index>(n % 3);
        pillar[(n + 3) % 6] = (lines[at + n] + offset_[axis]) * scale_[axis];
      }
    }
  }
  require_finite(*corner_lines_, part_.coord);
}

void RoffReader::check_splits() const {
  const auto [nx, ny, nz] = dimensions_;
  const std::int64_t nodes = (nx + 1) * (ny + 1) * (nz + 1);
  std::int64_t expected = nodes;
  if (splits_) {
    file_.require_count(*splits_, nodes);
    const std::vector<std::int32_t> splits = file_.integers(*splits_);
    for (const std::int32_t split : splits)
      if (split != 1 && split != 2 && split != 4 && split != 8)
        file_.fail(*splits_, {"1, 2, 4 or 8 depths for every node", fmt::format("{}", split), "the file is damaged"});
    expected = std::accumulate(splits.begin(), splits.end(), std::int64_t{0});
  }
  file_.require_count(*depths_, expected);
}

/// Nodes stand with k running fastest, from the bottom up. Around a node there are eight cells: first the four below
/// it, then the four above; among four south-west, south-east, north-west, north-east. A node has 1 depth for all of
/// them; 2, below and above; 4, one for each column; or all 8.
void RoffReader::make_depths() {
  if (!depths_)
    throw ParseError({file_.path(), 0, "zvalues"}, {"zvalues.data beside cornerLines", "none", "the file is damaged"});
  check_splits();
  const auto [nx, ny, nz] = dimensions_;
  const std::vector<std::int32_t> splits = splits_ ? file_.integers(*splits_) : std::vector<std::int32_t>();
  const std::vector<double> depths = file_.reals(*depths_);
  CornerPointGrid shape;  // for its numbering alone
  shape.dimensions = dimensions_;
  part_.zcorn.resize(static_cast<std::size_t>(8 * nx * ny * nz));
  std::size_t node = 0;
  std::size_t first = 0;
  for (std::int64_t i = 0; i <= nx; ++i) {
    for (std::int64_t j = 0; j <= ny; ++j) {
      for (std::int64_t level = 0; level <= nz; ++level, ++node) {
        const std::int32_t split = splits_ ? splits[node] : 1;
        for (int q = 0; q < 8; ++q) {
          const int east = q & 1;
          const int north = (q >> 1) & 1;
          const int above = q >> 2;
          const std::array<std::int64_t, 3> ijk{i - 1 + east, j - 1 + north, nz - level - above};
          if (ijk[0] < 0 || ijk[1] < 0 || ijk[2] < 0 || ijk[0] == nx || ijk[1] == ny || ijk[2] == nz) continue;
          const int which = split == 1 ? 0 : split == 2 ? above : split == 4 ? q & 3 : q;
          const double depth = depths[first + static_cast<std::size_t>(which)];
          part_.zcorn[shape.zcorn_index(ijk, 1 - east, 1 - north, above)] = (depth + offset_.z()) * scale_.z();
        }
        first += static_cast<std::size_t>(split);
      }
    }
  }
  require_finite(*depths_, part_.zcorn);
  note_depths_that_rise();
}

void RoffReader::require_finite(const RoffKey& key, const std::vector<double>& values) const {
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    file_.fail(key, {"coordinates that are finite when moved and scaled", "one that overflows", "the file is damaged"});
}

/// The first layer of the file is the lowest: a grid that is deeper at its top has its depths as elevations.
void RoffReader::note_depths_that_rise() {
  CornerPointGrid shape;
  shape.dimensions = dimensions_;
  const auto [nx, ny, nz] = dimensions_;
  double thickness = 0.0;
  for (std::int64_t j = 0; j < ny; ++j)
    for (std::int64_t i = 0; i < nx; ++i)
      thickness +=
          part_.zcorn[shape.zcorn_index({i, j, nz - 1}, 0, 0, 1)] - part_.zcorn[shape.zcorn_index({i, j, 0}, 0, 0, 0)];
  if (thickness < 0.0)
    part_.notes.emplace_back(
        "its top lies below its bottom: z may be an elevation; check scale.zscale (-1 in most files)");
}

void RoffReader::check_subgrids() const {
  if (!subgrids_) return;
  const std::vector<std::int32_t> layers = file_.integers(*subgrids_);
  const auto sum = std::accumulate(layers.begin(), layers.end(), std::int64_t{0});
  if (sum != dimensions_[2])
    file_.fail(*subgrids_, {fmt::format("{} layers in all subgrids, as nZ", dimensions_[2]), fmt::format("{}", sum),
                            "the file is damaged"});
}

/// The file's place of a cell: k fastest, from the bottom up.
std::size_t RoffReader::cell(std::int64_t i, std::int64_t j, std::int64_t k) const {
  return static_cast<std::size_t>((i * dimensions_[1] + j) * dimensions_[2] + (dimensions_[2] - 1 - k));
}

template <class T>
std::vector<T> RoffReader::reordered(const std::vector<T>& values) const {
  std::vector<T> out;
  out.reserve(values.size());
  for (std::int64_t k = 0; k < dimensions_[2]; ++k)
    for (std::int64_t j = 0; j < dimensions_[1]; ++j)
      for (std::int64_t i = 0; i < dimensions_[0]; ++i) out.push_back(values[cell(i, j, k)]);
  return out;
}

void RoffReader::set_active() {
  file_.require_count(*active_, dimensions_[0] * dimensions_[1] * dimensions_[2]);
  part_.arrays.push_back({"ACTNUM", reordered(file_.integers(*active_)), file_.where(*active_), false});
}

void RoffReader::add_parameter(const std::string& name, const RoffKey& key) {
  GridPartArray array;
  array.name = upper_case(name);
  array.where = file_.where(key);
  const CellArrayRule* rule = find_cell_array(array.name);
  if (rule == nullptr) {
    unknown_.push_back(quoted_for_message(name));
    return;
  }
  file_.require_count(key, dimensions_[0] * dimensions_[1] * dimensions_[2]);
  if (rule->kind == CellArrayKind::real) {
    std::vector<double> values = file_.reals(key);
    const double undefined = key.type == RoffType::byte ? undefined_byte : undefined_number;
    std::replace(values.begin(), values.end(), undefined, unset_real);
    array.values = reordered(values);
  } else {
    std::vector<std::int32_t> values = file_.integers(key);
    const auto undefined = key.type == RoffType::byte ? undefined_byte : static_cast<std::int32_t>(undefined_number);
    std::replace(values.begin(), values.end(), undefined, unset_integer);
    array.values = reordered(values);
  }
  part_.arrays.push_back(std::move(array));
}

}  // namespace

bool looks_like_roff(std::string_view bytes) {
  return bytes.substr(0, 8) == "roff-bin" || bytes.substr(0, 8) == "roff-asc";
}

GridPart parse_roff(std::string_view bytes, const std::string& path) { return RoffReader(bytes, path).read(); }

}  // namespace wellknit
