#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_binary_grid.py FILE FOLDER: the arrays that were read from FILE, raw and in SI in FOLDER (NAME.f8, NAME.i4, NAME.u1), are
those that this reader of its own finds in the file: the same numbers, not nearly the same. Where the module opm.io.ecl is there, its
reader is asked too."""

import pathlib
import struct
import sys

import numpy as np

MILLIDARCY = 9.869232667160130e-13 * 1e-3


def arrays(path):
    data = path.read_bytes()
    at, out = 0, {}
    while at < len(data):
        size, name, count, kind, end = struct.unpack_from(">i8si4si", data, at)
        assert size == end == 16, f"no header at byte {at}"
        at += 24
        blocks = b""
        width = {b"INTE": 4, b"REAL": 4, b"LOGI": 4, b"DOUB": 8, b"CHAR": 8}[kind]
        while len(blocks) < count * width:
            size, = struct.unpack_from(">i", data, at)
            blocks += data[at + 4:at + 4 + size]
            at += size + 8
        form = {b"INTE": ">i4", b"REAL": ">f4", b"LOGI": ">i4", b"DOUB": ">f8", b"CHAR": "S8"}[kind]
        out[name.decode().strip()] = np.frombuffer(blocks, form)
    return out


def main():
    path, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    found = arrays(path)
    length = 1.0
    if "GRIDUNIT" in found:
        length = {b"METRES": 1.0, b"FEET": 0.3048}[found["GRIDUNIT"][0].strip()]
    factors = {"COORD": length, "ZCORN": length, "PERMX": MILLIDARCY, "PERMY": MILLIDARCY, "PERMZ": MILLIDARCY}
    try:
        from opm.io.ecl import EclFile
        other = EclFile(str(path))
    except ImportError:
        other = None
    compared = 0
    for name in ("COORD", "ZCORN", "ACTNUM", "PORO", "PERMX", "PERMY", "PERMZ", "SATNUM", "PVTNUM", "EQLNUM", "FIPNUM"):
        files = list(folder.glob(name + ".*"))
        if name not in found or not files:
            continue
        kind = files[0].suffix[1:]
        ours = np.fromfile(files[0], kind)
        values = found[name].astype("f8" if kind == "f8" else kind)
        expected = values * factors[name] if name in factors else values
        assert ours.shape == expected.shape, f"{name}: {ours.shape} values in place of {expected.shape}"
        assert np.array_equal(ours, expected), f"{name}: {np.abs(ours - expected).max()} at most"
        if other is not None:
            assert np.array_equal(np.array(other[name]).astype(values.dtype), values), f"{name}: opm.io.ecl differs"
        compared += 1
    assert compared >= 3, f"only {compared} arrays were compared"


main()
