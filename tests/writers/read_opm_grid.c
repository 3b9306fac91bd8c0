/* SPDX-FileCopyrightText: 2026 The wellknit authors
   SPDX-License-Identifier: GPL-3.0-or-later */

/* Has OPM read a grid and prints what it got, one array a line: name, count, values. */

#include <opm/grid/UnstructuredGrid.h>
#include <stdio.h>

static void reals(const char* name, const double* values, size_t count) {
  printf("%s %zu", name, count);
  for (size_t i = 0; i < count; ++i) printf(" %.17g", values[i]);
  printf("\n");
}

static void integers(const char* name, const int* values, size_t count) {
  printf("%s %zu", name, count);
  for (size_t i = 0; i < count; ++i) printf(" %d", values[i]);
  printf("\n");
}

int main(int count, char** arguments) {
  struct UnstructuredGrid* grid = count == 2 ? read_grid(arguments[1]) : NULL;
  if (grid == NULL) {
    fprintf(stderr, "usage: read_opm_grid FILE, one that read_grid() takes\n");
    return 1;
  }
  const size_t cells = (size_t)grid->number_of_cells;
  const size_t faces = (size_t)grid->number_of_faces;
  reals("nodes", grid->node_coordinates, 3 * (size_t)grid->number_of_nodes);
  integers("face_nodepos", grid->face_nodepos, faces + 1);
  integers("face_nodes", grid->face_nodes, (size_t)grid->face_nodepos[faces]);
  integers("face_cells", grid->face_cells, 2 * faces);
  reals("face_areas", grid->face_areas, faces);
  reals("face_centroids", grid->face_centroids, 3 * faces);
  reals("face_normals", grid->face_normals, 3 * faces);
  integers("cell_facepos", grid->cell_facepos, cells + 1);
  integers("cell_faces", grid->cell_faces, (size_t)grid->cell_facepos[cells]);
  integers("global_cell", grid->global_cell, cells);
  integers("cartdims", grid->cartdims, 3);
  reals("cell_volumes", grid->cell_volumes, cells);
  reals("cell_centroids", grid->cell_centroids, 3 * cells);
  destroy_grid(grid);
  return 0;
}
