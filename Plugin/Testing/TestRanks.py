# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares images and values of one and four ranks, some without data; composites on two. Runs itself under MPI."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from vtkmodules.vtkIOXML import vtkXMLPImageDataReader


# "gathered": one rank collects all data and renders with occlusion; no image is composited.
# "rays": all ranks cast the rays of Still By Rays together.
EFFECTS = ("none", "occlusion", "shafts", "gathered", "rays")


def is_first():
    return servermanager.vtkProcessModule.GetProcessModule().GetPartitionId() == 0


def leaves(data):
    """Return the leaves of a composite data set, or the data set itself."""
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


def scene(normals=1):
    """Return a contour that is distributed over the ranks, with or without normals, and a floor on one rank."""
    contour = Contour(
        Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[170], ComputeNormals=normals)
    floor = Plane(Origin=[-20, -20, -11], Point1=[20, -20, -11], Point2=[-20, 20, -11],
                  XResolution=40, YResolution=40)
    return contour, floor


def compute(folder):
    """Executed by every rank: run the filters on distributed data."""
    start()
    contour, floor = scene()
    both = AppendGeometry(Input=[contour, floor])
    blocks = GroupDatasets(Input=[contour, floor])
    # Brute force, to exclude the interpolation error of records.
    rays = {"Method": "Brute Force", "Tolerance": 0.02}
    for name, baked, array in (
        ("occlusion", BakeAmbientOcclusion(Input=both, **rays), "AmbientOcclusion"),
        ("blocks", BakeAmbientOcclusion(Input=blocks, **rays), "AmbientOcclusion"),
        ("irradiance", BakeIrradiance(Input=both, Bounces=2, **rays | {"Tolerance": 0.05}), "Irradiance"),
        ("sunlight", BakeDirectLight(Input=both, Lights=[1, 2, 3, 0], LightAngle=10, Tolerance=0.02), "DirectLight"),
        ("alone", BakeAmbientOcclusion(Input=floor), "AmbientOcclusion"),
    ):
        data = servermanager.Fetch(baked)
        if is_first():
            parts = [arrays(leaf, array) + arrays(leaf, "Normals")[1:] for leaf in leaves(data)
                     if leaf.GetNumberOfPoints() > 0]
            points, values, normals = (numpy.concatenate(each) for each in zip(*parts))
            numpy.savez(os.path.join(folder, name + ".npz"), points=points, values=values,
                        normals=normals)
    reader = XMLPolyDataReader(FileName=[os.path.join(folder, "sphere.vtp")])
    # Without normals: those of the contour are one-sided at the borders of pieces, so they depend on the ranks.
    for name, inputs in (("file", [reader]), ("pieces", scene(normals=0))):
        cast = AdaptiveRayCast(Input=inputs, Resolution=[150, 90], AmbientOcclusion=1)
        SaveData(os.path.join(folder, name + ".pvti"), proxy=cast)


def draw(folder):
    """Executed by every rank: render images of a view."""
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
        view.StillByRays = effect == "rays"
        view.CameraPosition = [40, -50, 40]
        SaveScreenshot(os.path.join(folder, effect + ".png"), view)
        view.CameraPosition = [41, -50, 40]  # all ranks render a moved view, too
        Render(view)


def draw_cloud(folder):
    """Executed by every rank: render a distributed volume over a contour and a floor."""
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
    for name, has_cloud, occlusion in (("surfaces", 0, 0), ("dark", 0, 1), ("cloud", 1, 0), ("both", 1, 1)):
        cloud.Visibility = has_cloud
        view.AmbientOcclusion = occlusion
        SaveScreenshot(os.path.join(folder, name + ".png"), view)


def run_ranks(ranks, command):
    """Run the command with a number of ranks."""
    # This process is an MPI rank itself; its environment must not be inherited.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
    return subprocess.run(
        ["mpirun", "-np", str(ranks), "--oversubscribe", "--allow-run-as-root",
         "--mca", "btl_vader_single_copy_mechanism", "none"] + command,
        capture_output=True, text=True, timeout=300, env=environment)


def results(ranks, what, read):
    """Run a command of this script with a number of ranks and return its results, loaded by `read`."""
    with tempfile.TemporaryDirectory() as folder:
        SaveData(os.path.join(folder, "sphere.vtp"), proxy=sphere())
        run = run_ranks(
            ranks, ["pvbatch", "--force-offscreen-rendering", __file__, what, folder])
        if run.returncode:
            raise AssertionError(run.stdout + run.stderr)
        print(f"{ranks} ranks:\n{run.stdout.strip()}", flush=True)
        return read(folder, run.stderr)


def images(folder, _):
    return {effect: read_image(os.path.join(folder, effect + ".png")).astype(int)
            for effect in EFFECTS}


def clouds(folder, messages):
    shown = {name: read_image(os.path.join(folder, name + ".png")).astype(int)
             for name in ("surfaces", "dark", "cloud", "both")}
    return shown, messages


def computed(folder, _):
    """Load values by position, and the colors of images."""
    baked = {name: dict(numpy.load(os.path.join(folder, name + ".npz")))
             for name in ("occlusion", "blocks", "irradiance", "sunlight", "alone")}
    for name in ("file", "pieces"):
        reader = vtkXMLPImageDataReader()
        reader.SetFileName(os.path.join(folder, name + ".pvti"))
        reader.Update()
        baked[name] = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("Color")).copy()
    return baked


def by_point(data):
    """Return values by position and normal. The order of points depends on the ranks. Points on partition
    boundaries occur twice, with normals of one side only."""
    keys = numpy.concatenate([data["points"].round(2), data["normals"].round(2) + 0.0], axis=1)
    return {tuple(key): value for key, value in zip(keys, data["values"])}


class Ranks(unittest.TestCase):
    def setUp(self):
        probe = run_ranks(2, ["true"])
        if probe.returncode:
            self.skipTest("MPI cannot start processes on this machine: " + probe.stderr.strip())

    def test_render_the_same_images(self):
        one = results(1, "draw", images)
        for effect in EFFECTS[1:]:
            self.assertGreater(numpy.abs(one[effect] - one["none"]).max(), 32)
        many = results(4, "draw", images)
        for effect in EFFECTS:
            if effect == "rays":  # not as usual
                self.assertGreater(numpy.abs(many[effect] - many["none"]).max(), 32)
            difference = numpy.abs(many[effect] - one[effect]).max(axis=2)
            print(f"{effect}: {(difference > 0).mean():.2%} of pixels differ, "
                  f"{(difference > 8).mean():.2%} by more than 8/255, at most {difference.max()}", flush=True)
            # Gathered data has another order of triangles, which affects edges.
            self.assertLessEqual((difference > 8).mean(), {"gathered": 0.001, "occlusion": 0.0001}.get(effect, 0))

    def test_disable_effects_with_ordered_compositing(self):
        warning = "ambient occlusion and light shafts are not rendered"
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

    def test_pieces_occlude_each_other(self):
        one = results(1, "compute", computed)
        # Without the geometry of other ranks the floor would be unoccluded.
        on_floor = one["occlusion"]["points"][:, 2] == -11
        self.assertGreater(one["occlusion"]["values"][on_floor].max(), 0.2)
        many = results(4, "compute", computed)
        # The same rays, except at points where the pieces of ParaView have other neighbors.
        for name in ("occlusion", "blocks", "irradiance", "sunlight"):
            reference, values = by_point(one[name]), by_point(many[name])
            points = reference.keys() & values.keys()
            self.assertGreater(len(points), 0.8 * max(len(reference), len(values)))
            error = rmse([reference[point] for point in points], [values[point] for point in points])
            print(f"{name}: {error:.4f} from one rank's", flush=True)
            self.assertLess(error, 0.003)
        self.assertEqual(numpy.ptp(many["alone"]["values"]), 0)
        numpy.testing.assert_array_equal(many["file"], one["file"])
        difference = numpy.abs(many["pieces"] - one["pieces"]).max(axis=1)
        print(f"image of pieces: {(difference > 0).mean():.2%} of pixels differ", flush=True)
        # The triangles have another order, which affects edges.
        self.assertLess((difference > 1 / 512).mean(), 0.001)


if len(sys.argv) > 1:
    {"draw": draw, "draw_cloud": draw_cloud, "compute": compute}[sys.argv[1]](sys.argv[2])
else:
    run_tests()
