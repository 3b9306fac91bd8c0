#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads RMS wells by itself and compares them with what the library read.

    check_rms_wells.py WELL.w READ.txt

READ.txt: the name on the first line, then `x y depth measured_depth` a station, with all digits. Exit 1 at a difference.
"""
import math
import sys


def stations_of(path):
    """Name and different points of the well in this file, in order; knows nothing of the library."""
    with open(path, encoding="latin-1") as file:
        rows = [line.split() for line in file]
    name, logs = rows[2][0], int(rows[3][0])
    points = []
    for row in rows[4 + logs :]:
        if not row:
            continue
        assert len(row) == 3 + logs, row
        point = tuple(float(number) for number in row[:3])
        if not points or math.dist(point, points[-1]) > 1e-6:
            points.append(point)
    return name, points


def main():
    name, points = stations_of(sys.argv[1])
    with open(sys.argv[2], encoding="utf-8") as file:
        found_name = file.readline().strip()
        found = [[float(number) for number in line.split()] for line in file]
    if found_name != name or len(found) != len(points):
        sys.exit(f"{found_name} with {len(found)} stations, expected {name} with {len(points)}")
    length = 0.0
    for n, (point, read) in enumerate(zip(points, found)):
        length += math.dist(point, points[n - 1]) if n > 0 else 0.0
        if tuple(read[:3]) != point or abs(read[3] - length) > 1e-9 * max(1.0, length):
            sys.exit(f"station {n}: {read}, expected {point} at {length}")
    print(f"{name}: {len(points)} stations, {length:.3f} m")


if __name__ == "__main__":
    main()
