// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/well_sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/html.h"

namespace wellknit {

namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double width = 300.0;
constexpr double height = 180.0;
constexpr double margin = 14.0;
/// Two ends of stretches closer than this are one place, m: well paths are given in centimetres.
constexpr double same_place = 0.01;

/// The points of the path between two measured depths, with their ends.
std::vector<Vec3> piece_of(const Trajectory& path, const MeasuredDepthRange& range) {
  const auto at = [&](double md) {
    const auto& depths = path.measured_depth;
    const auto above = std::ranges::upper_bound(depths, md);
    const auto next = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - depths.begin(), 1, static_cast<std::ptrdiff_t>(depths.size()) - 1));
    const double along = std::clamp((md - depths[next - 1]) / (depths[next] - depths[next - 1]), 0.0, 1.0);
    return Vec3(path.points[next - 1] + along * (path.points[next] - path.points[next - 1]));
  };
  std::vector<Vec3> out{at(range.from)};
  for (std::size_t i = 0; i < path.points.size(); ++i)
    if (path.measured_depth[i] > range.from && path.measured_depth[i] < range.to) out.push_back(path.points[i]);
  out.push_back(at(range.to));
  return out;
}

/// Distance along the path in plan against depth. `start` is where the piece begins.
Points in_section(const std::vector<Vec3>& piece, const Trajectory& path) {
  const auto run_to = [&](const Vec3& point) {
    double run = 0.0;
    double best = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const Vec3 line = path.points[i + 1] - path.points[i];
      const double along = std::clamp(line.dot(point - path.points[i]) / std::max(line.squaredNorm(), 1e-30), 0.0, 1.0);
      const double distance = (path.points[i] + along * line - point).norm();
      if (distance < nearest) {
        nearest = distance;
        best = run + along * line.head<2>().norm();
      }
      run += line.head<2>().norm();
    }
    return best;
  };
  Points out;
  for (const Vec3& point : piece) out.emplace_back(run_to(point), point.z());
  return out;
}

Points in_plan(const std::vector<Vec3>& piece) {
  Points out;
  for (const Vec3& point : piece) out.emplace_back(point.x(), -point.y());
  return out;
}

/// From metres to the drawing.
class Frame {
 public:
  Frame(const Points& points, bool same_scale) {
    for (const auto& point : points)
      if (point.allFinite()) box_.extend(point);
    if (box_.isEmpty()) box_.extend(Eigen::Vector2d(0.0, 0.0));
    const Eigen::Vector2d room(width - 2 * margin, height - 2 * margin);
    scale_ = room.cwiseQuotient(box_.sizes().cwiseMax(1e-6));
    if (box_.sizes().x() < 0.02 * box_.sizes().y()) same_scale = true;  // a vertical well stays a straight line
    if (same_scale) scale_.setConstant(scale_.minCoeff());
    offset_ = Eigen::Vector2d(width, height) / 2 - box_.center().cwiseProduct(scale_);
  }
  [[nodiscard]] std::string line(const Points& points, std::string_view style) const {
    std::string text;
    for (const auto& point : points) {
      if (!point.allFinite()) continue;
      const Eigen::Vector2d at = point.cwiseProduct(scale_) + offset_;
      text += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
    }
    return fmt::format("<polyline class=\"{}\" points=\"{}\"/>", style, text);
  }
  [[nodiscard]] const Eigen::AlignedBox2d& box() const { return box_; }

 private:
  Eigen::AlignedBox2d box_;
  Eigen::Vector2d scale_;
  Eigen::Vector2d offset_;
};

template <class Project>
std::string drawing(const MeshWell& well, const std::vector<WellStretch>& stretches, const char* title, bool same_scale,
                    Project project) {
  const Points path = project(well.trajectory.points);
  const Frame frame(path, same_scale);
  std::string lines = frame.line(path, "well-path");
  for (const WellStretch& stretch : stretches)
    lines += frame.line(project(piece_of(well.trajectory, stretch.range)), stretch.own ? "well-radial" : "well-index");
  return fmt::format(
      "<figure><svg class=\"sketch\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}</svg>"
      "<figcaption>{}: {} m wide, {} m high</figcaption></figure>",
      width, height, title, lines, title, shown(std::round(frame.box().sizes().x())),
      shown(std::round(frame.box().sizes().y())));
}

}  // namespace

std::vector<WellStretch> stretches_of(const Mesh& mesh, WellId well) {
  std::vector<WellConnection> sorted = mesh.wells[well].connections;
  std::ranges::stable_sort(sorted, {}, [](const WellConnection& c) { return c.measured_depth.from; });
  std::vector<WellStretch> out;
  for (const WellConnection& connection : sorted) {
    const CellKind kind = mesh.cells.kind[connection.cell];
    const bool own = kind == CellKind::radial && mesh.cells.well[connection.cell] == well;
    const MeasuredDepthRange& range = connection.measured_depth;
    const bool goes_on = !out.empty() && out.back().kind == kind && out.back().own == own &&
                         range.from <= out.back().range.to + same_place;
    if (!goes_on) out.push_back({range, kind, own, 0, 0.0});
    WellStretch& stretch = out.back();
    stretch.range.to = std::max(stretch.range.to, range.to);
    ++stretch.cells;
    stretch.well_index += connection.well_index;
  }
  return out;
}

std::string well_sketch(const MeshWell& well, const std::vector<WellStretch>& stretches) {
  if (well.trajectory.points.size() < 2) return "";
  const auto section = [&](const std::vector<Vec3>& piece) { return in_section(piece, well.trajectory); };
  return "<div class=\"sketches\">" + drawing(well, stretches, "Section along the well", false, section) +
         drawing(well, stretches, "Plan", true, in_plan) + "</div>\n";
}

}  // namespace wellknit
