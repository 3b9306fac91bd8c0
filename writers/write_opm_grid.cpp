// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_opm_grid.h"

#include "model/mesh_topology.h"
#include "writers/connection_notes.h"
#include "writers/text_file.h"

namespace wellknit {

namespace {

class OpmGridText {
 public:
  OpmGridText(const Mesh& mesh, const OpmGridOptions& options, TextFile& out)
      : mesh_(mesh),
        points_(options.cell_point == CellPoint::center ? mesh.cells.center : mesh.cells.centroid),
        cell_faces_(faces_of_cells(mesh)),
        out_(out) {}

  /// The order is that of read_grid().
  void write() {
    sizes();
    for (const Vec3& p : mesh_.vertices) line_of(p);
    loops();
    face_cells();
    face_geometry();
    faces_of_each_cell();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) line_of(static_cast<std::int64_t>(c));  // global_cell
    for (const double volume : mesh_.cells.volume) line_of(volume);
    for (const Vec3& p : points_) line_of(p);
  }

 private:
  void line_of(const Vec3& p) {
    out_.point(p);
    out_.end_line();
  }
  void line_of(double value) {
    out_.number(value);
    out_.end_line();
  }
  void line_of(std::int64_t value) {
    out_.integer(value);
    out_.end_line();
  }

  void sizes() {
    out_.print("3 {} {} {} {} {}\n", mesh_.cells.size(), mesh_.faces.size(), mesh_.vertices.size(),
               mesh_.faces.vertices.size(), cell_faces_.faces.size());
    // No tags of the faces' directions; with the index of each cell in a grid of N x 1 x 1.
    out_.print("0 1\n{} 1 1\n", mesh_.cells.size());
  }

  void loops() {
    for (const std::int64_t start : mesh_.faces.vertex_start) line_of(start);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      std::string_view gap;
      for (const VertexId vertex : mesh_.faces.loop(FaceId(f))) {
        out_.text(gap);
        out_.integer(vertex.value());
        gap = " ";
      }
      out_.end_line();
    }
  }

  void face_cells() {
    for (const auto& [first, second] : mesh_.faces.cells) {
      out_.integer(first.value());
      out_.text(" ");
      out_.integer(second.value());  // none is -1 here too
      out_.end_line();
    }
  }

  /// Computed three times rather than kept: that takes less than a tenth of the time, and keeping it a third of the
  /// mesh's memory.
  void face_geometry() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) line_of(geometry(f).area);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) line_of(geometry(f).centroid);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) line_of(geometry(f).area_vector);
  }
  PolygonGeometry geometry(std::size_t face) { return polygon_geometry(face_points(mesh_, FaceId(face), buffer_)); }

  void faces_of_each_cell() {
    for (const std::int64_t start : cell_faces_.start) line_of(start);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      std::string_view gap;
      for (const CellFace& side : cell_faces_.of(CellId(c))) {
        out_.text(gap);
        out_.integer(side.face.value());
        gap = " ";
      }
      out_.end_line();
    }
  }

  const Mesh& mesh_;
  const IdVector<CellId, Vec3>& points_;
  CellFaces cell_faces_;
  std::vector<Vec3> buffer_;
  TextFile& out_;
};

}  // namespace

std::vector<std::string> write_opm_grid(const Mesh& mesh, const std::string& path, const OpmGridOptions& options,
                                        Overwrite overwrite) {
  OutputFile file(path, overwrite);
  TextFile out(file.temporary_path(), path);
  OpmGridText(mesh, options, out).write();
  out.close();
  file.commit();
  return notes_of_geometry(mesh, "the OPM grid", "the OPM grid");
}

}  // namespace wellknit
