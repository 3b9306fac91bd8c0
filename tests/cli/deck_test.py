# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of whole decks by `wellknit build CASE.DATA --write deck=OUT.DATA`, without a simulator.

The environment names the program (WELLKNIT).
"""
import json
import os
import pathlib
import random
import re
import subprocess
import tempfile
import unittest

import whole_deck

PROGRAM = os.environ["WELLKNIT"]


def keyword(text, name):
    """The records of the n-th keyword of a name: a list of lists of items, one list for each time it stands there."""
    out = []
    for match in re.finditer(rf"^{name}\b[^\n]*\n(.*?)^\s*/", text, re.MULTILINE | re.DOTALL):
        records = []
        for line in match.group(1).splitlines():
            line = line.split("--")[0]
            if "/" in line:
                records.append(line.split("/")[0].split())
        out.append(records)
    return out


class Deck(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)
        self.source = whole_deck.files()
        for name, text in self.source.items():
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, "build", "CASE.DATA", *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=300)

    def convert(self, *arguments):
        result = self.run_program(*arguments, "--json", "--write", "deck=OUT.DATA", "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.folder / "OUT.DATA").read_text(), json.loads(result.stdout)

    def change(self, old, new):
        self.assertIn(old, self.source["CASE.DATA"])
        (self.folder / "CASE.DATA").write_text(self.source["CASE.DATA"].replace(old, new, 1))

    def refuse(self, *mention):
        before = sorted(self.folder.rglob("*"))
        result = self.run_program("--write", "deck=OUT.DATA")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in mention:
            self.assertIn(word, result.stderr)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_what_names_no_cell_stays_byte_for_byte(self):
        text, _ = self.convert()
        source = self.source["CASE.DATA"]
        for begin, end in (("-- A small deck", "DIMENS"), ("OIL\nWATER", "NONNC"), ("PROPS\n-- water", "SWL "),
                           ("WCONPROD", "COMPDAT\n P1 5"), ("TSTEP\n 2*30", "")):
            part = source[source.index(begin):source.index(end, source.index(begin)) if end else None]
            self.assertIn(part, text)
        for name in self.source:
            self.assertEqual((self.folder / name).read_text(), self.source[name], "an input was changed")

    def test_the_grid_is_a_row(self):
        text, report = self.convert()
        self.assertIn("DIMENS\n 324 1 1 / cells\n", text)
        self.assertIn("'OUT_parts/grid.inc'", text)
        self.assertNotIn("small.grdecl", text)
        self.assertIn("-- NONNC dropped", text)
        grid = (self.folder / "OUT_parts" / "grid.inc").read_text()
        self.assertIn("\nNNC\n", grid)
        self.assertEqual({p.name for p in (self.folder / "OUT_parts").iterdir()}, {"grid.inc", "edit.inc", "files"})
        actions = {(e["keyword"], e["action"]) for e in report["conversion"]["entries"]}
        self.assertLessEqual({("GRID", "replaced"), ("SWL", "transferred"), ("FIPNUM", "transferred"), ("NONNC", "dropped"),
                              ("AQUANCON", "rewritten"), ("WBP5", "dropped")}, actions)

    def test_arrays_of_boxes_are_written_in_full(self):
        text, _ = self.convert()
        # Without a well every cell is an old one, in the old order: 3 x 9 x 2 cells have 0.25.
        values = re.findall(r"^SWL\n(.*?)/", text, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(values), 1)
        expanded = []
        for token in values[0].split():
            count, star, value = token.partition("*")
            expanded += [float(value)] * int(count) if star else [float(token)]
        expected = [0.25 if i < 3 and k < 2 else 0.2 for k in range(4) for j in range(9) for i in range(9)]
        self.assertEqual(expanded, expected)
        self.assertNotIn("\nBOX", text)
        regions = (self.folder / "OUT_parts" / "files" / "regions.inc").read_text()
        self.assertIn("-- end of the regions", regions)
        self.assertIn("FIPNUM", regions)
        self.assertNotIn("\nEQUALS", regions)
        self.assertIn("'OUT_parts/files/regions.inc'", text)

    def test_cells_have_their_new_numbers(self):
        text, _ = self.convert()
        # Cell (5,5,2) is number 4 + 9 * 4 + 81 = 121 from 0.
        self.assertEqual(keyword(text, "BPR"), [[["1", "1", "1"], ["122", "1", "1"]]])
        self.assertEqual(keyword(text, "COFR"), [[["P1", "122", "1", "1"], ["'H1'", "228", "1", "1"]]])
        self.assertEqual(keyword(text, "WELSPECS")[0][0][:4], ["P1", "G", "41", "1"])
        # The first of TRACK for P1 is layer 1, whose centre lies 3 m below its top: 2000 + 0.5 * 4.5 + 3.
        self.assertAlmostEqual(float(keyword(text, "WELSPECS")[0][0][4]), 2005.25)
        self.assertEqual(keyword(text, "WELSPECS")[0][1][4], "2005")
        self.assertIn("/  a producer", text)
        first = keyword(text, "COMPDAT")[0]
        self.assertEqual([r[1:5] for r in first if r[0] == "'P1'"], [["41", "1", "1", "1"], ["122", "1", "1", "1"]])
        # H1 is tracked from its head at i = 7 downwards.
        self.assertEqual([r[1] for r in first if r[0] == "'H1'"], ["230", "229", "228"])
        self.assertEqual([r[7] for r in first if r[0] == "'I1'"], ["12.5"] * 4)
        self.assertEqual(keyword(text, "COMPORD"), [[["'P1'", "DEPTH"], ["'I1'", "INPUT"], ["'H1'", "INPUT"], ["'B1'", "INPUT"]]])
        self.assertEqual(keyword(text, "WELOPEN"), [[["'P1'", "SHUT", "41", "1", "1"], ["'B1'", "SHUT", "260", "1", "1"]]])
        self.assertEqual(keyword(text, "WPIMULT"), [[["'I1'", "0.5", "101", "1", "1"], ["H1", "0.8"]]])
        self.assertEqual([r[:3] for r in keyword(text, "COMPSEGS")[0][1:]], [[str(17 + 81 * k), "1", "1"] for k in range(4)])

    def test_factors_are_those_of_the_simulator(self):
        text, _ = self.convert()
        # Peaceman in a square cell of 40 m: r_o = 0.14 sqrt(2) 40 m = 7.9196 m with k_x = k_y; h = 6 m * 0.9.
        import math
        cf = 0.008527014671917 * 2 * math.pi * 100 * 5.4 / math.log(0.28 * math.sqrt(2 * 40.0**2) / 2 / 0.1)
        line = keyword(text, "COMPDAT")[0][0]
        self.assertEqual(line[5:7], ["OPEN", "1*"])
        self.assertAlmostEqual(float(line[7]) / cf, 1.0, delta=1e-6)
        self.assertAlmostEqual(float(line[9]), 540.0, delta=1e-6)

    def test_a_meshed_well_has_a_record_for_each_cell_at_the_bore(self):
        text, report = self.convert("--deck-wells", "P1")
        self.assertTrue(report["wells"][0]["meshed"], report["wells"][0])
        first, second = keyword(text, "COMPDAT")[:2]
        upper = [r for r in first if r[0] == "'P1'"]
        self.assertEqual((len(upper), len(second)), (12, 12))  # two layers of six sectors each
        self.assertFalse({r[1] for r in upper} & {r[1] for r in second})
        # The deck's own connections of the others stay: three cells of H1, four of I1 with their stated factor.
        self.assertEqual(len([r for r in first if r[0] == "'H1'"]), 3)
        self.assertEqual({r[7] for r in first if r[0] == "'I1'"}, {"12.5"})
        # Shut by cell: the six cells of the layer, which are P1's own.
        shut = [r[2] for r in keyword(text, "WELOPEN")[0] if r[0] == "'P1'"]
        self.assertEqual(len(shut), 6)
        self.assertLessEqual(set(shut), {r[1] for r in upper})
        # A skin of 2 in the second keyword, none in the first: 2 pi Kh / CF differs by 2 from what it is without.
        self.change("2* 0.2 1* 2 /", "2* 0.2 1* 0 /")
        plain = keyword(self.convert("--deck-wells", "P1")[0], "COMPDAT")[1]
        unit = 0.008527014671917 * 2 * 3.141592653589793
        for with_skin, without in zip(second, plain):
            resistance = [unit * float(r[9]) / float(r[7]) for r in (with_skin, without)]
            self.assertAlmostEqual(resistance[0] - resistance[1], 2.0, delta=1e-6)
        self.assertIn("-- dropped", text)  # BPR and COFR of (5,5,2)

    def test_small_cells_at_the_bore_are_named(self):
        words = "steps may get very short; more even rings (--growth 1.2), fewer rings or sectors help"
        self.assertIn(words, str(self.convert("--deck-wells", "P1", "--rings", "8", "--growth", "geometric")[1]))
        self.assertNotIn(words, str(self.convert("--deck-wells", "P1")[1]))

    def radial_cells(self, *arguments):
        """Of P1, and the notes of the conversion."""
        _, report = self.convert("--deck-wells", "P1", *arguments)
        return report["wells"][0]["radial_cells"], " ".join(report["conversion"]["notes"])

    def test_a_deck_of_several_phases_has_three_even_rings_of_six_sectors(self):
        # 4 layers; the deck has oil and water.
        cells, notes = self.radial_cells()
        self.assertEqual(cells, 4 * 6 * 3)
        self.assertIn("meshes have 6 sectors, 3 rings, ring widths that grow by 1.2, so that", notes)
        cells, notes = self.radial_cells("--rings", "4")
        self.assertEqual(cells, 4 * 6 * 4)
        self.assertIn("meshes have 6 sectors, ring widths that grow by 1.2, so that", notes)
        cells, notes = self.radial_cells("--growth", "geometric", "--sectors", "8")
        self.assertEqual(cells, 4 * 8 * 3)
        self.assertIn("meshes have 3 rings, so that", notes)
        self.assertNotIn("several phases", self.radial_cells("--growth", "geometric", "--rings", "5", "--sectors", "10")[1])

    def test_the_choice_of_rings_is_the_same_as_giving_them(self):
        """Down to the pore volumes of the cells."""
        self.run_program("--deck-wells", "P1", "--write", "deck=A.DATA")
        self.run_program("--deck-wells", "P1", "--write", "deck=B.DATA", "--sectors", "6", "--rings", "3", "--growth", "1.2")
        self.run_program("--deck-wells", "P1", "--write", "deck=C.DATA", "--growth", "geometric")
        a, b, c = ((self.folder / f"{name}_parts" / "edit.inc").read_text() for name in "ABC")
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)

    def test_one_phase_and_a_mesh_alone_keep_radii_in_geometric_progression(self):
        result = self.run_program("--deck-wells", "P1", "--json", "-o", "mesh.h5")
        self.assertEqual(json.loads(result.stdout)["wells"][0]["radial_cells"], 4 * 10 * 5)
        self.change("OIL\nWATER\n", "WATER\n")
        cells, notes = self.radial_cells()
        self.assertEqual(cells, 4 * 10 * 5)
        self.assertNotIn("several phases", notes)

    def test_a_minimum_of_lift_gas_is_named(self):
        gas_lift = "LIFTOPT\n 12500 5E-3 37 YES /\nWLIFTOPT\n P1 YES 150000 1.2 {} /\n H1 NO 150000 1.2 5 /\n/\nTSTEP\n 1 9 20 /"
        self.change("TSTEP\n 1 9 20 /", gas_lift.format("3.0"))
        text, report = self.convert()
        notes = " ".join(report["conversion"]["notes"])
        self.assertIn("WLIFTOPT has a minimum of lift gas for well P1 (item 5)", notes)
        self.assertNotIn("well H1", notes)
        self.assertIn(gas_lift.format("3.0"), text, "the deck is as it was")
        for other in ("0", "-1.0", "1*"):
            self.change("TSTEP\n 1 9 20 /", gas_lift.format(other))
            self.assertNotIn("lift gas", " ".join(self.convert()[1]["conversion"]["notes"]))

    def test_the_pore_volume_of_the_aquifer_and_of_regions(self):
        text, report = self.convert("--deck-wells", "P1")
        rows = keyword(text, "AQUANCON")[0]
        # 9 cells along, 4 layers of 40 m * 6 m each.
        self.assertEqual(len(rows), 36)
        self.assertEqual({r[7] for r in rows}, {"'J-'"})
        self.assertAlmostEqual(sum(float(r[8]) for r in rows), 36 * 240.0, delta=1e-3)
        self.assertAlmostEqual(report["pore_volume"], 324 * 1600 * 6 * 0.2 * 0.9, delta=1e-2)

    def test_completion_numbers_survive(self):
        self.change(" P1 SHUT 5 5 1 /", " P1 SHUT 3* 2 2 /")
        text, _ = self.convert("--deck-wells", "P1")
        numbers = [r for r in keyword(text, "COMPLUMP")[0] if r[0] == "'P1'"]
        self.assertEqual(sorted(r[5] for r in numbers), ["1"] * 6 + ["2"] * 6)

    def test_refusals(self):
        for old, new, word in (
                ("OIL\n", "OIL\nDUALPORO\n", "dual medium"), ("OIL\n", "OIL\nLGR\n 1 1 /\n", "local grid refinement"),
                ("OIL\n", "OIL\nTHERMAL\n", "heat"), ("EQUIL\n", "RESTART\n OLD 10 /\nEQUIL\n", "continues another"),
                ("WELSPECS\n", "COMPDATL\n P1 L 1 1 1 1 OPEN /\n/\nWELSPECS\n", "local grid refinement"),
                ("PORO\n", "AQUNUM\n 1 1 1 1 1 1 /\n/\nPORO\n", "numerical aquifer"),
                ("TSTEP\n 30 /", "MULTZ\n 324*0.5 /\nTSTEP\n 30 /", "change with time"),
                ("ENDSCALE\n/", "ENDSCALE\n DIRECT /", "direction"),
                ("ENDBOX\n", "ENDBOX\nNEWPROP\n 324*1.5 /\n", "one for each cell")):
            self.change(old, new)
            self.refuse("CASE.DATA:", word)

    def test_arrays_in_a_part_of_the_cells_keep_their_gaps(self):
        self.change(f"SWL   -- by operations\n {9 * 9 * 4}*0.2 /\n", "")
        text, _ = self.convert()
        values = re.search(r"^SWL\n(.*?)/", text, re.MULTILINE | re.DOTALL).group(1)
        self.assertEqual(values.split()[:2], ["3*0.25", "6*"])

    def test_outputs_appear_together(self):
        self.convert()
        result = self.run_program("--write", "deck=OUT.DATA")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--overwrite", result.stderr)
        (self.folder / "OUT_parts" / "notes.txt").write_text("precious")
        result = self.run_program("--write", "deck=OUT.DATA", "--overwrite")
        self.assertEqual(result.returncode, 1)
        self.assertIn("notes.txt", result.stderr)
        result = self.run_program("--write", "deck=CASE.DATA", "--overwrite")
        self.assertEqual(result.returncode, 2)

    def test_damage_is_one_line(self):
        """Cut or changed bytes: a deck, or exit 1 with one line; never more."""
        seed = random.randrange(1_000_000)
        chance = random.Random(seed)
        text = self.source["CASE.DATA"]
        for _ in range(60):
            at = chance.randrange(len(text))
            damaged = chance.choice([text[:at], text[:at] + chance.choice("/'*-9Z\n\0") + text[at + 1:],
                                     text[:at] + text[at + chance.randrange(1, 40):]])
            (self.folder / "CASE.DATA").write_text(damaged)
            result = self.run_program("--write", "deck=OUT.DATA", "--overwrite", "--quiet")
            self.assertIn(result.returncode, (0, 1), f"seed {seed}, byte {at}: {result.stderr}")
            self.assertEqual(result.stderr.count("\n"), result.returncode, f"seed {seed}, byte {at}: {result.stderr}")


if __name__ == "__main__":
    unittest.main()
