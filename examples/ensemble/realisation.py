# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A realisation of a deck: its permeability times lognormal factors, one for each layer and patch of columns.

    realisation.py CASE.DATA OUT.DATA --seed N [--spread 0.5] [--patch 5] [--drop KEYWORD,...]

The factors stand as MULTIPLY at the end of GRID; the field's totals are added to SUMMARY; the same seed gives the same deck. --drop leaves keywords of SCHEDULE out; only those whose data end with a line of a
single / or, like LIFTOPT, with their first record. Includes are looked for beside OUT.DATA unless their paths are absolute: they are made so.
"""
import argparse
import pathlib
import re

import numpy as np

SINGLE_RECORD = {"LIFTOPT"}


def dimensions(text):
    found = re.search(r"^DIMENS\b[^\n]*\n(?:\s*--[^\n]*\n)*\s*(\d+)\s+(\d+)\s+(\d+)", text, re.MULTILINE)
    if not found:
        raise SystemExit("no DIMENS in the deck itself")
    return tuple(int(n) for n in found.groups())


def factors(shape, seed, spread, patch):
    """Lines of MULTIPLY: factors of mean 1 by patch and layer."""
    rng = np.random.default_rng(seed)
    nx, ny, nz = shape
    lines = []
    for k in range(1, nz + 1):
        for j in range(1, ny + 1, patch):
            for i in range(1, nx + 1, patch):
                factor = np.exp(rng.normal(-0.5 * spread**2, spread))
                box = f"{i} {min(i + patch - 1, nx)} {j} {min(j + patch - 1, ny)} {k} {k}"
                lines += [f"  {name} {factor:.6f} {box} /" for name in ("PERMX", "PERMY", "PERMZ")]
    return lines


def without(lines, keywords):
    out, inside = [], None
    for line in lines:
        word = line.split()[0] if line.split() else ""
        data = line.split("--")[0].strip()
        if inside:
            if data == "/" or (inside in SINGLE_RECORD and data.endswith("/")):
                inside = None
            continue
        if word in keywords:
            inside = word
            continue
        out.append(line)
    return out


def with_absolute_includes(text, folder):
    def absolute(found):
        before, path = found.groups()
        return f"{before}'{path if path.startswith('/') else folder / path}'"
    return re.sub(r"(^INCLUDE\b[^\n]*\n(?:\s*(?:--[^\n]*)?\n)*\s*)['\"]?([^\s'\"/][^\s'\"]*|/[^\s'\"]+)['\"]?", absolute, text, flags=re.MULTILINE | re.IGNORECASE)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--spread", type=float, default=0.5)
    parser.add_argument("--patch", type=int, default=5)
    parser.add_argument("--drop", default="")
    a = parser.parse_args()
    text = a.case.read_text(encoding="latin-1")
    lines = with_absolute_includes(text, a.case.resolve().parent).splitlines()
    lines = without(lines, {k for k in a.drop.split(",") if k})
    end = next((n for n, line in enumerate(lines) if line.split()[:1] in (["EDIT"], ["PROPS"])), None)
    if end is None:
        raise SystemExit("no PROPS in the deck itself")
    lines[end:end] = [f"-- realisation of seed {a.seed}", "MULTIPLY", *factors(dimensions(text), a.seed, a.spread, a.patch), "/", ""]
    # Totals for totals.py.
    schedule = next((n for n, line in enumerate(lines) if line.split()[:1] == ["SCHEDULE"]), None)
    if schedule is None:
        raise SystemExit("no SCHEDULE in the deck itself")
    present = {line.strip() for line in lines}
    lines[schedule:schedule] = [name for name in ("FOPT", "FWPT", "FGPT") if name not in present]
    a.out.parent.mkdir(parents=True, exist_ok=True)
    a.out.write_text("\n".join(lines) + "\n", encoding="latin-1")


if __name__ == "__main__":
    main()
