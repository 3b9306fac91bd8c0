#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has OPM's read_grid() read the grids of a folder, and compares with the mesh files beside them.

    check_opm_grid.py FOLDER [READ_OPM_GRID [--geometry]]
--geometry leaves transmissibilities out: those of a corner-point host follow from its pillars, not from polygons.
Ends with 77 where the program that calls OPM could not be built (Debian package libopm-grid-dev).
"""
import pathlib
import subprocess
import sys

import numpy as np

from mesh_numbers import Faults, Mesh, meshes

EXACT = 1e-12


def read(program, path):
    done = subprocess.run([program, str(path)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{path}: OPM does not read it: {done.stderr.strip()}")
    arrays = {}
    for line in done.stdout.splitlines():
        name, count, *values = line.split()
        arrays[name] = np.array(values, float)
        assert len(values) == int(count)
    return arrays


def two_point(grid, mesh, pairs_of_faces):
    """Transmissibilities from OPM's own geometry and the permeabilities."""
    normal, middle = grid["face_normals"].reshape(-1, 3), grid["face_centroids"].reshape(-1, 3)
    center = grid["cell_centroids"].reshape(-1, 3)
    resistance = np.zeros(len(pairs_of_faces))
    for side, sign in ((0, 1), (1, -1)):
        cell = pairs_of_faces[:, side]
        to_face = middle - center[cell]
        half = np.einsum("ij,ij,ij->i", sign * normal, mesh.permeability[cell], to_face) / (to_face ** 2).sum(1)
        resistance += np.where(cell >= 0, 1 / half, 0)
    return 1 / resistance


def check(program, path, mesh):
    grid, faults = read(program, path), Faults()
    neighbours = grid["face_cells"].reshape(-1, 2).astype(int)
    faults.compare("points", grid["nodes"].reshape(-1, 3), mesh.points, 0)
    faults.compare("neighbours", neighbours, mesh.face_cells, 0)
    faults.compare("loops", grid["face_nodes"], mesh.loops, 0)
    faults.compare("starts of loops", grid["face_nodepos"], mesh.start, 0)
    faults.compare("volumes", grid["cell_volumes"], mesh.volume, 0)
    faults.compare("centres", grid["cell_centroids"].reshape(-1, 3), mesh.center, 0)
    faults.compare("areas", grid["face_areas"], np.linalg.norm(mesh.area_vector, axis=1), EXACT)
    faults.compare("normals", grid["face_normals"].reshape(-1, 3), mesh.area_vector, EXACT, "largest")
    faults.compare("face centroids", grid["face_centroids"].reshape(-1, 3), mesh.face_centroid, EXACT, "largest")
    start, faces = grid["cell_facepos"].astype(int), grid["cell_faces"].astype(int)
    owner = np.repeat(np.arange(len(mesh.volume)), np.diff(start))
    face, side = np.nonzero(mesh.face_cells >= 0)
    expected = np.column_stack([mesh.face_cells[face, side], face])
    faults.compare("faces of the cells", np.column_stack([owner, faces])[np.lexsort([faces, owner])],
                   expected[np.lexsort([expected[:, 1], expected[:, 0]])], 0)
    faults.compare("cartdims", grid["cartdims"], [len(mesh.volume), 1, 1], 0)
    if "--geometry" in sys.argv:
        print(f"{path.name}: {len(mesh.volume)} cells, {len(neighbours)} faces")
        return faults
    # Connections on a face, without a multiplier: from OPM's geometry alone.
    t = two_point(grid, mesh, neighbours)
    bare = mesh.connection_face < 0
    faults.compare("transmissibilities", t[mesh.connection_face[~bare]], mesh.transmissibility[~bare], EXACT)
    pairs = np.concatenate([neighbours[mesh.connection_face[~bare]], mesh.pairs[bare]])
    flow = np.concatenate([t[mesh.connection_face[~bare]], mesh.transmissibility[bare]])
    difference = faults.rates(mesh, pairs, flow, mesh.wells)
    print(f"{path.name}: {len(mesh.volume)} cells, {len(neighbours)} faces; rates differ by {difference}")
    return faults


def main():
    if len(sys.argv) < 3 or not sys.argv[2]:
        print("skipped: no libopm-grid (Debian package libopm-grid-dev)")
        return 77
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        for fault in check(sys.argv[2], pathlib.Path(sys.argv[1]) / f"{name}.opmgrid", Mesh(mesh_file)):
            print(f"FAIL {name}: {fault}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
