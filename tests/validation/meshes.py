# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program and reads its mesh files."""
import json
import pathlib
import subprocess

import h5py
import numpy as np

BAR = 1e5
DAY = 86400.0
CENTIPOISE = 1e-3
TOP_AND_BASE = 2  # the axis of the normal
RADIAL = 3


class Failure(RuntimeError):
    pass


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = str(path), pathlib.Path(folder)

    def run(self, *arguments):
        done = subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failure(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return json.loads(done.stdout) if "--json" in arguments else done.stdout

    def build(self, case, out, *options):
        return self.run("build", case, "-o", out, "--overwrite", "--json", *options)

    def solve(self, mesh, out, *options):
        return self.run("solve", mesh, "-o", out, "--overwrite", "--json", *options)


def write_path(path, points):
    """A trajectory of straight parts as CSV; [n, 4] (measured depth, x, y, depth)."""
    points = np.asarray(points, float)
    md = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    rows = np.column_stack([md, points])
    with open(path, "w", encoding="ascii") as out:
        out.write("MD,X,Y,TVD\n")
        out.writelines("%.9g,%.9g,%.9g,%.9g\n" % tuple(row) for row in rows)
    return rows


class Faces:
    """Area vectors and centroids of all faces, each the fan of triangles around the mean of its vertices."""

    def __init__(self, file):
        points = file["vertices"][()]
        start, loop = file["faces/vertex_start"][()], file["faces/vertices"][()]
        self.cells = file["faces/cells"][()]
        count = np.diff(start)
        face = np.repeat(np.arange(len(count)), count)
        mean = np.zeros((len(count), 3))
        np.add.at(mean, face, points[loop])
        mean /= count[:, None]
        after = np.arange(len(loop)) + 1
        after[start[1:] - 1] = start[:-1]
        a, b = points[loop], points[loop[after]]
        triangle = 0.5 * np.cross(a - mean[face], b - mean[face])
        self.area_vector = np.zeros_like(mean)
        np.add.at(self.area_vector, face, triangle)
        self.area = np.linalg.norm(self.area_vector, axis=1)
        normal = self.area_vector / np.where(self.area > 0, self.area, 1)[:, None]
        weight = (triangle * normal[face]).sum(axis=1)
        moment = np.zeros_like(mean)
        np.add.at(moment, face, weight[:, None] * (a + b + mean[face]) / 3)
        self.centroid = np.where(self.area[:, None] > 0, moment / np.where(self.area > 0, self.area, 1)[:, None], mean)

    def outer(self, kinds, with_top_and_base, thickness=1e-6):
        """Outer faces but those of bores; without those whose normal is along depth where asked for."""
        cell = self.cells[:, 0]
        chosen = (self.cells[:, 1] < 0) & (self.area > 0)
        is_level = np.abs(self.area_vector[:, TOP_AND_BASE]) > (1 - thickness) * np.maximum(self.area, 1e-300)
        keep = chosen & (kinds[cell] != RADIAL) & (with_top_and_base | ~is_level)
        if with_top_and_base:  # a radial cell's level face is the top or base of the grid, not the bore
            keep |= chosen & (kinds[cell] == RADIAL) & is_level
        return np.nonzero(keep)[0]


def hold_faces(mesh, table, pressure, with_top_and_base=False, chosen=lambda centroid, area_vector: slice(None),
               thickness=1e-6):
    """Writes the table of held pressures (bar, a function of points) at the centroids of the outer faces."""
    with h5py.File(mesh) as file:
        faces = Faces(file)
        outer = faces.outer(file["cells/kind"][()], with_top_and_base, thickness)
        outer = outer[~on_bores(file, faces.centroid[outer])]
    outer = outer[chosen(faces.centroid[outer], faces.area_vector[outer])]
    values = pressure(faces.centroid[outer])
    with open(table, "w", encoding="ascii") as out:
        out.write("face,pressure_bar\n")
        out.writelines("%d,%.15g\n" % row for row in zip(outer, values))
    return len(outer)


def on_bores(file, points):
    """Whether points lie on a bore: the disc that closes its end is a face of a transition cell."""
    out = np.zeros(len(points), bool)
    for well in file.get("wells", {}).values():
        path, radius = well["trajectory"][()][:, 1:], 10.0 * well.attrs["bore_radius"]  # wide where depths are stretched
        for a, b in zip(path[:-1], path[1:]):
            share = np.clip((points - a) @ (b - a) / max((b - a) @ (b - a), 1e-30), 0, 1)
            out |= np.linalg.norm(points - a - share[:, None] * (b - a), axis=1) < radius
    return out


def mean_non_orthogonality(mesh):
    with h5py.File(mesh) as file:
        return float(file["connections/non_orthogonality"][()].mean())


def rate_unit(permeability_md, length):
    """2 pi k L / viscosity for 1 bar and 1 cP, m3/d: the rate of a unit of ln r."""
    return 2 * np.pi * permeability_md * 9.869232667160130e-16 * length / CENTIPOISE * BAR * DAY
