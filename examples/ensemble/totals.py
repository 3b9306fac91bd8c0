# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Field totals of many runs: a table of their ends, and a picture of the oil over time.

    totals.py TABLE.csv PICTURE.svg RUN.SMSPEC ...

Needs OPM's Python module (Debian: python3-opm-common). The last rows of the table are the mean and the 10th, 50th and 90th percentile.
"""
import pathlib
import sys

import numpy as np
from opm.io.ecl import ESmry

VECTORS = ("FOPT", "FWPT", "FGPT")


def picture(runs):
    width, height, left, top = 640, 360, 70, 20
    last = max(run["TIME"][-1] for run in runs) or 1.0
    most = max(run["FOPT"].max() for run in runs) or 1.0
    place = lambda t, v: f"{left + (width - left - 20) * t / last:.1f},{height - 40 - (height - 40 - top) * v / most:.1f}"
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>',
             f'<path d="M{left} {top}V{height - 40}H{width - 20}" fill="none" stroke="black"/>']
    for run in runs:
        points = " ".join(place(t, v) for t, v in zip(run["TIME"], run["FOPT"]))
        lines.append(f'<polyline points="{points}" fill="none" stroke="#2a6f97" stroke-opacity="0.5"/>')
    lines += [f'<text x="{width / 2}" y="{height - 8}" text-anchor="middle">days (to {last:g})</text>',
              f'<text x="{left - 6}" y="{top + 4}" text-anchor="end">{most:.3g}</text>',
              f'<text x="{left + 8}" y="{top + 4}">FOPT, {len(runs)} realisations</text>', "</svg>"]
    return "\n".join(lines) + "\n"


def main():
    table, svg, *specs = sys.argv[1:]
    runs = []
    for spec in specs:
        summary = ESmry(spec)
        runs.append({name: np.asarray(summary[name]) for name in ("TIME", *VECTORS)})
    ends = np.array([[run[name][-1] for name in VECTORS] for run in runs])
    rows = [[pathlib.Path(spec).parent.parent.name, *row] for spec, row in zip(specs, ends)]
    rows.append(["mean", *ends.mean(axis=0)])
    rows += [[f"p{p}", *np.percentile(ends, p, axis=0)] for p in (10, 50, 90)]
    with open(table, "w", encoding="ascii") as out:
        out.write("run," + ",".join(VECTORS) + "\n")
        out.writelines(f"{name}," + ",".join(f"{v:.6g}" for v in values) + "\n" for name, *values in rows)
    pathlib.Path(svg).write_text(picture(runs), encoding="ascii")


if __name__ == "__main__":
    main()
