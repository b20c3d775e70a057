# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The same picture from one, two and four ranks, and from one without data. Starts itself under MPI."""
import os
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *


def draw(path, effect):
    """What every rank runs: a contour of which each has a part, and a floor."""
    start()
    view = CreateView("PenumbraRenderView")
    view.ViewSize = [200, 160]
    view.OrientationAxesVisibility = 0
    view.RemoteRenderThreshold = 0
    view.CameraPosition = [40, -50, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    view.AmbientOcclusion = effect == "occlusion"
    view.LightShafts = effect == "shafts"
    contour = Contour(
        Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[170], ComputeNormals=0)
    floor = Plane(Origin=[-20, -20, -11], Point1=[20, -20, -11], Point2=[-20, 20, -11])
    for source in (contour, floor):
        shown = Show(source, view)
        shown.ColorArrayName = [None, ""]
        shown.Ambient = 1
        shown.Diffuse = 0
        shown.AmbientColor = shown.DiffuseColor = [1, 1, 1]
    SaveScreenshot(path, view)
    begin = time.monotonic()
    for step in range(1, 4):
        view.CameraPosition = [40 + step, -50, 40]
        Render(view)
    if servermanager.vtkProcessModule.GetProcessModule().GetPartitionId() == 0:
        print(f"{(time.monotonic() - begin) / 3:.2f} s a picture", flush=True)


def picture(ranks, effect):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        command = ["mpirun", "-np", str(ranks), "--oversubscribe", "--allow-run-as-root",
                   "--mca", "btl_vader_single_copy_mechanism", "none",
                   "pvbatch", "--force-offscreen-rendering", __file__, path, effect]
        # This process is a rank of its own already: its children shall not take part in that.
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
        run = subprocess.run(
            command, capture_output=True, text=True, timeout=120, env=environment)
        if run.returncode:
            raise AssertionError(run.stdout + run.stderr)
        return read_picture(path), run.stdout.strip().splitlines()[-1]


class Ranks(unittest.TestCase):
    def check(self, effect):
        one, seconds = picture(1, effect)
        plain, plain_seconds = picture(1, "none")
        print(f"1 rank: {seconds}, without effects {plain_seconds}", flush=True)
        self.assertGreater(numpy.abs(one.astype(int) - plain).max(), 32)
        for ranks in (2, 4):
            many, seconds = picture(ranks, effect)
            off = numpy.abs(many.astype(int) - one).max(axis=2)
            print(f"{ranks} ranks: {seconds}; {(off > 0).mean():.2%} of pixels differ, "
                  f"{(off > 8).mean():.2%} by more than 8/255, at most {off.max()}", flush=True)
            self.assertEqual(numpy.count_nonzero(off > 8), 0)

    def test_give_the_same_ambient_occlusion(self):
        self.check("occlusion")

    def test_give_the_same_light_shafts(self):
        self.check("shafts")


if len(sys.argv) > 2:
    draw(*sys.argv[1:])
else:
    run_tests()
