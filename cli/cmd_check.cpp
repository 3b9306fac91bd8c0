// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit check: validity and finite-volume quality of a mesh file (docs/commands/check.md).

#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/terminal.h"
#include "model/assessment.h"
#include "readers/read_mesh.h"

namespace wellknit {

namespace {

struct CheckRequest {
  std::string mesh;
  std::string limits;
  bool json = false;
};

/// The first line, which says whether the mesh is valid, in colour.
std::string coloured(const std::string& text, const Assessment& assessment) {
  const std::size_t end = text.find('\n');
  const Ink ink = !assessment.is_good() ? Ink::poor : worst_of(assessment.figures) != nullptr ? Ink::watch : Ink::good;
  return painted(text.substr(0, end), ink, Stream::output) + text.substr(end);
}

int check(const CheckRequest& request) {
  const std::vector<Limit> limits = request.limits.empty() ? std::vector<Limit>{} : read_limits(request.limits);
  const Assessment result = assess(read_mesh(request.mesh).mesh, limits);
  std::cout << (request.json ? to_json(result, request.mesh, program_and_version())
                             : coloured(to_text(result, request.mesh), result));
  return result.is_good() ? 0 : 1;
}

}  // namespace

Run add_check(CLI::App& app) {
  const auto request = std::make_shared<CheckRequest>();
  app.add_option("MESH", request->mesh, "A mesh file (HDF5)")->required()->type_name("FILE");
  app.add_option("--limits", request->limits,
                 "A TOML file of `figure = limit` lines; a figure past its limit makes exit 1")
      ->type_name("FILE");
  app.add_flag("--json", request->json, "As JSON");
  app.footer("Exit code 1: the mesh is not valid, a limit is passed, or the file cannot be read.");
  return [request] { return check(*request); };
}

}  // namespace wellknit
