#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of a large deck with one meshed well: seconds, and memory for each cell of the source grid against its limit of 1.5 kB (from 4 million cells on).

    deck_benchmark.py WELLKNIT [--cells MILLIONS] [--threads N] [--keep FOLDER]

The deck is a dipping box of 50 m x 50 m x 5 m cells, 50 layers, with porosity and permeability of their own in every cell, a producer in a mesh, an injector, oil and water, two years by months.
It takes 20 bytes of disk for each cell, the converted one some 320.
"""
import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

LAYERS, WIDTH, THICKNESS, TOP, DIP = 50, 50.0, 5.0, 2000.0, 0.02
MOST_BYTES_PER_CELL = 1500.0

HEAD = """RUNSPEC
TITLE
 A LARGE BOX
DIMENS
 {n} {n} {layers} /
OIL
WATER
METRIC
START
 1 JAN 2020 /
WELLDIMS
 2 50 1 2 /
TABDIMS
/
EQLDIMS
/
UNIFOUT

GRID
INIT
COORD
"""
TAIL = """COPY
 PERMX PERMY /
 PERMX PERMZ /
/
MULTIPLY
 PERMZ 0.1 /
/

PROPS
PVTW
 200 1.0 4E-5 0.5 0 /
PVDO
 10 1.15 1
 200 1.1 1
 500 1.05 1.1 /
ROCK
 200 5E-5 /
DENSITY
 850 1000 1 /
SWOF
 0.2 0 0.9 0
 0.5 0.1 0.3 0
 0.8 0.4 0 0 /

SOLUTION
EQUIL
 2000 200 {contact} 0 /

SUMMARY
FOPR
FWPR
WBHP
/

SCHEDULE
WELSPECS
 P G {p} {p} 1* OIL /
 I G 3 3 1* WATER /
/
COMPDAT
 P 2* 1 {layers} OPEN 2* 0.2 /
 I 2* 1 {layers} OPEN 2* 0.2 /
/
WCONPROD
 P OPEN LRAT 3* 2000 1* 100 /
/
WCONINJE
 I WATER OPEN RATE 2000 1* 400 /
/
TSTEP
 24*30.4375 /
END
"""


def write_deck(path, n):
    """n x n columns; depth rises along j, so that a row of corners is one number with a count."""
    rng = np.random.default_rng(1)
    with path.open("w", encoding="ascii") as out:
        out.write(HEAD.format(n=n, layers=LAYERS))
        for j in range(n + 1):
            for i in range(n + 1):
                out.write(f"{i * WIDTH:g} {j * WIDTH:g} 0 {i * WIDTH:g} {j * WIDTH:g} 5000\n")
        out.write("/\nZCORN\n")
        for k in range(2 * LAYERS):
            for row in range(2 * n):
                out.write(f"{2 * n}*{TOP + THICKNESS * ((k + 1) // 2) + DIP * WIDTH * ((row + 1) // 2):g}\n")
        out.write("/\n")
        for name, low, high, form in (("PORO", 0.1, 0.3, "%.4f"), ("PERMX", 10.0, 1000.0, "%.2f")):
            out.write(name + "\n")
            for _ in range(LAYERS):
                for row in rng.uniform(low, high, (n, n)):
                    out.write(" ".join(form % v for v in row) + "\n")
            out.write("/\n")
        out.write(TAIL.format(p=n // 2, layers=LAYERS, contact=TOP + 0.7 * (LAYERS * THICKNESS + DIP * WIDTH * n)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--cells", type=float, default=1.0, help="millions")
    parser.add_argument("--threads", type=int)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder where the decks stay")
    given = parser.parse_args()
    n = round((given.cells * 1e6 / LAYERS) ** 0.5)
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        write_deck(folder / "LARGE.DATA", n)
        command = [given.program.resolve(), "build", "LARGE.DATA", "--deck-wells", "P", "--strict", "--overwrite", "--write", "deck=OUT.DATA"]
        begin = time.monotonic()
        subprocess.run(command + (["--threads", str(given.threads)] if given.threads else []), cwd=folder, check=True)
        seconds = time.monotonic() - begin
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        written = sum(f.stat().st_size for f in [folder / "OUT.DATA", *(folder / "OUT_parts").rglob("*")] if f.is_file())
    cells = n * n * LAYERS
    memory = usage.ru_maxrss * 1024 / cells
    print(f"{cells} cells: {seconds:.1f} s ({usage.ru_utime + usage.ru_stime:.1f} s of processor), {usage.ru_maxrss / 1e6:.2f} GB, {memory:.0f} bytes a cell; {written / 1e6:.0f} MB written")
    # The limit is that of large models: at a million cells it is 1,541 bytes, at 8 million 1,366.
    if cells >= 4_000_000 and memory > MOST_BYTES_PER_CELL:
        print(f"more than {MOST_BYTES_PER_CELL:.0f} bytes a cell")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
