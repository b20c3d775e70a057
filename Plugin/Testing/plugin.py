# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin into pvpython, runs a script's tests, and holds scenes with known answers."""
import os
import sys
import unittest

import numpy
import paraview.simple
from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SPHERE_RADIUS = 0.5
SPHERE_HEIGHT = 0.8


def start():
    """An empty ParaView with the plugin."""
    ResetSession()
    paraview.simple._DisableFirstRenderCameraReset()
    LoadPlugin(os.environ["PENUMBRA_PLUGIN"], remote=False, ns=sys.modules["__main__"].__dict__)


def plane(resolution=24):
    """A square of side 6 at z = 0 that looks up."""
    return Plane(
        Origin=[-3, -3, 0], Point1=[3, -3, 0], Point2=[-3, 3, 0],
        XResolution=resolution, YResolution=resolution)


def ball(height=SPHERE_HEIGHT):
    return Sphere(
        Center=[0, 0, height], Radius=SPHERE_RADIUS, ThetaResolution=120, PhiResolution=120)


def view_of_ball(kind, size=(200, 200)):
    """Plane and ball from above and aside, without lights: pixels show 1 - occlusion."""
    view = CreateView(kind)
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.CameraPosition = [0, -6, 8]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    for source in (plane(), ball()):
        shown = Show(source, view)
        shown.Ambient = 1
        shown.Diffuse = 0
        shown.AmbientColor = [1, 1, 1]
        shown.DiffuseColor = [1, 1, 1]
    return view


def screenshot(view, folder, **options):
    """What SaveScreenshot writes."""
    path = os.path.join(folder, "picture.png")
    SaveScreenshot(path, view, **options)
    return read_picture(path)


def read_picture(path):
    """Rows from bottom to top."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).copy()


def plane_pixels(view):
    """Which pixels show the plane, four pixels away from other things, and its points there."""
    width, height = view.ViewSize
    eye = numpy.array(view.CameraPosition, float)
    axis = numpy.array(view.CameraFocalPoint) - eye
    axis /= numpy.linalg.norm(axis)
    right = numpy.cross(axis, view.CameraViewUp)
    right /= numpy.linalg.norm(right)
    slope = numpy.tan(numpy.radians(view.CameraViewAngle) / 2)
    x = (2 * (numpy.arange(width) + 0.5) - width) / height * slope
    y = (2 * (numpy.arange(height) + 0.5) - height) / height * slope
    ways = axis + x[None, :, None] * right + y[:, None, None] * numpy.cross(right, axis)
    points = eye - ways * (eye[2] / ways[..., 2:])
    margin = 4 * 2 * slope / height * numpy.linalg.norm(eye)
    to_ball = eye - [0, 0, SPHERE_HEIGHT]
    along = -(ways @ to_ball) / (ways**2).sum(axis=2)
    nearest = numpy.linalg.norm(to_ball + along[..., None] * ways, axis=2)
    seen = (numpy.abs(points[..., :2]).max(axis=2) < 3 - margin) & (nearest > SPHERE_RADIUS + margin)
    return seen, points[seen]


def rising_ball(folder):
    """A series of files: the ball at time 0, higher by one at time 1."""
    names = [os.path.join(folder, f"ball{time}.vtp") for time in (0, 1)]
    for time, name in enumerate(names):
        SaveData(name, proxy=ball(SPHERE_HEIGHT + time))
    return XMLPolyDataReader(FileName=names)


def occlusion_under_ball(points, height=SPHERE_HEIGHT):
    """Closed form: the share of a hemisphere about +z that a sphere above the horizon covers."""
    distance = numpy.linalg.norm(points - [0, 0, height], axis=1)
    return SPHERE_RADIUS**2 * height / distance**3


def arrays(data, name="AmbientOcclusion"):
    """Points of a fetched data set, and one of their arrays."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(data.GetPointData().GetArray(name))


def data_of(source):
    """What a filter made at the time that it was last asked for."""
    return source.SMProxy.GetClientSideObject().GetOutputDataObject(0)


def statistic(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def resident_megabytes():
    with open("/proc/self/statm") as numbers:
        return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def rmse(a, b):
    return float(numpy.sqrt(numpy.mean((numpy.asarray(a, float) - numpy.asarray(b, float)) ** 2)))


def run_tests():
    """Runs the tests of the calling script; the exit status tells."""
    result = unittest.TextTestRunner(verbosity=2).run(
        unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"]))
    os._exit(0 if result.wasSuccessful() else 1)
