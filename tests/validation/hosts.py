# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Corner-point hosts: a slab with flat top and base whose inside is deformed, splitting of columns, GRDECL.

Depth is positive down, lengths in m, permeability in mD. Arrays run k, j, i.
"""
from dataclasses import dataclass

import numpy as np


@dataclass
class Grid:
    coord: np.ndarray  # [ny+1, nx+1, 6]: the top and bottom point of each pillar
    zcorn: np.ndarray  # [2nz, 2ny, 2nx]
    values: dict       # keyword to [nz, ny, nx]

    @property
    def shape(self):
        return tuple(n // 2 for n in self.zcorn.shape)

    def pillars_at(self, depth, part=np.s_[:, :]):
        """Plan positions of the pillars (or of a part of them) at a depth: [ny+1, nx+1, 2]."""
        top, base = self.coord[part][..., :3], self.coord[part][..., 3:]
        height = base[..., 2] - top[..., 2]
        safe = np.where(height == 0, 1.0, height)
        share = np.where(height == 0, 0.0, (depth - top[..., 2]) / safe)
        return top[..., :2] + share[..., None] * (base[..., :2] - top[..., :2])

    def column_depths(self, i, j, s, t):
        """Depths of the tops and bases of a column's cells at (s, t) of it: [nz, 2]."""
        corners = self.zcorn[:, 2 * j:2 * j + 2, 2 * i:2 * i + 2]
        weights = np.array([[(1 - s) * (1 - t), s * (1 - t)], [(1 - s) * t, s * t]])
        return (corners * weights).sum(axis=(1, 2)).reshape(-1, 2)

    def axes(self, i, j, k):
        """From the middle of one face to that of the opposite one, along i, j and k."""
        z = self.zcorn[2 * k:2 * k + 2, 2 * j:2 * j + 2, 2 * i:2 * i + 2]
        corners = np.empty((2, 2, 2, 3))
        pillars = self.coord[j:j + 2, i:i + 2]
        height = pillars[..., 5] - pillars[..., 2]
        share = np.where(height == 0, 0.0, (z - pillars[..., 2]) / np.where(height == 0, 1.0, height))
        corners[..., :2] = pillars[..., :2] + share[..., None] * (pillars[..., 3:5] - pillars[..., :2])
        corners[..., 2] = z
        return [np.diff(corners, axis=axis).mean(axis=(0, 1, 2)) for axis in (2, 1, 0)]

    def cell_size(self, i, j, k):
        """Peaceman's sizes: between the middles of opposite faces, in plan, in plan and in depth."""
        along = self.axes(i, j, k)
        return np.array([np.hypot(*along[0][:2]), np.hypot(*along[1][:2]), abs(along[2][2])])


def slab(shape, size, deform, permeability=(100.0, 100.0, 100.0), depth=2000.0, flat_layers=False, straight_side=False):
    """shape: nx, ny, nz; size: dx, dy, dz. The deformation is that of make_case.py --slab: interfaces that undulate
    between a
    flat top and base, pillars that lean and bend in plan by up to 0.8 of a cell, all of it times `deform`.
    flat_layers: only the pillars are deformed. straight_side: the side j- stays in the plane y = 0. permeability: three
    numbers, or one triple for each layer."""
    nx, ny, nz = shape
    dx, dy, dz = size
    lx, ly, lz = nx * dx, ny * dy, nz * dz
    x, y = np.meshgrid(np.arange(nx + 1) * dx, np.arange(ny + 1) * dy)
    u, v = x / lx, y / ly
    k = np.arange(nz + 1).reshape(-1, 1, 1)
    wave = 0.0 if flat_layers else np.sin(5 * np.pi * u) * np.cos(4 * np.pi * v)
    nodes = depth + k * dz + 0.25 * deform * lz * np.sin(np.pi * k / nz) / np.pi * wave + 0.0 * x
    ends = []
    for z in (depth - lz, depth + 2 * lz):
        w = ((z - depth) / lz - 0.5) * deform
        shift_x = (0.25 * lz + 0.02 * lx * np.sin(3 * np.pi * v)) * w + 0.8 * dx * deform * np.sin(5 * np.pi * v)
        shift_y = 0.15 * lz * np.cos(2 * np.pi * u) * w + 0.8 * dy * deform * np.sin(6 * np.pi * u)
        if straight_side:
            shift_y = shift_y * np.minimum(1.0, y / (5 * dy))
        ends += [x + shift_x, y + shift_y, np.full_like(x, z)]
    rows, columns = np.arange(2 * ny), np.arange(2 * nx)
    layers = np.arange(2 * nz)
    zcorn = nodes[np.ix_((layers + 1) // 2, (rows + 1) // 2, (columns + 1) // 2)]
    triples = np.broadcast_to(np.asarray(permeability, float), (nz, 3))
    values = {"PORO": np.full((nz, ny, nx), 0.2)}
    for axis, keyword in enumerate(("PERMX", "PERMY", "PERMZ")):
        values[keyword] = np.broadcast_to(triples[:, axis][:, None, None], (nz, ny, nx))
    return Grid(np.stack(ends, -1), zcorn, values)


def split_columns(grid, parts):
    """Each column in parts x parts, between straight lines of its own pillars; layers stay."""
    nz, ny, nx = grid.shape
    top, base = grid.coord[..., 2].min(), grid.coord[..., 5].max()
    coord = []
    for depth in (top, base):
        plan = grid.pillars_at(depth)
        coord.append(np.concatenate([plan, np.full(plan.shape[:2] + (1,), depth)], -1))
    for axis in (0, 1):
        coord = [_split_nodes(c, parts, axis) for c in coord]
    z = grid.zcorn.reshape(2 * nz, ny, 2, nx, 2)
    share = (np.arange(parts)[:, None] + np.arange(2)) / parts  # of part and end
    z = np.einsum("kjbia,pqa->kjbipq", z, np.stack([1 - share, share], -1)).reshape(2 * nz, ny, 2, 2 * nx * parts)
    z = np.einsum("kjbi,pqb->kjpqi", z, np.stack([1 - share, share], -1))
    z = z.reshape(2 * nz, 2 * ny * parts, 2 * nx * parts)
    values = {key: np.repeat(np.repeat(v, parts, 1), parts, 2) for key, v in grid.values.items()}
    return Grid(np.concatenate(coord, -1), z, values)


def _split_nodes(nodes, parts, axis):
    count = nodes.shape[axis] - 1
    place = np.arange(count * parts + 1) / parts
    low = np.minimum(place.astype(int), count - 1)
    share = (place - low).reshape([-1 if a == axis else 1 for a in range(nodes.ndim)])
    return np.take(nodes, low, axis) * (1 - share) + np.take(nodes, low + 1, axis) * share


def write_grdecl(grid, path):
    nz, ny, nx = grid.shape
    with open(path, "w", encoding="ascii") as out:
        out.write(f"SPECGRID\n {nx} {ny} {nz} 1 F /\n")
        for keyword, values in (("COORD", grid.coord), ("ZCORN", grid.zcorn), *grid.values.items()):
            flat = np.asarray(values).ravel()
            form = "%d" if flat.dtype.kind in "iu" else "%.9g"
            out.write(keyword + "\n")
            padded = [flat[n:n + 4096] for n in range(0, flat.size, 4096)]
            for block in padded:
                text = (form + " ") * block.size % tuple(block)
                out.write("\n".join(_lines(text)) + "\n")
            out.write("/\n")


def _lines(text, width=110):
    words = text.split()
    count = max(1, width // (max(map(len, words)) + 1))
    return [" ".join(words[n:n + count]) for n in range(0, len(words), count)]
