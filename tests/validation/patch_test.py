# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A linear pressure on all outer faces: the fluxes that connections give it, and the pressures that come back."""
import h5py
import numpy as np

import cases
import hosts
import meshes
from attribution import KINDS
from linear_pressure import pressure_error


def flux_errors(mesh, axis, is_consistent):
    """Errors of all connections' fluxes, over the flux of a face of the same area across the slope; and pairs of
    kinds."""
    with h5py.File(mesh) as file:
        face = file["connections/face"][()]
        keep = face >= 0
        pair = file["connections/cells"][()][keep]
        faces = meshes.Faces(file)
        area_vector = faces.area_vector[face[keep]]
        sign = np.where(faces.cells[face[keep], 0] == pair[:, 0], 1.0, -1.0)
        center, k = file["cells/center"][()], file["cells/permeability"][()]
        t = file["connections/transmissibility"][()][keep]
        kind = file["cells/kind"][()]
        wanted = -k[pair[:, 0], axis] * area_vector[:, axis] * sign
        given = t * (center[pair[:, 0], axis] - center[pair[:, 1], axis])
        if is_consistent:
            start, cells = file["stencils/start"][()], file["stencils/cells"][()]
            terms = np.concatenate([[0.0], np.cumsum(file["stencils/coefficients"][()] *
                                                     (center[cells, axis] - center[:, axis].mean()))])
            given = (terms[start[1:]] - terms[start[:-1]])[keep]
        scale = k[pair[:, 0], axis] * np.linalg.norm(area_vector, axis=1)
        kinds = [f"{KINDS[a]} - {KINDS[b]}" for a, b in np.sort(kind[pair], axis=1)]
    return (given - wanted) / scale, np.array(kinds)


def run(program, deformations=cases.DEFORMATIONS):
    """{deform: {mesh: {pressure: [3], flux: {kinds: [count, mean, 95 %, largest of |error| over the three axes]}}}}"""
    out = {}
    for deform in deformations:
        problem = cases.thiem_problem(50.0, deform)
        case = program.folder / "patch.GRDECL"
        hosts.write_grdecl(problem.grid, case)
        path = program.folder / "patch_well.csv"
        meshes.write_path(path, problem.wells[0])
        row = {}
        for name, options in (("knit", ("--well", f"{path},name=W0")), ("corner_point", ())):
            mesh = program.folder / f"patch_{name}.h5"
            program.build(case, mesh, "--fluxes", "consistent", *options)
            row[name] = of_mesh(program, mesh)
            row[name + "_consistent"] = of_mesh(program, mesh, "--fluxes", "consistent")
        out[f"{deform:g}"] = row
    return out


def of_mesh(program, mesh, *fluxes):
    errors = [flux_errors(mesh, axis, bool(fluxes)) for axis in range(3)]
    size = np.max([np.abs(e) for e, _ in errors], axis=0)
    kinds = errors[0][1]
    return {"pressure": [pressure_error(program, mesh, axis, *fluxes) for axis in range(3)],
            "flux": {str(k): [int((kinds == k).sum()), float(size[kinds == k].mean()),
                              float(np.quantile(size[kinds == k], 0.95)), float(size[kinds == k].max())]
                     for k in np.unique(kinds)},
            "quantiles": {str(k): np.quantile(size[kinds == k], np.linspace(0, 1, 41)).tolist()
                          for k in np.unique(kinds)}}
