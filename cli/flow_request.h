// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What `wellknit solve` is asked to do, and the problem that it makes of a mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algorithm/steady_flow.h"
#include "readers/read_value_table.h"

namespace wellknit {

/// As the command line gives it.
struct FlowRequest {
  std::vector<std::string> wells;    ///< NAME=VALUE
  std::string producers = "100bar";  ///< of wells that are not named
  std::string injectors = "300bar";
  std::vector<std::string> boundaries;  ///< SIDES=VALUE
  std::string field;                    ///< P0,GX,GY,GZ
  std::string hold;                     ///< a table of values
  std::string viscosity = "1";          ///< cP
  std::string density;                  ///< kg/m3; empty: no gravity
  std::string datum;                    ///< m
  std::string expansion;
  std::string solver = "auto";
  std::string fluxes = "two-point";
};

/// A pressure that changes linearly in space, Pa and Pa/m.
struct PressureField {
  double at_origin = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< along x, y, depth
  [[nodiscard]] double at(const Vec3& point) const { return at_origin + gradient.dot(point); }
};

/// A request whose every value has been understood; nothing of a mesh is needed for it.
struct FlowSetting {
  struct NamedControl {
    std::string pattern;
    WellControl control;
  };
  struct Side {
    std::string name;                ///< i-, i+, j-, j+, k-, k+ or all
    std::optional<double> pressure;  ///< Pa; nothing: the field
  };
  std::vector<NamedControl> wells;
  WellControl producers;
  WellControl injectors;
  std::vector<Side> sides;
  std::optional<PressureField> field;
  std::optional<ValueTable> hold;
  double viscosity = 1e-3;      ///< Pa s
  double density = 0.0;         ///< kg/m3
  std::optional<double> datum;  ///< m
  double expansion = 0.0;       ///< m3/s
  PressureMethod method = PressureMethod::automatic;
  bool consistent = false;  ///< multi-point fluxes
};

/// Throws UsageError, and ParseError for the table.
FlowSetting understand(const FlowRequest& request);

struct FlowProblem {
  SteadyFlowProblem problem;
  double datum = 0.0;  ///< m, where constant pressures hold when there is gravity
  std::vector<std::string> notes;
};

/// Throws UsageError for a well or a side that the mesh does not have.
FlowProblem make_problem(const FlowSetting& setting, const Mesh& mesh);

}  // namespace wellknit
