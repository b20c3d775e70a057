# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filters of the plugin against closed forms."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from paraview import smstate


class BakeAmbientOcclusionFilter(unittest.TestCase):
    def setUp(self):
        start()

    def check_plane(self, data, height=SPHERE_HEIGHT, tolerance=0.01):
        points, values = arrays(data)
        on_plane = numpy.abs(points[:, 2]) < 1e-6
        self.assertEqual(numpy.count_nonzero(on_plane), 25 * 25)
        truth = occlusion_under_ball(points[on_plane], height)
        self.assertLess(rmse(values[on_plane], truth), tolerance)
        self.assertGreater(values[on_plane].max(), 0.3)

    def test_matches_the_closed_form_under_a_sphere(self):
        scene = AppendGeometry(Input=[plane(), ball()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        data = servermanager.Fetch(baked)
        self.check_plane(data)
        self.assertEqual(statistic(data, "Points/Total"), data.GetNumberOfPoints())
        self.assertGreater(statistic(data, "Rays/Total"), 0)
        baked.UpdatePropertyInformation()
        error = baked.SMProxy.GetProperty("EstimatedError").GetElement(0)
        self.assertTrue(0.0 < error < 0.01, error)

    def test_takes_the_surface_of_an_unstructured_grid(self):
        scene = AppendDatasets(Input=[plane(), ball()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        self.check_plane(servermanager.Fetch(baked))

    def test_lets_blocks_block_one_another(self):
        baked = BakeAmbientOcclusion(Input=GroupDatasets(Input=[plane(), ball()]), Radius=100)
        self.check_plane(servermanager.Fetch(baked).GetBlock(0))

    def test_follows_a_time_series(self):
        with tempfile.TemporaryDirectory() as folder:
            self.check_series(folder)

    def check_series(self, folder):
        scene = AppendGeometry(Input=[rising_ball(folder), plane()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        for time, least in ((0.0, 0.3), (1.0, 0.05)):
            baked.UpdatePipeline(time)
            points, values = arrays(data_of(baked))
            on_plane = numpy.abs(points[:, 2]) < 1e-6
            truth = occlusion_under_ball(points[on_plane], 0.8 + time)
            self.assertLess(rmse(values[on_plane], truth), 0.01)
            self.assertGreater(values[on_plane].max(), least)

    def test_bakes_onto_cells_when_asked(self):
        scene = AppendGeometry(Input=[plane(), ball()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100, BakeOn="Cells")
        data = servermanager.Fetch(baked)
        self.assertIsNone(data.GetPointData().GetArray("AmbientOcclusion"))
        values = vtk_to_numpy(data.GetCellData().GetArray("AmbientOcclusion"))[: 24 * 24]
        step = 6 / 24
        x = -3 + step * (numpy.arange(24) + 0.5)
        centres = numpy.array([(a, b, 0) for b in x for a in x])
        self.assertLess(rmse(values, occlusion_under_ball(centres)), 0.01)

    def test_has_the_defaults_of_its_class(self):
        baked = BakeAmbientOcclusion(Input=ball())
        text = str(baked.SMProxy.GetClientSideObject())
        for name in ("Tolerance", "Radius", "OnCells", "ComputeNormals", "PointRadius", "Method",
                     "NumberOfThreads"):
            shown = baked.SMProxy.GetProperty(name).GetElement(0)
            self.assertIn(f"  {name}: {shown:g}\n", text)

    def test_keeps_its_settings_in_a_state_and_in_a_script(self):
        BakeAmbientOcclusion(
            registrationName="Baked", Input=ball(), Tolerance=0.02, Radius=3.5, BakeOn="Cells")
        script = smstate.get_state()
        self.assertIn("BakeAmbientOcclusion(registrationName='Baked'", script)
        for setting in (".Tolerance = 0.02\n", ".Radius = 3.5\n", ".BakeOn = 'Cells'\n"):
            self.assertIn(setting, script)
        with tempfile.TemporaryDirectory() as folder:
            state = os.path.join(folder, "state.pvsm")
            SaveState(state)
            start()
            LoadState(state)
        again = FindSource("Baked")
        self.assertEqual((again.Tolerance, again.Radius, again.BakeOn), (0.02, 3.5, "Cells"))

    def test_tells_its_progress_and_can_be_aborted(self):
        for aborting in (False, True):
            baked = BakeAmbientOcclusion(Input=AppendGeometry(Input=[plane(200), ball()]), Radius=100)
            filter = baked.SMProxy.GetClientSideObject()
            seen = []

            def progress(caller, event):
                seen.append(filter.GetProgress())
                if aborting and seen[-1] > 0.2:
                    filter.SetAbortExecute(1)  # What the button beside ParaView's progress bar does.

            filter.AddObserver("ProgressEvent", progress)
            baked.UpdatePipeline()
            self.assertEqual(seen, sorted(seen))
            self.assertGreater(len(set(seen)), 4)
            if aborting:
                self.assertLess(seen[-2], 0.9)

    def test_returns_an_input_without_points_as_it_is(self):
        nothing = Threshold(Input=AppendDatasets(Input=[ball()]), LowerThreshold=9, UpperThreshold=9)
        nothing.Scalars = ["POINTS", "Normals"]
        data = servermanager.Fetch(BakeAmbientOcclusion(Input=nothing))
        self.assertEqual(data.GetNumberOfPoints(), 0)


class BakeIrradianceFilter(unittest.TestCase):
    def setUp(self):
        start()

    def test_matches_the_closed_form_under_a_sphere(self):
        scene = AppendGeometry(Input=[plane(), ball()])
        colors = [1.0, 0.5, 0.25]
        baked = BakeIrradiance(Input=scene, EnvironmentColor=colors, Bounces=1)
        data = servermanager.Fetch(baked)
        points, values = arrays(data, "Irradiance")
        on_plane = numpy.abs(points[:, 2]) < 1e-6
        open_sky = 1 - occlusion_under_ball(points[on_plane])
        self.assertLess(rmse(values[on_plane], numpy.pi * numpy.outer(open_sky, colors)), 0.01)
        self.assertGreater(statistic(data, "Rays/Total"), 0)
        self.assertIsNone(data.GetPointData().GetArray("AmbientOcclusion"))

    def test_adds_light_that_the_ball_throws_back(self):
        scene = AppendGeometry(Input=[plane(), ball()])
        straight, reflected = (
            arrays(servermanager.Fetch(BakeIrradiance(Input=scene, Bounces=bounces)), "Irradiance")[1]
            for bounces in (1, 3))
        self.assertGreater((reflected - straight).max(), 0.1)
        self.assertGreater((reflected - straight).min(), -0.05)

    def test_has_the_defaults_of_its_class(self):
        baked = BakeIrradiance(Input=ball())
        text = str(baked.SMProxy.GetClientSideObject())
        for name in ("Quantity", "Tolerance", "EnvironmentColor", "Albedo", "Bounces", "OnCells"):
            shown = baked.SMProxy.GetProperty(name)
            values = (shown.GetElement(i) for i in range(shown.GetNumberOfElements()))
            self.assertIn(f"  {name}: {' '.join(f'{value:g}' for value in values)}\n", text)


class AdaptiveRayCastFilter(unittest.TestCase):
    def setUp(self):
        start()

    def test_covers_the_exact_share_of_its_picture(self):
        cast = AdaptiveRayCast(Input=[plane()], Resolution=[90, 90], Background=0)
        image = servermanager.Fetch(cast)
        self.assertEqual(image.GetDimensions(), (90, 90, 1))
        covered = vtk_to_numpy(image.GetPointData().GetArray("Color"))[:, 3].mean()
        # The view holds the sphere around the bounds, seen under 30 degrees.
        half_height = numpy.hypot(3, 3) / numpy.cos(numpy.radians(15))
        self.assertAlmostEqual(float(covered), (3 / half_height) ** 2, places=4)
        self.assertGreater(statistic(image, "Rays/Total"), 0)

    def test_draws_all_its_inputs_and_their_blocks(self):
        separately = AdaptiveRayCast(
            Input=[plane(), ball()], Resolution=[60, 60], GeometryArrays=1, AmbientOcclusion=1)
        together = AdaptiveRayCast(
            Input=[GroupDatasets(Input=[plane(), ball()])], Resolution=[60, 60], GeometryArrays=1,
            AmbientOcclusion=1)
        pictures = [vtk_to_numpy(servermanager.Fetch(cast).GetPointData().GetArray("Color"))
                    for cast in (separately, together)]
        numpy.testing.assert_array_equal(*pictures)
        normals = servermanager.Fetch(together).GetPointData().GetArray("Normal")
        self.assertGreater(numpy.ptp(vtk_to_numpy(normals)), 0.5)

    def test_can_be_aborted_and_draws_all_when_asked_again(self):
        cast = AdaptiveRayCast(Input=[plane(), ball()], Resolution=[200, 200], AmbientOcclusion=1)
        filter = cast.SMProxy.GetClientSideObject()
        seen = []

        def abort(caller, event):
            seen.append(filter.GetProgress())
            filter.SetAbortExecute(1)

        observer = filter.AddObserver("ProgressEvent", abort)
        cast.UpdatePipeline()
        self.assertLess(seen[0], 0.5)
        filter.RemoveObserver(observer)
        filter.SetAbortExecute(0)
        cast.Tolerance = 1 / 128
        cast.UpdatePipeline()
        whole = AdaptiveRayCast(Input=[plane(), ball()], Resolution=[200, 200], AmbientOcclusion=1,
                                Tolerance=1 / 128)
        numpy.testing.assert_array_equal(*(
            vtk_to_numpy(servermanager.Fetch(each).GetPointData().GetArray("Color"))
            for each in (cast, whole)))


run_tests()
