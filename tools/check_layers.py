#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks which folder includes which, and that each file opens with its licence.

    check_layers.py [PROJECT]

model <- readers, writers, algorithm, report <- conversion <- cli; interface beside cli; readers never include algorithm, writers never include
readers.
Prints one line a fault and exits 1 where there is one.
"""
import pathlib
import re
import sys

# The folders that a file of each folder may include, besides its own.
MAY_INCLUDE = {
    "model": set(),
    "readers": {"model"},
    "writers": {"model"},
    "algorithm": {"model"},
    "report": {"model"},
    "conversion": {"model", "readers", "writers", "algorithm"},
    "cli": {"model", "readers", "writers", "algorithm", "conversion", "report"},
    "interface": {"model", "readers", "writers", "algorithm"},
    "fuzz": {"model", "readers"},
    "benchmarks": {"model", "readers", "writers", "algorithm"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)
LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"


def faults_of(path, project):
    """One line for each fault of a source file."""
    folder = path.relative_to(project).parts[0]
    text = path.read_text(encoding="utf-8")
    shown = path.relative_to(project)
    if LICENCE not in text[:300]:
        yield f"{shown}: no '{LICENCE}' in its first lines"
    if folder not in MAY_INCLUDE:
        return
    for match in INCLUDE.finditer(text):
        target, slash, _ = match.group(1).partition("/")  # <algorithm> of the standard library has none
        if slash and target in MAY_INCLUDE and target != folder and target not in MAY_INCLUDE[folder]:
            line = text.count("\n", 0, match.start(1)) + 1
            yield f"{shown}:{line}: {folder} must not include {match.group(1)}"


def main():
    project = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    folders = [*MAY_INCLUDE, "tests"]
    files = sorted(p for f in folders for p in (project / f).rglob("*") if p.suffix in (".h", ".cpp"))
    if not files:
        print(f"{project}: no sources found; give the project's folder")
        return 1
    faults = [fault for path in files for fault in faults_of(path, project)]
    for fault in faults:
        print(fault)
    print(f"{len(files)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
