# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random models with random wells through `wellknit build`, each mesh looked at by a checker that shares no code with it.

    campaign.py WELLKNIT CHECK_MESH|- [--first SEED] [--cases N] [--largest N] [--jobs N] [--limit S] [--keep FOLDER] [--table FILE]

One line a case, made from its seed alone: what the model is, how long the run took, the share of the wells' length in the grid that has a radial
mesh, and what is wrong. At the end the shares over all wells and the reasons of the rest. CHECK_MESH `-` leaves the checker out; `wellknit check`
is run always. Exits 1 where a run crashes, takes longer than the limit, or leaves a mesh that a check calls invalid.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np


class Model:
    """A grid whose pillars lean, whose layers are folded, thrown, pinched out and partly inactive."""

    def __init__(self, seed, largest):
        rng = np.random.default_rng(seed)
        self.rng = rng
        log = lambda low, high: float(np.exp(rng.uniform(np.log(low), np.log(high))))
        self.n = [int(round(log(10, largest))) for _ in range(3)]
        self.flatness = log(1, 100)
        self.dx = log(20, 200)
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
        wave = 0.3 * np.sin(2 * np.pi * u + self.phase[0]) * np.cos(np.pi * v + self.phase[1])
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

    def throw(self, u, v):
        """At the middles of columns; along i or j, growing to one side."""
        out = np.zeros(np.shape(u))
        for along, at, layers in self.faults:
            across, beside = (u, v) if along == 0 else (v, u)
            out += np.where(across > at, layers * self.dz * (0.3 + 0.7 * beside), 0)
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
        mu, mv = np.meshgrid((np.arange(nx) + 0.5) / nx, (np.arange(ny) + 0.5) / ny)
        zcorn += np.repeat(np.repeat(self.throw(mu, mv), 2, 0), 2, 1)[None]
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
            other = np.clip(middle + rng.uniform(0.1, 0.35) * np.array([np.cos(a := rng.uniform(0, 2 * np.pi)), np.sin(a)]), 0.08, 0.92)
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
        for number in range(int(model.rng.integers(1, 9))):
            kind, points, radius = model.well()
            write_well(folder / f"W{number}.csv", points)
            command += ["--well", f"{folder}/W{number}.csv,name=W{number},radius={radius:.3f}"]
            row["wells"].append({"kind": str(kind), "radius": radius, "length": 0.0, "meshed": 0.0, "reason": ""})
        begin = time.monotonic()
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=arguments.limit)
        except subprocess.TimeoutExpired:
            row["wrong"] = f"took longer than {arguments.limit:g} s"
            return row
        row["seconds"] = time.monotonic() - begin
        if done.returncode < 0 or done.returncode > 1:
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
    for check in checks:
        done = subprocess.run(check, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            found = [line.strip() for line in (done.stdout + done.stderr).splitlines() if "FAIL" in line or "rror" in line or "invalid" in line]
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
    parser.add_argument("wellknit")
    parser.add_argument("check_mesh")
    parser.add_argument("--first", type=int, default=None, help="first seed [a fresh one]")
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--largest", type=int, default=60, help="cells along an axis")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one run")
    parser.add_argument("--keep", help="folder for the inputs and meshes of cases that went wrong")
    parser.add_argument("--table", help="all figures as JSON, one case a line")
    arguments = parser.parse_args()
    first = arguments.first if arguments.first is not None else int(np.random.SeedSequence().entropy % 10**9)
    print(f"seeds {first} to {first + arguments.cases - 1}, up to {arguments.largest} cells along an axis", flush=True)
    rows = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(lambda seed: run_case(seed, arguments), range(first, first + arguments.cases)):
            rows.append(row)
            print(line_of(row), flush=True)
    if arguments.table:
        pathlib.Path(arguments.table).write_text("".join(json.dumps(r) + "\n" for r in rows), encoding="utf-8")
    print(summary_of(rows))
    return 1 if any(r["wrong"] for r in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
