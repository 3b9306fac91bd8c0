#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has OPM Flow run the decks of a folder to their end, and compares what it read with the mesh files beside them.

    check_flow_deck.py FOLDER
Pore volumes, depths and transmissibilities must come back in INIT and EGRID; the rates of the single-phase decks must be those of a dense
solve of the mesh file's own connection list. Ends with 77 where flow, python3-opm-common, python3-h5py or numpy is missing.
"""
import pathlib
import shutil
import subprocess
import sys

try:
    import h5py
    import numpy as np
    from opm.io.ecl import EclFile
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# 1 cP rm3/(day bar) in m3: 1e-3 Pa s / (86,400 s * 1e5 Pa).
UNIT = 1e-3 / (86400 * 1e5)
WATER_VISCOSITY = 0.5  # cP, of the single-phase template
WATER_DENSITY = 1000.0  # kg/m3
GRAVITY = 9.80665e-5  # bar per metre for 1 kg/m3
SINGLE = 3e-7  # relative: what single precision leaves of a value


class Mesh:
    def __init__(self, path):
        with h5py.File(path) as f:
            self.pore_volume = f["cells/pore_volume"][...]
            self.depth = f["cells/depth"][...]
            self.pairs = f["connections/cells"][...]
            self.t = f["connections/transmissibility"][...] / UNIT
            self.wells = {}
            for name in f["wells_order"][...]:
                group = f["wells/" + name.decode()]
                self.wells[name.decode()] = (group["connections/cell"][...], group["connections/well_index"][...] / UNIT)

    def summed(self):
        """{(a, b): T}, the smaller cell first."""
        out = {}
        for (a, b), t in zip(self.pairs, self.t):
            out[min(a, b), max(a, b)] = out.get((min(a, b), max(a, b)), 0.0) + t
        return out


def run(deck, out):
    shutil.rmtree(out, ignore_errors=True)
    # The default time-step control of flow 2022.10 aborts at an exact steady state.
    command = ["flow", str(deck), f"--output-dir={out}", "--time-step-control=newtoniterationcount", "--threads-per-process=1"]
    if "water" in deck.stem:
        command += ["--tolerance-cnv=1e-9", "--tolerance-mb=1e-12", "--tolerance-wells=1e-9"]
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(f"flow ends with {result.returncode}: {(result.stdout + result.stderr)[-800:]}")
    return out / deck.stem.upper()


def expect(name, ours, theirs, tolerance):
    ours, theirs = np.asarray(ours, float), np.asarray(theirs, float)
    if ours.shape != theirs.shape:
        raise AssertionError(f"{name}: {ours.shape} of ours, {theirs.shape} of flow's")
    worst = np.max(np.abs(ours - theirs) / np.maximum(np.abs(ours), 1e-30)) if ours.size else 0.0
    print(f"  {name}: {ours.size} values, largest relative difference {worst:.2g}")
    if not worst <= tolerance:
        raise AssertionError(f"{name}: differs by {worst}")


def check_static(mesh, base):
    init = EclFile(str(base) + ".INIT")
    expect("PORV", mesh.pore_volume, init["PORV"], SINGLE)
    expect("DEPTH", mesh.depth, init["DEPTH"], SINGLE)
    found = {}
    tranx = init["TRANX"]
    for i in np.nonzero(tranx)[0]:
        found[i, i + 1] = float(tranx[i])
    egrid = EclFile(str(base) + ".EGRID")
    if "NNC1" in [name for name, *_ in egrid.arrays]:
        for a, b, t in zip(egrid["NNC1"], egrid["NNC2"], init["TRANNNC"]):
            found[min(a, b) - 1, max(a, b) - 1] = float(t)
    ours = mesh.summed()
    if set(ours) != set(found):
        raise AssertionError(f"connections: {len(ours)} of ours, {len(found)} of flow's")
    keys = sorted(ours)
    expect("T", [ours[k] for k in keys], [found[k] for k in keys], SINGLE)


def steady_rates(mesh, pressures):
    """Rate of each well, m3/day, for potentials at its connections; one incompressible phase, cells without accumulation."""
    n = len(mesh.depth)
    matrix, right = np.zeros((n, n)), np.zeros(n)
    for (a, b), t in mesh.summed().items():
        matrix[[a, b], [a, b]] += t
        matrix[[a, b], [b, a]] -= t
    for name, (cells, factors) in mesh.wells.items():
        np.add.at(matrix, (cells, cells), factors)
        np.add.at(right, cells, factors * pressures[name])
    potential = np.linalg.solve(matrix, right)
    return {name: np.sum(f * (pressures[name] - potential[c])) / WATER_VISCOSITY for name, (c, f) in mesh.wells.items()}


def controls(deck):
    """Bottom-hole pressures as potentials: referred to depth 0 with the water's own weight."""
    depth, bhp, keyword = {}, {}, None
    for line in deck.read_text().splitlines():
        words = line.split()
        if words and words[0] in ("WELSPECS", "WCONINJE", "WCONPROD"):
            keyword = words[0]
        elif words == ["/"]:
            keyword = None
        elif keyword == "WELSPECS":
            depth[words[0].strip("'")] = float(words[4])
        elif keyword:
            bhp[words[0].strip("'")] = float(words[-2])
    return {name: bhp[name] - WATER_DENSITY * GRAVITY * depth[name] for name in bhp}


def last_summary(base):
    spec = EclFile(str(base) + ".SMSPEC")
    steps = EclFile(str(base) + ".UNSMRY")
    last = steps["PARAMS", max(i for i, (name, *_) in enumerate(n for n in steps.arrays if n[0] == "PARAMS"))]
    return {(k.strip(), w.strip()): float(v) for k, w, v in zip(spec["KEYWORDS"], spec["WGNAMES"], last)}


def check_rates(mesh, deck, base):
    expected = steady_rates(mesh, controls(deck))
    found = last_summary(base)
    rates = {name: found["WWIR", name] if rate > 0 else -found["WWPR", name] for name, rate in expected.items()}
    names = sorted(expected)
    # The template's compressibility is 1e-9 per bar and its pressures differ by less than 100 bar.
    expect("steady rates", [expected[n] for n in names], [rates[n] for n in names], 1e-6)


def main():
    folder = pathlib.Path(sys.argv[1])
    if shutil.which("flow") is None:
        print("skipped: flow is not installed")
        sys.exit(77)
    decks = sorted(folder.glob("*.data"))
    if not decks:
        sys.exit("no decks: writers.examples has not run")
    failed = False
    for deck in decks:
        print(deck.name)
        mesh = Mesh(folder / (deck.stem.replace("_water", "") + ".h5"))
        try:
            base = run(deck, folder / ("flow_" + deck.stem))
            check_static(mesh, base)
            if mesh.wells and "water" in deck.stem:
                check_rates(mesh, deck, base)
        except AssertionError as error:
            failed = True
            print(f"FAIL {deck.name}: {error}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
