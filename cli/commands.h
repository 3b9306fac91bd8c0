// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The commands of the program: one table, one cmd_<name>.cpp each.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wellknit {

/// Runs a command whose options have been read; returns the exit code 0 or 1. Throws what the library throws, and
/// UsageError.
using Run = std::function<int()>;

Run add_build(CLI::App& app);
Run add_check(CLI::App& app);
Run add_info(CLI::App& app);
Run add_convert(CLI::App& app);
Run add_report(CLI::App& app);
Run add_solve(CLI::App& app);
Run add_map(CLI::App& app);
Run add_compare(CLI::App& app);
Run add_formats(CLI::App& app);
Run add_completion(CLI::App& app);
Run add_manual(CLI::App& app);

/// The program with all its commands.
class Program {
 public:
  Program();
  /// Reads the command line and runs its command. Throws CLI::ParseError (also for --help and --version), UsageError,
  /// and what the library throws.
  int run(int argc, const char* const* argv);
  CLI::App& app() { return *app_; }

 private:
  struct Command {
    CLI::App* app;
    Run run;
  };
  std::unique_ptr<CLI::App> app_;
  std::vector<Command> commands_;
};

/// "wellknit 0.1.0"
std::string program_and_version();

}  // namespace wellknit
