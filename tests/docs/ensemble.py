# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ensemble of examples/ensemble on a small deck, from realisations to totals, where snakemake, flow and OPM's Python module are there.

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR).
"""
import csv
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "tests/cli"))
EXAMPLE = SOURCE / "examples/ensemble"


def deck(folder):
    import whole_deck
    for name, text in whole_deck.files().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="latin-1")
    return folder / "CASE.DATA"


def check_realisations(case, folder):
    """The same seed, the same deck; another one, another deck; a keyword that is dropped is gone."""
    def make(name, *arguments):
        subprocess.run([sys.executable, EXAMPLE / "realisation.py", case, folder / name, *arguments], check=True)
        return (folder / name).read_text(encoding="latin-1")
    one, again, other = make("a", "--seed", "1"), make("b", "--seed", "1"), make("c", "--seed", "2")
    assert one == again and one != other
    assert one.count("MULTIPLY") > case.read_text(encoding="latin-1").count("MULTIPLY")
    assert "WELOPEN" in one and "WELOPEN" not in make("d", "--seed", "1", "--drop", "WELOPEN")


def main():
    if importlib.util.find_spec("numpy") is None:
        print("numpy is not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        case = deck(folder / "case")
        check_realisations(case, folder)
        missing = [name for name in ("snakemake", "flow") if shutil.which(name) is None]
        if importlib.util.find_spec("opm") is None:
            missing.append("python3-opm-common")
        if missing:
            print(f"realisations are right; {', '.join(missing)} not installed: the workflow is skipped")
            return 77
        path = f"{pathlib.Path(os.environ['WELLKNIT']).parent}:{os.environ['PATH']}"
        command = ["snakemake", "--snakefile", EXAMPLE / "Snakefile", "--directory", folder / "work", "--cores", "2", "--config", f"case={case}", "realisations=2",
                   f"wells={sys.argv[1]}", f"mesh={sys.argv[2]}"]
        done = subprocess.run(list(map(str, command)), env=dict(os.environ, PATH=path), capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(done.stdout[-3000:], done.stderr[-3000:])
            return 1
        rows = list(csv.reader((folder / "work/totals.csv").open()))
        print("\n".join(",".join(row) for row in rows))
        assert [row[0] for row in rows] == ["run", "real_001", "real_002", "mean", "p10", "p50", "p90"]
        assert float(rows[1][1]) > 0 and rows[1][1] != rows[2][1], "two realisations, two totals"
        assert "polyline" in (folder / "work/totals.svg").read_text()
    return 0


if __name__ == "__main__":
    sys.exit(main())
