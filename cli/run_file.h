// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A run file (TOML): what `wellknit build` can be told on the command line, in a file (docs/commands/build.md).
#pragma once

#include <string>

#include "cli/build_request.h"

namespace wellknit {

/// Paths in it are taken from the run file's own folder. Throws ParseError when the file cannot be read, UsageError
/// (`file:line: key: …`) when it is not TOML or says something that is no option.
BuildRequest read_run_file(const std::string& path);

}  // namespace wellknit
