// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What is in a deck, grid, well or mesh file: the content of `wellknit info`.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/case.h"
#include "model/geometry.h"
#include "model/grid_validity.h"
#include "model/well.h"
#include "readers/exported_mesh.h"

namespace wellknit {

/// Smallest and largest value over the active cells.
struct PropertyRange {
  std::string name;
  double least = 0.0;
  double most = 0.0;
  std::string unit;  ///< "mD", "1", or empty: as in the source
};

struct FaultDescription {
  std::string name;
  std::int64_t faces = 0;
  double multiplier = 1.0;  ///< of MULTFLT
};

/// What a deck says about connections and pore volumes: counts of its records, names of its arrays.
struct EditsDescription {
  std::vector<FaultDescription> faults;
  std::vector<std::string> multipliers;             ///< MULTX, MULTX- …, MULTPV, MINPVV that are given
  std::int64_t region_multipliers = 0;              ///< MULTREGT
  std::int64_t region_pore_volumes = 0;             ///< MULTREGP
  std::int64_t non_neighbours = 0;                  ///< NNC
  std::int64_t edited_non_neighbours = 0;           ///< EDITNNC and EDITNNCR
  std::map<std::string, std::int64_t> array_edits;  ///< steps of EDIT on TRANX …, by array
  std::map<std::string, std::int64_t> regions;      ///< region arrays (…NUM, FIP…): how many numbers they hold
};

struct GridDescription {
  std::array<std::int64_t, 3> dimensions{};
  bool has_geometry = true;  ///< false: a file of properties alone; what follows of cells and volumes is not known
  std::int64_t active_cells = 0;
  std::int64_t inverted_cells = 0;    ///< active, with a volume of the other sign than the whole
  bool is_right_handed = true;        ///< i, j, k as stored
  double bulk_volume = 0.0;           ///< m3, active cells
  std::optional<double> pore_volume;  ///< m3; unset without porosity
  Vec3 least = Vec3::Zero();          ///< of the active cells' corners, m
  Vec3 most = Vec3::Zero();
  std::string units;  ///< METRIC, FIELD or LAB: of the source
  bool has_map_axes = false;
  bool connects_across_pinch = false;
  std::vector<PropertyRange> properties;
  EditsDescription edits;
};

struct WellDescription {
  std::string name;
  std::string parent;  ///< of a branch: its well; empty for a main bore
  int branch = 1;
  std::string type;  ///< "producer" or "injector"; empty for a trajectory file
  std::size_t stations = 0;
  double measured_depth_from = 0.0;  ///< m
  double measured_depth_to = 0.0;    ///< m
  double depth_from = 0.0;           ///< m, of the first and the last station
  double depth_to = 0.0;
  double largest_deviation = 0.0;  ///< degrees from the vertical, of any stretch
  double open_length = 0.0;        ///< m, measured depth open to flow
  std::size_t completions = 0;     ///< cells of COMPDAT
  std::size_t perforations = 0;    ///< records of COMPTRAJ
  bool is_approximate = false;     ///< a path through cell centres
};

struct MeshDescription {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::int64_t connections = 0;
  std::map<std::string, std::int64_t> cells;             ///< by kind: host, refined, transition, radial
  double bulk_volume = 0.0;                              ///< m3
  double pore_volume = 0.0;                              ///< m3
  std::map<std::string, std::int64_t> well_connections;  ///< by well
  std::string created_by;
};

struct FileDescription {
  std::string path;
  std::string format;  ///< name in the table of formats
  std::optional<GridDescription> grid;
  std::optional<MeshDescription> mesh;
  std::optional<ExportedCounts> exported;  ///< of a file for another program
  std::vector<WellDescription> wells;
  std::vector<SourceFile> sources;
  std::vector<std::string> notes;
  std::optional<GridValidity> validity;  ///< of a grid, where its caller looked at it
};

/// Reads the file, told by content. Throws ParseError as its reader does. `look_at` gets a grid before it goes.
FileDescription describe_file(const std::string& path,
                              const std::function<GridValidity(const CornerPointGrid&)>& look_at = {});

GridDescription describe(const CornerPointGrid& grid);
WellDescription describe(const Well& well);

/// Lines for people; ends with a line end.
std::string to_text(const FileDescription& description);
/// The same for machines; a value that is not finite is null.
std::string to_json(const FileDescription& description);

}  // namespace wellknit
