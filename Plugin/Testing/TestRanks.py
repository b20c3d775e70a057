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


EFFECTS = ("none", "occlusion", "shafts")


def draw(folder):
    """What every rank runs: a contour of which each has a part, and a floor that only one has."""
    start()
    view = CreateView("PenumbraRenderView")
    view.ViewSize = [200, 160]
    view.OrientationAxesVisibility = 0
    view.RemoteRenderThreshold = 0
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    contour = Contour(
        Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[170], ComputeNormals=0)
    floor = Plane(Origin=[-20, -20, -11], Point1=[20, -20, -11], Point2=[-20, 20, -11])
    for source in (contour, floor):
        shown = Show(source, view)
        shown.ColorArrayName = [None, ""]
        shown.Ambient = 1
        shown.Diffuse = 0
        shown.AmbientColor = shown.DiffuseColor = [1, 1, 1]
    for effect in EFFECTS:
        view.AmbientOcclusion = effect == "occlusion"
        view.LightShafts = effect == "shafts"
        view.CameraPosition = [40, -50, 40]
        SaveScreenshot(os.path.join(folder, effect + ".png"), view)
        begin = time.monotonic()
        for step in range(1, 4):
            view.CameraPosition = [40 + step, -50, 40]
            Render(view)
        if servermanager.vtkProcessModule.GetProcessModule().GetPartitionId() == 0:
            print(f"{effect}: {(time.monotonic() - begin) / 3:.2f} s a picture", flush=True)


def run_ranks(ranks, command):
    """The command, run by so many ranks."""
    # This process is a rank of its own already: its children shall not take part in that.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
    return subprocess.run(
        ["mpirun", "-np", str(ranks), "--oversubscribe", "--allow-run-as-root",
         "--mca", "btl_vader_single_copy_mechanism", "none"] + command,
        capture_output=True, text=True, timeout=300, env=environment)


def pictures(ranks):
    """The picture with each effect, drawn by so many ranks."""
    with tempfile.TemporaryDirectory() as folder:
        run = run_ranks(ranks, ["pvbatch", "--force-offscreen-rendering", __file__, folder])
        if run.returncode:
            raise AssertionError(run.stdout + run.stderr)
        print(f"{ranks} ranks:\n{run.stdout.strip()}", flush=True)
        return {effect: read_picture(os.path.join(folder, effect + ".png")).astype(int)
                for effect in EFFECTS}


class Ranks(unittest.TestCase):
    def setUp(self):
        trial = run_ranks(2, ["true"])
        if trial.returncode:
            self.skipTest("MPI starts no processes on this machine: " + trial.stderr.strip())

    def test_give_the_same_pictures(self):
        one = pictures(1)
        for effect in EFFECTS[1:]:
            self.assertGreater(numpy.abs(one[effect] - one["none"]).max(), 32)
        for ranks in (2, 4):
            many = pictures(ranks)
            for effect in EFFECTS:
                off = numpy.abs(many[effect] - one[effect]).max(axis=2)
                print(f"{effect}: {(off > 0).mean():.2%} of pixels differ, "
                      f"{(off > 8).mean():.2%} by more than 8/255, at most {off.max()}", flush=True)
                self.assertEqual(numpy.count_nonzero(off > 8), 0)


if len(sys.argv) > 1:
    draw(sys.argv[1])
else:
    run_tests()
