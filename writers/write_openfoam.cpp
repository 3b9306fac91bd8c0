// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Turning depth into height mirrors the mesh: a right-hand normal of (x, y, depth) is a left-hand one of (x, y,
/// height). A face whose owner is its first cell is therefore written backwards, and one whose owner is its second as
/// it stands.

#include "writers/write_openfoam.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "model/errors.h"
#include "writers/boundary_patches.h"
#include "writers/connection_notes.h"
#include "writers/foam_file.h"

namespace wellknit {

namespace {

struct OrderedFace {
  CellId owner;
  CellId neighbour;  ///< none on the boundary
  FaceId face;
  bool is_turned;  ///< written backwards: the owner is its first cell

  friend auto operator<=>(const OrderedFace&, const OrderedFace&) = default;
};

/// The faces in OpenFOAM's order.
struct FaceOrder {
  std::vector<OrderedFace> faces;  ///< those between two cells by (owner, neighbour), then patch by patch by owner
  std::size_t inner = 0;           ///< how many lie between two cells
  std::vector<std::size_t> ends;   ///< of each patch in `faces`
};

OrderedFace ordered(const Mesh& mesh, FaceId face) {
  const auto& [a, b] = mesh.faces.cells[face];
  return !b.is_valid() || a < b ? OrderedFace{a, b, face, true} : OrderedFace{b, a, face, false};
}

FaceOrder face_order(const Mesh& mesh, const std::vector<BoundaryPatch>& patches) {
  // Sorted by owner by counting; the few faces of one owner by comparison.
  std::vector<std::size_t> start(mesh.cells.size() + 1, 0);
  for (const auto& [a, b] : mesh.faces.cells)
    if (b.is_valid()) ++start[std::min(a, b).index() + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  FaceOrder out;
  out.inner = start.back();
  out.faces.resize(mesh.faces.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const OrderedFace face = ordered(mesh, FaceId(f));
    if (face.neighbour.is_valid()) out.faces[next[face.owner.index()]++] = face;
  }
  const auto at = [&](std::size_t place) { return out.faces.begin() + static_cast<std::ptrdiff_t>(place); };
  for (std::size_t c = 0; c + 1 < start.size(); ++c) std::sort(at(start[c]), at(start[c + 1]));

  std::size_t end = out.inner;
  for (const BoundaryPatch& patch : patches) {
    const std::size_t first = end;
    for (const FaceId face : patch.faces) out.faces[end++] = ordered(mesh, face);
    std::sort(at(first), at(end));
    out.ends.push_back(end);
  }
  return out;
}

/// A set of cells or faces with a name.
template <class Id>
struct Zone {
  std::string name;
  std::vector<Id> members;
};

/// Every cell in one zone: by its kind, and radial cells by their well.
std::vector<Zone<CellId>> cell_zones(const Mesh& mesh) {
  std::vector<std::string> names{"host", "refined", "transition", "radial"};
  for (const MeshWell& well : mesh.wells) names.push_back("radial_" + well.name);
  std::vector<Zone<CellId>> zones;
  for (std::string& name : plain_words(names)) zones.push_back({std::move(name), {}});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto kind = static_cast<std::size_t>(mesh.cells.kind[CellId(c)]);
    const WellId well = mesh.cells.well[CellId(c)];
    const bool has_well = mesh.cells.kind[CellId(c)] == CellKind::radial && well.is_valid();
    zones[has_well ? 4 + well.index() : kind].members.push_back(CellId(c));
  }
  std::erase_if(zones, [](const Zone<CellId>& zone) { return zone.members.empty(); });
  return zones;
}

class OpenFoamCase {
 public:
  OpenFoamCase(const Mesh& mesh, std::string folder, std::string shown_path)
      : mesh_(mesh),
        folder_(std::move(folder)),
        shown_path_(std::move(shown_path)),
        patches_(boundary_patches(mesh)),
        order_(face_order(mesh, patches_)) {}

  void write() {
    make_folders();
    points();
    faces();
    owner();
    neighbour();
    boundary();
    write_cell_zones();
    write_face_zones();
    permeability();
    porosity();
    system();
  }

 private:
  [[nodiscard]] FoamFile file(const std::string& name, std::string_view foam_class, std::string_view note = {}) const {
    return {folder_, name, foam_class, shown_path_, note};
  }

  void make_folders() const {
    std::error_code error;
    for (const char* name : {"/0", "/constant/polyMesh", "/system"}) {
      std::filesystem::create_directories(folder_ + name, error);
      if (error) throw WriteError(fmt::format("{}: cannot be written: {}", shown_path_, error.message()));
    }
  }

  static void begin_list(FoamFile& out, std::size_t size) { out.print("{}\n(\n", size); }

  void points() const {
    FoamFile out = file("constant/polyMesh/points", "vectorField");
    begin_list(out, mesh_.vertices.size());
    for (const Vec3& p : mesh_.vertices) {
      out.text("(");
      out.number(p.x());
      out.text(" ");
      out.number(p.y());
      out.text(" ");
      out.number(-p.z());
      out.text(")");
      out.end_line();
    }
    out.text(")\n");
    out.close();
  }

  void faces() const {
    FoamFile out = file("constant/polyMesh/faces", "faceList");
    begin_list(out, order_.faces.size());
    constexpr std::size_t ahead = 16;  // faces: about a microsecond
    const auto& start = mesh_.faces.vertex_start;
    for (std::size_t n = 0; n < order_.faces.size(); ++n) {
      // The loops lie in another order than they are written in: without this, half of the time is waiting for memory.
      // (Not in a function of its own: g++ 12 takes one that only fetches for one without an effect.)
      if (n + 2 * ahead < order_.faces.size()) {
        __builtin_prefetch(&start[order_.faces[n + 2 * ahead].face.index()]);
        __builtin_prefetch(mesh_.faces.loop(order_.faces[n + ahead].face).data());
      }
      const OrderedFace& ordered_face = order_.faces[n];
      const auto loop = mesh_.faces.loop(ordered_face.face);
      out.integer(static_cast<std::int64_t>(loop.size()));
      out.text("(");
      out.integer(loop.front().value());
      for (std::size_t i = 1; i < loop.size(); ++i) {
        out.text(" ");
        out.integer(loop[ordered_face.is_turned ? loop.size() - i : i].value());
      }
      out.text(")");
      out.end_line();
    }
    out.text(")\n");
    out.close();
  }

  void owner() const {
    const std::string note = fmt::format("nPoints: {} nCells: {} nFaces: {} nInternalFaces: {}", mesh_.vertices.size(),
                                         mesh_.cells.size(), order_.faces.size(), order_.inner);
    FoamFile out = file("constant/polyMesh/owner", "labelList", note);
    begin_list(out, order_.faces.size());
    for (const OrderedFace& face : order_.faces) {
      out.integer(face.owner.value());
      out.end_line();
    }
    out.text(")\n");
    out.close();
  }

  void neighbour() const {
    FoamFile out = file("constant/polyMesh/neighbour", "labelList");
    begin_list(out, order_.inner);
    for (std::size_t f = 0; f < order_.inner; ++f) {
      out.integer(order_.faces[f].neighbour.value());
      out.end_line();
    }
    out.text(")\n");
    out.close();
  }

  void boundary() const {
    FoamFile out = file("constant/polyMesh/boundary", "polyBoundaryMesh");
    begin_list(out, patches_.size());
    std::size_t start = order_.inner;
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      out.print("    {}\n    {{\n        type            patch;\n", patches_[p].name);
      out.print("        nFaces          {};\n        startFace       {};\n    }}\n", order_.ends[p] - start, start);
      start = order_.ends[p];
    }
    out.text(")\n");
    out.close();
  }

  void write_cell_zones() const {
    const auto zones = cell_zones(mesh_);
    FoamFile out = file("constant/polyMesh/cellZones", "regIOobject");
    begin_list(out, zones.size());
    for (const auto& [name, cells] : zones) {
      out.print("{}\n{{\n    type cellZone;\n    cellLabels List<label>\n{}\n(\n", name, cells.size());
      for (const CellId cell : cells) {
        out.integer(cell.value());
        out.end_line();
      }
      out.text(");\n}\n");
    }
    out.text(")\n");
    out.close();
  }

  /// The faces where a fault's two sides touch.
  void write_face_zones() const {
    std::vector<bool> is_fault(mesh_.faces.size(), false);
    for (std::size_t n = 0; n < mesh_.connections.size(); ++n) {
      const FaceId face = mesh_.connections.face[ConnectionId(n)];
      if (mesh_.connections.kind[ConnectionId(n)] == ConnectionKind::fault && face.is_valid())
        is_fault[face.index()] = true;
    }
    std::vector<std::size_t> places;
    for (std::size_t f = 0; f < order_.inner; ++f)
      if (is_fault[order_.faces[f].face.index()]) places.push_back(f);
    if (places.empty()) return;
    FoamFile out = file("constant/polyMesh/faceZones", "regIOobject");
    out.print("1\n(\nfault\n{{\n    type faceZone;\n    faceLabels List<label>\n{}\n(\n", places.size());
    for (const std::size_t place : places) {
      out.integer(static_cast<std::int64_t>(place));
      out.end_line();
    }
    out.print(");\n    flipMap List<bool> {}{{0}};\n}}\n)\n", places.size());
    out.close();
  }

  static void boundary_field(FoamFile& out) {
    out.text(")\n;\n\nboundaryField\n{\n    \".*\"\n    {\n        type            zeroGradient;\n    }\n}\n");
  }

  void permeability() const {
    FoamFile out = file("0/K", "volTensorField");
    out.print("dimensions      [0 2 0 0 0 0 0];\n\ninternalField   nonuniform List<tensor>\n");
    begin_list(out, mesh_.cells.size());
    for (const Vec3& k : mesh_.cells.permeability) {
      out.text("(");
      out.number(k.x());
      out.text(" 0 0 0 ");
      out.number(k.y());
      out.text(" 0 0 0 ");
      out.number(k.z());
      out.text(")");
      out.end_line();
    }
    boundary_field(out);
    out.close();
  }

  /// Such that porosity times volume is the pore volume.
  void porosity() const {
    FoamFile out = file("0/porosity", "volScalarField");
    out.print("dimensions      [0 0 0 0 0 0 0];\n\ninternalField   nonuniform List<scalar>\n");
    begin_list(out, mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      out.number(mesh_.cells.pore_volume[CellId(c)] / mesh_.cells.volume[CellId(c)]);
      out.end_line();
    }
    boundary_field(out);
    out.close();
  }

  void system() const {
    FoamFile control = file("system/controlDict", "dictionary");
    control.text(
        "startFrom       startTime;\nstartTime       0;\nstopAt          endTime;\nendTime         1;\n"
        "deltaT          1;\nwriteControl    timeStep;\nwriteInterval   1;\nwriteFormat     ascii;\n"
        "writePrecision  16;\n");
    control.close();
    FoamFile schemes = file("system/fvSchemes", "dictionary");
    schemes.text(
        "ddtSchemes\n{\n    default         steadyState;\n}\ngradSchemes\n{\n    default         Gauss linear;\n}\n"
        "divSchemes\n{\n    default         none;\n}\n"
        "laplacianSchemes\n{\n    default         Gauss linear corrected;\n}\n"
        "interpolationSchemes\n{\n    default         linear;\n}\nsnGradSchemes\n{\n    default         "
        "corrected;\n}\n");
    schemes.close();
    FoamFile solution = file("system/fvSolution", "dictionary");
    solution.text("solvers\n{\n}\n");
    solution.close();
    // ParaView opens the case by an empty file with this extension.
    TextFile(folder_ + "/case.foam", shown_path_).close();
  }

  const Mesh& mesh_;
  std::string folder_;
  std::string shown_path_;
  std::vector<BoundaryPatch> patches_;
  FaceOrder order_;
};

}  // namespace

std::vector<std::string> write_openfoam(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputFile folder(path, overwrite, openfoam_contents);
  OpenFoamCase(mesh, folder.temporary_path(), path).write();
  folder.commit();
  return notes_of_geometry(mesh, "the polyMesh", "the OpenFOAM case");
}

}  // namespace wellknit
