#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has Octave load the MRST files of a folder by the shipped loader, and compares with the mesh files beside them.

    check_mrst.py FOLDER LOADERS [--twisted]
With --twisted the cells may have twisted faces, which the mesh takes for bilinear in corner-point cells: 5 % instead of 1e-9.
Ends with 77 where octave is missing.
"""
import pathlib
import shutil
import subprocess
import sys

import numpy as np

from mesh_numbers import Faults, Mesh, meshes


def read(path, loaders):
    here = pathlib.Path(__file__).resolve().parent
    command = ["octave", "--no-gui", "--no-init-file", "--quiet", "--path", str(here), "--path", loaders,
               "--eval", f"read_mrst('{path}')"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"FAIL {path}: {done.stderr.strip()}")
    rows = [line.split() for line in done.stdout.splitlines()]
    return {row[0]: np.array(row[2:], float) for row in rows if row}


def check(path, mesh, loaders):
    data, faults = read(path, loaders), Faults()
    faults.compare("volumes", data["volumes"], mesh.volume, 0)
    if not data["volume_difference"][0] < (0.05 if "--twisted" in sys.argv else 1e-9):
        faults.append(f"volumes within the faces differ by {data['volume_difference'][0]}")
    faults.compare("centres", data["centroids"].reshape(-1, 3), mesh.center, 0)
    faults.compare("neighbours", data["neighbors"].reshape(-1, 2) - 1, mesh.face_cells, 0)
    faults.compare("areas", data["areas"], np.linalg.norm(mesh.area_vector, axis=1), 1e-12)
    faults.compare("permeabilities", data["perm"].reshape(-1, 3), mesh.permeability, 0)
    faults.compare("pore volumes", data["pore_volume"], mesh.pore_volume, 1e-15)
    pairs = data["N"].reshape(-1, 2).astype(int) - 1
    ours = {tuple(pair): t for pair, t in zip(mesh.pairs, mesh.transmissibility)}
    theirs = {tuple(sorted(pair)): t for pair, t in zip(pairs, data["T"])}
    faults.compare("transmissibilities", [theirs.pop(pair, np.nan) for pair in ours], list(ours.values()), 0)
    if any(theirs.values()):
        faults.append("connections that the mesh does not have")
    wells = {name: (data["cells:" + name].astype(int) - 1, data["WI:" + name]) for name in mesh.wells}
    print(f"{path.name}: {len(mesh.volume)} cells; rates differ by {faults.rates(mesh, pairs, data['T'], wells)}")
    return faults


def main():
    if shutil.which("octave") is None:
        print("skipped: no octave (Debian package octave)")
        return 77
    failed = False
    for name, mesh_file in meshes(sys.argv[1]):
        for fault in check(pathlib.Path(sys.argv[1]) / f"{name}.mat", Mesh(mesh_file), sys.argv[2]):
            print(f"FAIL {name}: {fault}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
