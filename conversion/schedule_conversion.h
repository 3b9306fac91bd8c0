// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The SCHEDULE section on the new grid: every record that names a cell, in the deck's order of time.
#pragma once

#include "conversion/conversion_report.h"
#include "conversion/deck_edits.h"
#include "conversion/schedule_wells.h"
#include "model/case.h"

namespace wellknit {

/// Returns the largest number of connections of a well. Throws ParseError, and InvalidInput where a factor cannot be
/// computed.
std::int64_t convert_schedule(const WholeDeck& deck, const Case& source, const Mesh& mesh, ScheduleWells& wells,
                              const SourceCells& cells, DeckEdits& edits, ConversionReport& report);

}  // namespace wellknit
