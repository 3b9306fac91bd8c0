// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// `wellknit build` for programs: a case and wells, piece by piece, to a mesh with its arrays. What the interfaces of
/// other languages share.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algorithm/build_mesh.h"
#include "interface/mesh_views.h"
#include "model/case.h"
#include "model/mesh.h"
#include "model/provenance.h"

namespace wellknit {

/// A mesh with what is known of it. It does not move: `views` points into `mesh`.
struct Model {
  explicit Model(Mesh its_mesh) : mesh(std::move(its_mesh)), views(mesh) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Mesh mesh;
  const MeshViews views;
  Provenance provenance;
  std::vector<WellSummary> wells;  ///< of a build; empty for a mesh that was read
  std::vector<std::string> notes;
};

/// What may be said about a well; unset options keep the defaults of RadialOptions.
struct WellOptions {
  RadialOptions radial;
  double skin = 0.0;
};

/// "auto", "layered" or "swept". Throws InvalidInput.
MeshMode mesh_mode_named(std::string_view name);

class ModelBuilder {
 public:
  /// Reads the case. Throws ParseError.
  explicit ModelBuilder(const std::string& path, const std::vector<std::string>& grid_includes = {});

  /// The wells of a trajectory file. Throws ParseError and InvalidInput.
  void add_file(const std::string& path, const WellOptions& options);
  /// Points as (x, y, depth), m; measured depths rise strictly, and are the lengths of the polyline where none are
  /// given. Throws InvalidInput.
  void add_path(const std::string& name, const std::vector<Vec3>& points, const std::vector<double>& measured_depth,
                const WellOptions& options);
  /// "all", or names separated by commas. Throws InvalidInput.
  void add_deck_wells(const std::string& names, const WellOptions& options);
  /// mapping, refine, fault-policy, heal-throw, fluxes or threads, with the values of the command line. Throws
  /// InvalidInput.
  void set(std::string_view option, const std::string& value);

  /// Throws InvalidInput.
  [[nodiscard]] std::unique_ptr<Model> build() const;

 private:
  void add(Well well, const WellOptions& options);

  std::string path_;
  Case source_;
  std::vector<Well> wells_;
  std::vector<SourceFile> files_;
  std::vector<std::string> notes_;
  BuildOptions options_;
};

/// Throws ParseError.
std::unique_ptr<Model> read_model(const std::string& path);

/// `format` as in `wellknit formats`; empty: by the path's extension. Returns notes. Throws InvalidInput and
/// WriteError.
std::vector<std::string> write_model(const Model& model, const std::string& path, const std::string& format,
                                     bool overwrite);

/// One line each; empty: valid.
std::vector<std::string> violations_of(const Model& model);
/// The figures of `wellknit check --json`.
std::string quality_json(const Model& model);

}  // namespace wellknit
