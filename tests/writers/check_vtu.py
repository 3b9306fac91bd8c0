#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has VTK open the VTU files of a folder: cells, validity, volumes.

    check_vtu.py FOLDER
Ends with 77 where python3-vtk9 is missing.
"""
import pathlib
import sys

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# Cells whose faces are not planar: VTK's own validity does not apply, and its volume cuts faces along diagonals of its choice.
TWISTED = {"twisted"}


def read(path):
    messages = []
    output = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(output)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    if output.GetOutput():
        messages.append(output.GetOutput())
    return reader.GetOutput(), messages


def states(grid):
    validator = vtk.vtkCellValidator()
    validator.SetInputData(grid)
    validator.Update()
    return vtk_to_numpy(validator.GetOutput().GetCellData().GetArray("ValidityState"))


def volumes(grid):
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.ComputeSumOff()
    sizes.Update()
    return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))


def check(path):
    grid, problems = read(path)
    ours = vtk_to_numpy(grid.GetCellData().GetArray("volume"))
    state = states(grid)
    difference = np.abs(volumes(grid) / ours - 1).max()
    planar = path.stem not in TWISTED
    print(f"{path.name}: {grid.GetNumberOfCells()} cells, validity states {np.unique(state, return_counts=True)}, volume difference {difference:.2g}")
    if grid.GetNumberOfCells() == 0:
        problems.append("no cells")
    if planar and state.any():
        problems.append(f"{np.count_nonzero(state)} cells are not valid")
    if difference > (1e-9 if planar else 0.02):
        problems.append(f"volumes differ by {difference}")
    bounds = grid.GetBounds()
    center = vtk_to_numpy(grid.GetCellData().GetArray("center"))
    if not (center[:, 2] >= bounds[4]).all() or not (center[:, 2] <= bounds[5]).all():
        problems.append("centres outside of the grid: z is not the points' z")
    return problems


def main():
    files = sorted(pathlib.Path(sys.argv[1]).glob("*.vtu"))
    if not files:
        sys.exit("no VTU files: writers.examples has not run")
    failed = False
    for path in files:
        for problem in check(path):
            failed = True
            print(f"FAIL {path.name}: {problem}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
