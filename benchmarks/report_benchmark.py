#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of one mesh file against its limits: 30 MB, written in 3 s, first view in 3 s in Chromium without a graphics card.

    report_benchmark.py WELLKNIT MESH.h5

The first view is the time from the page's start to the frame in which the picture stands; a turn is one step of the arrow keys until it is drawn.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

LIMITS = {"size, MB": 30.0, "written, s": 3.0, "first view, s": 3.0}


def main():
    program, mesh = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "report.html"
        begin = time.monotonic()
        subprocess.run([program, "report", mesh, "-o", page], check=True, capture_output=True)
        found = {"size, MB": page.stat().st_size / 1e6, "written, s": time.monotonic() - begin}
        options = Options()
        options.binary_location = shutil.which("chromium")
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                         "--enable-unsafe-swiftshader", "--window-size=1400,1000"):
            options.add_argument(argument)
        browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        try:
            browser.get("about:blank")
            begin = time.monotonic()
            browser.get(page.as_uri())
            while browser.execute_script("return document.documentElement.dataset.picture") != "ready":
                if time.monotonic() - begin > 120:
                    sys.exit("the picture was not drawn in 120 s")
                time.sleep(0.01)
            browser.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))")
            found["first view, s"] = time.monotonic() - begin
            canvas = browser.find_element(By.ID, "v-canvas")
            browser.execute_script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].focus()", canvas)
            steps, begin = 10, time.monotonic()
            for _ in range(steps):
                canvas.send_keys(Keys.ARROW_LEFT)
                browser.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))")
            turn = (time.monotonic() - begin) / steps
        finally:
            browser.quit()
    for name, value in found.items():
        print(f"{name:<14} {value:8.2f}  limit {LIMITS[name]:5.1f}  ratio {value / LIMITS[name]:.2f}")
    print(f"{'a turn, s':<14} {turn:8.2f}")


if __name__ == "__main__":
    main()
