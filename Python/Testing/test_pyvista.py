# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the accessors of PyVista with either VTK, without a display."""
import importlib.metadata
import importlib.util
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy
import pyvista
from pyvista import _vtk

import penumbra
from penumbra.conversion import statistics_dict
from penumbra.passes import passes_of


def rmse(a, b):
    return float(numpy.sqrt(numpy.mean((numpy.asarray(a, float) - numpy.asarray(b, float)) ** 2)))


def plane():
    return pyvista.Plane(i_size=6, j_size=6, i_resolution=24, j_resolution=24)


def sphere():
    return pyvista.Sphere(
        radius=0.5, center=(0, 0, 0.8), theta_resolution=120, phi_resolution=120)


def scene(**options):
    plotter = pyvista.Plotter(off_screen=True, window_size=(160, 120))
    for mesh in (plane(), sphere()):
        plotter.add_mesh(mesh, color="white", **options)
    plotter.camera_position = [(2.0, -4.0, 3.0), (0.0, 0.0, 0.3), (0.0, 0.0, 1.0)]
    return plotter


def closed_form(points):
    """Fraction of the hemisphere around +z that the sphere covers."""
    return 0.25 * 0.8 / numpy.linalg.norm(points - [0, 0, 0.8], axis=1) ** 3


class BakedOcclusion(unittest.TestCase):
    def check(self, baked):
        values = baked["AmbientOcclusion"]
        self.assertLess(rmse(values, closed_form(baked.points)), 0.01)
        self.assertGreater(values.max(), 0.3)

    def test_matches_the_closed_form_under_a_sphere(self):
        both = plane().merge(sphere(), merge_points=False)
        baked = both.penumbra.bake_ambient_occlusion(radius=math.inf, statistics=True)
        on_plane = numpy.abs(baked.points[:, 2]) < 1e-6
        reference = closed_form(baked.points[on_plane])
        self.assertLess(rmse(baked["AmbientOcclusion"][on_plane], reference), 0.01)
        self.assertGreater(baked.field_data["Rays/Total"][0], 0)
        self.assertLess(baked.field_data["EstimatedError"][0], 0.01)
        self.assertNotIn("AmbientOcclusion", both.array_names)

    def test_blocks_occlude_each_other(self):
        blocks = pyvista.MultiBlock([plane(), sphere()])
        self.check(blocks.penumbra.bake_ambient_occlusion(radius=100.0)[0])

    def test_inplace_adds_the_array_to_the_mesh(self):
        mesh = sphere()
        self.assertIs(mesh.penumbra.bake_ambient_occlusion(inplace=True), mesh)
        self.assertEqual(len(mesh["AmbientOcclusion"]), mesh.n_points)

    def test_computes_one_value_per_cell_of_a_volume(self):
        grid = pyvista.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid()
        baked = grid.penumbra.bake_ambient_occlusion(on="cells")
        self.assertEqual(baked.cell_data["AmbientOcclusion"].size, 8)
        self.assertLess(baked.cell_data["AmbientOcclusion"].max(), 0.05)

    def test_refuses_a_negative_line_radius(self):
        for bake in (sphere().penumbra.bake_ambient_occlusion, sphere().penumbra.bake_irradiance):
            with self.assertRaisesRegex(ValueError, "line_radius"):
                bake(line_radius=-1.0)

    def test_aborts_on_ctrl_c(self):
        mesh = sphere()
        alarm = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        alarm.start()
        with self.assertRaises(KeyboardInterrupt):
            mesh.penumbra.bake_ambient_occlusion(tolerance=1e-4, inplace=True)
        self.assertNotIn("AmbientOcclusion", mesh.point_data)

    def test_leaves_nothing_in_the_field_data_unless_asked(self):
        mesh = sphere()
        mesh.field_data["Points/Total"] = [7]
        baked = mesh.penumbra.bake_ambient_occlusion()
        self.assertEqual(list(baked.field_data), ["Points/Total"])
        self.assertEqual(baked.field_data["Points/Total"][0], 7)
        blocks = pyvista.MultiBlock([pyvista.Sphere(), plane()]).penumbra.bake_irradiance(tolerance=0.1)
        self.assertEqual([list(each.field_data) for each in (blocks, *blocks)], [[], [], []])
        asked = sphere().penumbra.bake_irradiance(statistics=True)
        self.assertIn("EstimatedError", asked.field_data)

    def test_says_what_is_baked(self):
        baked = sphere().penumbra.bake_ambient_occlusion()
        self.assertEqual(repr(sphere().penumbra), "<penumbra of PolyData: nothing baked>")
        self.assertEqual(repr(baked.penumbra), "<penumbra of PolyData: has AmbientOcclusion>")
        blocks = pyvista.MultiBlock([pyvista.MultiBlock([baked]), None])
        self.assertEqual(repr(blocks.penumbra), "<penumbra of MultiBlock: has AmbientOcclusion>")

    def test_warns_with_a_category_of_its_own(self):
        mesh = sphere()
        mesh.points = numpy.vstack([mesh.points, [[9.0, 9.0, 9.0]]])
        with self.assertWarnsRegex(penumbra.PenumbraWarning, "do not belong to a surface"):
            pyvista.PolyData(mesh.points, mesh.faces).penumbra.bake_ambient_occlusion()

    def test_computes_cell_values(self):
        baked = sphere().penumbra.bake_ambient_occlusion(on="cells")
        self.assertEqual(len(baked.cell_data["AmbientOcclusion"]), baked.n_cells)

    def test_array_shares_memory_with_vtk(self):
        baked = sphere().penumbra.bake_ambient_occlusion()
        baked["AmbientOcclusion"][0] = 0.75
        array = baked.GetPointData().GetArray("AmbientOcclusion")
        self.assertEqual(array.GetValue(0), 0.75)

    def test_falloffs_reduce_occlusion(self):
        both = plane().merge(sphere(), merge_points=False)
        means = [
            both.penumbra.bake_ambient_occlusion(radius=2.0, falloff=name)["AmbientOcclusion"].mean()
            for name in ("none", "quadratic", "linear", "square-root")]
        self.assertEqual(means, sorted(means, reverse=True))
        self.assertLess(means[3], 0.5 * means[0])

    def test_rejects_invalid_arguments(self):
        bake = sphere().penumbra.bake_ambient_occlusion
        for arguments in ({"tolerance": 0.0}, {"radius": -1.0}, {"radius": math.nan}, {"on": "edges"},
                      {"falloff": "steep"}):
            with self.assertRaises(ValueError):
                bake(**arguments)
        with self.assertRaisesRegex(TypeError, "extract_surface"):
            pyvista.ImageData(dimensions=(3, 3, 3)).penumbra.bake_ambient_occlusion()


class BakedIrradiance(unittest.TestCase):
    def test_matches_the_closed_form_under_a_sphere(self):
        both = plane().merge(sphere(), merge_points=False)
        colors = (1.0, 0.5, 0.25)
        baked = both.penumbra.bake_irradiance(environment_color=colors, bounces=1)
        on_plane = numpy.abs(baked.points[:, 2]) < 1e-6
        reference = math.pi * numpy.outer(1 - closed_form(baked.points[on_plane]), colors)
        self.assertLess(rmse(baked["Irradiance"][on_plane], reference), 0.01)
        self.assertNotIn("AmbientOcclusion", baked.array_names)

    def test_accepts_color_names(self):
        baked = sphere().penumbra.bake_irradiance(environment_color="red", albedo=0.0)
        self.assertLess(rmse(baked["Irradiance"], numpy.full((baked.n_points, 3), (math.pi, 0, 0))), 0.01)

    def test_rejects_invalid_arguments(self):
        bake = sphere().penumbra.bake_irradiance
        for arguments in ({"albedo": 2.0}, {"bounces": 0}, {"environment_color": (1.0, -1.0, 0.0)},
                      {"environment_color": (1.0, 1.0)}, {"tolerance": math.nan}):
            with self.assertRaises(ValueError):
                bake(**arguments)


class BakedDirectLight(unittest.TestCase):
    def test_is_the_cosine_outside_the_shadow_of_a_sphere(self):
        both = plane().merge(sphere(), merge_points=False)
        baked = both.penumbra.bake_direct_light((1, 0, 2, 0), statistics=True)
        on_plane = numpy.abs(baked.points[:, 2]) < 1e-6
        # Distance of the center of the sphere from the line from the point toward the light.
        to_center = numpy.array([0, 0, 0.8]) - baked.points[on_plane]
        direction = numpy.array([1, 0, 2]) / math.sqrt(5)
        distance = numpy.linalg.norm(numpy.cross(to_center, direction), axis=1)
        clear = numpy.abs(distance - 0.5) > 0.01  # not on the edge of the shadow
        lit = numpy.where(distance > 0.5, 2 / math.sqrt(5), 0.0)
        self.assertLess(rmse(baked["DirectLight"][on_plane][clear], lit[clear]), 1e-6)
        self.assertGreater(numpy.count_nonzero(lit == 0.0), 5)
        self.assertGreater(baked.field_data["Rays/Shadow"][0], 0)
        self.assertNotIn("DirectLight", both.array_names)
        self.assertEqual(repr(baked.penumbra), f"<penumbra of {type(baked).__name__}: has DirectLight>")

    def test_sizes_of_lights_make_soft_shadows_of_other_blocks(self):
        blocks = pyvista.MultiBlock([plane(), sphere()])
        lights = [(0, 0, 1, 0), (0, 0, 4, 1)]
        values = [blocks.penumbra.bake_direct_light(lights, on=on, light_angle=angle, light_radius=radius)[0][
            "DirectLight"] for on, angle, radius in (("points", 0, 0), ("points", 40, 0), ("points", 0, 1),
                                                    ("cells", 40, 1))]
        self.assertEqual([each.size for each in values], [625, 625, 625, 576])
        for soft in values[1:3]:
            self.assertGreater(numpy.count_nonzero(numpy.abs(values[0] - soft) > 0.1), 8)

    def test_rejects_invalid_arguments(self):
        bake = sphere().penumbra.bake_direct_light
        for lights, arguments in (([], {}), ((0, 0), {}), ((0, 0, math.nan), {}), ((0, 0, 0, 0), {}),
                                  ((0, 0, 1, -1), {}), ((0, 0, 9), {"light_radius": -1.0}),
                                  ((0, 0, 9, 0), {"light_angle": 200}), ((0, 0, 9), {"tolerance": 0.0})):
            with self.assertRaises(ValueError):
                bake(lights, **arguments)
        with self.assertRaises(TypeError):
            bake("sun")
        with self.assertRaisesRegex(TypeError, "extract_surface"):
            pyvista.ImageData(dimensions=(3, 3, 3)).penumbra.bake_direct_light((0, 0, 9))


class RayCastImage(unittest.TestCase):
    def test_computes_exact_pixel_coverage(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(20, 20))
        square = pyvista.Plane(i_size=0.73, j_size=0.41, i_resolution=1, j_resolution=1)
        plotter.add_mesh(square, color="white", lighting=False)
        plotter.camera_position = "xy"
        plotter.enable_parallel_projection()
        plotter.camera.parallel_scale = 0.5
        image = plotter.penumbra.ray_cast(transparent_background=True, as_float=True)
        self.assertEqual(image.shape, (20, 20, 4))
        self.assertAlmostEqual(float(image[..., 3].sum()), 0.73 * 0.41 * 400, places=3)

    def test_matches_the_window_away_from_edges(self):
        plotter = scene()
        image = plotter.penumbra.ray_cast()
        window = plotter.screenshot(return_img=True)
        self.assertEqual(image.shape, window.shape)
        self.assertEqual(image.dtype, window.dtype)
        difference = numpy.abs(image.astype(int) - window.astype(int)).max(axis=2)
        self.assertLess(numpy.count_nonzero(difference > 4), 0.05 * difference.size)

    def test_returns_error_and_statistics(self):
        _, statistics = scene().penumbra.ray_cast(return_statistics=True)
        self.assertGreater(statistics["Rays/Total"], 0)
        self.assertLess(statistics["EstimatedError"], 1 / 256)

    def test_ambient_occlusion_only_darkens(self):
        plotter = scene()
        plain = plotter.penumbra.ray_cast(as_float=True)
        dark = plotter.penumbra.ray_cast(ambient_occlusion=True, radius=100.0, as_float=True)
        self.assertTrue((dark <= plain + 1 / 64).all())  # the sampling noise of a pixel at the tolerance of 1 / 256
        self.assertLess((dark / plain).min(), 0.7)

    def test_follows_the_passes_that_are_enabled(self):
        plotter = scene()
        plain = plotter.penumbra.ray_cast()
        self.assertIn("no effects", repr(plotter.penumbra))
        plotter.penumbra.enable_temporal_ssao(radius=1.0, strength=0.5)
        self.assertIn("AmbientOcclusion(", repr(plotter.penumbra))
        followed = plotter.penumbra.ray_cast()
        numpy.testing.assert_array_equal(
            followed, plotter.penumbra.ray_cast(ambient_occlusion=True, radius=1.0, strength=0.5))
        numpy.testing.assert_array_equal(plotter.penumbra.ray_cast(ambient_occlusion=False), plain)
        self.assertGreater(rmse(plain, followed), 1.0)

    def test_follows_passes_that_the_classes_added(self):
        plotter = scene()
        occlusion = penumbra.vtkPenumbraTemporalSSAOPass.AddTo(plotter.renderer)
        occlusion.SetRadiusUnit(occlusion.WORLD)
        occlusion.SetRadius(1.0)
        occlusion.SetStrength(0.5)
        self.assertIs(penumbra.vtkPenumbraTemporalSSAOPass.FindIn(plotter.renderer), occlusion)
        self.assertIn("AmbientOcclusion(", repr(plotter.penumbra))
        with warnings.catch_warnings():
            warnings.simplefilter("error", penumbra.PenumbraWarning)
            followed = plotter.penumbra.ray_cast()
        numpy.testing.assert_array_equal(
            followed, scene().penumbra.ray_cast(ambient_occlusion=True, radius=1.0, strength=0.5))
        penumbra.vtkPenumbraTemporalSSAOPass.RemoveFrom(plotter.renderer)
        self.assertIsNone(penumbra.vtkPenumbraTemporalSSAOPass.FindIn(plotter.renderer))
        numpy.testing.assert_array_equal(plotter.penumbra.ray_cast(), scene().penumbra.ray_cast())

    def test_follows_light_shafts_that_the_class_added(self):
        def lit():
            plotter = scene()
            plotter.add_light(pyvista.Light(position=(2, 2, 4), light_type="scene light"))
            return plotter

        plotter = lit()
        penumbra.vtkPenumbraTemporalSSAOPass.AddTo(plotter.renderer)
        penumbra.vtkPenumbraLightShaftPass.AddTo(plotter.renderer)
        self.assertRegex(repr(plotter.penumbra), r"AmbientOcclusion\(.*\) \+ LightShafts\(")
        reference = lit()
        reference.penumbra.enable_light_shafts(bounds=[-math.inf, math.inf] * 3)
        hazy = plotter.penumbra.ray_cast(ambient_occlusion=False)
        numpy.testing.assert_array_equal(hazy, reference.penumbra.ray_cast())
        self.assertGreater(rmse(hazy, lit().penumbra.ray_cast()), 1.0)

    def test_follows_shadows_and_ssao_of_pyvista(self):
        plotter = scene()
        plotter.enable_ssao(radius=1.0)
        numpy.testing.assert_array_equal(
            plotter.penumbra.ray_cast(), plotter.penumbra.ray_cast(ambient_occlusion=True, radius=1.0, strength=1.0))
        plotter = scene()
        plotter.enable_shadows()
        numpy.testing.assert_array_equal(plotter.penumbra.ray_cast(), plotter.penumbra.ray_cast(shadows=True))

    def test_does_not_warn_of_effects_that_it_follows(self):
        def use_settings_of_vtk(plotter):
            plotter.renderer.UseSSAOOn()
            plotter.renderer.UseShadowsOn()

        for enable in (lambda plotter: plotter.penumbra.enable_temporal_ssao(), lambda plotter: plotter.enable_ssao(),
                       lambda plotter: plotter.enable_shadows(), lambda plotter: plotter.enable_anti_aliasing("ssaa"),
                       use_settings_of_vtk):
            plotter = scene()
            enable(plotter)
            with warnings.catch_warnings():
                warnings.simplefilter("error", penumbra.PenumbraWarning)
                plotter.penumbra.ray_cast(window_size=(40, 30), tolerance=0.1)

    def test_follows_the_settings_of_a_renderer_of_vtk(self):
        plotter = scene()
        plain = plotter.penumbra.ray_cast()
        plotter.renderer.UseSSAOOn()
        plotter.renderer.SetSSAORadius(1.0)
        numpy.testing.assert_array_equal(
            plotter.penumbra.ray_cast(), scene().penumbra.ray_cast(ambient_occlusion=True, radius=1.0, strength=1.0))
        numpy.testing.assert_array_equal(plotter.penumbra.ray_cast(ambient_occlusion=False), plain)
        plotter = scene()
        plotter.add_light(pyvista.Light(position=(2, 2, 4), light_type="scene light"))
        lit = plotter.penumbra.ray_cast()
        plotter.renderer.UseShadowsOn()
        shadows = plotter.penumbra.ray_cast()
        numpy.testing.assert_array_equal(shadows, plotter.penumbra.ray_cast(shadows=True))
        self.assertGreater(rmse(shadows, lit), 1.0)

    def test_metals_reflect_the_environment(self):
        y, x = numpy.mgrid[0:32, 0:64] / 32.0
        image = numpy.stack([127 + 120 * numpy.sin(3.1416 * x), 127 + 120 * numpy.cos(3.1416 * y), 200 + 0 * x], axis=2)
        inside = (slice(20, 40), slice(30, 50))

        def metal(linearizes, is_srgb):
            texture = pyvista.Texture(image.astype(numpy.uint8))
            texture.SetUseSRGBColorSpace(linearizes)
            plotter = pyvista.Plotter(off_screen=True, window_size=(80, 60), lighting="none")
            plotter.set_environment_texture(texture, is_srgb=is_srgb, show_background=False)
            plotter.add_mesh(pyvista.Sphere(theta_resolution=60, phi_resolution=60), pbr=True, metallic=1.0,
                             roughness=0.3)
            return plotter

        images = []
        for linearizes in (False, True):
            plotter = metal(linearizes, False)
            with warnings.catch_warnings():
                warnings.simplefilter("error", penumbra.PenumbraWarning)
                images.append(plotter.penumbra.ray_cast()[inside].astype(int))
            plotter.show(auto_close=False)
            raster = plotter.screenshot(return_img=True)[inside]
            self.assertGreater(raster.std(), 10)
            self.assertLess(numpy.abs(images[-1] - raster).max(), 8)
        self.assertGreater(images[0].mean(), images[1].mean() + 10)
        with self.assertWarnsRegex(penumbra.PenumbraWarning, "instead of is_srgb=True") as caught:
            metal(False, True).penumbra.ray_cast()
        self.assertEqual(caught.filename, __file__)

    def test_names_no_option_of_the_command_line_in_warnings(self):
        def volume(plotter):
            plotter.add_volume(pyvista.Wavelet())

        def own_pass(plotter):
            plotter.renderer.SetPass(_vtk.vtkCameraPass())

        for use, remedy in ((volume, "or render with OpenGL"), (own_pass, "Render with OpenGL")):
            plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30))
            use(plotter)
            with self.assertWarnsRegex(penumbra.PenumbraWarning, remedy) as caught:
                plotter.penumbra.ray_cast()
            self.assertNotIn("--", str(caught.warning))

    def test_draws_points_as_spheres_and_lines_as_tubes(self):
        def coverage(mesh, **options):
            plotter = pyvista.Plotter(off_screen=True, window_size=(50, 50))
            plotter.add_mesh(mesh, color="white")
            plotter.camera_position = [(0, 0, 10), (0, 0, 0), (0, 1, 0)]
            plotter.enable_parallel_projection()
            plotter.camera.parallel_scale = 1.0
            image = plotter.penumbra.ray_cast(transparent_background=True, as_float=True, **options)
            return image[..., 3].sum() / 625  # in units of the plane

        self.assertAlmostEqual(
            coverage(pyvista.PolyData([(0.0, 0.0, 0.0)]), point_radius=0.5), math.pi * 0.25, delta=0.001)
        self.assertAlmostEqual(coverage(pyvista.Line((-0.5, 0, 0), (0.5, 0, 0)), line_radius=0.25),
                               0.5 + math.pi * 0.0625, delta=0.001)

    def test_warns_of_effects_that_rays_do_not_draw(self):
        plotter = scene()
        plotter.enable_eye_dome_lighting()
        with self.assertWarnsRegex(penumbra.PenumbraWarning, "eye-dome lighting"):
            plotter.penumbra.ray_cast()

    def test_draws_subplots_where_the_window_has_them(self):
        plotter = pyvista.Plotter(shape=(1, 2), off_screen=True, window_size=(160, 80), border=False)
        plotter.add_mesh(sphere(), color="red")
        plotter.subplot(0, 1)
        plotter.add_mesh(sphere(), color="blue")
        image = plotter.penumbra.ray_cast()
        window = plotter.screenshot(return_img=True)
        self.assertEqual(image.shape, (80, 160, 3))
        difference = numpy.abs(image.astype(int) - window.astype(int)).max(axis=2)
        self.assertLess(numpy.count_nonzero(difference > 8), 0.05 * difference.size)
        self.assertGreater(int(image[40, 40, 0]), int(image[40, 40, 2]) + 50)
        self.assertGreater(int(image[40, 120, 2]), int(image[40, 120, 0]) + 50)

    def test_multiplies_the_size_by_the_image_scale(self):
        plotter = scene()
        plotter.image_scale = 2
        self.assertEqual(plotter.penumbra.ray_cast().shape, (240, 320, 3))
        self.assertEqual(plotter.penumbra.ray_cast(scale=1).shape, (120, 160, 3))

    def test_sees_the_scene_as_the_first_show_does(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(80, 60))
        plotter.add_mesh(pyvista.Cube())
        image = plotter.penumbra.ray_cast()
        self.assertGreater(rmse(image[30, 40], image[2, 2]), 10)
        difference = numpy.abs(image.astype(int) - plotter.screenshot(return_img=True)).max(axis=2)
        self.assertLess(numpy.count_nonzero(difference > 8), 0.08 * difference.size)

    def test_of_a_closed_plotter_says_so(self):
        plotter = scene()
        plotter.close()
        with self.assertRaisesRegex(RuntimeError, "closed"):
            plotter.penumbra.ray_cast()

    def test_render_draws_plotters_renderers_and_meshes(self):
        plotter = scene()
        numpy.testing.assert_array_equal(penumbra.render(plotter), plotter.penumbra.ray_cast())
        numpy.testing.assert_array_equal(
            penumbra.render(plotter.renderer, window_size=(160, 120)), plotter.penumbra.ray_cast())
        image = penumbra.render(sphere(), window_size=(60, 50), color="red")
        self.assertGreater(int(image[25, 30, 0]), int(image[25, 30, 1]) + 50)
        blocks = pyvista.MultiBlock([plane(), sphere()])
        self.assertGreater(penumbra.render(blocks, window_size=(60, 50)).max(), 100)
        self.assertGreater(penumbra.render(pyvista.ImageData(dimensions=(3, 3, 3)), window_size=(60, 50)).max(), 100)

    def test_adds_light_from_the_environment(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(20, 20))
        plotter.add_mesh(pyvista.Plane(), color="white")
        plotter.camera_position = "xy"
        plotter.camera.zoom(4)
        direct = plotter.penumbra.ray_cast(as_float=True)
        image = plotter.penumbra.ray_cast(
            indirect_light=True, environment_color=(0.5, 0.25, 1.0), albedo=0.5, bounces=1,
            as_float=True)
        added = (image - direct)[10, 10]
        numpy.testing.assert_allclose(added, [0.25, 0.125, 0.5], atol=0.004)

    def test_rejects_invalid_arguments(self):
        plotter = scene()
        for arguments in ({"tolerance": 2.0}, {"strength": 3.0}, {"radius": -1.0}, {"albedo": -0.1},
                      {"bounces": 65}, {"window_size": (0, 20)}, {"point_radius": -1.0}, {"line_radius": math.nan},
                      {"light_radius": -1.0}, {"light_angle": 181.0}):
            with self.assertRaisesRegex(ValueError, next(iter(arguments))):
                plotter.penumbra.ray_cast(**arguments)


class TemporalOcclusion(unittest.TestCase):
    def test_matches_ray_casting(self):
        plotter = scene(lighting=False)
        plain = plotter.screenshot(return_img=True).astype(float)
        occlusion = plotter.penumbra.enable_temporal_ssao(radius=1.0)
        dark = plotter.screenshot(return_img=True).astype(float)
        self.assertTrue(occlusion.IsConverged())
        self.assertEqual(occlusion.GetActiveKernelName(), "traced")
        self.assertGreater(statistics_dict(occlusion)["Samples/Static"], 0)
        reference = plotter.penumbra.ray_cast(ambient_occlusion=True, radius=1.0).astype(float)
        edges = numpy.abs(plain - plotter.penumbra.ray_cast()).max(axis=2) > 4
        self.assertLess(rmse(dark[~edges], reference[~edges]), 0.02 * 255)
        self.assertGreater(rmse(plain, dark), 0.03 * 255)

    def test_can_be_disabled(self):
        plotter = scene()
        plain = plotter.screenshot(return_img=True)
        plotter.penumbra.enable_temporal_ssao()
        plotter.render()
        plotter.penumbra.disable_temporal_ssao()
        numpy.testing.assert_array_equal(plotter.screenshot(return_img=True), plain)

    def test_stays_when_pyvista_enables_and_disables_a_pass(self):
        plotter = scene()
        plain = plotter.screenshot(return_img=True)
        occlusion = plotter.penumbra.enable_temporal_ssao(radius=1.0)
        dark = plotter.screenshot(return_img=True)
        for change in (lambda: plotter.enable_anti_aliasing("ssaa"), plotter.disable_anti_aliasing):
            change()
            plotter.render()
            image = plotter.screenshot(return_img=True)
            self.assertLess(rmse(image, dark), 0.5 * rmse(image, plain))
            self.assertTrue(occlusion.IsConverged())
        plotter.penumbra.disable_temporal_ssao()
        plotter.render()
        self.assertLess(rmse(plotter.screenshot(return_img=True), plain), 0.5 * rmse(dark, plain))

    def test_is_replaced_by_ssao_of_pyvista_with_a_warning(self):
        plotter = scene()
        plotter.penumbra.enable_temporal_ssao(radius=1.0)
        with self.assertWarnsRegex(penumbra.PenumbraWarning, r"call disable_ssao\(\) and enable_temporal_ssao\(\)"):
            plotter.enable_ssao(radius=0.5)
            plotter.screenshot(return_img=True)
        self.assertEqual(repr(plotter.penumbra), "<penumbra of a plotter: AmbientOcclusion(radius=0.5, strength=1)>")
        plotter.disable_ssao()
        plotter.penumbra.enable_temporal_ssao(radius=1.0)
        self.assertIn("AmbientOcclusion(radius=1, strength=1, tolerance=0.01)", repr(plotter.penumbra))

    def test_rejects_invalid_arguments(self):
        plotter = scene()
        for arguments in ({"radius": -1.0}, {"tolerance": 2.0}, {"strength": 3.0}):
            with self.assertRaises(ValueError):
                plotter.penumbra.enable_temporal_ssao(**arguments)


class LightShafts(unittest.TestCase):
    def test_add_light_to_the_image(self):
        plotter = scene()
        plotter.add_light(pyvista.Light(position=(2, 2, 4), light_type="scene light"))
        plain = plotter.screenshot(return_img=True).astype(int)
        plotter.penumbra.enable_light_shafts()
        hazy = plotter.screenshot(return_img=True).astype(int)
        self.assertGreater(numpy.abs(hazy - plain).max(), 8)
        shafts = plotter.penumbra.enable_light_shafts(estimator="shadow-map")
        self.assertEqual(shafts.GetEstimatorAsString(), "ShadowMap")
        mapped = plotter.screenshot(return_img=True).astype(int)
        self.assertLess(numpy.abs(mapped - hazy).mean(), 2)
        plotter.penumbra.enable_temporal_ssao()
        plotter.enable_anti_aliasing("ssaa")
        plotter.render()
        names = [each.GetClassName() for each in passes_of(plotter.renderer)]
        self.assertEqual(names[:3], ["vtkSSAAPass", "vtkPenumbraLightShaftPass", "vtkPenumbraTemporalSSAOPass"])

    def test_leave_a_white_background_bright(self):
        plotter = scene()
        plotter.set_background("white")
        plotter.camera_position = [(2.0, -4.0, 1.0), (0.0, 0.0, 0.3), (0.0, 0.0, 1.0)]
        plotter.add_light(pyvista.Light(position=(2, 2, 4), light_type="scene light"))
        self.assertGreater(plotter.penumbra.ray_cast(light_shafts=True)[0, 80].min(), 100)
        plotter.penumbra.enable_light_shafts()
        for image in (plotter.screenshot(return_img=True), plotter.penumbra.ray_cast()):
            self.assertGreater(image[0, 80].min(), 100)
        plotter.penumbra.enable_light_shafts(bounds=[-math.inf, math.inf] * 3)
        self.assertLess(plotter.penumbra.ray_cast()[0, 80].max(), 100)

    def test_passes_colored_media_to_ray_caster(self):
        plotter = scene()
        plotter.add_light(pyvista.Light(position=(2, 2, 4), light_type="scene light"))
        shafts = plotter.penumbra.enable_light_shafts(scattering=(0.1, 0.2, 0.4), rayleigh=0.1, scale_height=2.0)
        self.assertAlmostEqual(shafts.GetMedium().GetScattering(), 0.4)
        numpy.testing.assert_allclose(shafts.GetMedium().GetScatteringColor(), (0.25, 0.5, 1.0))
        self.assertAlmostEqual(shafts.GetMedium().GetBaseHeight(), plotter.bounds[4])
        colored = plotter.penumbra.ray_cast().astype(int)
        self.assertGreater(numpy.abs(colored[..., 2] - colored[..., 0]).max(), 8)

    def test_reject_invalid_arguments(self):
        plotter = scene()
        for arguments in ({"phase": "mie"}, {"scattering": -1.0}, {"extinction": math.nan},
                      {"scattering": (1.0, 2.0)}, {"extinction": (1.0, math.inf, 1.0)}, {"rayleigh": -1.0},
                      {"scale_height": math.nan}, {"up": (0.0, 0.0, 0.0)},
                      {"asymmetry": 1.5}, {"tolerance": 0.0}, {"estimator": "radial"},
                      {"bounds": (0.0, 1.0)}, {"bounds": (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)}):
            with self.assertRaisesRegex(ValueError, next(iter(arguments))):
                plotter.penumbra.enable_light_shafts(**arguments)


class RenderPassesProvider(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("pyvista_render_passes"), "needs pyvista-render-passes")
    def test_is_registered_and_darkens(self):
        plotter = scene()
        passes = plotter.render_passes
        self.assertEqual(dict(passes.provider_errors), {})
        plain = plotter.screenshot(return_img=True).astype(int)
        passes.set_state({"providers": {"penumbra": {"ambient_occlusion": True}}})
        plotter.render()
        dark = plotter.screenshot(return_img=True).astype(int)
        self.assertGreater((plain - dark).max(), 32)


class Package(unittest.TestCase):
    def run_script(self, script, **environment):
        return subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True,
            env={name: value for name, value in os.environ.items() if name != "DISPLAY"}
            | environment)

    def test_renders_without_a_display(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "image.png")
            run = self.run_script(
                "import penumbra, pyvista\n"
                "plotter = pyvista.Plotter(off_screen=True, window_size=(64, 48))\n"
                "plotter.add_mesh(pyvista.Sphere())\n"
                "plotter.penumbra.enable_temporal_ssao()\n"
                f"plotter.screenshot({path!r})\n")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertGreater(numpy.ptp(pyvista.read(path).active_scalars), 50)

    def test_is_registered_with_pyvista_and_imports_it_lazily(self):
        run = self.run_script(
            "import sys, pyvista\n"
            "mesh = pyvista.Sphere()\n"
            "mesh.penumbra.bake_ambient_occlusion(inplace=True)\n"
            "print(mesh.array_names[-1], 'pyvista.plotting.plotter' in sys.modules)\n"
            "plotter = pyvista.Plotter(off_screen=True)\n"
            "plotter.add_mesh(mesh)\n"
            "print(plotter.penumbra.ray_cast(window_size=(40, 30)).shape)\n")
        self.assertEqual(run.stdout, "AmbientOcclusion False\n(30, 40, 3)\n", run.stderr)
        run = self.run_script("import sys, penumbra\nprint('pyvista' in sys.modules)\n")
        self.assertEqual(run.stdout, "False\n", run.stderr)

    def test_reports_missing_opengl(self):
        compiler = shutil.which("cc")
        if not compiler:
            self.skipTest("no C compiler to build the library that hides OpenGL")
        with tempfile.TemporaryDirectory() as folder:
            hiding = os.path.join(folder, "no_opengl.so")
            source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "no_opengl.c")
            subprocess.run([compiler, "-shared", "-fPIC", source, "-o", hiding], check=True)
            for effect in ("enable_temporal_ssao", "enable_light_shafts"):
                run = self.run_script(
                    "import penumbra, pyvista\n"
                    "plotter = pyvista.Plotter(off_screen=True, window_size=(64, 48))\n"
                    "plotter.add_mesh(pyvista.Sphere())\n"
                    "print(plotter.penumbra.ray_cast().shape)\n"
                    f"plotter.penumbra.{effect}()\n", LD_PRELOAD=hiding)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertEqual(run.stdout, "(48, 64, 3)\n")
                self.assertIn("OpenGL is not available", run.stderr.splitlines()[-1])

    def test_rejects_old_python_versions(self):
        run = self.run_script(
            "import sys\n"
            "sys.version_info = (3, 11, 2)\n"
            "import penumbra\n")
        self.assertEqual(run.returncode, 1)
        self.assertIn("CPython 3.12 or newer; this is 3.11", run.stderr.splitlines()[-1])
        metadata = importlib.metadata.metadata("vtk-penumbra")
        self.assertEqual(metadata["Requires-Python"], ">=3.12")

    def test_has_docstrings_and_type_stubs(self):
        self.assertIn("ray casting", " ".join(penumbra.vtkPenumbraRayCaster.__doc__.split()))
        folder = os.path.dirname(penumbra.__file__)
        with open(os.path.join(folder, "_cvista", "vtkPenumbraFiltersRayCasting.pyi")) as stub:
            self.assertIn("def SetTolerance(self, _arg:float) -> None", stub.read())
