# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of a mesh file that the checks of other formats compare with, and steady flow on any connection list."""
import pathlib

import h5py
import numpy as np


class Mesh:
    """Arrays of the mesh file; faces as fans of triangles around the mean of their vertices."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.points = file["vertices"][:]
            self.start = file["faces/vertex_start"][:]
            self.loops = file["faces/vertices"][:]
            self.face_cells = file["faces/cells"][:]
            cells, connections = file["cells"], file["connections"]
            self.center, self.centroid = cells["center"][:], cells["centroid"][:]
            self.volume, self.depth, self.kind = cells["volume"][:], cells["depth"][:], cells["kind"][:]
            self.pore_volume, self.permeability = cells["pore_volume"][:], cells["permeability"][:]
            self.pairs = connections["cells"][:]
            self.transmissibility = connections["transmissibility"][:]
            self.area = connections["area"][:]
            self.connection_face = connections["face"][:]
            names = [n.decode() if isinstance(n, bytes) else n for n in file["wells_order"][:]]
            wells = [file["wells"][name]["connections"] for name in names]
            self.wells = {name: (w["cell"][:], w["well_index"][:]) for name, w in zip(names, wells)}
        self.area_vector, self.face_centroid = self.face_geometry()

    def loop(self, face):
        return self.loops[self.start[face]:self.start[face + 1]]

    def face_geometry(self):
        sizes = np.diff(self.start)
        face = np.repeat(np.arange(len(sizes)), sizes)
        by_face = lambda values: np.stack([np.bincount(face, v, len(sizes)) for v in values.T], -1)
        after = np.arange(len(self.loops)) + 1
        after[self.start[1:] - 1] = self.start[:-1]
        points, following = self.points[self.loops], self.points[self.loops[after]]
        # Relative to a point of the face: sums of products of map coordinates would cost digits.
        origin = self.points[self.loops[self.start[:-1]]]
        middle = (by_face(points - origin[face]) / sizes[:, None] + origin)[face]
        parts = np.cross(points - middle, following - middle) / 2
        weight = np.linalg.norm(parts, axis=1)
        moment = by_face(weight[:, None] * ((points - origin[face]) + (following - origin[face]) + (middle - origin[face])) / 3)
        return by_face(parts), moment / np.bincount(face, weight, len(sizes))[:, None] + origin


def meshes(folder):
    """Name and mesh file of every example."""
    found = sorted(pathlib.Path(folder).glob("*.h5"))
    if not found:
        raise SystemExit(f"no mesh file in {folder}")
    return [(path.stem, path) for path in found]


def conjugate_gradients(diagonal, pairs, transmissibility, right):
    """Solves the symmetric matrix with this diagonal and -transmissibility beside it, preconditioned by the diagonal."""
    count = len(diagonal)

    def times(x):
        flow = transmissibility * (x[pairs[:, 0]] - x[pairs[:, 1]])
        return own * x + np.bincount(pairs[:, 0], flow, count) - np.bincount(pairs[:, 1], flow, count)
    own = diagonal - np.bincount(pairs[:, 0], transmissibility, count) - np.bincount(pairs[:, 1], transmissibility, count)
    scale = np.where(diagonal > 0, diagonal, 1)
    x, rest = np.zeros(count), right.copy()
    ahead = along = rest / scale
    size = first = rest @ ahead
    for _ in range(20000):
        image = times(along)
        step = size / (along @ image)
        x += step * along
        rest -= step * image
        ahead = rest / scale
        size, before = rest @ ahead, size
        if size < 1e-26 * first:
            break
        along = ahead + size / before * along
    return x


def well_rates(count, pairs, transmissibility, wells):
    """Steady rates into the bores: the first well's bore at 1, the others' at 0; viscosity 1, no gravity."""
    diagonal = np.bincount(pairs[:, 0], transmissibility, count) + np.bincount(pairs[:, 1], transmissibility, count)
    right = np.zeros(count)
    bore = {name: 1.0 if n == 0 else 0.0 for n, name in enumerate(sorted(wells))}
    for name, (cells, index) in wells.items():
        np.add.at(diagonal, cells, index)
        np.add.at(right, cells, index * bore[name])
    scale = diagonal.max()
    pressure = conjugate_gradients(diagonal / scale, pairs, transmissibility / scale, right / scale)
    return np.array([np.sum(wells[name][1] * (pressure[wells[name][0]] - bore[name])) for name in sorted(wells)])


class Faults(list):
    """What differs, as texts."""

    def compare(self, what, found, expected, tolerance, scale=None):
        found, expected = np.asarray(found, float), np.asarray(expected, float)
        if found.shape != expected.shape:
            self.append(f"{what}: shape {found.shape}, expected {expected.shape}")
        elif expected.size:
            size = np.abs(expected).max() if scale == "largest" else np.abs(expected)
            off = np.abs(found - expected) - tolerance * size
            if not (off <= 0).all():
                worst = np.unravel_index(np.argmax(off), off.shape)
                self.append(f"{what}: {found[worst]!r} at {worst}, expected {expected[worst]!r}")

    def rates(self, mesh, pairs, transmissibility, wells, tolerance=1e-6, unit=1.0):
        """Transmissibilities and well indices in `unit` per m3. The largest relative difference, None without wells."""
        if len(mesh.wells) < 2:
            return None
        ours = well_rates(len(mesh.volume), mesh.pairs, mesh.transmissibility, mesh.wells)
        theirs = well_rates(len(mesh.volume), pairs, transmissibility, wells) / unit
        difference = np.abs(theirs / ours - 1).max()
        if not difference < tolerance:
            self.append(f"steady rates {theirs}, expected {ours}")
        return difference
