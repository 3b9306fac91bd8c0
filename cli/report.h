// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What `wellknit build` did, for a person and for a script.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algorithm/build_mesh.h"
#include "conversion/conversion_report.h"
#include "model/quality.h"

namespace wellknit {

struct WrittenFile {
  std::string format;
  std::string path;
  std::int64_t bytes = 0;
  std::vector<std::string> notes;  ///< what its user must know
};

struct BuildReport {
  std::string case_path;
  std::array<std::int64_t, 3> dimensions{};  ///< of the source grid
  BuildSummary build;
  QualityReport quality;
  double pore_volume = 0.0;     ///< m3, of the mesh
  std::vector<StepTime> times;  ///< of the whole run: reading, the steps of the mesh, writing
  std::vector<WrittenFile> files;
  std::vector<std::string> notes;              ///< of the readers
  std::optional<ConversionReport> conversion;  ///< of the whole deck
};

/// "wrote …" and what its user must know; ends with a line feed.
std::string to_text(const WrittenFile& file);
/// Plain text for a terminal, ends with a line feed.
std::string to_text(const BuildReport& report);
/// The same as one JSON object (docs/commands/build.md).
std::string to_json(const BuildReport& report);

}  // namespace wellknit
