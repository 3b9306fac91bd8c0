// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Well trajectory files: CSV, ResInsight .dev, RMS well.
#pragma once

#include <string>
#include <vector>

#include "model/well.h"

namespace wellknit {

struct TrajectoryFile {
  std::vector<Well> wells;         ///< name, trajectory and open intervals set; the rest at defaults
  std::vector<std::string> notes;  ///< what was mended: repeated stations …
};

/// Reads a trajectory file; its format is told by content, then by extension. Throws ParseError.
TrajectoryFile read_trajectory(const std::string& path);

}  // namespace wellknit
