# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pore volume of each region of the source grid against the same region of the mesh."""
import pathlib

import h5py
import numpy as np


def regions_of(mesh, source_region):
    """{region: [m3 in the source, relative error by the transfer map, relative error by the cells' own FIPNUM]}"""
    with h5py.File(mesh) as file:
        start, cell = file["transfer/start"][()], file["transfer/cell"][()]
        fraction, pores = file["transfer/fraction"][()], file["transfer/source_pore_volume"][()]
        volume, region = file["cells/pore_volume"][()], file["cells/properties/FIPNUM"][()]
    source = np.repeat(np.arange(len(start) - 1), np.diff(start))
    brought = np.bincount(cell, fraction * pores[source], len(volume))
    out = {}
    for r in np.unique(source_region[pores > 0]):
        total = pores[source_region == r].sum()
        of_region = np.where(source_region[source] == r, fraction * pores[source], 0.0)
        # What a cell holds is shared among its regions as the map brought it.
        share = np.bincount(cell, of_region, len(volume)) / np.where(brought > 0, brought, 1.0)
        by_map, by_cell = (share * volume).sum(), volume[region == r].sum()
        out[int(r)] = [float(total), float(by_map / total - 1), float(by_cell / total - 1)]
    return out


def host_regions(program, case, options):
    """FIPNUM of each source cell, from the host without wells."""
    mesh = program.folder / "regions_host.h5"
    program.build(case, mesh, *options)
    with h5py.File(mesh) as file:
        out = np.zeros(int(np.prod(file.attrs["source_dimensions"])), int)
        out[file["cells/source_cell"][()]] = file["cells/properties/FIPNUM"][()]
    return out


def model5(program, shared):
    case = pathlib.Path(shared, "data/model5/MODEL5.DATA")
    mesh = program.folder / "regions.h5"
    program.build(case, mesh, "--deck-wells", "all")
    return regions_of(mesh, host_regions(program, case, ()))


def reek(program, shared):
    """The published files have no regions: FIPNUM is 4 blocks of columns times 2 halves of the layers; constant
    permeability."""
    folder = pathlib.Path(shared, "data/reek")
    nx, ny, nz = 40, 64, 14
    k, j, i = np.meshgrid(np.arange(nz), np.arange(ny), np.arange(nx), indexing="ij")
    region = (1 + (i >= nx // 2) + 2 * (j >= ny // 2) + 4 * (k >= nz // 2)).ravel()
    extra = program.folder / "reek_extra.GRDECL"
    with open(extra, "w", encoding="ascii") as out:
        rows = (" ".join(map(str, row)) for row in region.reshape(-1, nx))
        out.write("FIPNUM\n" + "\n".join(rows) + "\n/\n")
        for key, value in (("PERMX", 100), ("PERMY", 100), ("PERMZ", 10)):
            out.write(f"{key}\n {nx * ny * nz}*{value} /\n")
    case = folder / "reek_sim.grdecl"
    include = ("--grid-include", folder / "reek_sim_poro.grdecl", "--grid-include", extra)
    wells = sorted(p for p in (folder / "wells").iterdir() if p.name.startswith(("OP_", "WI_")))
    mesh = program.folder / "regions.h5"
    program.build(case, mesh, *include, "--radius", 20, *(a for w in wells for a in ("--well", w)))
    return regions_of(mesh, host_regions(program, case, include))
