# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own test and benchmark scripts as they stand, their views plain and with the plugin's.

With PENUMBRA_PICTURES=FOLDER the pictures are kept there, plain beside darkened.
"""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

# Every render view that a script opens is one of ours; then the script runs as from the command line.
SCRIPT = """
import importlib, sys
from paraview import servermanager
from paraview.simple import *
plugin, picture, module = sys.argv[1:4]
if plugin != "plain":
    LoadPlugin(plugin, remote=False, ns=globals())
    create = servermanager._create_view
    servermanager._create_view = lambda name, *rest, **more: create(
        "PenumbraRenderView" if name == "RenderView" else name, *rest, **more)
main = importlib.import_module(module).main
arguments = sys.argv[4:]
sys.argv = [module] + arguments
main(arguments)
view = GetActiveView()
if plugin != "plain" and view.GetXMLName() != "PenumbraRenderView":
    raise SystemExit("the script drew into another view: " + view.GetXMLName())
SaveScreenshot(picture, view, ImageResolution=[400, 400])
"""


def write_beside(pictures, path):
    rows = numpy.ascontiguousarray(numpy.concatenate(pictures, axis=1))
    image = vtkImageData()
    image.SetDimensions(rows.shape[1], rows.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(rows.reshape(-1, rows.shape[2]), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


class RealCases(unittest.TestCase):
    def draw(self, name, module, *arguments):
        """Plain and with occlusion."""
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "script.py")
            with open(script, "w") as file:
                file.write(SCRIPT)
            pictures = []
            for plugin in ("plain", os.environ["PENUMBRA_PLUGIN"]):
                pictures.append(os.path.join(folder, f"{len(pictures)}.png"))
                run = subprocess.run(
                    ["pvpython", "--force-offscreen-rendering", script, plugin, pictures[-1], module,
                     *arguments], cwd=folder, capture_output=True, text=True, timeout=200)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
                self.assertNotIn("ERR|", run.stderr)
            drawn = [read_picture(picture)[..., :3] for picture in pictures]
        if "PENUMBRA_PICTURES" in os.environ:
            write_beside(drawn, os.path.join(os.environ["PENUMBRA_PICTURES"], name + ".png"))
        return [picture.astype(int) for picture in drawn]

    def check(self, *case, darkens):
        plain, ours = self.draw(*case)
        change = ours - plain
        # Edges may be smoothed otherwise.
        self.assertLess((change.max(axis=2) > 8).mean(), 0.02)
        self.assertEqual(change.min() < -24, darkens)

    def test_many_spheres_darken_each_other(self):
        self.check("spheres", "paraview.benchmark.manyspheres", "-s", "60", "-r", "12", "-f", "1",
                   darkens=True)

    def test_a_contour_darkens_in_its_hollows(self):
        self.check("contour", "paraview.benchmark.waveletcontour", "-d", "40", "-f", "1", darkens=True)

    def test_a_volume_stays_as_it_is(self):
        self.check("volume", "paraview.benchmark.waveletvolume", "-d", "30", "-f", "1", darkens=False)


run_tests()
