#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the PFLOTRAN folders of a folder as PFLOTRAN does, text and HDF5, and compares with the mesh files beside them.

    check_pflotran.py FOLDER
"""
import csv
import pathlib
import sys

import h5py
import numpy as np

from mesh_numbers import Faults, Mesh, meshes

EXACT = 1e-12
UP = np.array([1, 1, -1])


def read_uge(path):
    lines = iter(path.read_text(encoding="ascii").splitlines())

    def block(keyword):
        word, count = next(lines).split()
        assert word == keyword, word
        return np.array([next(lines).split() for _ in range(int(count))], float).reshape(int(count), -1)
    cells, connections = block("CELLS"), block("CONNECTIONS")
    assert next(lines, None) is None
    assert (cells[:, 0] == np.arange(1, len(cells) + 1)).all()
    return (cells[:, 1:4], cells[:, 4], connections[:, :2].astype(int) - 1, connections[:, 2:5], connections[:, 5])


def read_hdf5(path):
    with h5py.File(path, "r") as file:
        cells, connections = file["Domain/Cells"], file["Domain/Connections"]
        assert connections["Cell Ids"].dtype == np.int32
        return (cells["Centers"][:], cells["Volumes"][:], connections["Cell Ids"][:] - 1, connections["Centers"][:],
                connections["Areas"][:])


def along(permeability, direction):
    """PFLOTRAN's scalar for a gradient of potential (its default)."""
    return 1 / (direction ** 2 / permeability).sum(1)


def transmissibilities(grid, permeability):
    """As PFLOTRAN has them, the face's point projected on the line of centres."""
    center, _, pairs, point, area = grid
    line = center[pairs[:, 1]] - center[pairs[:, 0]]
    length = np.linalg.norm(line, axis=1)
    unit = line / length[:, None]
    first = np.einsum("ij,ij->i", point - center[pairs[:, 0]], unit)
    assert ((first > 0) & (first < length)).all()
    k = [along(permeability[pairs[:, side]], unit) for side in (0, 1)]
    return area / (first / k[0] + (length - first) / k[1])


def read_wells(path):
    wells = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            cells, index = wells.setdefault(row["well"], ([], []))
            cells.append(int(row["cell"]) - 1)
            index.append(float(row["well_index_m3"]))
    return {name: (np.array(cells), np.array(index)) for name, (cells, index) in wells.items()}


def boundary_faults(folder, mesh, faults):
    """Every boundary face once, with what PFLOTRAN makes of it."""
    outer = mesh.face_cells[:, 1] < 0
    rows = np.concatenate([np.loadtxt(path, skiprows=1, ndmin=2) for path in sorted(folder.glob("regions/*.ex"))])
    cell, middle = mesh.face_cells[outer, 0], mesh.face_centroid[outer]
    to_face = middle - mesh.center[cell]
    area = np.einsum("ij,ij->i", mesh.area_vector[outer], to_face) / np.linalg.norm(to_face, axis=1)
    expected = np.column_stack([cell + 1, middle * UP, area])

    def ordered(table):  # by cell, then along a direction in which no two faces are level
        return table[np.lexsort([table[:, 1:4] @ [0.6180339, 0.4142135, 0.7320508], table[:, 0]])]
    faults.compare("boundary", ordered(rows), ordered(expected), EXACT, "largest")


def check(folder, read, mesh):
    faults, grid = Faults(), read(next(folder.glob("mesh.*")))
    with h5py.File(folder / "properties.h5", "r") as file:
        permeability = np.column_stack([file["Permeability" + axis][:] for axis in "XYZ"])
        porosity = file["Porosity"][:]
        faults.compare("cell ids", file["Cell Ids"][:], np.arange(1, len(mesh.volume) + 1), 0)
    faults.compare("centres", grid[0], mesh.center * UP, 0)
    faults.compare("volumes", grid[1], mesh.volume, 0)
    faults.compare("pairs", grid[2], mesh.pairs, 0)
    faults.compare("pore volumes", porosity * mesh.volume, mesh.pore_volume, 1e-15)
    t = transmissibilities(grid, permeability)
    faults.compare("transmissibilities", t, mesh.transmissibility, EXACT)
    wells = read_wells(folder / "wells.csv")
    for name, (cells, _) in wells.items():
        ids = np.loadtxt(folder / "regions" / f"well_{name}.vs", dtype=int, ndmin=1)
        faults.compare("region of " + name, ids, cells + 1, 0)
    boundary_faults(folder, mesh, faults)
    print(f"{folder.name}: {len(grid[1])} cells; rates differ by {faults.rates(mesh, grid[2], t, wells)}")
    return faults


def main():
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        for extension, read in ((".pflotran", read_uge), (".pflotran_h5", read_hdf5)):
            for fault in check(pathlib.Path(sys.argv[1]) / (name + extension), read, Mesh(mesh_file)):
                print(f"FAIL {name}{extension}: {fault}")
                failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
