// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "model/units.h"
#include "readers/deck_well_path.h"
#include "readers/measured_depth_ranges.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// Items from 0.
namespace top {
constexpr std::size_t depth = 1, measured_depth = 2, info = 4, x = 7, y = 8;
}
namespace segment {
constexpr std::size_t first = 0, last = 1, branch = 2, outlet = 3, measured_depth = 4, depth = 5, x = 10, y = 11;
}
namespace compsegs {
constexpr std::size_t i = 0, branch = 3, from = 4, to = 5, direction = 6, end = 7;
}

constexpr std::int64_t most_segments = 100'000;
constexpr double farthest = 1e8;  // m: no coordinate

double number(const DeckStream& stream, const DeckRecord& record, std::size_t item, double fallback) {
  const double value = stream.real(record, item).value_or(fallback);
  if (std::abs(value) > farthest)
    stream.fail(record.line, {fmt::format("a length as item {}", item + 1), fmt::format("{}", value), ""});
  return value;
}

std::int64_t needed_integer(const DeckStream& stream, const DeckRecord& record, std::size_t item, const char* what) {
  const auto value = stream.integer(record, item);
  if (!value || *value < 1 || *value > most_segments) {
    stream.fail(record.line, {fmt::format("{} as item {}, 1 to {}", what, item + 1, most_segments),
                              value ? fmt::format("{}", *value) : "a default", ""});
  }
  return *value;
}

/// A record of WELSEGS: one segment or a range of equal ones.
void add_segments(DeckStream& stream, const DeckRecord& record, bool is_increment, DeckSegments& segments) {
  const std::int64_t first = needed_integer(stream, record, segment::first, "a segment");
  const std::int64_t last = needed_integer(stream, record, segment::last, "a segment");
  const std::int64_t branch = needed_integer(stream, record, segment::branch, "a branch");
  const std::int64_t outlet = needed_integer(stream, record, segment::outlet, "the outlet segment");
  if (first < 2 || last < first) {
    stream.fail(record.line, {"segments from 2 on, the first not above the last, as items 1 and 2",
                              fmt::format("{} and {}", first, last), ""});
  }
  const auto from = segments.nodes.find(outlet);
  if (from == segments.nodes.end() || outlet >= first) {
    stream.fail(record.line, {"an outlet segment that was defined before, as item 4", fmt::format("{}", outlet),
                              "order the records from the head on"});
  }
  const auto count = static_cast<double>(last - first + 1);
  stream.charge_steps(last - first + 1);
  stream.charge_values(16 * (last - first + 1));
  const DeckSegment start = from->second;
  // What each segment of the range adds to the one before it.
  const auto step = [&](std::size_t item, double before) {
    const auto value = stream.real(record, item);
    if (!value) return 0.0;
    const double checked = number(stream, record, item, 0.0);
    return is_increment ? checked : (checked - before) / count;
  };
  DeckSegment next = start;
  next.branch = branch;
  next.outlet = outlet;
  next.has_xy = (record.has(segment::x) || record.has(segment::y)) && (start.has_xy || !is_increment);
  const double md = step(segment::measured_depth, start.measured_depth);
  const double depth = step(segment::depth, start.depth);
  const double x = step(segment::x, start.x);
  const double y = step(segment::y, start.y);
  for (std::int64_t n = first; n <= last; ++n) {
    next.measured_depth += md;
    next.depth += depth;
    next.x += x;
    next.y += y;
    segments.nodes[n] = next;
    next.outlet = n;
  }
}

/// The cell that a record of COMPSEGS names, or begins with.
DeckSegmentCell segment_cell(const DeckStream& stream, const DeckRecord& record, const CellIndexReader& cell_index) {
  DeckSegmentCell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto index = cell_index(record, compsegs::i + axis, axis);
    if (!index) stream.fail(record.line, {fmt::format("{} as item {}", "IJK"[axis], axis + 1), "a default", ""});
    cell.cell[axis] = *index;
  }
  cell.branch = needed_integer(stream, record, compsegs::branch, "a branch");
  if (!stream.real(record, compsegs::to)) return cell;
  const MeasuredDepthRange range{number(stream, record, compsegs::from, 0.0),
                                 number(stream, record, compsegs::to, 0.0)};
  if (range.to <= range.from) {
    stream.fail(record.line, {"an end below the start, items 5 and 6", fmt::format("{} to {}", range.from, range.to),
                              "measured depths rise along the bore"});
  }
  cell.range = range;
  return cell;
}

std::size_t axis_of_range(const DeckStream& stream, const DeckRecord& record, const std::string& direction) {
  static constexpr std::string_view by_axis = "XYZ";
  static constexpr std::string_view by_index = "IJK";
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (direction == by_axis.substr(axis, 1) || direction == by_index.substr(axis, 1)) return axis;
  stream.fail(record.line, {"X, Y, Z, I, J or K as item 7", quoted_for_message(direction), ""});
}

/// A record may name a range of cells: from the last one along a direction. Their measured depths are not given. False
/// when it does not.
bool add_rest_of_range(DeckStream& stream, const DeckRecord& record, const CellIndexReader& cell_index,
                       std::vector<DeckSegmentCell>& cells) {
  const auto direction = stream.word(record, compsegs::direction);
  if (!direction || direction->empty() || !record.has(compsegs::end)) return false;
  const std::size_t axis = axis_of_range(stream, record, *direction);
  const auto end = cell_index(record, compsegs::end, axis);
  if (!end) return false;
  DeckSegmentCell cell = cells.back();
  cell.range.reset();
  const std::int64_t step = *end < cell.cell[axis] ? -1 : 1;
  stream.charge_values(8 * std::abs(*end - cell.cell[axis]));
  while (cell.cell[axis] != *end) {
    cell.cell[axis] += step;
    cells.push_back(cell);
  }
  return true;
}

using CellPlaces = std::unordered_map<std::int64_t, std::size_t>;

/// A completion of a branch with its place along the bore, m.
struct BranchCell {
  DeckCompletion completion;
  std::optional<MeasuredDepthRange> range;
};

class SegmentedWell {
 public:
  SegmentedWell(DeckStream& stream, const Well& well, const DeckSegments& segments, const CornerPointGrid& grid)
      : stream_(stream), well_(well), segments_(segments), grid_(grid), metre_(metre_per_length_unit(grid.units)) {}

  std::vector<Well> make();

 private:
  void note(const std::string& text) {
    stream_.notes.push_back(fmt::format("{}: well {}: {}", stream_.main_file(), well_.name, text));
  }
  std::map<std::int64_t, std::vector<BranchCell>> cells_by_branch();
  std::optional<Well> branch_well(std::int64_t branch, std::vector<BranchCell> cells);
  std::optional<Trajectory> path_through_nodes(std::int64_t branch);
  void set_path_through_cells_at(Well& well, const std::vector<BranchCell>& cells) const;

  DeckStream& stream_;
  const Well& well_;
  const DeckSegments& segments_;
  const CornerPointGrid& grid_;
  double metre_;
};

std::map<std::int64_t, std::vector<BranchCell>> SegmentedWell::cells_by_branch() {
  CellPlaces place_of;
  for (std::size_t n = 0; n < well_.completions.size(); ++n) place_of.emplace(well_.completions[n].cell.value(), n);
  std::map<std::int64_t, std::vector<BranchCell>> out;
  std::vector<bool> is_taken(well_.completions.size(), false);
  std::size_t unknown = 0;
  for (const DeckSegmentCell& cell : segments_.cells) {
    const auto found = place_of.find(grid_.cell_id(cell.cell[0], cell.cell[1], cell.cell[2]).value());
    if (found == place_of.end()) {
      ++unknown;
      continue;
    }
    is_taken[found->second] = true;
    BranchCell branch_cell{well_.completions[found->second], std::nullopt};
    if (cell.range) branch_cell.range = MeasuredDepthRange{metre_ * cell.range->from, metre_ * cell.range->to};
    out[cell.branch].push_back(std::move(branch_cell));
  }
  if (unknown > 0) note(fmt::format("{} cells of COMPSEGS are not completed by COMPDAT and are left out", unknown));
  const auto left = std::count(is_taken.begin(), is_taken.end(), false);
  if (left > 0) note(fmt::format("{} cells of COMPDAT are in no segment (COMPSEGS) and are left out", left));
  // Devices are modelled as a branch for each cell: then all of them are one bore.
  const bool single = std::all_of(out.begin(), out.end(), [](const auto& entry) { return entry.second.size() == 1; });
  if (out.size() > 2 && single) {
    note("each of its branches has one completed cell: taken as devices along one bore");
    std::vector<BranchCell> all;
    for (auto& [branch, cells] : out) all.push_back(std::move(cells.front()));
    out.clear();
    out[1] = std::move(all);
  }
  return out;
}

/// Through the outlet of the branch's first node and its nodes, where all have x and y.
std::optional<Trajectory> SegmentedWell::path_through_nodes(std::int64_t branch) {
  static constexpr double same_point = 1e-6;  // m
  stream_.charge_steps(static_cast<std::int64_t>(segments_.nodes.size()));
  std::vector<const DeckSegment*> nodes;
  for (const auto& [number, node] : segments_.nodes)
    if (node.branch == branch) nodes.push_back(&node);
  if (nodes.empty()) return std::nullopt;
  const auto by_depth = [](const auto* a, const auto* b) { return a->measured_depth < b->measured_depth; };
  std::stable_sort(nodes.begin(), nodes.end(), by_depth);
  if (const auto outlet = segments_.nodes.find(nodes.front()->outlet); outlet != segments_.nodes.end())
    nodes.insert(nodes.begin(), &outlet->second);
  Trajectory path;
  for (const DeckSegment* node : nodes) {
    if (!node->has_xy) return std::nullopt;
    const Vec3 point = metre_ * Vec3(node->x, node->y, node->depth);
    const double md = metre_ * node->measured_depth;
    const bool goes_on =
        path.points.empty() || ((point - path.points.back()).norm() > same_point && md > path.measured_depth.back());
    if (!goes_on) continue;
    path.points.push_back(point);
    path.measured_depth.push_back(md);
  }
  if (path.points.size() < 2) return std::nullopt;
  return path;
}

/// Through the cells' centres at the middle of their measured depths, from the face where it enters the first.
void SegmentedWell::set_path_through_cells_at(Well& well, const std::vector<BranchCell>& cells) const {
  static constexpr double same_point = 1e-6;  // m
  const auto center = [&](const BranchCell& cell) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : grid_.corners(cell.completion.cell)) sum += corner;
    return Vec3(sum / 8.0);
  };
  // The two ends from the path by cells; it may run the other way.
  Vec3 first = well.trajectory.points.front();
  Vec3 last = well.trajectory.points.back();
  const Vec3 start = center(cells.front());
  if (cells.size() > 1 && (first - start).norm() > (last - start).norm()) std::swap(first, last);
  Trajectory path;
  const auto add = [&](const Vec3& point, double md) {
    const bool goes_on =
        path.points.empty() || ((point - path.points.back()).norm() > same_point && md > path.measured_depth.back());
    if (!goes_on) return;
    path.points.push_back(point);
    path.measured_depth.push_back(md);
  };
  add(first, cells.front().range->from);
  for (const BranchCell& cell : cells) add(center(cell), 0.5 * (cell.range->from + cell.range->to));
  add(last, cells.back().range->to);
  if (path.points.size() >= 2) well.trajectory = std::move(path);
}

std::optional<Well> SegmentedWell::branch_well(std::int64_t branch, std::vector<BranchCell> cells) {
  Well out = well_;
  out.branch = static_cast<int>(branch);
  if (branch != 1) {
    out.name = fmt::format("{}:{}", well_.name, branch);
    out.parent = well_.name;
  }
  const bool has_ranges = std::all_of(cells.begin(), cells.end(), [](const auto& c) { return c.range.has_value(); });
  if (has_ranges)
    std::stable_sort(cells.begin(), cells.end(),
                     [](const auto& a, const auto& b) { return a.range->from < b.range->from; });
  out.completions.clear();
  for (const BranchCell& cell : cells) out.completions.push_back(cell.completion);
  const bool has_length = set_path_through_cells(grid_, out);
  const auto nodes = has_ranges ? path_through_nodes(branch) : std::nullopt;
  if (nodes) {
    out.trajectory = *nodes;
    out.approximate_path = false;
  } else if (!has_length) {
    note(fmt::format("branch {} has no length and is left out", branch));
    return std::nullopt;
  } else if (has_ranges) {
    set_path_through_cells_at(out, cells);
  } else {
    note(fmt::format("branch {}: COMPSEGS does not give all measured depths: arc length is taken", branch));
    return out;
  }
  out.open.clear();
  const auto& md = out.trajectory.measured_depth;
  for (const BranchCell& cell : cells) {
    const MeasuredDepthRange cut{std::max(cell.range->from, md.front()), std::min(cell.range->to, md.back())};
    stream_.charge_steps(static_cast<std::int64_t>(out.open.size()));
    if (cell.completion.open) out.open = with(out.open, cut);
  }
  // An empty list would mean open everywhere.
  if (out.open.empty()) out.open = {{md.front(), md.front()}};
  return out;
}

std::vector<Well> SegmentedWell::make() {
  std::vector<Well> out;
  for (auto& [branch, cells] : cells_by_branch())
    if (auto well = branch_well(branch, std::move(cells))) out.push_back(*std::move(well));
  return out;
}

}  // namespace

void read_welsegs(DeckStream& stream, const std::function<DeckSegments&(const DeckRecord&)>& segments_of) {
  const DeckRecord head = stream.next_record(20);
  if (head.empty()) stream.fail(head.line, {"the name of a well", "an empty record", ""});
  DeckSegments& segments = segments_of(head);
  segments.nodes.clear();
  const std::string info = stream.word(head, top::info).value_or("");
  if (info != "INC" && info != "ABS")
    stream.fail(head.line, {"INC or ABS as item 5", info.empty() ? "a default" : quoted_for_message(info), ""});
  DeckSegment& first = segments.nodes[1];
  first.depth = number(stream, head, top::depth, 0.0);
  first.measured_depth = number(stream, head, top::measured_depth, 0.0);
  first.x = number(stream, head, top::x, 0.0);
  first.y = number(stream, head, top::y, 0.0);
  first.has_xy = head.has(top::x) && head.has(top::y);
  while (true) {
    const DeckRecord record = stream.next_record(20);
    if (record.empty()) return;
    add_segments(stream, record, info == "INC", segments);
  }
}

void read_compsegs(DeckStream& stream, const std::function<DeckSegments&(const DeckRecord&)>& segments_of,
                   const CellIndexReader& cell_index) {
  const DeckRecord head = stream.next_record(1);
  if (head.empty()) stream.fail(head.line, {"the name of a well", "an empty record", ""});
  DeckSegments& segments = segments_of(head);
  segments.cells.clear();
  while (true) {
    const DeckRecord record = stream.next_record(12);
    if (record.empty()) return;
    const std::size_t first = segments.cells.size();
    segments.cells.push_back(segment_cell(stream, record, cell_index));
    stream.charge_values(8);
    if (add_rest_of_range(stream, record, cell_index, segments.cells)) segments.cells[first].range.reset();
  }
}

std::vector<Well> wells_with_segments(DeckStream& stream, const Well& well, const DeckSegments& segments,
                                      const CornerPointGrid& grid) {
  return SegmentedWell(stream, well, segments, grid).make();
}

}  // namespace wellknit
