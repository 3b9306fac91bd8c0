# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small decks with faults, pinch-outs, multipliers and edits of all kinds, each defined by its seed.

    make_model.py SEED OUT.DATA
"""
import sys

import numpy as np


def geometry(rng):
    """Slanted pillars; every column has a throw of its own or none; some layers without thickness."""
    nx, ny, nz = (int(n) for n in rng.integers([3, 3, 3], [7, 6, 8]))
    x, y = np.meshgrid(np.arange(nx + 1) * 50.0, np.arange(ny + 1) * 40.0)
    slant = rng.normal(0, 3, (2, ny + 1, nx + 1)) * rng.integers(0, 2)
    coord = np.stack([x, y, np.full_like(x, 950.0), x + slant[0], y + slant[1], np.full_like(x, 1200.0)], -1)
    thickness = rng.uniform(2, 8, nz)
    thickness[rng.random(nz) < 0.2] = 0.0
    thickness[0] = max(thickness[0], 2.0)
    tops = 1000 + np.concatenate([[0], np.cumsum(thickness)])
    throw = np.zeros((ny, nx))
    if rng.random() < 0.8:
        throw[:, nx // 2:] += rng.uniform(-12, 12)
    if rng.random() < 0.5:
        throw[ny // 2:, :] += rng.uniform(-6, 6)
    tilt = rng.normal(0, 0.02, 2)
    zcorn = np.empty((nz, 2, ny, 2, nx, 2))
    for k in range(nz):
        for s in range(2):
            for j in range(ny):
                for t in range(2):
                    for i in range(nx):
                        for u in range(2):
                            zcorn[k, s, j, t, i, u] = (tops[k + s] + throw[j, i] + tilt[0] * 50 * (i + u)
                                                       + tilt[1] * 40 * (j + t))
    thin = rng.random((nz, ny, nx)) < 0.1  # cells thinned out from their base
    for k, j, i in np.argwhere(thin):
        zcorn[k, 1, j, :, i, :] = zcorn[k, 0, j, :, i, :] + 0.02 * (zcorn[k, 1, j, :, i, :] - zcorn[k, 0, j, :, i, :])
        if k + 1 < nz:
            zcorn[k + 1, 0, j, :, i, :] = zcorn[k, 1, j, :, i, :]
    return (nx, ny, nz), coord, zcorn


def open_gap(zcorn, seed):
    """In some models all below one layer goes down, in one part of the columns. Its numbers are its own, so that the rest of a seed's model stays."""
    rng = np.random.default_rng([seed, 1])
    if len(zcorn) < 3 or rng.random() < 0.6:
        return
    k = int(rng.integers(1, len(zcorn)))
    zcorn[k:, :, :, :, :int(rng.integers(1, zcorn.shape[4] + 1))] += rng.uniform(0.2, 3)


class Deck:
    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.lines = []
        self.n, self.coord, self.zcorn = geometry(self.rng)
        open_gap(self.zcorn, seed)

    def text(self, *lines):
        self.lines.extend(lines)

    def array(self, keyword, values, form="%.10g"):
        flat = np.asarray(values).ravel()
        self.text(keyword)
        for start in range(0, flat.size, 8):
            self.text(" " + " ".join(form % v for v in flat[start:start + 8]))
        self.text("/")

    def box(self):
        ranges = [sorted(int(v) for v in self.rng.integers(1, n + 1, 2)) for n in self.n]
        return " ".join(str(v) for pair in ranges for v in pair)

    def cell(self):
        return tuple(int(self.rng.integers(1, n + 1)) for n in self.n)

    def maybe(self, probability=0.5):
        return self.rng.random() < probability

    def factor(self):
        return "%.4f" % self.rng.uniform(0.05, 2.0)

    def grid_section(self):
        nx, ny, nz = self.n
        shape = (nz, ny, nx)
        rng = self.rng
        self.text("GRID", "INIT", "GRIDFILE", "0 1 /", "SPECGRID", f"{nx} {ny} {nz} 1 F /")
        self.array("COORD", self.coord)
        self.array("ZCORN", self.zcorn)
        # Flow 2022.10 does not bridge thin inactive cells, as the manual and later versions do: none are made.
        thin = (self.zcorn[:, 1] - self.zcorn[:, 0]).mean(axis=(2, 4)) < 0.5
        self.array("ACTNUM", (thin | (rng.random(shape) > 0.08)).astype(int), "%d")
        self.array("PORO", rng.uniform(0.05, 0.3, shape))
        self.array("PERMX", np.exp(rng.normal(4, 1, shape)))
        self.text("COPY", "PERMX PERMY /", "PERMX PERMZ /", "/", "MULTIPLY", "PERMY 0.7 /", "PERMZ 0.1 /", "/")
        if self.maybe():
            self.array("NTG", rng.uniform(0.3, 1, shape))
        if self.maybe(0.7):
            # Not NOGAP: Flow 2022.10 bridges thick cells all the same.
            self.text("PINCH", ["/", "0.3 GAP 1* TOPBOT TOP /", "0.001 GAP 1* TOPBOT ALL /"][int(rng.integers(0, 3))])
            if self.maybe(0.7):
                self.text("MINPV", "%.1f /" % rng.uniform(50, 400))
        for keyword in ("MULTX", "MULTY", "MULTZ", "MULTX-", "MULTY-", "MULTZ-"):
            if self.maybe(0.4):
                self.text("EQUALS", f"'{keyword}' {self.factor()} {self.box()} /", "/")
        self.faults()
        self.regions(shape)
        if self.maybe(0.5):
            self.array("MULTPV", rng.uniform(0.5, 2, shape))
        self.non_neighbours()

    def faults(self):
        nx, ny, nz = self.n
        self.text("FAULTS", f"'F1' {nx // 2} {nx // 2} 1 {ny} 1 {nz} X /", f"F2 1 {nx} {ny // 2 + 1} {ny // 2 + 1} 1 {nz} 'J-' /",
                  "/", "MULTFLT", f"F1 {self.factor()} /", "/")
        if self.maybe():
            self.text("MULTFLT", f"'F2' {self.factor()} /", "/")

    def regions(self, shape):
        self.array("MULTNUM", self.rng.integers(1, 4, shape), "%d")
        if self.maybe(0.7):
            self.text("MULTREGT", f"1 2 {self.factor()} XYZ ALL M /", f"2 3 {self.factor()} {self.rng.choice(['X', 'XY', 'Z'])} /",
                      "/")
        if self.maybe(0.4):
            self.text("MULTREGP", f"2 {self.factor()} M /", "/")

    def non_neighbours(self):
        """Pairs of cells, each once."""
        pairs = {tuple(sorted((self.cell(), self.cell()))) for _ in range(int(self.rng.integers(0, 5)))}
        pairs = [p for p in sorted(pairs) if p[0] != p[1]]
        if pairs:
            self.text("NNC", *("%d %d %d %d %d %d %.5f /" % (*a, *b, self.rng.uniform(0.01, 5)) for a, b in pairs), "/")

    def edit_section(self):
        self.text("EDIT")
        for keyword in ("TRANX", "TRANY", "TRANZ"):
            if self.maybe(0.35):
                self.text("MULTIPLY", f"'{keyword}' {self.factor()} {self.box()} /", "/")
            if self.maybe(0.2):
                self.text("EQUALS", f"{keyword} 0.75 {self.box()} /", "/")
        if self.maybe(0.3):
            # A pore volume given to a cell without thickness keeps it from being a pinch-out in Flow.
            flat = (self.zcorn[:, 1] == self.zcorn[:, 0]).all(axis=(2, 4)).any()
            self.text(*(["MULTIPLY", f"PORV 1.5 {self.box()} /"] if flat else ["EQUALS", f"PORV 1234.5 {self.box()} /"]), "/")

    def write(self, path):
        nx, ny, nz = self.n
        self.text("RUNSPEC", "DIMENS", f"{nx} {ny} {nz} /", "WATER", "METRIC", "START", "1 JAN 2020 /", "EQLDIMS", "/", "TABDIMS",
                  "/", "GRIDOPTS", "YES 3 /", "UNIFOUT")
        self.grid_section()
        self.edit_section()
        self.text("PROPS", "PVTW", "100 1 1e-5 1 0 /", "ROCK", "100 1e-5 /", "DENSITY", "800 1000 1 /", "SOLUTION", "EQUIL",
                  "1000 100 0 0 0 0 /", "SCHEDULE", "TSTEP", "1 /", "END")
        with open(path, "w", encoding="ascii") as out:
            out.write(f"-- made by make_model.py\n" + "\n".join(self.lines) + "\n")


if __name__ == "__main__":
    Deck(int(sys.argv[1])).write(sys.argv[2])
