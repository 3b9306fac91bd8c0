#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds whole models in the formats of other programs and has the checks of this folder judge them: the shipped example, SPE9 with its
wells, and the paper's case, as far as their data is there.

    check_whole_models.py WELLKNIT PROJECT SHARED [READ_OPM_GRID]
"""
import pathlib
import subprocess
import sys
import tempfile

FORMATS = {"opm_grid": ".opmgrid", "mrst": ".mat", "pflotran": ".pflotran", "pflotran_h5": ".pflotran_h5", "tough": ".tough",
           "darts": ".npz", "darts_h5": ".darts_h5", "adgprs": ".adgprs", "csv": ".tables", "fehm": ".fehm", "dgf": ".dgf",
           "vtp": ".vtp", "vtkhdf": ".vtkhdf"}
SKIPPED = 77


def models(project, shared, folder):
    """Name and arguments of build."""
    example = project / "testdata" / "example"
    yield "example", [example / "example.GRDECL", "--well", example / "curved.csv", "--well", example / "steep.dev"]
    spe9, maker = shared / "data" / "spe9" / "SPE9_CP.DATA", shared / "tools" / "make_case.py"
    if spe9.exists():
        yield "spe9", [spe9, "--deck-wells", "all"]
    else:
        print(f"no {spe9}: left out")
    if maker.exists():
        subprocess.run([sys.executable, str(maker), "--out", str(folder / "case"), "--nx", "30", "--ny", "30", "--nz", "20",
                        "--deform", "0.5", "--well", "curved"], check=True, capture_output=True)
        yield "paper", [folder / "case.GRDECL", "--well", f"{folder / 'case'}.csv,radius=15,sectors=10,rings=5,segments=44"]
    else:
        print(f"no {maker}: left out")


def checks(project, reader, folder):
    loaders = str(project / "writers" / "loaders")
    return [["check_opm_grid.py", folder, reader, "--geometry"], ["check_mrst.py", folder, loaders, "--twisted"],
            ["check_pflotran.py", folder], ["check_tough.py", folder], ["check_darts.py", folder, loaders],
            ["check_text_tables.py", folder], ["check_vtu.py", folder, "--twisted"]]


def main():
    wellknit, project, shared = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    reader, here, failed = sys.argv[4] if len(sys.argv) > 4 else "", pathlib.Path(__file__).resolve().parent, False
    with tempfile.TemporaryDirectory() as scratch:
        for name, arguments in models(project, shared, pathlib.Path(scratch)):
            with tempfile.TemporaryDirectory() as folder:
                base = pathlib.Path(folder) / name
                writes = [word for key, end in FORMATS.items() for word in ("--write", f"{key}={base}{end}")]
                writes += ["--write", f"vtu={base}_geos.vtu,for=geos"]
                subprocess.run([wellknit, "build", *map(str, arguments), "-o", f"{base}.h5", *writes, "--quiet"], check=True)
                for script, *words in checks(project, reader, folder):
                    done = subprocess.run([sys.executable, here / script, *words], check=False)
                    failed = failed or done.returncode not in (0, SKIPPED)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
