# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write nanotubes.vtp into this folder. Requires the package vtk or cvista."""
import math
import pathlib
import random

from vtkmodules.vtkCommonCore import VTK_SHORT, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

BOND = 1.42  # between two atoms of carbon, in angstroms
PAIRS = 10  # of atoms around a tube: the chiral indices are (10, 10)
GAP = 3.35  # between the walls of neighboring tubes
RINGS = 4  # of tubes around the one in the middle
UNIT = 0.01  # of the coordinates in the file, in angstroms


def tube(x, y, turn, rows):
    """Yield the positions of the atoms of an armchair tube with its lower end at z = 0."""
    radius = 3.0 * PAIRS * BOND / (2.0 * math.pi)
    for row in range(rows):
        for pair in range(PAIRS):
            for atom in range(2):
                arc = (3.0 * pair + 1.5 * (row % 2) + atom) * BOND
                angle = turn + arc / radius
                yield (x + radius * math.cos(angle), y + radius * math.sin(angle),
                       0.5 * math.sqrt(3.0) * BOND * row)


def main():
    generator = random.Random(3)
    spacing = 3.0 * PAIRS * BOND / math.pi + GAP
    points = vtkPoints()
    points.SetDataType(VTK_SHORT)
    shells = vtkUnsignedCharArray()
    shells.SetName("Shell")
    for i in range(-RINGS, RINGS + 1):
        for j in range(max(-RINGS, -RINGS - i), min(RINGS, RINGS - i) + 1):
            shell = max(abs(i), abs(j), abs(i + j))
            rows = int(150 - 18 * shell + generator.uniform(-8.0, 8.0))
            turn = generator.uniform(0.0, 2.0 * math.pi)
            for p in tube(spacing * (i + 0.5 * j), spacing * math.sqrt(0.75) * j, turn, rows):
                points.InsertNextPoint([round(x / UNIT) for x in p])
                shells.InsertNextValue(shell)
    count = points.GetNumberOfPoints()
    cells = vtkCellArray()
    cells.InsertNextCell(count)
    for i in range(count):
        cells.InsertCellPoint(i)
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetVerts(cells)
    mesh.GetPointData().SetScalars(shells)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(str(pathlib.Path(__file__).parent / "nanotubes.vtp"))
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToLZMA()
    writer.Write()
    print(f"{count} atoms")


main()
