#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens reports in headless Chromium, as a user does, with the network off.

The environment names the program (WELLKNIT), the project's folder (WELLKNIT_SOURCE_DIR), public data that need not be
there (WELLKNIT_SHARED), and where screenshots are kept (WELLKNIT_SCREENSHOTS). Exit 77: no Chromium or no Selenium.
"""
import base64
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(77)

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
if not CHROMIUM or not DRIVER:
    print("skipped: chromium and chromium-driver are not installed")
    sys.exit(77)

PROGRAM = os.environ["WELLKNIT"]
PROJECT = pathlib.Path(os.environ["WELLKNIT_SOURCE_DIR"])
SHARED = pathlib.Path(os.environ.get("WELLKNIT_SHARED", "/nowhere"))
SCREENSHOTS = pathlib.Path(os.environ.get("WELLKNIT_SCREENSHOTS", tempfile.gettempdir()))
# Software rendering: the test must run where there is no graphics card.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--window-size=1400,1000", "--disable-background-networking"]


def run(folder, *arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, check=True, capture_output=True, text=True).stdout


class Report(unittest.TestCase):
    """A report of each mesh is made once."""

    @classmethod
    def setUpClass(cls):
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        shutil.copytree(PROJECT / "testdata" / "example", cls.folder, dirs_exist_ok=True)
        summary = run(cls.folder, "build", "example.GRDECL", "--well", "curved.csv", "--well", "steep.dev", "-o", "mesh.h5",
                      "--json")
        (cls.folder / "summary.json").write_text(summary)
        run(cls.folder, "solve", "mesh.h5", "--producers", "100bar", "--boundary", "all=200bar", "-o", "flow.h5")
        options = Options()
        options.binary_location = CHROMIUM
        for argument in ARGUMENTS:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(DRIVER), options=options)
        cls.browser.set_script_timeout(60)
        cls.command("Network.enable")
        cls.command("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls._folder.cleanup()

    @classmethod
    def command(cls, name, **parameters):
        return cls.browser.execute_cdp_cmd(name, parameters)

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def open(self, mesh, *options):
        """The report of a mesh file in the browser; returns what check --json says of the mesh."""
        page = self.folder / f"{mesh}.html"
        run(self.folder, "report", mesh, "-o", page, "--overwrite", *options)
        self.browser.get(page.as_uri())
        end = time.monotonic() + 60
        while self.script("return document.documentElement.dataset.picture") is None and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.script("return document.documentElement.dataset.picture"), "ready",
                         self.script("return document.getElementById('v-state').textContent"))
        self.assertEqual([entry for entry in self.browser.get_log("browser") if entry["level"] != "INFO"], [])
        result = subprocess.run([PROGRAM, "check", mesh, "--json"], cwd=self.folder, capture_output=True, text=True)
        return json.loads(result.stdout)

    def canvas(self):
        canvas = self.browser.find_element(By.ID, "v-canvas")
        self.script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        return canvas

    def pixels(self):
        """The picture when it has settled."""
        return self.browser.execute_async_script(
            "const done = arguments[0]; setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(() => done("
            "document.getElementById('v-canvas').toDataURL()))), 300);")

    def choose(self, name, value):
        self.script("const e = document.getElementById(arguments[0]); if (e.type === 'checkbox') e.checked = arguments[1];"
                    "else e.value = arguments[1]; e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change'));",
                    name, value)

    def keep(self, name):
        self.browser.save_screenshot(str(SCREENSHOTS / f"{name}.png"))

    def pick_cell(self, mesh):
        """A click shows the numbers of a cell, which are those of the mesh file."""
        ActionChains(self.browser).move_to_element_with_offset(self.canvas(), 0, 60).click().perform()
        end = time.monotonic() + 20
        while not self.script("return document.querySelector('#v-numbers table')") and time.monotonic() < end:
            time.sleep(0.05)
        cell = int(self.script("return document.getElementById('v-numbers').dataset.cell"))
        import h5py
        with h5py.File(self.folder / mesh) as file:
            volume, kind = file["cells/volume"][cell], file["cells/kind"][cell]
        value = lambda name: self.script(f"return document.querySelector('#v-numbers [data-array={name}]').textContent")
        self.assertAlmostEqual(float(value("volume")) / volume, 1.0, delta=1e-3)
        self.assertEqual(value("kind"), ["host", "refined", "transition", "radial"][kind])

    def check_figures(self, check):
        shown = self.script("return [...document.querySelectorAll('[data-figure]')].map(e => [e.dataset.figure, e.dataset.value])")
        self.assertGreater(len(shown), 60)
        for name, value in shown:
            self.assertEqual(float(value), check["quality"][name], name)
        embedded = json.loads(self.script("return document.getElementById('check').textContent"))
        self.assertEqual({**embedded, "file": ""}, {**check, "file": ""})
        self.assertEqual(self.script("return document.querySelector('#verdict h2').textContent"), check["headline"])


class Page(Report):
    def test_figures_are_those_of_check(self):
        self.check_figures(self.open("mesh.h5", "--summary", "summary.json"))
        steps = self.script("return document.getElementById('run').textContent")
        for step in json.loads((self.folder / "summary.json").read_text())["times"]:
            self.assertIn(step["step"], steps)
        self.keep("example")

    def test_flow_weighs_the_figures(self):
        check = self.open("flow.h5")
        self.check_figures(check)
        self.assertIn("nonorth_radial_flow_mean_deg", check["quality"])
        self.assertIn("by flow", self.script("return document.getElementById('conditions').textContent"))
        self.assertGreater(self.script("return document.querySelectorAll('polyline.flow').length"), 10)

    def test_nothing_is_asked_of_a_network(self):
        self.open("mesh.h5")
        page = (self.folder / "mesh.h5.html").as_uri()
        asked = self.script("return performance.getEntriesByType('resource').map(e => e.name)")
        self.assertEqual([name for name in asked if name != page and not name.startswith(("data:", "blob:"))], [])
        self.assertEqual(self.script("return fetch('http://127.0.0.1:1/').then(() => 'let through', () => 'refused')"), "refused")

    def test_light_dark_and_paper(self):
        self.open("mesh.h5")
        colour = lambda: self.script("return getComputedStyle(document.body).backgroundColor")
        self.assertEqual(colour(), "rgb(255, 255, 255)")
        self.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.assertEqual(colour(), "rgb(20, 24, 29)")
        self.keep("dark")
        self.browser.find_element(By.ID, "theme").click()
        self.assertEqual(colour(), "rgb(255, 255, 255)")
        self.command("Emulation.setEmulatedMedia", features=[])
        pdf = base64.b64decode(self.command("Page.printToPDF", printBackground=True)["data"])
        (SCREENSHOTS / "paper.pdf").write_bytes(pdf)
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.command("Emulation.setEmulatedMedia", media="print")
        self.assertFalse(self.browser.find_element(By.CSS_SELECTOR, ".controls").is_displayed())
        self.command("Emulation.setEmulatedMedia", media="")

    def test_every_control_has_a_name(self):
        self.open("mesh.h5")
        unnamed = self.script("""return [...document.querySelectorAll('button, input, select, canvas')].filter(e =>
            !e.textContent.trim() && !e.getAttribute('aria-label') && !(e.labels && e.labels.length)).map(e => e.outerHTML)""")
        self.assertEqual(unnamed, [])


class Picture(Report):
    def setUp(self):
        self.check = self.open("mesh.h5")

    def test_draws_and_turns(self):
        before = self.pixels()
        ActionChains(self.browser).drag_and_drop_by_offset(self.canvas(), 120, 40).perform()
        turned = self.pixels()
        self.assertNotEqual(before, turned)
        self.canvas().send_keys(Keys.ARROW_LEFT)
        by_key = self.pixels()
        self.assertNotEqual(turned, by_key)
        self.canvas().send_keys("+")
        self.assertNotEqual(by_key, self.pixels())
        self.keep("turned")

    def test_many_colours_are_drawn(self):
        """Not a blank picture: the share of the most frequent colour is below that of a picture of one colour."""
        counts = self.script("""const gl = wellknitViewer.drawing.gl, c = wellknitViewer.canvas;
            wellknitViewer.drawNow(); const p = new Uint8Array(4 * c.width * c.height);
            gl.readPixels(0, 0, c.width, c.height, gl.RGBA, gl.UNSIGNED_BYTE, p);
            const seen = new Map(); for (let i = 0; i < p.length; i += 4) {
              const k = p[i] << 16 | p[i + 1] << 8 | p[i + 2]; seen.set(k, (seen.get(k) || 0) + 1); }
            return [seen.size, Math.max(...seen.values()) / (p.length / 4)];""")
        self.assertGreater(counts[0], 50)
        self.assertLess(counts[1], 0.8)

    def test_cuts_move_and_take_whole_cells(self):
        before = self.pixels()
        self.choose("v-place", 400)
        moved = self.pixels()
        self.assertNotEqual(before, moved)
        self.choose("v-whole", True)
        whole = self.pixels()
        self.assertNotEqual(moved, whole)
        self.assertEqual(self.script("return wellknitViewer.surface.section.cells.length"), 0)
        self.choose("v-axis", "none")
        self.assertNotEqual(whole, self.pixels())

    def test_section_covers_the_plane(self):
        """Without holes: the areas of a cut's pieces add up to the area of the cut through the box of a grid of boxes."""
        (self.folder / "box.GRDECL").write_text(
            "SPECGRID\n 3 3 3 1 F /\nCOORD\n" + "".join(f"{10 * i} {10 * j} 0 {10 * i} {10 * j} 30\n" for j in range(4) for i in range(4))
            + "/\nZCORN\n" + "".join(f"36*{10 * ((k + 1) // 2)}\n" for k in range(6)) + "/\nPORO\n 27*0.2 /\nPERMX\n 27*100 /\n")
        run(self.folder, "build", "box.GRDECL", "-o", "box.h5")
        self.open("box.h5")
        area = """const p = wellknitViewer.surface.section.points.view(); let sum = 0;
            for (let i = 0; i < p.length; i += 9) { const a = p.slice(i, i + 3), b = p.slice(i + 3, i + 6), c = p.slice(i + 6, i + 9);
              sum += 0.5 * norm(cross(minus(b, a), minus(c, a))); } return sum;"""
        self.assertEqual(self.script(area), 0)
        self.choose("v-axis", "x")
        self.assertAlmostEqual(self.script(area), 900.0, delta=1e-2)  # 30 x 30 m
        self.choose("v-axis", "z")
        self.choose("v-place", 300)
        self.assertAlmostEqual(self.script(area), 900.0, delta=1e-2)

    def test_outside_is_closed(self):
        """With every cell shown the outside has the mesh's boundary faces, and their volume is the mesh's."""
        self.choose("v-axis", "none")
        volume = self.script("""const s = wellknitViewer.surface; let sum = 0;
            for (let f = 0; f < s.first.length; ++f) { if (s.second[f] >= 0) continue;
              const at = (i) => { const v = s.loops[s.faceStart[f] + i]; return [...s.points.slice(3 * v, 3 * v + 3)]; };
              for (let i = 1; i + 1 < s.faceStart[f + 1] - s.faceStart[f]; ++i) sum += dot(at(0), cross(at(i), at(i + 1))) / 6; }
            return Math.abs(sum);""")
        self.assertAlmostEqual(volume / self.check["conservation"]["mesh_bulk"], 1.0, delta=1e-3)

    def test_threshold_and_kinds_choose_cells(self):
        shown = "return wellknitViewer.surface.shown.reduce((a, b) => a + b, 0)"
        self.assertEqual(self.script(shown), self.check["quality"]["cells"])
        self.choose("v-kinds", "")
        self.script("const b = document.querySelector('[data-kind=\"0\"]'); b.click()")
        self.assertEqual(self.script(shown), self.check["quality"]["cells"] - self.check["quality"]["cells_host"])
        self.script("document.querySelector('[data-kind=\"0\"]').click()")
        self.browser.execute_async_script("wellknitViewer.colourBy('knonorth').then(arguments[0])")
        self.choose("v-low", "90")
        few = self.script(shown)
        self.assertGreater(few, 0)
        self.assertLess(few, 1000)
        self.keep("threshold")

    def test_every_array_colours(self):
        before = self.pixels()
        for name in self.script("return wellknitViewer.picture.arrays.map(a => a.name)"):
            self.browser.execute_async_script("wellknitViewer.colourBy(arguments[0]).then(arguments[1])", name)
            if name in ("knonorth", "depth", "volume"):
                now = self.pixels()
                self.assertNotEqual(before, now, name)
                before = now

    def test_a_cell_is_picked(self):
        self.pick_cell("mesh.h5")
        self.keep("picked")

    def test_a_worst_cell_is_shown(self):
        before = self.pixels()
        button = self.browser.find_element(By.CSS_SELECTOR, "button.show")
        self.script("arguments[0].scrollIntoView({block: 'center'})", button)
        button.send_keys(Keys.ENTER)
        end = time.monotonic() + 20
        while not self.script("return document.querySelector('#v-numbers table')") and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.script("return document.getElementById('v-numbers').dataset.cell"), button.get_attribute("data-cell"))
        self.assertNotEqual(before, self.pixels())
        self.keep("worst")


class PublicData(Report):
    def try_case(self, name, *arguments):
        if not (SHARED / "data" / name).exists():
            self.skipTest(f"{name} is not there")
        run(self.folder, "build", *arguments, "-o", f"{name}.h5", "--quiet")
        self.check_figures(self.open(f"{name}.h5"))
        self.keep(name)
        before = self.pixels()
        canvas = self.canvas()
        self.keep(f"{name}-picture")
        self.pick_cell(f"{name}.h5")
        picked = self.pixels()
        self.assertNotEqual(before, picked)  # it is marked
        self.keep(f"{name}-picked")
        ActionChains(self.browser).drag_and_drop_by_offset(canvas, 120, 40).perform()
        turned = self.pixels()
        self.assertNotEqual(picked, turned)
        self.choose("v-place", 400)
        self.assertNotEqual(turned, self.pixels())
        self.keep(f"{name}-cut")
        self.assertEqual([entry for entry in self.browser.get_log("browser") if entry["level"] != "INFO"], [])

    def test_spe9(self):
        self.try_case("spe9", SHARED / "data" / "spe9" / "SPE9_CP.DATA", "--deck-wells", "all", "--radius", "20")

    def test_model5(self):
        self.try_case("model5", SHARED / "data" / "model5" / "MODEL5.DATA", "--deck-wells", "all")

    def test_paper_case(self):
        folder = SHARED / "data" / "nwm"
        self.try_case("nwm", folder / "NWM.data", "--well", f"{folder / 'trajectory.csv'},name=W")


if __name__ == "__main__":
    unittest.main()
