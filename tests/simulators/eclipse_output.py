# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of Eclipse's unformatted output files, read without any library but numpy."""
import struct

import numpy as np

TYPES = {b"INTE": ">i4", b"REAL": ">f4", b"DOUB": ">f8", b"LOGI": ">i4"}


def arrays(path):
    """The first array of each name."""
    data = open(path, "rb").read()
    at = 0
    found = {}
    while at < len(data):
        name, count, kind = struct.unpack(">8si4s", data[at + 4:at + 20])
        at += 24
        size = 8 if kind in (b"DOUB", b"CHAR") else int(kind[1:]) if kind.startswith(b"C0") else 4
        pieces = []
        left = count
        while left > 0:
            length = struct.unpack(">i", data[at:at + 4])[0]
            pieces.append(data[at + 4:at + 4 + length])
            at += length + 8
            left -= length // size
        if kind in TYPES:
            found.setdefault(name.decode().strip(), np.frombuffer(b"".join(pieces), TYPES[kind]))
    return found
