# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin into pvpython, runs a script's tests, and holds scenes with known answers."""
import os
import sys
import unittest

import numpy
from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403
from vtkmodules.util.numpy_support import vtk_to_numpy

SPHERE_RADIUS = 0.5
SPHERE_HEIGHT = 0.8


def start():
    """An empty ParaView with the plugin."""
    ResetSession()
    LoadPlugin(os.environ["PENUMBRA_PLUGIN"], remote=False, ns=sys.modules["__main__"].__dict__)


def plane(resolution=24):
    """A square of side 6 at z = 0 that looks up."""
    return Plane(
        Origin=[-3, -3, 0], Point1=[3, -3, 0], Point2=[-3, 3, 0],
        XResolution=resolution, YResolution=resolution)


def ball(height=SPHERE_HEIGHT):
    return Sphere(
        Center=[0, 0, height], Radius=SPHERE_RADIUS, ThetaResolution=120, PhiResolution=120)


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


def arrays(data):
    """Points and the array AmbientOcclusion of a fetched data set."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(data.GetPointData().GetArray("AmbientOcclusion"))


def data_of(source):
    """What a filter made at the time that it was last asked for."""
    return source.SMProxy.GetClientSideObject().GetOutputDataObject(0)


def statistic(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def rmse(a, b):
    return float(numpy.sqrt(numpy.mean((numpy.asarray(a, float) - numpy.asarray(b, float)) ** 2)))


def run_tests():
    """Runs the tests of the calling script; the exit status tells."""
    result = unittest.TextTestRunner(verbosity=2).run(
        unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"]))
    os._exit(0 if result.wasSuccessful() else 1)
