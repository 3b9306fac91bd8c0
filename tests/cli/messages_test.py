# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages that no other test asks for, one row each: what is wrong, and the words that the program says then.

The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR). tools/list_messages.py tells which are left.
"""
import resource
import signal
import struct
import subprocess
import unittest

import whole_deck
from cli_test import DZ, NX, NY, NZ, PROGRAM, PROJECT, TOP, Case, coord, csv, grdecl, values

CELLS = 15 * 15 * 8


class Options(Case):
    def test_options_of_build(self):
        for words, arguments in {
            "expected true or false, found 'maybe'": ["flag.toml"],
            "expected one of off, on, edges, vertices, found 'often'": ["--optimise", "often"],
            "expected FILE[,key=value...], found ''": ["--well", ""],
            "expected key=value, found 'sectors'": ["--well", "well.csv,name=A,sectors"],
            "expected a name without spaces, quotes and slashes, found 'a/b'": ["--well", "well.csv,name=a/b"],
            "csv: unknown key 'x'; this format has none": ["--well", "well.csv", "--write", "csv=t,x=1"],
            "expected a text, a number, true or false": ["date.toml"],
            "expected a table: [[well]] with file = and keys": ["names.toml"],
            "expected file = \"…\" with the well's trajectory": ["nofile.toml"],
            "expected [[well]] tables": ["onewell.toml"],
            "expected a table: [write] with FORMAT = \"PATH\"": ["write.toml"],
        }.items():
            self.write("flag.toml", "strict = \"maybe\"\n")
            self.write("date.toml", "radius = 2020-01-01\n")
            self.write("names.toml", "well = [\"well.csv\"]\n")
            self.write("nofile.toml", "[[well]]\nname = \"A\"\n")
            self.write("onewell.toml", "well = \"well.csv\"\n")
            self.write("write.toml", "write = \"out.vtu\"\n")
            with self.subTest(words):
                files = [] if arguments[0].endswith(".toml") else ["box.GRDECL"]
                self.fail_with(2, "build", *files, *arguments, "-o", "out.h5", mention=[words])

    def test_wells_that_are_not_there(self):
        self.write("two.csv", "WELL,MD,X,Y,TVD\nA,0,150,150,990\nA,100,150,150,1090\nB,0,50,50,990\nB,100,50,50,1090\n")
        self.fail_to_build(1, "box.GRDECL", "--well", "two.csv,name=C", mention=["two.csv: no well of the name C in it"])
        self.write("CASE.DATA", deck(schedule="WELSPECS\nP G 5 5 1* OIL /\n/\nCOMPDAT\nP 2* 1 8 OPEN /\n/\n"))
        self.fail_to_build(1, "CASE.DATA", "--deck-wells", "Q", mention=["--deck-wells: no well Q; its wells are P"])

    def test_a_path_that_only_cuts_a_corner(self):
        # 8,500 m long, of which less than 2 m lie in the grid: none or one of 2,000 samples.
        self.write("far.csv", csv((-2999.0, 3000.0, 1040.0), (3000.0, -2999.0, 1040.0)))
        self.assertIn("its path inside the grid is shorter than a two-thousandth of its length",
                      " ".join(self.succeed("build", "box.GRDECL", "--well", "far.csv,mode=layered,radius=5", "-o", "out.h5").split()))

    def test_permeability_metric(self):
        self.write("dense.GRDECL", grdecl(PERMZ=f"{15 * 15 * 8}*0"))
        self.fail_to_build(1, "dense.GRDECL", "--well", "well.csv", "--metric", "permeability",
                           mention=["no cell on the wells' paths has permeability along all of its axes"])
        self.write("bare.GRDECL", grdecl(PERMZ=None))
        self.fail_to_build(1, "bare.GRDECL", "--well", "well.csv", "--metric", "permeability", mention=["--metric permeability needs PERMZ"])

    def test_strict(self):
        self.write("edge.csv", csv((0.3, 143.0, 990.0), (0.3, 143.0, 1090.0)))
        self.fail_to_build(1, "box.GRDECL", "--well", "edge.csv", "--strict", mention=["--strict: not meshed: edge; edge: "])

    def test_convert(self):
        self.fail_with(2, "convert", "box.GRDECL", "out.vtu", "--source", "box.GRDECL",
                       mention=["--source belongs to a mesh file; box.GRDECL is a grid itself"])

    def test_keys_of_a_whole_deck(self):
        for name, text in whole_deck.files().items():
            (self.folder / name).parent.mkdir(exist_ok=True)
            self.write(name, text)
        self.fail_with(2, "build", "CASE.DATA", "--write", "deck=OUT.DATA,layout=nested",
                       mention=["a converted whole deck has layout=row, order=mesh and its own fluids; leave the keys out, or convert the mesh file"])

    def test_memory(self):
        """Two hundred million porosities take 1.6 GB where there is 1 GiB."""
        def run(*arguments):
            return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30)))
        if run("--version").returncode != 0:
            self.skipTest("the program alone needs more")
        self.write("large.GRDECL", "SPECGRID\n1000 1000 200 1 F /\nPORO\n200000000*0.2 /\n")
        result = run("info", "large.GRDECL")
        self.assertEqual((result.returncode, result.stderr), (1, "wellknit: there is not enough memory for this input\n"))

    def test_a_device_as_input(self):
        self.fail_to_build(1, "/dev/null", mention=["expected a regular file, found a device or a pipe; save its content as a file first"])


class Flow(Case):
    def setUp(self):
        super().setUp()
        self.succeed("build", "box.GRDECL", "--well", "well.csv", "--radius", "15", "-o", "mesh.h5")

    def test_solve(self):
        self.write("flat.csv", "1\n2\n")
        self.fail_with(1, "solve", "mesh.h5", "--hold", "flat.csv",
                       mention=["expected a header `cell,pressure_bar` or `face,pressure_bar`, found none"])

    def test_isolated_parts_and_closed_cells(self):
        # No flow along k: each layer is a part of its own; the well reaches all of them but one.
        self.write("layers.GRDECL", grdecl(PERMZ=f"{CELLS}*0", PERMX=f"225*0 {CELLS - 225}*100", PERMY=f"225*0 {CELLS - 225}*100"))
        self.succeed("build", "layers.GRDECL", "--well", "well.csv,radius=15", "-o", "layers.h5")
        out = self.succeed("solve", "layers.h5", "--boundary", "i-=200bar", "--well", "well=100bar")
        for words in ("connections have no transmissibility", "boundary faces of the held sides conduct nothing",
                      "parts without a held pressure have none (NaN) and no flow: "):
            self.assertIn(words, out)

    def test_map(self):
        self.write("face.csv", "face,X\n1,2\n")
        self.write("far.csv", "cell,X\n1000000,1\n")
        self.write("twice.csv", "cell,X\n1,1\n1,2\n")
        for words, code, arguments in (
            ("expected values of cells, found values of faces; give a header `cell,NAME`", 1, ["--back", "face.csv"]),
            ("found cell 1000000", 1, ["--back", "far.csv"]),
            ("expected each cell once, found cell 1 twice", 1, ["--back", "twice.csv"]),
            ("--keyword: with --back it names the one result", 2, ["--back", "cells/porosity", "--keyword", "A", "--keyword", "B"]),
            ("--vtu: the source grid is not written as VTU; leave it out with --back", 2, ["--back", "cells/porosity", "--vtu", "m.vtu"]),
        ):
            with self.subTest(words):
                self.fail_with(code, "map", "mesh.h5", *arguments, "-o", "out.inc", mention=[words])

    def test_map_of_a_grid_with_inactive_cells(self):
        self.write("holes.GRDECL", grdecl(ACTNUM=f"20*0 {CELLS - 20}*1"))
        self.succeed("build", "holes.GRDECL", "-o", "holes.h5")
        self.assertIn("20 source cells are not in the mesh and have ", self.succeed("map", "holes.h5", "--back", "cells/porosity", "-o", "p.inc"))
        self.write("values.GRDECL", f"SWAT\n{CELLS}*0.3 /\n")
        self.succeed("map", "holes.h5", "--forward", "values.GRDECL", "-o", "first.h5")
        self.assertIn("SWAT of the mesh file is replaced",
                      self.succeed("map", "first.h5", "--forward", "values.GRDECL", "-o", "more.h5"))

    def test_sides(self):
        self.write("west.GRDECL", grdecl(ACTNUM="0 14*1 " * (15 * 8)))
        self.succeed("build", "west.GRDECL", "--well", "well.csv,radius=15", "-o", "west.h5")
        self.fail_with(1, "solve", "west.h5", "--boundary", "i-=200bar", "--well", "well=100bar",
                       mention=["--boundary i-: the mesh has no face on that side"])


def deck(grid="", edit="", schedule="", runspec="METRIC\n", zcorn=True):
    body = grdecl()
    return f"RUNSPEC\n{runspec}OIL\nWATER\nDIMENS\n15 15 8 /\nGRID\n{body}{grid}\nEDIT\n{edit}\nPROPS\nSOLUTION\nSCHEDULE\n{schedule}\n"


HEAD = "WELSPECS\nP G 8 8 1* OIL /\n/\n"


class Decks(Case):
    """Notes and refusals of decks: `wellknit build CASE.DATA` with its wells."""

    def check(self, words, text, *arguments, fails=False):
        with self.subTest(words):
            self.write("CASE.DATA", text)
            arguments = ["build", "CASE.DATA", "-o", "out.h5", "--overwrite", *arguments]
            if fails:
                self.fail_with(1, *arguments, mention=[words])
            else:
                self.assertIn(words, " ".join(self.succeed(*arguments).split()))

    def test_notes(self):
        for words, sections in {
            "MULTIPLY: the limits left out are those of the record or BOX before; OPM Flow takes the whole grid along them":
                {"grid": "BOX\n1 3 1 3 1 2 /\nMULTIPLY\nPORO 0.5 2 2 /\n/\nENDBOX\n"},
            "MULTIREG on TRANX: an array that the simulator computes; skipped":
                {"edit": f"FLUXNUM\n{CELLS}*1 /\nMULTIREG\nTRANX 0.5 1 F /\n/\n"},
            "FAULTS 'CONTINENT' and 'CONTINENTAL' are one fault: their first 8 characters are the same, and only these count":
                {"grid": "FAULTS\n'CONTINENT' 3 3 1 15 1 8 X /\n'CONTINENTAL' 6 6 1 15 1 8 X /\n/\n"},
            "NNC: items 8 and on (tables, faces, diffusivity) are not carried":
                {"grid": "NNC\n1 1 1 9 9 8 0.5 3 /\n/\n"},
            "GDORIENT says that Z points UP; ZCORN is read as depths, positive down":
                {"grid": "GDORIENT\nINC INC INC UP RIGHT /\n"},
        }.items():
            self.check(words, deck(**sections))

    def test_refusals(self):
        for words, sections in {
            "expected the name of a fault as item 1, found none": {"grid": "FAULTS\nF 3 3 1 15 1 8 X /\n/\nMULTFLT\n1* 0.5 /\n/\n"},
            "PEBI: expected a single corner-point grid in text, found an unstructured grid; export a corner-point grid (COORD and ZCORN)":
                {"grid": "PEBI\nYES /\n"},
            "the unit system PVT-M; convert the deck to METRIC, FIELD or LAB": {"runspec": "PVT-M\n"},
            "corner depths changed after ZCORN; let the simulator or the pre-processor write the grid as it is after this keyword":
                {"grid": "ADDZCORN\n1 1 15 1 15 1 8 /\n/\n"},
            "expected finite values, found one that overflows": {"grid": f"SWATINIT\n{CELLS}*1E9 /\nMULTIPLY\nSWATINIT 1E300 /\n/\n"},
            "expected a name and a path, found less": {"runspec": "METRIC\nPATHS\nONE /\n/\n"},
            "MULTREGP refers to the regions of ": {"grid": "MULTREGP\n1 0.5 F /\n/\n"},
            "MULTREGT refers to the regions of ": {"grid": "MULTREGT\n1 2 0.5 XYZ ALL F /\n/\n"},
            "EDIT: COPY of TRANX to TRANY is not handled: give the values instead": {"edit": "COPY\nTRANX TRANY /\n/\n"},
        }.items():
            self.check(words, deck(**sections), fails=True)

    def test_wells(self):
        track = "WELTRAJ\nP 1* 155 145 1000 0 /\nP 1* 155 145 1040 40 /\nP 1* 155 145 1080 80 /\n/\n"
        for words, schedule in {
            "1 repeated stations of WELTRAJ dropped":
                "WELTRAJ\nP 1* 155 145 1000 0 /\nP 1* 155 145 1000 0 /\nP 1* 155 145 1080 80 /\n/\nCOMPTRAJ\nP 1* 10 70 MD 1* OPEN /\n/\n",
            "connection factors and Kh of COMPTRAJ are kept but not used: they follow from the mesh":
                track + "COMPTRAJ\nP 1* 10 70 MD 1* OPEN 1* 15.5 0.2 /\n/\n",
            "the skin of COMPTRAJ differs between perforations and is not used":
                track + "COMPTRAJ\nP 1* 10 30 MD 1* OPEN 1* 1* 0.2 1* 1 /\nP 1* 40 70 MD 1* OPEN 1* 1* 0.2 1* 2 /\n/\n",
            "is left out: WELTRAJ gives fewer than two different stations":
                "WELSPECS\nQ G 3 3 1* OIL /\n/\nCOMPDAT\nQ 3 3 1 4 OPEN /\n/\nWELTRAJ\nP 1* 155 145 1000 0 /\n/\nCOMPTRAJ\nP 1* 10 70 MD 1* OPEN /\n/\n",
            "COMPTRAJ opens nothing of it": track + "COMPTRAJ\nP 1* 10 70 MD 1* SHUT /\n/\n",
            "no COMPTRAJ: it is open where its path crosses the boxes of its COMPDAT cells":
                track + "COMPDAT\nP 8 8 1 4 OPEN /\n/\n",
            "neither COMPTRAJ nor COMPDAT: it is taken as open over its whole length": track,
            "branch 1: COMPSEGS does not give all measured depths: arc length is taken":
                "COMPDAT\nP 8 8 1 4 OPEN /\n/\nWELSEGS\nP 1000 0 1* INC /\n2 2 1 1 10 10 0.2 1E-4 /\n/\nCOMPSEGS\nP /\n8 8 1 1 /\n8 8 2 1 /\n8 8 3 1 /\n/\n",
        }.items():
            # A well that opens nothing is a reason, not a failure.
            self.check(words, deck(schedule=HEAD + schedule), "--deck-wells", "all")

    def test_segments(self):
        cells = "COMPDAT\nP 8 8 1 4 OPEN /\n/\n"
        for words, schedule in {
            "WELSEGS: expected the name of a well, found an empty record": "WELSEGS\n/\n/\n",
            "COMPSEGS: expected the name of a well, found an empty record": "COMPSEGS\n/\n/\n",
        }.items():
            self.check(words, deck(schedule=HEAD + cells + schedule), "--deck-wells", "all", fails=True)

    def test_segments_without_length(self):
        # Layer 2 has no thickness, so neither has a branch that is completed there alone.
        depths = [TOP + DZ * (level - (level > 1)) for level in ((k + 1) // 2 for k in range(2 * NZ)) for _ in range(4 * NX * NY)]
        text = deck(schedule=HEAD + "COMPDAT\nP 8 8 1 4 OPEN /\n/\nWELSEGS\nP 1000 0 1* INC /\n2 2 1 1 10 10 0.2 1E-4 /\n/\nCOMPSEGS\nP /\n8 8 2 1 /\n/\n")
        text = text.replace(grdecl(), grdecl(ZCORN=values(depths)))
        self.check("well P: branch 1 has no length and is left out", text, "--deck-wells", "all")
        self.check("well P: no path comes of its segments; it is taken through its completed cells", text, "--deck-wells", "all")

    def test_a_bore_wider_than_its_cells_allow(self):
        # By the grid's side, where no tube has room; the equivalent radius of a cell of 20 x 20 m is 4 m.
        self.write("edge.csv", csv((0.3, 143.0, 990.0), (0.3, 143.0, 1090.0)))
        self.assertIn("it has no connections: the bore of radius 5 m with skin 0 is too wide for cell (1, 8, 1)",
                      " ".join(self.succeed("build", "box.GRDECL", "--well", "edge.csv,bore=5,radius=10", "-o", "out.h5").split()))

    def test_without_porosity(self):
        self.write("CASE.GRDECL", grdecl(PORO=None, PERMX=None, PERMY=None, PERMZ=None))
        out = " ".join(self.succeed("build", "CASE.GRDECL", "--well", "well.csv,radius=15", "-o", "out.h5").split())
        for words in ("no PORO: pore volumes are 0; give it with the grid", "transmissibilities and well indices along it are 0"):
            self.assertIn(words, out)

    def test_a_well_in_rock_without_permeability(self):
        zero = f"{CELLS}*0"
        self.write("CASE.GRDECL", grdecl(PERMX=zero, PERMY=zero, PERMZ=zero))
        self.assertIn("no cell with permeability is open to it",
                      " ".join(self.succeed("build", "CASE.GRDECL", "--well", "well.csv,radius=15", "-o", "out.h5").split()))

    def test_a_skin_wider_than_the_mesh(self):
        self.fail_to_build(1, "box.GRDECL", "--well", "well.csv,radius=5,skin=-6",
                           mention=["is an effective bore radius of ", "beyond the drainage radius of 5 m: choose a larger drainage radius or check the skin"])

    def test_edits_inside_the_mesh(self):
        text = deck(edit="MULTIPLY\nTRANX 0.5 1 15 1 15 1 8 /\n/\nEDITNNCR\n1 1 1 9 9 8 0.5 /\n/\n")
        self.check("of EDIT is not applied inside the wells' meshes", text, "--well", "well.csv,radius=15")
        self.check("1 records of EDITNNCR name cells that the grid does not connect", text)
        text = deck(edit="EQUALS\nTRANX 0.5 1 15 1 15 1 8 /\n/\n")
        self.check("keep their computed transmissibility", text, "--well", "well.csv,radius=15")

    def test_layers_numbered_upwards(self):
        upwards = [1000.0 + 10.0 * (8 - (k + 1) // 2) for k in range(16) for _ in range(4 * 225)]
        self.write("CASE.GRDECL", grdecl(ZCORN=" ".join(f"{z:g}" for z in upwards)))
        self.assertIn("The layers are numbered upwards.", self.succeed("build", "CASE.GRDECL", "-o", "out.h5"))


class Conversion(unittest.TestCase):
    """Refusals and notes of `--write deck` for whole decks."""

    def setUp(self):
        import deck_test
        self.deck = deck_test.Deck()
        self.deck.setUp()
        self.addCleanup(self.deck.doCleanups)

    def test_refused_keywords(self):
        for words, old, new in (
            ("diffusion or dispersion: a connection list carries none; take the keyword out", "OIL\nWATER", "OIL\nWATER\nDIFFUSE"),
            ("a compositional model; convert a black-oil deck", "OIL\nWATER", "OIL\nWATER\nCOMPS\n 3 /"),
            ("rock mechanics", "OIL\nWATER", "OIL\nWATER\nMECH"),
            ("connections beyond the faces of cells (nine-point, multi-point); take the keyword out for the two-point scheme",
             "OIL\nWATER", "OIL\nWATER\nMPFA\n/"),
            ("a flux boundary by cells of the old grid; convert the full-field deck", "OIL\nWATER", "OIL\nWATER\nUSEFLUX"),
            ("a coarsened grid", "NTG\n", "COARSEN\n 1 2 1 2 1 1 1 1 1 /\n/\nNTG\n"),
            ("boundary conditions on faces of the old grid", "NTG\n", "BC\n 1 1 1 1 1 1 X- FREE /\n/\nNTG\n"),
            ("threshold pressures by fault: faults have no names in a list of connections; give them by region with THPRES",
             "SOLUTION\n", "SOLUTION\nTHPRESFT\n F 1 /\n/\n"),
            ("an input by cells of the old grid that is not converted", "NTG\n", "JFUNCR\n/\nNTG\n"),
            ("expected a name and a path, found less", "OIL\nWATER", "OIL\nWATER\nPATHS\n ONE /\n/"),
            ("found more items than any record has; add the '/'", " 9 9 4 / cells", " 9 9 4 " + "1 " * 11000 + "/"),
            ("before '*', found ", " 9 9 4 / cells", " 9 9 4 99999999* /"),
            ("expected the number of an aquifer as item 1 and a face (I-, I+, J- …) as item 8", "J- / the south", "Q / the south"),
            ("the cell is outside the grid", "BPR\n 1 1 1 /", "BPR\n 99 1 1 /"),
            ("expected I, J and K of a cell, found less", "BPR\n 1 1 1 /", "BPR\n 1 1 /"),
        ):
            with self.subTest(words):
                self.deck.change(old, new)
                self.deck.refuse(words)

    def test_binary_include(self):
        (self.deck.folder / "regions.inc").write_bytes(b"\x00\x01\x02")
        self.deck.refuse("expected a text file, found 'regions.inc': binary data")

    def test_schedule(self):
        self.deck.change(" 8 2 1 1 1 7 /", " 8 2 1 1 1 7 1* 3 /")
        self.deck.refuse("expected one cell a record, found a range of cells (item 8); write a record for each cell of the range")

    def test_a_skin_that_no_cell_at_the_bore_allows(self):
        self.deck.change(" P1 2* 1 2 OPEN 2* 0.2 /", " P1 2* 1 2 OPEN 2* 0.2 1* -20 /")
        result = self.deck.run_program("--deck-wells", "all", "--write", "deck=OUT.DATA")
        self.assertEqual(result.returncode, 1)
        self.assertIn("COMPDAT: expected a skin that leaves a resistance to flow as item 11, found -20; the cells at the bore are too small for a skin "
                      "this low: use a larger bore radius or fewer rings", result.stderr)

    def test_a_cell_of_a_well_with_a_trajectory(self):
        # P1 by its path alone, and a WELOPEN of one of its cells later.
        text = self.deck.source["CASE.DATA"].replace(" P1 2* 1 2 OPEN 2* 0.2 / upper part\n", "").replace("COMPDAT\n P1 5 5 3 4 OPEN 2* 0.2 1* 2 /\n/\n", "")
        track = "WELTRAJ\n P1 1* 180 180 2000 0 /\n P1 1* 180 180 2030 30 /\n/\nCOMPTRAJ\n P1 1* 1 20 /\n/\n"
        (self.deck.folder / "CASE.DATA").write_text(text.replace("COMPDAT\n-- the", track + "COMPDAT\n-- the", 1))
        self.deck.refuse("WELOPEN: expected connections of a well with COMPTRAJ without their cells, found a cell; choose the whole well, or complete it "
                         "with COMPDAT")

    def test_a_disk_that_is_full(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the write fails instead
            resource.setrlimit(resource.RLIMIT_FSIZE, (5_000, 5_000))
        result = subprocess.run([PROGRAM, "build", "CASE.DATA", "--write", "deck=OUT.DATA"], cwd=self.deck.folder, capture_output=True, text=True,
                                preexec_fn=limit, restore_signals=False)
        self.assertEqual((result.returncode, result.stderr), (1, "wellknit: OUT_parts/grid.inc: cannot be written; is the disk full?\n"))
        self.assertEqual([path.name for path in self.deck.folder.glob("*OUT*")], [])

    def test_trajectories(self):
        begin = self.deck.source["CASE.DATA"].index("COMPDAT")
        track = "WELTRAJ\n P1 1* 180 180 2000 0 /\n P1 1* 180 180 2030 30 /\n/\nCOMPTRAJ\n P1 1* {} /\n/\n"
        head = self.deck.source["CASE.DATA"][begin:begin + 40]
        for words, perforation in (
            ("expected MD as item 5, found 'TVD'; state the stretch in measured depth", "2001 2020 TVD 1* OPEN 1* 1* 0.2"),
            ("expected a default as item 9, found a factor of the whole stretch; leave it out: wellknit computes factors by cell",
             "1 20 MD 1* OPEN 1* 5.0 0.2"),
        ):
            with self.subTest(words):
                self.deck.change(head, track.format(perforation) + head)
                self.deck.refuse(words)

    def test_wells_that_the_deck_does_not_know(self):
        (self.deck.folder / "X.csv").write_text(csv((180.0, 180.0, 1990.0), (180.0, 180.0, 2040.0)))
        _, report = self.deck.convert("--well", "X.csv,radius=10")
        self.assertIn("well X has no WELSPECS in the deck: it is not in the new deck; name it with --well FILE,name=…", str(report))
        self.deck.change("WELSPECS\n", "WELSPECS\n Z G 3 3 1* OIL /\n")
        (self.deck.folder / "Z.csv").write_text(csv((100.0, 100.0, 1990.0), (100.0, 100.0, 2040.0)))
        _, report = self.deck.convert("--well", "Z.csv,radius=10")
        self.assertIn("well Z has a mesh, but the deck completes it nowhere", str(report))


def record(name, kind, values):
    """An array of an Eclipse file."""
    size = {"CHAR": 8, "INTE": 4, "REAL": 4}[kind]
    form = {"CHAR": "8s", "INTE": "i", "REAL": "f"}[kind]
    if kind == "CHAR":
        values = [v.ljust(8).encode() for v in values]
    out = struct.pack(">i8si4si", 16, name.ljust(8).encode(), len(values), kind.encode(), 16)
    step = 105 if kind == "CHAR" else 1000
    for begin in range(0, len(values), step):
        part = values[begin:begin + step]
        out += struct.pack(f">i{''.join([form] * len(part))}i", size * len(part), *part, size * len(part))
    return out


class Compare(Case):
    def run_of(self, name, vectors, dimensions=(2, 1, 1), days=(1.0, 2.0), pressure=None):
        """A run's files: vectors by (keyword, well, number)."""
        keys = [("TIME", ":+:+:+:+", 0), *vectors]
        smspec = record("DIMENS", "INTE", [len(keys), *dimensions, 0, -1])
        smspec += record("KEYWORDS", "CHAR", [k[0] for k in keys]) + record("WGNAMES", "CHAR", [k[1] for k in keys])
        smspec += record("NUMS", "INTE", [k[2] for k in keys]) + record("UNITS", "CHAR", ["DAYS"] + ["BARSA"] * len(vectors))
        smspec += record("STARTDAT", "INTE", [1, 1, 2020, 0, 0, 0])
        unsmry = b"".join(record("SEQHDR", "INTE", [n]) + record("MINISTEP", "INTE", [n]) + record("PARAMS", "REAL", [day] + [100.0 + n] * len(vectors))
                          for n, day in enumerate(days))
        (self.folder / f"{name}.SMSPEC").write_bytes(smspec)
        (self.folder / f"{name}.UNSMRY").write_bytes(unsmry)
        if pressure:
            (self.folder / f"{name}.UNRST").write_bytes(record("SEQNUM", "INTE", [1]) + record("PRESSURE", "REAL", pressure))

    def test_notes(self):
        field = ("FPR", ":+:+:+:+", 0)
        self.run_of("A", [field, ("FOPR", ":+:+:+:+", 0), ("BPR", ":+:+:+:+", 1)])
        self.run_of("B", [field], dimensions=(3, 1, 1))
        out = self.succeed("compare", "A", "B")
        for words in ("1 vectors of the first run are not in the second", "1 vectors of cells are not compared: the runs have different grids",
                      "cell pressures are not compared: a run has no UNRST file"):
            self.assertIn(words, out)

    def test_pressures(self):
        field = ("FPR", ":+:+:+:+", 0)
        self.run_of("A", [field], pressure=[1.0, 2.0])
        self.run_of("B", [field], dimensions=(3, 1, 1), pressure=[1.0, 2.0, 3.0])
        self.assertIn("cell pressures are not compared: the runs have different grids; give the second one's mesh file with --mesh",
                      self.succeed("compare", "A", "B"))
        self.succeed("build", "box.GRDECL", "-o", "mesh.h5")
        self.fail_with(1, "compare", "A", "B", "--mesh", "mesh.h5", mention=["has 3 active cells, and --mesh says 1800: is this its mesh file?"])

    def test_other_times(self):
        self.run_of("A", [("FPR", ":+:+:+:+", 0)])
        self.run_of("B", [("FPR", ":+:+:+:+", 0)], days=(11.0, 12.0))
        self.fail_with(1, "compare", "A", "B", mention=["the two runs have no time in common"])


def zcorn(throw=0.0, thins_out=None):
    """Corner depths with a fault at i = 8, or with a layer that thins out from i = 3 to i = 9."""
    out = []
    for level in range(2 * NZ):
        layer = (level + 1) // 2
        for _ in range(2 * NY):
            for i in range(2 * NX):
                depth = TOP + DZ * layer + (throw if i // 2 >= 8 else 0.0)
                if thins_out is not None and layer > thins_out:
                    depth -= DZ * min(1.0, max(0.0, (i // 2 + i % 2 - 3) / 6.0))
                out.append(depth)
    return out


class Reasons(Case):
    """Why a well, or a part of one, has no mesh, or another one than was asked for."""

    def check(self, words, *wells, grid="box.GRDECL"):
        """Wells are points and keys; the words stand in a reason or a note."""
        arguments = []
        for n, (points, keys) in enumerate(wells):
            self.write(f"W{n}.csv", csv(*points))
            arguments += ["--well", f"W{n}.csv,{keys}"]
        with self.subTest(words):
            out = " ".join(self.succeed("build", grid, *arguments, "-o", "out.h5", "--overwrite").split())
            self.assertIn(words, out)
            self.assertIn("out.h5: valid", self.succeed("check", "out.h5"))

    def test_reasons(self):
        self.write("fault.GRDECL", grdecl(ZCORN=values(zcorn(25.0))))
        upright = lambda x, y: [(x, y, 990.0), (x, y, 1090.0)]
        along = [(60.0, 150.0, 1040.0), (250.0, 150.0, 1040.0)]
        for words, grid, wells in (
            ("a fault or a place without thickness lies within 27 m of it", "fault.GRDECL", [(upright(160.1, 150), "radius=15")]),
            ("its tube of radius 15 m leaves the grid, or meets a fault, at the top of layer 1", "box.GRDECL", [(upright(0.2, 0.2), "radius=15")]),
            ("it bends too sharply for a drainage radius of 15 m at measured depth 42.0 m", "box.GRDECL",
             [([(100, 100, 1040), (140, 100, 1040), (140, 104, 1040), (100, 104, 1040)], "radius=15,mode=swept")]),
            ("since with that well W1 comes within 5.0 m of it", "box.GRDECL", [(upright(150, 150), "radius=15"), (upright(155, 150), "radius=15")]),
            ("its tube overlaps another one: their paths come within", "box.GRDECL",
             [(upright(150, 150), "radius=15"), (upright(150.01, 150), "radius=15")]),
            ("no stretch of one drainage radius (15 m) keeps clear of faults, other tubes, and the top, base and sides of the grid", "box.GRDECL",
             [([(60, 150, 1000.2), (250, 150, 1000.2)], "radius=15,mode=swept")]),
            ("a swept tube needs 6 or more sectors, not 4", "box.GRDECL", [(along, "radius=15,sectors=4")]),
            ("7 rings instead of 20: thinner ones in 6 sectors could not hold their centres at the tube's ends", "box.GRDECL",
             [(along, "radius=15,sectors=6,rings=20")]),
            ("the path was smoothed by up to 2.8 m for the rings to stand normal to it", "box.GRDECL",
             [([(60 + 10 * i, 150 + 3 * (-1)**i, 1040) for i in range(18)], "radius=15")]),
            (" m) lies in 2 tubes; the rest is connected by index", "box.GRDECL",
             [(upright(150, 150), "radius=15"), (along, "radius=15")]),
        ):
            self.check(words, *wells, grid=grid)


class Trajectories(Case):
    def test_files(self):
        for words, name, text in (
            ("expected a Trajectory of WITSML", "w.xml", "<witsml><log/></witsml>"),
            ("found a number or text that cannot be held", "w.json", '{"stations": [1e999999]}'),
        ):
            self.write(name, text)
            with self.subTest(words):
                self.fail_to_build(1, "box.GRDECL", "--well", name, mention=[words])

    def test_notes(self):
        for words, name, text in (
            ("Z falls below 0 along the well: taken as elevation and turned into depth", "z.csv",
             "MD,X,Y,Z\n0,155,143,50\n1050,155,143,-1000\n1140,155,143,-1090\n"),
            ("its PERF log opens nothing; taken as open over its whole length", "w.rmswell",
             "1.0\nPlanned\nW 155 143\n2\nMD CONT lin\nPERF DISC 0 CLOSED\n155 143 990 0 0\n155 143 1090 100 0\n"),
        ):
            self.write(name, text)
            with self.subTest(words):
                out = self.succeed("build", "box.GRDECL", "--well", name, "-o", "out.h5", "--overwrite")
                self.assertIn(words, " ".join(out.split()))

    def test_las_with_another_null(self):
        self.write("w.las", "~V\nVERS. 2.0 :\nWRAP. NO :\n~W\nNULL. -999.25 :\nWELL. W :\n~C\nDEPT.M :\nX.M :\nY.M :\nTVD.M :\n~A\n"
                   "0 155 143 990\n50 1e30 143 1040\n100 155 143 1090\n")
        self.fail_to_build(1, "box.GRDECL", "--well", "w.las", mention=["expected a length in metres, below 1e8", "check NULL in the well section"])


class Samples(Case):
    """Files of other programs, from the project's test data."""

    def test_notes(self):
        data = PROJECT / "testdata"
        text = (data / "roff" / "grid.roffasc").read_text()
        self.write("upside.roffasc", text.replace("float zscale -1.0", "float zscale 1.0"))
        for words, path in (
            ("its bytes stand in little-endian order, which no simulator writes; it is read so", data / "ecl" / "little_endian.EGRID"),
            ("its top lies below its bottom: z may be an elevation; check scale.zscale (-1 in most files)", "upside.roffasc"),
        ):
            with self.subTest(words):
                self.assertIn(words, self.succeed("info", path))

    def test_properties_of_another_grid(self):
        cells = NX * NY * NZ
        self.succeed("build", "box.GRDECL", "-o", "mesh.h5")
        # Of the active cells alone: which these are only the grid's own file says.
        (self.folder / "other.INIT").write_bytes(
            record("INTEHEAD", "INTE", [0, 0, 1] + [0] * 5 + [NX, NY, NZ, cells - 1] + [0] * 88) + record("SWATINIT", "REAL", [0.2] * cells) +
            record("PORO", "REAL", [0.2] * (cells - 1)))
        self.assertIn(f"PORO has {cells - 1} values, not {cells}; passed over", self.succeed("map", "mesh.h5", "--forward", "other.INIT", "-o", "more.h5"))


class MeshFile(Case):
    """Mesh files whose parts are not what the schema says."""

    def setUp(self):
        super().setUp()
        try:
            import h5py
        except ImportError:
            self.skipTest("python3-h5py is not installed")
        self.h5py = h5py
        self.succeed("build", "box.GRDECL", "--well", "well.csv,radius=15", "-o", "good.h5")

    def check_changed(self, words, change):
        with self.subTest(words):
            (self.folder / "bad.h5").write_bytes((self.folder / "good.h5").read_bytes())
            with self.h5py.File(self.folder / "bad.h5", "r+") as file:
                change(file)
            self.fail_with(1, "check", "bad.h5", mention=[words])

    def test_attributes(self):
        def drop(name):
            return lambda file: file.attrs.__delitem__(name)

        def put(name, value, group="/"):
            def change(file):
                if name in file[group].attrs:
                    del file[group].attrs[name]
                file[group].attrs[name] = value
            return change

        well = "wells/well"
        for words, change in (
            ("created_by: expected an attribute of /, found none", drop("created_by")),
            ("command: expected one string, found 2 of them", put("command", ["a", "b"])),
            ("sources: expected pairs of a name and a SHA-256, found 1 strings", put("sources", ["a"])),
            ("bore_radius: expected numbers of its kind, found another type", put("bore_radius", "wide", well)),
            ("expected the type producer or injector, found observer", put("type", "observer", well)),
        ):
            self.check_changed(words, change)

    def test_a_transmissibility_that_is_none(self):
        for value in (-1e-12, float("nan")):
            (self.folder / "bad.h5").write_bytes((self.folder / "good.h5").read_bytes())
            with self.h5py.File(self.folder / "bad.h5", "r+") as file:
                file["connections/transmissibility"][7] = value
            with self.subTest(value):
                out = self.succeed("solve", "bad.h5", "--boundary", "all=200bar", "--well", "well=100bar")
                self.assertIn("1 connections of negative or undefined transmissibility were taken as closed", out)


if __name__ == "__main__":
    unittest.main(verbosity=0)
