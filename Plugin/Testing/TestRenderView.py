# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Render View (Penumbra): its effects against closed forms and against rays."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from paraview import smstate

SETTINGS = {
    "Tolerance": 0.02, "AmbientOcclusion": 0, "OcclusionRadius": 0.2, "OcclusionStrength": 0.5,
    "OcclusionKernel": "horizon", "LightShafts": 1, "ShaftDensity": 0.5, "ShaftExposure": 3.0,
    "ShaftThickness": 0.3, "SunDirection": [1.0, 2.0, 3.0], "SunIntensity": 2.0, "StillByRays": 1}


class RenderViewPenumbra(unittest.TestCase):
    def setUp(self):
        start()
        self.view = view_of_ball("PenumbraRenderView")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def picture(self, **options):
        return screenshot(self.view, self.folder.name, **options)

    def plain(self):
        self.view.AmbientOcclusion = 0
        picture = self.picture()
        self.view.AmbientOcclusion = 1
        return picture

    def test_shows_the_closed_form_by_rays(self):
        self.view.StillByRays = 1
        self.view.OcclusionRadius = 10
        seen, points = plane_pixels(self.view)
        values = 1 - self.picture()[..., 0][seen] / 255
        truth = occlusion_under_ball(points)
        self.assertGreater(len(truth), 5000)
        self.assertLess(rmse(values, truth), 0.01)

    def test_comes_near_to_rays_from_depth_alone(self):
        dark = self.picture()
        self.view.StillByRays = 1
        truth = self.picture()
        seen, _ = plane_pixels(self.view)
        error = rmse(dark[seen], truth[seen]) / 255
        self.assertLess(error, 0.04)
        self.assertGreater(rmse(self.plain()[seen], truth[seen]) / 255, 2 * error)

    def test_changes_nothing_when_all_effects_are_off(self):
        picture = self.plain()
        other = view_of_ball("RenderView")
        numpy.testing.assert_array_equal(picture, screenshot(other, self.folder.name))

    def test_has_converged_when_a_screenshot_is_saved(self):
        first = self.picture()
        numpy.testing.assert_array_equal(self.picture(), first)
        self.view.Tolerance = 0.002
        self.assertLess(rmse(self.picture(), first) / 255, 0.01)

    def test_saves_pictures_larger_than_the_view_without_seams(self):
        self.view.ViewSize = [100, 100]
        large = self.picture(ImageResolution=[200, 200])
        self.assertEqual(list(self.view.ViewSize), [100, 100])
        self.view.ViewSize = [200, 200]
        numpy.testing.assert_array_equal(large, self.picture())

    def test_saves_a_transparent_background(self):
        picture = self.picture(TransparentBackground=1)
        opaque = self.picture()
        self.assertEqual(picture.shape[2], 4)
        seen, _ = plane_pixels(self.view)
        self.assertTrue((picture[..., 3][seen] == 255).all())
        self.assertEqual(picture[-2, 2, 3], 0)
        numpy.testing.assert_array_equal(picture[..., :3][seen], opaque[seen])

    def test_leaves_selection_alone(self):
        width, height = self.view.ViewSize
        SelectSurfacePoints(Rectangle=[0, 0, width - 1, height - 1], View=self.view)
        self.assertTrue(any(source.GetSelectionInput(0) for source in GetSources().values()))
        seen, _ = plane_pixels(self.view)
        # The selected points are marked in the picture that the pass has made.
        self.assertGreater(numpy.ptp(self.picture()[seen], axis=1).max(), 100)

    def test_takes_light_away_in_haze_as_the_closed_form_says(self):
        self.view.AmbientOcclusion = 0
        self.view.LightShafts = 1
        self.view.SunIntensity = 1e-6
        seen, points = plane_pixels(self.view)
        distances = numpy.linalg.norm(points - self.view.CameraPosition, axis=1)
        diagonal = numpy.linalg.norm([6, 6, SPHERE_HEIGHT + SPHERE_RADIUS])
        truth = numpy.exp(-0.25 * distances / diagonal)
        dimmed = self.picture()
        self.assertLess(rmse(dimmed[..., 0][seen] / 255, truth), 0.003)
        self.view.SunIntensity = 5
        self.assertGreater((self.picture()[seen] / 255 - dimmed[seen] / 255).max(), 0.02)

    def test_keeps_its_memory_over_500_frames(self):
        self.view.ViewSize = [64, 64]
        self.view.Tolerance = 0.1
        self.view.LightShafts = 1
        for frame in range(500):
            angle = 2 * numpy.pi * frame / 500
            self.view.CameraPosition = [6 * numpy.sin(angle), -6 * numpy.cos(angle), 8]
            Render(self.view)
            if frame == 100:
                before = resident_megabytes()
        self.assertLess(resident_megabytes() - before, 10)

    def test_has_the_defaults_of_its_class(self):
        shown = CreateView("PenumbraRenderView")
        text = str(shown.SMProxy.GetClientSideObject())
        for name in SETTINGS:
            name = name.replace("Tolerance", "PenumbraTolerance")
            elements = shown.SMProxy.GetProperty(name)
            values = [elements.GetElement(i) for i in range(elements.GetNumberOfElements())]
            values = [v if isinstance(v, str) else f"{v:g}" for v in values]
            self.assertIn(f"{name}: {', '.join(values)}\n", text)

    def test_keeps_its_settings_in_a_state_and_in_a_script(self):
        for name, value in SETTINGS.items():
            setattr(self.view, name, value)
        script = smstate.get_state()
        self.assertIn("CreateView('PenumbraRenderView')", script)
        for name in SETTINGS:
            self.assertIn(f".{name} = ", script)
        state = os.path.join(self.folder.name, "state.pvsm")
        SaveState(state)
        start()
        LoadState(state)
        again = GetViews()[0]
        for name, value in SETTINGS.items():
            self.assertEqual(getattr(again, name), value, name)

    def test_shows_volumes_as_the_plain_view_does(self):
        pictures = []
        with tempfile.TemporaryDirectory() as folder:
            for kind in ("RenderView", "PenumbraRenderView"):
                view = CreateView(kind)
                view.ViewSize = [100, 80]
                shown = Show(Wavelet(WholeExtent=[-8, 8, -8, 8, -8, 8]), view)
                shown.Representation = "Volume"
                ColorBy(shown, ("POINTS", "RTData"))
                view.CameraPosition = [20, 30, 40]
                pictures.append(screenshot(view, folder).astype(int))
        self.assertGreater(numpy.ptp(pictures[0]), 50)
        self.assertLess(numpy.abs(pictures[1] - pictures[0]).max(), 8)


run_tests()
