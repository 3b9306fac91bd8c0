// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit check: validity and finite-volume quality of a mesh file (docs/commands/check.md).

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "model/mesh_check.h"
#include "model/quality.h"
#include "readers/read_mesh.h"

namespace wellknit {

namespace {

/// A broken mesh may have a violation in every cell: this many are printed.
constexpr std::size_t violations_shown = 20;
constexpr std::string_view not_seen_figure = "made_cells_not_seen_from_centre";

struct CheckRequest {
  std::string mesh;
  std::string limits;
  bool json = false;
};

struct CheckResult {
  std::vector<Violation> violations;
  QualityReport quality;
  bool has_quality = false;  ///< false: the structure is broken, nothing could be measured
  std::vector<PassedLimit> passed;

  [[nodiscard]] bool is_good() const { return violations.empty() && passed.empty(); }
};

CheckResult examine(const Mesh& mesh, const std::vector<Limit>& limits) {
  CheckResult result;
  result.has_quality = check_structure(mesh).empty();
  result.violations = check_mesh(mesh);
  // Who states how many such cells are tolerable has the limit decide.
  const auto names_unseen = [](const Limit& limit) { return limit.name == not_seen_figure; };
  if (std::ranges::any_of(limits, names_unseen)) {
    std::erase_if(result.violations, [](const Violation& v) { return v.check == not_seen_from_centre; });
  }
  if (!result.has_quality) return result;
  result.quality = quality(mesh);
  result.passed = passed_limits(result.quality, limits);
  return result;
}

std::string to_text(const CheckRequest& request, const CheckResult& result) {
  const std::size_t count = result.violations.size();
  std::string text = count == 0
                         ? fmt::format("{}: valid\n", request.mesh)
                         : fmt::format("{}: not valid: {} violation{}\n", request.mesh, count, count == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(count, violations_shown); ++i) {
    const Violation& violation = result.violations[i];
    text += fmt::format("  {}: {}: {}\n", violation.entity, violation.check, violation.detail);
  }
  if (count > violations_shown) text += fmt::format("  and {} more\n", count - violations_shown);
  if (result.has_quality) text += result.quality.to_text();
  for (const PassedLimit& passed : result.passed) {
    text += fmt::format("limit passed: {} is {:.6g}, the limit is {:.6g}\n", passed.limit.name, passed.value,
                        passed.limit.value);
  }
  return text;
}

std::string to_json(const CheckRequest& request, const CheckResult& result) {
  using Json = nlohmann::ordered_json;
  std::map<std::string, std::int64_t> by_check;
  for (const Violation& violation : result.violations) ++by_check[violation.check];
  Json json{{"program", program_and_version()}, {"file", request.mesh}, {"valid", result.violations.empty()}};
  json["violation_count"] = result.violations.size();
  json["violations_by_check"] = by_check;
  json["violations"] = Json::array();
  for (std::size_t i = 0; i < std::min(result.violations.size(), violations_shown); ++i) {
    const Violation& violation = result.violations[i];
    json["violations"].push_back(
        {{"check", violation.check}, {"entity", violation.entity}, {"detail", violation.detail}});
  }
  if (result.has_quality) json["quality"] = Json::parse(result.quality.to_json());
  json["passed_limits"] = Json::array();
  for (const PassedLimit& passed : result.passed) {
    json["passed_limits"].push_back(
        {{"name", passed.limit.name}, {"value", passed.value}, {"limit", passed.limit.value}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int check(const CheckRequest& request) {
  const std::vector<Limit> limits = request.limits.empty() ? std::vector<Limit>{} : read_limits(request.limits);
  const CheckResult result = examine(read_mesh(request.mesh).mesh, limits);
  std::cout << (request.json ? to_json(request, result) : to_text(request, result));
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
