// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_dgf.h"

#include "model/mesh_topology.h"
#include "writers/connection_notes.h"
#include "writers/text_file.h"

namespace wellknit {

namespace {

/// A line of ids.
template <class Ids, class Get>
void line_of(TextFile& out, const Ids& ids, const Get& get) {
  std::string_view gap;
  for (const auto& id : ids) {
    out.text(gap);
    out.integer(get(id).value());
    gap = " ";
  }
  out.end_line();
}

}  // namespace

std::vector<std::string> write_dgf(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputFile file(path, overwrite);
  TextFile out(file.temporary_path(), path);
  out.text("DGF\nVertex\n");
  for (const Vec3& p : mesh.vertices) {
    out.point(p);
    out.end_line();
  }
  out.text("#\nPolygon\n");
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    line_of(out, mesh.faces.loop(FaceId(f)), [](VertexId vertex) { return vertex; });
  out.text("#\nPolyhedron\n");
  const CellFaces faces = faces_of_cells(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    line_of(out, faces.of(CellId(c)), [](const CellFace& side) { return side.face; });
  out.text("#\n");
  out.close();
  file.commit();
  return notes_of_geometry(mesh, "the DGF file", "the DGF file");
}

}  // namespace wellknit
