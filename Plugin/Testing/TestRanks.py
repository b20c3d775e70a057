# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The same pictures and values from one, two and four ranks, some without data. Starts itself under MPI."""
import os
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from vtkmodules.vtkIOXML import vtkXMLPImageDataReader


# The last one draws the occlusion of data that one rank has got from all: no picture is composited.
EFFECTS = ("none", "occlusion", "shafts", "gathered")


def is_first():
    return servermanager.vtkProcessModule.GetProcessModule().GetPartitionId() == 0


def leaves(data):
    """The data sets of a composite one, or the one that it is."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    found = []
    each = data.NewIterator()
    each.UnRegister(None)
    each.InitTraversal()
    while not each.IsDoneWithTraversal():
        found += leaves(each.GetCurrentDataObject())
        each.GoToNextItem()
    return found


def scene():
    """A contour of which each rank has a part, and a floor that only one has."""
    contour = Contour(
        Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[170], ComputeNormals=1)
    floor = Plane(Origin=[-20, -20, -11], Point1=[20, -20, -11], Point2=[-20, 20, -11],
                  XResolution=40, YResolution=40)
    return contour, floor


def compute(folder):
    """What every rank runs: filters on data that is spread over ranks."""
    start()
    contour, floor = scene()
    both = AppendGeometry(Input=[contour, floor])
    blocks = GroupDatasets(Input=[contour, floor])
    # Brute force: how well records do is not the question here.
    rays = {"Method": "Brute Force", "Tolerance": 0.02}
    for name, baked, array in (
        ("occlusion", BakeAmbientOcclusion(Input=both, **rays), "AmbientOcclusion"),
        ("blocks", BakeAmbientOcclusion(Input=blocks, **rays), "AmbientOcclusion"),
        ("irradiance", BakeIrradiance(Input=both, Bounces=2, **rays | {"Tolerance": 0.05}), "Irradiance"),
        ("alone", BakeAmbientOcclusion(Input=floor), "AmbientOcclusion"),
    ):
        data = servermanager.Fetch(baked)
        if is_first():
            parts = [arrays(leaf, array) + arrays(leaf, "Normals")[1:] for leaf in leaves(data)
                     if leaf.GetNumberOfPoints() > 0]
            points, values, normals = (numpy.concatenate(each) for each in zip(*parts))
            numpy.savez(os.path.join(folder, name + ".npz"), points=points, values=values,
                        normals=normals)
    reader = XMLPolyDataReader(FileName=[os.path.join(folder, "ball.vtp")])
    for name, inputs in (("file", [reader]), ("pieces", [contour, floor])):
        cast = AdaptiveRayCast(Input=inputs, Resolution=[150, 90], AmbientOcclusion=1)
        SaveData(os.path.join(folder, name + ".pvti"), proxy=cast)


def draw(folder):
    """What every rank runs: pictures of a view."""
    start()
    view = CreateView("PenumbraRenderView")
    view.ViewSize = [200, 160]
    view.OrientationAxesVisibility = 0
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    for source in scene():
        shown = Show(source, view)
        shown.ColorArrayName = [None, ""]
        shown.Ambient = 1
        shown.Diffuse = 0
        shown.AmbientColor = shown.DiffuseColor = [1, 1, 1]
    for effect in EFFECTS:
        view.AmbientOcclusion = effect in ("occlusion", "gathered")
        view.RemoteRenderThreshold = 1000 if effect == "gathered" else 0
        view.LightShafts = effect == "shafts"
        view.CameraPosition = [40, -50, 40]
        SaveScreenshot(os.path.join(folder, effect + ".png"), view)
        begin = time.monotonic()
        for step in range(1, 4):
            view.CameraPosition = [40 + step, -50, 40]
            Render(view)
        if is_first():
            print(f"{effect}: {(time.monotonic() - begin) / 3:.2f} s a picture", flush=True)


def draw_cloud(folder):
    """What every rank runs: a volume, of which each has a part, over a contour and a floor."""
    start()
    view = CreateView("PenumbraRenderView")
    view.ViewSize = [200, 160]
    view.OrientationAxesVisibility = 0
    view.RemoteRenderThreshold = 0
    view.CameraPosition = [40, -50, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    for source in scene():
        Show(source, view).ColorArrayName = [None, ""]
    cloud = Show(Wavelet(), view)
    cloud.Representation = "Volume"
    ColorBy(cloud, ("POINTS", "RTData"))
    for name, cloudy, occlusion in (("surfaces", 0, 0), ("dark", 0, 1), ("cloud", 1, 0), ("both", 1, 1)):
        cloud.Visibility = cloudy
        view.AmbientOcclusion = occlusion
        SaveScreenshot(os.path.join(folder, name + ".png"), view)


def run_ranks(ranks, command):
    """The command, run by so many ranks."""
    # This process is a rank of its own already: its children shall not take part in that.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
    return subprocess.run(
        ["mpirun", "-np", str(ranks), "--oversubscribe", "--allow-run-as-root",
         "--mca", "btl_vader_single_copy_mechanism", "none"] + command,
        capture_output=True, text=True, timeout=300, env=environment)


def results(ranks, what, read):
    """What `read` finds in the folder that so many ranks have filled."""
    with tempfile.TemporaryDirectory() as folder:
        SaveData(os.path.join(folder, "ball.vtp"), proxy=ball())
        run = run_ranks(
            ranks, ["pvbatch", "--force-offscreen-rendering", __file__, what, folder])
        if run.returncode:
            raise AssertionError(run.stdout + run.stderr)
        print(f"{ranks} ranks:\n{run.stdout.strip()}", flush=True)
        return read(folder, run.stderr)


def pictures(folder, _):
    return {effect: read_picture(os.path.join(folder, effect + ".png")).astype(int)
            for effect in EFFECTS}


def clouds(folder, messages):
    shown = {name: read_picture(os.path.join(folder, name + ".png")).astype(int)
             for name in ("surfaces", "dark", "cloud", "both")}
    return shown, messages


def computed(folder, _):
    """Values by position, and colours of pictures."""
    baked = {name: dict(numpy.load(os.path.join(folder, name + ".npz")))
             for name in ("occlusion", "blocks", "irradiance", "alone")}
    for name in ("file", "pieces"):
        reader = vtkXMLPImageDataReader()
        reader.SetFileName(os.path.join(folder, name + ".pvti"))
        reader.Update()
        baked[name] = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("Color")).copy()
    return baked


def by_place(data):
    """Values by position and normal: ranks order their points otherwise, and have those of borders
    twice, with normals that know one side alone."""
    keys = numpy.concatenate([data["points"].round(2), data["normals"].round(2) + 0.0], axis=1)
    return {tuple(key): value for key, value in zip(keys, data["values"])}


class Ranks(unittest.TestCase):
    def setUp(self):
        trial = run_ranks(2, ["true"])
        if trial.returncode:
            self.skipTest("MPI starts no processes on this machine: " + trial.stderr.strip())

    def test_give_the_same_pictures(self):
        one = results(1, "draw", pictures)
        for effect in EFFECTS[1:]:
            self.assertGreater(numpy.abs(one[effect] - one["none"]).max(), 32)
        for ranks in (2, 4):
            many = results(ranks, "draw", pictures)
            for effect in EFFECTS:
                off = numpy.abs(many[effect] - one[effect]).max(axis=2)
                print(f"{effect}: {(off > 0).mean():.2%} of pixels differ, "
                      f"{(off > 8).mean():.2%} by more than 8/255, at most {off.max()}", flush=True)
                # Data that comes together has its triangles in another order: that shows on borders.
                self.assertLessEqual((off > 8).mean(), 0.001 if effect == "gathered" else 0)

    def test_leave_effects_out_where_volumes_are_blended(self):
        warning = "ambient occlusion and light shafts are left out"
        for ranks in (1, 2):
            shown, messages = results(ranks, "draw_cloud", clouds)
            self.assertGreater(numpy.abs(shown["dark"] - shown["surfaces"]).max(), 32)
            self.assertGreater(numpy.abs(shown["cloud"] - shown["surfaces"]).max(), 32)
            darkened = numpy.abs(shown["both"] - shown["cloud"]).max()
            if ranks == 1:
                self.assertGreater(darkened, 16)
                self.assertNotIn(warning, messages)
            else:
                self.assertEqual(darkened, 0)
                self.assertEqual(messages.count(warning), 1)

    def test_let_pieces_block_one_another(self):
        one = results(1, "compute", computed)
        # Without the other ranks the floor would be open.
        on_floor = one["occlusion"]["points"][:, 2] == -11
        self.assertGreater(one["occlusion"]["values"][on_floor].max(), 0.2)
        for ranks in (2, 4):
            many = results(ranks, "compute", computed)
            # The errors of two answers, each within its tolerance.
            for name, bound in (("occlusion", 0.028), ("blocks", 0.028), ("irradiance", 0.07)):
                truth, found = by_place(one[name]), by_place(many[name])
                places = truth.keys() & found.keys()
                self.assertGreater(len(places), 0.8 * max(len(truth), len(found)))
                error = rmse([truth[place] for place in places], [found[place] for place in places])
                print(f"{name}: {error:.4f} from one rank's", flush=True)
                self.assertLess(error, bound)
            self.assertEqual(numpy.ptp(many["alone"]["values"]), 0)
            numpy.testing.assert_array_equal(many["file"], one["file"])
            off = numpy.abs(many["pieces"] - one["pieces"]).max(axis=1)
            print(f"picture of pieces: {(off > 1 / 512).mean():.2%} of pixels differ", flush=True)
            self.assertLess((off > 8 / 255).mean(), 0.001)


if len(sys.argv) > 1:
    {"draw": draw, "draw_cloud": draw_cloud, "compute": compute}[sys.argv[1]](sys.argv[2])
else:
    run_tests()
