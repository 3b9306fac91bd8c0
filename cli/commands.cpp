// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/commands.h"

#include <array>

#include "cli/usage_error.h"
#include "wellknit_version.h"

namespace wellknit {

namespace {

struct Entry {
  const char* name;
  const char* description;
  Run (*add)(CLI::App& app);
};

constexpr std::array table{
    Entry{"build", "Host grid and wells to a mesh file", add_build},
    Entry{"check", "Validity and quality of a mesh file", add_check},
    Entry{"info", "What is in a deck, grid, well or mesh file", add_info},
    Entry{"convert", "Mesh file, or a grid alone, to another format", add_convert},
    Entry{"formats", "The formats that can be read and written", add_formats},
};

}  // namespace

Program::Program() : app_(std::make_unique<CLI::App>("Knits radial well meshes into corner-point grids.", "wellknit")) {
  app_->set_version_flag("--version", program_and_version());
  app_->footer("Exit code: 0 done, 1 something is wrong with the data, 2 something is wrong with the command line.");
  for (const Entry& entry : table) {
    CLI::App* command = app_->add_subcommand(entry.name, entry.description);
    command->set_version_flag("--version", program_and_version());
    commands_.push_back({command, entry.add(*command)});
  }
}

int Program::run(int argc, const char* const* argv) {
  app_->parse(argc, argv);
  for (const Command& command : commands_) {
    if (command.app->parsed()) return command.run();
  }
  throw UsageError("no command given; wellknit --help lists them");
}

std::string program_and_version() { return std::string("wellknit ") + version; }

}  // namespace wellknit
