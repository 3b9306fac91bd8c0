# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which connections a rate's error comes from.

Let p be the exact pressure, Q the exact flux of each connection, and w the discrete pressure with 1 in the bore and
0 on the held
faces. As w is in balance and Q is, the discrete rate less the exact one is exactly

    sum over connections of (T (p_i - p_j) - Q_ij) (w_i - w_j)

with outer faces and well connections as connections of their own. So each class of connections has its part of the
error. (The
centre of a cell is a choice that moves parts between its connections, not their sum.)
"""
import h5py
import numpy as np

from meshes import BAR, Faces, RADIAL

KINDS = ("host", "refined", "transition", "radial")


def cell_points(file, ring_radii):
    """Where each cell carries its pressure: its centre; a radial cell at the radius of its mean pressure
    (docs/algorithms/flow.md)."""
    points = file["cells/center"][()]
    radius = np.full(len(points), np.nan)
    kind = file["cells/kind"][()]
    if (kind == RADIAL).any():
        ring = file["cells/radial_index"][()][:, 2]
        a, b = ring_radii[:-1] ** 2, ring_radii[1:] ** 2
        mean = np.exp((b * np.log(b) - a * np.log(a)) / (2 * (b - a)) - 0.5)
        radius[kind == RADIAL] = mean[ring[kind == RADIAL]]
    return points, radius


def connection_classes(file):
    pair = np.sort(file["cells/kind"][()][file["connections/cells"][()]], axis=1)
    return np.array([f"{KINDS[a]} - {KINDS[b]}" for a, b in pair])


def attribute(mesh, weights, solution, ring_radii, center, permeability):
    """{class of connections: its part of the rate's error, m3/s at 1 Pa s and bar as the unit of pressure}, for
    isotropic rock and one
    vertical well at `center` (x, y).

    weights: the mesh file with the pressures of 1 bar in the bore and 0 on the held faces; solution:
    pressure(points) in bar and its
    gradient(points); permeability: m2."""
    with h5py.File(mesh) as file, h5py.File(weights) as other:
        faces = Faces(file)
        names = connection_classes(file)
        points, radius = cell_points(file, ring_radii)
        offset = points[:, :2] - center
        is_ring = ~np.isnan(radius)
        points[is_ring, :2] = center + offset[is_ring] * (radius / np.linalg.norm(offset, axis=1))[is_ring, None]
        p, w = solution.pressure(points), other["flow/pressure"][()] / BAR
        pair, face = file["connections/cells"][()], file["connections/face"][()]
        sign = np.where(faces.cells[face, 0] == pair[:, 0], 1.0, -1.0)
        exact = -permeability * face_integral(file, face, solution.gradient) * sign
        error = file["connections/transmissibility"][()] * (p[pair[:, 0]] - p[pair[:, 1]]) - exact
        # Into the bore is positive.
        parts = -error * (w[pair[:, 0]] - w[pair[:, 1]])
    return {str(name): float(parts[names == name].sum()) for name in np.unique(names)}


def face_integral(file, chosen, flux_density):
    """Integral of a field's normal component over faces: each triangle of the fan by its edge middles."""
    points = file["vertices"][()]
    start, loop = file["faces/vertex_start"][()], file["faces/vertices"][()]
    count = np.diff(start)
    owner = np.repeat(np.arange(len(count)), count)
    mean = np.zeros((len(count), 3))
    np.add.at(mean, owner, points[loop])
    mean /= count[:, None]
    after = np.arange(len(loop)) + 1
    after[start[1:] - 1] = start[:-1]
    a, b, m = points[loop], points[loop[after]], mean[owner]
    normal = 0.5 * np.cross(a - m, b - m)
    value = sum((flux_density(0.5 * (u + v)) * normal).sum(axis=1) for u, v in ((a, b), (b, m), (m, a))) / 3
    total = np.zeros(len(count))
    np.add.at(total, owner, value)
    return total[chosen]
