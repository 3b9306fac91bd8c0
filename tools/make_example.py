#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the shipped example: a deformed corner-point model with one curved and one steep well.

    make_example.py [FOLDER]     (testdata/example by default)
writes example.GRDECL, curved.csv and steep.dev. No randomness and no module beyond the standard library: the same bytes each time.

The model is a dome of 24 x 24 x 16 cells of about 30 m x 30 m x 10 m, with undulating layers of uneven thickness and slanted pillars.
Depth is positive down; metres and millidarcy.
"""
import math
import pathlib
import sys

NX, NY, NZ = 24, 24, 16
CELL = 30.0  # m, along i and j
LAYER = 10.0  # m, mean thickness
TOP = 2000.0  # m, mean depth of the top
WIDTH = NX * CELL

# Rock of each layer, top to base: porosity, permeability in millidarcy.
ROCK = [(0.24, 320), (0.22, 210), (0.19, 90), (0.23, 260), (0.25, 410), (0.17, 45), (0.20, 130), (0.22, 230),
        (0.24, 350), (0.18, 60), (0.21, 170), (0.23, 280), (0.16, 30), (0.20, 140), (0.22, 220), (0.19, 100)]
VERTICAL_TO_HORIZONTAL = 0.1


def structure(x, y):
    """Depth of the top at (x, y), m: a dome off the centre, gentle waves, and a regional dip; layers dip by up to 12 degrees."""
    dome = -26.0 * math.exp(-((x - 330.0) ** 2 + (y - 390.0) ** 2) / (2.0 * 170.0**2))
    waves = 2.0 * math.sin(2.0 * math.pi * x / 310.0) * math.cos(2.0 * math.pi * y / 370.0)
    return TOP + dome + waves + 0.02 * (x - y)


def horizon(k, x, y):
    """Depth of the interface above layer k (k = NZ: the base) at (x, y), m."""
    depth = structure(x, y)
    for layer in range(k):
        phase = 0.9 * layer
        depth += LAYER * (1.0 + 0.12 * math.sin(2.0 * math.pi * x / WIDTH + phase) * math.cos(1.5 * math.pi * y / WIDTH - phase))
    return depth


def pillar(i, j):
    """Top and bottom point of pillar (i, j), 100 m above and below the reservoir; slants up to about 5 degrees."""
    x, y = CELL * i, CELL * j
    high, low = TOP - 100.0, TOP + NZ * LAYER + 100.0
    half = 0.5 * (low - high)
    slant_x = 0.06 * math.cos(2.0 * math.pi * y / WIDTH) + 0.02
    slant_y = 0.05 * math.sin(2.0 * math.pi * x / WIDTH)
    return (x - half * slant_x, y - half * slant_y, high), (x + half * slant_x, y + half * slant_y, low)


def coord():
    for j in range(NY + 1):
        for i in range(NX + 1):
            for point in pillar(i, j):
                yield from ("%.3f" % c for c in point)


def zcorn():
    """Every cell takes the depths of its horizons at the undisturbed node of each pillar: no faults, so neighbours agree."""
    node = [[["%.2f" % horizon(k, CELL * i, CELL * j) for i in range(NX + 1)] for j in range(NY + 1)] for k in range(NZ + 1)]
    for k in range(2 * NZ):
        for j in range(2 * NY):
            for i in range(2 * NX):
                yield node[(k + 1) // 2][(j + 1) // 2][(i + 1) // 2]


def write_array(out, keyword, values):
    out.write(keyword + "\n")
    line = []
    for value in values:
        line.append(value)
        if len(line) == 12:
            out.write(" ".join(line) + "\n")
            line = []
    if line:
        out.write(" ".join(line) + "\n")
    out.write("/\n\n")


def write_grid(path):
    layer = NX * NY
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write("-- The example of wellknit, made by tools/make_example.py: a dome with uneven layers and slanted pillars.\n")
        out.write("-- Metres, depth down; millidarcy.\n\n")
        out.write("SPECGRID\n%d %d %d 1 F /\n\n" % (NX, NY, NZ))
        write_array(out, "COORD", coord())
        write_array(out, "ZCORN", zcorn())
        out.write("ACTNUM\n%d*1 /\n\n" % (layer * NZ))
        write_array(out, "PORO", ("%d*%.2f" % (layer, porosity) for porosity, _ in ROCK))
        for keyword, factor in (("PERMX", 1.0), ("PERMY", 1.0), ("PERMZ", VERTICAL_TO_HORIZONTAL)):
            write_array(out, keyword, ("%d*%g" % (layer, factor * perm) for _, perm in ROCK))


def curved_well():
    """Stations (md, x, y, depth) every 10 m: builds from 45 to 80 degrees while it turns by 25, then holds its angle."""
    x, y = 190.0, 400.0
    depth = 0.5 * (horizon(4, x, y) + horizon(5, x, y))
    step, build_length, length = 0.1, 125.0, 260.0
    stations, md = [], 0.0
    count = round(length / step)
    for n in range(count + 1):
        if n % 100 == 0:
            stations.append((md, x, y, depth))
        share = min(1.0, (md + 0.5 * step) / build_length)
        inclination = math.radians(45.0 + 35.0 * share)
        azimuth = math.radians(75.0 + 25.0 * share)  # from the y axis towards the x axis
        x += step * math.sin(inclination) * math.sin(azimuth)
        y += step * math.sin(inclination) * math.cos(azimuth)
        depth += step * math.cos(inclination)
        md = (n + 1) * step
    return stations


def steep_well():
    """Stations (md, x, y, depth) every 20 m: nearly vertical, from 30 m above the top to 30 m below the base."""
    x, y = 565.0, 195.0
    depth, end = structure(x, y) - 30.0, horizon(NZ, x, y) + 30.0
    inclination, azimuth = math.radians(4.0), math.radians(210.0)
    slope = math.tan(inclination)
    stations, md = [], 1950.0
    while True:
        stations.append((md, x, y, depth))
        if depth >= end:
            return stations
        step = min(20.0, (end - depth) / math.cos(inclination) + 1e-9)
        drop = step * math.cos(inclination)
        x += drop * slope * math.sin(azimuth)
        y += drop * slope * math.cos(azimuth)
        depth += drop
        md += step


def write_csv(path, stations):
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write("MD,X,Y,TVD\n")
        for station in stations:
            out.write("%.2f,%.3f,%.3f,%.3f\n" % station)


def write_dev(path, name, stations):
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write("WELLNAME: %s\n#      X           Y         TVD          MD\n" % name)
        for md, x, y, depth in stations:
            out.write("%11.3f %11.3f %11.3f %11.3f\n" % (x, y, depth, md))
        out.write("-999\n")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "testdata" / "example"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    write_grid(folder / "example.GRDECL")
    write_csv(folder / "curved.csv", curved_well())
    write_dev(folder / "steep.dev", "steep", steep_well())


if __name__ == "__main__":
    main()
