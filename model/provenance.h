// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What made a mesh file: goes into its root attributes.
#pragma once

#include <string>
#include <vector>

#include "model/case.h"

namespace wellknit {

struct Provenance {
  std::string created_by;  ///< program and version
  std::string command;     ///< the command line
  std::string config;      ///< the whole effective configuration as text
  std::vector<SourceFile> sources;
};

}  // namespace wellknit
