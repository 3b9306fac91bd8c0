// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What `wellknit solve` found, for a person and for a script.
#pragma once

#include <string>
#include <vector>

#include "algorithm/steady_flow.h"
#include "cli/flow_request.h"
#include "cli/report.h"

namespace wellknit {

struct FlowReport {
  std::string mesh_path;
  const Mesh* mesh = nullptr;
  FlowProblem problem;
  SteadyFlow flow;
  double seconds = 0.0;
  std::vector<WrittenFile> files;
};

/// Notes of the problem and of its solution, one sentence each.
std::vector<std::string> flow_notes(const FlowReport& report);
/// Plain text for a terminal, ends with a line feed.
std::string to_text(const FlowReport& report);
/// The same as one JSON object (docs/commands/solve.md).
std::string to_json(const FlowReport& report);

}  // namespace wellknit
