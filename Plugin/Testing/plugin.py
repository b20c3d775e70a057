# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the tests: loads the plugin into pvpython, creates scenes with closed forms and runs the tests."""
import contextlib
import os
import sys
import unittest

import numpy
import paraview.simple
from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOImage import vtkPNGReader

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SPHERE_RADIUS = 0.5
SPHERE_HEIGHT = 0.8


def start():
    """Reset the session and load the plugin."""
    ResetSession()
    paraview.simple._DisableFirstRenderCameraReset()
    LoadPlugin(os.environ["PENUMBRA_PLUGIN"], remote=False, ns=sys.modules["__main__"].__dict__)


def plane(resolution=24):
    """Return a square of side 6 at z = 0 that faces up."""
    return Plane(
        Origin=[-3, -3, 0], Point1=[3, -3, 0], Point2=[-3, 3, 0],
        XResolution=resolution, YResolution=resolution)


def sphere(height=SPHERE_HEIGHT):
    return Sphere(
        Center=[0, 0, height], Radius=SPHERE_RADIUS, ThetaResolution=120, PhiResolution=120)


def sphere_view(kind, size=(200, 200)):
    """Return a view of plane and sphere from above, without lighting: pixels show 1 - occlusion."""
    view = CreateView(kind)
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.CameraPosition = [0, -6, 8]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    for source in (plane(), sphere()):
        shown = Show(source, view)
        shown.Ambient = 1
        shown.Diffuse = 0
        shown.AmbientColor = [1, 1, 1]
        shown.DiffuseColor = [1, 1, 1]
    return view


def screenshot(view, folder, **options):
    """Return the image written by SaveScreenshot."""
    path = os.path.join(folder, "image.png")
    SaveScreenshot(path, view, **options)
    return read_image(path)


def read_image(path):
    """Return the rows of a PNG file from bottom to top."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).copy()


def plane_mask(view):
    """Return the mask of the pixels that show the plane, at least four pixels from edges, and their points."""
    width, height = view.ViewSize
    eye = numpy.array(view.CameraPosition, float)
    axis = numpy.array(view.CameraFocalPoint) - eye
    axis /= numpy.linalg.norm(axis)
    right = numpy.cross(axis, view.CameraViewUp)
    right /= numpy.linalg.norm(right)
    slope = numpy.tan(numpy.radians(view.CameraViewAngle) / 2)
    x = (2 * (numpy.arange(width) + 0.5) - width) / height * slope
    y = (2 * (numpy.arange(height) + 0.5) - height) / height * slope
    directions = axis + x[None, :, None] * right + y[:, None, None] * numpy.cross(right, axis)
    points = eye - directions * (eye[2] / directions[..., 2:])
    margin = 4 * 2 * slope / height * numpy.linalg.norm(eye)
    to_eye = eye - [0, 0, SPHERE_HEIGHT]
    parameter = -(directions @ to_eye) / (directions**2).sum(axis=2)
    nearest = numpy.linalg.norm(to_eye + parameter[..., None] * directions, axis=2)
    mask = (numpy.abs(points[..., :2]).max(axis=2) < 3 - margin) & (nearest > SPHERE_RADIUS + margin)
    return mask, points[mask]


def rising_sphere(folder):
    """Return a reader of a time series: the sphere at time 0, one unit higher at time 1."""
    names = [os.path.join(folder, f"sphere{time}.vtp") for time in (0, 1)]
    for time, name in enumerate(names):
        SaveData(name, proxy=sphere(SPHERE_HEIGHT + time))
    return XMLPolyDataReader(FileName=names)


def occlusion_under_sphere(points, height=SPHERE_HEIGHT):
    """Closed form: fraction of the hemisphere around +z covered by a sphere above the horizon."""
    distance = numpy.linalg.norm(points - [0, 0, height], axis=1)
    return SPHERE_RADIUS**2 * height / distance**3


def arrays(data, name="AmbientOcclusion"):
    """Return the points of a data set and one of their arrays."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(data.GetPointData().GetArray(name))


def output_data(source):
    """Return the output of the last update of a filter."""
    return source.SMProxy.GetClientSideObject().GetOutputDataObject(0)


def statistic(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def resident_megabytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


@contextlib.contextmanager
def captured_messages():
    """Give an output window that keeps the messages of VTK instead of printing them."""
    before, window = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    try:
        yield window
    finally:
        vtkOutputWindow.SetInstance(before)


def rmse(a, b):
    return float(numpy.sqrt(numpy.mean((numpy.asarray(a, float) - numpy.asarray(b, float)) ** 2)))


def run_tests():
    """Run the tests of the calling script and exit; status 0 if all pass."""
    result = unittest.TextTestRunner(verbosity=2).run(
        unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"]))
    os._exit(0 if result.wasSuccessful() else 1)
