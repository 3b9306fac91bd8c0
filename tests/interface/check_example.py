#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the Fortran example and compares what it prints with the mesh file that it writes.

    check_example.py PROGRAM CASE TRAJECTORY OUT.h5
"""
import subprocess
import sys

import h5py
import numpy as np

program, *arguments = sys.argv[1:]
printed = subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout.split()
with h5py.File(arguments[-1]) as mesh:
    volume, transmissibility = mesh["cells/volume"][:], mesh["connections/transmissibility"][:]
print(*printed)
assert [int(word) for word in printed[:2]] == [len(volume), len(transmissibility)], (len(volume), len(transmissibility))
np.testing.assert_allclose([float(word) for word in printed[2:]], [volume.sum(), transmissibility.max()], rtol=1e-13)
wrong = subprocess.run([program, "nowhere.GRDECL", *arguments[1:]], check=False, capture_output=True, text=True)
assert wrong.returncode != 0 and "nowhere.GRDECL" in wrong.stdout, wrong
