// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/refined_path.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

#include "algorithm/trilinear.h"

namespace wellknit {

namespace {

/// A refined cell's place in one source cell.
struct PlacedCell {
  HostCellId cell;
  PieceBox box;

  [[nodiscard]] bool holds(const Vec3& uvw) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = std::clamp(uvw[static_cast<Eigen::Index>(a)], 0.0, 1.0);
      if (x < box.low[a] || x > box.high[a]) return false;
    }
    return true;
  }
};

class PathSplitter {
 public:
  PathSplitter(const CornerPointGrid& grid, const HostMesh& host, const std::vector<CellPart>& parts)
      : grid_(grid), host_(host) {
    for (const CellPart& part : parts)
      if (host.is_refined(part.cell)) placed_[part.cell.value()];
    if (placed_.empty()) return;
    const RefinedCells& refined = host.refined;
    for (std::size_t c = 0; c < refined.size(); ++c)
      for (auto p = static_cast<std::size_t>(refined.piece_start[c]);
           p < static_cast<std::size_t>(refined.piece_start[c + 1]); ++p)
        if (const auto found = placed_.find(refined.piece_source[p].value()); found != placed_.end())
          found->second.push_back({HostCellId(c + host.source_count()), refined.piece_box[p]});
  }

  void add(const CellPart& part) {
    if (!host_.is_refined(part.cell)) return push(part, part.cell);
    // The way in the cell's own coordinates is all but straight: pieces of it are taken as straight.
    constexpr int pieces = 16;
    const auto& cells = placed_.at(part.cell.value());
    const auto corners = grid_.corners(part.cell);
    begins_new_part_ = true;
    Vec3 from = place_at(part, corners, 0.0);
    for (int n = 0; n < pieces; ++n) {
      const Vec3 to = place_at(part, corners, (n + 1.0) / pieces);
      std::vector<double> cuts = cuts_between(cells, from, to);
      for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        const Vec3 middle = from + 0.5 * (cuts[c] + cuts[c + 1]) * (to - from);
        add_stretch(part, cells, middle, (n + cuts[c]) / pieces, (n + cuts[c + 1]) / pieces);
      }
      from = to;
    }
  }

  HostPath take() { return std::move(out_); }

 private:
  static Vec3 place_at(const CellPart& part, const std::array<Vec3, 8>& corners, double t) {
    const auto uvw = inverse_trilinear(corners, part.entry + t * (part.exit - part.entry));
    return uvw ? *uvw : Vec3::Constant(0.5);
  }

  /// Where the line from one place to another crosses sides of cells, in [0, 1] with both ends.
  static std::vector<double> cuts_between(const std::vector<PlacedCell>& cells, const Vec3& from, const Vec3& to) {
    std::vector<double> cuts{0.0, 1.0};
    for (const PlacedCell& cell : cells)
      for (std::size_t a = 0; a < 3; ++a)
        for (const double side : {cell.box.low[a], cell.box.high[a]}) {
          const auto axis = static_cast<Eigen::Index>(a);
          const double t = (side - from[axis]) / (to[axis] - from[axis]);
          if (t > 0.0 && t < 1.0) cuts.push_back(t);
        }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
  }

  void add_stretch(const CellPart& part, const std::vector<PlacedCell>& cells, const Vec3& middle, double from,
                   double to) {
    const auto holder = std::find_if(cells.begin(), cells.end(), [&](const auto& c) { return c.holds(middle); });
    const HostCellId cell = holder == cells.end() ? part.cell : holder->cell;
    const Vec3 exit = part.entry + to * (part.exit - part.entry);
    const double span = part.measured_depth.to - part.measured_depth.from;
    const double last = part.measured_depth.from + to * span;
    if (!begins_new_part_ && out_.parts.back().cell == cell) {
      out_.parts.back().exit = exit;
      out_.parts.back().measured_depth.to = last;
      return;
    }
    begins_new_part_ = false;
    push({cell, {part.measured_depth.from + from * span, last}, part.entry + from * (part.exit - part.entry), exit},
         part.cell);
  }

  void push(const CellPart& part, HostCellId source) {
    out_.parts.push_back(part);
    out_.source.push_back(source);
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  std::unordered_map<std::int64_t, std::vector<PlacedCell>> placed_;  ///< by source cell
  bool begins_new_part_ = true;
  HostPath out_;
};

}  // namespace

HostPath split_at_refined(const CornerPointGrid& grid, const HostMesh& host, const std::vector<CellPart>& parts) {
  PathSplitter splitter(grid, host, parts);
  for (const CellPart& part : parts) splitter.add(part);
  return splitter.take();
}

}  // namespace wellknit
