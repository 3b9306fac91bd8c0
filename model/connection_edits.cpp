// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/connection_edits.h"

#include <fmt/format.h>

#include <string_view>

#include "model/errors.h"

namespace wellknit {

namespace {

void expect_inside(const CellBox& box, const std::array<std::int64_t, 3>& dimensions, std::string_view keyword) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.first[axis] < 0 || box.last[axis] < box.first[axis] || box.last[axis] >= dimensions[axis])
      throw InvalidInput(fmt::format("{} names cells outside the grid along {}", keyword, "IJK"[axis]));
  }
}

void expect_cells(const std::vector<CellPairValue>& pairs, std::int64_t cells, std::string_view keyword) {
  for (const CellPairValue& pair : pairs) {
    for (const HostCellId cell : {pair.first, pair.second})
      if (cell.value() < 0 || cell.value() >= cells)
        throw InvalidInput(fmt::format("{} names a cell outside the grid", keyword));
  }
}

}  // namespace

std::int64_t Fault::face_count() const {
  std::int64_t count = 0;
  for (const FaultFaces& record : faces) count += record.cells.cell_count();
  return count;
}

void validate(const ConnectionEdits& edits, const std::array<std::int64_t, 3>& dimensions) {
  const std::int64_t cells = dimensions[0] * dimensions[1] * dimensions[2];
  const auto expect_length = [&](const std::vector<double>& values, std::string_view keyword) {
    if (!values.empty() && values.size() != static_cast<std::size_t>(cells))
      throw InvalidInput(
          fmt::format("{} has {} values where the dimensions ask for {}", keyword, values.size(), cells));
  };
  if (edits.method == TransmissibilityMethod::oldtran || edits.method == TransmissibilityMethod::oldtranr)
    throw InvalidInput("transmissibilities of block centres (OLDTRAN, OLDTRANR) are not available: ask for NEWTRAN");
  for (std::size_t face = 0; face < edits.face_multiplier.size(); ++face)
    expect_length(edits.face_multiplier[face], multiplier_keyword(static_cast<FaceDirection>(face)));
  expect_length(edits.pore_volume_multiplier, "MULTPV");
  expect_length(edits.pore_volume_multiplier_edit, "MULTPV");
  expect_length(edits.least_pore_volume_by_cell, "MINPVV");
  expect_cells(edits.non_neighbours, cells, "NNC");
  expect_cells(edits.non_neighbour_multipliers, cells, "EDITNNC");
  expect_cells(edits.non_neighbour_transmissibilities, cells, "EDITNNCR");
  for (const Fault& fault : edits.faults)
    for (const FaultFaces& record : fault.faces) expect_inside(record.cells, dimensions, "FAULTS");
  for (const ArrayEdit& edit : edits.array_edits) {
    expect_inside(edit.cells, dimensions, keyword_of(edit.array));
    if (!edit.values.empty() && edit.values.size() != static_cast<std::size_t>(edit.cells.cell_count()))
      throw InvalidInput(fmt::format("{} has {} values for a box of {} cells", keyword_of(edit.array),
                                     edit.values.size(), edit.cells.cell_count()));
  }
}

std::string multiplier_keyword(FaceDirection face) {
  const auto n = static_cast<std::size_t>(face);
  return std::string("MULT") + "XYZ"[n / 2] + (n % 2 == 0 ? "-" : "");
}

std::string keyword_of(RegionSet regions) {
  switch (regions) {
    case RegionSet::fluxnum: return "FLUXNUM";
    case RegionSet::opernum: return "OPERNUM";
    case RegionSet::multnum: break;
  }
  return "MULTNUM";
}

std::string keyword_of(ComputedArray array) {
  switch (array) {
    case ComputedArray::transmissibility_x: return "TRANX";
    case ComputedArray::transmissibility_y: return "TRANY";
    case ComputedArray::transmissibility_z: return "TRANZ";
    case ComputedArray::pore_volume: return "PORV";
    case ComputedArray::depth: break;
  }
  return "DEPTH";
}

}  // namespace wellknit
