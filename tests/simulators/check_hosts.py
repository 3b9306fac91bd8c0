# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the host of every public grid, without wells; a checker compares it with the grid's own corner points.

    check_hosts.py WELLKNIT SHARED

SHARED/tools/check_mesh.py is the checker, which shares no code with the project, SHARED/data the grids; exits 77 without
them. Prints a line a grid: the cells, or the one line that refused it. A grid that is not in a table of this file is built and checked as it stands.
"""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

FOOT = 0.3048  # m

# Where the checker needs a word: the text grids to compare with (default: the grid itself; none: only the mesh is
# checked), the length unit of those in m, their dimensions where they do not say, limits, and why.
SPECIAL = {
    "odd/sixcells2_hdr2.bgrdecl": {"grdecl": ["odd/sixcells2_hdr2.grdecl"], "why": "compared with its text twin"},
    "odd/sixcells2_described_zoverlap.grdecl": {
        "limits": {"total_volume_error": 0.005, "host_cell_volume_error": 0.05},
        "why": "cell (1,1,2) begins 20 m above the base of (1,1,1) and is cut off there; Flow's PORV is the same"},
    "reek/reek_sim.grdecl": {"include": ["reek/reek_sim_poro.grdecl", "reek/reek_sim_faults.grdecl"],
                             "grdecl": ["reek/reek_sim.grdecl", "reek/reek_sim_poro.grdecl"]},
    "reek/reek_sim.bgrdecl": {"grdecl": [], "why": "single precision at UTM coordinates: half a metre off the text"},
    "reek/REEK.EGRID": {"grdecl": [], "why": "another grid than the text's"},
    "spe9/SPE9_CP.DATA": {"grdecl": ["spe9/SPE9.GRDECL"], "unit": FOOT},
    "spe9/SPE9.DATA": {"grdecl": ["spe9/SPE9.GRDECL"], "unit": FOOT,
                       "why": "DX, DY, DZ, TOPS: compared with the corner points of the same model"},
    "model5/MODEL5.DATA": {},
    "nwm/NWM.data": {"grdecl": ["nwm/coord.inc", "nwm/zcorn.inc", "nwm/actnum.inc", "nwm/NWM.data"],
                     "dimensions": (40, 30, 8)},
}

# What must be refused: a deck around a public grid, and a part of the one line that says why.
REFUSED = {
    "DUALPORO over odd/dual_distorted1.grdecl": (
        "odd/dual_distorted1.grdecl", "RUNSPEC\nDIMENS\n5 3 1 /\nDUALPORO\nWATER\nMETRIC\nGRID\nINCLUDE\n'{grid}' /\n",
        "found a dual medium"),
    "odd/twocell.grdecl in a deck of other dimensions": (
        "odd/twocell.grdecl", "RUNSPEC\nDIMENS\n2 2 1 /\nWATER\nMETRIC\nGRID\nINCLUDE\n'{grid}' /\n", "expected"),
}


def load_checker(path):
    spec = importlib.util.spec_from_file_location("check_mesh", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def plain_grid(checker, data, case, special, folder):
    """The grid as one text file in metres that the checker reads; None where there is nothing to compare with."""
    names = special.get("grdecl", [case])
    if not names:
        return None
    arrays = {}
    for name in names:
        arrays.update(checker.read_grdecl(data / name))
    if "dimensions" in special:
        arrays["SPECGRID"] = special["dimensions"]
    if "SPECGRID" not in arrays:
        arrays["SPECGRID"] = arrays["DIMENS"]
    path = folder / "plain.grdecl"
    with open(path, "w", encoding="ascii") as out:
        out.write("SPECGRID\n " + " ".join(str(int(n)) for n in arrays["SPECGRID"][:3]) + " 1 F /\n")
        for keyword in ("COORD", "ZCORN", "ACTNUM", "PORO", "NTG"):
            if keyword in arrays:
                unit = special.get("unit", 1.0) if keyword in ("COORD", "ZCORN") else 1.0
                out.write(keyword + "\n" + "\n".join(repr(float(v * unit)) for v in arrays[keyword]) + "\n/\n")
    return path


def check(wellknit, tool, checker, data, case, folder):
    """What is wrong, as texts; and what to print."""
    special = SPECIAL.get(case, {})
    mesh = folder / "host.h5"
    command = [wellknit, "build", str(data / case), "-o", str(mesh), "--overwrite", "--quiet"]
    for name in special.get("include", []):
        command += ["--grid-include", str(data / name)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return ["refused: " + " | ".join(done.stderr.strip().splitlines())], ""
    command = [sys.executable, str(tool), str(mesh)]
    plain = plain_grid(checker, data, case, special, folder)
    if plain:
        command += ["--grdecl", str(plain)]
    for name, limit in special.get("limits", {}).items():
        command += ["--set", f"{name}={limit}"]
    checked = subprocess.run(command, capture_output=True, text=True, check=False)
    faults = [" ".join(line.split()) for line in checked.stdout.splitlines() if line.startswith("FAIL")]
    if checked.returncode != 0 and not faults:
        faults.append("the checker failed: " + checked.stderr.strip()[-300:])
    with h5py.File(mesh) as file:
        cells, faces = len(file["cells/volume"]), len(file["faces/cells"])
        inner = int((file["faces/cells"][:, 1] >= 0).sum())
    why = f" ({special['why']})" if "why" in special else ""
    return faults, f"{cells} cells, {faces} faces, {inner} of them between cells{why}"


def check_refusal(wellknit, data, name, folder):
    """The same for a deck that must be refused by one clear line with exit 1, without an output."""
    grid, deck, expected = REFUSED[name]
    path, mesh = folder / "DECK.DATA", folder / "host.h5"
    path.write_text(deck.format(grid=data / grid), encoding="ascii")
    done = subprocess.run([wellknit, "build", str(path), "-o", str(mesh)], capture_output=True, text=True, check=False)
    lines = done.stderr.strip().splitlines()
    if done.returncode != 1 or len(lines) != 1 or expected not in lines[0] or mesh.exists():
        return [f"exit {done.returncode} and '{done.stderr.strip()}'; expected exit 1, one line with '{expected}'"], ""
    return [], "refused: " + lines[0].replace(str(folder) + "/", "")


def main():
    wellknit, shared = sys.argv[1], pathlib.Path(sys.argv[2])
    tool, data = shared / "tools" / "check_mesh.py", shared / "data"
    if not tool.exists() or not data.is_dir():
        print(f"skipped: no {tool} or no {data}")
        return 77
    checker = load_checker(tool)
    cases = sorted(f"odd/{path.name}" for path in (data / "odd").glob("*.*grdecl"))
    cases += [case for case in SPECIAL if case not in cases and (data / case).exists()]
    if not cases:
        print(f"skipped: no grids in {data}")
        return 77
    jobs = [(case, lambda folder, case=case: check(wellknit, tool, checker, data, case, folder)) for case in cases]
    jobs += [(name, lambda folder, name=name: check_refusal(wellknit, data, name, folder)) for name in REFUSED]
    failed = 0
    for name, job in jobs:
        with tempfile.TemporaryDirectory() as folder:
            faults, figures = job(pathlib.Path(folder))
        failed += 1 if faults else 0
        print(f"{'FAIL' if faults else 'ok  '} {name}: " + "; ".join(faults + [figures]), flush=True)
    print(f"{len(jobs)} grids, {failed} with faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
