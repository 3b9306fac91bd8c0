# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One problem on three meshes: ours, the corner-point grid with Peaceman's indices, and that grid with columns in 4
x 4."""
from dataclasses import dataclass

import h5py
import numpy as np

import host_wells
import hosts
import meshes

FINER = 4
MESHES = ("knit", "corner_point", "finer")


@dataclass
class Problem:
    grid: hosts.Grid
    wells: list                  # ends [n, 3] of each path
    exact: object                # rates, bore_pressures, pressure(points)
    bore: float = 0.1
    options: tuple = ()          # of build
    keys: str = ""               # of each --well
    chosen: object = None        # of the outer faces but top and base: fn(centroid, area_vector) -> mask
    line: tuple = None           # two level points: pressures along it are compared
    layer: float = 10.0          # m, of the cells whose middles count as on the line
    meshes: tuple = MESHES
    with_top_and_base: bool = False  # pressures are held there too
    is_across_layers: bool = False   # indices in host cells: host_wells.across_layers()


def compare(program, problem):
    """{mesh: {cells, rates, errors (relative, by well), line: [distance, error over drawdown]}}; `knit` has mode and
    radius too. With two-point fluxes; but for the finer grid {mesh}_consistent with multi-point ones."""
    out = {}
    for name in problem.meshes:
        grid = hosts.split_columns(problem.grid, FINER) if name == "finer" else problem.grid
        case, mesh = program.folder / "host.GRDECL", program.folder / f"{name}.h5"
        hosts.write_grdecl(grid, case)
        more = {}
        fluxes = () if name == "finer" else ("--fluxes", "consistent")
        if name == "knit":
            report = build_knit(program, problem, mesh, *fluxes)
            more = {"wells": [{k: w[k] for k in ("mode", "drainage_radius", "index_connections", "length_in_rock",
                                                 "length_meshed")} for w in report["wells"]]}
        else:
            program.build(case, mesh, *fluxes)
            for n, path in enumerate(write_paths(program, problem)):
                host_wells.add_well(mesh, grid, f"W{n}", path, problem.bore,
                                    is_across_layers=problem.is_across_layers)
            if name == "corner_point":
                more = {"non_orthogonality": meshes.mean_non_orthogonality(mesh)}
        out[name] = {**solve(program, problem, mesh), **more}
        if fluxes:
            out[name + "_consistent"] = solve(program, problem, mesh, *fluxes)
    return out


def write_paths(program, problem):
    return [meshes.write_path(program.folder / f"well{n}.csv", points) for n, points in enumerate(problem.wells)]


def build_knit(program, problem, mesh, *options):
    """Our mesh of the problem; the program's report."""
    case = program.folder / "host.GRDECL"
    hosts.write_grdecl(problem.grid, case)
    wells = [f"{program.folder}/well{n}.csv,name=W{n},bore={problem.bore}{problem.keys}"
             for n in range(len(write_paths(program, problem)))]
    return program.build(case, mesh, *options, *problem.options, *(a for w in wells for a in ("--well", w)))


def solve(program, problem, mesh, *options):
    table, result = program.folder / "hold.csv", mesh.with_name(mesh.stem + "_flow.h5")
    select = {"chosen": problem.chosen} if problem.chosen else {}
    if problem.with_top_and_base:
        select.update(with_top_and_base=True, thickness=0.05)
    meshes.hold_faces(mesh, table, problem.exact.pressure, **select)
    wells = [f"W{n}={p:.12g}bar" for n, p in enumerate(problem.exact.bore_pressures)]
    report = program.solve(mesh, result, "--hold", table, *options, *(a for w in wells for a in ("--well", w)))
    rates = [w["rate_m3_per_day"] for w in report["wells"]]
    errors = [rate / exact - 1 for rate, exact in zip(rates, problem.exact.rates)]
    out = {"cells": report["cells"], "rates": rates, "errors": errors}
    if problem.line:
        out["line"] = along_line(result, problem)
    return out


def along_line(result, problem):
    """Distance from the line's start and the error of the pressure over the line's drawdown, of the cells that the
    line passes near
    the middle of; without radial cells and those open to a well."""
    start, end = (np.asarray(p, float) for p in problem.line)
    with h5py.File(result) as file:
        center, volume = file["cells/center"][()], file["cells/volume"][()]
        pressure = file["flow/pressure"][()] / meshes.BAR
        # A cell that a bore passes has the mean of its block and not the pressure at its centre.
        is_left_out = file["cells/kind"][()] == meshes.RADIAL
        for well in file["wells"].values():
            is_left_out[well["connections/cell"][()]] = True
    along = (end - start) / np.linalg.norm(end - start)
    offset = center - start
    distance = offset @ along
    aside = np.linalg.norm((offset - distance[:, None] * along)[:, :2], axis=1)
    near = (np.abs(offset[:, 2]) < 0.6 * problem.layer) & (aside < 0.4 * np.cbrt(volume)) & ~is_left_out
    near &= (distance > 0) & (distance < np.linalg.norm(end - start))
    drawdown = problem.exact.pressure(end[None])[0] - problem.exact.bore_pressures[0]
    error = (pressure[near] - problem.exact.pressure(center[near])) / drawdown
    order = np.argsort(distance[near])
    return [[round(float(d), 3), float(e)] for d, e in zip(distance[near][order], error[order])]
