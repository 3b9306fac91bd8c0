#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the TOUGH folders of a folder by their columns, and compares with the mesh files beside them.

    check_tough.py FOLDER
"""
import csv
import pathlib
import sys

import numpy as np

from check_pflotran import read_wells
from mesh_numbers import Faults, Mesh, meshes

# Ten columns hold 8 digits of a distance or an area, 6 of one below 0.01: half a unit of 1.00000E-3 is 5e-6 of it.
PRECISION = 1e-5
DIGITS = 2e-7


def numbers(line, first, last):
    """The fields of ten columns from column `first` (counted from 1); an empty one is 0."""
    fields = [line[column:column + 10].strip() for column in range(first - 1, last, 10)]
    return [float(field) if field else 0.0 for field in fields]


def blocks(path):
    """Lines of each block by its keyword."""
    found, lines = {}, None
    for line in path.read_text(encoding="ascii").splitlines():
        if lines is None:
            lines = found.setdefault(line[:5], [])
        elif not line.strip():
            lines = None
        else:
            lines.append(line)
    return found


def check(folder, mesh):
    faults, data = Faults(), {**blocks(folder / "MESH"), **blocks(folder / "ROCKS")}
    rocks = {line[:5]: np.array(numbers(line, 11, 80)) for line in data["ROCKS"]}
    if "SEED" not in rocks:
        faults.append("no rock SEED: TOUGH would not read the modifiers")
    names = [row["name"] for row in csv.DictReader(open(folder / "names.csv", encoding="ascii"))]
    assert len(set(names)) == len(names) == len(mesh.volume)
    place = {name: n for n, name in enumerate(names)}
    length = len(names[0])
    elements = np.array([numbers(line, 21, 80) for line in data["ELEME"]])
    faults.compare("names", [place[line[:length]] for line in data["ELEME"]], np.arange(len(names)), 0)
    faults.compare("volumes", elements[:, 0], mesh.volume, DIGITS)
    faults.compare("places", elements[:, 3:], mesh.center * [1, 1, -1], DIGITS, "largest")
    permeability = np.array([rocks[line[15:20]][2:5] * row[2] for line, row in zip(data["ELEME"], elements)])
    faults.compare("permeability along x", permeability[:, 0], mesh.permeability[:, 0], 1e-6)
    porosity = np.array([rocks[line[15:20]][1] for line in data["ELEME"]])
    faults.compare("pore volume", np.sum(porosity * elements[:, 0]), mesh.pore_volume.sum(), 1e-6)
    pairs = np.array([[place[line[:length]], place[line[length:2 * length]]] for line in data["CONNE"]])
    faults.compare("pairs", pairs, mesh.pairs, 0)
    axis = np.array([int(line[25:30]) - 1 for line in data["CONNE"]])
    d1, d2, area, cosine = np.array([numbers(line, 31, 70) for line in data["CONNE"]]).T
    line = mesh.center[pairs[:, 1]] - mesh.center[pairs[:, 0]]
    faults.compare("distance", d1 + d2, np.linalg.norm(line, axis=1), DIGITS)
    faults.compare("height", cosine * (d1 + d2), line[:, 2], DIGITS, "largest")
    k = [permeability[pairs[:, side], axis] for side in (0, 1)]
    t = area / (d1 / k[0] + d2 / k[1])
    faults.compare("transmissibilities", t, mesh.transmissibility, PRECISION)
    difference = faults.rates(mesh, pairs, t, read_wells(folder / "wells.csv"))
    print(f"{folder.name}: {len(names)} cells; transmissibilities differ by "
          f"{np.abs(t / mesh.transmissibility - 1).max():.2g}, rates by {difference}")
    return faults


def main():
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        for fault in check(pathlib.Path(sys.argv[1]) / (name + ".tough"), Mesh(mesh_file)):
            print(f"FAIL {name}: {fault}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
