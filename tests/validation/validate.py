# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of docs/validation.md: makes the models, runs `wellknit build` and `wellknit solve`, compares with
exact solutions.

    validate.py WELLKNIT --work DIR [--cases NAME,…] [--shared DIR] [--docs DIR]
    validate.py WELLKNIT --quick

Results are kept as DIR/<case>.json; --docs writes the tables of docs/validation.md and the pictures from all that
are there.
--quick is the test: a part of the cases, with limits; exits 1 where one is exceeded. Exits 77 without numpy and h5py.
"""
import argparse
import json
import pathlib
import sys
import tempfile
import time

try:
    import h5py  # noqa: F401
    import numpy  # noqa: F401
except ImportError:
    print("numpy or h5py is not installed: skipped")
    sys.exit(77)

import cases
import fields
import patch_test
import pore_volume
import quick
import report
from meshes import Program

RUNS = {
    "thiem": lambda program, shared: cases.thiem(program),
    "boundary": lambda program, shared: cases.boundary(program),
    "two_wells": lambda program, shared: cases.two_wells(program),
    "line_wells": lambda program, shared: cases.line_wells(program),
    "line_wells_metric": lambda program, shared: cases.line_wells_metric(program),
    "layered": lambda program, shared: cases.layered(program),
    "dipping": lambda program, shared: cases.dipping(program),
    "adapted": lambda program, shared: cases.adapted(program),
    "attribution": lambda program, shared: cases.attribution_of_thiem(program),
    "patch": lambda program, shared: patch_test.run(program),
    "field_SPE9": lambda program, shared: fields.compare(program, shared, "SPE9"),
    "field_MODEL5": lambda program, shared: fields.compare(program, shared, "MODEL5"),
    "hosts_SPE9": lambda program, shared: fields.compare_hosts(program, shared, "SPE9"),
    "pore_volume": lambda program, shared: {"MODEL5": pore_volume.model5(program, shared),
                                            "Reek": pore_volume.reek(program, shared)},
}


def run(program, work, names, shared):
    for name in names:
        begin = time.monotonic()
        result = RUNS[name](program, shared)
        (work / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n", encoding="ascii")
        print(f"{name}: {time.monotonic() - begin:.0f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wellknit")
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--cases", default="")
    parser.add_argument("--shared", default="../shared")
    parser.add_argument("--docs", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(a.wellknit, scratch)
        if a.quick:
            return quick.run(program)
        if a.work is None:
            parser.error("--work is missing")
        a.work.mkdir(parents=True, exist_ok=True)
        run(program, a.work, [n for n in a.cases.split(",") if n], a.shared)
    if a.docs:
        report.write(a.work, a.docs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
