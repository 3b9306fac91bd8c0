#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the CSV tables, FEHM folders and DGF files of a folder, and compares with the mesh files beside them.

    check_text_tables.py FOLDER
"""
import csv
import pathlib
import sys

import numpy as np

from check_pflotran import read_wells
from mesh_numbers import Faults, Mesh, meshes


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))

    def column(name):
        return np.array([float(row[name]) for row in rows])
    return column, rows


def check_csv(folder, mesh):
    faults = Faults()
    column, rows = table(folder / "cells.csv")
    faults.compare("volumes", column("volume_m3"), mesh.volume, 0)
    faults.compare("pore volumes", column("pore_volume_m3"), mesh.pore_volume, 0)
    faults.compare("depths", column("depth"), mesh.depth, 0)
    permeability = np.column_stack([column(f"k{axis}_m2") for axis in "xyz"])
    faults.compare("permeabilities", permeability, mesh.permeability, 0)
    kinds = ["host", "refined", "transition", "radial"]
    faults.compare("kinds", [kinds.index(row["kind"]) for row in rows], mesh.kind, 0)
    column, _ = table(folder / "connections.csv")
    pairs = np.column_stack([column("first"), column("second")]).astype(int)
    faults.compare("pairs", pairs, mesh.pairs, 0)
    faults.compare("transmissibilities", column("transmissibility_m3"), mesh.transmissibility, 0)
    faults.compare("areas", column("area_m2"), mesh.area, 0)
    wells = {name: (cells + 1, index) for name, (cells, index) in read_wells(folder / "wells.csv").items()}  # from 0
    return faults, faults.rates(mesh, pairs, column("transmissibility_m3"), wells)


def read_stor(path):
    """Volumes, and row, column, coefficient of every entry, as FEHM reads them."""
    lines = path.read_text(encoding="ascii").splitlines()
    assert lines[0][9:13] == "asci" and lines[0][13:17] == "r8i4"
    written, count, graph, kinds, longest = map(int, lines[2].split())
    assert kinds == 1
    words = iter(" ".join(lines[3:]).split())

    def take(number, kind):
        return np.array([kind(next(words)) for _ in range(number)])
    volumes, pointers = take(count, float), take(count + 1, int)
    entries = graph - count - 1
    columns, places = take(entries, int), take(entries, int)
    assert not take(count + 1, int).any()
    diagonals, values = take(count, int), take(written, float)
    assert next(words, None) is None
    assert pointers[0] == count + 1 and pointers[-1] == graph and np.diff(pointers).max() == longest
    rows = np.repeat(np.arange(count), np.diff(pointers))
    assert (np.diff(columns)[np.diff(rows) == 0] > 0).all()  # in order in each row
    assert (columns[diagonals - count - 2] == np.arange(1, count + 1)).all()
    return volumes, rows, columns - 1, values[places - 1]


def read_macro(path):
    lines = path.read_text(encoding="ascii").split("\n\n")[0].splitlines()[1:]
    return np.array([line.split()[3:] for line in lines], float)


def check_fehm(folder, mesh):
    faults = Faults()
    volumes, rows, columns, values = read_stor(folder / "mesh.stor")
    faults.compare("volumes", volumes, mesh.volume, 1e-12)
    upper, lower = rows < columns, rows > columns
    transposed = np.lexsort([rows[lower], columns[lower]])
    if (values[rows == columns] != 0).any() or (values > 0).any():
        faults.append("a diagonal that is not 0 or a positive coefficient")
    faults.compare("symmetry", values[lower][transposed], values[upper], 0)
    by_pair = np.lexsort(mesh.pairs.T[::-1])
    faults.compare("pairs", np.column_stack([rows[upper], columns[upper]]), mesh.pairs[by_pair], 0)
    coefficient = np.empty(len(mesh.pairs))
    coefficient[by_pair] = values[upper]
    permeability = read_macro(folder / "perm.macro")
    faults.compare("permeabilities", permeability, mesh.permeability, 0)
    faults.compare("pore volumes", read_macro(folder / "rock.macro")[:, 2] * mesh.volume, mesh.pore_volume, 1e-14)
    lines = (folder / "mesh.fehmn").read_text(encoding="ascii").split("\n\n")[0].splitlines()[2:]
    center = np.array([line.split()[1:] for line in lines], float)
    faults.compare("places", center, mesh.center * [1, 1, -1], 0)
    a, b = mesh.pairs.T
    line = center[b] - center[a]
    mean = 2 * permeability[a] * permeability[b] / (permeability[a] + permeability[b])
    t = -coefficient * (line ** 2).sum(1) / (line ** 2 / mean).sum(1)
    faults.compare("transmissibilities", t, mesh.transmissibility, 2e-12)
    return faults, faults.rates(mesh, mesh.pairs, t, read_wells(folder / "wells.csv"))


def check_dgf(path, mesh):
    faults = Faults()
    blocks = path.read_text(encoding="ascii").split("#\n")
    assert blocks[0].startswith("DGF\nVertex\n") and blocks[1].startswith("Polygon\n") and blocks[3] == ""
    rows = [[line.split() for line in block.splitlines()[skip:]] for block, skip in zip(blocks, (2, 1, 1))]
    faults.compare("points", np.array(rows[0], float), mesh.points, 0)
    faults.compare("loops", [int(v) for row in rows[1] for v in row], mesh.loops, 0)
    cells = [set() for _ in mesh.volume]
    for face, pair in enumerate(mesh.face_cells):
        for cell in pair[pair >= 0]:
            cells[cell].add(face)
    if [set(map(int, row)) for row in rows[2]] != cells:
        faults.append("cells have other faces")
    return faults, None


def main():
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        for extension, check in ((".tables", check_csv), (".fehm", check_fehm), (".dgf", check_dgf)):
            faults, difference = check(pathlib.Path(sys.argv[1]) / (name + extension), Mesh(mesh_file))
            print(f"{name}{extension}: rates differ by {difference}")
            for fault in faults:
                print(f"FAIL {name}{extension}: {fault}")
                failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
