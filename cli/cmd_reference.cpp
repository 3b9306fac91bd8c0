// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit manual and wellknit completion: the options for man and for shells (docs/commands/completion.md).

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/reference.h"
#include "cli/usage_error.h"

namespace wellknit {

namespace {

const CLI::App& page_asked_for(const CLI::App& program, const std::string& name) {
  if (name.empty()) return program;
  const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
  const auto found = std::ranges::find(commands, name, &CLI::App::get_name);
  if (found == commands.end()) throw UsageError("no command " + name + "; wellknit --help lists them");
  return **found;
}

}  // namespace

Run add_manual(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  app.add_option("COMMAND", *name, "The command; without it the page of the program");
  return [name, &app] {
    std::cout << manual_page(page_asked_for(*app.get_parent(), *name), program_and_version());
    return 0;
  };
}

Run add_completion(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  app.add_option("SHELL", *shell, "bash, zsh or fish")->required();
  return [shell, &app] {
    const std::string script = completion_script(*app.get_parent(), *shell);
    if (script.empty()) throw UsageError("expected bash, zsh or fish, found '" + *shell + "'");
    std::cout << script;
    return 0;
  };
}

}  // namespace wellknit
