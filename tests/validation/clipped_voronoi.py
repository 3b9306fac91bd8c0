#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A clipped Voronoi diagram in the place of the transition cells: what the published alternative to a deformed power diagram gives.

    clipped_voronoi.py WELLKNIT [--mesh FILE.h5 ...]

The diagram is that of the centres of the transition cells (of --optimise off) in the real space. It is clipped by the cavity's own walls, host
faces and the tube's outer faces, which it does not move: a wall face is cut into a piece for each Voronoi cell that meets it. This is how PEBI
grids are put into corner-point grids. Its inner faces are plane and orthogonal by construction; what that costs stands at the walls.

Without --mesh the case is a vertical well in a homogeneous slab (the suite's Thiem problem, cells of 50 m, deformations 0.5 and 1): with the
error of the two-point rate of both meshes, from one list of connections each that differ in those of the transition cells alone. With --mesh the
figures of geometry of that file.

Rows: faces; angle between a face's normal and the line of the centres (degrees, mean / 99th percentile, at the walls the mean by area too); faces whose area is below a thousandth of the
square of the smaller cell's size (transition cells; size: cube root of the mean volume); wall faces whose centre of a Voronoi cell lies
behind them; the rate's relative error.

How it is computed: the space of the transition cells is cut into tetrahedra (centre, middle of a face, edge); each Voronoi polygon is clipped by
these, each wall triangle by the cells near it. Needs numpy, scipy, h5py. Exit: 0 done, 77 something is missing.
"""
import argparse
import pathlib
import sys
import tempfile

try:
    import h5py
    import numpy as np
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve
    from scipy.spatial import Voronoi, cKDTree
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import cases
import hosts
import meshes

TRANSITION, RADIAL = 2, 3
SMALL = 1e-3  # of the square of a cell's size
NEAR = 40     # sites that can own a part of a wall triangle


def clip(polygons, counts, normal, offset):
    """The parts of polygons [n, m, 3] (counts [n] of vertices) with normal . x <= offset; one half-space for each."""
    n, m = polygons.shape[:2]
    slot = np.arange(m)
    is_there = slot < counts[:, None]
    following = np.where(slot + 1 < counts[:, None], slot + 1, 0)
    distance = (polygons * normal[:, None]).sum(2) - offset[:, None]
    other = np.take_along_axis(distance, following, 1)
    inside, other_inside = distance <= 0, other <= 0
    share = distance / np.where(distance == other, 1.0, distance - other)
    cut = polygons + share[..., None] * (np.take_along_axis(polygons, following[..., None], 1) - polygons)
    keep = np.stack([is_there & inside, is_there & (inside != other_inside)], 2).reshape(n, 2 * m)
    points = np.stack([polygons, cut], 2).reshape(n, 2 * m, 3)
    order = np.argsort(~keep, axis=1, kind="stable")
    counts = keep.sum(1)
    width = max(int(counts.max(initial=0)), 3)
    return np.take_along_axis(points, order[:, :width, None], 1), counts


def area_vectors(polygons, counts):
    relative = np.where((np.arange(polygons.shape[1]) < counts[:, None])[..., None], polygons - polygons[:, :1], 0.0)
    return 0.5 * np.cross(relative[:, :-1], relative[:, 1:]).sum(1)


def moments(polygons, counts):
    """Area times centroid of plane polygons, and the areas."""
    a, b = polygons[:, 1:-1], polygons[:, 2:]
    size = np.linalg.norm(np.cross(a - polygons[:, :1], b - polygons[:, :1]), axis=2) / 2
    size = np.where(np.arange(2, polygons.shape[1]) < counts[:, None], size, 0.0)
    return (size[..., None] * (a + b + polygons[:, :1]) / 3).sum(1), size.sum(1)


class Cavity:
    """The transition cells of a mesh file: sites, tetrahedra that fill them, triangles of their walls."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.faces = meshes.Faces(file)
            self.kind, self.center = file["cells/kind"][()], file["cells/center"][()]
            self.volume, self.permeability = file["cells/volume"][()], file["cells/permeability"][()]
            self.pairs, self.trans = file["connections/cells"][()], file["connections/transmissibility"][()]
            self.wells = [(w["connections/cell"][()], w["connections/well_index"][()]) for w in file["wells"].values()]
            points, start, loop = file["vertices"][()], file["faces/vertex_start"][()], file["faces/vertices"][()]
        self.cells = np.nonzero(self.kind == TRANSITION)[0]
        self.number = np.full(len(self.kind), -1)
        self.number[self.cells] = np.arange(len(self.cells))
        self.sites = self.center[self.cells]
        self.size = np.cbrt(self.volume[self.cells].mean())
        pair = self.faces.cells
        is_made = (pair >= 0) & (self.kind[pair] == TRANSITION)
        self.wall = np.nonzero(is_made.sum(1) == 1)[0]  # faces between a transition cell and something else
        self.inner = np.nonzero(is_made.all(1))[0]
        count = np.diff(start)
        face = np.repeat(np.arange(len(count)), count)
        following = np.arange(len(loop)) + 1
        following[start[1:] - 1] = start[:-1]
        middle = np.zeros((len(count), 3))
        np.add.at(middle, face, points[loop])
        middle /= count[:, None]
        corners = np.stack([middle[face], points[loop], points[loop[following]]], 1)
        chosen = is_made.any(1)[face]
        self.tetrahedra = np.concatenate([
            np.concatenate([corners[c], self.center[pair[face[c], side]][:, None]], 1)
            for side in (0, 1) for c in [np.nonzero(chosen & is_made[face, side])[0]]])
        on_wall = np.isin(face, self.wall)
        self.triangles, self.face_of_triangle = corners[on_wall], face[on_wall]

    def planes(self):
        """Outward normals and offsets of the tetrahedra's four sides: [n, 4, 3], [n, 4]."""
        t = self.tetrahedra
        normals = []
        for a, b, c, d in ((0, 1, 2, 3), (0, 3, 1, 2), (1, 3, 2, 0), (2, 3, 0, 1)):
            normal = np.cross(t[:, b] - t[:, a], t[:, c] - t[:, a])
            away = (normal * (t[:, d] - t[:, a])).sum(1) > 0
            normals.append((np.where(away[:, None], -normal, normal), t[:, a]))
        normal = np.stack([n for n, _ in normals], 1)
        return normal, (normal * np.stack([p for _, p in normals], 1)).sum(2)


def voronoi_polygons(sites):
    """Pairs of sites and the polygons between them, [m, k, 3] and counts; far points close the outer cells."""
    low, high = sites.min(0), sites.max(0)
    middle, reach = 0.5 * (low + high), 10.0 * (high - low).max()
    far = middle + reach * np.array([[i, j, k] for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if i or j or k])
    diagram = Voronoi(np.concatenate([sites, far]))
    rows = [(p, v) for p, v in zip(diagram.ridge_points, diagram.ridge_vertices) if p.max() < len(sites) and min(v) >= 0]
    pairs = np.array([p for p, _ in rows])
    counts = np.array([len(v) for _, v in rows])
    polygons = np.zeros((len(rows), counts.max(), 3))
    for n, (pair, ridge) in enumerate(rows):
        corners = diagram.vertices[ridge]
        normal = sites[pair[1]] - sites[pair[0]]
        across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        relative = corners - corners.mean(0)
        order = np.argsort(np.arctan2(relative @ np.cross(normal, across) / np.linalg.norm(normal), relative @ across))
        polygons[n, :counts[n]] = corners[order]
    return pairs, polygons, counts


def inner_faces(cavity):
    """Pairs of sites and the areas of the polygons between them within the cavity."""
    pairs, polygons, counts = voronoi_polygons(cavity.sites)
    normal, offset = cavity.planes()
    low, high = cavity.tetrahedra.min(1), cavity.tetrahedra.max(1)
    areas = np.zeros(len(pairs))
    for n, (polygon, count) in enumerate(zip(polygons, counts)):
        corners = polygon[:count]
        line = cavity.sites[pairs[n, 1]] - cavity.sites[pairs[n, 0]]
        near = np.nonzero((low <= corners.max(0)).all(1) & (high >= corners.min(0)).all(1))[0]
        if not len(near):
            continue
        side = (cavity.tetrahedra[near] - corners[0]) @ line
        near = near[(side.min(1) < 0) & (side.max(1) > 0)]
        if not len(near):
            continue
        part, part_count = np.repeat(corners[None], len(near), 0), np.full(len(near), count)
        for k in range(4):
            part, part_count = clip(part, part_count, normal[near, k], offset[near, k])
        areas[n] = moments(part, part_count)[1].sum()
    return pairs, areas


def wall_pieces(cavity):
    """Wall faces cut by the Voronoi cells: face, site, area, centroid of each piece."""
    tree = cKDTree(cavity.sites)
    count = min(NEAR, len(cavity.sites))
    near = tree.query(cavity.triangles.mean(1), count)[1]
    out = []
    for column in range(count):
        own = cavity.sites[near[:, column]]
        part, part_count = cavity.triangles, np.full(len(cavity.triangles), 3)
        row = np.arange(len(part))
        for other in range(count):
            if other == column or not len(row):
                continue
            a, b = own[row], cavity.sites[near[row, other]]
            part, part_count = clip(part, part_count, b - a, 0.5 * ((b ** 2).sum(1) - (a ** 2).sum(1)))
            keep = part_count > 2
            part, part_count, row = part[keep], part_count[keep], row[keep]
        if len(row):
            moment, area = moments(part, part_count)
            out.append((cavity.face_of_triangle[row], near[row, column], area, moment))
    face, site, area, moment = (np.concatenate([o[k] for o in out]) for k in range(4))
    key, at = np.unique(face * len(cavity.sites) + site, return_inverse=True)
    total, center = np.zeros(len(key)), np.zeros((len(key), 3))
    np.add.at(total, at.ravel(), area)
    np.add.at(center, at.ravel(), moment)
    # Nearly all of each wall: a far site that owns a part of it would be missing.
    lost = 1.0 - total.sum() / cavity.faces.area[cavity.wall].sum()
    if abs(lost) > 0.02:
        raise meshes.Failure(f"{100 * lost:.1f} % of the walls belong to no Voronoi cell")
    good = total > 1e-12 * cavity.size ** 2
    return key[good] // len(cavity.sites), key[good] % len(cavity.sites), total[good], center[good] / total[good, None]


def angle(normal, line):
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(normal, line), axis=1), (normal * line).sum(1)))


def other_cells(cavity, face):
    """Of wall faces: the cell on the other side (-1: none) and the unit normal out of the cavity."""
    pair = cavity.faces.cells[face]
    is_first = cavity.number[pair[:, 0]] >= 0
    normal = cavity.faces.area_vector[face] / cavity.faces.area[face, None]
    return np.where(is_first, pair[:, 1], pair[:, 0]), np.where(is_first[:, None], normal, -normal)


def half(permeability, area, normal, way):
    """Half-transmissibility of a host cell, from its centre to a face's centroid."""
    return area * ((normal * permeability) * way).sum(1) / (way ** 2).sum(1)


def site_half(permeability, area, normal, way):
    """That of a cell whose site stands over the plane of the face (docs/algorithms/flow.md)."""
    height = np.maximum(np.abs((normal * way).sum(1)), 0.1 * np.linalg.norm(way, axis=1))
    return area * (normal ** 2 * permeability).sum(1) / height


class Mesh:
    """Faces of the transition cells: inner ones, and those at the walls with what is on the other side."""

    def __init__(self, cavity, is_voronoi):
        self.cavity, self.is_voronoi = cavity, is_voronoi
        if is_voronoi:
            pairs, area = inner_faces(cavity)
            keep = area > 1e-12 * cavity.size ** 2
            self.pairs, self.area = cavity.cells[pairs[keep]], area[keep]
            a, b = (cavity.center[self.pairs[:, n]] for n in (0, 1))
            self.normal, self.middle = (b - a) / np.linalg.norm(b - a, axis=1)[:, None], 0.5 * (a + b)
            self.face, site, self.wall_area, self.wall_middle = wall_pieces(cavity)
            self.wall_cell = cavity.cells[site]
        else:
            faces = cavity.faces
            self.pairs, self.area = faces.cells[cavity.inner], faces.area[cavity.inner]
            self.normal, self.middle = faces.area_vector[cavity.inner] / self.area[:, None], faces.centroid[cavity.inner]
            self.face = cavity.wall
            self.wall_area, self.wall_middle = faces.area[self.face], faces.centroid[self.face]
            pair = faces.cells[self.face]
            self.wall_cell = np.where(cavity.number[pair[:, 0]] >= 0, pair[:, 0], pair[:, 1])
        self.beyond, self.wall_normal = other_cells(cavity, self.face)

    def figures(self):
        center = self.cavity.center
        inner = angle(self.normal, center[self.pairs[:, 1]] - center[self.pairs[:, 0]])
        joint = self.beyond >= 0
        walls = angle(self.wall_normal[joint], center[self.beyond[joint]] - center[self.wall_cell[joint]])
        is_radial = self.cavity.kind[self.beyond[joint]] == RADIAL
        ahead = ((self.wall_middle - center[self.wall_cell]) * self.wall_normal).sum(1)
        small = SMALL * self.cavity.size ** 2
        return {"cells": len(self.cavity.cells), "inner faces": len(inner), "inner angle": summary(inner), "wall faces": int(joint.sum()),
                "host": summary(walls[~is_radial], self.wall_area[joint][~is_radial]), "radial": summary(walls[is_radial], self.wall_area[joint][is_radial]), "beyond 90": int((walls >= 90).sum()),
                "behind": int((ahead <= 0).sum()), "small": int((self.area < small).sum() + (self.wall_area[joint] < small).sum())}

    def connections(self):
        """Pairs and transmissibilities of the whole mesh: the file's own but for those of transition cells. At a wall the other
        cell's half is what the file's connection has beyond the transition cell's, by area."""
        c = self.cavity
        if not self.is_voronoi:
            return c.pairs, c.trans
        own = (c.kind[c.pairs] == TRANSITION).any(1)
        perm = c.permeability
        t = [site_half(perm[self.pairs[:, n]], self.area, self.normal, self.middle - c.center[self.pairs[:, n]]) for n in (0, 1)]
        inner = series(*t)
        joint = self.beyond >= 0
        mine = site_half(perm[self.wall_cell], self.wall_area, self.wall_normal, self.wall_middle - c.center[self.wall_cell])
        other = self.beyond_half()[self.face] * self.wall_area / c.faces.area[self.face]
        pairs = np.concatenate([c.pairs[~own], self.pairs, np.stack([self.wall_cell, self.beyond], 1)[joint]])
        return pairs, np.concatenate([c.trans[~own], inner, series(mine, other)[joint]])

    def beyond_half(self):
        """Per face of the file: the half-transmissibility of the cell beyond a wall."""
        c = self.cavity
        known = {tuple(sorted(p)): t for p, t in zip(c.pairs.tolist(), c.trans)}
        out = np.zeros(len(c.faces.cells))
        beyond, normal = other_cells(c, c.wall)
        pair = c.faces.cells[c.wall]
        cell = np.where(c.number[pair[:, 0]] >= 0, pair[:, 0], pair[:, 1])
        mine = site_half(c.permeability[cell], c.faces.area[c.wall], normal, c.faces.centroid[c.wall] - c.center[cell])
        for n in np.nonzero(beyond >= 0)[0]:
            rest = 1.0 / known[tuple(sorted((cell[n], beyond[n])))] - 1.0 / mine[n]
            out[c.wall[n]] = 1.0 / max(rest, 1e-30)
        return out

    def rate_error(self, exact):
        """Of the two-point rate, with the exact pressure held on the outer faces."""
        c = self.cavity
        pairs, trans = self.connections()
        outer = c.faces.outer(c.kind, False)
        cell = c.faces.cells[outer, 0]
        normal = c.faces.area_vector[outer] / c.faces.area[outer, None]
        held = half(c.permeability[cell], c.faces.area[outer], normal, c.faces.centroid[outer] - c.center[cell])
        well, index = c.wells[0]
        n = len(c.kind)
        diagonal = np.zeros(n)
        right = np.zeros(n)
        for at, t, p in ((cell, held, exact.pressure(c.faces.centroid[outer])), (well, index, exact.bore_pressures[0])):
            np.add.at(diagonal, at, t)
            np.add.at(right, at, t * p)
        for side in (0, 1):
            np.add.at(diagonal, pairs[:, side], trans)
        a, b = pairs.T
        every = np.arange(n)
        matrix = coo_matrix((np.concatenate([diagonal, -trans, -trans]), (np.concatenate([every, a, b]), np.concatenate([every, b, a]))))
        pressure = spsolve(matrix.tocsc(), right)
        rate = (index * (pressure[well] - exact.bore_pressures[0])).sum() * meshes.BAR * meshes.DAY / meshes.CENTIPOISE
        return rate / exact.rates[0] - 1.0


def series(a, b):
    return a * b / (a + b)


def summary(values, weights=None):
    if not len(values):
        return "-"
    by_area = "" if weights is None else f" ({np.average(values, weights=weights):.1f})"
    return f"{values.mean():.1f} / {np.percentile(values, 99):.1f}{by_area}"


def row(name, mesh, exact=None):
    f = mesh.figures()
    error = f"{100 * mesh.rate_error(exact):.2f} %" if exact else ""
    print(f"| {name} | {f['cells']} | {f['inner faces']} | {f['inner angle']} | {f['wall faces']} | {f['host']} | {f['radial']} | "
          f"{f['beyond 90']} | {f['behind']} | {f['small']} | {error} |", flush=True)


def thiem(program, deform):
    problem = cases.thiem_problem(50.0, deform)
    meshes.write_path(program.folder / "well.csv", problem.wells[0])
    hosts.write_grdecl(problem.grid, program.folder / "host.GRDECL")
    out = program.folder / "mesh.h5"
    for setting in ("off", "on"):
        program.build(program.folder / "host.GRDECL", out, "--well", f"{program.folder}/well.csv,name=W0,bore={problem.bore}", "--optimise", setting)
        cavity = Cavity(out)
        row(f"Thiem, deformation {deform:g}, `{setting}`", Mesh(cavity, False), problem.exact)
        if setting == "off":
            row("clipped Voronoi", Mesh(cavity, True), problem.exact)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="WELLKNIT")
    parser.add_argument("--mesh", nargs="+", default=[], metavar="FILE.h5")
    options = parser.parse_args()
    print("| mesh | transition cells | inner faces | their angles | wall faces | with the host | with radial cells | beyond 90 | behind | small faces | rate |\n"
          "|" + " --- |" * 11)
    for path in options.mesh:
        cavity = Cavity(path)
        row(pathlib.Path(path).stem, Mesh(cavity, False))
        row("clipped Voronoi", Mesh(cavity, True))
    if options.mesh:
        return 0
    with tempfile.TemporaryDirectory() as folder:
        for deform in (0.5, 1.0):
            thiem(meshes.Program(pathlib.Path(options.program).resolve(), folder), deform)
    return 0


if __name__ == "__main__":
    sys.exit(main())
