#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""clang-tidy over the project's sources, within a time limit.

    check_tidy.py BUILD [--seconds N]
BUILD has been built by ninja with clang++. A source that passed once is not looked at again until it, a header of the project that it
includes, or .clang-tidy changes: what passed is kept in the cache folder (XDG_CACHE_HOME or ~/.cache)/wellknit-tidy. Sources changed
last come first. What the time did not suffice for is named. Exit 1 where clang-tidy has a finding.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time

FOLDERS = ("model", "readers", "algorithm", "writers", "conversion", "report", "interface", "cli")
PROJECT = pathlib.Path(__file__).resolve().parent.parent


def output_of(*command):
    return subprocess.run(command, cwd=PROJECT, check=True, capture_output=True, text=True).stdout


def dependencies(build):
    """{source: its files inside the project}, as the last build saw them."""
    found, files = {}, []
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line.startswith("    "):
            path = pathlib.Path(build, line.strip()).resolve()
            if path.is_relative_to(PROJECT) and not path.is_relative_to(build):
                files.append(path)
        elif files:
            found[files[0]], files = files, []
    if files:
        found[files[0]] = files
    return found


def key_of(source, files):
    digest = hashlib.sha256(output_of("clang-tidy", "--version").encode())
    for path in [PROJECT / ".clang-tidy", source, *files]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def newest_first(sources):
    """By the commit that changed them last, uncommitted ones first."""
    order = output_of("git", "log", "--name-only", "--pretty=format:", "--", *FOLDERS).split()
    rank = {}
    for place, name in enumerate(order):
        rank.setdefault(PROJECT / name, place)
    changed = {PROJECT / name for name in output_of("git", "diff", "--name-only", "HEAD").split()}
    return sorted(sources, key=lambda s: (-1 if s in changed else rank.get(s, -1), s))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=600.0)
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "wellknit-tidy"
    cache.mkdir(parents=True, exist_ok=True)

    compiled = {pathlib.Path(entry["file"]) for entry in json.loads((build / "compile_commands.json").read_text())}
    sources = newest_first(s for s in compiled if s.is_relative_to(PROJECT) and s.relative_to(PROJECT).parts[0] in FOLDERS)
    files_of = dependencies(build)
    keys = {source: key_of(source, files_of.get(source, [])) for source in sources}
    to_check = [source for source in sources if not (cache / keys[source]).exists()]
    deadline = time.monotonic() + arguments.seconds
    failed, left = [], []

    def check(source):
        if time.monotonic() > deadline:
            left.append(source)
            return
        result = subprocess.run(["clang-tidy", "-p", str(build), "--quiet", str(source)], cwd=PROJECT, capture_output=True, text=True)
        if result.returncode == 0:
            (cache / keys[source]).touch()
        else:
            failed.append(source)
            print(result.stdout, flush=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(check, to_check))
    print(f"{len(to_check) - len(left)} sources checked, {len(sources) - len(to_check)} unchanged since they passed, "
          f"{len(left)} left for lack of time, {len(failed)} with findings")
    for source in sorted(left):
        print(f"left: {source.relative_to(PROJECT)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
