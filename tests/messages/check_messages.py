# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests that produce messages with record_messages.so preloaded, and asks tools/list_messages.py for those that none has produced.

    check_messages.py RECORDER BUILD     BUILD: folder of the build, with tests/ and cli/ in it
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
# In these tests nothing is refused; they take most of the time.
SLOW = "-*Random*:*Watertight*:*Paper*:*Spe9*:*Campaign*:*Cone*:*Thiem*"


def commands(build, folder):
    for part in ("algorithm", "readers", "model", "writers", "report"):
        yield [str(build / "tests" / part / f"{part}_test"), *([f"--gtest_filter={SLOW}"] if part == "algorithm" else [])]
    example = SOURCE / "testdata/example"
    yield [str(build / "tests/interface/c_interface_test"), str(example / "example.GRDECL"), str(example / "curved.csv"), f"{folder}/c.h5"]
    yield [sys.executable, str(SOURCE / "tests/interface/python_test.py")]
    cli = (SOURCE / "tests/cli/CMakeLists.txt").read_text()
    for suite in re.search(r"foreach\(suite ([^)]*)\)", cli).group(1).split():
        yield [sys.executable, str(SOURCE / "tests/cli/cli_test.py"), suite]
    for script in ("deck_test", "messages_test"):
        yield [sys.executable, str(SOURCE / f"tests/cli/{script}.py")]


def main():
    recorder, build = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as scratch:
        environment = dict(os.environ, LD_PRELOAD=recorder, WELLKNIT_MESSAGES=folder, WELLKNIT=str(build / "cli/wellknit"),
                           WELLKNIT_SOURCE_DIR=str(SOURCE), PYTHONPATH=str(build / "interface/python"))

        def run(command):
            return command, subprocess.run(command, env=environment, capture_output=True, text=True).returncode

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            failed = [c for c, code in pool.map(run, commands(build, scratch)) if code != 0]
        for command in failed:
            print("failed with the recorder:", *command)
        missing = subprocess.run([sys.executable, str(SOURCE / "tools/list_messages.py"), "--produced", folder]).returncode
    return 1 if failed or missing else 0


if __name__ == "__main__":
    sys.exit(main())
