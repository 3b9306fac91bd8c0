// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// All outputs of one run: they appear together or not at all.
#pragma once

#include <string>
#include <vector>

#include "cli/build_request.h"
#include "cli/report.h"
#include "model/mesh.h"
#include "model/provenance.h"
#include "writers/formats.h"

namespace wellknit {

class OutputSet {
 public:
  /// Asked before the work begins. Throws UsageError for an unknown format, two outputs with one path, or an output
  /// that is an input; WriteError where a file exists (and `overwrite` is false) or cannot be made.
  OutputSet(std::vector<OutputRequest> outputs, const std::vector<std::string>& inputs, bool overwrite);

  /// Writes each beside its target, then names them all. Throws WriteError, and leaves nothing then.
  std::vector<WrittenFile> write(const Mesh& mesh, const Provenance& provenance) const;

 private:
  std::vector<OutputRequest> outputs_;
  bool overwrite_;
};

}  // namespace wellknit
