# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives the program as a user does: exit codes, one line on stderr, no output left behind.

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR).
"""
import json
import os
import pathlib
import pty
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["WELLKNIT"]
PROJECT = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"])
NX, NY, NZ, DX, DZ, TOP = 15, 15, 8, 20.0, 10.0, 1000.0


def values(items):
    return " ".join(str(item) for item in items)


def coord():
    """Vertical pillars of a box of NX x NY cells."""
    return [v for j in range(NY + 1) for i in range(NX + 1) for v in (DX * i, DX * j, TOP, DX * i, DX * j, TOP + NZ * DZ)]


def zcorn():
    return [TOP + DZ * ((k + 1) // 2) for k in range(2 * NZ) for _ in range(4 * NX * NY)]


def grdecl(**changed):
    """A box as GRDECL text; an argument replaces a keyword's data, None leaves the keyword out."""
    cells = NX * NY * NZ
    data = {
        "SPECGRID": f"{NX} {NY} {NZ} 1 F",
        "COORD": values(coord()),
        "ZCORN": values(zcorn()),
        "PORO": f"{cells}*0.2",
        "PERMX": f"{cells}*100",
        "PERMY": f"{cells}*100",
        "PERMZ": f"{cells}*10",
    }
    data.update(changed)
    return "".join(f"{keyword}\n{text}\n/\n" for keyword, text in data.items() if text is not None)


def csv(*points):
    rows, md, last = [], 0.0, points[0]
    for point in points:
        md += sum((a - b) ** 2 for a, b in zip(point, last)) ** 0.5
        rows.append(f"{md:.3f}," + ",".join(f"{c:.3f}" for c in point))
        last = point
    return "MD,X,Y,TVD\n" + "\n".join(rows) + "\n"


class Case(unittest.TestCase):
    """A fresh folder with a good grid and a good well through its middle."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)
        self.write("box.GRDECL", grdecl())
        self.write("well.csv", csv((155.0, 143.0, 990.0), (155.0, 143.0, 1090.0)))

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*"))

    def run_program(self, *arguments, **keywords):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=300, **keywords)

    def succeed(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def fail_with(self, exit_code, *arguments, mention=()):
        """The run fails as promised: this exit code, one line on stderr that says these words, and no new file."""
        before = self.files()
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, exit_code, result.stdout + result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.endswith("\n"))
        for word in mention:
            self.assertIn(word, result.stderr)
        self.assertEqual(self.files(), before)
        return result

    def fail_to_build(self, exit_code, *arguments, mention=()):
        return self.fail_with(exit_code, "build", *arguments, "-o", "out.h5", "--write", "vtu=out.vtu", mention=mention)


class BadInput(Case):
    def test_missing_grid(self):
        self.fail_to_build(1, "nowhere.GRDECL", mention=["nowhere.GRDECL"])

    def test_missing_trajectory(self):
        self.fail_to_build(1, "box.GRDECL", "--well", "nowhere.csv", mention=["nowhere.csv"])

    def test_missing_include(self):
        self.write("box.GRDECL", grdecl() + "INCLUDE\n'nowhere.inc' /\n")
        self.fail_to_build(1, "box.GRDECL", mention=["nowhere.inc"])

    def test_cut_zcorn(self):
        text = grdecl()
        self.write("box.GRDECL", text[: text.index("ZCORN") + 5000])
        self.fail_to_build(1, "box.GRDECL", mention=["box.GRDECL", "ZCORN"])

    def test_wrong_count(self):
        self.write("box.GRDECL", grdecl(PORO="17*0.2"))
        self.fail_to_build(1, "box.GRDECL", mention=["box.GRDECL:", "PORO", "1800", "17"])

    def test_too_many_values(self):
        self.write("box.GRDECL", grdecl(ZCORN=values(zcorn() + [1.0])))
        self.fail_to_build(1, "box.GRDECL", mention=["box.GRDECL:", "ZCORN"])

    def test_text_in_a_number(self):
        self.write("box.GRDECL", grdecl(COORD=values(coord()).replace("20.0", "2O.0", 1)))
        self.fail_to_build(1, "box.GRDECL", mention=["box.GRDECL:", "COORD", "2O.0"])

    def test_text_in_a_trajectory(self):
        self.write("well.csv", "MD,X,Y,TVD\n0,1,2,3\n10,abc,2,13\n")
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv", mention=["well.csv:3", "abc"])

    def test_negative_bore_radius(self):
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv", "--bore", "-0.1", mention=["--bore", "-0.1"])
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv,bore=-0.1", mention=["--well", "-0.1"])

    def test_bore_wider_than_the_drainage_radius(self):
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv,bore=20", mention=["20", "15"])

    def test_well_outside_the_grid(self):
        self.write("well.csv", csv((5000.0, 5000.0, 990.0), (5000.0, 5000.0, 1090.0)))
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv", mention=["well"])

    def test_tube_larger_than_the_grid(self):
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv", "--radius", "400", mention=["400"])

    def test_unknown_option(self):
        self.fail_to_build(2, "box.GRDECL", "--frobnicate", mention=["--frobnicate"])

    def test_unknown_key_of_a_well(self):
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv,radios=3", mention=["radios", "radius"])

    def test_bad_option_values(self):
        for option, value in (("--radius", "-3"), ("--radius", "nan"), ("--sectors", "2"), ("--sectors", "4.5"), ("--rings", "0"),
                              ("--growth", "0"), ("--segments", "0"), ("--mode", "spiral"), ("--threads", "0"), ("--refine", "11"),
                              ("--fault-policy", "jump"), ("--heal-throw", "-1"), ("--metric", "euclidean"), ("--split", "0"), ("--split", "11"), ("--mapping", "best"),
                              ("--write", "vtu"), ("--write", "png=a.png"), ("--deck-wells", "")):
            with self.subTest(option=option, value=value):
                self.fail_to_build(2, "box.GRDECL", "--well", "well.csv", option, value, mention=[option if option != "--write" else value.split("=")[0]])

    def test_heal_throw_without_heal(self):
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv", "--heal-throw", "1", mention=["--heal-throw", "--fault-policy heal"])
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv", "--fault-policy", "stop", "--heal-throw", "1", mention=["--heal-throw"])

    def test_include_loop(self):
        self.write("box.GRDECL", "INCLUDE\n'other.inc' /\n" + grdecl())
        self.write("other.inc", "INCLUDE\n'box.GRDECL' /\n")
        self.fail_to_build(1, "box.GRDECL", mention=["INCLUDE"])

    def test_unwritable_output(self):
        self.fail_with(1, "build", "box.GRDECL", "-o", "no/such/folder/out.h5", mention=["no/such/folder"])
        self.fail_with(1, "build", "box.GRDECL", "-o", "box.GRDECL/out.h5", mention=["box.GRDECL"])
        self.fail_with(1, "build", "box.GRDECL", "-o", "/dev/null/out.h5", mention=["/dev/null"])

    def test_existing_output(self):
        self.write("out.h5", "precious")
        self.fail_with(1, "build", "box.GRDECL", "-o", "out.h5", mention=["out.h5", "--overwrite"])
        self.assertEqual((self.folder / "out.h5").read_text(), "precious")

    def test_existing_second_output(self):
        self.write("out.vtu", "precious")
        self.fail_to_build(1, "box.GRDECL", mention=["out.vtu"])

    def test_existing_output_is_told_before_the_case_is_read(self):
        self.write("out.h5", "precious")
        self.fail_with(1, "build", "nowhere.GRDECL", "-o", "out.h5", mention=["out.h5"])

    def test_empty_files(self):
        for name in ("empty.GRDECL", "empty.DATA", "empty.csv", "empty.dev"):
            self.write(name, "")
        self.fail_to_build(1, "empty.GRDECL", mention=["empty.GRDECL"])
        self.fail_to_build(1, "empty.DATA", mention=["empty.DATA"])
        self.fail_to_build(1, "box.GRDECL", "--well", "empty.csv", mention=["empty.csv"])
        self.fail_to_build(1, "box.GRDECL", "--well", "empty.dev", mention=["empty.dev"])

    def test_files_that_are_no_mesh(self):
        self.write("empty.h5", "")
        for name in ("nowhere.h5", "empty.h5", "box.GRDECL"):
            with self.subTest(name=name):
                self.fail_with(1, "check", name, mention=[name])

    def test_folder_as_input(self):
        (self.folder / "folder").mkdir()
        self.fail_to_build(1, "folder", mention=["folder"])
        self.fail_with(1, "info", "folder", mention=["folder"])

    def test_nothing_given(self):
        self.fail_with(2, "build", mention=["CASE"])
        self.fail_with(2, "build", "box.GRDECL", mention=["-o"])
        self.fail_with(2, mention=["command"])
        self.fail_with(2, "simulate", "out.h5", mention=["simulate"])

    def test_deck_wells_of_a_grid_without_wells(self):
        self.fail_to_build(1, "box.GRDECL", "--deck-wells", "all", mention=["--deck-wells"])

    def test_a_full_disk_leaves_nothing(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "formats"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))

    def test_a_disk_that_fills_up_leaves_nothing_of_any_format(self):
        """A limit on the size of files fails a write half-way, as a full disk does."""
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5")
        before = self.files()

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the write fails instead
            resource.setrlimit(resource.RLIMIT_FSIZE, (5_000, 5_000))
        names = [line.split("[")[1].split("]")[0] for line in self.succeed("formats", "--markdown").splitlines() if line.startswith("| out ")]
        self.assertGreaterEqual(len(names), 17)
        for name in names:
            with self.subTest(format=name):
                result = subprocess.run([PROGRAM, "convert", "mesh.h5", "out", "--to", name, "--source", "box.GRDECL"], cwd=self.folder, capture_output=True,
                                        text=True, preexec_fn=limit, restore_signals=False)
                if name == "vtp":  # smaller than the limit
                    self.assertEqual(result.returncode, 0, result.stderr)
                    (self.folder / "out").unlink()
                else:
                    self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
                    self.assertIn("is the disk full?", result.stderr)
                self.assertEqual(self.files(), before)


class Outputs(Case):
    def test_every_output_and_no_other_file(self):
        before = self.files()
        self.succeed("build", "box.GRDECL", "--well", "well.csv", "-o", "out.h5", "--write", "vtu=out.vtu", "--write", "deck=OUT.DATA")
        self.assertEqual(self.files(), sorted(before + ["out.h5", "out.vtu", "OUT.DATA"]))

    def test_overwrite_replaces(self):
        self.write("out.h5", "old")
        self.succeed("build", "box.GRDECL", "-o", "out.h5", "--overwrite")
        self.assertEqual((self.folder / "out.h5").read_bytes()[:4], b"\x89HDF")

    def test_an_input_is_never_an_output(self):
        self.fail_with(2, "build", "box.GRDECL", "-o", "box.GRDECL", "--overwrite", mention=["input"])
        self.fail_with(2, "build", "box.GRDECL", "--well", "well.csv", "-o", "./well.csv", "--overwrite", mention=["input"])

    def test_two_outputs_of_one_path(self):
        self.fail_with(2, "build", "box.GRDECL", "-o", "a.h5", "--write", "vtu=./a.h5", mention=["a.h5"])

    def test_a_folder_as_output(self):
        before = self.files()
        text = self.succeed("build", "box.GRDECL", "--well", "well.csv", "-o", "out.h5", "--write", "openfoam=case")
        self.assertIn("case (openfoam, ", text)
        new = [name for name in self.files() if name not in before]
        self.assertEqual([name for name in new if "/" not in name], ["case", "out.h5"])
        self.assertIn("case/constant/polyMesh/faces", new)
        self.fail_with(1, "build", "box.GRDECL", "--write", "openfoam=case", mention=["case", "--overwrite"])
        self.succeed("build", "box.GRDECL", "--write", "openfoam=case/", "--overwrite")
        self.write("case/results.txt", "precious")
        self.fail_with(1, "build", "box.GRDECL", "--write", "openfoam=case", "--overwrite", mention=["case", "results.txt"])
        # Outputs that hinder each other: the mesh file gets its name first, and then the folder is not empty.
        (self.folder / "fresh").mkdir()
        self.fail_with(1, "build", "box.GRDECL", "-o", "fresh/out.h5", "--write", "openfoam=fresh", mention=["fresh"])

    def test_host_alone(self):
        text = self.succeed("build", "box.GRDECL", "-o", "out.h5")
        self.assertIn("1,800 cells", text)
        self.succeed("check", "out.h5")


class Threads(Case):
    def test_same_bytes_for_any_thread_count(self):
        self.write("flat.csv", csv((60.0, 60.0, 1040.0), (100.0, 62.0, 1041.0), (140.0, 66.0, 1041.0)))
        made = []
        for threads in (1, 2, 4):
            name = f"t{threads}.h5"
            self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "--well", "flat.csv,radius=5", "-o", name, "--threads", threads)
            made.append((self.folder / name).read_bytes())
        self.assertEqual(made[0], made[1])
        self.assertEqual(made[0], made[2])


class Convert(Case):
    def test_mesh_file_to_vtu_and_back(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", "--write", "vtu=direct.vtu")
        self.assertIn("vtu", self.succeed("convert", "mesh.h5", "out.vtu"))
        self.assertEqual((self.folder / "out.vtu").read_bytes(), (self.folder / "direct.vtu").read_bytes())
        self.succeed("convert", "mesh.h5", "again.h5", "--quiet")
        self.assertEqual((self.folder / "again.h5").read_bytes(), (self.folder / "mesh.h5").read_bytes())
        self.succeed("convert", "mesh.h5", "deck.txt", "--to", "deck")

    def test_mesh_file_to_every_format(self):
        """convert gives the bytes of build --write, and info knows what it is."""
        outputs = {"opm_grid": "a.opmgrid", "mrst": "a.mat", "pflotran": "a.pflotran", "pflotran_h5": "a.pflotran_h5", "tough": "a.tough",
                   "darts": "a.npz", "darts_h5": "a.darts_h5", "adgprs": "a.adgprs", "csv": "a.tables", "fehm": "a.fehm", "dgf": "a.dgf",
                   "openfoam": "a.openfoam", "vtu": "a.vtu", "vtp": "a.vtp", "vtkhdf": "a.vtkhdf"}
        written = [word for name, path in outputs.items() for word in ("--write", f"{name}={path}")]
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", *written)

        def content(name):
            path = self.folder / name
            files = sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]
            return [(str(p.relative_to(path)), p.read_bytes()) for p in files]
        for path in outputs.values():
            with self.subTest(path=path):
                self.succeed("convert", "mesh.h5", "b" + path, *(["--source", "box.GRDECL"] if path == "a.vtkhdf" else []))
                self.assertEqual(content("b" + path), content(path))
        mesh = json.loads(self.succeed("info", "mesh.h5", "--json"))["mesh"]
        numbers = {"cells": sum(mesh["cells"].values()), "faces": mesh["faces"], "connections": mesh["connections"], "vertices": mesh["vertices"]}
        counted = {"cells": ("a.opmgrid", "a.pflotran", "a.pflotran/mesh.uge", "a.pflotran_h5", "a.tough", "a.tough/MESH", "a.npz", "a.darts_h5", "a.tables",
                             "a.tables/cells.csv", "a.fehm", "a.fehm/mesh.stor", "a.dgf", "a.openfoam", "a.vtu"),
                   "faces": ("a.opmgrid", "a.dgf", "a.openfoam"),
                   "connections": ("a.pflotran", "a.pflotran_h5", "a.tough", "a.npz", "a.darts_h5", "a.adgprs", "a.adgprs/connections.txt", "a.tables",
                                   "a.tables/connections.csv", "a.fehm"),
                   "vertices": ("a.opmgrid", "a.dgf", "a.openfoam", "a.vtu")}
        for what, paths in counted.items():
            for path in paths:
                with self.subTest(path=path, what=what):
                    self.assertEqual(json.loads(self.succeed("info", path, "--json"))["exported"][what], numbers[what])
        self.assertEqual(json.loads(self.succeed("info", "a.vtkhdf", "--json"))["exported"]["cells"], 1800)
        self.assertEqual(json.loads(self.succeed("info", "a.vtp", "--json"))["exported"]["cells"], 1)
        self.assertIn("a.mat", self.succeed("info", "a.mat"))

    def test_vtkhdf_needs_the_source(self):
        self.succeed("build", "box.GRDECL", "-o", "mesh.h5")
        self.fail_with(1, "convert", "mesh.h5", "host.vtkhdf", mention=["--source"])
        self.assertFalse((self.folder / "host.vtkhdf").exists())

    def test_vtu_for_geos(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", "--write", "vtu=geos.vtu,for=geos")
        self.succeed("convert", "mesh.h5", "again.vtu", "--to", "vtu,for=geos")
        self.assertEqual((self.folder / "geos.vtu").read_bytes(), (self.folder / "again.vtu").read_bytes())
        self.fail_with(2, "convert", "mesh.h5", "none.vtu", "--to", "vtu,for=nobody", mention=["for", "paraview|geos"])

    def test_mesh_file_to_a_folder(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", "--write", "openfoam=direct")
        self.succeed("convert", "mesh.h5", "by_extension.openfoam")
        self.succeed("convert", "mesh.h5", "by_name", "--to", "openfoam")
        content = lambda name: {str(p.relative_to(self.folder / name)): p.read_bytes() for p in (self.folder / name).rglob("*") if p.is_file()}
        self.assertEqual(content("by_extension.openfoam"), content("direct"))
        self.assertEqual(content("by_name"), content("direct"))
        self.assertIn("bore_well", (self.folder / "direct/constant/polyMesh/boundary").read_text())

    def test_keys_of_outputs(self):
        """The same bytes by --write, a run file and convert; plain refusals."""
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5",
                     "--write", "deck=A.DATA,layout=portable,order=rcm", "--write", "deck=N.DATA,layout=nested", "--write", "vtu=odd,name.vtu")
        self.assertTrue((self.folder / "odd,name.vtu").exists())
        self.write("run.toml", "case = 'box.GRDECL'\nradius = 9\n[[well]]\nfile = 'well.csv'\n[write]\nvtu = 'c.vtu'\n"
                   "deck = [{path = 'C.DATA', layout = 'portable', order = 'rcm'}, {path = 'D.DATA', layout = 'nested'}]\n")
        self.succeed("build", "run.toml")
        self.succeed("convert", "mesh.h5", "B.DATA", "--to", "deck,layout=portable,order=rcm")
        self.succeed("convert", "mesh.h5", "M.DATA", "--to", "deck,layout=nested", "--source", "box.GRDECL")
        self.succeed("convert", "box.GRDECL", "H.DATA", "--to", "deck,layout=nested")
        same = lambda *names: self.assertEqual(len({(self.folder / name).read_bytes() for name in names}), 1, names)
        same("A.DATA", "B.DATA", "C.DATA")
        same("A_CELLS.grdecl", "B_CELLS.grdecl", "C_CELLS.grdecl")
        same("N.DATA", "M.DATA", "D.DATA")
        for end in ("CELLS", "REFINE", "OLDIJK"):
            same(f"N_{end}.grdecl", f"M_{end}.grdecl", f"D_{end}.grdecl")
        for line, words in (("deck=X.DATA,layout=wide", ["layout", "portable", "wide"]), ("deck=X.DATA,colour=red", ["colour", "layout"]),
                            ("vtu=x.vtu,layout=row", ["vtu", "layout"]), ("deck=,layout=row", ["FORMAT=PATH"])):
            with self.subTest(line=line):
                self.fail_with(2, "build", "box.GRDECL", "--well", "well.csv", "--write", line, mention=["--write", *words])
        self.fail_with(2, "convert", "mesh.h5", "X.DATA", "--to", "deck,layout=wide", mention=["layout", "wide"])
        self.fail_with(1, "convert", "mesh.h5", "X.DATA", "--to", "deck,layout=nested", mention=["--source"])
        (self.folder / "A.DATA").unlink()
        self.fail_with(1, "convert", "mesh.h5", "A.DATA", "--to", "deck,order=rcm", mention=["A_CELLS.grdecl", "--overwrite"])
        self.write("bad.toml", "case = 'box.GRDECL'\n[write]\ndeck = {path = 'Y.DATA', layout = 'wide'}\n")
        self.fail_with(2, "build", "bad.toml", mention=["bad.toml:3:", "layout", "wide"])
        self.write("bad.toml", "case = 'box.GRDECL'\n[write]\ndeck = {layout = 'row'}\n")
        self.fail_with(2, "build", "bad.toml", mention=["bad.toml:3:", "path"])
        self.assertEqual([p.name for p in self.folder.glob("[XY]*")], [])

    def test_grid_to_mesh_file(self):
        self.succeed("convert", "box.GRDECL", "host.h5")
        self.assertIn("valid", self.succeed("check", "host.h5"))

    def test_refusals(self):
        self.write("there.vtu", "precious")
        self.fail_with(1, "convert", "box.GRDECL", "there.vtu", mention=["--overwrite"])
        self.fail_with(1, "convert", "well.csv", "out.vtu", mention=["well.csv"])
        self.fail_with(1, "convert", "nowhere.h5", "out.vtu", mention=["nowhere.h5"])
        self.fail_with(2, "convert", "box.GRDECL", "out.xyz", mention=["--to"])
        self.fail_with(2, "convert", "box.GRDECL", "out.vtu", "--to", "png", mention=["png"])
        self.fail_with(2, "convert", "box.GRDECL", mention=["OUT"])


class Wells(Case):
    def summary(self, *arguments):
        return json.loads(self.succeed("build", "box.GRDECL", *arguments, "-o", "out.h5", "--overwrite", "--json"))

    def test_steep_well_is_meshed_layered(self):
        well = self.summary("--well", "well.csv,name=P1,radius=9,sectors=8,rings=4")["wells"][0]
        self.assertEqual((well["name"], well["meshed"], well["mode"]), ("P1", True, "layered"))
        self.assertEqual(well["radial_cells"], 8 * 4 * NZ)
        self.assertEqual(well["drainage_radius"], 9)

    def test_every_cavity_face_is_found_again(self):
        for cavity in self.summary("--well", "well.csv,radius=9")["cavities"]:
            self.assertGreater(cavity["boundary_faces"], 0)
            self.assertEqual(cavity["boundary_faces"], cavity["boundary_faces_found"])

    def test_own_key_wins_over_the_default(self):
        self.write("second.csv", csv((65.0, 63.0, 990.0), (65.0, 63.0, 1090.0)))
        wells = self.summary("--radius", "8", "--well", "well.csv", "--well", "second.csv,radius=6")["wells"]
        self.assertEqual([well["drainage_radius"] for well in wells], [8, 6])

    def test_open_interval_limits_the_connections(self):
        every = self.summary("--well", "well.csv,radius=9")["wells"][0]["connections"]
        some = self.summary("--well", "well.csv,radius=9,from=40,to=60")["wells"][0]["connections"]
        self.assertGreater(some, 0)
        self.assertLess(some, every)

    def test_open_interval_off_the_path(self):
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv,from=4000,to=6000", mention=["4000"])
        self.fail_to_build(2, "box.GRDECL", "--well", "well.csv,from=60,to=40", mention=["60"])

    def test_two_wells_of_one_name(self):
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv,name=A", "--well", "well.csv,name=A", mention=["A", "name="])

    def test_a_comma_in_the_file_name(self):
        self.write("a,b.csv", (self.folder / "well.csv").read_text())
        self.assertEqual(self.summary("--well", "a,b.csv,radius=9,name=W")["wells"][0]["name"], "W")

    def test_survey_takes_its_head_from_the_keys(self):
        self.write("survey.csv", "MD,INC,AZI\n0,0,0\n100,0,0\n")
        self.fail_to_build(1, "box.GRDECL", "--well", "survey.csv", mention=["survey.csv:1: head:", "kb="])
        well = self.summary("--well", "survey.csv,x=155,y=143,kb=-990,radius=9")["wells"][0]
        self.assertTrue(well["meshed"], well)
        self.assertEqual(json.loads(self.succeed("info", "survey.csv", "--json"))["wells"][0]["depth"], [0, 100])

    def test_map_coordinates_are_turned_with_mapaxes(self):
        self.write("box.GRDECL", grdecl(MAPAXES="1000 2100 1000 2000 1100 2000"))
        self.write("map.csv", csv((1155.0, 2143.0, 990.0), (1155.0, 2143.0, 1090.0)))
        summary = self.summary("--well", "map.csv,radius=9")
        self.assertTrue(summary["wells"][0]["meshed"])
        self.assertTrue([note for note in summary["notes"] if "with MAPAXES" in note], summary["notes"])
        self.write("far.csv", csv((9155.0, 2143.0, 990.0), (9155.0, 2143.0, 1090.0)))
        (self.folder / "out.h5").unlink()
        self.fail_to_build(1, "box.GRDECL", "--well", "far.csv,radius=9", mention=["well far does not meet the grid"])

    def test_name_picks_a_well_with_its_branches(self):
        rows = "A,,155,143,990\nA,,155,143,1090\nA,2,155,143,990\nA,2,95,103,1090\nB,,55,43,990\nB,,55,43,1090\n"
        self.write("wells.csv", "WELL,BRANCH,X,Y,TVD\n" + rows)
        wells = self.summary("--well", "wells.csv,name=A,radius=5")["wells"]
        self.assertEqual([well["name"] for well in wells], ["A", "A:2"])


class RunFile(Case):
    RUN = """
case = "box.GRDECL"
radius = 8
sectors = 8
output = "run.h5"
[[well]]
file = "well.csv"
name = "FROM_FILE"
[write]
vtu = "run.vtu"
"""

    def test_names_what_the_options_name(self):
        self.write("run.toml", self.RUN)
        text = self.succeed("build", "run.toml")
        self.assertIn("FROM_FILE", text)
        self.assertTrue((self.folder / "run.h5").exists() and (self.folder / "run.vtu").exists())

    def test_paths_are_taken_from_its_folder(self):
        self.write("run.toml", self.RUN)
        result = subprocess.run([PROGRAM, "build", str(self.folder / "run.toml")], cwd="/", capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "run.h5").exists())

    def test_options_win(self):
        self.write("run.toml", self.RUN)
        out = json.loads(self.succeed("build", "run.toml", "--radius", "6", "-o", "other.h5", "--json"))
        self.assertEqual(out["wells"][0]["drainage_radius"], 6)
        self.assertFalse((self.folder / "run.h5").exists())

    def test_faults_name_the_line(self):
        for text, line, word in (("radios = 3\n", 1, "radios"), ("radius = -3\n", 1, "-3"), ("case = 'box.GRDECL'\nradius = [1, 2]\n", 2, "list"),
                                 ("[[well]]\nfile = 'well.csv'\nbore = 'x'\n", 3, "bore"), ("radius = \n", 1, "")):
            with self.subTest(text=text):
                self.write("run.toml", text)
                self.fail_with(2, "build", "run.toml", "-o", "out.h5", mention=[f"run.toml:{line}:", word])

    def test_missing(self):
        self.fail_with(1, "build", "nowhere.toml", "-o", "out.h5", mention=["nowhere.toml"])

    def test_config_in_the_mesh_file_makes_the_same_mesh(self):
        try:
            import h5py
            import numpy
        except ImportError:
            self.skipTest("python3-h5py is not installed")
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=A", "--sectors", "8", "-o", "first.h5")
        with h5py.File(self.folder / "first.h5") as first:
            config = first.attrs["config"]
            self.write("again.toml", config if isinstance(config, str) else config.decode())
        self.succeed("build", "again.toml", "-o", "second.h5")
        with h5py.File(self.folder / "first.h5") as first, h5py.File(self.folder / "second.h5") as second:
            for name in ("vertices", "faces/vertices", "faces/cells", "connections/transmissibility", "wells/A/connections/well_index"):
                self.assertTrue(numpy.array_equal(first[name][:], second[name][:]), name)


class Summary(Case):
    def test_names_wells_mesh_quality_and_times(self):
        text = self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=P1", "-o", "out.h5")
        for word in ("P1", "layered", "removed", "transition", "radial", "inverted", "loops", "points", "faces", "connections", "quality", "time", "out.h5"):
            self.assertIn(word, text)

    def test_optimisation_is_there_when_asked_for(self):
        build = ("build", "box.GRDECL", "--well", "well.csv,radius=15", "-o", "out.h5", "--overwrite", "--json")
        self.assertNotIn("optimisation", json.loads(self.succeed(*build)))
        self.assertEqual(json.loads(self.succeed(*build, "--optimise", "on"))["optimisation"]["cells_restored"], 0)

    def test_quiet_prints_nothing(self):
        self.assertEqual(self.succeed("build", "box.GRDECL", "-o", "out.h5", "--quiet"), "")

    def test_json_says_the_same(self):
        out = json.loads(self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5", "--json"))
        self.assertEqual(out["source_dimensions"], [NX, NY, NZ])
        self.assertEqual(out["wells"][0]["cavity"], 0)
        self.assertGreater(out["cavities"][0]["transition_cells"], 0)
        self.assertAlmostEqual(out["pore_volume"], 0.2 * NX * NY * NZ * DX * DX * DZ, delta=1e-3)
        self.assertEqual(out["outputs"][0]["path"], "out.h5")
        self.assertEqual(out["outputs"][0]["bytes"], (self.folder / "out.h5").stat().st_size)
        self.assertTrue(all(time["seconds"] >= 0 for time in out["times"]))

    def test_names_odd_cells_in_the_summary_and_info(self):
        """Two cells of 10 x 10 x 2 m with a void of 1 m between them."""
        self.write("gap.GRDECL", "SPECGRID\n 1 1 2 1 F /\nCOORD\n 0 0 0 0 0 9 10 0 0 10 0 9 0 10 0 0 10 9 10 10 0 10 10 9 /\n"
                   "ZCORN\n 4*0 4*2 4*3 4*5 /\nPORO\n 2*0.2 /\n")
        line = "cells below a gap in their column: 1, 100 m2 in plan"
        for text in (self.succeed("build", "gap.GRDECL", "-o", "out.h5"), self.succeed("info", "gap.GRDECL")):
            self.assertIn(line, text)
            self.assertIn("worst (1, 1, 2): 1 m", text)
        built = json.loads(self.succeed("build", "gap.GRDECL", "-o", "out.h5", "--overwrite", "--json"))["validity"]
        self.assertEqual(built["gap"]["worst"], {"cell": [1, 1, 2], "other": [1, 1, 1], "figure": 1.0})
        self.assertEqual(built.pop("open_fault_faces"), 0)
        self.assertEqual(json.loads(self.succeed("info", "gap.GRDECL", "--json"))["validity"], built)

    def test_check_as_text_and_json(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5")
        self.assertIn("valid", self.succeed("check", "out.h5"))
        self.assertTrue(json.loads(self.succeed("check", "out.h5", "--json"))["valid"])

    def test_check_holds_the_limits(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5")
        self.write("good.toml", "negative_transmissibilities = 0\n")
        self.write("bad.toml", "min_volume = 1e30\n")
        self.succeed("check", "out.h5", "--limits", "good.toml")
        result = self.run_program("check", "out.h5", "--limits", "bad.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("min_volume", result.stdout)
        self.write("unknown.toml", "beauty = 1\n")
        self.fail_with(1, "check", "out.h5", "--limits", "unknown.toml", mention=["beauty"])

    def test_info_of_each_kind_of_file(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5")
        for name in ("box.GRDECL", "well.csv", "out.h5"):
            with self.subTest(name=name):
                self.assertIn(name, self.succeed("info", name))
                json.loads(self.succeed("info", name, "--json"))


class Report(Case):
    def setUp(self):
        super().setUp()
        self.write("summary.json", self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=P1", "-o", "mesh.h5", "--json"))

    def test_is_one_page_with_the_figures_of_check(self):
        self.assertIn("wrote", self.succeed("report", "mesh.h5", "-o", "page.html", "--summary", "summary.json"))
        page = (self.folder / "page.html").read_text()
        check = json.loads(self.succeed("check", "mesh.h5", "--json"))
        self.assertEqual(json.loads(page.split('id="check">')[1].split("</script>")[0]), check)
        for text in (check["headline"], "P1", "near-well mesh", "pore_volume_error"):
            self.assertIn(text, page)

    def test_says_why_a_well_was_not_meshed(self):
        self.write("summary.json", self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=P1", "--well",
                                                "well.csv,radius=9,name=P2", "-o", "two.h5", "--json"))
        reasons = [well["reason"] for well in json.loads((self.folder / "summary.json").read_text())["wells"] if well["reason"]]
        self.assertTrue(reasons)  # two wells of one path: one of them cannot be meshed
        self.succeed("report", "two.h5", "-o", "page.html", "--summary", "summary.json", "--quiet")
        page = (self.folder / "page.html").read_text()
        self.assertIn("Not meshed", page)
        self.assertIn("Not in a radial mesh", page)

    def test_refusals(self):
        self.fail_with(2, "report", "mesh.h5", mention=["--output"])
        self.fail_with(1, "report", "box.GRDECL", "-o", "page.html", mention=["box.GRDECL"])
        self.fail_with(1, "report", "mesh.h5", "-o", "nowhere/page.html", mention=["nowhere"])
        self.fail_with(1, "report", "mesh.h5", "-o", "page.html", "--summary", "well.csv", mention=["well.csv", "--json"])
        self.write("page.html", "mine")
        self.fail_with(1, "report", "mesh.h5", "-o", "page.html", mention=["--overwrite"])
        self.succeed("report", "mesh.h5", "-o", "page.html", "--overwrite")


class Terminal(Case):
    def on_a_terminal(self, *arguments, **environment):
        """What the program writes where both of its streams are a terminal."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        given = {**os.environ, "TERM": "xterm", **environment}
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=slave, stderr=slave,
                                   env=given)
        os.close(slave)
        text = b""
        while True:
            try:
                piece = os.read(master, 4096)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            text += piece
        process.wait()
        return text.decode()

    def test_colours_are_for_terminals(self):
        self.succeed("build", "box.GRDECL", "-o", "out.h5")
        self.assertIn("\x1b[32mout.h5: valid\x1b[0m", self.on_a_terminal("check", "out.h5", NO_COLOR=""))
        self.assertNotIn("\x1b", self.on_a_terminal("check", "out.h5", NO_COLOR="1"))
        self.assertNotIn("\x1b", self.on_a_terminal("check", "out.h5", TERM="dumb"))
        self.assertNotIn("\x1b", self.succeed("check", "out.h5"))
        self.assertIn("\x1b[31mwellknit:\x1b[0m nowhere.h5", self.on_a_terminal("check", "nowhere.h5", NO_COLOR=""))

    def test_progress_is_plain_lines_where_asked_for(self):
        result = self.run_program("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5", "--progress", "plain")
        self.assertEqual(result.returncode, 0)
        lines = result.stderr.splitlines()
        self.assertEqual([line.split()[1] for line in lines], ["read", "mesh", "quality", "write"])
        self.assertNotIn("\x1b", result.stderr)
        self.fail_with(2, "build", "box.GRDECL", "-o", "other.h5", "--progress", "much", mention=["auto, plain, off"])

    def test_the_report_of_a_build_comes_with_it(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "out.h5", "--report", "out.html")
        self.assertIn("near-well mesh", (self.folder / "out.html").read_text())
        self.fail_with(1, "build", "box.GRDECL", "-o", "other.h5", "--report", "out.html", mention=["out.html", "--overwrite"])
        self.fail_with(2, "build", "box.GRDECL", "-o", "other.h5", "--report", "other.h5", mention=["two outputs"])

    def interrupted(self, number):
        """Stopped as soon as something of an output is on the disk."""
        before = self.files()
        example = PROJECT / "testdata" / "example"  # large enough for writing to take longer than a signal
        command = [PROGRAM, "build", example / "example.GRDECL", "-o", "out.h5", "--write", "openfoam=foam", "--write",
                   "csv=tables", "--report", "out.html"]
        # What a shell runs in the background ignores SIGINT, and so do its children.
        process = subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        while self.files() == before and process.poll() is None:
            time.sleep(0.001)
        begin = time.monotonic()
        process.send_signal(number)
        _, text = process.communicate(timeout=20)
        return process.returncode, text, time.monotonic() - begin, sorted(set(self.files()) - set(before))

    def test_a_signal_ends_at_once_and_leaves_nothing(self):
        # The shell expects to see the signal of Ctrl-C itself.
        for number, expected, name in ((signal.SIGINT, -signal.SIGINT, "Ctrl-C"), (signal.SIGTERM, 1, "SIGTERM"), (signal.SIGHUP, 1, "SIGHUP")):
            with self.subTest(signal=number):
                code, text, seconds, left = self.interrupted(number)
                self.assertEqual(code, expected, text)
                self.assertIn(f"stopped by {name}; nothing was written", text)
                self.assertEqual(left, [])
                self.assertLess(seconds, 5.0)  # machines that do much else; it takes milliseconds


class Reference(Case):
    def test_manual_names_every_option(self):
        for command in ("build", "check", "report", "solve", "map", "convert", "info"):
            page = self.succeed("manual", command).replace("\\-", "-")
            for word in self.succeed(command, "--help").split():
                if word.startswith("--"):
                    self.assertIn(word.strip("`").split("=")[0].split(",")[0], page)
            for part in (".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS", ".SH EXIT STATUS"):
                self.assertIn(part, page)
        self.assertIn("wellknit\\-build", self.succeed("manual"))
        self.fail_with(2, "manual", "nothing", mention=["nothing"])

    def test_bash_completes(self):
        (self.folder / "complete.bash").write_text(self.succeed("completion", "bash"))
        for words, expected in (("wellknit ch", "check"), ("wellknit build --mod", "--mode"), ("wellknit build --mode sw", "swept"),
                                ("wellknit check --lim", "--limits")):
            script = (f"source complete.bash; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _wellknit;"
                      'echo "${COMPREPLY[@]}"')
            out = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, text=True, check=True).stdout
            self.assertEqual(out.split(), [expected], words)

    def test_other_shells(self):
        for shell, start in (("zsh", "#compdef wellknit"), ("fish", "# fish")):
            text = self.succeed("completion", shell)
            self.assertTrue(text.startswith(start))
            for word in ("heal-throw", "limits", "report"):
                self.assertIn(word, text)
        self.fail_with(2, "completion", "tcsh", mention=["bash, zsh or fish"])


class Solve(Case):
    """One vertical well in a box of 300 x 300 x 80 m, 100 mD."""

    def setUp(self):
        super().setUp()
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=W", "-o", "mesh.h5")

    def solve(self, *arguments):
        return json.loads(self.succeed("solve", "mesh.h5", "--json", *arguments))

    def test_rates_balance_and_scale_with_the_drawdown(self):
        one = self.solve("--boundary", "i-,i+=200bar", "--well", "W=190bar")
        two = self.solve("--boundary", "i-,i+=200bar", "--well", "W=180bar", "--viscosity", "2")
        well = one["wells"][0]
        self.assertGreater(well["rate_m3_per_day"], 0)
        # Twice the drawdown, twice the viscosity: the same rate, half the index.
        self.assertAlmostEqual(two["wells"][0]["rate_m3_per_day"] / well["rate_m3_per_day"], 1, places=9)
        self.assertAlmostEqual(one["boundary"]["rate_out_m3_per_day"] / well["rate_m3_per_day"], -1, places=9)
        self.assertAlmostEqual(sum(c["rate_m3_per_day"] for c in well["connections"]) / well["rate_m3_per_day"], 1, places=12)
        drop = well["mean_pressure_bar"] - well["pressure_bar"]
        self.assertAlmostEqual(well["productivity_index_m3_per_day_bar"] * drop / well["rate_m3_per_day"], 1, places=12)
        self.assertLess(one["balance"]["error"], 1e-10)
        self.assertTrue(190 <= one["pressure_bar"]["min"] <= one["pressure_bar"]["max"] <= 200)

    def test_rate_gives_back_the_pressure(self):
        rate = self.solve("--boundary", "all=200bar", "--well", "W=150bar")["wells"][0]["rate_m3_per_day"]
        again = self.solve("--boundary", "all=200bar", "--well", f"W={rate!r}m3/d", "--solver", "multigrid")
        self.assertAlmostEqual(again["wells"][0]["pressure_bar"], 150, places=7)

    def test_field_goes_through_undisturbed_by_a_shut_well(self):
        out = self.solve("--boundary", "all=field", "--field", "100,0.1,0,0", "--well", "W=shut")
        self.assertEqual(out["wells"][0]["rate_m3_per_day"], 0)
        self.assertIsNone(out["wells"][0]["pressure_bar"])
        # From 100 bar at x = 0 to 130 bar at x = 300 m; the first centre stands at 10 m.
        self.assertAlmostEqual(out["pressure_bar"]["min"], 101, places=1)
        self.assertAlmostEqual(out["pressure_bar"]["max"], 129, places=1)

    def test_table_holds_cells(self):
        self.write("hold.csv", "cell,pressure_psi\n0,2900.75476\n5,2900.75476\n")  # 200 bar
        out = self.solve("--hold", "hold.csv", "--well", "W=100bar")
        self.assertEqual(out["held_cells"]["cells"], 2)
        self.assertAlmostEqual(out["pressure_bar"]["max"], 200, places=5)
        self.write("hold.csv", "cell,pressure\n0,200\n99999999,200\n")
        self.fail_with(1, "solve", "mesh.h5", "--hold", "hold.csv", mention=["99999999"])
        self.write("hold.csv", "cell,pressure\n0,two\n")
        self.fail_with(1, "solve", "mesh.h5", "--hold", "hold.csv", mention=["hold.csv:2", "two"])

    def test_gravity_alone_moves_nothing(self):
        out = self.solve("--boundary", "all=200bar", "--gravity", "1000", "--well", "W=shut")
        # Hydrostatic over the 70 m between the first and the last centre: 6.86 bar.
        self.assertAlmostEqual(out["pressure_bar"]["max"] - out["pressure_bar"]["min"], 70 * 1000 * 9.80665e-5, places=6)
        self.assertAlmostEqual(out["datum"], 1040, places=6)

    def test_outputs(self):
        text = self.succeed("solve", "mesh.h5", "--boundary", "all=200bar", "-o", "flow.h5", "--vtu", "flow.vtu")
        self.assertIn("flow.h5", text)
        self.assertIn(b'Name="pressure"', (self.folder / "flow.vtu").read_bytes())
        self.succeed("check", "flow.h5")
        self.succeed("convert", "flow.h5", "copy.h5")
        self.assertEqual((self.folder / "flow.h5").read_bytes(), (self.folder / "copy.h5").read_bytes())
        self.fail_with(1, "solve", "mesh.h5", "-o", "flow.h5", mention=["flow.h5", "--overwrite"])
        self.fail_with(2, "solve", "mesh.h5", "-o", "mesh.h5", "--overwrite", mention=["mesh.h5"])

    def test_says_when_nothing_can_flow(self):
        self.assertIn("nothing flows", self.succeed("solve", "mesh.h5"))
        self.fail_with(1, "solve", "mesh.h5", "--well", "W=500m3/d", mention=["well W", "holds a pressure", "cells"])

    def test_refusals(self):
        for arguments, words in ((["--well", "X=1bar"], ["X", "W"]), (["--well", "W=3furlong"], ["3furlong", "bar"]),
                                 (["--well", "W"], ["NAME=VALUE"]), (["--boundary", "north=3bar"], ["north", "i-"]),
                                 (["--boundary", "all=3m3/d"], ["3m3/d"]), (["--boundary", "all=field"], ["--field"]),
                                 (["--field", "1,0,0,0"], ["--boundary"]), (["--field", "1,2", "--boundary", "all=field"], ["1,2"]),
                                 (["--viscosity", "0"], ["--viscosity"]), (["--gravity", "heavy"], ["heavy"]),
                                 (["--datum", "3"], ["--gravity"]), (["--solver", "magic"], ["magic"]),
                                 (["--expansion", "3bar"], ["3bar"])):
            with self.subTest(arguments=arguments):
                self.fail_with(2, "solve", "mesh.h5", *arguments, mention=words)
        self.fail_with(1, "solve", "nowhere.h5", mention=["nowhere.h5"])


class ConsistentFluxes(Case):
    """Multi-point fluxes: made by build, used by solve, refused where a mesh does not have them."""

    def test_a_box_has_the_rates_of_two_points(self):
        self.succeed("build", "box.GRDECL", "-o", "mesh.h5", "--fluxes", "consistent", "--quiet")
        asked = ("solve", "mesh.h5", "--json", "--boundary", "i-=210bar", "--boundary", "i+=200bar")
        two_point, consistent = (json.loads(self.succeed(*asked, *more)) for more in ((), ("--fluxes", "consistent")))
        self.assertEqual([two_point["fluxes"], consistent["fluxes"]], ["two-point", "consistent"])
        self.assertGreater(two_point["balance"]["in_m3_per_day"], 0.0)
        self.assertAlmostEqual(consistent["balance"]["in_m3_per_day"] / two_point["balance"]["in_m3_per_day"], 1.0, places=9)

    def test_a_mesh_without_them_is_refused(self):
        self.succeed("build", "box.GRDECL", "-o", "mesh.h5", "--quiet")
        self.fail_with(1, "solve", "mesh.h5", "--fluxes", "consistent", mention=["--fluxes consistent", "build"])
        self.fail_with(2, "solve", "mesh.h5", "--fluxes", "exact", mention=["--fluxes", "two-point", "exact"])
        self.fail_with(2, "build", "box.GRDECL", "-o", "other.h5", "--fluxes", "exact", mention=["two-point", "exact"])


class AdaptedFluxes(Case):
    """Transmissibilities fitted to multi-point flow: in the mesh file and in every other output."""

    def test_a_box_keeps_its_rate(self):
        rates = []
        for fluxes in ("two-point", "adapted"):
            done = json.loads(self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=W", "-o", "mesh.h5", "--overwrite",
                                           "--fluxes", fluxes, "--json"))
            solved = json.loads(self.succeed("solve", "mesh.h5", "--json", "--boundary", "i-,i+=200bar", "--well", "W=190bar"))
            rates.append(solved["wells"][0]["rate_m3_per_day"])
        self.assertEqual((done["adaptation"]["fields"], done["adaptation"]["not_solved"]), (4, 0))  # a well, three linear ones
        self.assertAlmostEqual(rates[1] / rates[0], 1.0, places=2)
        self.fail_with(1, "solve", "mesh.h5", "--fluxes", "consistent", mention=["--fluxes consistent"])

    def test_the_summary_says_what_changed(self):
        said = self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=W", "-o", "mesh.h5", "--fluxes", "adapted")
        self.assertRegex(said, r"adapted +[\d,]+ of [\d,]+ transmissibilities")
        said = self.succeed("build", "box.GRDECL", "-o", "host.h5", "--fluxes", "adapted")
        self.assertIn("nothing: no well flows", said)


class Map(Case):
    def setUp(self):
        super().setUp()
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9,name=W", "-o", "mesh.h5")
        cells = NX * NY * NZ
        self.numbers = [round(1.0 + (i * 7919 % 1000) / 1000, 3) for i in range(cells)]
        self.write("values.GRDECL", f"SPECGRID\n {NX} {NY} {NZ} 1 F /\nODD\n 1 2 /\nMASS\n{values(self.numbers)} /\nSOIL -- a comment\n{cells}*0.7 /\n"
                   f"FIPNUM\n{NX * NY}*1 {cells - NX * NY}*2 /\n")

    def read(self, name, keyword):
        words = (self.folder / name).read_text().split(f"\n{keyword}\n", 1)[1].split()
        out = []
        for word in words[: words.index("/")]:
            count, _, value = word.rpartition("*")
            out += [float(value)] * int(count or 1)
        return out

    def test_forward_and_back_keep_the_sum(self):
        report = json.loads(self.succeed("map", "mesh.h5", "--forward", "values.GRDECL", "--sum", "mass", "-o", "out.h5", "--json"))
        rules = {c["keyword"]: c for c in report["carried"]}
        self.assertEqual(rules["MASS"]["rule"], "sum")
        self.assertAlmostEqual(rules["MASS"]["to"]["sum"] / sum(self.numbers), 1, places=12)
        self.assertAlmostEqual(rules["SOIL"]["to"]["min"], 0.7, places=12)
        self.assertEqual((rules["FIPNUM"]["to"]["min"], rules["FIPNUM"]["to"]["max"]), (1, 2))
        self.assertTrue(any("ODD" in note for note in report["notes"]))
        self.succeed("check", "out.h5")
        self.succeed("map", "out.h5", "--back", "MASS", "--sum", "MASS", "-o", "mass.GRDECL")
        self.assertAlmostEqual(sum(self.read("mass.GRDECL", "MASS")) / sum(self.numbers), 1, places=12)
        self.succeed("map", "out.h5", "--back", "cells/properties/FIPNUM", "-o", "fip.GRDECL")
        self.assertEqual(self.read("fip.GRDECL", "FIPNUM"), [1.0] * (NX * NY) + [2.0] * (NX * NY * (NZ - 1)))

    def test_only_the_keywords_asked_for(self):
        report = json.loads(self.succeed("map", "mesh.h5", "--forward", "values.GRDECL", "--keyword", "SOIL", "-o", "out.h5", "--json",
                                         "--weight", "pore-volume", "--vtu", "out.vtu"))
        self.assertEqual([c["keyword"] for c in report["carried"]], ["SOIL"])
        self.assertIn(b'Name="SOIL"', (self.folder / "out.vtu").read_bytes())
        self.fail_with(2, "map", "mesh.h5", "--forward", "values.GRDECL", "--keyword", "SGAS", "-o", "x.h5", mention=["SGAS", "SOIL"])

    def test_pressure_back(self):
        self.succeed("solve", "mesh.h5", "--boundary", "all=200bar", "-o", "flow.h5")
        self.succeed("map", "flow.h5", "--back", "flow/pressure", "-o", "p.GRDECL")
        found = self.read("p.GRDECL", "PRESSURE")
        self.assertEqual(len(found), NX * NY * NZ)
        self.assertTrue(100 < min(found) < max(found) < 200)
        built = self.succeed("build", "box.GRDECL", "--grid-include", "p.GRDECL", "-o", "with.h5")  # it is read again
        self.assertIn("with.h5", built)
        self.fail_with(1, "map", "mesh.h5", "--back", "flow/pressure", "-o", "q.GRDECL", mention=["flow/pressure", "wellknit solve"])

    def test_table_back(self):
        self.write("table.csv", "cell,kind\n" + "".join(f"{c},3.5\n" for c in range(40)))
        self.succeed("map", "mesh.h5", "--back", "table.csv", "--keyword", "MINE", "--default", "-1", "-o", "mine.GRDECL")
        self.assertEqual(set(self.read("mine.GRDECL", "MINE")), {3.5, -1.0})
        self.write("short.txt", "1.0\n2.0\n")
        self.fail_with(1, "map", "mesh.h5", "--back", "short.txt", "-o", "x.GRDECL", mention=["short.txt", "2"])

    def test_refusals(self):
        self.fail_with(2, "map", "mesh.h5", "-o", "x.h5", mention=["--forward", "--back"])
        self.fail_with(2, "map", "mesh.h5", "--back", "cells/porosity", "-o", "mesh.h5", mention=["mesh.h5"])
        self.fail_with(2, "map", "mesh.h5", "--back", "cells/porosity", "--keyword", "TOOLONGNAME", "-o", "x.GRDECL", mention=["TOOLONGNAME"])
        self.fail_with(2, "map", "mesh.h5", "--forward", "values.GRDECL", "--weight", "luck", "-o", "x.h5", mention=["luck"])
        self.write("few.GRDECL", "PORO\n 1 2 3 /\n")
        self.fail_with(1, "map", "mesh.h5", "--forward", "few.GRDECL", "-o", "x.h5", mention=["few.GRDECL", "PORO", "1800"])
        self.write("none.GRDECL", "ODD\n 1 2 3 /\n")
        self.fail_with(1, "map", "mesh.h5", "--forward", "none.GRDECL", "-o", "x.h5", mention=["none.GRDECL"])


class Commands(Case):
    def test_help_and_version(self):
        for command in ([], ["build"], ["check"], ["info"], ["convert"], ["report"], ["solve"], ["map"], ["formats"], ["completion"], ["manual"]):
            with self.subTest(command=command):
                self.assertIn("--help", self.succeed(*command, "--help"))
                self.assertEqual(self.succeed(*command, "--version").split()[0], "wellknit")

    def test_help_names_every_command(self):
        text = self.succeed("--help")
        for command in ("build", "check", "info", "convert", "report", "solve", "map", "formats", "completion", "manual"):
            self.assertIn(command, text)

    def test_formats(self):
        text = self.succeed("formats")
        for name in ("hdf5", "vtu", "deck"):
            self.assertIn(name, text)


class Documents(Case):
    def test_readme_has_the_table_of_formats(self):
        self.assertIn(self.succeed("formats", "--markdown"), (PROJECT / "README.md").read_text())

    def test_every_option_is_in_its_commands_page(self):
        for command in ("build", "check", "report", "info", "convert", "solve", "map", "compare", "formats"):
            page = (PROJECT / "docs" / "commands" / f"{command}.md").read_text()
            options = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", self.succeed(command, "--help"))) - {"--help", "--version"}
            for option in sorted(options):
                with self.subTest(command=command):
                    self.assertIn(option, page)

    def test_every_format_has_its_page(self):
        for line in self.succeed("formats", "--markdown").splitlines()[2:]:
            if "](" not in line:
                continue
            page = line.split("](")[1].split(")")[0]
            self.assertTrue((PROJECT / page).is_file(), page)

    def test_every_option_is_explained(self):
        for command in ("build", "check", "info", "convert", "report", "solve", "map", "formats", "completion"):
            page = (PROJECT / "docs" / "commands" / f"{command}.md").read_text()
            for word in self.succeed(command, "--help").split():
                option = word.strip("`").split("=")[0].split(",")[0]
                if option.startswith("--") and option not in ("--help", "--version"):  # those of every command
                    self.assertIn(option, page, command)


if __name__ == "__main__":
    unittest.main()
