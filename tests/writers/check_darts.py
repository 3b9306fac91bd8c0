#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the arrays for open-DARTS of a folder by the shipped loader, reads the text for AD-GPRS, and compares with the mesh files.

    check_darts.py FOLDER LOADERS
"""
import pathlib
import sys

import numpy as np

from check_pflotran import read_wells
from mesh_numbers import Faults, Mesh, meshes

EXACT = 1e-14
MILLIDARCY = 9.869232667160130e-16
UNIT = 0.0085267146719160105 / MILLIDARCY  # per m3


def read_adgprs(folder):
    data = {}
    for name in ("volume", "poro", "depth", "permx", "permy", "permz"):
        keyword, *values, end = (folder / f"{name}.txt").read_text(encoding="ascii").split()
        assert keyword == name.upper() and end == "/"
        data[name] = np.array(values, float)
    head, count, *rows, end = (folder / "connections.txt").read_text(encoding="ascii").splitlines()
    assert head == "TPFACONNSN" and end == "/" and int(count) == len(rows)
    table = np.array([row.split() for row in rows], float)
    data.update(block_m=table[:, 0].astype(int), block_p=table[:, 1].astype(int), tran=table[:, 2], tranD=table[:, 3])
    data.update(kx=data["permx"], ky=data["permy"], kz=data["permz"])
    return data


def check(data, wells, mesh):
    faults = Faults()
    pairs = np.column_stack([data["block_m"], data["block_p"]])
    faults.compare("pairs", pairs, mesh.pairs, 0)
    faults.compare("transmissibilities", data["tran"], mesh.transmissibility * UNIT, EXACT)
    faults.compare("volumes", data["volume"], mesh.volume, 0)
    faults.compare("depths", data["depth"], mesh.depth, 0)
    faults.compare("pore volumes", data["poro"] * data["volume"], mesh.pore_volume, EXACT)
    permeability = np.column_stack([data[name] for name in ("kx", "ky", "kz")]) * MILLIDARCY
    faults.compare("permeabilities", permeability, mesh.permeability, EXACT)
    line = mesh.center[pairs[:, 1]] - mesh.center[pairs[:, 0]]
    has_face = mesh.connection_face >= 0
    across = np.abs(np.einsum("ij,ij->i", mesh.area_vector[mesh.connection_face], line)) / (line ** 2).sum(1)
    faults.compare("area over distance", data["tranD"], np.where(has_face, across, 0), 1e-12)
    if "centers" in data:
        faults.compare("centres", data["centers"], mesh.center, 0)
    return faults, faults.rates(mesh, pairs, data["tran"], wells, unit=UNIT)


def main():
    sys.path.insert(0, sys.argv[2])
    import wellknit_darts  # the loader that is shipped
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        mesh, base = Mesh(mesh_file), pathlib.Path(sys.argv[1]) / name
        for extension in (".npz", ".darts_h5", ".adgprs"):
            path = base.with_suffix(extension)
            if extension == ".adgprs":
                data = read_adgprs(path)
                wells = {well: (cells, index * UNIT) for well, (cells, index) in read_wells(path / "wells.csv").items()}
                wells = {well: (cells + 1, index) for well, (cells, index) in wells.items()}  # counted from 0 there
            else:
                data = wellknit_darts.load(path)
                wells = {well: (cells, index) for well, cells, index in wellknit_darts.wells(data)}
            faults, difference = check(data, wells, mesh)
            print(f"{path.name}: {len(mesh.volume)} cells; rates differ by {difference}")
            for fault in faults:
                print(f"FAIL {path.name}: {fault}")
                failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
