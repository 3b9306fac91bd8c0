#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the numerical example of Mouton, Bennis and Borouchaki as closely as it is described and prints a table beside the paper's figures.

    paper_table.py WELLKNIT GENERATOR [--python PYTHON] [--runs N]

WELLKNIT is the program, GENERATOR the script make_case.py that writes the synthetic model; it is not a part of this project and needs
numpy. PYTHON is an interpreter that has numpy (default /usr/bin/python3). Each mapping is run N times (default 3); the counts must be the same
each time, the times are the least.

Case: 30 x 30 x 20 cells, deformation 1, curved well; drainage radius 15 m, 10 sectors, 5 rings, 44 segments; the host is not refined.
Exit: 0 done, 1 a run failed, 2 something is missing.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

CASE = ["--out", "paper", "--nx", "30", "--ny", "30", "--nz", "20", "--deform", "1", "--well", "curved"]
WELL = "paper.csv,radius=15,sectors=10,rings=5,segments=44"
MAPPINGS = ["auto", "paper"]

# What is compared: the row's name, the paper's figure, the key of the summary's cavity.
COUNTS = [
    ("inverted tetrahedra, before correction", 143, "inverted_tetrahedra"),
    ("loops", 6, "loops"),
    ("inserted points", 101, "points_inserted"),
    ("transition cells", 950, "transition_cells"),
    ("transition faces", 6432, "transition_faces"),
    ("transition vertices", 4887, "transition_vertices"),
]
# Steps of the summary that make the mesh; reading, quality figures and writing are not among them.
MESH_STEPS = {"host grid", "near-well mesh", "assembly"}


class Failure(Exception):
    """One line for the user, and the exit code."""

    def __init__(self, line, code):
        super().__init__(line)
        self.code = code


def run(command, folder, what):
    """Standard output of a command; a Failure when it does not exit with 0."""
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    except OSError as error:
        raise Failure(f"{what}: {command[0]} does not start: {error.strerror}", 2) from error
    if done.returncode != 0:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise Failure(f"{what} failed with exit code {done.returncode}: {last}", 1)
    return done.stdout


def build(program, mapping, folder):
    """The summary of one run."""
    command = [program, "build", "paper.GRDECL", "--well", WELL, "--mapping", mapping, "--refine", "off", "-o", f"{mapping}.h5", "--overwrite", "--json"]
    summary = json.loads(run(command, folder, f"wellknit with --mapping {mapping}"))
    well = summary["wells"][0]
    if not well["meshed"]:
        raise Failure(f"the well is not meshed with --mapping {mapping}: {well['reason']}", 1)
    return summary


def counts_of(summary):
    return [summary["cavities"][0][key] for _, _, key in COUNTS]


def times_of(summary):
    """Seconds of the whole run, of the near-well mesh alone, and of all mesh steps."""
    steps = {t["step"]: t["seconds"] for t in summary["times"]}
    return summary["seconds"], steps["near-well mesh"], sum(steps.get(s, 0.0) for s in MESH_STEPS)


def repeat(program, mapping, runs, folder):
    """The summary of the last of some runs and the least of each time."""
    summaries = [build(program, mapping, folder) for _ in range(runs)]
    if any(counts_of(s) != counts_of(summaries[0]) for s in summaries):
        raise Failure(f"the counts of --mapping {mapping} differ from run to run", 1)
    return summaries[-1], [min(column) for column in zip(*(times_of(s) for s in summaries))]


def table(results):
    """Markdown lines; results: (summary, times) by mapping."""
    lines = ["| | the paper | " + " | ".join(f"`--mapping {m}`" for m in MAPPINGS) + " |", "| --- | --- |" + " --- |" * len(MAPPINGS)]

    def add(name, paper, values):
        lines.append(f"| {name} | {paper} | " + " | ".join(values) + " |")

    for row, (name, paper, _) in enumerate(COUNTS):
        add(name, f"{paper:,}", [f"{counts_of(results[m][0])[row]:,}" for m in MAPPINGS])
    cavity = {m: results[m][0]["cavities"][0] for m in MAPPINGS}
    add("radial cells", "2,200", [f"{results[m][0]['wells'][0]['radial_cells']:,}" for m in MAPPINGS])
    add("host cells removed", "not given", [f"{cavity[m]['cells_removed']:,}" for m in MAPPINGS])
    add("boundary faces found again", "not given", [f"{cavity[m]['boundary_faces_found']:,} of {cavity[m]['boundary_faces']:,}" for m in MAPPINGS])
    add("transition cells not seen whole", "not given", [f"{cavity[m]['cells_not_seen_from_centre']:,}" for m in MAPPINGS])
    for index, name in enumerate(["whole run, s", "near-well mesh, s", "all mesh steps (host grid, near-well mesh, assembly), s"]):
        add(name, "not given", [f"{results[m][1][index]:.2f}" for m in MAPPINGS])
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="WELLKNIT")
    parser.add_argument("generator", metavar="GENERATOR")
    parser.add_argument("--python", default="/usr/bin/python3", help="an interpreter with numpy [%(default)s]")
    parser.add_argument("--runs", type=int, default=3, help="runs of each mapping [%(default)s]")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error("--runs must be 1 or more")
    generator = pathlib.Path(options.generator).resolve()
    program = pathlib.Path(options.program).resolve()
    try:
        if not generator.is_file():
            raise Failure(f"{options.generator} is absent: this table needs the script make_case.py, which is not a part of the project", 2)
        if not program.is_file():
            raise Failure(f"{options.program} is absent: build the program first", 2)
        with tempfile.TemporaryDirectory() as folder:
            run([options.python, str(generator), *CASE], folder, "the generator")
            results = {m: repeat(str(program), m, options.runs, folder) for m in MAPPINGS}
    except Failure as failure:
        print(f"paper_table.py: {failure}", file=sys.stderr)
        return failure.code
    print("\n".join(table(results)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
