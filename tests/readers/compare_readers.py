#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of read_case against independent readers: the few lines of Python below, and OPM's parser where it is installed.

compare_readers.py public DUMP_CASE FOLDER     real decks and grids; skipped (77) without the folder
compare_readers.py generated DUMP_CASE [SEED]  random decks with operations on arrays; skipped without OPM's parser
"""
import pathlib
import random
import re
import subprocess
import sys
import tempfile

SKIP = 77
try:
    import numpy as np
except ImportError:
    print("no numpy")
    sys.exit(SKIP)
try:
    from opm.io.ecl_state import EclipseState
    from opm.io.parser import ParseContext, Parser
except ImportError:
    Parser = None

MILLIDARCY = 9.869232667160130e-16
FOOT = 0.3048


def dump(program, case, *includes):
    """All arrays by name, the notes, and the faults (name: faces, multiplier)."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, folder, str(case), *map(str, includes)], capture_output=True, text=True)
        assert done.returncode == 0, f"{case}: {done.stderr}"
        path = pathlib.Path(folder)
        arrays = {f.stem: np.fromfile(f) for f in path.glob("*.f64")}
        notes = (path / "notes.txt").read_text().splitlines()
        faults = [line.split("\t") for line in (path / "faults.txt").read_text().splitlines()]
    return arrays, notes, {name: (int(faces), float(factor)) for name, faces, factor in faults}


def array_in(text, keyword):
    """The last array of this keyword in a text without INCLUDEs; nothing where it does not stand."""
    text = re.sub(r"--[^\n]*", "", text)
    found = list(re.finditer(rf"^\s*{keyword}\b((?:[\s\d.*+-]|[EDed][+-]?\d)+)/", text, re.MULTILINE))
    if not found:
        return None
    out = []
    for token in found[-1].group(1).split():
        count, star, value = token.rpartition("*")
        out += (int(count) if star else 1) * [float(value.replace("D", "E"))]
    return np.array(out)


def same(what, ours, theirs, tolerance=0.0):
    assert ours.shape == theirs.shape, f"{what}: {ours.shape} values, expected {theirs.shape}"
    difference = np.abs(ours - theirs)
    assert np.all(difference <= tolerance * np.abs(theirs)), f"{what}: differs by up to {difference.max()}"


def check_text(program, case, unit=1.0, texts=None, keywords=("COORD", "ZCORN", "ACTNUM"), notes=0):
    """What a file gives as plain arrays."""
    arrays, found_notes, _ = dump(program, case)
    assert len(found_notes) == notes, f"{case}: {found_notes}"
    text = "\n".join(path.read_text(errors="replace") for path in (texts or [case]))
    compared = 0
    for keyword in keywords:
        theirs = array_in(text, keyword)
        if theirs is None:
            continue
        scale = unit if keyword in ("COORD", "ZCORN") else MILLIDARCY if keyword.startswith("PERM") else 1.0
        same(f"{case} {keyword}", arrays[keyword], theirs * scale)
        compared += 1
    assert compared >= 2, case


def check_state(program, case, properties, unit=1.0):
    """A whole deck against the state that OPM makes of it."""
    arrays, _, faults = dump(program, case)
    deck = Parser().parse(str(case), ParseContext())
    state = EclipseState(deck)
    grid = state.grid()
    active = arrays["ACTNUM"] > 0
    assert grid.nactive == active.sum()
    for keyword in ("COORD", "ZCORN"):
        if keyword in deck:
            theirs = [entry for entry in deck if entry.name == keyword][-1]
            same(f"{case} {keyword}", arrays[keyword], np.array(theirs.get_raw_array()) * unit, 1e-15)
    volumes = np.array([grid.getCellVolume(cell) for cell in range(active.size)])
    # OPM integrates each cell by trilinear shape functions, which for boxes and sheared boxes is the same number.
    same(f"{case} volume", np.abs(arrays["volume"]), volumes, 1e-9)
    for keyword in properties:
        get = state.field_props().get_int_array if keyword.endswith("NUM") else state.field_props().get_double_array
        same(f"{case} {keyword}", arrays[keyword][active], np.array(get(keyword), dtype=float), 1e-14)
    assert sorted(faults) == sorted(state.faultNames())
    for name, (faces, _) in faults.items():
        assert faces == len(state.faultFaces(name)), name


def public(program, folder):
    data = pathlib.Path(folder) / "data"
    if not data.is_dir():
        print("no folder", data)
        return SKIP
    for case in sorted((data / "odd").glob("*.grdecl")):
        check_text(program, case)
    reek = [data / "reek" / f"reek_sim{part}.grdecl" for part in ("", "_poro", "_faults")]
    check_text(program, reek[0])
    arrays, notes, faults = dump(program, *reek)
    same("reek PORO", arrays["PORO"], array_in(reek[1].read_text(), "PORO"))
    records = [line.split() for line in reek[2].read_text().splitlines() if re.match(r"\s*'?\w+'?(\s+\d+){6}\s", line)]
    assert not notes and sum(faces for faces, _ in faults.values()) == sum(
        (int(r[2]) - int(r[1]) + 1) * (int(r[4]) - int(r[3]) + 1) * (int(r[6]) - int(r[5]) + 1) for r in records)
    nwm = [data / "nwm" / name for name in ("coord.inc", "zcorn.inc", "actnum.inc", "perm.inc")]
    check_text(program, data / "nwm" / "NWM.data", 1.0, nwm, ("COORD", "ZCORN", "ACTNUM", "PERMX"))
    for name in ("SPE1CASE1_WELTRAJ.DATA", "SPE1CASE1_WELTRAJ_2.DATA"):
        case = data / "decks" / name
        arrays, _, _ = dump(program, case)
        text = case.read_text()
        same(name, arrays["PERMZ"], array_in(text, "PERMZ") * MILLIDARCY)
        same(name, arrays["volume"], np.prod([array_in(text, k) for k in ("DX", "DY", "DZ")], axis=0) * FOOT**3, 1e-12)
    spe9 = data / "spe9"
    blocks, corners = (dump(program, spe9 / name)[0] for name in ("SPE9.DATA", "SPE9_CP.DATA"))
    same("SPE9 volume", blocks["volume"], corners["volume"], 1e-6)
    check_text(program, spe9 / "SPE9_CP.DATA", FOOT, [spe9 / "SPE9.GRDECL", spe9 / "PERMVALUES.DATA"],
               ("COORD", "ZCORN", "PERMX"))
    if Parser is None:
        print("without OPM's parser")
        return 0
    check_state(program, spe9 / "SPE9_CP.DATA", ("PORO", "PERMX", "PERMY", "PERMZ"), FOOT)
    check_state(program, spe9 / "SPE9.DATA", ("PORO", "PERMX", "PERMY", "PERMZ"), FOOT)
    check_state(program, data / "model5" / "MODEL5.DATA",
                ("PORO", "PERMX", "PERMY", "PERMZ", "MULTY", "EQLNUM", "FIPNUM", "SATNUM"))
    return 0


REALS = ("PORO", "PERMX", "PERMY", "PERMZ", "NTG", "MULTX", "MULTX-", "MULTZ", "MULTPV")
REGIONS = ("FLUXNUM", "MULTNUM", "OPERNUM", "SATNUM", "FIPNUM")


class Generator:
    """A deck whose arrays go through random operations, each of them in a form that all readers agree on."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.n = [self.random.randint(1, 4) for _ in range(3)]
        self.cells = self.n[0] * self.n[1] * self.n[2]

    def number(self, low=0.1, high=2.0):
        value = self.random.uniform(low, high)
        return self.random.choice([f"{value:.4f}", f"{value:.3E}", f"{value:.3E}".replace("E", "D")])

    def values(self, of, count):
        out = []
        while count > 0:
            repeat = self.random.randint(1, min(count, 5))
            out.append(f"{repeat}*{of()}" if repeat > 1 or self.random.random() < 0.2 else of())
            count -= repeat
        return self.random.choice([" ", "\n", "\t"]).join(out) + self.random.choice(["/", " /", "\n/ text"])

    def box(self):
        if self.random.random() < 0.3:
            return ""
        pairs = [sorted(self.random.choices(range(1, n + 1), k=2)) for n in self.n]
        return " ".join(f"{a} {b}" for a, b in pairs)

    def operation(self, names):
        r = self.random
        name = r.choice(names)
        kind = r.randint(0, 5)
        quoted = r.choice([name, f"'{name}'"])
        if kind == 0:
            keyword = r.choice(["EQUALS", "ADD", "MULTIPLY", "MINVALUE", "MAXVALUE"])
            return f"{keyword}\n {quoted} {self.number()} {self.box()} /\n/\n"
        if kind == 1:
            # Of one unit: OPM copies SI numbers, others those of the deck.
            other = r.choice([n for n in names if n != name and n.startswith("PERM") == name.startswith("PERM")])
            return f"COPY\n {quoted} {other} {self.box()} /\n/\n"
        if kind == 2:
            keyword = r.choice(["EQUALREG", "ADDREG", "MULTIREG"])
            return f"{keyword}\n {quoted} {self.number()} {r.randint(1, 3)} {r.choice('FMO')} /\n/\n"
        if kind == 3:
            return f"EQUALREG\n {quoted} {self.number()} {r.randint(1, 3)} /\n/\n"
        # Only of numbers without unit: older OPM versions compute OPERATE on others in SI units.
        name, other = r.choices(["PORO", "NTG"], k=2)
        function = r.choice(["MULTA", "MULTX", "ADDX", "MULTIPLY", "POLY", "MULTP", "COPY", "MAXLIM", "MINLIM", "ABS"])
        box = " ".join(f"1 {n}" for n in self.n)
        return f"OPERATE\n {name} {box} {function} {other} {self.number(0.5, 1.5)} {self.number(0.5, 1.5)} /\n/\n"

    def deck(self):
        r = self.random
        units = r.choice(["METRIC", "FIELD", "LAB"])
        text = f"RUNSPEC\nDIMENS\n {self.n[0]} {self.n[1]} {self.n[2]} /\n{units}\nOIL\nWATER\nGRIDOPTS\n 'YES' {r.randint(0, 3)} /\n"
        text += "FAULTDIM\n 100 /\nTABDIMS\n/\nGRID\n"
        text += "".join(f"D{axis}\n {self.cells}*{r.randint(1, 50)} /\n" for axis in "XYZ")
        text += f"TOPS\n {self.n[0] * self.n[1]}*{r.randint(0, 3000)} /\n"
        for name in REGIONS[:3]:
            text += f"{name}\n {self.values(lambda: str(r.randint(1, 3)), self.cells)}\n"
        for name in REALS:
            text += f"{name}\n {self.values(self.number, self.cells)}\n"
        for _ in range(r.randint(1, 12)):
            text += self.operation([n for n in REALS if not n.startswith("MULT")])
        for _ in range(r.randint(0, 6)):
            keyword = r.choice(["EQUALS", "MULTIPLY", "ADD"])
            text += f"{keyword}\n {r.choice(REALS[5:])} {self.number()} {self.box()} /\n/\n"
        text += "FAULTS\n"
        for _ in range(r.randint(1, 5)):
            face = r.choice(["X", "Y-", "'I'", "'J-'", "K", "Z-", "I-"])
            axis = "XYZ".find(face.strip("'")[0]) % 3 if face.strip("'")[0] in "XYZ" else "IJK".find(face.strip("'")[0])
            pairs = [sorted(r.choices(range(1, n + 1), k=2)) for n in self.n]
            pairs[axis][1] = pairs[axis][0]
            text += f" 'F{r.randint(1, 3)}' " + " ".join(f"{a} {b}" for a, b in pairs) + f" {face} /\n"
        text += "/\n"
        if r.random() < 0.5:
            text += "EDIT\n"
            # Each once: of two in EDIT older OPM versions take the product and newer ones the last; MULTPV differs too.
            for name in r.sample(["MULTX", "MULTZ", "MULTX-"], r.randint(1, 3)):
                text += f"{name}\n {self.values(self.number, self.cells)}\n"
        return text + "REGIONS\n" + "".join(
            f"{name}\n {self.values(lambda: str(r.randint(1, 9)), self.cells)}\n" for name in REGIONS[3:])


def edit_multipliers_multiply():
    """Older OPM versions replace the multipliers of GRID by those of EDIT."""
    text = ("RUNSPEC\nDIMENS\n 1 1 1 /\nGRID\nDX\n 1 /\nDY\n 1 /\nDZ\n 1 /\nTOPS\n 0 /\nPORO\n 1 /\nMULTX\n 2 /\nEDIT\n"
            "MULTX\n 3 /\n")
    state = EclipseState(Parser().parse_string(text, ParseContext()))
    return state.field_props().get_double_array("MULTX")[0] == 6.0


def generated(program, seed):
    if Parser is None:
        print("without OPM's parser")
        return SKIP
    print("seed", seed)
    multiplies = edit_multipliers_multiply()
    refused = 0
    for n in range(200):
        text = Generator(seed + n).deck()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "CASE.DATA"
            path.write_text(text)
            try:
                state = EclipseState(Parser().parse(str(path), ParseContext()))
            except RuntimeError:
                refused += 1
                continue
            arrays, _, faults = dump(program, path)
        active = arrays["ACTNUM"] > 0
        arrays["MULTPV"] = arrays["MULTPV"] * arrays.get("MULTPV edit", 1.0)
        for keyword in REALS + REGIONS:
            if keyword.startswith("MULT") and "\nEDIT\n" in text and not multiplies:
                continue
            get = state.field_props().get_int_array if keyword in REGIONS else state.field_props().get_double_array
            ours = arrays[keyword][active]
            try:
                same(f"{keyword}", ours, np.array(get(keyword), dtype=float), 1e-13)
            except AssertionError as error:
                print(text)
                print(f"seed {seed + n}: {error}")
                return 1
        assert sorted(faults) == sorted(state.faultNames()), seed + n
        for name, (faces, _) in faults.items():
            assert faces == len(state.faultFaces(name)), (seed + n, name)
    print(200 - refused, "decks compared,", refused, "refused by OPM")
    assert refused < 100, "too few decks say anything"
    return 0


if __name__ == "__main__":
    if sys.argv[1] == "public":
        sys.exit(public(sys.argv[2], sys.argv[3]))
    sys.exit(generated(sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 20261122))
