# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Renders a first image with VTK's classes, without PyVista: first_cast.py FILE"""
import sys

from cvista.util.numpy_support import vtk_to_numpy
from cvista.vtkFiltersSources import vtkSphereSource
from cvista.vtkIOImage import vtkPNGWriter
from cvista.vtkImagingCore import vtkImageShiftScale
from penumbra import vtkPenumbraRayCaster

sphere = vtkSphereSource()
caster = vtkPenumbraRayCaster()
caster.AddInputConnection(sphere.GetOutputPort())
caster.SetResolution(800, 600)
caster.AmbientOcclusionOn()
bytes_of = vtkImageShiftScale()
bytes_of.SetInputConnection(caster.GetOutputPort())
bytes_of.SetScale(255)
bytes_of.SetOutputScalarTypeToUnsignedChar()
bytes_of.ClampOverflowOn()
writer = vtkPNGWriter()
writer.SetInputConnection(bytes_of.GetOutputPort())
writer.SetFileName(sys.argv[1])
writer.Write()
assert vtk_to_numpy(caster.GetOutput().GetPointData().GetArray("Color")).max() > 0.5
