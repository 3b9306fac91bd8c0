// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Everything that `wellknit check` and `wellknit report` say of a mesh's validity and quality, worked out once.
#pragma once

#include <string>
#include <vector>

#include "model/mesh_check.h"
#include "model/quality.h"
#include "model/verdict.h"

namespace wellknit {

struct Assessment {
  std::vector<Violation> violations;
  QualityReport quality;
  bool has_quality = false;        ///< false: the structure is broken, nothing could be measured
  std::vector<KeyFigure> figures;  ///< empty without quality
  std::vector<Limit> limits;       ///< that were asked for
  std::vector<PassedLimit> passed;

  [[nodiscard]] bool is_valid() const { return violations.empty(); }
  [[nodiscard]] bool is_good() const { return is_valid() && passed.empty(); }
};

/// Of a broken mesh, which may have a violation in every cell, this many are shown.
inline constexpr std::size_t violations_shown = 20;

/// A limit on the made cells that are not seen from their centre decides instead of the check of that name.
Assessment assess(const Mesh& mesh, const std::vector<Limit>& limits);

/// One sentence: valid or not, and how many of the five figures are good.
std::string headline(const Assessment& assessment);

/// Plain text for a terminal; `path` is the mesh file's. Ends with a line feed.
std::string to_text(const Assessment& assessment, const std::string& path);
/// The same as one JSON object (docs/commands/check.md). Ends with a line feed.
std::string to_json(const Assessment& assessment, const std::string& path, const std::string& program);

}  // namespace wellknit
