#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes before and after the optimisation beside the host's own figures in the same place: the tables of docs/algorithms/optimisation.md.

    optimisation_table.py WELLKNIT SHARED [--case PART] [--optimise SETTING ...] [--runs N] [--keep FOLDER]

WELLKNIT is the program. SHARED is a folder that is not a part of this project: `tools/make_case.py` writes synthetic models, `tools/check_mesh.py` checks a mesh
file with no code of the project, `data/` has public decks. Angles, planarity, cells that are not seen and faces beyond 90 degrees are
check_mesh.py's, times the least of N runs by the summary of the program. What neither has is worked out here from the mesh file:

- edges of transition cells over the size (cube root of the volume) of the smallest and of the largest of these cells that has them: the shortest by the first, and how many are below 0.02 by
  either; of edges with an end that belongs to transition cells alone, since those on the cavity's boundary are the host's and the tubes';
- the host's faces between cells that the cavities take, whole or in part, from a run without wells.

Exit: 0 done, 1 a run failed, 2 something is missing. Needs numpy and h5py.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

TRANSITION = 2
SHORT = 0.02  # of a cell's size
WELL = "sectors=10,rings=5"
REEK_WELLS = ["OP_1", "OP_2", "OP_3", "OP_4", "OP_5", "WI_1", "WI_2"]


def made_case(deform, *options):
    return {"make": ["--nx", "30", "--ny", "30", "--nz", "20", "--deform", deform, "--well", "curved", *options],
            "arguments": ["made.GRDECL", "--well", f"made.csv,radius=15,{WELL},segments=44", "--refine", "off"]}


CASES = {
    **{f"paper, deformation {d}": made_case(d) for d in ("0.5", "1", "1.5")},
    **{f"slab, deformation {d}": made_case(d, "--slab") for d in ("0.5", "1", "1.5")},
    "SPE9, 26 wells, 30 m": {"arguments": ["{data}/spe9/SPE9_CP.DATA", "--deck-wells", "all", "--radius", "30"]},
    "MODEL5, 9 wells, 15 m": {"arguments": ["{data}/model5/MODEL5.DATA", "--deck-wells", "all", "--radius", "15"]},
    "Reek, 7 wells, 50 m": {"arguments": ["{data}/reek/reek_sim.grdecl", "--radius", "50"]
                            + [part for w in REEK_WELLS for part in ("--well", f"{{data}}/reek/wells/{w}.w")]},
    "nwm, horizontal, 2 m": {"arguments": ["{data}/nwm/NWM.data", "--well", "{data}/nwm/trajectory.csv", "--radius", "2"]},
}


class Failure(Exception):
    """One line for the user, and the exit code."""

    def __init__(self, line, code):
        super().__init__(line)
        self.code = code


def run(command, folder, may_fail=False):
    try:
        done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True, check=False)
    except OSError as error:
        raise Failure(f"{command[0]} does not start: {error.strerror}", 2) from error
    if done.returncode != 0 and not (may_fail and done.stdout):
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise Failure(f"{' '.join(map(str, command))} failed with exit code {done.returncode}: {last}", 1)
    return done.stdout


class Mesh:
    """What is needed of a mesh file; faces as fans around the mean of their vertices."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.points = file["vertices"][()]
            self.start, self.loop = file["faces/vertex_start"][()], file["faces/vertices"][()]
            self.cells, self.kind = file["faces/cells"][()], file["cells/kind"][()]
            self.center, self.volume = file["cells/center"][()], file["cells/volume"][()]
            self.source = file["cells/source_cell"][()]
            self.transfer = [file["transfer/" + key][()] for key in ("start", "cell")]
        count = np.diff(self.start)
        self.face_of = np.repeat(np.arange(len(count)), count)
        following = np.arange(1, len(self.loop) + 1)
        following[self.start[1:] - 1] = self.start[:-1]
        self.after = self.loop[following]
        self.middle = self._sum(self.points[self.loop]) / count[:, None]
        a, b = (self.points[v] - self.middle[self.face_of] for v in (self.loop, self.after))
        self.area = 0.5 * self._sum(np.cross(a, b))

    def _sum(self, values):
        out = np.zeros((len(self.start) - 1, 3))
        np.add.at(out, self.face_of, values)
        return out

    def edges(self):
        """Of transition cells, with an end that belongs to them alone: length over the sizes of the smallest and the largest of them at each."""
        is_made = np.zeros((len(self.cells), 2), bool)
        for side in (0, 1):
            is_made[:, side] = (self.cells[:, side] >= 0) & (self.kind[self.cells[:, side]] == TRANSITION)
        is_free = np.ones(len(self.points), bool)
        is_free[self.loop[~is_made.all(1)[self.face_of]]] = False
        pairs, sizes = [], []
        for side in (0, 1):
            chosen = is_made[self.face_of, side] & (is_free[self.loop] | is_free[self.after])
            pairs.append(np.sort(np.stack([self.loop, self.after], 1)[chosen], 1))
            sizes.append(np.cbrt(self.volume[self.cells[self.face_of[chosen], side]]))
        unique, at = np.unique(np.concatenate(pairs), axis=0, return_inverse=True)
        smallest, largest = np.full(len(unique), np.inf), np.zeros(len(unique))
        np.minimum.at(smallest, at.ravel(), np.concatenate(sizes))
        np.maximum.at(largest, at.ravel(), np.concatenate(sizes))
        length = np.linalg.norm(self.points[unique[:, 0]] - self.points[unique[:, 1]], axis=1)
        return length / smallest, length / largest

    def faces_within(self, sources):
        """Angle (degrees) and planarity of faces between two host cells of a set of source cells."""
        is_in = np.isin(self.source, sources)
        inner = (self.cells[:, 1] >= 0) & is_in[self.cells].all(1)
        size = np.linalg.norm(self.area, axis=1)
        inner &= size > 1e-9 * np.median(size)
        normal = self.area / np.maximum(size, 1e-300)[:, None]
        line = self.center[self.cells[inner, 1]] - self.center[self.cells[inner, 0]]
        cosine = (normal[inner] * line).sum(1) / np.linalg.norm(line, axis=1)
        height = np.abs(((self.points[self.loop] - self.middle[self.face_of]) * normal[self.face_of]).sum(1))
        most = np.zeros(len(size))
        np.maximum.at(most, self.face_of, height)
        return np.degrees(np.arccos(np.clip(cosine, -1, 1))), (most / np.sqrt(np.maximum(size, 1e-300)))[inner]

    def taken(self):
        """Source cells that transition or radial cells have a part of."""
        start, cell = self.transfer
        return np.unique(np.repeat(np.arange(len(start) - 1), np.diff(start))[self.kind[cell] >= TRANSITION])


# What the summary calls the mesh: all of it but the properties and the connections.
MESH_STEPS = ("host grid", "near-well mesh", "refinement", "assembly")


def seconds(summary, step):
    return sum(t["seconds"] for t in summary["times"] if t["step"] == step)


class Runner:
    def __init__(self, options, folder):
        self.program, self.runs = pathlib.Path(options.program).resolve(), options.runs
        shared = pathlib.Path(options.shared).resolve()
        self.data, self.generator, self.checker = shared / "data", shared / "tools/make_case.py", shared / "tools/check_mesh.py"
        for path in (self.program, self.generator, self.checker, self.data):
            if not path.exists():
                raise Failure(f"{path} is absent", 2)
        self.folder = folder

    def case(self, case, settings):
        """{setting: figures}, with the host's own under "host"."""
        if "make" in case:
            run([sys.executable, self.generator, "--out", "made", *case["make"]], self.folder)
        arguments = [part.format(data=self.data) for part in case["arguments"]]
        out = {setting: self.build(arguments, setting) for setting in settings}
        self.host(arguments[0], Mesh(self.folder / f"{settings[0]}.h5").taken(), out)
        return out

    def build(self, arguments, setting):
        path = self.folder / f"{setting}.h5"
        command = [self.program, "build", *arguments, "--optimise", setting, "-o", path, "--overwrite", "--json"]
        summaries = [json.loads(run(command, self.folder)) for _ in range(self.runs)]
        checked = json.loads(run([sys.executable, self.checker, path, "--json"], self.folder, may_fail=True))
        small, large = Mesh(path).edges()
        return {"meshed": [w["meshed"] for w in summaries[0]["wells"]], "check": checked, "shortest": small.min(),
                "short": int((small < SHORT).sum()), "short_of_largest": int((large < SHORT).sum()), "restored": (summaries[0].get("optimisation") or {}).get("cells_restored"),
                "near_well": min(seconds(s, "near-well mesh") for s in summaries), "mesh": min(sum(seconds(s, step) for step in MESH_STEPS) for s in summaries),
                "optimisation": min(seconds(s, "optimisation") for s in summaries)}

    def host(self, grid, sources, out):
        path = self.folder / "host.h5"
        run([self.program, "build", grid, "-o", path, "--overwrite", "--json"], self.folder)
        angle, planarity = Mesh(path).faces_within(sources)
        out["host"] = {"mean": angle.mean(), "p99": np.percentile(angle, 99), "planarity": planarity.mean()}


def angles(check, name):
    key = f"nonorth_{name}"
    return f"{check[key + '_mean_deg']:.1f} / {check[key + '_p99_deg']:.1f}" if key + "_mean_deg" in check else "-"


def rows(name, figures):
    host = figures["host"]
    yield f"| {name} | host | | {host['mean']:.1f} / {host['p99']:.1f} | | | {host['planarity']:.4f} | | | | | |"
    for setting, f in figures.items():
        if setting == "host":
            continue
        check = f["check"]
        unsound = check["made_cells_not_seen_from_centre"] + check["made_faces_beyond_90_deg"]
        yield (f"| | `{setting}` | {check['cells_transition']:,.0f} | {angles(check, 'transition')} | {angles(check, 'transition_host')} | "
               f"{angles(check, 'transition_radial')} | {check['planarity_transition_mean']:.4f} | {f['shortest']:.2g} | {f['short']}, {f['short_of_largest']} | {unsound:.0f} | "
               f"{f['near_well']:.2f}, {f['mesh']:.2f} | {f['optimisation']:.2f} |")


HEAD = ["| case | | transition cells | inner faces | joints with the host | joints with radial cells | planarity | shortest edge | below 0.02 | unsound | near-well mesh, all mesh steps, s | optimisation, s |",
        "|" + " --- |" * 12]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="WELLKNIT")
    parser.add_argument("shared", metavar="SHARED")
    parser.add_argument("--case", default="", metavar="PART", help="only cases that have PART in their name")
    parser.add_argument("--optimise", nargs="+", default=["off", "edges", "on"], metavar="SETTING", help="settings of --optimise [off edges on]")
    parser.add_argument("--runs", type=int, default=3, metavar="N", help="runs, for their times [%(default)s]")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="all figures as JSON, a file for each case")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error("--runs must be 1 or more")
    print("\n".join(HEAD))
    try:
        for name, case in CASES.items():
            if options.case not in name:
                continue
            with tempfile.TemporaryDirectory() as folder:
                figures = Runner(options, pathlib.Path(folder)).case(case, options.optimise)
            print("\n".join(rows(name, figures)), flush=True)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / (name.replace(", ", "_").replace(" ", "_") + ".json")).write_text(json.dumps(figures, indent=1))
    except Failure as failure:
        print(f"optimisation_table.py: {failure}", file=sys.stderr)
        return failure.code
    return 0


if __name__ == "__main__":
    sys.exit(main())
