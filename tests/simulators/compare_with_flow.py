# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells, pore volumes and connections of a deck's host mesh against what OPM Flow writes in its INIT and EGRID.

    compare_with_flow.py WELLKNIT CHECK_MESH|- [--random FIRST COUNT] [DECK|DECK,STEM…] [--reek FOLDER] [--nwm FOLDER]

--reek takes the grid, porosity and faults in a folder and adds permeability and multipliers; --nwm takes the files of MRST's example as they are. DECK,STEM compares with the files STEM.INIT and STEM.EGRID that some simulator wrote before. Exits 77 without flow. Prints one line a deck; exits 1 where a number differs by more than single precision allows.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from eclipse_output import arrays
from make_model import Deck

M3_PER_UNIT = {1: 1e-3 / (86400 * 1e5), 2: 1e-3 * 0.158987294928 / (86400 * 6894.757293168361),
               3: 1e-3 * 1e-6 / (3600 * 101325)}
M3_PER_RESERVOIR_UNIT = {1: 1.0, 2: 0.158987294928, 3: 1e-6}
TOLERANCE = 1e-5


def flow_result(deck, folder):
    """What flow makes of a deck."""
    command = ["flow", "--enable-dry-run=true", f"--output-dir={folder}", str(deck)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    stem = pathlib.Path(folder) / deck.stem.upper()
    if not stem.with_suffix(".INIT").exists():
        tail = [line for line in done.stdout.splitlines() if "rror" in line][-3:]
        raise RuntimeError("flow failed: " + " | ".join(tail or done.stderr.splitlines()[-3:]))
    return simulator_result(stem)


def simulator_result(stem):
    """Active cells, pore volume (m3), {(a, b): transmissibility in m3} and ZCORN from a simulator's own files."""
    init, grid = arrays(stem.with_suffix(".INIT")), arrays(stem.with_suffix(".EGRID"))
    nx, ny, nz = (int(n) for n in grid["GRIDHEAD"][1:4])
    flags = grid.get("ACTNUM")
    active = np.arange(nx * ny * nz) if flags is None else np.nonzero(flags)[0]
    is_active = np.zeros(nx * ny * nz, bool)
    is_active[active] = True
    units = int(init["INTEHEAD"][2])
    pairs = {}

    def add(a, b, value):
        if value > 0:
            key = (min(a, b), max(a, b))
            pairs[key] = pairs.get(key, 0.0) + float(value) * M3_PER_UNIT[units]

    for step, name in ((1, "TRANX"), (nx, "TRANY"), (nx * ny, "TRANZ")):
        for c, value in zip(active, init[name]):
            other = c + step
            # Flow writes a connection across a pinch-out in the place of the one to the next layer.
            while step == nx * ny and other < nx * ny * nz and not is_active[other]:
                other += step
            add(int(c), int(other), value)
    if "TRANNNC" in init:
        for a, b, value in zip(grid["NNC1"], grid["NNC2"], init["TRANNNC"]):
            if is_active[a - 1] and is_active[b - 1]:  # flow lists records of NNC with cells that MINPV left out
                add(int(a) - 1, int(b) - 1, value)
    return active, init["PORV"][active].astype(float) * M3_PER_RESERVOIR_UNIT[units], pairs, grid["ZCORN"]


def is_explained(pair, dimensions):
    """Flow 2022.10 does not look at the uppermost layer when it bridges more than one cell left out (MinpvProcessor)."""
    layer = dimensions[0] * dimensions[1]
    return pair[0] < layer and (pair[1] - pair[0]) % layer == 0 and pair[1] >= 3 * layer


def has_void(pair, dimensions, zcorn):
    """Whether some of the depths between two cells of a column belong to no cell. Flow 2022.10 connects nothing there, as later versions do."""
    nx, ny, _ = dimensions
    if (pair[1] - pair[0]) % (nx * ny):
        return False
    column = zcorn.reshape(-1, 2, ny, 2, nx, 2)[:, :, pair[0] // nx % ny, :, pair[0] % nx, :]
    upper, lower = pair[0] // (nx * ny), pair[1] // (nx * ny)
    solid = (column[upper + 1:lower, 1] - column[upper + 1:lower, 0]).sum(axis=0)
    return bool((np.abs(column[lower, 0] - column[upper, 1] - solid) > 1e-3).any())


def our_result(path):
    with h5py.File(path) as mesh:
        source = mesh["cells/source_cell"][()]
        order = np.argsort(source)
        pairs = {}
        for (a, b), value in zip(source[mesh["connections/cells"][()]], mesh["connections/transmissibility"][()]):
            if value > 0:
                key = (int(min(a, b)), int(max(a, b)))
                pairs[key] = pairs.get(key, 0.0) + float(value)
        return source[order], mesh["cells/pore_volume"][()][order], pairs, mesh.attrs["source_dimensions"]


def deck_around(dimensions, grid):
    """What flow needs around a GRID section; `grid` also has EDIT."""
    return f"""RUNSPEC
DIMENS
{dimensions} /
WATER
METRIC
FAULTDIM
10000 /
START
1 JAN 2020 /
EQLDIMS
/
TABDIMS
/
UNIFOUT
GRID
INIT
GRIDFILE
0 1 /
{grid}
PROPS
PVTW
100 1 1e-5 1 0 /
ROCK
100 1e-5 /
DENSITY
800 1000 1 /
SOLUTION
EQUIL
1600 160 0 0 0 0 /
SCHEDULE
TSTEP
1 /
END
"""


# By option: dimensions, and a grid whose files are in the folder that takes the place of {0}.
IN_FOLDERS = {"--reek": ("40 64 14", """PINCH
/
INCLUDE
'{0}/reek_sim.grdecl' /
INCLUDE
'{0}/reek_sim_poro.grdecl' /
INCLUDE
'{0}/reek_sim_faults.grdecl' /
EQUALS
PERMX 100 /
PERMY 70 /
PERMZ 10 /
MULTZ 0.2 1 40 1 64 5 5 /
MULTX 0.5 10 20 10 30 1 14 /
/
MULTFLT
F1 0.1 /
F2 0.3 /
F3 0 /
/
EDIT
MULTIPLY
TRANY 0.3 5 30 7 50 2 9 /
/"""), "--nwm": ("40 30 8", """INCLUDE
'{0}/coord.inc' /
INCLUDE
'{0}/zcorn.inc' /
INCLUDE
'{0}/actnum.inc' /
INCLUDE
'{0}/perm.inc' /
COPY
PERMX PERMY /
PERMX PERMZ /
/
NTG
9600*0.9 /
PORO
9600*0.2 /""")}


def deck_in_folder(option, folder):
    """The text of an IN_FOLDERS deck."""
    dimensions, grid = IN_FOLDERS[option]
    return deck_around(dimensions, grid.format(folder))


def compare(wellknit, checker, deck, folder, stem=None):
    """Faults found, as texts; and a line of figures."""
    out = pathlib.Path(folder) / "host.h5"
    done = subprocess.run([wellknit, "build", str(deck), "-o", str(out), "--overwrite", "--quiet"], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        return [f"wellknit failed: {done.stderr.strip()}"], ""
    active, porv, theirs, zcorn = simulator_result(stem) if stem else flow_result(deck, folder)
    source, pore_volume, ours, dimensions = our_result(out)
    keep = pore_volume > 0  # flow leaves out cells without pores
    with_pores = set(source[keep].tolist())
    ours = {pair: value for pair, value in ours.items() if pair[0] in with_pores and pair[1] in with_pores}
    faults = []
    if not np.array_equal(source[keep], active):
        extra, missing = np.setdiff1d(source[keep], active), np.setdiff1d(active, source[keep])
        return [f"cells: {len(extra)} only here {extra[:5]}, {len(missing)} only in flow {missing[:5]}"], ""
    worst_porv = float(np.max(np.abs(pore_volume[keep] / porv - 1))) if len(porv) else 0.0
    if worst_porv > TOLERANCE:
        faults.append(f"pore volumes differ by {worst_porv:.2e}")
    largest = max(theirs.values(), default=1.0)
    both = theirs.keys() & ours.keys()
    worst = max((abs(ours[p] / theirs[p] - 1) for p in both), default=0.0)
    alone_here = [p for p in ours.keys() - theirs.keys() if ours[p] > 1e-6 * largest]
    gaps = {p for p in alone_here if has_void(p, dimensions, zcorn)}
    explained = {p for p in alone_here if p not in gaps and is_explained(p, dimensions)}
    alone_here = [p for p in alone_here if p not in explained and p not in gaps]
    alone_there = [p for p in theirs.keys() - ours.keys() if theirs[p] > 1e-6 * largest]
    if worst > TOLERANCE:
        pair = max(both, key=lambda p: abs(ours[p] / theirs[p] - 1))
        faults.append(f"transmissibilities differ by {worst:.2e}, at {pair}: {ours[pair]:.6g} here, {theirs[pair]:.6g} there")
    if alone_here or alone_there:
        faults.append(f"connections: {len(alone_here)} only here {alone_here[:3]}, {len(alone_there)} only in flow {alone_there[:3]}")
    if checker != "-":
        checked = subprocess.run([sys.executable, checker, str(out)], capture_output=True, text=True, check=False)
        faults += [line for line in checked.stdout.splitlines() if "FAIL" in line]
    figures = f"{len(active)} cells, {len(theirs)} connections, T {worst:.1e}, PORV {worst_porv:.1e}"
    figures += f", {len(explained)} across the uppermost layers only here" if explained else ""
    return faults, figures + (f", {len(gaps)} across gaps only here" if gaps else "")


def main():
    arguments = sys.argv[1:]
    wellknit, checker = arguments[:2]
    decks = arguments[2:]
    if shutil.which("flow") is None:
        print("flow is not installed: skipped")
        return 77
    if checker != "-" and not os.path.exists(checker):
        checker = "-"
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        if decks[:1] == ["--random"]:
            first, count = int(decks[1]), int(decks[2])
            decks = decks[3:]
            for seed in range(first, first + count):
                path = pathlib.Path(scratch) / f"SEED{seed}.DATA"
                Deck(seed).write(path)
                decks.append(str(path))
        for option in IN_FOLDERS:
            if option not in decks:
                continue
            at = decks.index(option)
            folder = pathlib.Path(decks[at + 1]).resolve()
            path = pathlib.Path(scratch) / f"{option[2:].upper()}.DATA"
            if folder.is_dir():
                path.write_text(deck_in_folder(option, folder), encoding="ascii")
            decks[at:at + 2] = [str(path)]
        for deck, *stem in (d.split(",") for d in decks):
            if not os.path.exists(deck):
                print(f"{deck}: not there, skipped")
                continue
            with tempfile.TemporaryDirectory() as folder:
                faults, figures = compare(wellknit, checker, pathlib.Path(deck), folder, *map(pathlib.Path, stem))
            name = pathlib.Path(deck).stem
            failed += 1 if faults else 0
            print(f"{name}: " + ("; ".join(faults) if faults else figures), flush=True)
    print(f"{len(decks)} decks, {failed} differ")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
