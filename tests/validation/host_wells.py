# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wells in the cells of a corner-point grid with Peaceman's index (key Peaceman1983), projected on the cell's axes;
written into
the mesh file of a host without wells. Computed here, apart from the program's own indices."""
import h5py
import numpy as np

MILLIDARCY = 9.869232667160130e-16  # m2
SAMPLES = 6000


def inverse_bilinear(quad, point):
    """(s, t) of a point in the quad [2 (t), 2 (s), 2], by Newton's method; may lie outside."""
    st = np.array([0.5, 0.5])
    for _ in range(30):
        s, t = st
        here = (1 - t) * ((1 - s) * quad[0, 0] + s * quad[0, 1]) + t * ((1 - s) * quad[1, 0] + s * quad[1, 1])
        by_s = (1 - t) * (quad[0, 1] - quad[0, 0]) + t * (quad[1, 1] - quad[1, 0])
        by_t = (1 - s) * (quad[1, 0] - quad[0, 0]) + s * (quad[1, 1] - quad[0, 1])
        step = np.linalg.solve(np.stack([by_s, by_t], 1), point - here)
        st = st + step
        if np.abs(step).max() < 1e-13:
            break
    return st


def column_of(grid, point, guess):
    """Column (i, j) and (s, t) in it of a point, or None. The guess and its neighbours are looked at first."""
    nz, ny, nx = grid.shape

    def look(i, j):
        if not (0 <= i < nx and 0 <= j < ny):
            return None
        st = inverse_bilinear(grid.pillars_at(point[2], np.s_[j:j + 2, i:i + 2]), point[:2])
        return (i, j, *st) if np.all(st >= -1e-9) and np.all(st <= 1 + 1e-9) else None

    if guess:
        order = sorted(((a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)), key=lambda n: abs(n[0]) + abs(n[1]))
        for a, b in order:
            if found := look(guess[0] + a, guess[1] + b):
                return found
    pillars = grid.pillars_at(point[2])
    middle = 0.25 * (pillars[:-1, :-1] + pillars[1:, :-1] + pillars[:-1, 1:] + pillars[1:, 1:])
    near = np.argsort(np.linalg.norm(middle - point[:2], axis=-1), axis=None)[:12]
    for n in near:
        if found := look(int(n % nx), int(n // nx)):
            return found
    return None


def shares_along(grid, path, ranges=None):
    """{(i, j, k): shares of the cell along its three axes} and {(i, j, k): measured depths} of a path [n, 4]
    (measured depth, x,
    y, depth), in its open ranges."""
    md = np.linspace(path[0, 0], path[-1, 0], SAMPLES + 1)
    points = np.stack([np.interp(md, path[:, 0], path[:, n]) for n in (1, 2, 3)], 1)
    is_open = np.ones(len(md), bool) if ranges is None else np.any([(a <= md) & (md <= b) for a, b in ranges], axis=0)
    where = []
    guess = None
    bounds = grid.zcorn.min(), grid.zcorn.max()
    for n, point in enumerate(points):
        found = column_of(grid, point, guess) if is_open[n] and bounds[0] <= point[2] <= bounds[1] else None
        if found is None:
            where.append(None)
            continue
        i, j, s, t = found
        guess = (i, j)
        levels = grid.column_depths(i, j, s, t)
        k = np.nonzero((levels[:, 0] <= point[2]) & (point[2] <= levels[:, 1]) & (levels[:, 1] > levels[:, 0]))[0]
        if len(k) == 0:
            where.append(None)
            continue
        top, base = levels[k[0]]
        where.append((i, j, int(k[0]), s, t, (point[2] - top) / (base - top)))
    shares, depths = {}, {}
    for n in range(len(md) - 1):
        a, b = where[n], where[n + 1]
        if a is None or b is None:
            continue
        depths.setdefault(a[:3], [md[n], md[n]])[1] = md[n + 1]
        if a[:3] == b[:3]:
            step = np.abs(np.subtract(b[3:], a[3:]))
        else:  # the step that leaves the cell counts as much as the one before it
            before = where[n - 1] if n else None
            is_same = before is not None and before[:3] == a[:3]
            step = np.abs(np.subtract(a[3:], before[3:])) if is_same else np.zeros(3)
        shares[a[:3]] = shares.get(a[:3], np.zeros(3)) + step
    return shares, depths


def peaceman_index(size, permeability, share, bore, skin=0.0):
    """m3 for sizes in m and permeability in m2."""
    index = np.zeros(3)
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        kb, kc = permeability[b], permeability[c]
        if not kb * kc > 0:
            continue
        ratio = np.sqrt(kc / kb)
        radius = 0.28 * np.sqrt(ratio * size[b] ** 2 + size[c] ** 2 / ratio) / (ratio ** 0.5 + ratio ** -0.5)
        index[axis] = 2 * np.pi * np.sqrt(kb * kc) * share[axis] * size[axis] / (np.log(radius / bore) + skin)
    return float(np.linalg.norm(index))


def across_layers(grid, i, j, k, permeability, direction):
    """What a bore that does not stand normal to the layers has of the index of one that does and is as long: the
    permeability in the plane normal to the bore, of a tensor whose axes are those of the layer."""
    along = grid.axes(i, j, k)
    normal = np.cross(along[0], along[1])
    frame = np.linalg.qr(np.stack([along[0], along[1], normal], 1))[0]
    tensor = frame @ np.diag(permeability) @ frame.T
    plane = np.linalg.svd(np.asarray(direction, float)[None, :])[2][1:]
    return float(np.sqrt(np.linalg.det(plane @ tensor @ plane.T) / (permeability[0] * permeability[1])))


def add_well(mesh, grid, name, path, bore, ranges=None, is_injector=False, is_across_layers=False):
    """Adds a well in host cells to the mesh file of the grid itself. `is_across_layers`: of a straight well about
    normal to the layers, with the index of across_layers()."""
    shares, depths = shares_along(grid, path, ranges)
    nz, ny, nx = grid.shape
    with h5py.File(mesh, "r+") as file:
        cell_of = {int(c): n for n, c in enumerate(file["cells/source_cell"][()])}
        rows = []
        for (i, j, k), share in shares.items():
            source = i + nx * (j + ny * k)
            if source not in cell_of:
                continue
            net = float(grid.values.get("NTG", np.ones(grid.shape))[k, j, i])
            rock = np.array([grid.values[key][k, j, i] for key in ("PERMX", "PERMY", "PERMZ")]) * MILLIDARCY
            size = grid.cell_size(i, j, k) * (1, 1, net)
            index = peaceman_index(size, rock, share, bore)
            if is_across_layers and index > 0:
                index *= across_layers(grid, i, j, k, rock, path[-1, 1:] - path[0, 1:])
            if index > 0:
                rows.append((cell_of[source], index, depths[i, j, k]))
        names = [n.decode() for n in file["wells_order"][()]] if "wells_order" in file else []
        if "wells_order" in file:
            del file["wells_order"]
        names = names + [name]
        file["wells_order"] = np.array([n.encode() for n in names])
        group = file.require_group("wells").create_group(name)
        group["trajectory"] = np.asarray(path, float)
        group["connections/cell"] = np.array([r[0] for r in rows], "i8")
        group["connections/well_index"] = np.array([r[1] for r in rows], "f8")
        group["connections/md"] = np.array([r[2] for r in rows], "f8").reshape(-1, 2)
        group.attrs["name"] = np.bytes_(name)
        group.attrs["type"] = np.bytes_("injector" if is_injector else "producer")
        group.attrs["bore_radius"] = float(bore)
        group.attrs["drainage_radius"] = 0.0
    return len(rows)
