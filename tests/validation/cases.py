# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The problems of the suite. Each function gives {row: result of compare()}."""
import numpy as np

import exact
import hosts
import meshes
from attribution import attribute
from comparison import MESHES, Problem, build_knit, compare, solve
from host_wells import MILLIDARCY
from linear_pressure import pressure_error

TOP = 2000.0
DEFORMATIONS = (0.0, 0.5, 1.0)
PERMEABILITY = 100.0  # mD
COUNT = (30, 30, 20)


def vertical(x, y, height):
    """A path from above the slab to below it."""
    return [[x, y, TOP - 0.05 * height], [x, y, TOP + 1.05 * height]]


def line_from(x, y, height, length, angle=30.0):
    z = TOP + 0.5 * height
    a = np.radians(angle)
    return (x, y, z), (x + length * np.cos(a), y + length * np.sin(a), z)


def thiem_problem(width, deform, **more):
    size = (width, width, 0.4 * width)
    height = COUNT[2] * size[2]
    x, y = 15.3 * width, 14.8 * width
    solution = exact.VerticalWells([(x, y)], 0.1, PERMEABILITY * height)
    return Problem(hosts.slab(COUNT, size, deform), [vertical(x, y, height)], solution,
                   line=line_from(x, y, height, 12 * width), layer=size[2], **more)


def thiem(program, widths=(20.0, 50.0, 100.0), deformations=DEFORMATIONS, kinds=MESHES):
    return {f"{w:g} m, deform {d:g}": compare(program, thiem_problem(w, d, meshes=kinds))
            for w in widths for d in deformations}


def boundary_problem(distance, deform, **more):
    size = (50.0, 50.0, 10.0)
    height = 20 * size[2]
    x, y = 15.3 * size[0], distance
    solution = exact.VerticalWells([(x, y)], 0.1, PERMEABILITY * height, images=[(x, -y, 0)])
    grid = hosts.slab(COUNT, size, deform, straight_side=True)

    def beyond_plane(centroid, _):
        return centroid[:, 1] > 1e-3

    return Problem(grid, [vertical(x, y, height)], solution, chosen=beyond_plane,
                   line=line_from(x, y, height, 600.0, 60.0), **more)


def boundary(program, distances=(30.0, 60.0), deformations=DEFORMATIONS):
    return {f"{a:g} m from the boundary, deform {d:g}": compare(program, boundary_problem(a, d))
            for a in distances for d in deformations}


def two_wells_problem(deform, strengths=(1.0, 0.6), **more):
    size = (50.0, 50.0, 10.0)
    height = 20 * size[2]
    x, y = 15.3 * size[0], 14.8 * size[1]
    places = [(x, y), (x + 60.0, y)]
    solution = exact.VerticalWells(places, 0.1, PERMEABILITY * height, strengths)
    return Problem(hosts.slab(COUNT, size, deform), [vertical(*p, height) for p in places], solution,
                   line=line_from(x, y, height, 600.0, 120.0), **more)


def two_wells(program, deformations=DEFORMATIONS):
    out = {}
    for name, strengths in (("two producers", (1.0, 0.6)), ("producer and injector", (1.0, -1.0))):
        for d in deformations:
            out[f"{name}, deform {d:g}"] = compare(program, two_wells_problem(d, strengths))
    return out


def line_problem(kind, ratio, deform, **more):
    """A slanted (60 degrees from the vertical) or horizontal well inside a slab of 1,500 x 1,500 x 200 m. In
    anisotropic rock layers are flat: a deck's permeability is along the layers, so that with layers that dip the
    slab's solution would not be the deck's."""
    size = (50.0, 50.0, 10.0)
    height = 20 * size[2]
    middle = np.array([765.0, 740.0, TOP + 0.5 * height])
    half = {"slanted": (0.5 * 0.6 * height * np.array([np.tan(np.radians(60.0)), 0.0, 1.0])),
            "horizontal": np.array([200.0, 30.0, 0.0])}[kind]
    permeability = (100.0, 100.0, 100.0 * ratio)
    ends = np.array([middle - half, middle + half])
    solution = exact.LineWell(ends, 0.1, permeability, (TOP, TOP + height))
    grid = hosts.slab(COUNT, size, deform, permeability, flat_layers=ratio != 1.0)
    return Problem(grid, [ends], solution,
                   line=(tuple(middle), tuple(middle + (150.0, 600.0, 0.0))), **more)


def line_wells(program, kinds=("slanted", "horizontal"), ratios=(1.0, 0.1, 0.01), deformations=DEFORMATIONS):
    return {f"{kind}, k_v/k_h {r:g}, deform {d:g}": compare(program, line_problem(kind, r, d))
            for kind in kinds for r in ratios for d in deformations}


def line_wells_metric(program, deformations=DEFORMATIONS):
    """The same wells in anisotropic rock with the mesh of --metric permeability."""
    return {f"{kind}, k_v/k_h {r:g}, deform {d:g}": compare(program, line_problem(kind, r, d, meshes=("knit",), options=("--metric", "permeability")))
            for kind in ("slanted", "horizontal") for r in (0.1, 0.01) for d in deformations}


def dipping_problem(dip, ratio, **more):
    """A vertical well through layers that dip along x, permeability along them and across: where a bore is not normal
    to its layers."""
    size = (50.0, 50.0, 10.0)
    height = COUNT[2] * size[2]
    grid = hosts.slab(COUNT, size, 0.0, (PERMEABILITY, PERMEABILITY, PERMEABILITY * ratio))
    a = np.radians(dip)
    grid.zcorn += np.tan(a) * size[0] * ((np.arange(2 * COUNT[0]) + 1) // 2)
    across = np.cos(a) ** 2 + ratio * np.sin(a) ** 2  # k_xx / k_h
    x, y = 15.3 * size[0], 14.8 * size[1]
    solution = exact.PlanWell((x, y), 0.1, PERMEABILITY * np.diag([across, 1.0]), height)
    path = [[x, y, TOP - 0.05 * height], [x, y, TOP + 1.05 * height + np.tan(a) * COUNT[0] * size[0]]]
    return Problem(grid, [path], solution, with_top_and_base=True, **more)


def dipping(program, dips=(0.0, 10.0, 20.0), ratios=(1.0, 0.1, 0.01)):
    """{row: {knit, knit_consistent, corner_point, across: result of solve()}}"""
    out = {}
    for dip in dips:
        for ratio in ratios:
            row = compare(program, dipping_problem(dip, ratio, meshes=("knit", "corner_point")))
            more = compare(program, dipping_problem(dip, ratio, meshes=("corner_point",), is_across_layers=True))
            out[f"dip {dip:g}, k_v/k_h {ratio:g}"] = {**row, "across": more["corner_point"]}
    return out


def layered_problem(deform, mode="layered", **more):
    """Layers of 1000 mD and 1 mD in turn; flat, so that ln r stays exact; pillars are deformed."""
    size = (50.0, 50.0, 10.0)
    layers = [1000.0 if k % 2 == 0 else 1.0 for k in range(COUNT[2])]
    height = COUNT[2] * size[2]
    x, y = 15.3 * size[0], 14.8 * size[1]
    solution = exact.VerticalWells([(x, y)], 0.1, sum(layers) * size[2])
    grid = hosts.slab(COUNT, size, deform, [(k, k, k) for k in layers], flat_layers=True)
    return Problem(grid, [vertical(x, y, height)], solution, keys=f",mode={mode}",
                   line=line_from(x, y, height, 600.0), **more)


def layered(program, deformations=DEFORMATIONS):
    return {f"deform {d:g}": compare(program, layered_problem(d)) for d in deformations}


def attribution_of_thiem(program, widths=(20.0, 50.0, 100.0), deformations=DEFORMATIONS, rings=5):
    """{row: {error, parts: {class of connections: part of the relative error}}} of our mesh."""
    out = {}
    for width in widths:
        for deform in deformations:
            problem = thiem_problem(width, deform, meshes=("knit",))
            result = compare(program, problem)["knit"]
            table, weights = program.folder / "zero.csv", program.folder / "weights.h5"
            meshes.hold_faces(program.folder / "knit.h5", table, lambda points: np.zeros(len(points)))
            program.solve(program.folder / "knit.h5", weights, "--well", "W0=1bar", "--hold", table)
            radii = 0.1 * (result["wells"][0]["drainage_radius"] / 0.1) ** (np.arange(rings + 1) / rings)
            parts = attribute(program.folder / "knit.h5", weights, problem.exact, radii,
                              problem.exact.sources[0, :2], PERMEABILITY * MILLIDARCY)
            rate = problem.exact.rates[0] / (meshes.BAR * meshes.DAY) * meshes.CENTIPOISE
            out[f"{width:g} m, deform {deform:g}"] = {"error": result["errors"][0],
                                                      "parts": {k: v / rate for k, v in parts.items()}}
    return out


def adapted_problems():
    """{row: problems of one mesh}"""
    return {
        "Thiem, 50 m, deform 0": [thiem_problem(50.0, 0.0)],
        "Thiem, 50 m, deform 0.5": [thiem_problem(50.0, 0.5)],
        "Thiem, 50 m, deform 1": [thiem_problem(50.0, 1.0)],
        "Thiem, 20 m, deform 1": [thiem_problem(20.0, 1.0)],
        "60 m from the boundary, deform 1": [boundary_problem(60.0, 1.0)],
        "two wells, deform 0.5": [two_wells_problem(0.5), two_wells_problem(0.5, (1.0, -1.0))],
        "two wells, deform 1": [two_wells_problem(1.0), two_wells_problem(1.0, (1.0, -1.0))],
        "layers of a factor 1,000, deform 1": [layered_problem(1.0)],
        "horizontal, k_v/k_h 1, deform 1": [line_problem("horizontal", 1.0, 1.0)],
        "slanted, k_v/k_h 0.01, deform 1, permeability metric": [
            line_problem("slanted", 0.01, 1.0, options=("--metric", "permeability"))],
    }


def adapted(program, rows=None):
    """{row: {two_point, adapted, consistent: [result of solve() for each problem]}} of our mesh; and with `linear`, the
    largest errors of a linear pressure along x, y and depth past the shut wells."""
    out = {}
    for name, problems in adapted_problems().items():
        if rows and name not in rows:
            continue
        row = {}
        for fluxes in ("consistent", "adapted"):
            mesh = program.folder / f"{fluxes}.h5"
            build_knit(program, problems[0], mesh, "--fluxes", fluxes)
            key = "adapted" if fluxes == "adapted" else "two_point"
            row[key] = [solve(program, p, mesh) for p in problems]
            row[f"{key}_linear"] = [pressure_error(program, mesh, axis) for axis in range(3)]
            if fluxes == "consistent":
                row["consistent"] = [solve(program, p, mesh, "--fluxes", "consistent") for p in problems]
        out[name] = row
        print(f"  {name}", flush=True)
    return out
