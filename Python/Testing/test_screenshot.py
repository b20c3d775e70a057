# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of screenshots by ray casting, of plotters with and without subplots."""
import io
import os
import tempfile
import unittest

import matplotlib.image
import numpy
import pyvista
from test_pyvista import plane, scene, sphere


class Screenshot(unittest.TestCase):
    colors = ("red", "green", "blue", "white")

    def subplots(self):
        plotter = pyvista.Plotter(shape=(2, 2), off_screen=True, window_size=(85, 60), border=False)
        for index, color in enumerate(self.colors):
            plotter.subplot(index // 2, index % 2)
            plotter.add_mesh(sphere(), color=color)
            plotter.add_mesh(plane(), color=color)
        plotter.penumbra.ray_cast(window_size=(8, 8), tolerance=1.0)  # sets the cameras, as the first show does
        return plotter

    def test_is_the_image_of_each_subplot(self):
        plotter = self.subplots()
        window = numpy.asarray(plotter.screenshot(scale=2))
        plotter.image_scale = 2
        difference = numpy.abs(plotter.penumbra.screenshot().astype(int) - window).max(axis=2)
        self.assertLess(numpy.count_nonzero(difference > 8), 0.08 * difference.size)
        plotter.renderers[0].UseSSAOOn()
        plotter.renderers[0].SetSSAORadius(1.0)
        for transparent in (False, True):
            image = plotter.penumbra.screenshot(transparent_background=transparent)
            self.assertEqual(image.shape, (120, 170, 4 if transparent else 3))
            self.assertEqual(image.dtype, numpy.uint8)
            for index, color in enumerate(self.colors):
                alone = pyvista.Plotter(off_screen=True, window_size=(85, 60))
                for mesh in (sphere(), plane()):
                    alone.add_mesh(mesh, color=color)
                alone.camera = plotter.renderers[index].camera
                occlusion = {"ambient_occlusion": True, "radius": 1.0, "strength": 1.0} if index == 0 else {}
                row, column = 60 * (index // 2), 85 * (index % 2)
                numpy.testing.assert_array_equal(
                    image[row:row + 60, column:column + 85],
                    alone.penumbra.ray_cast(transparent_background=transparent, **occlusion))

    def test_background_of_each_subplot_can_be_transparent(self):
        image = self.subplots().penumbra.screenshot(transparent_background=True, scale=1)
        alpha = image[..., 3]
        for rows in (slice(0, 30), slice(30, 60)):
            for columns in (slice(0, 42), slice(43, 85)):
                self.assertEqual(alpha[rows, columns].max(), 255)
                self.assertEqual(alpha[rows, columns].min(), 0)

    def test_places_subplots_of_odd_windows_where_the_window_has_them(self):
        plotter = pyvista.Plotter(shape=(1, 2), off_screen=True, window_size=(85, 40), border=False)
        plotter.set_background("red", all_renderers=False)
        plotter.subplot(0, 1)
        plotter.set_background("blue", all_renderers=False)
        numpy.testing.assert_array_equal(plotter.penumbra.screenshot(), plotter.screenshot(return_img=True))

    def test_is_written_to_files_as_by_pyvista(self):
        plotter = scene()
        image = plotter.penumbra.ray_cast()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "image")
            self.assertIsNone(plotter.penumbra.screenshot(path, return_img=False))
            numpy.testing.assert_array_equal(matplotlib.image.imread(path + ".png"), image / numpy.float32(255))
            figures, pyvista.FIGURE_PATH = pyvista.FIGURE_PATH, folder
            try:
                plotter.penumbra.screenshot("relative.tif", scale=2)
            finally:
                pyvista.FIGURE_PATH = figures
            self.assertEqual(matplotlib.image.imread(os.path.join(folder, "relative.tif")).shape, (240, 320, 3))
        memory = io.BytesIO()
        plotter.penumbra.screenshot(memory, transparent_background=True)
        memory.seek(0)
        self.assertEqual(matplotlib.image.imread(memory).shape, (120, 160, 4))

    def test_follows_the_theme_and_takes_the_options_of_ray_cast(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30), theme=pyvista.themes.Theme())
        plotter.theme.transparent_background = True
        plotter.add_mesh(sphere())
        self.assertEqual(plotter.penumbra.screenshot().shape, (30, 40, 4))
        self.assertEqual(plotter.penumbra.screenshot(transparent_background=False, scale=1).shape, (30, 40, 3))
        numpy.testing.assert_array_equal(plotter.penumbra.screenshot(window_size=(50, 20), ambient_occlusion=True),
                                         plotter.penumbra.ray_cast(window_size=(50, 20), ambient_occlusion=True,
                                                                   transparent_background=True))

    def test_rejects_invalid_arguments(self):
        plotter = scene()
        for arguments in ({"as_float": True}, {"return_statistics": True}, {"samples": 3}):
            with self.assertRaisesRegex(TypeError, next(iter(arguments))):
                plotter.penumbra.screenshot(**arguments)
        with self.assertRaisesRegex(ValueError, "tolerance"):
            plotter.penumbra.screenshot(tolerance=2.0)
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(ValueError):
            plotter.penumbra.screenshot(os.path.join(folder, "image.unknown"))
