# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The step of examples/ert without ERT, which Debian does not have: the files are read by the rules of ERT's documentation (keywords.rst, forward_model.rst), and the program is run in a
realisation's folder with the arguments that ERT would give it.

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"])
EXAMPLE = SOURCE / "examples/ert"
sys.path.insert(0, str(SOURCE / "tests/cli"))

# A text in quotes, a comment, or a word: at the beginning of a word two dashes make a comment.
TOKEN = re.compile(r'"(?P<double>(?:[^"\\]|\\.)*)"|\'(?P<single>(?:[^\'\\]|\\.)*)\'|(?P<comment>--.*)|(?P<word>[^" \t\n]+)')
STEP_KEYWORDS = {"EXECUTABLE", "ARGLIST", "REQUIRED", "DEFAULT", "STDOUT", "STDERR", "STDIN", "TARGET_FILE", "START_FILE", "ERROR_FILE", "MAX_RUNNING_MINUTES", "ENV", "ARG_TYPE", "MIN_ARG",
                 "MAX_ARG"}


def words(line):
    out = []
    for found in TOKEN.finditer(line):
        if found["comment"] is not None:
            break
        out.append(next(found[kind] for kind in ("double", "single", "word") if found[kind] is not None))
    return out


def lines_of(path):
    return [line for line in map(words, path.read_text(encoding="utf-8").splitlines()) if line]


def forward_models(path):
    """(name, arguments) of each FORWARD_MODEL: NAME(<KEY>=value, …)."""
    out = []
    for line in path.read_text(encoding="utf-8").splitlines():
        found = re.fullmatch(r"FORWARD_MODEL\s+(\w+)(?:\((.*)\))?\s*", line)
        if found:
            pairs = re.findall(r'(<\w+>)\s*=\s*("[^"]*"|[^",()= \t]+)', found[2] or "")
            out.append((found[1], {key: value.strip('"') for key, value in pairs}))
    return out


def arguments_of(step, given):
    """ARGLIST with what FORWARD_MODEL gives; an argument that is nothing but a name without a value takes its default."""
    defaults = {line[1]: line[2] for line in step if line[0] == "DEFAULT"}
    required = {name for line in step if line[0] == "REQUIRED" for name in line[1:]}
    assert required <= set(given), f"REQUIRED names {required - set(given)}, which FORWARD_MODEL does not give"

    def filled(text):
        for key, value in given.items():
            text = text.replace(key, value)
        return defaults.get(text, text)
    arglist = [filled(text) for line in step if line[0] == "ARGLIST" for text in line[1:]]
    assert not [text for text in arglist if "<" in text], arglist
    return arglist, filled


def run_step(step, given, folder):
    """The exit code; output and errors go where the step says."""
    (executable,) = [line[1] for line in step if line[0] == "EXECUTABLE"]
    assert executable == "wellknit", "found on the PATH by its name"
    arguments, filled = arguments_of(step, given)
    streams = {line[0]: folder / f"{line[1]}.0" for line in step if line[0] in ("STDOUT", "STDERR")}
    with streams["STDOUT"].open("w") as out, streams["STDERR"].open("w") as err:
        code = subprocess.run([os.environ["WELLKNIT"], *arguments], cwd=folder, stdout=out, stderr=err, check=False, timeout=300).returncode
    (target,) = [filled(line[1]) for line in step if line[0] == "TARGET_FILE"]
    return code, folder / target, streams["STDERR"].read_text()


def realisation(folder):
    import whole_deck
    for name, text in whole_deck.files().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="latin-1")


def check_reading():
    assert words('ARGLIST build "--deck-wells" <WELLS> deck=<M>.DATA -- end') == ["ARGLIST", "build", "--deck-wells", "<WELLS>", "deck=<M>.DATA"]
    assert words("ARGLIST build --deck-wells all") == ["ARGLIST", "build"], "without quotes the rest is a comment"


def main():
    check_reading()
    step = lines_of(EXAMPLE / "WELLKNIT")
    assert {line[0] for line in step} <= STEP_KEYWORDS
    config = lines_of(EXAMPLE / "ensemble.ert")
    models = forward_models(EXAMPLE / "ensemble.ert")
    assert [name for name, _ in models] == ["WELLKNIT", "FLOW"]
    assert ["INSTALL_JOB", "WELLKNIT", "WELLKNIT"] in config
    given = dict(models)["WELLKNIT"]
    (base,) = [line[1] for line in config if line[0] == "ECLBASE"]
    assert base == given["<MESHED>"], "FLOW runs ECLBASE.DATA, and ERT loads its summary"
    page = (SOURCE / "docs/workflow.md").read_text(encoding="utf-8")
    for name in ("WELLKNIT", "ensemble.ert"):
        assert (EXAMPLE / name).read_text(encoding="utf-8") in page, f"docs/workflow.md shows another {name}"
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "realization-0/iter-0"
        realisation(folder)
        code, target, errors = run_step(step, {**given, "<WELLS>": "NOBODY"}, folder)
        assert code == 1 and not target.exists() and "no well NOBODY" in errors, (code, errors)
        code, target, errors = run_step(step, given, folder)
        assert code == 0 and target.exists() and errors == "", (code, errors)
        # ERT runs a realisation again in the same folder, and other wells are another argument.
        every = target.read_text(encoding="latin-1")
        assert run_step(step, {**given, "<WELLS>": "P1"}, folder)[0] == 0 and target.read_text(encoding="latin-1") != every
        if shutil.which("flow"):
            options = dict(models)["FLOW"]["<OPTS>"].split()
            done = subprocess.run(["flow", f"{base}.DATA", *options], cwd=folder, capture_output=True, text=True, check=False, timeout=300)
            assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-1000:]
            assert (folder / f"{base}.UNSMRY").exists()
    return 0


if __name__ == "__main__":
    sys.exit(main())
