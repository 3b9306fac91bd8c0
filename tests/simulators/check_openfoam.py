# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenFOAM's checkMesh on the polyMesh of whole models: no topological error, and figures equal to the mesh file's.

    check_openfoam.py WELLKNIT PROJECT SHARED [FIRST COUNT]

The models are the example with wells, Reek with its faults file, SPE9 with its wells, the paper's case at three
deformations, and COUNT generated faulted ones from seed FIRST on. Exits 77 without checkMesh (Debian package openfoam),
numpy or h5py; models whose data is absent are left out. Hosts of faulted grids must also have every boundary face in
the patch that the grid's pillars say. What counts as an error and what does not is in docs/formats/openfoam.md.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

from check_hosts import load_checker
from compare_with_flow import deck_in_folder
from make_model import Deck

TOLERANCE = 1e-6  # relative; checkMesh prints 16 digits of sums that it takes in another order
NOTHING = 1e-12  # below this share of the largest, a face or cell is rounding, and so are the angles at it

SIDES = ("i_min", "i_max", "j_min", "j_max", "k_min", "k_max")


def run_openfoam(program, case, *options):
    environment = dict(os.environ)
    # Debian's package keeps its etc folder there and sets nothing.
    environment.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    command = [program, "-case", str(case), *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0 or "\nEnd" not in done.stdout:
        raise RuntimeError(f"{program} ends with {done.returncode}: {(done.stdout + done.stderr)[-600:]}")
    return done.stdout


def field_faults(mesh_file, case):
    """Permeability and porosity as OpenFOAM's foamToVTK reads them, against the mesh file's; it writes six digits."""
    if shutil.which("foamToVTK") is None:
        return []
    run_openfoam("foamToVTK", case, "-ascii", "-no-boundary", "-no-point-data")
    text = next((case / "VTK").glob("*/internal.vtu")).read_text(encoding="ascii")
    with h5py.File(mesh_file) as f:
        tensor = np.zeros((len(f["cells/volume"]), 9))
        tensor[:, [0, 4, 8]] = f["cells/permeability"][...]
        expected = {"K": tensor.ravel(), "porosity": f["cells/pore_volume"][...] / f["cells/volume"][...]}
    faults = []
    for name, ours in expected.items():
        theirs = np.array(re.search(f"Name='{name}'[^>]*>([^<]*)<", text).group(1).split(), float)
        if theirs.shape != ours.shape or not np.allclose(theirs, ours, rtol=2e-5, atol=0):
            faults.append(f"field {name}: not what the mesh file has")
    return faults


def complaints(output):
    """Failed checks of the topology, what else is counted there, and failed checks of the geometry."""
    topology = output[output.index("Checking topology..."):output.index("Checking geometry...")]
    geometry = output[output.index("Checking geometry..."):]
    stars = lambda text: [" ".join(line.replace("***", "").split()) for line in text.splitlines() if "***" in line]
    counted = [" ".join(line.replace("<<", "").split()) for line in topology.splitlines()
               if "<<" in line or "Number of identical" in line]
    return stars(topology), counted, stars(geometry)


def figure(output, pattern):
    found = re.search(pattern, output)
    if not found:
        raise RuntimeError(f"checkMesh printed nothing like '{pattern}'")
    return float(found.group(1))


def count(output, pattern):
    """A number that checkMesh prints only when it is not 0."""
    found = re.search(pattern + r":?\s*(\d+)", output)
    return int(found.group(1)) if found else 0


def their_figures(output):
    number = r"\s*[=:]?\s*([-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"
    names = {
        "points": "points:", "faces": r"\n    faces:", "inner faces": "internal faces:", "cells": "cells:",
        "smallest face": "Minimum face area", "largest face": "Maximum face area", "smallest volume": "Min volume",
        "largest volume": "Max volume", "total volume": "Total volume", "non-orthogonality": "non-orthogonality Max",
        "mean non-orthogonality": r"non-orthogonality Max: \S+ average", "skewness": "Max skewness"}
    figures = {name: figure(output, pattern + number) for name, pattern in names.items()}
    figures["doubled boundary faces"] = count(output, r"identical duplicate faces \(baffle faces\)")
    figures["touching face pairs"] = count(output, "faces with non-consecutive shared points")
    figures["faces seen from behind"] = count(output, "Error in face pyramids")
    figures["faces beyond 90 degrees"] = count(output, "Number of non-orthogonality errors")
    return figures


def one_run(loop, shared):
    """Whether a loop's vertices that are among `shared` follow one another."""
    inside = [v in shared for v in loop]
    return sum(here and not before for here, before in zip(inside, inside[-1:] + inside)) <= 1


class Mesh:
    """The mesh file with OpenFOAM's centres: cells are pyramids over their faces, around the mean of those."""

    def __init__(self, path):
        with h5py.File(path) as f:
            self.points = f["vertices"][...] * [1, 1, -1]
            self.start = f["faces/vertex_start"][...]
            self.corner = f["faces/vertices"][...]
            self.cells = f["faces/cells"][...]
            self.count = len(f["cells/volume"])
            self.source = f["cells/source_cell"][...]
            self.dimensions = f.attrs["source_dimensions"]
            names = [name.decode() for name in f["wells_order"][...]]
            self.wells = {name: float(f["wells/" + name].attrs["drainage_radius"]) for name in names}
        self.face = np.repeat(np.arange(len(self.start) - 1), np.diff(self.start))
        after = np.arange(len(self.corner)) + 1
        after[self.start[1:] - 1] = self.start[:-1]
        self.here, self.there = self.points[self.corner], self.points[self.corner[after]]
        self.inner = self.cells[:, 1] >= 0
        self.face_geometry()
        self.cell_geometry()

    def sum_by_face(self, values):
        return np.stack([np.bincount(self.face, v, len(self.cells)) for v in values.T], -1)

    def face_geometry(self):
        mean = self.sum_by_face(self.here) / np.diff(self.start)[:, None]
        middle = mean[self.face]
        # Mirrored: the loops turn the other way round.
        triangle = np.cross(self.there - self.here, middle - self.here) / -2
        weight = np.linalg.norm(triangle, axis=1)
        self.area = self.sum_by_face(triangle)
        total = np.bincount(self.face, weight, len(self.cells))
        centre = self.sum_by_face(weight[:, None] * (self.here + self.there + middle) / 3)
        self.centre = np.where(total[:, None] > 0, centre / np.maximum(total, 1e-300)[:, None], mean)

    def cell_geometry(self):
        owner, neighbour = self.cells[:, 0], self.cells[self.inner, 1]
        cell = np.concatenate([owner, neighbour])
        area = np.concatenate([self.area, -self.area[self.inner]])
        centre = np.concatenate([self.centre, self.centre[self.inner]])
        by_cell = lambda values: np.stack([np.bincount(cell, v, self.count) for v in values.T], -1)
        middle = by_cell(centre) / np.bincount(cell, minlength=self.count)[:, None]
        pyramid = np.einsum("ij,ij->i", area, centre - middle[cell]) / 3
        self.volume = np.bincount(cell, pyramid, self.count)
        self.middle = by_cell(pyramid[:, None] * (0.75 * centre + 0.25 * middle[cell])) / self.volume[:, None]

    def angles(self):
        line = self.middle[self.cells[self.inner, 1]] - self.middle[self.cells[self.inner, 0]]
        area = self.area[self.inner]
        lengths = np.linalg.norm(line, axis=1) * np.linalg.norm(area, axis=1)
        cosine = np.einsum("ij,ij->i", line, area) / (lengths + 1e-300)
        return np.degrees(np.arccos(np.clip(cosine, -1, 1))), cosine

    def skewness(self):
        """Of every face; a boundary face's line runs along its normal."""
        to_face = self.centre - self.middle[self.cells[:, 0]]
        size = np.linalg.norm(self.area, axis=1)
        normal = self.area / (size + 1e-150)[:, None]
        line = normal * np.einsum("ij,ij->i", normal, to_face)[:, None]
        line[self.inner] = self.middle[self.cells[self.inner, 1]] - self.middle[self.cells[self.inner, 0]]
        share = np.where(self.inner, 0.2, 0.4)
        along = np.einsum("ij,ij->i", self.area, to_face) / (np.einsum("ij,ij->i", self.area, line) + 1e-150)
        miss = to_face - along[:, None] * line
        distance = np.linalg.norm(miss, axis=1)
        unit = miss / (distance + 1e-150)[:, None]
        reach = share * np.linalg.norm(line, axis=1) + 1e-150
        extent = np.einsum("ij,ij->i", unit[self.face], self.here - self.centre[self.face])
        np.maximum.at(reach, self.face, np.abs(extent))
        return distance / reach

    def loop(self, face):
        return self.corner[self.start[face]:self.start[face + 1]]

    def doubled_boundary_faces(self):
        """Pairs of boundary faces with the same vertices."""
        seen = {}
        for face in np.nonzero(~self.inner)[0]:
            key = tuple(sorted(self.loop(face)))
            seen[key] = seen.get(key, 0) + 1
        return sum(n - 1 for n in seen.values())

    def touching_face_pairs(self):
        """Pairs of a cell's faces that share points which do not follow one another.

        The cell has no thickness at two places that are apart."""
        faces_of = [[] for _ in range(self.count)]
        for face, cells in enumerate(self.cells):
            for cell in cells[cells >= 0]:
                faces_of[cell].append(face)
        pairs = set()
        for faces in faces_of:
            loops = [(face, self.loop(face).tolist()) for face in faces]
            for n, (a, first) in enumerate(loops):
                for b, second in loops[n + 1:]:
                    shared = set(first).intersection(second)
                    if len(shared) > 1 and not (one_run(first, shared) and one_run(second, shared)):
                        pairs.add((a, b))
        return len(pairs)

    def seen_from_behind(self):
        """Faces whose pyramid with the centre of one of their cells has a negative volume."""
        wrong = np.zeros(len(self.cells), bool)
        for side, sign in ((0, 1), (1, -1)):
            has = self.cells[:, side] >= 0
            height = np.einsum("ij,ij->i", self.area[has], self.centre[has] - self.middle[self.cells[has, side]])
            wrong[has] |= sign * height / 3 < -1e-15  # checkMesh's own threshold, m3
        return int(wrong.sum())

    def figures(self):
        angle, cosine = self.angles()
        area = np.linalg.norm(self.area, axis=1)
        return {
            "points": len(self.points), "faces": len(self.cells), "inner faces": int(self.inner.sum()),
            "cells": self.count,
            "smallest face": area.min(), "largest face": area.max(), "smallest volume": self.volume.min(),
            "largest volume": self.volume.max(), "total volume": self.volume.sum(),
            "non-orthogonality": angle.max(initial=0),
            "mean non-orthogonality": float(np.degrees(np.arccos(np.clip(cosine.mean(), -1, 1)))) if len(cosine) else 0,
            "skewness": self.skewness().max(), "doubled boundary faces": self.doubled_boundary_faces(),
            "touching face pairs": self.touching_face_pairs(), "faces seen from behind": self.seen_from_behind(),
            "faces beyond 90 degrees": int((cosine <= 0).sum())}


def patches(case):
    """{name: (number of faces, the first of them)}"""
    text = (case / "constant" / "polyMesh" / "boundary").read_text(encoding="ascii")
    pattern = r"    (\S+)\n    {\n        type            patch;\n        nFaces +(\d+);\n        startFace +(\d+);"
    return {name: (int(number), int(start)) for name, number, start in re.findall(pattern, text)}


def written_faces(case):
    """(sorted points, owner) of every face of the polyMesh."""
    folder = case / "constant" / "polyMesh"
    faces = re.findall(r"\d+\(([\d ]+)\)", (folder / "faces").read_text(encoding="ascii"))
    owner = (folder / "owner").read_text(encoding="ascii").split("(")[1].split(")")[0].split()
    return [(tuple(sorted(map(int, face.split()))), int(cell)) for face, cell in zip(faces, owner)]


class Pillars:
    """Which side of its source cell a boundary face is on, by the pillars of the grid."""

    def __init__(self, checker, path):
        grid = checker.read_grdecl(path)
        self.n = [int(v) for v in grid["SPECGRID"][:3]]
        self.coord = grid["COORD"].reshape(self.n[1] + 1, self.n[0] + 1, 6)

    def at(self, i, j, depth):
        x0, y0, z0, x1, y1, z1 = self.coord[j, i]
        share = (depth - z0) / (z1 - z0) if z1 != z0 else np.zeros_like(depth)
        return np.stack([x0 + share * (x1 - x0), y0 + share * (y1 - y0)], -1)

    def off_side(self, points, first, second):
        """How far the face reaches from the surface between two pillars, over their distance."""
        a, b = (self.at(*pillar, points[:, 2]) for pillar in (first, second))
        line, to = b - a, points[:, :2] - a
        return float(np.max(np.abs(line[:, 0] * to[:, 1] - line[:, 1] * to[:, 0]) / np.einsum("ij,ij->i", line, line)))

    def side(self, cell, points, normal):
        i, j = cell % self.n[0], cell // self.n[0] % self.n[1]
        corners = {"i_min": ((i, j), (i, j + 1)), "i_max": ((i + 1, j), (i + 1, j + 1)),
                   "j_min": ((i, j), (i + 1, j)), "j_max": ((i, j + 1), (i + 1, j + 1))}
        off, name = min((self.off_side(points, *pair), name) for name, pair in corners.items())
        if off < 0.05:  # a top or base reaches from one pillar to the opposite one: about 1
            return name
        return "k_max" if normal[2] > 0 else "k_min"

    def patches(self, cell, points, normal, present):
        """Where the face may be: with nothing behind, the mesh file cannot always tell a gap from inactive rock."""
        side = self.side(cell, points, normal)
        place = [cell % self.n[0], cell // self.n[0] % self.n[1], cell // (self.n[0] * self.n[1])]
        axis = "ijk".index(side[0])
        place[axis] += 1 if side.endswith("max") else -1
        if not 0 <= place[axis] < self.n[axis]:
            return (side,)
        if place[0] + self.n[0] * (place[1] + self.n[1] * place[2]) in present:
            return ("gap",) if axis == 2 else ("fault",)
        return ("inactive", "gap") if axis == 2 else ("inactive",)


def misplaced_faces(mesh, case, pillars):
    """Boundary faces in another patch than the pillars say, as texts."""
    faces = written_faces(case)
    patch_of = {faces[place]: name for name, (number, start) in patches(case).items()
                for place in range(start, start + number)}
    present = set(mesh.source.tolist())
    faults = []
    for face in np.nonzero(~mesh.inner)[0]:
        cell = int(mesh.source[mesh.cells[face, 0]])
        points = mesh.points[mesh.loop(face)] * [1, 1, -1]
        expected = pillars.patches(cell, points, mesh.area[face] * [1, 1, -1], present)
        found = patch_of[(tuple(sorted(mesh.loop(face).tolist())), int(mesh.cells[face, 0]))]
        if found not in expected:
            faults.append(f"face {face} of source cell {cell}: in the patch {found}, on {' or '.join(expected)}")
    return faults[:3] + ([f"{len(faults)} faces in a wrong patch"] if faults else [])


def differences(ours, theirs):
    """Figures that are not the same, as texts."""
    faults = []
    for name, value in ours.items():
        scale = abs(value)
        if name == "smallest face":
            scale = max(scale, NOTHING * ours["largest face"] / TOLERANCE)
        if name == "smallest volume":
            scale = max(scale, NOTHING * ours["largest volume"] / TOLERANCE)
        if isinstance(value, int) and value != theirs[name] or abs(value - theirs[name]) > TOLERANCE * scale + 1e-12:
            faults.append(f"{name}: {value!r} in the mesh file, {theirs[name]!r} in checkMesh")
    return faults


def patch_faults(found, mesh):
    """Where all cells are in the mesh, a side has a face for each cell there; every meshed well has its bore."""
    faults = [f"no patch bore_{name}" for name, radius in mesh.wells.items()
              if radius > 0 and "bore_" + name not in found]
    n = [int(v) for v in mesh.dimensions]
    if len(mesh.source) == np.prod(n) and (mesh.source >= 0).all():
        cells = (n[1] * n[2], n[0] * n[2], n[0] * n[1])
        faults += [f"patch {side}: {found.get(side, (0,))[0]} faces for {cells[s // 2]} cells"
                   for s, side in enumerate(SIDES) if found.get(side, (0,))[0] != cells[s // 2]]
    if "other" in found:
        faults.append(f"{found['other'][0]} faces in the patch other")
    return faults


def check(wellknit, arguments, pillars, folder):
    """Faults as texts, and lines to print."""
    mesh_file, case = folder / "mesh.h5", folder / "case"
    command = [wellknit, "build", *map(str, arguments), "-o", str(mesh_file), "--write", f"openfoam={case}", "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    if done.returncode != 0:
        return ["wellknit failed: " + done.stderr.strip()], []
    output = run_openfoam("checkMesh", case, "-allTopology", "-allGeometry")
    wrong, counted, shape = complaints(output)
    mesh = Mesh(mesh_file)
    ours, theirs, found = mesh.figures(), their_figures(output), patches(case)
    faults = wrong + differences(ours, theirs) + patch_faults(found, mesh)
    if ours["cells"] < 20000:
        faults += field_faults(mesh_file, case)
    if pillars:
        faults += misplaced_faces(mesh, case, pillars)
    checked = subprocess.run([wellknit, "check", "--json", str(mesh_file)], capture_output=True, text=True, check=False)
    quality = json.loads(checked.stdout)["quality"]
    angle = max(v for k, v in quality.items() if re.fullmatch(r"nonorth_\w+_max_deg", k))
    skewness = max(quality["max_skewness"], quality["max_boundary_skewness"])
    same = {"non-orthogonality": "checkmesh_nonorth_max_deg", "mean non-orthogonality": "checkmesh_nonorth_mean_deg",
            "skewness": "checkmesh_skewness_max"}
    faults += differences({name: quality[figure] for name, figure in same.items()}, theirs)
    lines = [f"{ours['cells']} cells, {ours['faces']} faces, {ours['points']} points; "
             + " ".join(f"{k} {v}" for k, (v, _) in found.items())]
    for name, checked in (("non-orthogonality", angle), ("skewness", skewness)):
        lines.append(f"{name}: checkMesh {theirs[name]:.6g}, from the mesh file {ours[name]:.6g}; "
                     f"from pressure points, as wellknit check has it, {checked:.6g}")
    return faults, lines + [f"topology, no error: {line}" for line in counted] + [f"geometry: {line}" for line in shape]


def models(project, shared, first, count, folder):
    """Name, arguments of build, file with the host's COORD or None; those whose data is there."""
    example = project / "testdata" / "example"
    wells = ["--well", example / "curved.csv", "--well", example / "steep.dev"]
    yield "example", [example / "example.GRDECL", *wells], None
    reek, spe9 = shared / "data" / "reek", shared / "data" / "spe9" / "SPE9_CP.DATA"
    if reek.is_dir():
        grid = reek / "reek_sim.grdecl"
        yield "Reek", [grid, "--grid-include", reek / "reek_sim_poro.grdecl"], grid
        deck = folder / "REEK.DATA"
        deck.write_text(deck_in_folder("--reek", reek.resolve()), encoding="ascii")
        yield "Reek with faults and multipliers", [deck], grid
    else:
        print(f"no {reek}: left out")
    if spe9.exists():
        yield "SPE9", [spe9], None
        yield "SPE9 with its wells", [spe9, "--deck-wells", "all"], None
    else:
        print(f"no {spe9}: left out")
    maker = shared / "tools" / "make_case.py"
    for deform in ("0", "0.5", "1") if maker.exists() else ():
        stem = folder / f"paper{deform}"
        size = ["--nx", "30", "--ny", "30", "--nz", "20"]
        subprocess.run([sys.executable, str(maker), "--out", str(stem), *size, "--deform", deform, "--well", "curved"],
                       check=True, capture_output=True)
        well = f"{stem}.csv,radius=15,sectors=10,rings=5,segments=44"
        yield f"the paper's case at deformation {deform}", [f"{stem}.GRDECL", "--well", well], None
    for seed in range(first, first + count):
        deck = folder / f"SEED{seed}.DATA"
        Deck(seed).write(deck)
        yield f"seed {seed}", [deck], deck


def main():
    wellknit, project, shared = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    first, count = (int(v) for v in sys.argv[4:6]) if len(sys.argv) > 5 else (1, 10)
    if shutil.which("checkMesh") is None:
        print("skipped: no checkMesh (Debian package openfoam)")
        return 77
    tool = shared / "tools" / "check_mesh.py"
    checker = load_checker(tool) if tool.exists() else None  # its reader of GRDECL shares nothing with ours
    failed = total = 0
    with tempfile.TemporaryDirectory() as scratch:
        for name, arguments, grid in models(project, shared, first, count, pathlib.Path(scratch)):
            with tempfile.TemporaryDirectory() as folder:
                pillars = Pillars(checker, grid) if grid and checker else None
                faults, lines = check(wellknit, arguments, pillars, pathlib.Path(folder))
            total += 1
            failed += 1 if faults else 0
            print("\n  ".join([name] + lines + ["FAIL " + fault for fault in faults]), flush=True)
    print(f"{total} models, {failed} with faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
