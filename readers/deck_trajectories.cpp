// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_trajectories.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/units.h"
#include "readers/measured_depth_ranges.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// Items of the two keywords, from 0.
namespace weltraj {
constexpr std::size_t x = 2, y = 3, depth = 4, measured_depth = 5;
}
namespace comptraj {
constexpr std::size_t from = 2, to = 3, reference = 4, state = 6, factor = 8, diameter = 9, kh = 10, skin = 11;
}

/// Twice the Earth's circumference: no coordinate.
constexpr double farthest = 1e8;  // m

double length(const DeckStream& stream, const DeckRecord& record, std::size_t item, const char* what) {
  const auto value = stream.real(record, item);
  if (!value || std::abs(*value) > farthest) {
    stream.fail(record.line, {fmt::format("{} as item {}", what, item + 1),
                              value ? fmt::format("{}", *value) : "a default", "every number of it is needed"});
  }
  return *value;
}

std::optional<double> positive(std::optional<double> value) { return value && *value > 0.0 ? value : std::nullopt; }

/// The first measured depth at or after `after` where the path is at this depth.
std::optional<double> measured_depth_at(const Trajectory& path, double depth, double after) {
  for (std::size_t n = 1; n < path.points.size(); ++n) {
    if (path.measured_depth[n] < after) continue;
    const double from = path.points[n - 1].z();
    const double to = path.points[n].z();
    if (std::min(from, to) > depth || std::max(from, to) < depth) continue;
    const double fraction = from == to ? 0.0 : (depth - from) / (to - from);
    const double md = path.measured_depth[n - 1] + fraction * (path.measured_depth[n] - path.measured_depth[n - 1]);
    if (md >= after) return md;
  }
  return std::nullopt;
}

/// Where a line from a to b is inside a box, as fractions of it.
MeasuredDepthRange inside(const Eigen::AlignedBox3d& box, const Vec3& a, const Vec3& b) {
  MeasuredDepthRange part{0.0, 1.0};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double step = b[axis] - a[axis];
    const double least = box.min()[axis] - a[axis];
    const double most = box.max()[axis] - a[axis];
    if (step == 0.0) {
      if (least > 0.0 || most < 0.0) return {1.0, 0.0};
      continue;
    }
    part.from = std::max(part.from, std::min(least / step, most / step));
    part.to = std::min(part.to, std::max(least / step, most / step));
  }
  return part;
}

/// Opens the well where its path crosses the boxes around its open completions' cells.
void open_by_cells(DeckStream& stream, Well& well, const CornerPointGrid& grid) {
  const Trajectory& path = well.trajectory;
  for (const DeckCompletion& completion : well.completions) {
    if (!completion.open) continue;
    stream.charge_steps(static_cast<std::int64_t>(path.points.size() * (1 + well.open.size())));
    Eigen::AlignedBox3d box;
    for (const Vec3& corner : grid.corners(completion.cell)) box.extend(corner);
    for (std::size_t n = 1; n < path.points.size(); ++n) {
      const auto part = inside(box, path.points[n - 1], path.points[n]);
      const double from = path.measured_depth[n - 1];
      const double step = path.measured_depth[n] - from;
      well.open = with(well.open, {from + part.from * step, from + part.to * step});
    }
  }
}

class BranchWell {
 public:
  BranchWell(DeckStream& stream, Well well, const DeckBranch& branch, double metre)
      : stream_(stream), well_(std::move(well)), branch_(branch), metre_(metre) {}

  std::optional<Well> make(const CornerPointGrid& grid);

 private:
  void note(const std::string& text) {
    stream_.notes.push_back(fmt::format("{}: well {}: {}", stream_.main_file(), well_.name, text));
  }
  void set_path();
  std::optional<MeasuredDepthRange> range_of(const DeckBranch::PerforationRecord& record);
  void set_perforations();
  void set_bore();

  DeckStream& stream_;
  Well well_;
  const DeckBranch& branch_;
  double metre_;
};

void BranchWell::set_path() {
  static constexpr double same_point = 1e-6;  // m, far below any survey
  std::size_t repeated = 0;
  for (const DeckBranch::Station& station : branch_.stations) {
    const Vec3 point = metre_ * station.point;
    Trajectory& path = well_.trajectory;
    const double md = metre_ * station.measured_depth;
    if (!path.points.empty() &&
        ((point - path.points.back()).norm() <= same_point || md <= path.measured_depth.back())) {
      ++repeated;
      continue;
    }
    path.points.push_back(point);
    path.measured_depth.push_back(md);
  }
  if (repeated > 0) note(fmt::format("{} repeated stations of WELTRAJ dropped", repeated));
}

/// In metres of measured depth, cut to the path; nothing, with a note, when it is outside.
std::optional<MeasuredDepthRange> BranchWell::range_of(const DeckBranch::PerforationRecord& record) {
  const Trajectory& path = well_.trajectory;
  MeasuredDepthRange range{metre_ * record.perforation.range.from, metre_ * record.perforation.range.to};
  const auto outside = [&](const char* kind) {
    note(fmt::format("its perforation in line {} ({} to {} m {}) is not on its path and is left out", record.line,
                     range.from, range.to, kind));
    return std::nullopt;
  };
  if (record.is_by_depth) {
    const auto from = measured_depth_at(path, range.from, path.measured_depth.front());
    const auto to = from ? measured_depth_at(path, range.to, *from) : std::nullopt;
    if (!to || *to <= *from) return outside("TVD");
    return MeasuredDepthRange{*from, *to};
  }
  const MeasuredDepthRange cut{std::max(range.from, path.measured_depth.front()),
                               std::min(range.to, path.measured_depth.back())};
  if (cut.to <= cut.from) return outside("MD");
  if (cut.from > range.from || cut.to < range.to)
    note(fmt::format("its perforation in line {} reaches beyond its path and is cut", record.line));
  return cut;
}

void BranchWell::set_perforations() {
  bool has_factor = false;
  for (const DeckBranch::PerforationRecord& record : branch_.perforations) {
    stream_.charge_steps(static_cast<std::int64_t>(well_.trajectory.points.size() + well_.open.size()));
    const auto range = range_of(record);
    if (!range) continue;
    Perforation perforation = record.perforation;
    perforation.range = *range;
    perforation.diameter *= metre_;
    has_factor = has_factor || perforation.connection_factor || perforation.permeability_thickness;
    well_.open = perforation.open ? with(well_.open, *range) : without(well_.open, *range);
    well_.perforations.push_back(perforation);
  }
  if (has_factor) note("connection factors and Kh of COMPTRAJ are kept but not used: they follow from the mesh");
}

/// Bore radius and skin, where the perforations state them.
void BranchWell::set_bore() {
  const auto& all = well_.perforations;
  const auto given = std::find_if(all.begin(), all.end(), [](const auto& p) { return p.diameter > 0.0; });
  if (given != all.end()) well_.radial.bore_radius = given->diameter / 2.0;
  if (all.empty()) return;
  const double skin = all.front().skin;
  if (std::all_of(all.begin(), all.end(), [&](const auto& p) { return p.skin == skin; }))
    well_.skin = skin;
  else
    note("the skin of COMPTRAJ differs between perforations and is not used");
}

std::optional<Well> BranchWell::make(const CornerPointGrid& grid) {
  set_path();
  if (well_.trajectory.points.size() < 2) {
    note("is left out: WELTRAJ gives fewer than two different stations");
    return std::nullopt;
  }
  if (!branch_.perforations.empty()) {
    well_.completions.clear();
    set_perforations();
    set_bore();
    if (well_.open.empty()) note("COMPTRAJ opens nothing of it");
  } else if (!well_.completions.empty()) {
    open_by_cells(stream_, well_, grid);
    note("no COMPTRAJ: it is open where its path crosses the boxes of its COMPDAT cells");
  } else {
    note("neither COMPTRAJ nor COMPDAT: it is taken as open over its whole length");
    well_.open = {{well_.trajectory.measured_depth.front(), well_.trajectory.measured_depth.back()}};
  }
  // An empty list would mean open everywhere.
  const double start = well_.trajectory.measured_depth.front();
  if (well_.open.empty()) well_.open = {{start, start}};
  return std::move(well_);
}

}  // namespace

std::int64_t branch_number(const DeckStream& stream, const DeckRecord& record) {
  static constexpr std::int64_t most = 10'000;
  const std::int64_t branch = stream.integer(record, 1).value_or(1);
  if (branch < 1 || branch > most)
    stream.fail(record.line, {fmt::format("a branch between 1 and {} as item 2", most), fmt::format("{}", branch), ""});
  return branch;
}

void add_station(DeckStream& stream, const DeckRecord& record, std::int64_t keyword, DeckBranches& branches) {
  DeckBranch::Station station;
  station.point = {length(stream, record, weltraj::x, "X"), length(stream, record, weltraj::y, "Y"),
                   length(stream, record, weltraj::depth, "TVD")};
  station.measured_depth = length(stream, record, weltraj::measured_depth, "MD");
  stream.charge_values(10);
  const std::int64_t number = branch_number(stream, record);
  DeckBranch& branch = branches[number];
  const bool rises = branch.stations.empty() || station.measured_depth > branch.stations.back().measured_depth;
  if (!rises && branch.keyword == keyword && station.measured_depth < branch.stations.back().measured_depth) {
    stream.fail(record.line, {fmt::format("a measured depth above {} as item 6", branch.stations.back().measured_depth),
                              fmt::format("{}", station.measured_depth), "give the stations from the head on"});
  }
  if (!rises && branch.keyword != keyword) {
    stream.note(record.line, fmt::format("a later WELTRAJ begins at a measured depth of {} and replaces the path of "
                                         "branch {} of {}",
                                         station.measured_depth, number, quoted_for_message(record.items[0].text)));
    branch.stations.clear();
  }
  branch.keyword = keyword;
  branch.stations.push_back(station);
}

void add_perforation(DeckStream& stream, const DeckRecord& record, DeckBranches& branches) {
  DeckBranch::PerforationRecord out;
  out.line = record.line;
  Perforation& perforation = out.perforation;
  perforation.range = {length(stream, record, comptraj::from, "the top of the perforation"),
                       length(stream, record, comptraj::to, "the bottom of the perforation")};
  if (perforation.range.to <= perforation.range.from) {
    stream.fail(record.line, {"a bottom of the perforation below its top, items 3 and 4",
                              fmt::format("{} to {}", perforation.range.from, perforation.range.to), "swap them"});
  }
  const std::string reference = stream.word(record, comptraj::reference).value_or("MD");
  if (reference != "MD" && reference != "TVD")
    stream.fail(record.line, {"MD or TVD as item 5", quoted_for_message(reference), ""});
  out.is_by_depth = reference == "TVD";
  const std::string state = stream.word(record, comptraj::state).value_or("OPEN");
  if (state != "OPEN" && state != "SHUT" && state != "AUTO")
    stream.fail(record.line, {"OPEN, SHUT or AUTO as item 7", quoted_for_message(state), ""});
  perforation.open = state != "SHUT";
  perforation.diameter = stream.real(record, comptraj::diameter).value_or(0.0);
  if (perforation.diameter < 0.0)
    stream.fail(record.line, {"a bore diameter of 0 or more as item 10", fmt::format("{}", perforation.diameter), ""});
  perforation.skin = stream.real(record, comptraj::skin).value_or(0.0);
  perforation.connection_factor = positive(stream.real(record, comptraj::factor));
  perforation.permeability_thickness = positive(stream.real(record, comptraj::kh));
  stream.charge_values(15);
  branches[branch_number(stream, record)].perforations.push_back(out);
}

std::vector<Well> wells_with_trajectories(DeckStream& stream, const Well& well, const DeckBranches& branches,
                                          const CornerPointGrid& grid) {
  std::vector<Well> out;
  const double metre = metre_per_length_unit(grid.units);
  for (const auto& [number, branch] : branches) {
    Well base = well;
    base.branch = static_cast<int>(number);
    if (number != 1) {
      base.name = fmt::format("{}:{}", well.name, number);
      base.parent = well.name;
      base.completions.clear();
    }
    if (branch.stations.empty()) {
      stream.notes.push_back(fmt::format("{}: well {}: is left out: COMPTRAJ perforates it, but WELTRAJ gives no path",
                                         stream.main_file(), base.name));
      continue;
    }
    if (auto made = BranchWell(stream, std::move(base), branch, metre).make(grid)) {
      for (Perforation& perforation : made->perforations) {
        if (perforation.connection_factor) *perforation.connection_factor *= m3_per_transmissibility_unit(grid.units);
        if (perforation.permeability_thickness) *perforation.permeability_thickness *= m2_per_millidarcy * metre;
      }
      out.push_back(*std::move(made));
    }
  }
  return out;
}

}  // namespace wellknit
