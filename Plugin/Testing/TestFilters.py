# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the filters of the plugin with closed forms."""
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
        reference = occlusion_under_sphere(points[on_plane], height)
        self.assertLess(rmse(values[on_plane], reference), tolerance)
        self.assertGreater(values[on_plane].max(), 0.3)

    def test_matches_the_closed_form_under_a_sphere(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        data = servermanager.Fetch(baked)
        self.check_plane(data)
        self.assertEqual(statistic(data, "Points/Total"), data.GetNumberOfPoints())
        self.assertGreater(statistic(data, "Rays/Total"), 0)
        baked.UpdatePropertyInformation()
        error = baked.SMProxy.GetProperty("EstimatedError").GetElement(0)
        self.assertTrue(0.0 < error < 0.01, error)

    def test_extracts_the_surface_of_an_unstructured_grid(self):
        scene = AppendDatasets(Input=[plane(), sphere()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        self.check_plane(servermanager.Fetch(baked))

    def test_blocks_occlude_each_other(self):
        baked = BakeAmbientOcclusion(Input=GroupDatasets(Input=[plane(), sphere()]), Radius=100)
        self.check_plane(servermanager.Fetch(baked).GetBlock(0))

    def test_updates_with_the_time_step(self):
        with tempfile.TemporaryDirectory() as folder:
            self.check_series(folder)

    def check_series(self, folder):
        scene = AppendGeometry(Input=[rising_sphere(folder), plane()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100)
        for time, minimum in ((0.0, 0.3), (1.0, 0.05)):
            baked.UpdatePipeline(time)
            points, values = arrays(output_data(baked))
            on_plane = numpy.abs(points[:, 2]) < 1e-6
            reference = occlusion_under_sphere(points[on_plane], 0.8 + time)
            self.assertLess(rmse(values[on_plane], reference), 0.01)
            self.assertGreater(values[on_plane].max(), minimum)

    def test_computes_cell_values(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        baked = BakeAmbientOcclusion(Input=scene, Radius=100, BakeOn="Cells")
        data = servermanager.Fetch(baked)
        self.assertIsNone(data.GetPointData().GetArray("AmbientOcclusion"))
        values = vtk_to_numpy(data.GetCellData().GetArray("AmbientOcclusion"))[: 24 * 24]
        step = 6 / 24
        x = -3 + step * (numpy.arange(24) + 0.5)
        centers = numpy.array([(a, b, 0) for b in x for a in x])
        self.assertLess(rmse(values, occlusion_under_sphere(centers)), 0.01)

    def test_has_the_defaults_of_its_class(self):
        baked = BakeAmbientOcclusion(Input=sphere())
        text = str(baked.SMProxy.GetClientSideObject())
        for name in ("Tolerance", "Radius", "OnCells", "ComputeNormals", "PointRadius", "LineRadius",
                     "NumberOfThreads"):
            shown = baked.SMProxy.GetProperty(name).GetElement(0)
            self.assertIn(f"  {name}: {shown:g}\n", text)
        self.assertEqual(baked.SMProxy.GetProperty("Method").GetElement(0), 0)
        self.assertIn("  Method: Automatic\n", text)

    def test_saves_its_settings_in_states_and_scripts(self):
        BakeAmbientOcclusion(
            registrationName="Baked", Input=sphere(), Tolerance=0.02, Radius=3.5, BakeOn="Cells")
        script = smstate.get_state()
        self.assertIn("BakeAmbientOcclusion(registrationName='Baked'", script)
        for setting in (".Tolerance = 0.02\n", ".Radius = 3.5\n", ".BakeOn = 'Cells'\n"):
            self.assertIn(setting, script)
        with tempfile.TemporaryDirectory() as folder:
            state = os.path.join(folder, "state.pvsm")
            SaveState(state)
            start()
            LoadState(state)
        restored = FindSource("Baked")
        self.assertEqual((restored.Tolerance, restored.Radius, restored.BakeOn), (0.02, 3.5, "Cells"))

    def test_reports_progress_and_can_be_aborted(self):
        for aborting in (False, True):
            baked = BakeAmbientOcclusion(Input=AppendGeometry(Input=[plane(200), sphere()]), Radius=100)
            filter = baked.SMProxy.GetClientSideObject()
            progress_values = []

            def progress(caller, event):
                progress_values.append(filter.GetProgress())
                if aborting and progress_values[-1] > 0.2:
                    filter.SetAbortExecute(1)  # ParaView's Abort button calls this method.

            filter.AddObserver("ProgressEvent", progress)
            baked.UpdatePipeline()
            self.assertEqual(progress_values, sorted(progress_values))
            self.assertGreater(len(set(progress_values)), 4)
            if aborting:
                self.assertLess(progress_values[-2], 0.9)

    def test_returns_an_empty_input_unchanged(self):
        empty = Threshold(Input=AppendDatasets(Input=[sphere()]), LowerThreshold=9, UpperThreshold=9)
        empty.Scalars = ["POINTS", "Normals"]
        data = servermanager.Fetch(BakeAmbientOcclusion(Input=empty))
        self.assertEqual(data.GetNumberOfPoints(), 0)


class BakeIrradianceFilter(unittest.TestCase):
    def setUp(self):
        start()

    def test_matches_the_closed_form_under_a_sphere(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        colors = [1.0, 0.5, 0.25]
        baked = BakeIrradiance(Input=scene, EnvironmentColor=colors, Bounces=1)
        data = servermanager.Fetch(baked)
        points, values = arrays(data, "Irradiance")
        on_plane = numpy.abs(points[:, 2]) < 1e-6
        visibility = 1 - occlusion_under_sphere(points[on_plane])
        self.assertLess(rmse(values[on_plane], numpy.pi * numpy.outer(visibility, colors)), 0.01)
        self.assertGreater(statistic(data, "Rays/Total"), 0)
        self.assertIsNone(data.GetPointData().GetArray("AmbientOcclusion"))

    def test_adds_light_reflected_by_the_sphere(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        direct, reflected = (
            arrays(servermanager.Fetch(BakeIrradiance(Input=scene, Bounces=bounces)), "Irradiance")[1]
            for bounces in (1, 3))
        self.assertGreater((reflected - direct).max(), 0.1)
        self.assertGreater((reflected - direct).min(), -0.05)

    def test_has_the_defaults_of_its_class(self):
        baked = BakeIrradiance(Input=sphere())
        text = str(baked.SMProxy.GetClientSideObject())
        self.assertIn("  Quantity: Irradiance\n", text)
        for name in ("Tolerance", "EnvironmentColor", "Albedo", "Bounces", "OnCells"):
            shown = baked.SMProxy.GetProperty(name)
            values = (shown.GetElement(i) for i in range(shown.GetNumberOfElements()))
            self.assertIn(f"  {name}: {' '.join(f'{value:g}' for value in values)}\n", text)


class BakeDirectLightFilter(unittest.TestCase):
    def setUp(self):
        start()

    def lit_by(self, points, light):
        """Return the direct light of a plane with a sphere in its middle, and which points are off the shadow's edge."""
        x, y, z, w = light
        toward = numpy.array([x, y, z]) - w * points
        toward = toward / numpy.linalg.norm(toward, axis=1)[:, None]
        to_center = numpy.array([0, 0, SPHERE_HEIGHT]) - points
        distance = numpy.linalg.norm(numpy.cross(to_center, toward), axis=1)
        return numpy.where(distance > SPHERE_RADIUS, toward[:, 2], 0), numpy.abs(distance - SPHERE_RADIUS) > 0.01

    def test_sums_lights_behind_a_sphere(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        lights = ((1, 0, 2, 0), (0, 1, 4, 1))
        baked = BakeDirectLight(Input=scene, Lights=[number for light in lights for number in light])
        data = servermanager.Fetch(baked)
        points, values = arrays(data, "DirectLight")
        on_plane = numpy.abs(points[:, 2]) < 1e-6
        exact, clear = zip(*(self.lit_by(points[on_plane], light) for light in lights))
        clear = numpy.logical_and(*clear)
        self.assertLess(rmse(values[on_plane][clear], sum(exact)[clear]), 1e-5)
        self.assertGreater(numpy.count_nonzero(values[on_plane] < 1), 8)
        self.assertGreater(statistic(data, "Rays/Shadow"), 0)
        self.assertIsNone(data.GetPointData().GetArray("AmbientOcclusion"))

    def test_sizes_of_lights_make_soft_shadows(self):
        scene = AppendGeometry(Input=[plane(), sphere()])
        hard = BakeDirectLight(Input=scene)  # from above
        soft = BakeDirectLight(Input=scene, LightAngle=40)
        near = BakeDirectLight(Input=scene, Lights=[0, 0, 4, 1], LightRadius=1, BakeOn="Cells")
        points, values = arrays(servermanager.Fetch(hard), "DirectLight")
        on_plane = numpy.abs(points[:, 2]) < 1e-6
        self.assertEqual(set(numpy.unique(values[on_plane])), {0, 1})
        penumbra = arrays(servermanager.Fetch(soft), "DirectLight")[1][on_plane]
        self.assertGreater(numpy.count_nonzero((penumbra > 0.1) & (penumbra < 0.9)), 8)
        cells = vtk_to_numpy(servermanager.Fetch(near).GetCellData().GetArray("DirectLight"))
        self.assertGreater(numpy.ptp(cells[: 24 * 24]), 0.5)

    def test_has_the_defaults_of_its_class(self):
        baked = BakeDirectLight(Input=sphere())
        text = str(baked.SMProxy.GetClientSideObject())
        self.assertIn("  Quantity: DirectLight\n", text)
        for name in ("Tolerance", "LightRadius", "LightAngle", "OnCells"):
            self.assertIn(f"  {name}: {baked.SMProxy.GetProperty(name).GetElement(0):g}\n", text)
        self.assertIn("  Lights: 1\n", text)

    def test_saves_its_lights_in_states(self):
        BakeDirectLight(registrationName="Baked", Input=sphere(), Lights=[1, 0, 2, 0, 0, 1, 4, 1], LightAngle=0.53)
        with tempfile.TemporaryDirectory() as folder:
            state = os.path.join(folder, "state.pvsm")
            SaveState(state)
            start()
            LoadState(state)
        restored = FindSource("Baked")
        self.assertEqual((list(restored.Lights), restored.LightAngle), ([1, 0, 2, 0, 0, 1, 4, 1], 0.53))


class AdaptiveRayCastFilter(unittest.TestCase):
    def setUp(self):
        start()

    def test_computes_exact_coverage(self):
        cast = AdaptiveRayCast(Input=[plane()], Resolution=[90, 90], Background=0)
        image = servermanager.Fetch(cast)
        self.assertEqual(image.GetDimensions(), (90, 90, 1))
        covered = vtk_to_numpy(image.GetPointData().GetArray("Color"))[:, 3].mean()
        # The camera frames the bounding sphere with a view angle of 30 degrees.
        half_height = numpy.hypot(3, 3) / numpy.cos(numpy.radians(15))
        self.assertAlmostEqual(float(covered), (3 / half_height) ** 2, places=4)
        self.assertGreater(statistic(image, "Rays/Total"), 0)

    def test_renders_all_inputs_and_blocks(self):
        separately = AdaptiveRayCast(
            Input=[plane(), sphere()], Resolution=[60, 60], GeometryArrays=1, AmbientOcclusion=1)
        together = AdaptiveRayCast(
            Input=[GroupDatasets(Input=[plane(), sphere()])], Resolution=[60, 60], GeometryArrays=1,
            AmbientOcclusion=1)
        images = [vtk_to_numpy(servermanager.Fetch(cast).GetPointData().GetArray("Color"))
                    for cast in (separately, together)]
        numpy.testing.assert_array_equal(*images)
        normals = servermanager.Fetch(together).GetPointData().GetArray("Normal")
        self.assertGreater(numpy.ptp(vtk_to_numpy(normals)), 0.5)

    def test_can_be_aborted_and_restarted(self):
        cast = AdaptiveRayCast(Input=[plane(), sphere()], Resolution=[200, 200], AmbientOcclusion=1)
        filter = cast.SMProxy.GetClientSideObject()
        progress_values = []

        def abort(caller, event):
            progress_values.append(filter.GetProgress())
            filter.SetAbortExecute(1)

        observer = filter.AddObserver("ProgressEvent", abort)
        cast.UpdatePipeline()
        self.assertLess(progress_values[0], 0.5)
        filter.RemoveObserver(observer)
        filter.SetAbortExecute(0)
        cast.Tolerance = 1 / 128
        cast.UpdatePipeline()
        complete = AdaptiveRayCast(Input=[plane(), sphere()], Resolution=[200, 200], AmbientOcclusion=1,
                                Tolerance=1 / 128)
        numpy.testing.assert_array_equal(*(
            vtk_to_numpy(servermanager.Fetch(each).GetPointData().GetArray("Color"))
            for each in (cast, complete)))


run_tests()
