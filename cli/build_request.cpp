// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/build_request.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <array>
#include <charconv>
#include <cmath>

#include "cli/usage_error.h"

namespace wellknit {

namespace {

template <class Number>
Number number(const std::string& text, const char* expected) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(static_cast<double>(value))) {
    throw UsageError(fmt::format("expected {}, found '{}'", expected, text));
  }
  return value;
}

double length_above_zero(const std::string& text) {
  constexpr const char* expected = "a length above 0 in metres";
  const double value = number<double>(text, expected);
  if (value <= 0.0) throw UsageError(fmt::format("expected {}, found '{}'", expected, text));
  return value;
}

int count_from(int least, const std::string& text) {
  const std::string expected = fmt::format("a whole number of {} or more", least);
  const int value = number<int>(text, expected.c_str());
  if (value < least) throw UsageError(fmt::format("expected {}, found '{}'", expected, text));
  return value;
}

/// What `growth` has for radii in geometric progression.
constexpr const char* geometric_growth = "geometric";

double positive_ratio(const std::string& text) {
  constexpr const char* expected = "a ratio above 0, or geometric";
  const double value = number<double>(text, expected);
  if (value <= 0.0) throw UsageError(fmt::format("expected {}, found '{}'", expected, text));
  return value;
}

std::string not_empty(const std::string& text, const char* expected) {
  if (text.empty()) throw UsageError(fmt::format("expected {}, found nothing", expected));
  return text;
}

/// The entry of `table` that has this name.
template <class Value, std::size_t size>
Value choice(const std::string& text, const std::array<std::pair<std::string_view, Value>, size>& table) {
  std::string names;
  for (const auto& [name, value] : table) {
    if (text == name) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw UsageError(fmt::format("expected one of {}, found '{}'", names, text));
}

constexpr std::array<std::pair<std::string_view, MeshMode>, 3> mesh_modes{
    {{"auto", MeshMode::automatic}, {"layered", MeshMode::layered}, {"swept", MeshMode::swept}}};
constexpr std::array<std::pair<std::string_view, MappingMethod>, 2> mapping_methods{
    {{"auto", MappingMethod::automatic}, {"paper", MappingMethod::paper}}};
constexpr std::array<std::pair<std::string_view, FaultPolicy>, 2> fault_policies{
    {{"stop", FaultPolicy::stop}, {"heal", FaultPolicy::heal}}};

constexpr std::array<std::pair<std::string_view, Metric>, 2> metrics{
    {{"geometric", Metric::geometric}, {"permeability", Metric::permeability}}};
constexpr std::array<std::pair<std::string_view, Optimisation>, 4> optimisations{
    {{"off", Optimisation::off},
     {"on", Optimisation::on},
     {"edges", Optimisation::edges},
     {"vertices", Optimisation::vertices}}};
constexpr std::array<std::pair<std::string_view, Fluxes>, 3> flux_kinds{
    {{"two-point", Fluxes::two_point}, {"consistent", Fluxes::consistent}, {"adapted", Fluxes::adapted}}};

constexpr std::array<std::pair<std::string_view, ProgressStyle>, 3> progress_styles{
    {{"auto", ProgressStyle::automatic}, {"plain", ProgressStyle::plain}, {"off", ProgressStyle::off}}};

template <class Value, std::size_t size>
std::string_view name_in(Value value, const std::array<std::pair<std::string_view, Value>, size>& table) {
  for (const auto& [name, entry] : table) {
    if (entry == value) return name;
  }
  return "";
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// auto -1, off 0, else how often columns are split in two.
int refinement_levels(const std::string& text) {
  if (text == "auto") return -1;
  if (text == "off") return 0;
  const int levels = count_from(1, text);
  if (levels > 10) throw UsageError(fmt::format("expected auto, off or 1 to 10, found '{}'", text));
  return levels;
}

int split_parts(const std::string& text) {
  const int parts = count_from(1, text);
  if (parts > 10) throw UsageError(fmt::format("expected 1 to 10, found '{}'", text));
  return parts;
}

bool is_true(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  throw UsageError(fmt::format("expected true or false, found '{}'", text));
}

/// Where the first `,key=` of an output begins; the text's length where there is none.
std::size_t first_key(const std::string& text) {
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', comma + 1)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", comma + 1);
    if (end != std::string::npos && end > comma + 1 && text[end] == '=') return comma;
  }
  return text.size();
}

void set_output_keys(OutputRequest& output, const std::string& text) {
  for (const std::string& part : split(text, ',')) {
    const std::size_t equal = part.find('=');
    if (equal == std::string::npos) throw UsageError(fmt::format("expected key=value, found '{}'", part));
    set_output_key(output, part.substr(0, equal), part.substr(equal + 1));
  }
}

/// True where `key` is one of the radial mesh.
bool set_radial(RadialChoice& radial, std::string_view key, const std::string& value) {
  if (key == "radius") {
    radial.radius = length_above_zero(value);
  } else if (key == "bore") {
    radial.bore = length_above_zero(value);
  } else if (key == "sectors") {
    radial.sectors = count_from(3, value);
  } else if (key == "rings") {
    radial.rings = count_from(1, value);
  } else if (key == "growth") {
    radial.growth = value == geometric_growth ? 0.0 : positive_ratio(value);
  } else if (key == "segments") {
    radial.segments = count_from(1, value);
  } else if (key == "mode") {
    radial.mode = choice(value, mesh_modes);
  } else {
    return false;
  }
  return true;
}

template <std::size_t key_size>
struct Key {
  char text[key_size]{};
  // NOLINTNEXTLINE: a string as a template argument needs the implicit conversion
  constexpr Key(const char (&from)[key_size]) { std::copy(from, from + key_size, text); }
};

/// The setter of the option for all wells that has a well key's name.
template <Key key>
void set_default(BuildRequest& request, const std::string& value) {
  set_radial(request.radial, key.text, value);
}

using Kind = BuildOption::Kind;

constexpr std::array options{
    BuildOption{
        "well", "FILE[,key=value...]",
        "A trajectory; keys: name, radius, bore, sectors, rings, growth, segments, mode, from, to, skin, x, y, kb",
        Kind::list, [](BuildRequest& r, const std::string& v) { r.wells.push_back(parse_well(v)); }},
    BuildOption{"deck-wells", "all|NAME,...", "Wells of the deck's own schedule", Kind::value,
                [](BuildRequest& r, const std::string& v) {
                  for (const std::string& name : split(not_empty(v, "all or names of wells"), ',')) {
                    r.deck_wells.push_back(not_empty(name, "the name of a well"));
                  }
                }},
    BuildOption{"grid-include", "FILE", "A further grid or property file, read after CASE", Kind::list,
                [](BuildRequest& r, const std::string& v) { r.grid_includes.push_back(not_empty(v, "a file")); }},
    BuildOption{"radius", "M", "Drainage radius of the radial meshes, m [15]", Kind::value, set_default<"radius">},
    BuildOption{"bore", "M", "Bore radius, m [0.1; a deck's well: its COMPDAT diameter]", Kind::value,
                set_default<"bore">},
    BuildOption{"sectors", "N", "Cells around a well [10; deck of several phases to deck: 6]", Kind::value,
                set_default<"sectors">},
    BuildOption{"rings", "N", "Cells from the bore to the drainage radius [5; deck of several phases to deck: 3]",
                Kind::value, set_default<"rings">},
    BuildOption{
        "growth", "RATIO|geometric",
        "Ratio of successive ring widths, or radii in geometric progression [geometric; deck of several phases to "
        "deck: 1.2]",
        Kind::value, set_default<"growth">},
    BuildOption{"segments", "N", "Cells along a swept well [one for about one drainage radius]", Kind::value,
                set_default<"segments">},
    BuildOption{"mode", "auto|layered|swept", "How the radial mesh follows the well [auto]", Kind::value,
                set_default<"mode">},
    BuildOption{"refine", "auto|off|N",
                "Splitting of the host's columns near wells: by their radii, never, or N times in two [auto]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.refinement_levels = refinement_levels(v); }},
    BuildOption{"split", "N", "For comparisons: every column in N x N parts, 1 to 10, and no meshes around wells [1]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.split = split_parts(v); }},
    BuildOption{"fault-policy", "stop|heal",
                "Small throws near wells: the wells stop there, or they are averaged out before [stop]", Kind::value,
                [](BuildRequest& r, const std::string& v) { r.fault_policy = choice(v, fault_policies); }},
    BuildOption{"heal-throw", "M",
                "With --fault-policy heal: the largest throw to heal, m [a tenth of the layers' mean thickness there]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.heal_throw = length_above_zero(v); }},
    BuildOption{"metric", "geometric|permeability",
                "The space that the mesh is made in: the real one, or with depths times sqrt(k_h / k_v) [geometric]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.metric = choice(v, metrics); }},
    BuildOption{"mapping", "auto|paper", "How the mapping is made bijective [auto]", Kind::value,
                [](BuildRequest& r, const std::string& v) { r.mapping = choice(v, mapping_methods); }},
    BuildOption{"optimise", "off|on|edges|vertices",
                "Taking out short edges of transition cells, moving inner vertices and centres for orthogonality, or "
                "both [off]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.optimise = choice(v, optimisations); }},
    BuildOption{"fluxes", "two-point|consistent|adapted",
                "Fluxes: two-point, multi-point ones beside them, or two-point ones fitted to these [two-point]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.fluxes = choice(v, flux_kinds); }},
    BuildOption{"output", "OUT.h5", "The mesh file", Kind::value,
                [](BuildRequest& r, const std::string& v) { r.output = not_empty(v, "a file"); }},
    BuildOption{"write", "FORMAT=PATH[,key=value...]",
                "A further output; `wellknit formats` lists the formats and their keys", Kind::list,
                [](BuildRequest& r, const std::string& v) { r.writes.push_back(parse_write(v)); }},
    BuildOption{"report", "REPORT.html", "The quality report as a page", Kind::value,
                [](BuildRequest& r, const std::string& v) { r.report = not_empty(v, "a file"); }},
    BuildOption{"progress", "auto|plain|off", "How far the run is: a line on a terminal, a line a step, nothing [auto]",
                Kind::value, [](BuildRequest& r, const std::string& v) { r.progress = choice(v, progress_styles); }},
    BuildOption{"threads", "N", "Threads [all]; the result does not depend on it", Kind::value,
                [](BuildRequest& r, const std::string& v) { r.threads = count_from(1, v); }},
    BuildOption{"overwrite", "", "Replace outputs that exist", Kind::flag,
                [](BuildRequest& r, const std::string& v) { r.overwrite = is_true(v); }},
    BuildOption{"quiet", "", "No summary", Kind::flag,
                [](BuildRequest& r, const std::string& v) { r.quiet = is_true(v); }},
    BuildOption{"json", "", "The summary as JSON", Kind::flag,
                [](BuildRequest& r, const std::string& v) { r.json = is_true(v); }},
    BuildOption{"strict", "", "Fail when a well cannot be meshed", Kind::flag,
                [](BuildRequest& r, const std::string& v) { r.strict = is_true(v); }},
};

template <class Value>
void take(std::optional<Value>& value, const std::optional<Value>& fallback) {
  if (!value) value = fallback;
}

template <class Value>
void take(std::vector<Value>& value, const std::vector<Value>& fallback) {
  if (value.empty()) value = fallback;
}

RadialChoice overlay(const RadialChoice& given, const RadialChoice& fallback) {
  RadialChoice out = given;
  take(out.radius, fallback.radius);
  take(out.bore, fallback.bore);
  take(out.sectors, fallback.sectors);
  take(out.rings, fallback.rings);
  take(out.growth, fallback.growth);
  take(out.segments, fallback.segments);
  take(out.mode, fallback.mode);
  return out;
}

template <class Value>
void insert(toml::table& table, std::string_view key, const std::optional<Value>& value) {
  if (value) table.insert(key, *value);
}

void insert(toml::table& table, const RadialChoice& radial) {
  insert(table, "radius", radial.radius);
  insert(table, "bore", radial.bore);
  insert(table, "sectors", radial.sectors);
  insert(table, "rings", radial.rings);
  if (radial.growth == 0.0)
    table.insert("growth", geometric_growth);
  else
    insert(table, "growth", radial.growth);
  insert(table, "segments", radial.segments);
  if (radial.mode) table.insert("mode", name_of(*radial.mode));
}

/// The defaults of RadialOptions, spelled out where they are numbers.
RadialChoice with_defaults(const RadialChoice& given) {
  const RadialOptions defaults;
  RadialChoice fallback;
  fallback.radius = defaults.drainage_radius;
  fallback.sectors = defaults.sectors;
  fallback.rings = defaults.rings;
  fallback.mode = defaults.mode;
  return overlay(given, fallback);
}

toml::array array_of(const std::vector<std::string>& values) {
  toml::array out;
  for (const std::string& value : values) out.push_back(value);
  return out;
}

}  // namespace

std::span<const BuildOption> build_options() { return options; }

void set_well_key(WellRequest& well, std::string_view key, const std::string& value) {
  if (set_radial(well.radial, key, value)) return;
  if (key == "name") {
    // The name becomes a group of the mesh file and a word in a deck.
    if (value.empty() || value.find_first_of("/'\" \t") != std::string::npos) {
      throw UsageError(fmt::format("expected a name without spaces, quotes and slashes, found '{}'", value));
    }
    well.name = value;
  } else if (key == "from") {
    well.from = number<double>(value, "a measured depth in metres");
  } else if (key == "to") {
    well.to = number<double>(value, "a measured depth in metres");
  } else if (key == "skin") {
    well.skin = number<double>(value, "a number");
  } else if (key == "x") {
    well.head.x = number<double>(value, "the x of the well's head in metres");
  } else if (key == "y") {
    well.head.y = number<double>(value, "the y of the well's head in metres");
  } else if (key == "kb") {
    well.head.datum = number<double>(value, "the elevation of the datum in metres");
  } else {
    throw UsageError(fmt::format(
        "unknown key '{}'; the keys are name, radius, bore, sectors, rings, growth, segments, mode, from, to, skin, "
        "x, y, kb",
        key));
  }
}

WellRequest parse_well(const std::string& text) {
  WellRequest well;
  const std::vector<std::string> parts = split(text, ',');
  std::size_t first_key = 1;
  well.file = parts[0];
  // A part without '=' belongs to the file's name.
  while (first_key < parts.size() && parts[first_key].find('=') == std::string::npos)
    well.file += "," + parts[first_key++];
  if (well.file.empty()) throw UsageError(fmt::format("expected FILE[,key=value...], found '{}'", text));
  for (std::size_t i = first_key; i < parts.size(); ++i) {
    const std::size_t equal = parts[i].find('=');
    if (equal == std::string::npos) throw UsageError(fmt::format("expected key=value, found '{}'", parts[i]));
    const std::string key = parts[i].substr(0, equal);
    set_well_key(well, key, parts[i].substr(equal + 1));
  }
  return well;
}

const WriterFormat& format_named(const std::string& name) {
  if (const WriterFormat* format = find_writer(name)) return *format;
  std::string names;
  for (const WriterFormat& format : writer_formats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
  throw UsageError(fmt::format("unknown format '{}'; the formats are {}", name, names));
}

void set_output_key(OutputRequest& output, std::string_view key, const std::string& value) {
  const std::string_view format = format_named(output.format).name;
  std::string names;
  for (const WriterKey& known : writer_keys(format)) {
    if (known.name == key) {
      if (known.set(output.options, value)) return;
      throw UsageError(fmt::format("{}: {}: expected {}, found '{}'", format, key, known.values, value));
    }
    names += (names.empty() ? "" : ", ") + std::string(known.name);
  }
  throw UsageError(fmt::format("{}: unknown key '{}'; {}", format, key,
                               names.empty() ? "this format has none" : "its keys are " + names));
}

OutputRequest parse_write(const std::string& text) {
  const std::size_t equal = text.find('=');
  const std::size_t keys = first_key(text);
  if (equal == std::string::npos || equal == 0 || equal + 1 >= keys) {
    throw UsageError(fmt::format("expected FORMAT=PATH[,key=value...], found '{}'", text));
  }
  OutputRequest output{text.substr(0, equal), text.substr(equal + 1, keys - equal - 1)};
  if (keys < text.size()) set_output_keys(output, text.substr(keys + 1));
  return output;
}

OutputRequest parse_format(const std::string& text, const std::string& path) {
  const std::size_t comma = text.find(',');
  OutputRequest output{text.substr(0, comma), path};
  format_named(output.format);
  if (comma != std::string::npos) set_output_keys(output, text.substr(comma + 1));
  return output;
}

BuildRequest overlay(const BuildRequest& given, const BuildRequest& fallback) {
  BuildRequest out = given;
  take(out.case_path, fallback.case_path);
  take(out.grid_includes, fallback.grid_includes);
  take(out.wells, fallback.wells);
  take(out.deck_wells, fallback.deck_wells);
  out.radial = overlay(given.radial, fallback.radial);
  take(out.mapping, fallback.mapping);
  take(out.refinement_levels, fallback.refinement_levels);
  take(out.fault_policy, fallback.fault_policy);
  take(out.heal_throw, fallback.heal_throw);
  take(out.fluxes, fallback.fluxes);
  take(out.optimise, fallback.optimise);
  take(out.metric, fallback.metric);
  take(out.split, fallback.split);
  take(out.writes, fallback.writes);
  take(out.output, fallback.output);
  take(out.report, fallback.report);
  if (out.progress == ProgressStyle::automatic) out.progress = fallback.progress;
  take(out.threads, fallback.threads);
  out.overwrite = given.overwrite || fallback.overwrite;
  out.quiet = given.quiet || fallback.quiet;
  out.json = given.json || fallback.json;
  out.strict = given.strict || fallback.strict;
  return out;
}

void validate(const BuildRequest& request) {
  if (!request.case_path) throw UsageError("no CASE given: name a deck, a grid or a run file");
  if (!request.output && request.writes.empty())
    throw UsageError("no output given: add -o OUT.h5 or --write FORMAT=PATH");
  if (request.heal_throw && request.fault_policy != FaultPolicy::heal)
    throw UsageError("--heal-throw says how far --fault-policy heal goes: add that, or leave out --heal-throw");
  for (const WellRequest& well : request.wells) {
    const RadialOptions radial = resolve(well.radial, request.radial, RadialOptions{});
    if (radial.bore_radius >= radial.drainage_radius) {
      throw UsageError(fmt::format("--well {}: the bore radius {} m is not below the drainage radius {} m", well.file,
                                   radial.bore_radius, radial.drainage_radius));
    }
    if (well.from && well.to && *well.from >= *well.to) {
      throw UsageError(fmt::format("--well {}: from={} is not above to={}", well.file, *well.from, *well.to));
    }
  }
}

RadialOptions resolve(const RadialChoice& own, const RadialChoice& all, const RadialOptions& start) {
  const RadialChoice choice = overlay(own, all);
  RadialOptions out = start;
  out.drainage_radius = choice.radius.value_or(start.drainage_radius);
  out.bore_radius = choice.bore.value_or(start.bore_radius);
  out.sectors = choice.sectors.value_or(start.sectors);
  out.rings = choice.rings.value_or(start.rings);
  if (choice.growth) out.growth = *choice.growth > 0.0 ? choice.growth : std::nullopt;
  if (choice.segments) out.segments = choice.segments;
  out.mode = choice.mode.value_or(start.mode);
  return out;
}

std::string config_text(const BuildRequest& request) {
  toml::table table;
  insert(table, "case", request.case_path);
  if (!request.grid_includes.empty()) table.insert("grid-include", array_of(request.grid_includes));
  if (!request.deck_wells.empty()) table.insert("deck-wells", array_of(request.deck_wells));
  insert(table, with_defaults(request.radial));
  table.insert("mapping", name_of(request.mapping.value_or(MappingMethod::automatic)));
  table.insert("fault-policy", name_of(request.fault_policy.value_or(FaultPolicy::stop)));
  insert(table, "heal-throw", request.heal_throw);
  table.insert("metric", name_in(request.metric.value_or(Metric::geometric), metrics));
  if (request.split.value_or(1) > 1) table.insert("split", *request.split);
  if (request.optimise) table.insert("optimise", name_in(*request.optimise, optimisations));
  if (request.fluxes.value_or(Fluxes::two_point) != Fluxes::two_point)
    table.insert("fluxes", name_in(*request.fluxes, flux_kinds));
  const int levels = request.refinement_levels.value_or(-1);
  if (levels > 0)
    table.insert("refine", levels);
  else
    table.insert("refine", levels < 0 ? "auto" : "off");
  toml::array wells;
  for (const WellRequest& well : request.wells) {
    toml::table entry;
    entry.insert("file", well.file);
    insert(entry, "name", well.name);
    insert(entry, well.radial);
    insert(entry, "from", well.from);
    insert(entry, "to", well.to);
    insert(entry, "skin", well.skin);
    insert(entry, "x", well.head.x);
    insert(entry, "y", well.head.y);
    insert(entry, "kb", well.head.datum);
    wells.push_back(std::move(entry));
  }
  if (!wells.empty()) table.insert("well", std::move(wells));
  std::ostringstream out;
  out << table << '\n';
  return out.str();
}

std::string_view name_of(MeshMode mode) { return name_in(mode, mesh_modes); }

std::string_view name_of(MappingMethod mapping) { return name_in(mapping, mapping_methods); }

std::string_view name_of(FaultPolicy policy) { return name_in(policy, fault_policies); }

}  // namespace wellknit
