#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_grid_samples.py FOLDER: writes one small faulted grid in every form that the readers know, into FOLDER/ecl and
FOLDER/roff. It shares no code with the readers. Every number is exact in single precision, so that all forms hold the same
grid; testdata/ecl/fault.GRDECL is its text.

The grid: 3 x 2 x 3 cells of 64 x 32 m, pillars that lean, a fault with a throw of 8 m between i = 2 and i = 3, a gap of 1 m
between layers 2 and 3, cell 1 1 1 inactive."""

import pathlib
import struct
import sys

import numpy as np

NX, NY, NZ = 3, 2, 3
ORIGIN = np.array([460000.0, 5930000.0])
TOP, BOTTOM = 1000.0, 1128.0
LAYERS = [(1000.0, 1008.0), (1008.0, 1020.0), (1021.0, 1037.0)]


def pillar(i, j):
    """Top and bottom point; it leans by 8 m in x and 16 m in y."""
    x, y = ORIGIN + [64.0 * i, 32.0 * j]
    return [x, y, TOP], [x + 8.0, y + 16.0, BOTTOM]


def depth(i, j, k, di, dj, dk):
    throw = 8.0 if i == 2 else 0.0
    return LAYERS[k][dk] + throw + 0.5 * (i + di) + 0.25 * (j + dj)


def arrays():
    coord = np.array([pillar(i, j) for j in range(NY + 1) for i in range(NX + 1)]).ravel()
    zcorn = np.array([depth(i, j, k, di, dj, dk)
                      for k in range(NZ) for dk in (0, 1) for j in range(NY) for dj in (0, 1)
                      for i in range(NX) for di in (0, 1)])
    cells = np.arange(NX * NY * NZ)
    return {"coord": coord, "zcorn": zcorn, "actnum": np.where(cells == 0, 0, 1), "poro": 0.125 + cells / 128.0,
            "permx": 100.0 + cells, "permz": 10.0 + cells / 2.0, "satnum": 1 + cells % 2}


# -- GRDECL ------------------------------------------------------------------------------------------------------------------

def grdecl(a):
    def block(name, values):
        return name + "\n" + "\n".join(" " + repr(v) for v in values.tolist()) + "\n/\n"
    return ("-- one faulted grid in many forms: see tools/make_grid_samples.py\n"
            f"MAPAXES\n 0 1 0 0 1 0 /\nGRIDUNIT\n METRES /\nSPECGRID\n {NX} {NY} {NZ} 1 F /\n"
            + block("COORD", a["coord"]) + block("ZCORN", a["zcorn"]) + block("ACTNUM", a["actnum"])
            + block("PORO", a["poro"]) + block("PERMX", a["permx"]) + block("PERMZ", a["permz"])
            + block("SATNUM", a["satnum"]))


# -- Eclipse arrays ----------------------------------------------------------------------------------------------------------

def binary_array(name, kind, values, order=">"):
    """Header and blocks of at most 1000 numbers or 105 texts."""
    frame = lambda data: struct.pack(order + "i", len(data)) + data + struct.pack(order + "i", len(data))
    out = frame(name.ljust(8).encode() + struct.pack(order + "i", len(values)) + kind.encode())
    size = 105 if kind == "CHAR" else 1000
    for n in range(0, len(values), size):
        part = values[n:n + size]
        if kind == "CHAR":
            out += frame(b"".join(v.ljust(8).encode() for v in part))
        else:
            out += frame(np.asarray(part).astype(order + {"INTE": "i4", "REAL": "f4", "DOUB": "f8", "LOGI": "i4"}[kind]).tobytes())
    return out


def formatted_array(name, kind, values, _order=None):
    out = f" '{name:<8}' {len(values):11d} '{kind}'\n"
    form, columns = {"INTE": (" {:11d}", 6), "REAL": (" {:16.8E}", 4), "DOUB": (" {:22.14E}", 3), "CHAR": (" '{:<8}'", 7),
                     "LOGI": ("  {}", 25)}[kind]
    texts = [form.format(("T" if v else "F") if kind == "LOGI" else v) for v in
             (values.tolist() if isinstance(values, np.ndarray) else values)]
    if kind == "DOUB":
        texts = [t.replace("E", "D") for t in texts]
    for n in range(0, len(texts), columns):
        out += "".join(texts[n:n + columns]) + "\n"
    return out.encode()


def egrid(a, array, order=">"):
    filehead = [0] * 100
    filehead[0:2] = 3, 2007
    gridhead = [0] * 100
    gridhead[0:4] = 1, NX, NY, NZ
    gridhead[24] = 1
    return b"".join(array(*r, order) for r in [
        ("FILEHEAD", "INTE", filehead), ("MAPUNITS", "CHAR", ["METRES"]), ("MAPAXES", "REAL", np.array([0., 1, 0, 0, 1, 0])),
        ("GRIDUNIT", "CHAR", ["METRES", ""]), ("GRIDHEAD", "INTE", gridhead), ("COORD", "REAL", a["coord"]),
        ("COORDSYS", "INTE", [1, NZ, 0, 0, 0, 0]), ("ZCORN", "REAL", a["zcorn"]), ("ACTNUM", "INTE", a["actnum"]),
        ("ENDGRID", "INTE", []), ("NNCHEAD", "INTE", [1] + [0] * 9), ("NNC1", "INTE", [2]), ("NNC2", "INTE", [9])])


def grid_file(a, array):
    out = [("DIMENS", "INTE", [NX, NY, NZ]), ("RADIAL", "CHAR", ["FALSE"]), ("MAPUNITS", "CHAR", ["METRES"]),
           ("MAPAXES", "REAL", np.array([0., 1, 0, 0, 1, 0])), ("GRIDUNIT", "CHAR", ["METRES", ""])]
    number = 0
    for k in range(NZ):
        for j in range(NY):
            for i in range(NX):
                number += 1
                corners = []
                for dk in (0, 1):
                    for dj in (0, 1):
                        for di in (0, 1):
                            top, bottom = (np.array(p) for p in pillar(i + di, j + dj))
                            z = depth(i, j, k, di, dj, dk)
                            corners.append(top + (z - top[2]) / (bottom[2] - top[2]) * (bottom - top))
                out += [("COORDS", "INTE", [i + 1, j + 1, k + 1, number, int(a["actnum"][number - 1]), 0, 0]),
                        ("CORNERS", "REAL", np.array(corners).ravel())]
    return b"".join(array(*r) for r in out)


def init(a, array):
    active = a["actnum"] == 1
    intehead = [0] * 100
    intehead[2] = 1
    intehead[8:12] = NX, NY, NZ, int(active.sum())
    intehead[14] = 7
    porv = np.where(active, 64.0 * 32.0 * 8.0 * a["poro"], 0.0)
    return b"".join(array(*r) for r in [
        ("INTEHEAD", "INTE", intehead), ("LOGIHEAD", "LOGI", [False, True]), ("DOUBHEAD", "DOUB", np.array([0.0, 1.5])),
        ("PORV", "REAL", porv), ("PORO", "REAL", a["poro"][active]), ("PERMX", "REAL", a["permx"][active]),
        ("PERMZ", "REAL", a["permz"][active]), ("SATNUM", "INTE", a["satnum"][active])])


def binary_grdecl(a, order=">"):
    return b"".join(binary_array(*r, order) for r in [
        ("MAPAXES", "REAL", np.array([0., 1, 0, 0, 1, 0])), ("SPECGRID", "INTE", [NX, NY, NZ, 1]), ("COORD", "REAL", a["coord"]),
        ("ZCORN", "REAL", a["zcorn"]), ("ACTNUM", "INTE", a["actnum"]), ("PORO", "REAL", a["poro"]),
        ("PERMX", "REAL", a["permx"]), ("PERMZ", "DOUB", a["permz"]), ("SATNUM", "INTE", a["satnum"])])


# -- ROFF --------------------------------------------------------------------------------------------------------------------

class Roff:
    """Keys of tags as bytes; order is '<', '>' or 'ascii'."""

    def __init__(self, order, filetype):
        self.order = order
        self.ascii = order == "ascii"
        self.out = b"roff-asc\n" if self.ascii else b"roff-bin\0"
        self.words("#ROFF file#") if not self.ascii else self.line("#ROFF file#")
        self.words("#Creator: tools/make_grid_samples.py#") if not self.ascii else self.line("#Creator: tools/make_grid_samples.py#")
        self.tag("filedata", ("int", "byteswaptest", 1), ("char", "filetype", filetype),
                 ("char", "creationDate", "01/01/2026 00:00:00"))
        self.tag("version", ("int", "major", 2), ("int", "minor", 0))

    def words(self, *words):
        self.out += b"".join(w.encode() + b"\0" for w in words)

    def line(self, text):
        self.out += text.encode() + b"\n"

    def number(self, kind, values):
        form = {"int": "i4", "float": "f4", "double": "f8", "bool": "u1", "byte": "u1"}[kind]
        return np.asarray(values).astype(self.order + form).tobytes()

    def tag(self, name, *keys):
        self.line("tag " + name) if self.ascii else self.words("tag", name)
        for kind, key, value in keys:
            is_array = isinstance(value, np.ndarray)
            if self.ascii:
                if kind == "char":
                    self.line(f'char {key} "{value}"')
                elif is_array:
                    self.line(f"array {kind} {key} {len(value)}")
                    form = "{:d}" if kind in ("int", "bool", "byte") else "{:.9E}"
                    texts = [form.format(v) for v in value.tolist()]
                    for n in range(0, len(texts), 6):
                        self.line(" ".join(texts[n:n + 6]))
                else:
                    self.line(f"{kind} {key} {value}")
            elif kind == "char":
                self.words(kind, key, value)
            elif is_array:
                self.words("array", kind, key)
                self.out += self.number("int", len(value)) + self.number(kind, value)
            else:
                self.words(kind, key)
                self.out += self.number(kind, value)
        self.line("endtag") if self.ascii else self.words("endtag")

    def bytes(self):
        self.tag("eof")
        return self.out


def turned(values):
    """From i fastest, k down, to k fastest, k up."""
    return np.ascontiguousarray(values.reshape(NZ, NY, NX).transpose(2, 1, 0)[:, :, ::-1]).ravel()


def node_depths(i, j, level):
    """What the eight cells around a node have there: below and above; south-west, south-east, north-west, north-east. Nothing
    for a cell outside."""
    found = []
    for above in (0, 1):
        for north in (0, 1):
            for east in (0, 1):
                ci, cj, ck = i - 1 + east, j - 1 + north, NZ - level - above
                inside = 0 <= ci < NX and 0 <= cj < NY and 0 <= ck < NZ
                found.append(depth(ci, cj, ck, 1 - east, 1 - north, above) if inside else None)
    return found


def split_of(found):
    """The fewest depths that say it, and they themselves."""
    def one(values):
        values = {v for v in values if v is not None}
        return len(values) <= 1, (values.pop() if values else 0.0)
    for groups in ([range(8)], [range(4), range(4, 8)], [(q, q + 4) for q in range(4)]):
        tried = [one([found[n] for n in group]) for group in groups]
        if all(ok for ok, _ in tried):
            return [value for _, value in tried]
    return [0.0 if v is None else v for v in found]


def roff_grid(a, order):
    lines, splits, depths = [], [], []
    for i in range(NX + 1):
        for j in range(NY + 1):
            top, bottom = pillar(i, j)
            for point in (bottom, top):
                lines += [point[0] - ORIGIN[0], point[1] - ORIGIN[1], -point[2]]
            for level in range(NZ + 1):
                values = split_of(node_depths(i, j, level))
                splits.append(len(values))
                depths += [-v for v in values]
    out = Roff(order, "grid")
    out.tag("dimensions", ("int", "nX", NX), ("int", "nY", NY), ("int", "nZ", NZ))
    out.tag("translate", ("float", "xoffset", ORIGIN[0]), ("float", "yoffset", ORIGIN[1]), ("float", "zoffset", 0.0))
    out.tag("scale", ("float", "xscale", 1.0), ("float", "yscale", 1.0), ("float", "zscale", -1.0))
    out.tag("subgrids", ("int", "nLayers", np.array([1, 2])))
    out.tag("cornerLines", ("float", "data", np.array(lines)))
    out.tag("zvalues", ("byte", "splitEnz", np.array(splits)), ("float", "data", np.array(depths)))
    out.tag("active", ("bool", "data", turned(a["actnum"])))
    assert set(splits) == {1, 2, 4, 8}
    return out.bytes()


def roff_parameters(a, order):
    out = Roff(order, "parameter")
    out.tag("dimensions", ("int", "nX", NX), ("int", "nY", NY), ("int", "nZ", NZ))
    poro = turned(a["poro"]).copy()
    poro[turned(a["actnum"]) == 0] = -999.0
    for name, kind, values in [("PORO", "float", poro), ("PERMX", "double", turned(a["permx"])),
                               ("PERMZ", "float", turned(a["permz"])), ("SATNUM", "byte", turned(a["satnum"]))]:
        out.tag("parameter", ("char", "name", name), (kind, "data", values))
    return out.bytes()


def main():
    folder = pathlib.Path(sys.argv[1])
    a = arrays()
    files = {
        "ecl/fault.GRDECL": grdecl(a).encode(),
        "ecl/fault.EGRID": egrid(a, binary_array), "ecl/fault.FEGRID": egrid(a, formatted_array),
        "ecl/little_endian.EGRID": egrid(a, binary_array, "<"),
        "ecl/cells.GRID": grid_file(a, binary_array), "ecl/cells.FGRID": grid_file(a, formatted_array),
        "ecl/fault.INIT": init(a, binary_array), "ecl/formatted.FINIT": init(a, formatted_array),
        "ecl/fault.bgrdecl": binary_grdecl(a), "ecl/little_endian.bgrdecl": binary_grdecl(a, "<"),
        "roff/grid.roff": roff_grid(a, "<"), "roff/grid_big_endian.roff": roff_grid(a, ">"),
        "roff/grid.roffasc": roff_grid(a, "ascii"),
        "roff/rock.roff": roff_parameters(a, "<"), "roff/rock_big_endian.roff": roff_parameters(a, ">"),
        "roff/rock.roffasc": roff_parameters(a, "ascii"),
    }
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
