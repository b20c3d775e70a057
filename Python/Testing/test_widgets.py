# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of ray-cast widgets, charts and actors of lights of PyVista, compared with images of OpenGL."""
import unittest
import warnings

import numpy
import pyvista

import penumbra

BLOCK = 8  # pixels


def block_means(image):
    rows, columns = (length // BLOCK for length in image.shape[:2])
    cut = numpy.asarray(image[:rows * BLOCK, :columns * BLOCK, :3], float)
    return cut.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


class Widgets(unittest.TestCase):
    def check(self, add, different=0.02):
        """Compare the images with what `add` adds, and require that it changes them."""
        images = []
        for shown in (False, True):
            plotter = pyvista.Plotter(off_screen=True, window_size=(320, 240))
            plotter.add_mesh(pyvista.Cone(), color="tan")
            if shown:
                add(plotter)
            window = plotter.screenshot(return_img=True)
            with warnings.catch_warnings():
                warnings.simplefilter("error", penumbra.PenumbraWarning)
                images.append((block_means(window), block_means(plotter.penumbra.ray_cast())))
            plotter.close()
        (_, without), (window, rays) = images
        self.assertGreater(numpy.abs(rays - without).max(), 20.0)
        self.assertLess((numpy.abs(rays - window).max(axis=2) > 16.0).mean(), different)

    def test_sliders(self):
        self.check(lambda plotter: plotter.add_slider_widget(lambda value: None, (0, 5), value=2, title="Level"))
        self.check(lambda plotter: plotter.add_text_slider_widget(lambda value: None, ["low", "high"]))

    def test_buttons(self):
        self.check(lambda plotter: plotter.add_checkbox_button_widget(lambda state: None, value=True))
        self.check(lambda plotter: plotter.add_radio_button_widget(lambda: None, "group", title="First"))

    def test_camera_orientation(self):
        self.check(lambda plotter: plotter.add_camera_orientation_widget())

    def test_logo(self):
        self.check(lambda plotter: plotter.add_logo_widget(size=(0.3, 0.3)))

    def test_light_actors(self):
        def add(plotter):
            light = pyvista.Light(position=(0.6, 0.4, 0.8), focal_point=(0, 0, 0), positional=True, cone_angle=20,
                                  show_actor=True)
            plotter.add_light(light)

        self.check(add, different=0.05)

    def test_charts_have_the_layout_of_the_window_in_larger_images(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(400, 300))
        chart = pyvista.Chart2D(x_label="time", y_label="height")
        chart.line(range(10), [value * value for value in range(10)])
        plotter.add_chart(chart)
        plotter.show(auto_close=False)
        rows = []
        for scale in (1, 2, 4):
            dark = plotter.penumbra.ray_cast(scale=scale)[..., :3].max(axis=2) < 60
            axis = numpy.flatnonzero(dark.mean(axis=1) > 0.3)
            rows.append((axis.mean() + 0.5) / scale)  # the horizontal axis, in pixels of the window
        plotter.close()
        self.assertLess(max(rows) - min(rows), 0.5)  # was 1

    def test_charts(self):
        def add(plotter):
            chart = pyvista.Chart2D(size=(0.6, 0.5), loc=(0.1, 0.1), x_label="time", y_label="height")
            chart.line([0, 1, 2, 3], [2, 1, 3, 2], color="r", width=3, style="--", label="line")
            chart.scatter([0, 1, 2, 3], [1, 2, 2, 1], size=8, style="d", color="b")
            chart.bar([0.5, 1.5], [1.0, 2.0], color="g")
            plotter.add_chart(chart)

        self.check(add, different=0.08)  # VTK dims lines between two rows of pixels

    def test_pies_and_boxes(self):
        self.check(lambda plotter: plotter.add_chart(pyvista.ChartPie([3, 1, 2], size=(0.5, 0.5))), different=0.03)
        self.check(lambda plotter: plotter.add_chart(pyvista.ChartBox([[1, 2, 5, 7], [2, 3, 4, 4]], size=(0.5, 0.5))),
                   different=0.05)

    def test_other_widgets_are_named(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(160, 120))
        plotter.add_mesh(pyvista.Cone())
        plotter.add_camera3d_widget()
        with self.assertWarnsRegex(penumbra.PenumbraWarning, "vtkCamera3DRepresentation.*not supported"):
            plotter.penumbra.ray_cast()


class Blocks(unittest.TestCase):
    def test_without_the_array_have_the_color_of_nan(self):
        blocks = pyvista.MultiBlock([pyvista.Cube(), pyvista.Sphere(center=(0, 0, 1))])
        blocks[0].point_data["data"] = blocks[0].points[:, 2]
        plotter = pyvista.Plotter(off_screen=True, window_size=(160, 120))
        _, mapper = plotter.add_composite(blocks, scalars="data", show_scalar_bar=False, nan_color="red")
        mapper.color_missing_with_nan = True
        window = plotter.screenshot(return_img=True)
        difference = numpy.abs(block_means(window) - block_means(plotter.penumbra.ray_cast()))
        self.assertLess(difference.max(), 40.0)
        self.assertLess(difference.mean(), 1.0)


if __name__ == "__main__":
    unittest.main()
