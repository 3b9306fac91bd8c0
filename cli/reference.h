// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Manual pages and shell completion, from the same options that --help prints.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace wellknit {

/// One page in the language of man(7), of the program or of one of its commands.
std::string manual_page(const CLI::App& app, const std::string& version);

/// For "bash", "zsh" or "fish"; empty for another shell. `program` has the commands.
std::string completion_script(const CLI::App& program, const std::string& shell);

}  // namespace wellknit
