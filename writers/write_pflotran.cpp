// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// PFLOTRAN takes a connection's transmissibility as area / (d1 / k1 + d2 / k2): d1 and d2 are the parts of the line
/// between the centres on either side of the point that the file gives, k1 and k2 the tensors' permeabilities along it.

#include "writers/write_pflotran.h"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>

#include "model/errors.h"
#include "writers/boundary_patches.h"
#include "writers/hdf5_file.h"
#include "writers/text_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

/// Height instead of depth.
Vec3 up(const Vec3& p) { return {p.x(), p.y(), 0.0 - p.z()}; }

class PflotranFolder {
 public:
  PflotranFolder(const Mesh& mesh, std::string folder, std::string shown_path, const PflotranOptions& options)
      : mesh_(mesh), folder_(std::move(folder)), shown_path_(std::move(shown_path)), options_(options) {
    std::vector<std::string> names;
    for (const MeshWell& well : mesh_.wells) names.push_back("well_" + well.name);
    well_regions_ = plain_words(names);
  }

  void write() {
    std::error_code error;
    std::filesystem::create_directories(folder_ + "/regions", error);
    if (error) throw WriteError(fmt::format("{}: cannot be written: {}", shown_path_, error.message()));
    if (options_.grid == PflotranGrid::text)
      grid_text();
    else
      grid_hdf5();
    properties();
    well_files();
    boundaries();
    cards();
  }

  /// What must be said, after write().
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> out;
    if (closed_ > 0)
      out.push_back(fmt::format(
          "{} connections have a transmissibility that no area gives (no permeability on a side, or no distance); "
          "PFLOTRAN will have none there",
          closed_));
    if (options_.areas == AreaKind::raw)
      out.push_back("the areas are the faces' own: angles and multipliers are not in PFLOTRAN's transmissibilities");
    return out;
  }

 private:
  struct Link {
    Vec3 point;
    double area;
  };

  Link link(ConnectionId connection) {
    const CentreLine line = centre_line(mesh_, connection);
    if (options_.areas == AreaKind::raw) return {up(line.crossing), mesh_.connections.area[connection]};
    const auto& [a, b] = mesh_.connections.cells[connection];
    const double transmissibility = mesh_.connections.transmissibility[connection];
    const double area =
        effective_area(transmissibility, line, permeability_along(mesh_.cells.permeability[a], line.direction),
                       permeability_along(mesh_.cells.permeability[b], line.direction));
    closed_ += transmissibility > 0.0 && area == 0.0 ? 1 : 0;
    return {up(line.crossing), area};
  }

  [[nodiscard]] TextFile file(const std::string& name) const { return {folder_ + "/" + name, shown_path_}; }

  void grid_text() {
    TextFile out = file("mesh.uge");
    out.print("CELLS {}\n", mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      out.integer(static_cast<std::int64_t>(c) + 1);
      out.text(" ");
      out.point(up(mesh_.cells.center[CellId(c)]));
      out.text(" ");
      out.number(mesh_.cells.volume[CellId(c)]);
      out.end_line();
    }
    out.print("CONNECTIONS {}\n", mesh_.connections.size());
    for (std::size_t n = 0; n < mesh_.connections.size(); ++n) {
      const auto& [a, b] = mesh_.connections.cells[ConnectionId(n)];
      const Link found = link(ConnectionId(n));
      out.integer(a.value() + 1);
      out.text(" ");
      out.integer(b.value() + 1);
      out.text(" ");
      out.point(found.point);
      out.text(" ");
      out.number(found.area);
      out.end_line();
    }
    out.close();
  }

  void grid_hdf5() {
    const hdf5::Silence silence;
    Hdf5File out(folder_ + "/mesh.h5", shown_path_);
    for (const char* group : {"Domain", "Domain/Cells", "Domain/Connections"}) out.group(group);
    std::vector<Vec3> points;
    points.reserve(std::max(mesh_.cells.size(), mesh_.connections.size()));
    for (const Vec3& center : mesh_.cells.center) points.push_back(up(center));
    out.array("Domain/Cells/Centers", points);
    out.array("Domain/Cells/Volumes", mesh_.cells.volume.raw());
    points.clear();
    std::vector<double> areas;
    std::vector<std::array<std::int32_t, 2>> pairs;
    areas.reserve(mesh_.connections.size());
    pairs.reserve(mesh_.connections.size());
    for (std::size_t n = 0; n < mesh_.connections.size(); ++n) {
      const Link found = link(ConnectionId(n));
      const auto& [a, b] = mesh_.connections.cells[ConnectionId(n)];
      points.push_back(found.point);
      areas.push_back(found.area);
      pairs.push_back({static_cast<std::int32_t>(a.value() + 1), static_cast<std::int32_t>(b.value() + 1)});
    }
    out.array("Domain/Connections/Cell Ids", pairs);
    out.array("Domain/Connections/Centers", points);
    out.array("Domain/Connections/Areas", areas);
    out.finish();
  }

  void properties() const {
    const hdf5::Silence silence;
    Hdf5File out(folder_ + "/properties.h5", shown_path_);
    const Cells& cells = mesh_.cells;
    std::vector<std::int32_t> ids(cells.size());
    std::iota(ids.begin(), ids.end(), 1);
    out.array("Cell Ids", ids);
    std::vector<double> values(cells.size());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (std::size_t c = 0; c < cells.size(); ++c) values[c] = cells.permeability[CellId(c)][axis];
      out.array(std::string("Permeability") + "XYZ"[axis], values);
    }
    for (std::size_t c = 0; c < cells.size(); ++c) values[c] = cells.pore_volume[CellId(c)] / cells.volume[CellId(c)];
    out.array("Porosity", values);
    // Which part of the mesh a cell belongs to, as material 1 to 4.
    out.group("Materials");
    out.array("Materials/Cell Ids", ids);
    for (std::size_t c = 0; c < cells.size(); ++c) ids[c] = static_cast<std::int32_t>(cells.kind[CellId(c)]) + 1;
    out.array("Materials/Material Ids", ids);
    out.finish();
  }

  void well_files() const {
    for (std::size_t w = 0; w < mesh_.wells.size(); ++w) {
      TextFile out = file("regions/" + well_regions_[w] + ".vs");
      for (const WellConnection& connection : cells_of_well(mesh_.wells[WellId(w)])) {
        out.integer(connection.cell.value() + 1);
        out.end_line();
      }
      out.close();
    }
    TextFile table = file("wells.csv");
    write_well_table(table, mesh_, 1);
    table.close();
  }

  void boundaries() {
    for (const BoundaryPatch& patch : boundary_patches(mesh_)) {
      boundary_regions_.push_back(patch.name);
      TextFile out = file("regions/" + patch.name + ".ex");
      out.print("CONNECTIONS {}\n", patch.faces.size());
      for (const FaceId face : patch.faces) {
        out.integer(mesh_.faces.cells[face][0].value() + 1);
        out.text(" ");
        out.point(up(face_geometry(mesh_, face).centroid));
        out.text(" ");
        out.number(boundary_area(mesh_, face, options_.areas));
        out.end_line();
      }
      out.close();
    }
  }

  /// The cards that name the files, for the input deck of a run.
  void cards() const {
    TextFile out = file("cards.in");
    out.print("GRID\n  TYPE UNSTRUCTURED_EXPLICIT {}\n  UPWIND_FRACTION_METHOD FACE_CENTER_PROJECTION\nEND\n\n",
              options_.grid == PflotranGrid::text ? "mesh.uge" : "mesh.h5");
    for (const char* name : {"PermeabilityX", "PermeabilityY", "PermeabilityZ", "Porosity"})
      out.print("DATASET {0}\n  FILENAME properties.h5\n  HDF5_DATASET_NAME {0}\nEND\n\n", name);
    // PFLOTRAN appends X, Y and Z to the dataset's name.
    out.text(
        "MATERIAL_PROPERTY rock\n  ID 1\n  POROSITY DATASET Porosity\n  PERMEABILITY\n    ANISOTROPIC\n"
        "    DATASET Permeability\n  END\nEND\n\n");
    for (const std::string& name : well_regions_) out.print("REGION {0}\n  FILE regions/{0}.vs\nEND\n\n", name);
    for (const std::string& name : boundary_regions_) out.print("REGION {0}\n  FILE regions/{0}.ex\nEND\n\n", name);
    out.close();
  }

  const Mesh& mesh_;
  std::string folder_;
  std::string shown_path_;
  PflotranOptions options_;
  std::vector<std::string> well_regions_;
  std::vector<std::string> boundary_regions_;
  std::int64_t closed_ = 0;
};

}  // namespace

std::vector<std::string> write_pflotran(const Mesh& mesh, const std::string& path, const PflotranOptions& options,
                                        Overwrite overwrite) {
  OutputFile folder(path, overwrite, pflotran_contents);
  PflotranFolder out(mesh, folder.temporary_path(), path, options);
  out.write();
  folder.commit();
  return out.notes();
}

}  // namespace wellknit
