// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Rings of one well. Where the text says "reference" it means E_ref; phi_0 is the map of the host's cells onto boxes.
#include "algorithm/well_tube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "algorithm/horizon.h"
#include "algorithm/well_path.h"

namespace wellknit {

namespace {

constexpr int path_sample_count = 2000;  ///< fine enough to see every layer that is 1/1000 of the well's length thick
constexpr double mode_angle = 30.0 * std::numbers::pi / 180.0;
/// Rings that lean more than this from their path's normal are first smoothed; about the angle that a segment of a
/// well at the limit of curvature turns by.
constexpr double tilt_limit = 6.0 * std::numbers::pi / 180.0;
constexpr double least_lateral_ratio =
    0.5;  ///< method.md §3: the drainage radius is at most half the radius of curvature
constexpr double least_reference_ratio = 0.2;
constexpr int most_natural_segments =
    500;  ///< of a swept tube when the user does not say: a longer one gets longer cells
/// Of the drainage radius: what a layered tube keeps from a fault.
constexpr double layered_gap = 0.8;

// ---- layered
// ----------------------------------------------------------------------------------------------------------

/// Where the path crosses a horizon: lateral place in E_ref and measured depth.
struct Crossing {
  double x = 0.0;
  double y = 0.0;
  double measured_depth = 0.0;
  bool is_found = false;
};

/// Bisection between two samples on either side of the plane; they see different layers, and a kink of phi_0 between
/// them is what makes a straight interpolation wrong.
Crossing refine_crossing(const HostFrame& frame, const WellPath& path, PathSample a, PathSample b, double plane) {
  const bool rises = b.reference.z() > a.reference.z();
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (a.measured_depth + b.measured_depth);
    const auto location = frame.grid.locate(path.point(middle), a.location.source);
    if (!location) break;
    PathSample m{middle, frame.space.map(*location), *location};
    ((m.reference.z() < plane) == rises ? a : b) = m;
  }
  const double width = b.reference.z() - a.reference.z();
  const double t = width != 0.0 ? std::clamp((plane - a.reference.z()) / width, 0.0, 1.0) : 0.5;
  const Vec3 at = a.reference + t * (b.reference - a.reference);
  return {at.x(), at.y(), a.measured_depth + t * (b.measured_depth - a.measured_depth), true};
}

std::vector<Crossing> horizon_crossings(const HostFrame& frame, const Well& well, const std::vector<PathSample>& path) {
  const std::int64_t nz = frame.grid.dimensions()[2];
  std::vector<Crossing> crossings(static_cast<std::size_t>(nz) + 1);
  const WellPath curve(well.trajectory);
  const double touch = 1e-9 * std::abs(frame.space.plane(2, nz) - frame.space.plane(2, 0));
  for (std::int64_t level = 0; level <= nz; ++level) {
    const double plane = frame.space.plane(2, level);
    auto& crossing = crossings[static_cast<std::size_t>(level)];
    for (std::size_t s = 0; s + 1 < path.size() && !crossing.is_found; ++s) {
      const double za = path[s].reference.z() - plane;
      const double zb = path[s + 1].reference.z() - plane;
      if (std::abs(za) <= touch)
        crossing = {path[s].reference.x(), path[s].reference.y(), path[s].measured_depth, true};
      else if (za * zb < 0.0)
        crossing = refine_crossing(frame, curve, path[s], path[s + 1], plane);
    }
    const PathSample& last = path.back();
    if (!crossing.is_found && std::abs(last.reference.z() - plane) <= touch)
      crossing = {last.reference.x(), last.reference.y(), last.measured_depth, true};
  }
  return crossings;
}

/// Horizons that the path does not reach take the place of the nearest one that it does (or of the path's end), and go
/// on in measured depth by the distance in E_ref.
void extend_crossings(const HostFrame& frame, const std::vector<PathSample>& path, std::vector<Crossing>& crossings) {
  const PathSample& high = path.front().reference.z() < path.back().reference.z() ? path.front() : path.back();
  const PathSample& low = path.front().reference.z() < path.back().reference.z() ? path.back() : path.front();
  const double direction = path.back().reference.z() >= path.front().reference.z() ? 1.0 : -1.0;
  for (std::size_t level = 0; level < crossings.size(); ++level) {
    if (crossings[level].is_found) continue;
    const double plane = frame.space.plane(2, static_cast<std::int64_t>(level));
    const PathSample& from = plane <= high.reference.z() ? high : low;
    crossings[level] = {from.reference.x(), from.reference.y(),
                        from.measured_depth + direction * (plane - from.reference.z()), false};
  }
}

/// The points of all circles on one horizon; false where a point has none.
bool add_horizon_rings(const HostFrame& frame, std::int64_t level, const Crossing& crossing,
                       const std::vector<double>& radii, int sectors, RadialMesh& mesh,
                       std::vector<Vec3>& outer_reference) {
  const auto [i, u] = frame.space.place(0, crossing.x);
  const auto [j, v] = frame.space.place(1, crossing.y);
  const Horizon horizon(frame.grid, level);
  const auto c = horizon.patch({i, j});
  const Vec3 center = (1 - u) * (1 - v) * c[0] + u * (1 - v) * c[1] + (1 - u) * v * c[2] + u * v * c[3];
  mesh.axis.push_back(center);
  mesh.measured_depth.push_back(crossing.measured_depth);
  std::array<std::int64_t, 2> column{i, j};
  for (const double r : radii)
    for (int s = 0; s < sectors; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / sectors;
      const auto at = horizon.at(center.x() + r * std::cos(angle), center.y() + r * std::sin(angle), column);
      if (!at) return false;
      column = at->column;
      mesh.points.push_back(at->point);
      if (r == radii.back())
        outer_reference.push_back(frame.space.node(column[0], column[1], level) +
                                  Vec3(at->u * (frame.space.plane(0, column[0] + 1) - frame.space.plane(0, column[0])),
                                       at->v * (frame.space.plane(1, column[1] + 1) - frame.space.plane(1, column[1])),
                                       0.0));
    }
  return true;
}

/// Empty, or the first layer that has no thickness at the rings (0-based).
std::optional<int> layer_without_thickness(const RadialMesh& mesh) {
  for (int k = 0; k < mesh.segments; ++k)
    for (int c = 0; c <= mesh.rings; ++c)
      for (int s = 0; s < mesh.sectors; ++s)
        if (!(mesh.point(k + 1, c, s).z() - mesh.point(k, c, s).z() >= 0.5 * least_cell_thickness)) return k;
  return std::nullopt;
}

/// The circle in plan that fits the mapped points of all horizons best, and its start angle.
struct PlanCircle {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
  double start_angle = 0.0;
};

PlanCircle fit_plan_circle(const std::vector<Vec3>& points, int sectors) {
  PlanCircle circle;
  for (const Vec3& p : points) circle.center += p / static_cast<double>(points.size());
  std::complex<double> turn = 0.0;
  // The radius about each horizon's own centre: drift must not widen the prism.
  for (std::size_t ring = 0; ring < points.size(); ring += static_cast<std::size_t>(sectors)) {
    Vec3 center = Vec3::Zero();
    for (int s = 0; s < sectors; ++s)
      center += points[ring + static_cast<std::size_t>(s)] / static_cast<double>(sectors);
    for (int s = 0; s < sectors; ++s) {
      const Vec3 d = points[ring + static_cast<std::size_t>(s)] - center;
      circle.radius += std::hypot(d.x(), d.y()) / static_cast<double>(points.size());
      turn += std::complex<double>(d.x(), d.y()) * std::polar(1.0, -2.0 * std::numbers::pi * s / sectors);
    }
  }
  circle.start_angle = std::arg(turn);
  return circle;
}

RadialMesh reference_prism(const HostFrame& frame, const PlanCircle& circle, const RadialMesh& real,
                           const std::vector<double>& radii) {
  std::vector<RingFrame> frames;
  for (int k = 0; k < real.stations(); ++k) {
    const Vec3 center(circle.center.x(), circle.center.y(), frame.space.plane(2, k));
    frames.push_back({center, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()});
  }
  std::vector<double> scaled = radii;
  for (double& r : scaled) r *= circle.radius / radii.back();
  return sweep_rings(frames, scaled, real.sectors, circle.start_angle);
}

// ---- swept
// ------------------------------------------------------------------------------------------------------------

/// True where a disc of radius r normal to the path keeps the gap to all outer planes.
bool is_clear_of_outside(const HostFrame& frame, const Vec3& at, const Vec3& along, double r, double gap) {
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = r * std::sqrt(std::max(0.0, 1.0 - along[axis] * along[axis])) + gap;
    const double p0 = frame.space.plane(axis, 0);
    const double p1 = frame.space.plane(axis, frame.grid.dimensions()[static_cast<std::size_t>(axis)]);
    if (at[axis] - std::min(p0, p1) < extent || std::max(p0, p1) - at[axis] < extent) return false;
  }
  return true;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(d.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * d).norm();
}

bool is_clear_of_tubes(const Vec3& point, double radius, const std::vector<Neighbour>& neighbours, double gap) {
  return std::none_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& n) {
    const double least = radius + n.radius + gap * std::min(radius, n.radius);
    const auto& axis = n.mesh->axis;
    for (std::size_t k = 0; k + 1 < axis.size(); ++k)
      if (distance_to_segment(point, axis[k], axis[k + 1]) < least) return true;
    return false;
  });
}

/// The measured depths that the tube should cover: the open part and one drainage radius beyond it.
MeasuredDepthRange wanted_range(const Well& well, const std::vector<PathSample>& path) {
  MeasuredDepthRange range{path.front().measured_depth, path.back().measured_depth};
  if (well.open.empty()) return range;
  double from = well.open.front().from;
  double to = well.open.front().to;
  for (const auto& o : well.open) {
    from = std::min(from, o.from);
    to = std::max(to, o.to);
  }
  const double margin = well.radial.drainage_radius;
  return {std::max(range.from, from - margin), std::min(range.to, to + margin)};
}

/// Frames of a reflection sweep; stations are smoothed until the rings stand normal to the path within tilt_limit.
struct Sweep {
  std::vector<Vec3> stations;
  std::vector<RingFrame> frames;
  double tilt = 0.0;
  double largest_move = 0.0;
};

Sweep smooth_sweep(const std::vector<Vec3>& stations) {
  Sweep sweep;
  double weight = 0.0;
  for (int trial = 0; trial < 12; ++trial) {
    sweep.stations = weight > 0.0 ? smoothed_stations(stations, weight) : stations;
    const auto tangents = polyline_tangents(sweep.stations);
    sweep.frames = sweep_frames(sweep.stations, tangents);
    sweep.tilt = largest_tilt(sweep.frames, tangents);
    if (sweep.tilt <= tilt_limit) break;
    weight = weight > 0.0 ? 2.0 * weight : 0.125;
  }
  for (std::size_t k = 0; k < stations.size(); ++k)
    sweep.largest_move = std::max(sweep.largest_move, (sweep.stations[k] - stations[k]).norm());
  return sweep;
}

/// phi_0 of the outermost circles and of the stations.
struct MappedRings {
  std::vector<Vec3> stations;
  std::vector<Vec3> outer;  ///< station * sectors + sector
};

/// The rings, or the first station with a point outside of the grid.
std::variant<MappedRings, int> map_rings(const HostFrame& frame, const RadialMesh& mesh) {
  MappedRings out;
  HostCellId hint;
  for (int k = 0; k < mesh.stations(); ++k) {
    const auto center = frame.map(mesh.axis[static_cast<std::size_t>(k)], hint);
    if (!center) return k;
    out.stations.push_back(*center);
    for (int s = 0; s < mesh.sectors; ++s) {
      const auto p = frame.map(mesh.point(k, mesh.rings, s), hint);
      if (!p) return k;
      out.outer.push_back(*p);
    }
  }
  return out;
}

/// Start angle that brings the circles closest to the mapped points, and their mean radius.
std::pair<double, double> fit_rings(const std::vector<RingFrame>& frames, const MappedRings& mapped, int sectors) {
  std::complex<double> turn = 0.0;
  double radius = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (int s = 0; s < sectors; ++s) {
      const Vec3& p = mapped.outer[k * static_cast<std::size_t>(sectors) + static_cast<std::size_t>(s)];
      const Vec3 d = p - frames[k].center;
      turn += std::complex<double>(d.dot(frames[k].e1), d.dot(frames[k].e2)) *
              std::polar(1.0, -2.0 * std::numbers::pi * s / sectors);
      radius += (p - mapped.stations[k]).norm();
    }
  return {std::arg(turn), radius / static_cast<double>(mapped.outer.size())};
}

std::vector<Vec3> even_stations(const Well& well, double from, double to, int segments) {
  const WellPath curve(well.trajectory);
  std::vector<Vec3> stations;
  for (int k = 0; k <= segments; ++k) stations.push_back(curve.point(from + (to - from) * k / segments));
  return stations;
}

/// Most rings whose trapezoids have their circumcentres inside: the ratio of radii must be above 1 / cos(2 pi / N)
/// (method.md §3). 0: none.
int most_rings(const RadialOptions& options) {
  const double cosine = std::cos(2.0 * std::numbers::pi / options.sectors);
  if (cosine < 0.4) return 0;
  for (int rings = options.rings; rings > 0; --rings) {
    RadialOptions trial = options;
    trial.rings = rings;
    const auto radii = circle_radii(trial);
    bool fits = true;
    for (std::size_t i = 0; i + 1 < radii.size(); ++i) fits = fits && radii[i + 1] / radii[i] * cosine > 1.001;
    if (fits) return rings;
  }
  return 0;
}

}  // namespace

std::vector<PathSample> path_in_reference(const HostFrame& frame, const Well& well) {
  const WellPath curve(well.trajectory);
  std::vector<PathSample> samples;
  HostCellId hint;
  const double from = curve.first_depth();
  const double to = curve.last_depth();
  for (int s = 0; s <= path_sample_count; ++s) {
    const double md = from + (to - from) * s / path_sample_count;
    const auto location = frame.grid.locate(curve.point(md), hint);
    if (!location) continue;
    hint = location->source;
    samples.push_back({md, frame.space.map(*location), *location});
  }
  return samples;
}

MeshMode choose_mode(const std::vector<PathSample>& path, double drainage_radius) {
  const Vec3 chord = path.back().reference - path.front().reference;
  const double lateral = std::hypot(chord.x(), chord.y());
  if (std::atan2(lateral, std::abs(chord.z())) > mode_angle) return MeshMode::swept;
  Vec3 mean = Vec3::Zero();
  for (const auto& s : path) mean += s.reference / static_cast<double>(path.size());
  double drift = 0.0;
  for (const auto& s : path)
    drift = std::max(drift, std::hypot(s.reference.x() - mean.x(), s.reference.y() - mean.y()));
  return drift < drainage_radius ? MeshMode::layered : MeshMode::swept;
}

std::vector<MeasuredDepthRange> clear_stretches(const HostFrame& frame, const Well& well,
                                                const std::vector<PathSample>& path, const Obstacles& obstacles,
                                                const std::vector<Neighbour>& neighbours, const Gaps& gaps) {
  std::vector<MeasuredDepthRange> out;
  if (path.size() < 2) return out;
  const double radius = well.radial.drainage_radius;
  const MeasuredDepthRange wanted = wanted_range(well, path);
  const WellPath curve(well.trajectory);
  const auto is_good = [&](std::size_t s) {
    const double md = path[s].measured_depth;
    if (md < wanted.from || md > wanted.to) return false;
    const std::size_t a = s == 0 ? 0 : s - 1;
    const std::size_t b = s + 1 == path.size() ? s : s + 1;
    const Vec3 along = (path[b].reference - path[a].reference).normalized();
    return is_clear_of_outside(frame, path[s].reference, along, radius, gaps.outside * radius) &&
           obstacles.is_clear(path[s].reference, along, radius, gaps.obstacle * radius) &&
           is_clear_of_tubes(curve.point(md), radius, neighbours, gaps.tube);
  };
  const double step = path[1].measured_depth - path[0].measured_depth;
  for (std::size_t s = 0; s < path.size(); ++s) {
    if (!is_good(s)) continue;
    std::size_t e = s;
    // A jump in measured depth is a part of the path outside of the grid.
    while (e + 1 < path.size() && path[e + 1].measured_depth - path[e].measured_depth < 1.5 * step && is_good(e + 1))
      ++e;
    if (path[e].measured_depth - path[s].measured_depth >= radius)
      out.push_back({path[s].measured_depth, path[e].measured_depth});
    s = e;
  }
  return out;
}

TubeOrReason build_layered_tube(const HostFrame& frame, const Well& well, const std::vector<PathSample>& path,
                                const Obstacles& obstacles) {
  const auto radii = circle_radii(well.radial);
  auto crossings = horizon_crossings(frame, well, path);
  extend_crossings(frame, path, crossings);
  for (const Crossing& c : crossings)
    if (!obstacles.is_clear_in_plan(c.x, c.y, (1.0 + layered_gap) * radii.back()))
      return NoTube{fmt::format("a fault or a place without thickness lies within {:.3g} m of it",
                                (1.0 + layered_gap) * radii.back())};
  Tube tube;
  tube.space = well.trajectory.moved.map;
  tube.layered = true;
  tube.real.segments = static_cast<int>(frame.grid.dimensions()[2]);
  tube.real.sectors = well.radial.sectors;
  tube.real.rings = well.radial.rings;
  std::vector<Vec3> outer;
  for (std::size_t level = 0; level < crossings.size(); ++level)
    if (!add_horizon_rings(frame, static_cast<std::int64_t>(level), crossings[level], radii, well.radial.sectors,
                           tube.real, outer))
      return NoTube{fmt::format("its tube of radius {:g} m leaves the grid, or meets a fault, at the top of layer {}",
                                radii.back(), level + 1)};
  if (const auto layer = layer_without_thickness(tube.real))
    return NoTube{fmt::format("layer {} pinches out within {:g} m of it", *layer + 1, radii.back())};
  const PlanCircle circle = fit_plan_circle(outer, tube.real.sectors);
  tube.reference_radius = circle.radius;
  tube.reference = reference_prism(frame, circle, tube.real, radii);
  return tube;
}

TubeOrReason build_swept_tube(const HostFrame& frame, const Well& well, const MeasuredDepthRange& stretch) {
  const int most = most_rings(well.radial);
  if (most == 0) return NoTube{fmt::format("a swept tube needs 6 or more sectors, not {}", well.radial.sectors)};
  RadialOptions options = well.radial;
  options.rings = std::min(options.rings, most);
  const auto radii = circle_radii(options);
  const double outer = radii.back();
  const double length = stretch.to - stretch.from;
  const int natural_segments = std::clamp(static_cast<int>(std::lround(length / outer)), 2, most_natural_segments);
  const int segments = options.segments.value_or(natural_segments);
  const Sweep sweep = smooth_sweep(even_stations(well, stretch.from, stretch.to, segments));
  const WellPath path(well.trajectory);
  Tube tube;
  tube.space = well.trajectory.moved.map;
  tube.real = sweep_rings(sweep.frames, radii, options.sectors, 0.0);
  for (int k = 0; k <= segments; ++k) tube.real.measured_depth.push_back(stretch.from + length * k / segments);
  int tight = 0;
  if (sweep.tilt > 3.0 * tilt_limit || smallest_lateral_ratio(tube.real, &tight) < least_lateral_ratio)
    return NoTube{fmt::format("it bends too sharply for a drainage radius of {:g} m at measured depth {:.1f} m", outer,
                              path.original(tube.real.measured_depth[static_cast<std::size_t>(tight)])),
                  tube.real.measured_depth[static_cast<std::size_t>(tight)]};
  if (options.rings < well.radial.rings)
    tube.notes.push_back(fmt::format(
        "{} rings instead of {}: thinner ones in {} sectors could not hold their centres at the tube's ends",
        options.rings, well.radial.rings, options.sectors));
  if (sweep.largest_move > 1e-3 * outer)
    tube.notes.push_back(
        fmt::format("the path was smoothed by up to {:.2g} m for the rings to stand normal to it", sweep.largest_move));
  const auto rings = map_rings(frame, tube.real);
  if (const int* outside = std::get_if<int>(&rings))
    return NoTube{fmt::format("its tube of radius {:g} m leaves the grid", outer),
                  tube.real.measured_depth[static_cast<std::size_t>(*outside)]};
  const auto* mapped = &std::get<MappedRings>(rings);
  const Sweep ideal = smooth_sweep(mapped->stations);
  const auto [angle, radius] = fit_rings(ideal.frames, *mapped, tube.real.sectors);
  std::vector<double> scaled = radii;
  for (double& r : scaled) r *= radius / outer;
  tube.reference_radius = radius;
  tube.reference = sweep_rings(ideal.frames, scaled, tube.real.sectors, angle);
  if (ideal.tilt > 3.0 * tilt_limit || smallest_lateral_ratio(tube.reference, &tight) < least_reference_ratio)
    return NoTube{
        fmt::format("the grid bends too sharply around it at measured depth {:.1f} m for a drainage radius of {:g} m",
                    path.original(tube.real.measured_depth[static_cast<std::size_t>(tight)]), outer),
        tube.real.measured_depth[static_cast<std::size_t>(tight)]};
  return tube;
}

}  // namespace wellknit
