// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A text file of an OpenFOAM case: a TextFile with OpenFOAM's head.
#pragma once

#include <string>
#include <string_view>

#include "writers/text_file.h"

namespace wellknit {

class FoamFile : public TextFile {
 public:
  /// `name` is relative to the case's folder, where its own folder must be. `shown_path` stands in messages. Throws
  /// WriteError.
  FoamFile(const std::string& folder, const std::string& name, std::string_view foam_class, std::string shown_path,
           std::string_view note = {});
};

}  // namespace wellknit
