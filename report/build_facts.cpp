// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/build_facts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/errors.h"

namespace wellknit {

namespace {

using Json = nlohmann::json;

BuildFacts::Well well_of(const Json& json) {
  BuildFacts::Well well;
  json.at("name").get_to(well.name);
  json.at("meshed").get_to(well.meshed);
  json.at("mode").get_to(well.mode);
  json.at("reason").get_to(well.reason);
  json.at("radius_wanted").get_to(well.radius_wanted);
  json.at("drainage_radius").get_to(well.drainage_radius);
  json.at("length_in_rock").get_to(well.length_in_rock);
  json.at("length_meshed").get_to(well.length_meshed);
  json.at("notes").get_to(well.notes);
  return well;
}

}  // namespace

const BuildFacts::Well* BuildFacts::well(const std::string& name) const {
  const auto found = std::ranges::find(wells, name, &Well::name);
  return found == wells.end() ? nullptr : &*found;
}

BuildFacts parse_build_facts(const std::string& text, const std::string& path) {
  try {
    const Json json = Json::parse(text);
    BuildFacts facts;
    for (const Json& well : json.at("wells")) facts.wells.push_back(well_of(well));
    for (const Json& step : json.at("times"))
      facts.steps.push_back({step.at("step").get<std::string>(), step.at("seconds").get<double>()});
    json.at("notes").get_to(facts.notes);
    return facts;
  } catch (const Json::exception&) {
    throw ParseError({path, 0, ""}, {"what `wellknit build --json` prints", "something else",
                                     "save it with `wellknit build … --json > summary.json`"});
  }
}

}  // namespace wellknit
