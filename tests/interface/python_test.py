#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module as its user has it. The environment names the program (WELLKNIT) and the project's folder (WELLKNIT_SOURCE_DIR)."""
import ast
import gc
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

import wellknit

PROJECT = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"])
EXAMPLE = PROJECT / "testdata" / "example"


class Python(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = wellknit.build(EXAMPLE / "example.GRDECL", [EXAMPLE / "curved.csv", wellknit.Well(EXAMPLE / "steep.dev", sectors=8)], threads=2)
        cls.scratch = tempfile.TemporaryDirectory()
        cls.file = pathlib.Path(cls.scratch.name) / "mesh.h5"
        cls.mesh.write(cls.file)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_arrays_are_those_of_the_mesh_file(self):
        with h5py.File(self.file) as file:
            names = []
            file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and name != "wells_order" else None)
            self.assertEqual(sorted(names), sorted(self.mesh))
            for name in names:
                np.testing.assert_array_equal(self.mesh[name], file[name][...], err_msg=name)
        self.assertEqual(len(self.mesh), len(names))
        self.assertIn("cells/volume", self.mesh)
        self.assertNotIn("cells/colour", self.mesh)
        with self.assertRaises(KeyError):
            self.mesh["cells/colour"]

    def test_a_read_mesh_has_the_same_arrays(self):
        again = wellknit.read(str(self.file))
        for name in self.mesh:
            np.testing.assert_array_equal(self.mesh[name], again[name], err_msg=name)
        self.assertNotIn("reason", again.wells[0])

    def test_arrays_are_read_only_and_keep_the_mesh(self):
        volume = wellknit.read(self.file)["cells/volume"]
        gc.collect()
        self.assertGreater(volume.sum(), 0)
        with self.assertRaises(ValueError):
            volume[0] = 1.0

    def test_the_same_mesh_as_the_program(self):
        out = pathlib.Path(self.scratch.name) / "program.h5"
        subprocess.run([os.environ["WELLKNIT"], "build", EXAMPLE / "example.GRDECL", "--well", EXAMPLE / "curved.csv", "--well",
                        f"{EXAMPLE / 'steep.dev'},sectors=8", "-o", out, "--quiet"], check=True)
        theirs = wellknit.read(out)
        for name in theirs:
            np.testing.assert_array_equal(self.mesh[name], theirs[name], err_msg=name)

    def test_wells_by_points(self):
        points = np.array([[250, 260, 1900], [255, 262, 2600]])  # integers are taken as numbers
        mesh = wellknit.build(EXAMPLE / "example.GRDECL", [wellknit.Well(name="W", points=points, radius=12, mode="layered")], refine="off")
        self.assertEqual([(w["name"], w["meshed"]) for w in mesh.wells], [("W", True)])
        self.assertEqual(mesh["wells/W/trajectory"][:, 1:].tolist(), points.tolist())
        self.assertGreater(mesh.wells[0]["length_meshed"], 0)

    def test_check_and_quality(self):
        self.assertEqual(self.mesh.violations(), [])
        checked = json.loads(subprocess.run([os.environ["WELLKNIT"], "check", self.file, "--json"], check=True, capture_output=True, text=True).stdout)
        self.assertEqual(self.mesh.quality(), checked["quality"])

    def test_formats(self):
        folder = pathlib.Path(self.scratch.name)
        self.mesh.write(folder / "out.vtu")
        self.mesh.write(folder / "tables", format="csv")
        self.assertTrue((folder / "tables" / "cells.csv").exists())
        with self.assertRaisesRegex(wellknit.Error, "exist"):
            self.mesh.write(folder / "out.vtu")
        self.mesh.write(folder / "out.vtu", overwrite=True)
        with self.assertRaisesRegex(wellknit.Error, "extension"):
            self.mesh.write(folder / "out.unknown")

    def test_growth_of_the_rings(self):
        even = wellknit.build(EXAMPLE / "example.GRDECL", [wellknit.Well(EXAMPLE / "steep.dev", growth=1.0)])
        smallest = lambda mesh: mesh["cells/volume"][mesh["cells/kind"] == 3].min()
        self.assertGreater(smallest(even), 50 * smallest(self.mesh))

    def test_what_is_wrong_is_said(self):
        grid = EXAMPLE / "example.GRDECL"
        for call, text in ((lambda: wellknit.build("nowhere.GRDECL"), "nowhere.GRDECL"), (lambda: wellknit.read(grid), "example.GRDECL"),
                           (lambda: wellknit.build(grid, deck_wells="all"), "no wells"), (lambda: wellknit.build(grid, refine="often"), "refine"),
                           (lambda: wellknit.build(grid, colour="red"), "colour"), (lambda: wellknit.Well(name="W", points=[1, 2, 3]), "n rows"),
                           (lambda: wellknit.Well(grid, mode="round"), "mode"), (lambda: wellknit.build(grid, [wellknit.Well()]), "name"),
                           (lambda: wellknit.build(grid, [wellknit.Well(EXAMPLE / "curved.csv", sectors=2)]), "sectors")):
            with self.subTest(text=text), self.assertRaisesRegex(wellknit.Error, text):
                call()
        well = lambda **keys: wellknit.build(grid, [wellknit.Well(EXAMPLE / "curved.csv", **keys)])
        path = lambda points, **keys: wellknit.build(grid, [wellknit.Well(name="P", points=points, **keys)])
        for call, text in ((lambda: well(bore_radius=5.0, radius=2.0), "expected a bore radius above 0 and a drainage radius above it"),
                           (lambda: well(rings=5000), "rings: expected 1 to 1000, found 5000"),
                           (lambda: well(segments=-1), "segments: expected 1 to 1000000, found -1"),
                           (lambda: well(skin=float("nan")), "skin: expected a number"),
                           (lambda: wellknit.build(grid, threads=-1), "threads: expected a whole number from 0 to "),
                           (lambda: wellknit.build(grid, [EXAMPLE / "curved.csv"] * 2), "two wells are named curved; give one of them another name"),
                           (lambda: path([[1, 2, 3]]), "well P: expected 2 points or more, found 1"),
                           (lambda: path([[1, 2, 3], [1, 2, float("nan")]]), "well P: point 1 has a value that is not a number"),
                           (lambda: path([[1, 2, 3], [1, 2, 9]], measured_depth=[5, 4]), "well P: measured depth 4 at point 1 is not above the one before"),
                           (lambda: well(sectors=2), "sectors: expected 3 to 360, found 2"),
                           (lambda: self.mesh.write("x.unknown"), "x.unknown: its extension is none of those in `wellknit formats`"),
                           (lambda: self.mesh.write("x.h5", format="stl"), "no format stl; `wellknit formats` names them"),
                           (lambda: wellknit.build(grid, colour="red"), "expected the option mapping, metric, optimise, refine, fault-policy, heal-throw, fluxes or threads, found colour")):
            with self.subTest(text=text), self.assertRaises(wellknit.Error) as caught:
                call()
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(TypeError):
            wellknit.build(42)

    def test_the_stub_names_what_there_is(self):
        tree = ast.parse((PROJECT / "interface" / "python" / "wellknit.pyi").read_text())
        stub = {node.name if hasattr(node, "name") else node.target.id for node in tree.body
                if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign))}
        self.assertEqual(stub, {name for name in dir(wellknit) if not name.startswith("__") or name == "__version__"})
        public = lambda names: {name for name in names if not name.startswith("_")}
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and node.name in ("Well", "Mesh"):
                members = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
                self.assertEqual(public(members), public(dir(getattr(wellknit, node.name))))


if __name__ == "__main__":
    unittest.main()
