// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What `wellknit build` is asked to do, as the command line and a run file give it. One table of options serves both.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithm/build_mesh.h"
#include "cli/progress.h"
#include "model/well.h"
#include "readers/read_trajectory.h"
#include "writers/formats.h"

namespace wellknit {

/// The radial mesh as far as the user chose it; lengths in metres.
struct RadialChoice {
  std::optional<double> radius;
  std::optional<double> bore;
  std::optional<int> sectors;
  std::optional<int> rings;
  std::optional<double> growth;  ///< ratio of successive ring widths; 0: radii in geometric progression
  std::optional<int> segments;
  std::optional<MeshMode> mode;
};

/// A trajectory file and what its wells get. Measured depths in metres.
struct WellRequest {
  std::string file;
  std::optional<std::string> name;
  RadialChoice radial;
  std::optional<double> from;
  std::optional<double> to;
  std::optional<double> skin;
  WellHead head;  ///< of a survey whose file leaves it out
};

struct OutputRequest {
  std::string format;  ///< a name of the table of writers; "hdf5" for -o
  std::string path;
  WriterOptions options = {};  ///< of that format
};

/// By a name of the table of writers. Throws UsageError with all names where there is none of this one.
const WriterFormat& format_named(const std::string& name);

/// Sets what `key=value` of an output says. Throws UsageError, with the format's keys where it has none of this name.
void set_output_key(OutputRequest& output, std::string_view key, const std::string& value);

/// `FORMAT=PATH[,key=value…]`; a comma that is followed by no `key=` is part of the path. Throws UsageError.
OutputRequest parse_write(const std::string& text);

/// `FORMAT[,key=value…]`, of the output `path`. Throws UsageError.
OutputRequest parse_format(const std::string& text, const std::string& path);

/// Empty members were not given.
struct BuildRequest {
  std::optional<std::string> case_path;
  std::vector<std::string> grid_includes;
  std::vector<WellRequest> wells;
  std::vector<std::string> deck_wells;  ///< names, or the one word "all"
  RadialChoice radial;                  ///< for every well that does not say otherwise
  std::optional<MappingMethod> mapping;
  std::optional<int> refinement_levels;  ///< 0 off, -1 auto
  std::optional<FaultPolicy> fault_policy;
  std::optional<double> heal_throw;  ///< m
  std::optional<Fluxes> fluxes;
  std::optional<Optimisation> optimise;
  std::optional<Metric> metric;
  std::optional<int> split;
  std::vector<OutputRequest> writes;
  std::optional<std::string> output;
  std::optional<std::string> report;  ///< the quality report, a page
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<int> threads;
  bool overwrite = false;
  bool quiet = false;
  bool json = false;
  bool strict = false;
};

/// An option of `build`: `--name VALUE` on the command line, `name = VALUE` in a run file.
struct BuildOption {
  enum class Kind { value, list, flag };
  const char* name;
  const char* placeholder;
  const char* description;
  Kind kind;
  /// Takes one value (a flag's is "true" or "false"). Throws UsageError: `expected …, found …`.
  void (*set)(BuildRequest& request, const std::string& value);
};

/// Every option except CASE, which is no option.
std::span<const BuildOption> build_options();

/// Takes `key=value` of a well. Throws UsageError.
void set_well_key(WellRequest& well, std::string_view key, const std::string& value);

/// `FILE[,key=value…]`; a comma inside the file's name is part of it. Throws UsageError.
WellRequest parse_well(const std::string& text);

/// `given` where it says something, else `fallback`. A list that is given replaces the other list.
BuildRequest overlay(const BuildRequest& given, const BuildRequest& fallback);

/// Throws UsageError when the request lacks a case or an output, or contradicts itself.
void validate(const BuildRequest& request);

/// The options of a well's radial mesh: the well's own choice, else the choice for all, else what `start` has.
RadialOptions resolve(const RadialChoice& own, const RadialChoice& all, const RadialOptions& start);

/// What determines the mesh, as a run file: the same mesh comes from it on any machine. Outputs and threads are left
/// out.
std::string config_text(const BuildRequest& request);

std::string_view name_of(MeshMode mode);
std::string_view name_of(MappingMethod mapping);
std::string_view name_of(FaultPolicy policy);

}  // namespace wellknit
