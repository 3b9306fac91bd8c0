# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Public models as single-phase problems: geometry and rock of the deck, no multipliers, wells on pressure."""
import pathlib
import re

import h5py
import numpy as np

import host_wells
import hosts
import meshes

FOOT = 0.3048
MODELS = {"SPE9": ("spe9/SPE9_CP.DATA", ("spe9/SPE9.GRDECL",), FOOT, 30.0),
          "MODEL5": ("model5/MODEL5.DATA", ("model5/MODEL5.DATA",), 1.0, 15.0)}
PRODUCER, INJECTOR, SIDES = 100.0, 300.0, 200.0


def keyword_values(text, keyword):
    """The numbers after a keyword up to the slash, with repeat counts."""
    found = re.search(rf"^\s*{keyword}\s*$", text, re.MULTILINE)
    if not found:
        return None
    words = text[found.end():text.index("/", found.end())].split()
    if not any("*" in w for w in words):
        return np.array(words, float)
    out = []
    for word in words:
        count, _, value = word.rpartition("*")
        out += [float(value)] * (int(count) if count else 1)
    return np.array(out)


def read_grid(program, shared, name):
    """The grid with the rock of the deck's own host mesh; cells that are not there are inactive. And that mesh's
    file."""
    deck, sources, unit, _ = MODELS[name]
    text = "\n".join(pathlib.Path(shared, "data", s).read_text(encoding="latin-1") for s in sources)
    text = re.sub(r"--.*", "", text)
    mesh = program.folder / f"{name}_deck.h5"
    program.build(pathlib.Path(shared, "data", deck), mesh, "--deck-wells", "all", "--radius", MODELS[name][3])
    host = program.folder / f"{name}_host.h5"
    program.build(pathlib.Path(shared, "data", deck), host)
    with h5py.File(host) as file:
        nx, ny, nz = (int(n) for n in file.attrs["source_dimensions"])
        source = file["cells/source_cell"][()]
        rock = {"PORO": file["cells/porosity"][()], "NTG": file["cells/net_to_gross"][()]}
        k = file["cells/permeability"][()] / host_wells.MILLIDARCY
        rock.update({key: k[:, axis] for axis, key in enumerate(("PERMX", "PERMY", "PERMZ"))})
    values = {}
    for key, cells in rock.items():
        values[key] = np.zeros(nx * ny * nz)
        values[key][source] = cells
    values["ACTNUM"] = np.isin(np.arange(nx * ny * nz), source).astype(int)
    values = {key: v.reshape(nz, ny, nx) for key, v in values.items()}
    coord = keyword_values(text, "COORD").reshape(ny + 1, nx + 1, 6) * unit
    zcorn = keyword_values(text, "ZCORN").reshape(2 * nz, 2 * ny, 2 * nx) * unit
    return hosts.Grid(coord, zcorn, values), mesh


def read_wells(mesh):
    """Paths, bore radii, open ranges and kinds as the program took them from the deck."""
    out = []
    with h5py.File(mesh) as file:
        for key in file["wells_order"][()]:
            group = file["wells"][key.decode()]
            md = group["connections/md"][()]
            out.append({"name": text_of(group.attrs["name"]), "path": group["trajectory"][()],
                        "bore": float(group.attrs["bore_radius"]),
                        "open": (float(md[:, 0].min()), float(md[:, 1].max())),
                        "is_injector": text_of(group.attrs["type"]) == "injector"})
    return out


def text_of(attribute):
    return attribute.decode() if isinstance(attribute, bytes) else str(attribute)


def solve(program, mesh, wells, with_sides):
    options = [a for w in wells for a in ("--well", f"{w['name']}={INJECTOR if w['is_injector'] else PRODUCER}bar")]
    if with_sides:
        options += ["--boundary", f"i-,i+,j-,j+={SIDES}bar"]
    report = program.solve(mesh, mesh.with_name(mesh.stem + "_flow.h5"), *options)
    return {w["name"]: w["rate_m3_per_day"] for w in report["wells"]}


def well_options(program, wells):
    """`--well` options, with the paths in files."""
    options = []
    for n, well in enumerate(wells):
        path = program.folder / f"field{n}.csv"
        with open(path, "w", encoding="ascii") as out:
            out.write("MD,X,Y,TVD\n")
            out.writelines("%.9g,%.9g,%.9g,%.9g\n" % tuple(row) for row in well["path"])
        keys = f"name={well['name']},bore={well['bore']:.9g},from={well['open'][0]:.9g},to={well['open'][1]:.9g}"
        options += ["--well", f"{path},{keys}"]
    return options


def with_peaceman(program, grid, wells, mesh, is_across_layers=False):
    """The mesh of a corner-point grid, its wells in its cells."""
    case = program.folder / "field.GRDECL"
    hosts.write_grdecl(grid, case)
    program.build(case, mesh)
    for well in wells:
        host_wells.add_well(mesh, grid, well["name"], well["path"], well["bore"], [well["open"]], well["is_injector"],
                            is_across_layers)
    return mesh


def solved(program, mesh, wells):
    return {"cells": cells_of(mesh), "closed": solve(program, mesh, wells, False),
            "sides": solve(program, mesh, wells, True)}


def compare(program, shared, name, finer=(4, 5)):
    """{mesh: {cells, closed: {well: rate}, sides: {well: rate}}} for knit, corner_point and refined grids."""
    grid, deck_mesh = read_grid(program, shared, name)
    wells = read_wells(deck_mesh)
    case = program.folder / "field.GRDECL"
    hosts.write_grdecl(grid, case)
    mesh = program.folder / f"{name}_knit.h5"
    report = program.build(case, mesh, "--radius", MODELS[name][3], *well_options(program, wells))
    tubes = {w["name"]: [w["mode"], w["drainage_radius"], w["index_connections"]] for w in report["wells"]}
    out = {"knit": {**solved(program, mesh, wells), "wells": tubes}}
    for parts in (1, *finer):
        key = "corner_point" if parts == 1 else f"finer{parts}"
        fine = hosts.split_columns(grid, parts)
        mesh = with_peaceman(program, fine, wells, program.folder / f"{name}_{key}.h5")
        out[key] = solved(program, mesh, wells)
    return out


def compare_hosts(program, shared, name, finer=3, radius=12.0, references=(5, 7)):
    """The same in the model's columns and in columns `finer` times as fine, with our meshes and with Peaceman's wells;
    references with his index and with that of a bore across dipping layers."""
    grid, deck_mesh = read_grid(program, shared, name)
    wells = read_wells(deck_mesh)
    options = well_options(program, wells)
    case = program.folder / "field.GRDECL"
    out = {}
    for parts, r in ((1, MODELS[name][3]), (finer, radius)):
        fine = hosts.split_columns(grid, parts)
        mesh = with_peaceman(program, fine, wells, program.folder / f"{name}_{parts}_peaceman.h5")
        out[f"{parts} peaceman"] = solved(program, mesh, wells)
        hosts.write_grdecl(fine, case)
        mesh = program.folder / f"{name}_{parts}_knit.h5"
        program.build(case, mesh, "--radius", r, *options)
        out[f"{parts} knit"] = solved(program, mesh, wells)
        if parts == 1:
            program.build(case, mesh, "--fluxes", "adapted", "--radius", r, *options)
            out["1 adapted"] = solved(program, mesh, wells)
    for parts in references:
        fine = hosts.split_columns(grid, parts)
        for is_across_layers in (False, True):
            mesh = with_peaceman(program, fine, wells, program.folder / f"{name}_{parts}.h5", is_across_layers)
            out[f"{parts} across" if is_across_layers else f"{parts} peaceman"] = solved(program, mesh, wells)
    return out


def cells_of(mesh):
    with h5py.File(mesh) as file:
        return int(file["cells/kind"].shape[0])


def closer(result, boundary, reference):
    """{well: (error of ours, error of the corner-point grid's)} against a refined grid; and the share of wells where
    ours is less."""
    rows = {}
    for well, rate in result[reference][boundary].items():
        rows[well] = [result[key][boundary][well] / rate - 1 for key in ("knit", "corner_point")]
    return rows, sum(abs(a) < abs(b) for a, b in rows.values()) / len(rows)
