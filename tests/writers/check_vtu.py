#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has VTK open the VTU, VTP and VTKHDF files of a folder: cells, validity, volumes, lines.

    check_vtu.py FOLDER [--twisted]
--twisted: the models have faces that are not planar. Ends with 77 where python3-vtk9 is missing.
"""
import collections
import pathlib
import sys

try:
    import h5py
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# Cells whose faces are not planar: VTK's own validity does not apply, and its volume cuts faces along diagonals of its choice.
TWISTED = {"twisted", "twisted_geos"}
# GEOS: tetrahedron, hexahedron, pyramid, and prisms as polyhedra.
GEOS_TYPES = {10, 12, 14, 42}
MOST_SIDES = 11


def read(path, reader):
    messages = []
    output = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(output)
    reader.SetFileName(str(path))
    reader.Update()
    if output.GetOutput():
        messages.append(output.GetOutput())
    return reader.GetOutput(), messages


def cell_array(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def states(grid):
    validator = vtk.vtkCellValidator()
    validator.SetInputData(grid)
    validator.Update()
    return cell_array(validator.GetOutput(), "ValidityState")


def volumes(grid):
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.ComputeSumOff()
    sizes.Update()
    return cell_array(sizes.GetOutput(), "Volume")


def outer_area(grid):
    """Of the faces that only one cell has, however VTK tells: a face without its counterpart beyond would add to it."""
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    properties = vtk.vtkTriangleFilter()
    properties.SetInputConnection(surface.GetOutputPort())
    mass = vtk.vtkMassProperties()
    mass.SetInputConnection(properties.GetOutputPort())
    mass.Update()
    return mass.GetSurfaceArea()


def check_general(path, grid, twisted):
    problems = []
    ours = cell_array(grid, "volume")
    state = states(grid)
    difference = np.abs(volumes(grid) / ours - 1).max()
    print(f"{path.name}: {grid.GetNumberOfCells()} cells, validity states {np.unique(state, return_counts=True)}, volume difference {difference:.2g}")
    if not twisted and state.any():
        problems.append(f"{np.count_nonzero(state)} cells are not valid")
    if difference > (1e-9 if not twisted else 0.02):
        problems.append(f"volumes differ by {difference}")
    bounds = grid.GetBounds()
    center = cell_array(grid, "center")
    if not (center[:, 2] >= bounds[4]).all() or not (center[:, 2] <= bounds[5]).all():
        problems.append("centres outside of the grid: z is not the points' z")
    return problems


def prism_problem(grid, cell):
    """Whether a polyhedron is a prism of few sides: two polygons of n, n quadrilaterals, 2 n points."""
    faces = [grid.GetCell(cell).GetFace(f).GetNumberOfPoints() for f in range(grid.GetCell(cell).GetNumberOfFaces())]
    sides = len(faces) - 2
    ends = [3, 3] if sides == 3 else [sides, sides]
    rest = sorted(faces)
    for end in ends:
        if end not in rest:
            return f"cell {cell} with faces {faces} is no prism"
        rest.remove(end)
    if sides > MOST_SIDES or any(n != 4 for n in rest) or grid.GetCell(cell).GetNumberOfPoints() != 2 * sides:
        return f"cell {cell} with faces {faces} is no prism"
    return None


def check_geos(path, grid, twisted):
    """`grid` has the shapes that GEOS takes, of positive volume; by cells of the mesh they add up to the mesh file's."""
    types = np.array([grid.GetCellType(n) for n in range(grid.GetNumberOfCells())])
    problems = [] if set(types) <= GEOS_TYPES else [f"types {sorted(set(types) - GEOS_TYPES)}"]
    problems += [p for n in np.flatnonzero(types == 42) if (p := prism_problem(grid, n))]
    with h5py.File(path.with_name(path.name.replace("_geos.vtu", ".h5"))) as mesh:
        volume, pores = mesh["cells/volume"][:], mesh["cells/pore_volume"][:]
    cell, ours, sizes = cell_array(grid, "cell"), cell_array(grid, "volume"), volumes(grid)
    sums = np.bincount(cell, ours, len(volume))
    pore_sums = np.bincount(cell, ours * cell_array(grid, "PORO") * cell_array(grid, "NTG"), len(volume))
    inverted = np.count_nonzero(ours <= 0)
    print(f"{path.name}: {len(volume)} cells as {dict(sorted(collections.Counter(types.tolist()).items()))}, {inverted} without volume, "
          f"sums differ by {np.abs(sums / volume - 1).max():.2g}, VTK's by {np.abs(sizes / ours - 1).max():.2g}")
    if inverted:
        problems.append(f"{inverted} pieces have no volume")
    if np.abs(sums / volume - 1).max() > 1e-9:
        problems.append("the pieces do not fill the cells")
    if np.abs(pore_sums - pores).max() > 1e-9 * pores.max():
        problems.append("the pieces' pore volumes do not add up")
    if not twisted and np.abs(sizes / ours - 1).max() > 1e-9:
        problems.append("VTK's volumes differ")
    if (cell_array(grid, "attribute") < 0).any():
        problems.append("negative regions")
    return problems


def check_grid(path, twisted):
    grid, problems = read(path, vtk.vtkXMLUnstructuredGridReader())
    if grid.GetNumberOfCells() == 0:
        return problems + ["no cells"]
    if path.stem.endswith("_geos"):
        problems += check_geos(path, grid, twisted or path.stem in TWISTED)
        whole_path = path.with_name(path.name.replace("_geos", ""))
        if whole_path.exists() and path.stem not in TWISTED:
            whole, _ = read(whole_path, vtk.vtkXMLUnstructuredGridReader())
            areas = outer_area(grid), outer_area(whole)
            print(f"{path.name}: outer area {areas[0]:.12g}, of the whole cells {areas[1]:.12g}")
            if abs(areas[0] / areas[1] - 1) > 1e-6:
                problems.append("pieces do not meet face to face")
        return problems
    return problems + check_general(path, grid, twisted or path.stem in TWISTED)


def check_lines(path):
    """The wells of the mesh file beside it."""
    lines, problems = read(path, vtk.vtkXMLPolyDataReader())
    with h5py.File(path.with_suffix(".h5")) as mesh:
        wells = [group for group in mesh["wells"].values() if isinstance(group, h5py.Group)] if "wells" in mesh else []
        count = len(wells)
        points = sum(len(group["trajectory"]) for group in wells)
    print(f"{path.name}: {lines.GetNumberOfLines()} lines of {lines.GetNumberOfPoints()} points")
    if lines.GetNumberOfLines() != count or lines.GetNumberOfPoints() != points:
        problems.append(f"{lines.GetNumberOfLines()} lines of {lines.GetNumberOfPoints()} points, in the mesh file {count} of {points}")
    if count:
        names = lines.GetCellData().GetAbstractArray("name")
        if any(not names.GetValue(n) for n in range(count)):
            problems.append("a well has no name")
        depth = vtk_to_numpy(lines.GetPointData().GetArray("measured_depth"))
        for n in range(count):
            ids = vtk.vtkIdList()
            lines.GetCellPoints(n, ids)
            at = [ids.GetId(k) for k in range(ids.GetNumberOfIds())]
            path_points = vtk_to_numpy(lines.GetPoints().GetData())[at]
            steps = np.linalg.norm(np.diff(path_points, axis=0), axis=1)
            if (np.diff(depth[at]) <= 0).any() or (steps > np.diff(depth[at]) * (1 + 1e-3) + 1e-3).any():
                problems.append(f"measured depths of line {n} do not fit its points")
    return problems


def check_source(path, twisted):
    """All cells of the source, with a volume, in VTK's order of corners."""
    grid, problems = read(path, vtk.vtkHDFReader())
    with h5py.File(path.with_suffix(".h5")) as mesh:
        wanted = mesh["transfer/source_volume"][:] if "transfer/source_volume" in mesh else None
    sizes = volumes(grid)
    print(f"{path.name}: {grid.GetNumberOfCells()} hexahedra, volumes {sizes.min():.3g} to {sizes.max():.3g}")
    if grid.GetNumberOfCells() == 0 or grid.GetCellType(0) != 12:
        problems.append("no hexahedra")
    if (sizes < (-0.01 * sizes.max() if twisted else 0)).any():
        problems.append("negative volumes")
    if wanted is not None and twisted:  # a whole model: its own source
        ours = wanted[cell_array(grid, "source_cell")]
        if abs(sizes.sum() / ours.sum() - 1) > 1e-3:
            problems.append(f"volumes add up to {sizes.sum():.9g}, those of the source to {ours.sum():.9g}")
    return problems


def main():
    folder, twisted = pathlib.Path(sys.argv[1]), "--twisted" in sys.argv[2:]
    checks = ((".vtu", lambda path: check_grid(path, twisted)), (".vtp", check_lines), (".vtkhdf", lambda path: check_source(path, twisted)))
    failed = False
    for extension, check in checks:
        files = sorted(folder.glob("*" + extension))
        if not files:
            sys.exit(f"no {extension} files: writers.examples has not run")
        for path in files:
            for problem in check(path):
                failed = True
                print(f"FAIL {path.name}: {problem}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
