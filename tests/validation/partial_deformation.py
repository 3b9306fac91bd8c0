#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the mesh could be made in a space between the real one and the regular grid: X_l = (1 - l) X_real + l X_regular.

    partial_deformation.py MESH.h5 CASE.GRDECL

MESH.h5 is a mesh of the grid without faults or pinched layers, not refined, --optimise off. In X_l walls are no longer plane with all vertices on one circle
but for l = 1, so each is cut into two triangles, by the better diagonal. Printed for each l:

- how many triangles are not admissible: no sphere through the three corners is empty of the other vertices of the cavity's boundary; how many
  have no empty sphere with its centre inside (then no site can be in its cell);
- of the triangles that have one, the angle between the normal and the line from a site, half as far inside as it may be, to the centre of the cell
  beyond the wall (degrees, mean and 99th percentile), in X_l. The centre is the mapped one of the mesh;
- the shear that the way from X_l to the real space adds: the mean angle between a direction's images as normal and as line, over all
  directions and the taken cells. It is what inner faces lose.

Needs numpy, scipy, h5py.
"""
import argparse
import pathlib
import sys

import h5py
import numpy as np
from scipy.spatial import cKDTree

TRANSITION = 2
BLENDS = (1.0, 0.8, 0.6, 0.4, 0.2, 0.1, 0.0)


def read_nodes(path):
    """Nodes [nx+1, ny+1, nz+1, 3] of a grid whose pillars are not split."""
    arrays, key = {}, None
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        words = line.split("--")[0].split()
        if not words or words == ["/"]:
            continue
        if words[0][0].isalpha():
            key = words[0]
            arrays[key] = []
        else:
            arrays[key].extend(w for w in words if w != "/")
    nx, ny, nz = (int(v) for v in arrays["SPECGRID"][:3])
    coord = np.array(arrays["COORD"], float).reshape(ny + 1, nx + 1, 2, 3)
    zcorn = np.array(arrays["ZCORN"], float).reshape(2 * nz, 2 * ny, 2 * nx)
    pick = [np.minimum(2 * np.arange(n + 1), 2 * n - 1) for n in (nz, ny, nx)]
    z = zcorn[np.ix_(*pick)]
    top, base = coord[:, :, 0], coord[:, :, 1]
    share = (z - top[..., 2]) / (base[..., 2] - top[..., 2])
    plan = top[..., :2] + share[..., None] * (base[..., :2] - top[..., :2])
    return np.concatenate([plan, z[..., None]], -1).transpose(2, 1, 0, 3)


def trilinear(nodes, at):
    """Points and their derivatives by the place in the grid, [n, 3] and [n, 3, 3]."""
    shape = np.array(nodes.shape[:3])
    cell = np.clip(np.floor(at).astype(int), 0, shape - 2)
    t = at - cell
    point, slope = np.zeros_like(at), np.zeros(at.shape + (3,))
    for corner in np.ndindex(2, 2, 2):
        c = np.array(corner)
        weights = np.where(c == 1, t, 1 - t)
        value = nodes[tuple((cell + c).T)]
        point += weights.prod(1)[:, None] * value
        for axis in range(3):
            rest = np.delete(weights, axis, 1).prod(1) * (1 if c[axis] else -1)
            slope[:, :, axis] += rest[:, None] * value
    return point, slope


def places(nodes, points):
    """Where points lie in the grid, in cells."""
    tree = cKDTree(nodes.reshape(-1, 3))
    at = np.stack(np.unravel_index(tree.query(points)[1], nodes.shape[:3]), 1).astype(float)
    limit = np.array(nodes.shape[:3]) - 1.0
    for _ in range(60):
        value, slope = trilinear(nodes, at)
        at = np.clip(at + np.clip(np.linalg.solve(slope, (points - value)[..., None])[..., 0], -0.5, 0.5), 0, limit)
    error = np.linalg.norm(trilinear(nodes, at)[0] - points, axis=1)
    return at, error.max()


def rotation(source, target):
    """The rotation that turns one set of points nearest to another."""
    u, _, v = np.linalg.svd((source - source.mean(0)).T @ (target - target.mean(0)))
    return (u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v).T


def read_walls(path):
    """Loops of the cavity's walls, normals into the cavity by their order, cells beyond, and everything they index."""
    with h5py.File(path) as file:
        points, start, loop = file["vertices"][()], file["faces/vertex_start"][()], file["faces/vertices"][()]
        cells, kind, center = file["faces/cells"][()], file["cells/kind"][()], file["cells/center"][()]
        source = file["cells/source_cell"][()]
    is_made = (cells >= 0) & (kind[cells] == TRANSITION)
    walls = np.nonzero(is_made.sum(1) == 1)[0]
    loops = [loop[start[f]:start[f + 1]] for f in walls]
    loops = [w[::-1] if is_made[f, 0] else w for f, w in zip(walls, loops)]
    beyond = np.where(is_made[walls, 0], cells[walls, 1], cells[walls, 0])
    return points, loops, beyond, center, source[kind == 0]


def bounds(triangle, vertices):
    """Circumcentre, normal and the range of t for which the sphere around centre + t normal through the corners is empty."""
    a, b, c = triangle
    normal = np.cross(b - a, c - a)
    square = normal @ normal
    center = a + (np.cross(normal, b - a) * ((c - a) @ (c - a)) + np.cross(c - a, normal) * ((b - a) @ (b - a))) / (2 * square)
    normal = normal / np.sqrt(square)
    relative = vertices - center
    power = (relative ** 2).sum(1) - ((a - center) ** 2).sum()
    height = relative @ normal
    scale = np.sqrt(((a - center) ** 2).sum())
    above, below = height > 1e-9 * scale, height < -1e-9 * scale
    level = ~(above | below)
    if (power[level] < -1e-9 * scale ** 2).any():
        return center, normal, 1.0, 0.0
    high = (power[above] / (2 * height[above])).min(initial=np.inf)
    low = (power[below] / (2 * height[below])).max(initial=-np.inf)
    return center, normal, low, high


def cut(loop, points, vertices):
    """Triangles of a loop with their bounds: the diagonal whose worse triangle has the wider range."""
    best, widest = None, -np.inf
    for first in range(2 if len(loop) == 4 else 1):
        turned = np.roll(loop, -first)
        parts = [bounds(points[turned[[0, n, n + 1]]], vertices) for n in range(1, len(loop) - 1)]
        width = min(high - low for *_, low, high in parts)
        if width > widest:
            best, widest = parts, width
    return best


def shear(gradients, blend, turn, directions):
    """Mean angle between images as normal and as line, from X_l to the real space; gradients of the regular grid's."""
    between = np.linalg.inv((1 - blend) * gradients + blend * turn)
    way = gradients @ between
    lines = way @ directions.T
    normals = np.linalg.inv(way).transpose(0, 2, 1) @ directions.T
    cosine = (lines * normals).sum(1) / np.linalg.norm(lines, axis=1) / np.linalg.norm(normals, axis=1)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("grid")
    options = parser.parse_args()
    points, loops, beyond, center, left = read_walls(options.mesh)
    nodes = read_nodes(options.grid)
    taken = np.setdiff1d(np.arange(np.prod(np.array(nodes.shape[:3]) - 1)), left)
    nx, ny, _ = np.array(nodes.shape[:3]) - 1
    middles = np.stack([taken % nx, taken // nx % ny, taken // (nx * ny)], 1) + 0.5
    gradients = trilinear(nodes, middles)[1]
    spacing = np.linalg.norm(gradients, axis=1).mean(0)
    used = np.unique(np.concatenate(loops))
    at, error = places(nodes, points[used])
    cells = np.unique(beyond[beyond >= 0])
    cells_at, cells_error = places(nodes, center[cells])
    print(f"{len(loops)} walls, {len(used)} vertices; places found to {max(error, cells_error):.1e} m")
    turn = rotation(at * spacing, points[used])
    shift = points[used].mean(0) - (at * spacing).mean(0) @ turn.T
    regular, regular_cells = ((x * spacing) @ turn.T + shift for x in (at, cells_at))
    directions = np.random.default_rng(1).normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    place = np.full(len(points), -1)
    place[used] = np.arange(len(used))
    place_of_cell = {c: n for n, c in enumerate(cells)}
    print("| l | triangles | not admissible | without a centre inside | joints | shear |\n| --- | --- | --- | --- | --- | --- |")
    for blend in BLENDS:
        vertices = (1 - blend) * points[used] + blend * regular
        centers = (1 - blend) * center[cells] + blend * regular_cells
        angles, count, shut, no_center = [], 0, 0, 0
        for loop, cell in zip(loops, beyond):
            for middle, normal, low, high in cut(place[loop], vertices, vertices):
                count += 1
                shut += high <= low
                no_center += high > low and high <= 0
                if high <= max(low, 0.0) or cell < 0:
                    continue
                inside = max(low, 0.0) + 0.5 * (min(high, 1e3) - max(low, 0.0))
                line = middle + inside * normal - centers[place_of_cell[cell]]
                angles.append(np.degrees(np.arccos(np.clip(normal @ line / np.linalg.norm(line), -1, 1))))
        joints = f"{np.mean(angles):.1f} / {np.percentile(angles, 99):.1f}" if angles else "-"
        print(f"| {blend:g} | {count} | {shut} | {no_center} | {joints} | {shear(gradients / spacing, blend, turn, directions):.1f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
