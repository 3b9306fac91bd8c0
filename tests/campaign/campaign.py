# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random models with random wells through `wellknit build`, each mesh looked at by a checker that shares no code with it.

    campaign.py --summarise TABLE
    campaign.py WELLKNIT CHECK_MESH|- [--first SEED] [--cases N] [--largest N] [--most-wells N] [--jobs N] [--limit S] [--tolerate N] [--keep FOLDER] [--table FILE]

One line a case, made from its seed alone: what the model is, how long the run took, the share of the wells' length in the grid that has a radial
mesh, and what is wrong. At the end the shares over all wells and the reasons of the rest. CHECK_MESH `-` leaves the checker out; `wellknit check`
is run always. Exits 1 where a run crashes, and where more runs than are tolerated take longer than the limit or leave a mesh that a check calls invalid.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np


LONGEST = 1500.0  # m in plan, from a well's entry into the reservoir to its end


class Model:
    """A grid whose pillars lean, whose layers are folded, thrown, pinched out and partly inactive."""

    def __init__(self, seed, largest):
        rng = np.random.default_rng(seed)
        self.rng = rng
        log = lambda low, high: float(np.exp(rng.uniform(np.log(low), np.log(high))))
        self.n = [int(round(log(10, largest))) for _ in range(3)]
        self.flatness = log(1, 100)
        # Layers of a metre and more on average: the drainage radii of the wells are 2 m and more.
        self.dx = log(max(20.0, self.flatness), 200)
        self.dy = self.dx * log(0.5, 2)
        self.dz = self.dx / self.flatness
        self.deformation = float(rng.uniform(0, 2))
        self.faults = [(int(rng.integers(0, 2)), float(rng.uniform(0.15, 0.85)), float(rng.uniform(-3, 3)))
                       for _ in range(int(rng.integers(0, 5)))]
        self.pinched = [(int(rng.integers(0, self.n[2])), float(rng.uniform(0, 1)), float(rng.uniform(0, 2 * np.pi)))
                        for _ in range(int(rng.integers(0, 3)))]
        self.inactive = float(rng.uniform(0, 0.3)) if rng.random() < 0.5 else 0.0
        self.size = [self.n[0] * self.dx, self.n[1] * self.dy, self.n[2] * self.dz]
        self.phase = rng.uniform(0, 2 * np.pi, 6)

    def thickness(self, u, v):
        """Of every layer at places u, v in 0 … 1: array (nz, …)."""
        # Thick models would dip by 70 degrees and more at their base: the wave is such that the dip stays below 45.
        height = min(1.0, 0.5 * min(self.size[:2]) / self.size[2])
        wave = 0.3 * height * np.sin(2 * np.pi * u + self.phase[0]) * np.cos(np.pi * v + self.phase[1])
        out = np.repeat((self.dz * (1 + self.deformation * wave))[None], self.n[2], 0)
        for layer, where, angle in self.pinched:
            across = (u - 0.5) * np.cos(angle) + (v - 0.5) * np.sin(angle)
            out[layer] *= np.clip(4 * (across + where - 0.5), 0, 1)
        return np.maximum(out, 0)

    def depth(self, u, v):
        """Of the interfaces, without throws."""
        relief = min(self.size[2], 0.15 * min(self.size[:2]))
        fold = 0.4 * self.deformation * relief * np.sin(3 * np.pi * u + self.phase[2]) * np.cos(2 * np.pi * v + self.phase[3])
        layers = np.concatenate([np.zeros((1,) + np.shape(u)), np.cumsum(self.thickness(u, v), 0)])
        return 2000.0 + fold + layers

    def throw(self, u, v, beyond=None):
        """At places u, v; along i or j, growing to one side. `beyond`: u, v of the middles of the columns that the
        places belong to, which decide on which side of a fault they lie."""
        out = np.zeros(np.shape(u))
        for along, at, layers in self.faults:
            side = (u, v)[along] if beyond is None else beyond[along]
            beside = (v, u)[along]
            out += np.where(side > at, layers * self.dz * (0.3 + 0.7 * beside), 0)
        return out

    def shift(self, u, v, z):
        """Of a pillar in plan, linear in depth."""
        lean = 0.1 * self.deformation * (z - 2000.0) / max(self.size[2], 1.0) * min(self.size[2], 2 * self.dx)
        bend = 0.25 * self.deformation * min(self.dx, self.dy)
        return (lean * np.sin(2 * np.pi * v + self.phase[4]) + bend * np.sin(3 * np.pi * v),
                lean * np.cos(2 * np.pi * u + self.phase[5]) + bend * np.sin(4 * np.pi * u))

    def write(self, path):
        nx, ny, nz = self.n
        u, v = np.meshgrid(np.arange(nx + 1) / nx, np.arange(ny + 1) / ny)
        coord = []
        for z in (1500.0, 2500.0 + self.size[2]):
            sx, sy = self.shift(u, v, z)
            coord.append(np.stack([u * self.size[0] + sx, v * self.size[1] + sy, np.full_like(u, z)], -1))
        depth = self.depth(u, v)
        zcorn = np.empty((2 * nz, 2 * ny, 2 * nx))
        for k, j, i in np.ndindex(2, 2, 2):
            zcorn[k::2, j::2, i::2] = depth[k:nz + k, j:ny + j, i:nx + i]
        place = lambda n: (np.arange(2 * n) + 1) // 2 / n
        middle = lambda n: (np.arange(2 * n) // 2 + 0.5) / n
        zcorn += self.throw(*np.meshgrid(place(nx), place(ny)), np.meshgrid(middle(nx), middle(ny)))[None]
        active = np.ones((nz, ny, nx), int)
        if self.inactive > 0:
            noise = self.rng.random((nz, ny, nx))
            active[noise < self.inactive] = 0
        layer = self.rng.normal(0, 1, nz)[:, None, None]
        k = 100 * np.exp(0.7 * layer + 0.3 * self.rng.normal(0, 1, (nz, ny, nx)))
        poro = np.clip(0.2 + 0.03 * layer + 0.01 * self.rng.normal(0, 1, (nz, ny, nx)), 0.02, 0.35)
        with open(path, "w", encoding="ascii") as out:
            out.write(f"SPECGRID\n {nx} {ny} {nz} 1 F /\n")
            for name, values, form in (("COORD", np.concatenate(coord, -1), "%.3f"), ("ZCORN", zcorn, "%.3f"),
                                       ("ACTNUM", active, "%d"), ("PORO", poro, "%.4f"), ("PERMX", k, "%.5g"),
                                       ("PERMY", k, "%.5g"), ("PERMZ", 0.1 * k, "%.5g")):
                out.write(name + "\n")
                flat = values.ravel()
                for s in range(0, flat.size, 12):
                    out.write(" ".join(form % x for x in flat[s:s + 12]) + "\n")
                out.write("/\n")

    def point(self, u, v, w):
        """At the share w of the height of the grid."""
        z = float(np.interp(w * self.n[2], np.arange(self.n[2] + 1), self.depth(np.array(u), np.array(v)))) + float(self.throw(np.array(u), np.array(v)))
        sx, sy = self.shift(u, v, z)
        return np.array([u * self.size[0] + float(sx), v * self.size[1] + float(sy), z])

    def well(self):
        """(kind, points, radius)"""
        rng = self.rng
        kind = rng.choice(["vertical", "deviated", "s-shaped", "horizontal", "edge"])
        s = np.linspace(0, 1, 101)[:, None]
        middle = rng.uniform(0.25, 0.75, 2)
        if kind in ("vertical", "edge"):
            if kind == "edge":
                middle[0] = 2.5 / self.n[0]
            top, base = self.point(*middle, 0), self.point(*middle, 1)
            points = np.array([top[0], top[1], 0]) + (top[2] + s * (base[2] - top[2])) * np.array([[0, 0, 1]])
        else:
            step = rng.uniform(0.1, 0.35) * np.array([np.cos(a := rng.uniform(0, 2 * np.pi)), np.sin(a)])
            step *= min(1.0, LONGEST / np.hypot(*(step * self.size[:2])))
            other = np.clip(middle + step, 0.08, 0.92)
            ends = (0.5, 0.5) if kind == "horizontal" else (0.02, 0.98)
            begin, end = self.point(*middle, ends[0]), self.point(*other, ends[1])
            if kind == "s-shaped":
                bend = s + 0.12 * np.sin(2 * np.pi * s)
                points = begin + np.concatenate([bend, bend, s], 1) * (end - begin)
            else:
                points = begin + s * (end - begin)
        radius = float(np.exp(rng.uniform(np.log(2), np.log(max(2.5, 0.5 * min(self.dx, self.dy))))))
        return kind, points, radius

    def text(self):
        return (f"{self.n[0]}x{self.n[1]}x{self.n[2]} dx {self.dx:.0f} flatness {self.flatness:.1f} deformation {self.deformation:.2f} "
                f"faults {len(self.faults)} pinched {len(self.pinched)} inactive {100 * self.inactive:.0f} %")


def write_well(path, points):
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    with open(path, "w", encoding="ascii") as out:
        out.write("MD,X,Y,TVD\n")
        for md, p in zip(length, points):
            out.write(f"{md:.3f},{p[0]:.3f},{p[1]:.3f},{p[2]:.3f}\n")


def run_case(seed, arguments):
    """A dictionary for the table; key `wrong` is the worst thing that happened, or nothing."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"wellknit-campaign-{seed}-"))
    row = {"seed": seed, "wrong": "", "wells": []}
    try:
        model = Model(seed, arguments.largest)
        row["model"] = model.text()
        row["easy"] = model.flatness <= 20 and model.deformation <= 1
        grid = folder / "case.GRDECL"
        model.write(grid)
        command = [arguments.wellknit, "build", str(grid), "-o", str(folder / "mesh.h5"), "--json", "--threads", "1"]
        for number in range(min(int(model.rng.integers(1, 9)), arguments.most_wells)):
            kind, points, radius = model.well()
            write_well(folder / f"W{number}.csv", points)
            command += ["--well", f"{folder}/W{number}.csv,name=W{number},radius={radius:.3f}"]
            row["wells"].append({"kind": str(kind), "radius": radius, "length": 0.0, "meshed": 0.0, "reason": ""})
        begin = time.monotonic()
        # Of one core's time, so that other work on the machine does not count; a run that waits is stopped too.
        limits = lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(arguments.limit), int(arguments.limit)))
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=10 * arguments.limit, preexec_fn=limits)
        except subprocess.TimeoutExpired:
            row["wrong"] = f"took longer than {10 * arguments.limit:g} s"
            return row
        row["seconds"] = time.monotonic() - begin
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            row["wrong"] = f"took longer than {arguments.limit:g} s of one core"
        elif done.returncode < 0 or done.returncode > 1:
            row["crashed"] = True
            row["wrong"] = f"ended with {done.returncode}: {done.stderr.strip()[-200:]}"
        elif done.returncode == 1:
            row["refused"] = done.stderr.strip()
            if len(row["refused"].splitlines()) != 1:
                row["wrong"] = "refused with more than one line"
        else:
            look_at(row, json.loads(done.stdout), folder, grid, arguments)
        return row
    finally:
        if arguments.keep and row["wrong"]:
            shutil.copytree(folder, pathlib.Path(arguments.keep) / str(seed), dirs_exist_ok=True)
        shutil.rmtree(folder)


def look_at(row, summary, folder, grid, arguments):
    for well, told in zip(row["wells"], summary["wells"]):
        well["length"] = told.get("length_in_rock", 0.0)
        well["meshed"] = told.get("length_meshed", 0.0)
        well["reason"] = told.get("reason", "")
    checks = [[arguments.wellknit, "check", str(folder / "mesh.h5")]]
    if arguments.check_mesh != "-":
        checks.append([sys.executable, arguments.check_mesh, str(folder / "mesh.h5"), "--grdecl", str(grid)])
    # The checker's large arrays come and go: with memory that is kept it takes two thirds of the time.
    kept = dict(os.environ, MALLOC_MMAP_THRESHOLD_=str(2**32), MALLOC_TRIM_THRESHOLD_=str(2**34))
    for check in checks:
        done = subprocess.run(check, capture_output=True, text=True, check=False, env=kept)
        if done.returncode != 0:
            found = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip().startswith("FAIL") or "Error" in line or "invalid" in line]
            row["wrong"] = f"{pathlib.Path(check[0] if check[0] != sys.executable else check[1]).name}: " + "; ".join(found[:3])


def line_of(row):
    length = sum(w["length"] for w in row["wells"])
    meshed = sum(w["meshed"] for w in row["wells"])
    share = f"{100 * meshed / length:.0f} % of {len(row['wells'])} wells" if length > 0 else f"{len(row['wells'])} wells"
    return f"seed {row['seed']}: {row.get('model', '')}: {row.get('seconds', 0):.1f} s, {share}" + (f": refused: {row['refused']}" if "refused" in row else "") + (f": WRONG: {row['wrong']}" if row["wrong"] else "")


def summary_of(rows):
    lines = []
    for name, chosen in (("all", rows), ("flatness up to 20 and deformation up to 1", [r for r in rows if r.get("easy")])):
        wells = [w for r in chosen for w in r["wells"] if w["length"] > 0]
        whole = sum(w["meshed"] >= 0.9 * w["length"] for w in wells)
        length = sum(w["length"] for w in wells)
        if wells:
            lines.append(f"{name}: {whole} of {len(wells)} wells ({100 * whole / len(wells):.1f} %) meshed over at least 90 % of their length; "
                         f"{100 * sum(w['meshed'] for w in wells) / length:.1f} % of all length")
    reasons = collections.Counter(re.sub(r"[-+]?\d[\d.]*", "#", w["reason"]) for r in rows for w in r["wells"] if w["reason"])
    lines += [f"{count:5d}  {reason}" for reason, count in reasons.most_common(12)]
    seconds = sorted(r["seconds"] for r in rows if "seconds" in r)
    if seconds:
        lines.append(f"time: median {seconds[len(seconds) // 2]:.1f} s, longest {seconds[-1]:.1f} s")
    lines.append(f"{len(rows)} cases, {sum('refused' in r for r in rows)} refused, {sum(bool(r['wrong']) for r in rows)} wrong")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wellknit", nargs="?", default="wellknit")
    parser.add_argument("check_mesh", nargs="?", default="-")
    parser.add_argument("--first", type=int, default=None, help="first seed [a fresh one]")
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--largest", type=int, default=60, help="cells along an axis")
    parser.add_argument("--most-wells", type=int, default=8, help="in one model")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of one core for one run")
    parser.add_argument("--tolerate", type=int, default=0, help="runs that may be too slow or invalid, not crash [0]")
    parser.add_argument("--keep", help="folder for the inputs and meshes of cases that went wrong")
    parser.add_argument("--table", help="all figures as JSON, one case a line, added to the file as they come")
    parser.add_argument("--summarise", metavar="TABLE", help="no runs: the summary of a table")
    arguments = parser.parse_args()
    if arguments.summarise:
        print(summary_of([json.loads(line) for line in pathlib.Path(arguments.summarise).read_text(encoding="utf-8").splitlines()]))
        return 0
    first = arguments.first if arguments.first is not None else int(np.random.SeedSequence().entropy % 10**9)
    print(f"seeds {first} to {first + arguments.cases - 1}, up to {arguments.largest} cells along an axis", flush=True)
    rows = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(lambda seed: run_case(seed, arguments), range(first, first + arguments.cases)):
            rows.append(row)
            print(line_of(row), flush=True)
            if arguments.table:
                with open(arguments.table, "a", encoding="utf-8") as table:
                    table.write(json.dumps(row) + "\n")
    print(summary_of(rows))
    return 1 if any(r.get("crashed") for r in rows) or sum(bool(r["wrong"]) for r in rows) > arguments.tolerate else 0


if __name__ == "__main__":
    sys.exit(main())
