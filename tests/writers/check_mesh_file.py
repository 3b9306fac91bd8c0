#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares our quality figures with those of the independent checker, and has h5py see the mesh file.

    check_mesh_file.py FOLDER SHARED
SHARED/tools/check_mesh.py is the checker; without it, or without python3-h5py, this ends with 77.
"""
import json
import pathlib
import subprocess
import sys


def main():
    folder = pathlib.Path(sys.argv[1])
    checker = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 and sys.argv[2] else "/nonexistent") / "tools/check_mesh.py"
    try:
        import h5py  # noqa: F401
    except ImportError as error:
        print("skipped:", error)
        sys.exit(77)
    if not checker.exists():
        print("skipped: no", checker)
        sys.exit(77)
    files = sorted(folder.glob("*.h5"))
    if not files:
        sys.exit("no mesh files: writers.examples has not run")
    problems = 0
    for path in files:
        result = subprocess.run([sys.executable, str(checker), str(path), "--json"], capture_output=True, text=True)
        theirs = json.loads(result.stdout)
        ours = json.loads(path.with_name(path.stem + "_quality.json").read_text())
        common = sorted(set(ours) & set(theirs))
        # The checker takes angles from their cosine, which near 1 leaves it sqrt(2 * 1e-16) rad, some 1e-6 degrees.
        wrong = [k for k in common if abs(ours[k] - theirs[k]) > (1e-5 if k.endswith("_deg") else 1e-9 * max(1.0, abs(theirs[k])))]
        print(f"{path.name}: checker ends with {result.returncode}, {len(common)} figures in common")
        for key in wrong:
            print(f"FAIL {path.name}: {key}: ours {ours[key]!r}, the checker's {theirs[key]!r}")
        missing = {k for k in theirs if k.startswith(("nonorth", "planarity", "cells_", "faces", "vertices"))} - set(ours) - {
            "cells_not_watertight", "faces_with_fewer_than_3_vertices", "cells_without_connection"}
        if missing:
            print(f"FAIL {path.name}: no figures of ours for {sorted(missing)}")
        problems += len(wrong) + len(missing) + (result.returncode != 0)
    sys.exit(problems > 0)


if __name__ == "__main__":
    main()
