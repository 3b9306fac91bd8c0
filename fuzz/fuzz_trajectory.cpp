// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A trajectory file of any bytes, in any of the formats, either reads as valid wells or ends in ParseError.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "model/errors.h"
#include "readers/describe.h"
#include "readers/formats.h"
#include "readers/parse_trajectory.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_well(const wellknit::Well& well) {
  const auto& path = well.trajectory;
  require(path.points.size() >= 2 && path.points.size() == path.measured_depth.size());
  for (std::size_t n = 1; n < path.points.size(); ++n) require(path.measured_depth[n] > path.measured_depth[n - 1]);
  for (const auto& point : path.points) require(point.allFinite());
  for (const auto& range : well.open) require(range.to > range.from);
  require(well.branch >= 1 && well.parent.empty() == (well.branch == 1));
  (void)wellknit::describe(well);
}

template <class Parse>
void run(Parse parse) {
  try {
    const wellknit::TrajectoryFile read = parse();
    require(!read.wells.empty());
    for (const wellknit::Well& well : read.wells) check_well(well);
  } catch (const wellknit::ParseError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
}

}  // namespace

/// Every reader of the table takes the bytes, whatever they look like, and so does the one that is recognised.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const wellknit::TrajectoryOptions options{{0.0, 0.0, 0.0}, false};
  run([&] { return wellknit::parse_trajectory(text, "wells.txt", options); });
  for (const wellknit::ReaderFormat& format : wellknit::reader_formats())
    if (format.read_wells != nullptr) run([&] { return format.read_wells(text, "wells.txt", options); });
  return 0;
}
