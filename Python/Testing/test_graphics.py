# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of figures in vector graphics, written by the accessor of plotters."""
import os
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import penumbra
import pyvista
from test_pyvista import plane, scene

SVG = "{http://www.w3.org/2000/svg}"


class SaveGraphic(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def svg(self, plotter, **options):
        self.assertIsNone(plotter.penumbra.save_graphic(self.path("figure.svg"), **options))
        return ElementTree.parse(self.path("figure.svg")).getroot()

    def test_writes_visible_triangles_and_text(self):
        plotter = scene(lighting=False)
        plotter.add_text("left & right", position=(5, 5), font_size=8)
        figure = self.svg(plotter)
        self.assertEqual((figure.get("width"), figure.get("height")), ("160pt", "120pt"))
        self.assertEqual([text.text for text in figure.iter(SVG + "text")], ["left & right"])
        self.assertEqual(list(figure.iter(SVG + "image")), [])
        self.assertGreater(len(list(figure.iter(SVG + "path"))), 0)

    def test_embeds_an_image_with_the_pixels_of_scale(self):
        plotter = scene()
        figure = self.svg(plotter, scale=2, maximum_paths=0, window_size=(50, 40), shadows=True)
        self.assertEqual((figure.get("width"), figure.get("viewBox")), ("50pt", "0 0 100 80"))
        self.assertEqual([image.get("width") for image in figure.iter(SVG + "image")], ["100"])

    def test_returns_statistics_and_the_reason_of_an_image(self):
        fractions = []
        counts = scene().penumbra.save_graphic(
            self.path("figure.pdf"), outline_width=0.5, outline_color="red", maximum_paths=10, return_statistics=True,
            progress=fractions.append)
        self.assertIn("maximum number of paths", counts["Vector/ImageReason"])
        self.assertEqual(counts["Vector/Images"], 1)
        self.assertGreater(counts["Vector/Outlines"], 10)
        self.assertGreater(counts["Rays/Total"], 0)
        self.assertGreater(len(fractions), 0)
        with open(self.path("figure.pdf"), "rb") as file:
            data = file.read()
        self.assertTrue(data.startswith(b"%PDF"))
        self.assertIsNotNone(re.search(rb"MediaBox \[0 0 160 120\]", data))

    def test_warns_of_an_image_and_keeps_text(self):
        plotter = scene()
        plotter.add_mesh(pyvista.Sphere(radius=0.2), opacity=0.5, label="half")
        plotter.add_text("corner", position="upper_left", font_size=8)
        plotter.add_legend(size=(0.4, 0.3), face=None)
        plotter.add_point_labels([(0.0, 0.0, 0.5)], ["label"], font_size=10)
        with self.assertWarnsRegex(penumbra.PenumbraWarning, "an image of 288 dpi.*: the scene contains translucent"):
            figure = self.svg(plotter)
        self.assertEqual([image.get("width") for image in figure.iter(SVG + "image")], ["640"])
        texts = {text.text for text in figure.iter(SVG + "text")}
        self.assertLessEqual({"corner", "half", "label"}, texts)

    def test_is_relative_to_the_figure_path_of_pyvista(self):
        figures, pyvista.FIGURE_PATH = pyvista.FIGURE_PATH, self.folder
        try:
            scene().penumbra.save_graphic("figure.svg")
        finally:
            pyvista.FIGURE_PATH = figures
        self.assertTrue(os.path.exists(self.path("figure.svg")))

    def test_follows_the_theme(self):
        plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30), theme=pyvista.themes.Theme())
        plotter.set_background("black")
        plotter.add_mesh(plane(), color="white", lighting=False)
        fills = [path.get("fill") for path in self.svg(plotter).iter(SVG + "path")]
        self.assertEqual(fills, ["#000", "#fff"])
        plotter.theme.transparent_background = True
        fills = [path.get("fill") for path in self.svg(plotter).iter(SVG + "path")]
        self.assertEqual(fills, ["#fff"])

    def test_rejects_invalid_arguments(self):
        plotter = scene()
        save = plotter.penumbra.save_graphic
        for name in ("figure.eps", "figure", "figure.png"):
            with self.assertRaisesRegex(ValueError, r"\.svg or \.pdf"):
                save(self.path(name))
        path = self.path("figure.svg")
        for error, word, arguments in (
            (TypeError, "samples", {"samples": 3}), (TypeError, "as_float", {"as_float": True}),
            (ValueError, "outline_width", {"outline_width": -1}), (ValueError, "scale", {"scale": 100}),
            (ValueError, "maximum_paths", {"maximum_paths": -1}), (ValueError, "tolerance", {"tolerance": 2.0}),
            (ValueError, "window_size", {"window_size": (0, 3)}),
        ):
            with self.assertRaisesRegex(error, word):
                save(path, **arguments)
        with self.assertRaisesRegex(OSError, "cannot be written"):
            save(self.path("missing/figure.svg"))
        subplots = pyvista.Plotter(shape=(1, 2), off_screen=True)
        with self.assertRaisesRegex(NotImplementedError, "one subplot"):
            subplots.penumbra.save_graphic(path)
        plotter.close()
        with self.assertRaisesRegex(RuntimeError, "closed"):
            save(path)
        self.assertEqual(os.listdir(self.folder), [])

    def test_names_characters_that_a_font_lacks(self):
        plotter = scene()
        plotter.add_text("5 \N{CJK UNIFIED IDEOGRAPH-6E29}", position=(5, 5))
        with self.assertRaisesRegex(RuntimeError, r"U\+6E29"):
            plotter.penumbra.save_graphic(self.path("figure.pdf"), window_size=(40, 30))

    def test_stops_if_progress_raises(self):
        def stop(fraction):
            raise KeyError("stop")

        with self.assertRaisesRegex(KeyError, "stop"):
            scene().penumbra.save_graphic(self.path("figure.svg"), progress=stop)
        self.assertEqual(os.listdir(self.folder), [])
