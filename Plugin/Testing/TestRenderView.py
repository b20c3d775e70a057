# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Render View (Penumbra): its effects against closed forms and against rays."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *
from paraview import smstate, smtrace
from paraview.modules import vtkRemotingServerManager

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

    def test_saves_several_views_in_one_picture(self):
        other = view_of_ball("PenumbraRenderView")
        layout = CreateLayout("both")
        AssignViewToLayout(view=self.view, layout=layout)
        layout.SplitViewHorizontal(self.view)
        AssignViewToLayout(view=other, layout=layout)
        layout.SetSize(404, 200)
        path = os.path.join(self.folder.name, "both.png")
        SaveScreenshot(path, layout, ImageResolution=[404, 200])
        both = read_picture(path)
        for view, half in ((self.view, both[:, :self.view.ViewSize[0]]),
                           (other, both[:, -other.ViewSize[0]:])):
            numpy.testing.assert_array_equal(half, screenshot(view, self.folder.name))
            self.assertGreater(numpy.ptp(half[50:]), 60)

    def test_saves_frames_of_an_animation_that_have_converged(self):
        for source in GetSources().values():
            Hide(source, self.view)
        shown = Show(AppendGeometry(Input=[rising_ball(self.folder.name), plane()]), self.view)
        shown.Ambient, shown.Diffuse = 1, 0
        self.view.ViewSize = [120, 120]
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        SaveAnimation(os.path.join(self.folder.name, "frame.png"), self.view, ImageResolution=[120, 120],
                      FrameWindow=[0, 1])
        frames = []
        for step, moment in enumerate(scene.TimeKeeper.TimestepValues):
            frames.append(read_picture(os.path.join(self.folder.name, f"frame.{step:04}.png")))
            self.view.ViewTime = moment
            self.assertLess(rmse(frames[-1], self.picture()) / 255, 0.01)
        self.assertGreater(numpy.abs(frames[0].astype(int) - frames[1]).max(), 32)

    def test_draws_stereo_as_the_plain_view_does(self):
        stereo = {"StereoMode": "Left Eye Only"}
        dark = self.picture(**stereo).astype(int)
        self.view.AmbientOcclusion = 0
        off = numpy.abs(dark - self.picture(**stereo)).max(axis=2)
        self.assertLess((off > 8).mean(), 0.005)  # Edges may be smoothed otherwise.

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

    def test_undoes_and_redoes_its_settings(self):
        builder = vtkRemotingServerManager.vtkSMUndoStackBuilder()
        stack = vtkRemotingServerManager.vtkSMUndoStack()
        stack.SetStackDepth(len(SETTINGS))
        builder.SetUndoStack(stack)
        vtkRemotingServerManager.vtkSMProxyManager.GetProxyManager().SetUndoStackBuilder(builder)
        self.addCleanup(builder.SetUndoStack, None)
        self.view = CreateView("PenumbraRenderView")
        before = {name: self.setting(name) for name in SETTINGS}
        for name, value in SETTINGS.items():
            builder.Begin(name)  # As the panel does with each change.
            setattr(self.view, name, value)
            builder.EndAndPushToStack()
        for name in reversed(SETTINGS):
            self.assertEqual(stack.GetUndoSetLabel(0), name)
            self.assertEqual(self.setting(name), SETTINGS[name], name)
            stack.Undo()
            self.assertEqual(self.setting(name), before[name], name)
        while stack.CanRedo():
            stack.Redo()
        self.assertEqual({name: self.setting(name) for name in SETTINGS}, SETTINGS)

    def setting(self, name):
        value = getattr(self.view, name)
        if isinstance(value, (int, float)):
            return value
        return list(value) if len(value) > 1 else value[0]

    def test_tells_its_settings_to_a_trace(self):
        smtrace.start_trace()
        change = smtrace.PropertiesModified(self.view.SMProxy)  # What the panel's Apply wraps its work in.
        for name, value in SETTINGS.items():
            setattr(self.view, name, value)
        change.finalize()
        trace = smtrace.stop_trace()
        for name, value in SETTINGS.items():
            self.assertIn(f".{name} = {value!r}\n", trace)

    def test_lays_volumes_over_what_it_darkens(self):
        self.view.UseFXAA = 0  # ParaView smooths edges before it draws volumes, this view after.
        # A cloud within the bounds of the scene, before the plane and before the background.
        cloud = ResampleToImage(Input=Wavelet(), UseInputBounds=0, SamplingDimensions=[12, 12, 12],
                                SamplingBounds=[-2.5, 0, -1.5, 3, 0.9, 1.3])
        shown = Show(cloud, self.view)
        shown.Representation = "Volume"
        ColorBy(shown, ("POINTS", "RTData"))
        self.view.CameraPosition = [0, -6, 4]
        for source in GetSources().values():
            GetDisplayProperties(source, self.view).AmbientColor = [0.2, 0.8, 0.2]  # No colour of the cloud's.
        clear, dark = [], []
        for pictures, occlusion in ((clear, 0), (dark, 1)):
            self.view.AmbientOcclusion = occlusion
            for visible in (0, 1):
                shown.Visibility = visible
                pictures.append(self.picture().astype(int))
        thick = numpy.abs(clear[1] - clear[0]).max(axis=2)
        darkened = clear[0] - dark[0]
        without = thick == 0
        self.assertGreater(numpy.abs(darkened[without]).max(), 60)
        self.assertLessEqual(numpy.abs(dark[1] - dark[0])[without].max(), 2)
        # Before the background the cloud is as it was; else it hides what is dark as far as it hides it.
        open_sky = (thick > 8) & (darkened == 0).all(axis=2)
        self.assertGreater(numpy.count_nonzero(open_sky), 500)
        self.assertLessEqual(numpy.abs(dark[1] - clear[1])[open_sky].max(), 1)
        before_plane = (thick > 8) & (darkened.max(axis=2) > 8)
        self.assertGreater(numpy.count_nonzero(before_plane), 100)
        left = (clear[1] - dark[1])[before_plane]
        self.assertGreaterEqual(left.min(), -1)
        self.assertLess((left - darkened[before_plane]).max(), 1)

    def test_lays_translucent_surfaces_over_what_it_darkens(self):
        glass = Show(Plane(Origin=[-3, -1, 1], Point1=[3, -1, 1], Point2=[-3, 3, 1]), self.view)
        glass.Opacity = 0.5
        glass.Ambient, glass.Diffuse = 1, 0
        glass.AmbientColor = glass.DiffuseColor = [0, 0, 1]
        seen, _ = plane_pixels(self.view)
        with_glass = self.picture()[seen].astype(int)
        glass.Visibility = 0
        without = self.picture()[seen].astype(int)
        behind = with_glass[:, 2] - without[:, 2] > 8
        self.assertGreater(numpy.count_nonzero(behind), 500)
        truth = 0.5 * without[behind] + 0.5 * numpy.array([0, 0, 255])
        self.assertLess(numpy.abs(with_glass[behind] - truth).max(), 3)


run_tests()
