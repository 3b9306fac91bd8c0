// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/assessment.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view not_seen_figure = "made_cells_not_seen_from_centre";

std::string violation_lines(const std::vector<Violation>& violations) {
  std::string text;
  for (std::size_t i = 0; i < std::min(violations.size(), violations_shown); ++i)
    text += fmt::format("  {}: {}: {}\n", violations[i].entity, violations[i].check, violations[i].detail);
  if (violations.size() > violations_shown)
    text += fmt::format("  and {} more\n", violations.size() - violations_shown);
  return text;
}

Json json_of(const KeyFigure& figure) {
  return {{"name", figure.figure}, {"value", figure.value},          {"watch", figure.watch},
          {"poor", figure.poor},   {"grade", name_of(figure.grade)}, {"advice", figure.advice}};
}

Json json_of_violations(const std::vector<Violation>& violations) {
  Json out = Json::array();
  for (std::size_t i = 0; i < std::min(violations.size(), violations_shown); ++i)
    out.push_back({{"check", violations[i].check}, {"entity", violations[i].entity}, {"detail", violations[i].detail}});
  return out;
}

Json json_of(const Conservation& volumes) {
  return {{"source_bulk", volumes.source_bulk},
          {"mesh_bulk", volumes.mesh_bulk()},
          {"source_pores", volumes.source_pores},
          {"mesh_pores", volumes.mesh_pores()},
          {"bulk_of_kind", volumes.bulk_of_kind},
          {"pores_of_kind", volumes.pores_of_kind},
          {"largest_fraction_error", volumes.largest_fraction_error}};
}

/// Shares of area and flow by class, for each measure and pair that the mesh has.
Json json_of_distributions(const QualityReport& quality) {
  Json out = Json::object();
  for (std::size_t m = 0; m < face_measure_count; ++m) {
    const auto measure = static_cast<FaceMeasure>(m);
    const auto classes = classes_of(measure);
    Json entry{{"classes", std::vector<double>(classes.begin(), classes.end())}};
    for (std::size_t p = 0; p < face_pair_count; ++p) {
      const Distribution& values = quality.pairs[p].of(measure);
      if (values.area_share.empty()) continue;
      Json& pair = entry[std::string(name_of(FacePair(p)))];
      pair["area"] = values.area_share;
      if (!values.flow_share.empty()) pair["flow"] = values.flow_share;
    }
    out[std::string(name_of(measure))] = std::move(entry);
  }
  return out;
}

}  // namespace

Assessment assess(const Mesh& mesh, const std::vector<Limit>& limits) {
  Assessment out;
  out.limits = limits;
  out.has_quality = check_structure(mesh).empty();
  out.violations = check_mesh(mesh);
  // Who states how many such cells are tolerable has the limit decide.
  const auto names_unseen = [](const Limit& limit) { return limit.name == not_seen_figure; };
  if (std::ranges::any_of(limits, names_unseen))
    std::erase_if(out.violations, [](const Violation& v) { return v.check == not_seen_from_centre; });
  if (!out.has_quality) return out;
  out.quality = quality(mesh);
  out.figures = key_figures(out.quality, limits);
  out.passed = passed_limits(out.quality, limits);
  return out;
}

std::string headline(const Assessment& assessment) {
  if (!assessment.is_valid()) {
    const std::size_t count = assessment.violations.size();
    return fmt::format("Not valid: {} violation{}", count, count == 1 ? "" : "s");
  }
  const auto open =
      std::ranges::count_if(assessment.figures, [](const KeyFigure& f) { return f.grade != Grade::good; });
  std::string text = "Valid; ";
  text += open == 0 ? fmt::format("all {} key figures are good", assessment.figures.size())
                    : fmt::format("{} of {} key figures ask{} for a look", open, assessment.figures.size(),
                                  open == 1 ? "s" : "");
  if (!assessment.passed.empty())
    text += fmt::format("; {} limit{} passed", assessment.passed.size(), assessment.passed.size() == 1 ? "" : "s");
  return text;
}

std::string to_text(const Assessment& assessment, const std::string& path) {
  const std::size_t count = assessment.violations.size();
  std::string text = count == 0 ? fmt::format("{}: valid\n", path)
                                : fmt::format("{}: not valid: {} violation{}\n", path, count, count == 1 ? "" : "s");
  text += violation_lines(assessment.violations);
  for (const KeyFigure& figure : assessment.figures)
    text += fmt::format("{:6} {} {:.4g}{} (watch above {:g}, poor above {:g})\n", name_of(figure.grade), figure.figure,
                        figure.value, figure.unit, figure.watch, figure.poor);
  if (const KeyFigure* worst = worst_of(assessment.figures)) text += fmt::format("advice: {}\n", worst->advice);
  if (assessment.has_quality) text += assessment.quality.to_text();
  for (const PassedLimit& passed : assessment.passed) {
    text += fmt::format("limit passed: {} is {:.6g}, the limit is {:.6g}\n", passed.limit.name, passed.value,
                        passed.limit.value);
  }
  return text;
}

std::string to_json(const Assessment& assessment, const std::string& path, const std::string& program) {
  std::map<std::string, std::int64_t> by_check;
  for (const Violation& violation : assessment.violations) ++by_check[violation.check];
  Json json{{"program", program}, {"file", path}, {"valid", assessment.is_valid()}};
  json["headline"] = headline(assessment);
  json["violation_count"] = assessment.violations.size();
  json["violations_by_check"] = by_check;
  json["violations"] = json_of_violations(assessment.violations);
  json["key_figures"] = Json::array();
  for (const KeyFigure& figure : assessment.figures) json["key_figures"].push_back(json_of(figure));
  if (assessment.has_quality) {
    json["quality"] = Json::parse(assessment.quality.to_json());
    if (assessment.quality.conservation) json["conservation"] = json_of(*assessment.quality.conservation);
    json["distributions"] = json_of_distributions(assessment.quality);
  }
  json["limits"] = Json::array();
  for (const Limit& limit : assessment.limits) json["limits"].push_back({{"name", limit.name}, {"limit", limit.value}});
  json["passed_limits"] = Json::array();
  for (const PassedLimit& passed : assessment.passed) {
    json["passed_limits"].push_back(
        {{"name", passed.limit.name}, {"value", passed.value}, {"limit", passed.limit.value}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wellknit
