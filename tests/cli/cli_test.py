# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives the program as a user does: exit codes, one line on stderr, no output left behind.

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR).
"""
import json
import os
import pathlib
import subprocess
import tempfile
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
                              ("--growth", "0"), ("--segments", "0"), ("--mode", "spiral"), ("--threads", "0"), ("--refine", "2"),
                              ("--fault-policy", "heal"), ("--metric", "permeability"), ("--mapping", "best"),
                              ("--write", "vtu"), ("--write", "png=a.png"), ("--deck-wells", "")):
            with self.subTest(option=option, value=value):
                self.fail_to_build(2, "box.GRDECL", "--well", "well.csv", option, value, mention=[option if option != "--write" else value.split("=")[0]])

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
        self.fail_with(2, "solve", "out.h5", mention=["solve"])

    def test_deck_wells_of_a_grid_without_wells(self):
        self.fail_to_build(1, "box.GRDECL", "--deck-wells", "all", mention=["--deck-wells"])

    def test_a_full_disk_leaves_nothing(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "formats"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))


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
    def test_mesh_file_to_every_format(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", "--write", "vtu=direct.vtu")
        self.assertIn("vtu", self.succeed("convert", "mesh.h5", "out.vtu"))
        self.assertEqual((self.folder / "out.vtu").read_bytes(), (self.folder / "direct.vtu").read_bytes())
        self.succeed("convert", "mesh.h5", "again.h5", "--quiet")
        self.assertEqual((self.folder / "again.h5").read_bytes(), (self.folder / "mesh.h5").read_bytes())
        self.succeed("convert", "mesh.h5", "deck.txt", "--to", "deck")

    def test_mesh_file_to_a_folder(self):
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=9", "-o", "mesh.h5", "--write", "openfoam=direct")
        self.succeed("convert", "mesh.h5", "by_extension.openfoam")
        self.succeed("convert", "mesh.h5", "by_name", "--to", "openfoam")
        content = lambda name: {str(p.relative_to(self.folder / name)): p.read_bytes() for p in (self.folder / name).rglob("*") if p.is_file()}
        self.assertEqual(content("by_extension.openfoam"), content("direct"))
        self.assertEqual(content("by_name"), content("direct"))
        self.assertIn("bore_well", (self.folder / "direct/constant/polyMesh/boundary").read_text())

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


class Commands(Case):
    def test_help_and_version(self):
        for command in ([], ["build"], ["check"], ["info"], ["convert"], ["formats"]):
            with self.subTest(command=command):
                self.assertIn("--help", self.succeed(*command, "--help"))
                self.assertEqual(self.succeed(*command, "--version").split()[0], "wellknit")

    def test_help_names_every_command(self):
        text = self.succeed("--help")
        for command in ("build", "check", "info", "convert", "formats"):
            self.assertIn(command, text)

    def test_formats(self):
        text = self.succeed("formats")
        for name in ("hdf5", "vtu", "deck"):
            self.assertIn(name, text)


class Documents(Case):
    def test_readme_has_the_table_of_formats(self):
        self.assertIn(self.succeed("formats", "--markdown"), (PROJECT / "README.md").read_text())

    def test_every_format_has_its_page(self):
        for line in self.succeed("formats", "--markdown").splitlines()[2:]:
            if "](" not in line:
                continue
            page = line.split("](")[1].split(")")[0]
            self.assertTrue((PROJECT / page).is_file(), page)

    def test_every_option_is_explained(self):
        page = (PROJECT / "docs" / "commands" / "build.md").read_text()
        for word in self.succeed("build", "--help").split():
            if word.startswith("--"):
                self.assertIn(word.split("=")[0].split(",")[0], page)


if __name__ == "__main__":
    unittest.main()
