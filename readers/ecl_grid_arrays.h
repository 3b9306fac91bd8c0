// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the kinds of Eclipse grid files have in common: the frame of the coordinates, and arrays of cells.
#pragma once

#include <string>
#include <vector>

#include "readers/ecl_records.h"
#include "readers/grid_part.h"

namespace wellknit {

/// Takes MAPUNITS, MAPAXES and GRIDUNIT. False for any other array. Throws ParseError.
bool take_frame_array(const EclRecords& file, const EclArray& array, GridPart& part);

/// Takes an array that has a rule as a property of cells. False for one that has none. Throws ParseError.
bool take_cell_array(const EclRecords& file, const EclArray& array, bool may_be_active, GridPart& part);

/// Three numbers of cells from this place of an integer array. Throws ParseError when they cannot be.
std::array<std::int64_t, 3> dimensions_of(const EclRecords& file, const EclArray& array, std::size_t first);

/// Throws ParseError for LGR and its kin: a local grid refinement.
void refuse_local_grids(const EclRecords& file, const EclArray& array);

/// Says that the file has the other byte order, where it has.
void note_byte_order(const EclRecords& file, GridPart& part);

}  // namespace wellknit
