// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit info: what is in a file (docs/commands/info.md).

#include <iostream>
#include <memory>

#include "algorithm/host_validity.h"
#include "cli/commands.h"
#include "readers/describe.h"

namespace wellknit {

namespace {

struct InfoRequest {
  std::string file;
  bool json = false;
};

int info(const InfoRequest& request) {
  const FileDescription description =
      describe_file(request.file, [](const CornerPointGrid& grid) { return check_host_validity(grid); });
  std::cout << (request.json ? to_json(description) : to_text(description));
  return 0;
}

}  // namespace

Run add_info(CLI::App& app) {
  const auto request = std::make_shared<InfoRequest>();
  app.add_option("FILE", request->file, "A deck, grid, trajectory or mesh file")->required()->type_name("FILE");
  app.add_flag("--json", request->json, "As JSON");
  return [request] { return info(*request); };
}

}  // namespace wellknit
