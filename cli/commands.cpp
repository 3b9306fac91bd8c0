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
  const char* example;
  Run (*add)(CLI::App& app);
};

constexpr std::array table{
    Entry{"build", "Host grid and wells to a mesh file", "wellknit build grid.GRDECL --well path.csv -o mesh.h5",
          add_build},
    Entry{"check", "Validity and quality of a mesh file", "wellknit check mesh.h5 --limits limits.toml", add_check},
    Entry{"info", "What is in a deck, grid, well or mesh file", "wellknit info FIELD.DATA", add_info},
    Entry{"convert", "Mesh file, or a grid alone, to another format", "wellknit convert mesh.h5 mesh.vtu", add_convert},
    Entry{"report", "Quality of a mesh file as one HTML page", "wellknit report mesh.h5 -o report.html", add_report},
    Entry{"solve", "Steady single-phase flow: rates, pressures, productivity",
          "wellknit solve mesh.h5 --producers 100bar --boundary all=200bar", add_solve},
    Entry{"map", "Values carried from the source grid to the mesh, or back",
          "wellknit map mesh.h5 --forward more.GRDECL -o mapped.h5", add_map},
    Entry{"compare", "Two runs of a simulator: vectors and cell pressures", "wellknit compare FIELD OUT", add_compare},
    Entry{"formats", "The formats that can be read and written", "wellknit formats", add_formats},
    Entry{"completion", "Completion of commands and options for a shell", "source <(wellknit completion bash)",
          add_completion},
    Entry{"manual", "A manual page, for man", "wellknit manual build | man -l -", add_manual},
};

}  // namespace

Program::Program() : app_(std::make_unique<CLI::App>("Knits radial well meshes into corner-point grids.", "wellknit")) {
  app_->set_version_flag("--version", program_and_version());
  app_->footer("Exit code: 0 done, 1 something is wrong with the data, 2 something is wrong with the command line.");
  app_->require_subcommand(0, 1);  // so that the name of a command can be an argument of another
  for (const Entry& entry : table) {
    CLI::App* command = app_->add_subcommand(entry.name, entry.description);
    command->set_version_flag("--version", program_and_version());
    commands_.push_back({command, entry.add(*command)});
    const std::string notes = command->get_footer();
    command->footer((notes.empty() ? "" : notes + "\n") + "Example: " + entry.example);
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
