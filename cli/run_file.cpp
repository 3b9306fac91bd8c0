// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/run_file.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/usage_error.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// A place in the run file, for messages.
struct Place {
  const std::string& file;
  const toml::node& node;
  std::string key;

  [[noreturn]] void fail(std::string_view what) const {
    throw UsageError(fmt::format("{}:{}: {}: {}", file, node.source().begin.line, key, what));
  }
};

/// The value as the command line would spell it.
std::string spelled(const Place& place) {
  if (const auto text = place.node.value_exact<std::string>()) return *text;
  if (const auto flag = place.node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const auto whole = place.node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto real = place.node.value_exact<double>()) return fmt::format("{}", *real);
  place.fail("expected a text, a number, true or false");
}

/// Runs `set` and puts file, line and key before what it throws.
template <class Set>
void set_at(const Place& place, Set set) {
  try {
    set();
  } catch (const UsageError& error) {
    place.fail(error.what());
  }
}

void read_well(const Place& place, BuildRequest& request) {
  const toml::table* entry = place.node.as_table();
  if (entry == nullptr) place.fail("expected a table: [[well]] with file = and keys");
  WellRequest well;
  for (const auto& [name, node] : *entry) {
    const std::string key(name.str());
    const Place here{place.file, node, "well." + key};
    const std::string value = spelled(here);
    if (key == "file") {
      well.file = value;
    } else {
      set_at(here, [&] { set_well_key(well, key, value); });
    }
  }
  if (well.file.empty()) place.fail("expected file = \"…\" with the well's trajectory");
  request.wells.push_back(std::move(well));
}

/// A path, or a table with `path` and the format's keys.
OutputRequest read_output(const std::string& format, const Place& place) {
  const toml::table* entry = place.node.as_table();
  if (entry == nullptr) return {format, spelled(place)};
  OutputRequest output{format, ""};
  for (const auto& [name, node] : *entry) {
    const std::string key(name.str());
    const Place here{place.file, node, place.key + "." + key};
    const std::string value = spelled(here);
    if (key == "path") {
      output.path = value;
    } else {
      set_at(here, [&] { set_output_key(output, key, value); });
    }
  }
  if (output.path.empty()) place.fail("expected path = \"…\" with the output's place");
  return output;
}

void read_writes(const Place& place, BuildRequest& request) {
  const toml::table* formats = place.node.as_table();
  if (formats == nullptr) place.fail("expected a table: [write] with FORMAT = \"PATH\"");
  for (const auto& [name, node] : *formats) {
    const std::string format(name.str());
    const std::string key = "write." + format;
    const toml::array* outputs = node.as_array();
    if (outputs == nullptr) {
      request.writes.push_back(read_output(format, {place.file, node, key}));
      continue;
    }
    for (const toml::node& output : *outputs) request.writes.push_back(read_output(format, {place.file, output, key}));
  }
}

void read_option(const Place& place, BuildRequest& request) {
  const auto options = build_options();
  const auto option = std::ranges::find_if(options, [&](const BuildOption& o) { return place.key == o.name; });
  if (option == options.end()) place.fail("unknown key; `wellknit build --help` lists the options");
  const toml::array* list = place.node.as_array();
  if (list == nullptr) {
    set_at(place, [&] { option->set(request, spelled(place)); });
    return;
  }
  if (option->kind != BuildOption::Kind::list && place.key != "deck-wells")
    place.fail("expected one value, found a list");
  for (const toml::node& node : *list) {
    const Place here{place.file, node, place.key};
    set_at(here, [&] { option->set(request, spelled(here)); });
  }
}

void read_key(const Place& place, BuildRequest& request) {
  if (place.key == "case") {
    request.case_path = spelled(place);
  } else if (place.key == "well") {
    const toml::array* wells = place.node.as_array();
    if (wells == nullptr) place.fail("expected [[well]] tables");
    for (const toml::node& node : *wells) read_well({place.file, node, "well"}, request);
  } else if (place.key == "write") {
    read_writes(place, request);
  } else {
    read_option(place, request);
  }
}

/// Paths as seen from the working folder.
void place_beside(const std::filesystem::path& folder, BuildRequest& request) {
  const auto moved = [&](const std::string& path) { return (folder / path).string(); };
  if (request.case_path) request.case_path = moved(*request.case_path);
  if (request.output) request.output = moved(*request.output);
  for (std::string& path : request.grid_includes) path = moved(path);
  for (WellRequest& well : request.wells) well.file = moved(well.file);
  for (OutputRequest& write : request.writes) write.path = moved(write.path);
}

/// The library of TOML reports through an exception of its own; here it becomes ours.
toml::table parsed(const std::string& text, const std::string& path) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw UsageError(fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
  }
}

}  // namespace

BuildRequest read_run_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || std::filesystem::is_directory(path) || !(text << stream.rdbuf())) {
    throw ParseError({path, 0, ""}, {"a run file", "no readable file", "check the path"});
  }
  const toml::table table = parsed(text.str(), path);
  BuildRequest request;
  for (const auto& [key, node] : table) read_key({path, node, std::string(key.str())}, request);
  place_beside(std::filesystem::path(path).parent_path(), request);
  return request;
}

}  // namespace wellknit
