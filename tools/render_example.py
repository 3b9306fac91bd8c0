#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws true cuts of a mesh file: host, transition and radial cells in three colours.

    render_example.py MESH.h5 OUT.png [--along WELL] [--around WELL] [--depth METRES]
Four pictures: a vertical section that follows the path of the well ALONG, a cut across its middle, a plan at DEPTH, and the
plan around the well AROUND. Every polygon is the intersection of one polyhedral cell with a plane, computed here from the
plain arrays of the file. Needs python3-numpy, python3-h5py and python3-matplotlib.
"""
import argparse

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  the backend must be chosen first
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

HOST, REFINED, TRANSITION, RADIAL = range(4)
COLOUR = {HOST: "#ece7db", REFINED: "#d5cdb8", TRANSITION: "#8dbad9", RADIAL: "#f0a04b"}
EDGE_COLOUR = "#33383d"
BORE_COLOUR = "#b3261e"


class Mesh:
    """The arrays of a mesh file that a cut needs."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.vertices = file["vertices"][:]
            start, flat = file["faces/vertex_start"][:], file["faces/vertices"][:]
            self.loops = [flat[a:b] for a, b in zip(start[:-1], start[1:])]
            self.face_cells = file["faces/cells"][:]
            self.kind = file["cells/kind"][:]
            self.paths = {name: group["trajectory"][:, 1:] for name, group in file["wells"].items()}
        self.faces = [[] for _ in self.kind]
        for face, cells in enumerate(self.face_cells):
            for cell in cells:
                if cell >= 0:
                    self.faces[cell].append(face)


def face_crossings(loop, side, distance):
    """Segments, as pairs of (edge, share of its length), in which a face's polygon meets the plane."""
    crossings = []
    for a, b in zip(loop, np.roll(loop, -1)):
        if side[a] != side[b]:
            low, high = (a, b) if a < b else (b, a)
            crossings.append(((low, high), distance[low] / (distance[low] - distance[high])))
    # A convex face has one pair; a bent one may have two, which follow one another around it.
    return list(zip(crossings[::2], crossings[1::2]))


def chained(segments):
    """Closed rings of edges from segments that share them."""
    neighbours = {}
    for (a, _), (b, _) in segments:
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    rings, seen = [], set()
    for first in neighbours:
        ring, here = [], first
        while here is not None and here not in seen:
            seen.add(here)
            ring.append(here)
            here = next((n for n in neighbours[here] if n not in seen), None)
        if len(ring) > 2:
            rings.append(ring)
    return rings


def cut(mesh, origin, u, v):
    """Polygons of the plane through origin with axes u and v: [(kind, n x 2 array of (u, v))]."""
    distance = (mesh.vertices - origin) @ np.cross(u, v)
    side = distance > 0
    mixed = np.zeros(len(mesh.kind), bool)
    segments_of_face = {}
    for face, loop in enumerate(mesh.loops):
        above = side[loop]
        if above.any() and not above.all():
            segments_of_face[face] = face_crossings(loop, side, distance)
            cells = mesh.face_cells[face]
            mixed[cells[cells >= 0]] = True
    polygons = []
    for cell in np.flatnonzero(mixed):
        segments = [s for face in mesh.faces[cell] for s in segments_of_face.get(face, [])]
        share = {edge: t for pair in segments for edge, t in pair}
        for ring in chained(segments):
            points = np.array([mesh.vertices[a] + share[a, b] * (mesh.vertices[b] - mesh.vertices[a]) for a, b in ring]) - origin
            polygons.append((mesh.kind[cell], np.column_stack([points @ u, points @ v])))
    return polygons


def clipped(polygon, left, right):
    """The polygon between two vertical lines."""
    for limit, sign in ((left, 1.0), (right, -1.0)):
        out = []
        for p, q in zip(polygon, np.roll(polygon, -1, axis=0)):
            inside_p, inside_q = sign * (p[0] - limit) >= 0, sign * (q[0] - limit) >= 0
            if inside_p:
                out.append(p)
            if inside_p != inside_q:
                out.append(p + (limit - p[0]) / (q[0] - p[0]) * (q - p))
        polygon = np.array(out)
        if len(polygon) < 3:
            return None
    return polygon


def section(mesh, path, margin):
    """Vertical section along the plan view of a path, unrolled: polygons over (distance along it, depth)."""
    plan = path[:, :2]
    step = np.diff(plan, axis=0)
    plan = plan[np.concatenate([[True], np.hypot(*step.T) > 1e-6])]
    first, last = plan[0] - plan[1], plan[-1] - plan[-2]
    plan = np.vstack([plan[0] + margin * first / np.hypot(*first), plan, plan[-1] + margin * last / np.hypot(*last)])
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plan, axis=0).T))]) - margin
    polygons, seams = [], []
    for a, b, start, end in zip(plan[:-1], plan[1:], length[:-1], length[1:]):
        u = np.append((b - a) / np.hypot(*(b - a)), 0.0)
        for kind, polygon in cut(mesh, np.append(a, 0.0), u, np.array([0.0, 0.0, 1.0])):
            piece = clipped(polygon + [start, 0.0], start, end)
            if piece is not None:
                polygons.append((kind, piece))
        seams += [start, end]
    return polygons, np.unique(np.round(seams, 6))


def draw(axes, polygons, window, seams=(), line=0.35):
    """Fills the polygons that reach into the window (left, right, top, bottom); lines at the seams of a section are left out."""
    left, right, top, bottom = window
    for kind in (HOST, REFINED, TRANSITION, RADIAL):
        shown = [p for k, p in polygons
                 if k == kind and p[:, 0].max() > left and p[:, 0].min() < right and p[:, 1].max() > top and p[:, 1].min() < bottom]
        axes.add_collection(PolyCollection(shown, facecolors=COLOUR[kind], edgecolors=COLOUR[kind], linewidths=0.6))
        edges = []
        for polygon in shown:
            for p, q in zip(polygon, np.roll(polygon, -1, axis=0)):
                if not (len(seams) and abs(p[0] - q[0]) < 1e-6 and np.min(np.abs(np.asarray(seams) - p[0])) < 1e-5):
                    edges.append((p, q))
        axes.add_collection(LineCollection(edges, colors=EDGE_COLOUR, linewidths=line, capstyle="round"))
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    axes.tick_params(labelsize=7, length=2)


def point_at(path, share):
    """The point and the direction at this share of a path's length."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    at = share * length[-1]
    n = min(np.searchsorted(length, at, side="right"), len(path) - 1)
    step = path[n] - path[n - 1]
    return path[n - 1] + (at - length[n - 1]) / (length[n] - length[n - 1]) * step, step / np.linalg.norm(step)


def crossing(path, depth):
    """Where a path passes a depth, in plan."""
    return np.array([np.interp(depth, path[:, 2], path[:, c]) for c in (0, 1)])


def draw_section(axes, mesh, path, name):
    margin = 75.0
    polygons, seams = section(mesh, path, margin)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path[:, :2], axis=0).T))])
    depths = np.concatenate([polygon[:, 1] for _, polygon in polygons])
    top, bottom = depths.min(), depths.max()
    draw(axes, polygons, (-margin, along[-1] + margin, top - 3.0, bottom + 3.0), seams)
    axes.plot(along, path[:, 2], color=BORE_COLOUR, linewidth=0.7)
    axes.set_title(f"vertical section along the well '{name}'", fontsize=9, loc="left")
    axes.set_xlabel("along the well's plan view, m", fontsize=7)
    axes.set_ylabel("depth, m", fontsize=7)


def draw_across(axes, mesh, path, share, half):
    origin, tangent = point_at(path, share)
    u = np.cross(tangent, [0.0, 0.0, 1.0])
    u /= np.linalg.norm(u)
    v = np.cross(u, tangent)
    v *= np.sign(v[2])
    draw(axes, cut(mesh, origin, u, v), (-half, half, -half, half), line=0.5)
    axes.set_title("across it", fontsize=9, loc="left")
    axes.set_xlabel("m from the well", fontsize=7)


def draw_plan(axes, mesh, depth, window, title, line, axis_label):
    polygons = cut(mesh, np.array([0.0, 0.0, depth]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    draw(axes, polygons, window, line=line)
    axes.invert_yaxis()  # north up
    axes.set_title(title, fontsize=9, loc="left")
    axes.set_xlabel("x, m", fontsize=7)
    axes.set_ylabel(axis_label, fontsize=7)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("out")
    parser.add_argument("--along", default="curved")
    parser.add_argument("--around", default="steep")
    parser.add_argument("--depth", type=float, default=2076.0)
    arguments = parser.parse_args()
    mesh = Mesh(arguments.mesh)
    along, around = mesh.paths[arguments.along], mesh.paths[arguments.around]

    figure = plt.figure(figsize=(11.0, 7.6), dpi=130)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.9, 1.0), height_ratios=(0.8, 1.0), wspace=0.13, hspace=0.24, top=0.915)
    draw_section(figure.add_subplot(grid[0, 0]), mesh, along, arguments.along)
    draw_across(figure.add_subplot(grid[0, 1]), mesh, along, 0.5, 40.0)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    window = (low[0] + 60.0, high[0] - 60.0, low[1] + 60.0, high[1] - 220.0)
    draw_plan(figure.add_subplot(grid[1, 0]), mesh, arguments.depth, window, f"plan at a depth of {arguments.depth:g} m", 0.3, "y, m")
    x, y = crossing(around, arguments.depth)
    window = (x - 55.0, x + 55.0, y - 55.0, y + 55.0)
    draw_plan(figure.add_subplot(grid[1, 1]), mesh, arguments.depth, window, f"around the well '{arguments.around}'", 0.5, "")
    patches = [Patch(facecolor=COLOUR[k], edgecolor=EDGE_COLOUR, linewidth=0.5, label=name)
               for k, name in ((HOST, "host"), (REFINED, "refined"), (TRANSITION, "transition"), (RADIAL, "radial"))]
    figure.legend(handles=patches, loc="upper center", ncol=4, fontsize=9, frameon=False, bbox_to_anchor=(0.5, 1.0))
    figure.savefig(arguments.out, bbox_inches="tight", pad_inches=0.08)


if __name__ == "__main__":
    main()
