# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads what `wellknit --write darts=OUT.npz` (or darts_h5) wrote, and makes a mesh of open-DARTS of it.

    data = load("OUT.npz")                  # a dictionary of numpy arrays; docs/formats/darts.md has their meaning
    mesh = conn_mesh(data)                  # needs the package open-darts
    for name, cells, indices in wells(data):
        well.perforations += [(0, int(cell), index, 0) for cell, index in zip(cells, indices)]
"""
import numpy as np


def load(path):
    """Arrays by name, from either file."""
    with open(path, "rb") as file:
        is_zip = file.read(4) == b"PK\x03\x04"
    if is_zip:
        with np.load(path) as file:
            return {name: file[name] for name in file.files}
    import h5py
    with h5py.File(path, "r") as file:
        return {name: file[name][()] for name in file}


def wells(data):
    """(name, cells, well indices) of each well."""
    start = data["well_start"]
    for n, name in enumerate(data["well_name"]):
        own = slice(start[n], start[n + 1])
        yield name.decode("utf-8"), data["well_cell"][own], data["well_index"][own]


def conn_mesh(data, heat_capacity=2200.0, rock_conduction=181.44):
    """A conn_mesh with volumes, depths, porosities; heat capacity in kJ/m3/K, conduction in kJ/m/day/K."""
    from darts.engines import conn_mesh as Mesh, index_vector, value_vector
    if max(data["block_m"].max(), data["block_p"].max()) + 1 != len(data["volume"]):
        raise ValueError("the last cell has no connection: open-DARTS would not count it")
    mesh = Mesh()
    mesh.init(index_vector(data["block_m"]), index_vector(data["block_p"]), value_vector(data["tran"]),
              value_vector(data["tranD"]))
    for name in ("volume", "depth", "poro"):
        np.array(getattr(mesh, name), copy=False)[:] = data[name]
    np.array(mesh.heat_capacity, copy=False)[:] = heat_capacity
    np.array(mesh.rock_cond, copy=False)[:] = rock_conduction
    np.array(mesh.op_num, copy=False)[:] = 0
    return mesh
