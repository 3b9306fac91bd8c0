#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The layouts and orders of a deck are one model: OPM Flow computes the same pressures and rates from each.

    check_layouts.py WELLKNIT PROJECT
The shipped example with its wells as layout=row, portable and nested, and in the orders layer and rcm. INIT and EGRID must give back the
mesh file's pore volumes, depths and connections from every one of them; pressures and rates over time must agree with those of layout=row.
Hosts of generated faulted grids as layout=nested: nothing may connect by its geometry.
Ends with 77 where flow, python3-opm-common, python3-h5py or numpy is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
    from opm.io.ecl import EclFile

    from make_model import Deck as FaultedDeck
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

UNIT = 1e-3 / (86400 * 1e5)  # 1 cP rm3/(day bar) in m3
SINGLE = 3e-7  # relative: what single precision leaves of a value
TOLERANCE = 1e-6  # of pressures and rates between two layouts; the output's single precision takes 1e-7 of it
SMALLEST = 1e-6  # cP rm3/(day bar): smaller connections Flow sets to zero, unless their cells are neighbours in i, j or k
DECKS = {"ROW": "layout=row", "PORTABLE": "layout=portable", "NESTED": "layout=nested", "LAYER": "order=layer",
         "RCM": "layout=portable,order=rcm"}
FLOW = ["--threads-per-process=1", "--time-step-control=newtoniterationcount", "--tolerance-cnv=1e-9", "--tolerance-mb=1e-12",
        "--tolerance-wells=1e-9", "--linear-solver-reduction=1e-10", "--linear-solver-max-iter=1000", "--enable-tuning=false"]


def expect(what, found, expected, tolerance):
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    if found.shape != expected.shape:
        raise AssertionError(f"{what}: {found.shape} instead of {expected.shape}")
    scale = np.abs(expected).max() if expected.size else 0.0
    off = np.abs(found - expected).max() / (scale or 1.0) if expected.size else 0.0
    print(f"  {what}: {found.size} values, largest difference {off:.2g} of the largest")
    if not off <= tolerance:
        raise AssertionError(f"{what}: differs by {off}")


def integers(path, keyword):
    """The numbers of one keyword of a GRDECL file, repeat counts expanded."""
    body = re.search(rf"^{keyword}\n([^/]*)/", path.read_text(encoding="ascii"), re.MULTILINE).group(1)
    out = []
    for word in body.split():
        count, _, value = word.rpartition("*")
        out += [int(value)] * (int(count) if count else 1)
    return np.array(out)


class Deck:
    """A deck that Flow has run, its places taken back to the mesh's cells."""

    def __init__(self, folder, name, cells):
        self.deck, base = folder / f"{name}.DATA", folder / name
        self.init, self.egrid = EclFile(str(base) + ".INIT"), EclFile(str(base) + ".EGRID")
        self.nx, self.ny, self.nz = self.egrid["GRIDHEAD"][1:4]
        numbers = folder / f"{name}_CELLS.grdecl"
        if numbers.exists():
            self.cell = integers(numbers, "MESHCELL") - 1
        else:
            self.cell = np.full(self.nx * self.ny * self.nz, -1)
            self.cell[::2 if name == "PORTABLE" else 1] = np.arange(cells)
        expect("places", np.sort(self.cell[self.cell >= 0]), np.arange(cells), 0)
        self.active = np.nonzero(np.asarray(self.init["PORV"]) > 0)[0]
        self.base = base

    def by_cell(self, values):
        """Values of active places as values of the mesh's cells."""
        out = np.full(self.cell.max() + 1, np.nan)
        out[self.cell[self.active]] = values
        return out

    def below(self, places):
        """Flow writes a connection across inactive cells in the place of the one to the next layer."""
        is_active = np.zeros(len(self.cell), bool)
        is_active[self.active] = True
        places = places.copy()
        while not is_active[places].all():
            places[~is_active[places]] += self.nx * self.ny
        return places

    def connections(self):
        """{(a, b): T} of the mesh's cells, as Flow has them."""
        found = {}

        def add(first, second, values):
            for a, b, t in zip(self.cell[first], self.cell[second], values):
                # One connection across inactive cells stands both in TRANZ and in the list, with the whole value each time.
                if found.setdefault((min(a, b), max(a, b)), float(t)) != float(t):
                    raise AssertionError(f"cells {a} and {b}: {found[min(a, b), max(a, b)]} and {t}")
        for name, step in (("TRANX", 1), ("TRANY", self.nx), ("TRANZ", self.nx * self.ny)):
            values = np.asarray(self.init[name])
            at = np.nonzero(values)[0]
            add(self.active[at], self.below(self.active[at] + step) if name == "TRANZ" else self.active[at] + step, values[at])
        if "NNC1" in [entry[0] for entry in self.egrid.arrays]:
            add(np.asarray(self.egrid["NNC1"]) - 1, np.asarray(self.egrid["NNC2"]) - 1, self.init["TRANNNC"])
        return found

    def pressures(self):
        restart = EclFile(str(self.base) + ".UNRST")
        count = sum(entry[0] == "PRESSURE" for entry in restart.arrays)
        return np.array([self.by_cell(restart["PRESSURE", n]) for n in range(count)])

    def summary(self):
        """{(vector, well): values at the report steps}"""
        spec, steps = EclFile(str(self.base) + ".SMSPEC"), EclFile(str(self.base) + ".UNSMRY")
        last, table, kept = None, 0, []
        for name, *_ in steps.arrays:
            if name == "SEQHDR" and last is not None:
                kept.append(last)
            if name == "PARAMS":
                last, table = table, table + 1
        rows = np.array([np.asarray(steps["PARAMS", n]) for n in kept + [last]])
        keys = zip(spec["KEYWORDS"], spec["WGNAMES"])
        return {(k.strip(), w.strip()): rows[:, n] for n, (k, w) in enumerate(keys)
                if k.strip() in ("FPR", "WBHP", "WOPR", "WWPR", "WWIR", "TIME")}


def mesh_numbers(path):
    with h5py.File(path) as f:
        t = {}
        for (a, b), value in zip(f["connections/cells"][...], f["connections/transmissibility"][...] / UNIT):
            t[min(a, b), max(a, b)] = t.get((min(a, b), max(a, b)), 0.0) + value
        return f["cells/pore_volume"][...], f["cells/depth"][...], t, f["cells/kind"][...]


def check_static(deck, mesh):
    pore_volume, depth, t, _ = mesh
    expect("PORV", deck.by_cell(np.asarray(deck.init["PORV"])[deck.active]), pore_volume, SINGLE)
    expect("DEPTH", deck.by_cell(deck.init["DEPTH"]), depth, SINGLE)
    found = deck.connections()
    # A connection of a list that Flow sets to zero stands in INIT as that zero less the deck's value.
    for pair in [pair for pair, value in found.items() if value < 0 and -value < SMALLEST]:
        if abs(found[pair] / t.get(pair, np.inf) + 1) <= SINGLE:
            del found[pair]
    strange = [pair for pair in found if pair not in t]
    if strange:
        raise AssertionError(f"{len(strange)} connections that the mesh does not have, the first {strange[0]}")
    lost = [value for pair, value in t.items() if pair not in found]
    if lost and max(lost) >= SMALLEST:
        raise AssertionError(f"{len(lost)} connections are lost, the largest with {max(lost)}")
    keys = sorted(found)
    off = max(abs(found[k] / t[k] - 1) for k in keys)
    print(f"  T: {len(keys)} connections, largest relative difference {off:.2g}, {len(lost)} below Flow's smallest")
    if not off <= SINGLE:
        raise AssertionError(f"transmissibilities differ by {off}")


def check_side_files(deck, mesh):
    """What ResInsight reads: levels, and the source cell of every place."""
    kind = mesh[3]
    refine = integers(deck.base.parent / "NESTED_REFINE.grdecl", "REFINE")
    old = [integers(deck.base.parent / "NESTED_OLDIJK.grdecl", name) for name in ("OLDI", "OLDJ", "OLDK")]
    here = deck.cell >= 0
    expect("REFINE", refine[here], np.where(kind[deck.cell[here]] == 0, 1, 2), 0)
    source = [24, 24, 16]  # the example's
    i, j, k = np.unravel_index(np.arange(len(deck.cell)), (deck.nz, deck.ny, deck.nx))[::-1]
    host = i < source[0]
    for own, value in zip((i, j, k), old):
        expect("own place", value[host], own[host] + 1, 0)
    for value, most in zip(old, source):
        if not ((value[here] >= 1) & (value[here] <= most)).all() or value[~here & ~host].any():
            raise AssertionError("OLDI, OLDJ, OLDK: not a cell of the source grid, or one where none stands")


def check_corners(deck, folder, mesh_file):
    """Boxes of made cells stand where the cells are."""
    with h5py.File(mesh_file) as f:
        centre = f["cells/center"][...]
    coord = np.asarray(deck.egrid["COORD"]).reshape(deck.ny + 1, deck.nx + 1, 6)
    at = np.nonzero(deck.cell >= 0)[0]
    i, j = at % deck.nx, at // deck.nx % deck.ny
    made = i >= 24 if deck.base.name == "NESTED" else np.ones(len(at), bool)
    i, j, cell = i[made], j[made], deck.cell[at[made]]
    middle = (coord[j, i] + coord[j, i + 1] + coord[j + 1, i] + coord[j + 1, i + 1])[:, :2] / 4
    width = np.abs(coord[j, i + 1, 0] - coord[j, i, 0])
    off = np.abs(middle - centre[cell, :2]).max(1) / width
    print(f"  x, y: {len(at)} boxes, farthest from their cells by {off.max():.2g} widths")
    if not off.max() < 0.11:
        raise AssertionError(f"a box stands {off.max()} widths beside its cell")


def check_faulted(wellknit, folder, seed):
    """The host of a generated deck, nested: what INIT and EGRID have before anything flows."""
    case, mesh_file = folder / f"F{seed}_CASE.DATA", folder / f"F{seed}.h5"
    FaultedDeck(seed).write(case)
    subprocess.run([wellknit, "convert", case, mesh_file, "--quiet", "--overwrite"], check=True)
    subprocess.run([wellknit, "convert", mesh_file, folder / f"F{seed}.DATA", "--to", "deck,layout=nested", "--source", case, "--quiet",
                    "--overwrite"], check=True)
    run(folder / f"F{seed}.DATA", "--enable-dry-run=true")
    mesh = mesh_numbers(mesh_file)
    check_static(Deck(folder, f"F{seed}", len(mesh[0])), mesh)


def run(deck, *options):
    command = ["flow", str(deck), f"--output-dir={deck.parent}", *FLOW, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"flow ends with {done.returncode}: {(done.stdout + done.stderr)[-1500:]}")


def main():
    wellknit, example = sys.argv[1], pathlib.Path(sys.argv[2]) / "testdata" / "example"
    if shutil.which("flow") is None:
        print("skipped: flow is not installed")
        return 77
    failed = False
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else scratch)
        mesh_file, case = folder / "mesh.h5", example / "example.GRDECL"
        writes = [word for name, keys in DECKS.items() for word in ("--write", f"deck={folder / name}.DATA,{keys}")]
        subprocess.run([wellknit, "build", case, "--well", example / "curved.csv", "--well", example / "steep.dev", "-o", mesh_file,
                        *writes, "--overwrite", "--quiet"], check=True)
        mesh = mesh_numbers(mesh_file)
        first = None
        for name in DECKS:
            print(name)
            try:
                run(folder / f"{name}.DATA")
                deck = Deck(folder, name, len(mesh[0]))
                check_static(deck, mesh)
                if name == "NESTED":
                    check_side_files(deck, mesh)
                if name in ("NESTED", "PORTABLE", "RCM"):
                    check_corners(deck, folder, mesh_file)
                pressures, vectors = deck.pressures(), deck.summary()
                if first is None:
                    first = pressures, vectors
                expect("pressures", pressures, first[0], TOLERANCE)
                for key, values in vectors.items():
                    expect(" ".join(key), values, first[1][key], TOLERANCE)
            except AssertionError as error:
                failed = True
                print(f"FAIL {name}: {error}")
        for seed in range(1, 7):
            print("faulted", seed)
            try:
                check_faulted(wellknit, folder, seed)
            except AssertionError as error:
                failed = True
                print(f"FAIL faulted {seed}: {error}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
