// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a simulator wrote about a run: summary vectors (SMSPEC, UNSMRY) and cell values at report steps (UNRST).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wellknit {

struct SummaryVector {
  std::string unit;
  std::vector<double> values;  ///< one a time step
};

struct SummaryRun {
  std::array<std::int64_t, 3> dimensions{};
  std::vector<double> time;  ///< as the file has it: days, or hours in LAB units
  std::string time_unit;
  std::map<std::string, SummaryVector> vectors;  ///< by KEYWORD, KEYWORD:WELL, KEYWORD:NUMBER or KEYWORD:WELL:NUMBER
};

/// The stem of a run's files from its deck, one of its files, or the stem itself: /a/RUN of /a/RUN.SMSPEC.
std::string run_stem(const std::string& path);

/// STEM.SMSPEC and STEM.UNSMRY, binary. Throws ParseError.
SummaryRun read_summary(const std::string& stem);

/// An array of STEM.UNSMRY's sister STEM.UNRST by report step: one value an active cell. Nothing where there is no such
/// file. Throws ParseError.
std::optional<std::map<std::int32_t, std::vector<double>>> read_restart_array(const std::string& stem,
                                                                              const std::string& keyword);

}  // namespace wellknit
