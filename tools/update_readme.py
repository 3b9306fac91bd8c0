#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the parts of README.md that come from the program: the example's output and the table of formats.

    update_readme.py WELLKNIT      the path of the program
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

EXAMPLE = "build example.GRDECL --well curved.csv --well steep.dev -o example.h5 --write vtu=example.vtu --write deck=EXAMPLE.DATA"


def run(program, arguments, folder):
    return subprocess.run([program, *arguments.split()], cwd=folder, check=True, capture_output=True, text=True).stdout


def replaced(text, part, content):
    pattern = re.compile(rf"(<!-- {part}: [^\n]*-->\n).*?(<!-- end -->)", re.DOTALL)
    if not pattern.search(text):
        sys.exit(f"README.md has no part '{part}'")
    return pattern.sub(lambda match: match.group(1) + content + match.group(2), text)


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    project = pathlib.Path(__file__).resolve().parent.parent
    readme = project / "README.md"
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(project / "testdata" / "example", folder, dirs_exist_ok=True)
        output = run(program, EXAMPLE, folder)
        formats = run(program, "formats --markdown", folder)
    text = readme.read_text()
    text = replaced(text, "output", f"```\n$ wellknit {EXAMPLE}\n{output}```\n")
    text = replaced(text, "formats", "\n" + formats + "\n")
    readme.write_text(text)


if __name__ == "__main__":
    main()
