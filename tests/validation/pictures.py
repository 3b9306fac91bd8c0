# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""SVG pictures of the results, by matplotlib where it is installed. The same results give the same bytes."""
import numpy as np

from fields import closer

try:
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
except ImportError:
    plt = None

COLOURS = {"knit": "#0b6e99", "knit_consistent": "#5fb0d3", "corner_point": "#c2571a", "finer": "#7a7a7a"}
LABELS = {"knit": "wellknit", "knit_consistent": "wellknit, consistent fluxes", "corner_point": "corner point, Peaceman", "finer": "4 × 4 finer"}
LIMITS = {0.0: 0.5, 0.5: 1.0, 1.0: 2.0}  # %, of Thiem's rate


def save(figure, path):
    figure.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    plt.close(figure)


def bars(axes, rows, title, limit=None):
    """Errors of the rates of the first well, in %."""
    names = list(rows)
    place = np.arange(len(names))
    for n, mesh in enumerate(COLOURS):
        values = [100 * rows[r][mesh]["errors"][0] for r in names]
        axes.bar(place + 0.21 * (n - 1.5), values, 0.2, color=COLOURS[mesh], label=LABELS[mesh])
    if limit:
        for x, value in zip(place, limit):
            for y in (value, -value):
                axes.plot([x - 0.45, x + 0.45], [y, y], "k:", lw=1)
    axes.axhline(0, color="k", lw=0.6)
    axes.set_xticks(place, [r.replace(", ", "\n") for r in names], fontsize=6)
    axes.set_ylabel("error of the rate, %")
    axes.set_title(title, fontsize=9)


def thiem(rows, folder):
    figure, axes = plt.subplots(figsize=(8, 3.2))
    bars(axes, rows, "Thiem flow; dotted: the limits 0.5, 1 and 2 %", [LIMITS[float(r.split()[-1])] for r in rows])
    axes.legend(fontsize=7)
    save(figure, folder / "validation_thiem.svg")


def line(rows, folder):
    figure, every = plt.subplots(1, 3, figsize=(9, 2.8), sharey=True)
    for axes, deform in zip(every, ("0", "0.5", "1")):
        for mesh in reversed(COLOURS):
            points = np.array(rows[f"50 m, deform {deform}"][mesh]["line"]).reshape(-1, 2)
            axes.plot(points[:, 0], 100 * points[:, 1], ".-", ms=3, lw=0.6, color=COLOURS[mesh], label=LABELS[mesh])
        axes.set_title(f"deform {deform}", fontsize=9)
        axes.set_xlabel("distance from the well, m")
    every[0].set_ylabel("error of the pressure,\n% of the drawdown")
    every[0].legend(fontsize=6)
    save(figure, folder / "validation_line.svg")


def wells(rows, folder):
    figure, every = plt.subplots(2, 1, figsize=(8, 5.5))
    for axes, kind in zip(every, ("slanted", "horizontal")):
        bars(axes, {k.replace(f"{kind}, ", ""): v for k, v in rows.items() if k.startswith(kind)}, f"{kind} well")
    every[0].legend(fontsize=7)
    figure.tight_layout()
    save(figure, folder / "validation_line_wells.svg")


def patch(result, folder):
    figure, every = plt.subplots(1, 3, figsize=(9, 2.8), sharey=True)
    for axes, (deform, row) in zip(every, result.items()):
        for kinds, values in row["knit"]["quantiles"].items():
            axes.plot(np.linspace(0, 100, len(values)), 100 * np.array(values), lw=1, label=kinds)
        axes.set_title(f"deform {deform}", fontsize=9)
        axes.set_xlabel("% of the connections below")
    every[0].set_ylabel("flux error at a linear pressure, %")
    every[-1].legend(fontsize=6)
    save(figure, folder / "validation_patch.svg")


def field(name, result, folder):
    figure, every = plt.subplots(1, 2, figsize=(9, 3.2))
    for axes, (boundary, title) in zip(every, (("closed", "closed sides"), ("sides", "sides held"))):
        errors, share = closer(result, boundary, "finer4")
        place = np.arange(len(errors))
        for n, mesh in enumerate(("knit", "corner_point")):
            values = [100 * e[n] for e in errors.values()]
            axes.bar(place + 0.4 * (n - 0.5), values, 0.38, color=COLOURS[mesh], label=LABELS[mesh])
        axes.axhline(0, color="k", lw=0.6)
        axes.set_xticks(place, list(errors), rotation=90, fontsize=5)
        axes.set_title(f"{name}, {title}: closer {100 * share:.0f} %", fontsize=9)
    every[0].set_ylabel("rate less that of 4 × 4, %")
    every[0].legend(fontsize=6)
    save(figure, folder / f"validation_{name.lower()}.svg")


def write(results, folder):
    if plt is None:
        print("matplotlib is not installed: no pictures")
        return
    matplotlib.rcParams.update({"svg.hashsalt": "wellknit", "svg.fonttype": "none", "font.size": 8})
    folder.mkdir(exist_ok=True)
    if "thiem" in results:
        thiem(results["thiem"], folder)
        line(results["thiem"], folder)
    if "line_wells" in results:
        wells(results["line_wells"], folder)
    if "patch" in results:
        patch(results["patch"], folder)
    for name in ("SPE9", "MODEL5"):
        if f"field_{name}" in results:
            field(name, results[f"field_{name}"], folder)
