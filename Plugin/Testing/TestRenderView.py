# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the effects of Render View (Penumbra) with closed forms and with ray casting."""
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
    "ShaftRayleigh": 0.25, "ShaftAsymmetry": 0.5, "ShaftScaleHeight": 2.0, "ShaftUp": [0.0, 0.0, 1.0],
    "ShaftEstimator": "Shadow Map",
    "ShaftThickness": 0.3, "SunDirection": [1.0, 2.0, 3.0], "SunIntensity": 2.0, "SunAngle": 0.5, "StillByRays": 1}


class RenderViewPenumbra(unittest.TestCase):
    def setUp(self):
        start()
        self.view = sphere_view("PenumbraRenderView")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def image(self, **options):
        return screenshot(self.view, self.folder.name, **options)

    def plain(self):
        self.view.AmbientOcclusion = 0
        image = self.image()
        self.view.AmbientOcclusion = 1
        return image

    def test_ray_cast_matches_the_closed_form(self):
        self.view.StillByRays = 1
        self.view.OcclusionRadius = 10
        mask, points = plane_mask(self.view)
        values = 1 - self.image()[..., 0][mask] / 255
        reference = occlusion_under_sphere(points)
        self.assertGreater(len(reference), 5000)
        self.assertLess(rmse(values, reference), 0.01)

    def test_screen_space_occlusion_is_close_to_ray_casting(self):
        dark = self.image()
        self.view.StillByRays = 1
        reference = self.image()
        mask, _ = plane_mask(self.view)
        error = rmse(dark[mask], reference[mask]) / 255
        self.assertLess(error, 0.04)
        self.assertGreater(rmse(self.plain()[mask], reference[mask]) / 255, 2 * error)

    def test_matches_the_plain_view_without_effects(self):
        image = self.plain()
        other = sphere_view("RenderView")
        numpy.testing.assert_array_equal(image, screenshot(other, self.folder.name))

    def test_tone_mapping_disables_the_effects(self):
        other = sphere_view("RenderView")
        plain = screenshot(other, self.folder.name)
        other.UseToneMapping = 1
        mapped = screenshot(other, self.folder.name)
        self.assertGreater(rmse(mapped, plain), 8)
        for effect, warnings in (None, 0), ("AmbientOcclusion", 1), ("StillByRays", 0), ("LightShafts", 0):
            self.view.AmbientOcclusion = 0
            if effect:
                setattr(self.view, effect, 1)
            before = self.image()
            with captured_messages() as messages:
                self.view.UseToneMapping = 1
                numpy.testing.assert_array_equal(self.image(), mapped, str(effect))
                self.view.UseToneMapping = 0
            self.assertEqual(messages.GetOutput().count("while tone mapping is on"), warnings, effect)
            numpy.testing.assert_array_equal(self.image(), before, str(effect))
            if effect:
                setattr(self.view, effect, 0)

    def test_warns_of_a_missed_tolerance_by_its_own_setting(self):
        self.view = CreateView("PenumbraRenderView", ViewSize=[100, 100])
        Show(OpenDataFile(os.path.join(ROOT, "Data", "head.ply")), self.view)
        ResetCamera(self.view)
        self.view.StillByRays = self.view.LightShafts = 1
        self.view.SunAngle = 2
        self.view.Tolerance = 0.001
        self.view.UseLight = 0
        with captured_messages() as messages:
            self.image()
        self.assertEqual(messages.GetOutput().count("The tolerance of 0.001 was not reached"), 1,
                         messages.GetOutput())
        self.assertIn("Increase Tolerance.", messages.GetOutput())
        self.assertNotIn("LightTolerance", messages.GetOutput())

    def test_screenshots_have_converged(self):
        first = self.image()
        numpy.testing.assert_array_equal(self.image(), first)
        self.view.Tolerance = 0.002
        self.assertLess(rmse(self.image(), first) / 255, 0.01)

    def test_large_screenshots_have_no_seams(self):
        self.view.ViewSize = [100, 100]
        large = self.image(ImageResolution=[200, 200])
        self.assertEqual(list(self.view.ViewSize), [100, 100])
        self.view.ViewSize = [200, 200]
        numpy.testing.assert_array_equal(large, self.image())

    def test_supports_transparent_backgrounds(self):
        image = self.image(TransparentBackground=1)
        opaque = self.image()
        self.assertEqual(image.shape[2], 4)
        mask, _ = plane_mask(self.view)
        self.assertTrue((image[..., 3][mask] == 255).all())
        self.assertEqual(image[-2, 2, 3], 0)
        numpy.testing.assert_array_equal(image[..., :3][mask], opaque[mask])

    def test_saves_several_views_in_one_image(self):
        other = sphere_view("PenumbraRenderView")
        layout = CreateLayout("both")
        AssignViewToLayout(view=self.view, layout=layout)
        layout.SplitViewHorizontal(self.view)
        AssignViewToLayout(view=other, layout=layout)
        layout.SetSize(404, 200)
        path = os.path.join(self.folder.name, "both.png")
        SaveScreenshot(path, layout, ImageResolution=[404, 200])
        both = read_image(path)
        for view, half in ((self.view, both[:, :self.view.ViewSize[0]]),
                           (other, both[:, -other.ViewSize[0]:])):
            numpy.testing.assert_array_equal(half, screenshot(view, self.folder.name))
            self.assertGreater(numpy.ptp(half[50:]), 60)

    def test_animation_frames_have_converged(self):
        for source in GetSources().values():
            Hide(source, self.view)
        shown = Show(AppendGeometry(Input=[rising_sphere(self.folder.name), plane()]), self.view)
        shown.Ambient, shown.Diffuse = 1, 0
        self.view.ViewSize = [120, 120]
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        SaveAnimation(os.path.join(self.folder.name, "frame.png"), self.view, ImageResolution=[120, 120],
                      FrameWindow=[0, 1])
        frames = []
        for step, moment in enumerate(scene.TimeKeeper.TimestepValues):
            frames.append(read_image(os.path.join(self.folder.name, f"frame.{step:04}.png")))
            self.view.ViewTime = moment
            self.assertLess(rmse(frames[-1], self.image()) / 255, 0.01)
        self.assertGreater(numpy.abs(frames[0].astype(int) - frames[1]).max(), 32)

    def test_renders_occlusion_in_stereo(self):
        stereo = {"StereoMode": "Left Eye Only"}
        dark = self.image(**stereo).astype(int)
        self.view.AmbientOcclusion = 0
        difference = self.image(**stereo).astype(int) - dark
        self.assertGreater((difference.max(axis=2) > 8).mean(), 0.02)
        self.assertLess((difference.min(axis=2) < -8).mean(), 0.005)  # The antialiasing of edges may differ.

    def test_supports_selection(self):
        width, height = self.view.ViewSize
        SelectSurfacePoints(Rectangle=[0, 0, width - 1, height - 1], View=self.view)
        self.assertTrue(any(source.GetSelectionInput(0) for source in GetSources().values()))
        mask, _ = plane_mask(self.view)
        # The selected points are highlighted in the processed image.
        self.assertGreater(numpy.ptp(self.image()[mask], axis=1).max(), 100)

    def test_extinction_matches_the_closed_form(self):
        self.view.AmbientOcclusion = 0
        self.view.LightShafts = 1
        self.view.SunIntensity = 1e-6
        mask, points = plane_mask(self.view)
        distances = numpy.linalg.norm(points - self.view.CameraPosition, axis=1)
        diagonal = numpy.linalg.norm([6, 6, SPHERE_HEIGHT + SPHERE_RADIUS])
        reference = numpy.exp(-0.25 * distances / diagonal)
        dimmed = self.image()
        self.assertLess(rmse(dimmed[..., 0][mask] / 255, reference), 0.003)
        self.view.SunIntensity = 5
        self.assertGreater((self.image()[mask] / 255 - dimmed[mask] / 255).max(), 0.02)

    def test_the_light_kit_does_not_light_the_haze(self):
        self.view.AmbientOcclusion = 0
        self.view.LightShafts = 1
        for rays in 0, 1:
            self.view.StillByRays = rays
            images = []
            for self.view.UseLight in 1, 0:
                images.append(self.image())
            numpy.testing.assert_array_equal(*images)

    def test_extinction_of_small_particles_matches_the_closed_form(self):
        self.view.AmbientOcclusion = 0
        self.view.LightShafts = 1
        self.view.SunIntensity = 1e-6
        self.view.ShaftDensity = 0.1
        self.view.ShaftRayleigh = 0.3
        self.view.ShaftAsymmetry = 0.7
        mask, points = plane_mask(self.view)
        distances = numpy.linalg.norm(points - self.view.CameraPosition, axis=1)
        diagonal = numpy.linalg.norm([6, 6, SPHERE_HEIGHT + SPHERE_RADIUS])
        extinction = 0.1 + 0.3 * numpy.array([0.42797, 1, 2.44141])
        reference = numpy.exp(-numpy.outer(distances, extinction) / diagonal)
        for estimator in "Depth", "Shadow Map":
            self.view.ShaftEstimator = estimator
            self.assertLess(rmse(self.image()[mask] / 255, reference), 0.003)
        self.view.ShaftScaleHeight = 0.01
        self.view.ShaftUp = [0, 0, 1]
        # Seen from above, the optical depth is at most 0.01 (0.1 + 0.3 * 2.44) / 0.8.
        self.assertGreater(self.image()[mask].min(), 250)

    def test_memory_is_constant_over_500_frames(self):
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

    def test_saves_its_settings_in_states_and_scripts(self):
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
        restored = GetViews()[0]
        for name, value in SETTINGS.items():
            self.assertEqual(getattr(restored, name), value, name)

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
            builder.Begin(name)  # Same as a change in the Properties panel.
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

    def test_traces_its_settings(self):
        smtrace.start_trace()
        change = smtrace.PropertiesModified(self.view.SMProxy)  # Same as Apply in the Properties panel.
        for name, value in SETTINGS.items():
            setattr(self.view, name, value)
        change.finalize()
        trace = smtrace.stop_trace()
        for name, value in SETTINGS.items():
            self.assertIn(f".{name} = {value!r}\n", trace)

    def test_renders_volumes_over_darkened_surfaces(self):
        self.view.UseFXAA = 0  # ParaView applies FXAA before volumes, this view after them.
        # A volume within the scene bounds, in front of the plane and of the background.
        cloud = ResampleToImage(Input=Wavelet(), UseInputBounds=0, SamplingDimensions=[12, 12, 12],
                                SamplingBounds=[-2.5, 0, -1.5, 3, 0.9, 1.3])
        shown = Show(cloud, self.view)
        shown.Representation = "Volume"
        ColorBy(shown, ("POINTS", "RTData"))
        self.view.CameraPosition = [0, -6, 4]
        for source in GetSources().values():
            # A color that the volume does not have.
            GetDisplayProperties(source, self.view).AmbientColor = [0.2, 0.8, 0.2]
        clear, dark = [], []
        for images, occlusion in ((clear, 0), (dark, 1)):
            self.view.AmbientOcclusion = occlusion
            for visible in (0, 1):
                shown.Visibility = visible
                images.append(self.image().astype(int))
        opacity = numpy.abs(clear[1] - clear[0]).max(axis=2)
        darkened = clear[0] - dark[0]
        without = opacity == 0
        self.assertGreater(numpy.abs(darkened[without]).max(), 60)
        self.assertLessEqual(numpy.abs(dark[1] - dark[0])[without].max(), 2)
        # In front of the background the volume is unchanged; elsewhere it attenuates the darkening.
        in_front_of_background = (opacity > 8) & (darkened == 0).all(axis=2)
        self.assertGreater(numpy.count_nonzero(in_front_of_background), 500)
        self.assertLessEqual(numpy.abs(dark[1] - clear[1])[in_front_of_background].max(), 1)
        in_front_of_plane = (opacity > 8) & (darkened.max(axis=2) > 8)
        self.assertGreater(numpy.count_nonzero(in_front_of_plane), 100)
        left = (clear[1] - dark[1])[in_front_of_plane]
        self.assertGreaterEqual(left.min(), -1)
        self.assertLess((left - darkened[in_front_of_plane]).max(), 1)

    def test_renders_translucent_surfaces_over_darkened_surfaces(self):
        glass = Show(Plane(Origin=[-3, -1, 1], Point1=[3, -1, 1], Point2=[-3, 3, 1]), self.view)
        glass.Opacity = 0.5
        glass.Ambient, glass.Diffuse = 1, 0
        glass.AmbientColor = glass.DiffuseColor = [0, 0, 1]
        mask, _ = plane_mask(self.view)
        with_glass = self.image()[mask].astype(int)
        glass.Visibility = 0
        without = self.image()[mask].astype(int)
        behind = with_glass[:, 2] - without[:, 2] > 8
        self.assertGreater(numpy.count_nonzero(behind), 500)
        reference = 0.5 * without[behind] + 0.5 * numpy.array([0, 0, 255])
        self.assertLess(numpy.abs(with_glass[behind] - reference).max(), 3)


run_tests()
