// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "model/errors.h"
#include "readers/ecl_records.h"
#include "readers/file_content.h"
#include "readers/text.h"

namespace wellknit {

namespace fs = std::filesystem;

namespace {

FileContent load(const std::string& path) {
  DiskFiles files;
  auto content = files.load(path);
  if (!content)
    throw ParseError({path, 0, ""}, {"a file of a simulator's run", "none of this name",
                                     "give the run's deck, its SMSPEC file or their common stem"});
  return *std::move(content);
}

/// The name under which a vector is known; empty for one that belongs to nothing (an unused place).
std::string name_of_vector(const std::string& keyword, const std::string& well, std::int32_t number) {
  if (keyword.empty()) return {};
  const bool has_well = !well.empty() && well != ":+:+:+:+";
  switch (keyword.front()) {
    case 'W':
    case 'G': return has_well ? keyword + ":" + well : std::string();
    case 'R':
    case 'B':
    case 'A': return number > 0 ? fmt::format("{}:{}", keyword, number) : keyword;
    case 'C':
    case 'S': return has_well ? fmt::format("{}:{}:{}", keyword, well, number) : keyword;
    default: return keyword;
  }
}

/// SMSPEC: the names of the vectors, by place.
struct Specification {
  std::vector<std::string> names, units;
  std::array<std::int64_t, 3> dimensions{};
};

Specification read_specification(const std::string& path) {
  const FileContent content = load(path);
  EclRecords records(content.text, content.path);
  std::vector<std::string> keywords, wells;
  std::vector<std::int32_t> numbers;
  Specification out;
  while (const auto array = records.next()) {
    if (array->name == "KEYWORDS") keywords = records.strings(*array);
    if (array->name == "WGNAMES" || array->name == "NAMES") wells = records.strings(*array);
    if (array->name == "NUMS") numbers = records.integers(*array);
    if (array->name == "UNITS") out.units = records.strings(*array);
    if (array->name != "DIMENS") continue;
    records.require_at_least(*array, 4);
    const auto values = records.integers(*array);
    out.dimensions = {values[1], values[2], values[3]};
  }
  if (keywords.empty() || wells.size() != keywords.size() || (!numbers.empty() && numbers.size() != keywords.size()) ||
      out.units.size() != keywords.size())
    throw ParseError({content.path, 0, ""}, {"KEYWORDS, WGNAMES, UNITS and NUMS of one length", "others",
                                             "is this a summary specification (SMSPEC)?"});
  for (std::size_t n = 0; n < keywords.size(); ++n)
    out.names.push_back(name_of_vector(keywords[n], wells[n], numbers.empty() ? 0 : numbers[n]));
  return out;
}

}  // namespace

std::string run_stem(const std::string& path) {
  const std::string extension = upper_case(fs::path(path).extension().string());
  for (const char* known : {".DATA", ".SMSPEC", ".UNSMRY", ".UNRST", ".EGRID", ".INIT"})
    if (extension == known) return fs::path(path).replace_extension().string();
  return path;
}

SummaryRun read_summary(const std::string& stem) {
  const Specification specification = read_specification(stem + ".SMSPEC");
  SummaryRun out;
  out.dimensions = specification.dimensions;
  const std::size_t count = specification.names.size();
  std::vector<SummaryVector*> places(count, nullptr);
  for (std::size_t n = 0; n < count; ++n) {
    if (specification.names[n].empty()) continue;
    const auto [place, is_new] = out.vectors.try_emplace(specification.names[n]);
    if (!is_new) continue;
    place->second.unit = specification.units[n];
    places[n] = &place->second;
  }
  const FileContent content = load(stem + ".UNSMRY");
  EclRecords records(content.text, content.path);
  while (const auto array = records.next()) {
    if (array->name != "PARAMS") continue;
    records.require_count(*array, static_cast<std::int64_t>(count));
    const auto values = records.reals(*array);
    for (std::size_t n = 0; n < count; ++n)
      if (places[n] != nullptr) places[n]->values.push_back(values[n]);
  }
  const auto time = out.vectors.find("TIME");
  if (time == out.vectors.end() || time->second.values.empty())
    throw ParseError({content.path, 0, ""}, {"TIME and at least one step", "none", "did the run begin at all?"});
  out.time = time->second.values;
  out.time_unit = time->second.unit;
  out.vectors.erase(time);
  return out;
}

std::optional<std::map<std::int32_t, std::vector<double>>> read_restart_array(const std::string& stem,
                                                                              const std::string& keyword) {
  DiskFiles files;
  const auto content = files.load(stem + ".UNRST");
  if (!content) return std::nullopt;
  EclRecords records(content->text, content->path);
  std::map<std::int32_t, std::vector<double>> out;
  std::int32_t step = -1;
  while (const auto array = records.next()) {
    if (array->name == "SEQNUM") {
      records.require_at_least(*array, 1);
      step = records.integers(*array).front();
    }
    if (array->name == keyword && step >= 0) out.emplace(step, records.reals(*array));
  }
  return out;
}

}  // namespace wellknit
