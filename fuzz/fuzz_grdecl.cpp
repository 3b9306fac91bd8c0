// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A deck of any bytes either reads as a valid grid or ends in ParseError. The line "%%" ends the deck and begins the
/// file part.inc, which it may include.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "model/errors.h"
#include "readers/describe.h"
#include "readers/parse_case.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_well(const wellknit::Well& well) {
  const auto& path = well.trajectory;
  require(path.points.size() >= 2 && path.points.size() == path.measured_depth.size() && !well.open.empty());
  for (std::size_t n = 1; n < path.points.size(); ++n) require(path.measured_depth[n] > path.measured_depth[n - 1]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto cut = text.find("\n%%\n");
  const std::string part = cut == std::string::npos ? "PORO\n0.1 0.2 /\n" : text.substr(cut + 4);
  wellknit::MemoryFiles files({{"case", text.substr(0, cut)}, {"part.inc", part}});
  wellknit::DeckLimits limits;
  limits.free_values = 100'000;
  limits.free_steps = 1'000'000;
  limits.include_count = 20;
  limits.hashes_sources = false;
  try {
    const wellknit::Case read = wellknit::parse_case(files, "case", {}, limits);
    wellknit::validate(read.grid);
    for (const wellknit::Well& well : read.deck_wells) check_well(well);
    for (const wellknit::Fault& fault : read.grid.edits.faults) require(fault.face_count() > 0);
    for (const std::string& note : read.notes) require(note.find('\n') == std::string::npos);
    (void)wellknit::describe(read.grid);
  } catch (const wellknit::ParseError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}
