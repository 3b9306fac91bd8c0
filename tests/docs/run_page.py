#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of a page, its blocks of `sh`, one after the other and exactly as printed, in a copy of the example.

    run_page.py PAGE.md

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR). The one thing that differs from a user's
machine: the installed example is the project's own. Exit 77 where a program that the page needs is not installed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(os.environ["WELLKNIT"]).resolve()
EXAMPLE = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"]) / "testdata" / "example"
INSTALLED = "/usr/share/wellknit/example"


def main():
    page = pathlib.Path(sys.argv[1])
    blocks = re.findall(r"^```sh\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    if not blocks:
        print(f"{page}: no commands")
        return 1
    if any(re.search(r"^flow ", block, re.MULTILINE) for block in blocks) and not shutil.which("flow"):
        print("skipped: flow is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder) / "work"
        shutil.copytree(EXAMPLE, work)
        programs = pathlib.Path(folder) / "bin"
        programs.mkdir()
        (programs / "wellknit").symlink_to(PROGRAM)
        script = "set -eo pipefail\n" + "\n".join(blocks).replace(INSTALLED, str(EXAMPLE))
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        result = subprocess.run(["bash", "-x", "-c", script], cwd=work, env=environment, stdin=subprocess.DEVNULL)
        left = sorted(str(path.relative_to(work)) for path in work.rglob("*") if path.is_file())
        for block in blocks:  # what a page says it makes is there
            for name in re.findall(r"(?:-o|--report|>) (\S+)", block):
                if not any(path.endswith(name) for path in left):
                    print(f"{page}: {name} was not made")
                    return 1
    return result.returncode


if __name__ == "__main__":
    sys.exit(main())
