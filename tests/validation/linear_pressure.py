# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a linear pressure on all outer faces makes of the pressures inside, with the wells shut."""
import h5py
import numpy as np

import exact
import meshes

SLOPE = 0.01  # bar/m


def pressure_error(program, mesh, axis, *options):
    """Largest error of a cell's pressure over the drop across the slab along the axis; radial cells aside."""
    slope = np.zeros(3)
    slope[axis] = SLOPE
    with h5py.File(mesh) as file:
        points = file["vertices"][()]
        wells = [n.decode() for n in file["wells_order"][()]] if "wells_order" in file else []
    field = exact.Linear(200.0 - float(points.mean(axis=0) @ slope), slope)
    table, result = program.folder / "patch.csv", program.folder / "patch_flow.h5"
    meshes.hold_faces(mesh, table, field.pressure, with_top_and_base=True)
    program.solve(mesh, result, "--hold", table, *options, *(a for w in wells for a in ("--well", f"{w}=shut")))
    with h5py.File(result) as file:
        error = file["flow/pressure"][()] / meshes.BAR - field.pressure(file["cells/center"][()])
        outside = file["cells/kind"][()] != meshes.RADIAL
    return float(np.abs(error[outside]).max() / (SLOPE * np.ptp(points[:, axis])))
