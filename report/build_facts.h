// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a run of `wellknit build` knew and the mesh file does not keep: times, notes, wells that were not meshed. Read
/// from what `wellknit build --json` prints.
#pragma once

#include <string>
#include <vector>

namespace wellknit {

struct BuildFacts {
  struct Step {
    std::string name;
    double seconds = 0.0;
  };
  struct Well {
    std::string name;
    bool meshed = false;
    std::string mode;
    std::string reason;  ///< why it was not meshed
    double radius_wanted = 0.0;
    double drainage_radius = 0.0;
    double length_in_rock = 0.0;  ///< m
    double length_meshed = 0.0;   ///< m
    std::vector<std::string> notes;
  };
  std::vector<Step> steps;
  std::vector<Well> wells;
  std::vector<std::string> notes;

  [[nodiscard]] const Well* well(const std::string& name) const;
};

/// `path` stands in messages. Throws ParseError: not JSON, or not that of `wellknit build --json`.
BuildFacts parse_build_facts(const std::string& text, const std::string& path);

}  // namespace wellknit
