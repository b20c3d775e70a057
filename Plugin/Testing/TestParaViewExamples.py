# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs ParaView's own benchmark scripts unchanged, with its render view and with that of the plugin.

If PENUMBRA_IMAGES=FOLDER is set, the images are saved there side by side, without and with occlusion.
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

# Replaces each render view that a script creates, then runs the script as from the command line.
SCRIPT = """
import importlib, sys
from paraview import servermanager
from paraview.simple import *
plugin, path, module = sys.argv[1:4]
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
    raise SystemExit("the script used another view: " + view.GetXMLName())
SaveScreenshot(path, view, ImageResolution=[400, 400])
"""


def write_side_by_side(images, path):
    rows = numpy.ascontiguousarray(numpy.concatenate(images, axis=1))
    image = vtkImageData()
    image.SetDimensions(rows.shape[1], rows.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(rows.reshape(-1, rows.shape[2]), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


class ParaViewExamples(unittest.TestCase):
    def render(self, name, module, *arguments):
        """Return the images of a script without and with occlusion."""
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "script.py")
            with open(script, "w") as file:
                file.write(SCRIPT)
            paths = []
            for plugin in ("plain", os.environ["PENUMBRA_PLUGIN"]):
                paths.append(os.path.join(folder, f"{len(paths)}.png"))
                run = subprocess.run(
                    ["pvpython", "--force-offscreen-rendering", script, plugin, paths[-1], module,
                     *arguments], cwd=folder, capture_output=True, text=True, timeout=200)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
                self.assertNotIn("ERR|", run.stderr)
            rendered = [read_image(path)[..., :3] for path in paths]
        if "PENUMBRA_IMAGES" in os.environ:
            write_side_by_side(rendered, os.path.join(os.environ["PENUMBRA_IMAGES"], name + ".png"))
        return [image.astype(int) for image in rendered]

    def check(self, *case, darkens):
        plain, dark = self.render(*case)
        change = dark - plain
        # The antialiasing of edges may differ.
        self.assertLess((change.max(axis=2) > 8).mean(), 0.02)
        self.assertEqual(change.min() < -24, darkens)

    def test_darkens_many_spheres(self):
        self.check("spheres", "paraview.benchmark.manyspheres", "-s", "60", "-r", "12", "-f", "1",
                   darkens=True)

    def test_darkens_a_contour(self):
        self.check("contour", "paraview.benchmark.waveletcontour", "-d", "40", "-f", "1", darkens=True)

    def test_does_not_change_a_volume(self):
        self.check("volume", "paraview.benchmark.waveletvolume", "-d", "30", "-f", "1", darkens=False)


run_tests()
