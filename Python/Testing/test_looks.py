# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of looks of plotters, and of frames of movies."""
import pathlib
import re
import tempfile
import unittest

import numpy
import pyvista

import penumbra
from penumbra.looks import LOOKS

SOURCE = pathlib.Path(__file__).parents[2] / "Command" / "Options" / "LookOptions.cxx"
VIEW = [(2.0, -4.0, 3.0), (0.0, 0.0, 0.3), (0.0, 0.0, 1.0)]


def scene(**options):
    plotter = pyvista.Plotter(off_screen=True, window_size=(160, 120))
    plotter.add_mesh(pyvista.Plane(i_size=6, j_size=6), color="white", **options)
    plotter.add_mesh(pyvista.Sphere(radius=0.5, center=(0, 0, 0.8)), color="white", **options)
    plotter.camera_position = VIEW
    return plotter


class Looks(unittest.TestCase):
    def test_have_the_lights_and_backgrounds_of_the_program(self):
        source = SOURCE.read_text()
        table = source[source.index("looks = {"):source.index("return looks;")]
        number = r"-?[\d.]+"
        for name, look in LOOKS.items():
            row = table[table.index(f'"{name}"'):]
            row = row[:row.index("},\n    {") if "},\n    {" in row else len(row)]
            found = re.findall(rf"\{{ ({number}), ({number}), \{{ ({number}), ({number}), ({number}) \}} \}}", row)
            lights = [(*light[:2], *light[2]) for light in look.lights]
            self.assertEqual([tuple(map(float, light)) for light in found][:len(lights)], lights, name)
            code = source[source.index(f'options.Look == "{name}"'):]
            background = re.search(rf"setBackground\(\{{ ({number}), ({number}), ({number}) \}}\)", code)
            self.assertEqual(tuple(map(float, background.groups())), look.background, name)
            sky = re.search(rf'"--environment-color".*?Vector3\{{ ({number}), ({number}), ({number}) \}}',
                            code.split("else if")[0], re.DOTALL)
            self.assertEqual(tuple(map(float, sky.groups())) if sky else None,
                             look.settings.get("environment_color"), name)

    def test_change_the_image_and_return_to_the_plain_one(self):
        plotter = scene()
        plain = plotter.penumbra.ray_cast()
        lights = list(plotter.renderer.lights)
        images = {name: plotter.penumbra.look(name).ray_cast() for name in LOOKS}
        for name, image in images.items():
            self.assertGreater(numpy.abs(image.astype(int) - plain).max(), 40, name)
            numpy.testing.assert_allclose(image[0, 0] / 255.0, LOOKS[name].background, atol=0.005)
        plotter.penumbra.look("plain")
        numpy.testing.assert_array_equal(plotter.penumbra.ray_cast(), plain)
        self.assertEqual(list(plotter.renderer.lights), lights)

    def test_give_way_to_arguments(self):
        plotter = scene()
        plotter.penumbra.look("studio")
        image = plotter.penumbra.ray_cast()
        numpy.testing.assert_array_equal(image, plotter.penumbra.ray_cast(ambient_occlusion=True, strength=0.85))
        bright = plotter.penumbra.ray_cast(ambient_occlusion=False)
        self.assertGreater((bright.astype(int) - image).max(), 20)
        self.assertGreaterEqual((bright.astype(int) - image).min(), -4)

    def test_are_that_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = pyvista.Sphere(theta_resolution=60, phi_resolution=60).save(f"{folder}/mesh.ply")
            del mesh
            look, up = pathlib.Path(folder, "look.png"), "0,0,1"
            import subprocess
            import sys
            import sysconfig
            program = pathlib.Path(sysconfig.get_path("scripts"), "penumbra")
            if not program.exists():
                self.skipTest("the program is not in the environment of " + sys.executable)
            subprocess.run(
                [program, "render", f"{folder}/mesh.ply", "--output", look, "--look", "studio", "--resolution", "160,120",
                 "--camera-position", "2,-4,3", "--camera-focal-point", "0,0,0", "--camera-view-up", up,
                 "--camera-view-angle", "30", "--ambient-occlusion-radius", "0.3"], check=True)
            plotter = pyvista.Plotter(off_screen=True, window_size=(160, 120))
            plotter.add_mesh(pyvista.read(f"{folder}/mesh.ply"), color="white", smooth_shading=False)
            plotter.camera_position = [(2, -4, 3), (0, 0, 0), (0, 0, 1)]
            image = plotter.penumbra.look("studio").ray_cast(radius=0.3)
            difference = numpy.abs(pyvista.read(look).active_scalars.reshape(120, 160, 3)[::-1].astype(int) - image)
        self.assertLess(numpy.mean(difference), 2.0)

    def test_are_described(self):
        plotter = scene()
        self.assertEqual(plotter.penumbra.describe(), "no effects")
        plotter.penumbra.look("studio")
        self.assertEqual(plotter.penumbra.describe(), "Look(studio) + AmbientOcclusion(rays only, strength=0.85)")
        plotter.penumbra.enable_temporal_ssao(radius=0.5)
        self.assertEqual(plotter.penumbra.describe(),
                         "Look(studio) + AmbientOcclusion(radius=0.5, strength=1, tolerance=0.01)")
        plotter.penumbra.disable_temporal_ssao()
        plotter.penumbra.look("outdoor")
        self.assertEqual(plotter.penumbra.describe(), "Look(outdoor) + Shadows(light_angle=3) + IndirectLight(bounces=2)")

    def test_are_part_of_the_representation(self):
        plotter = scene()
        self.assertEqual(repr(plotter.penumbra), "<penumbra of a plotter: no effects>")
        plotter.penumbra.look("studio")
        self.assertEqual(repr(plotter.penumbra),
                         "<penumbra of a plotter: Look(studio) + AmbientOcclusion(rays only, strength=0.85)>")
        plotter.close()
        self.assertIn("penumbra of a plotter", repr(plotter.penumbra))

    def test_are_described_with_the_effects_of_pyvista_and_vtk(self):
        plotter = scene()
        plotter.enable_ssao(radius=0.25)
        self.assertEqual(plotter.penumbra.describe(), "AmbientOcclusion(radius=0.25, strength=1)")
        plotter.enable_shadows()
        self.assertEqual(plotter.penumbra.describe(), "AmbientOcclusion(radius=0.25, strength=1) + Shadows")
        plotter = scene()
        plotter.renderer.UseSSAOOn()
        plotter.renderer.SetSSAORadius(0.75)
        self.assertEqual(plotter.penumbra.describe(), "AmbientOcclusion(radius=0.75, strength=1)")

    def test_have_names(self):
        with self.assertRaisesRegex(ValueError, "name must be"):
            scene().penumbra.look("dramatic")


class Frames:
    """Stands for the writer of a movie."""

    def __init__(self):
        self.images = []

    def append_data(self, image):
        self.images.append(numpy.asarray(image).copy())

    def close(self):
        pass


class Movies(unittest.TestCase):
    def test_have_frames_that_have_converged(self):
        plotter = scene()
        occlusion = plotter.penumbra.enable_temporal_ssao(radius=1.0, tolerance=0.01)
        plotter.mwriter = movie = Frames()
        for azimuth in (0, 20, 40):
            plotter.camera.azimuth = azimuth
            plotter.write_frame()
            self.assertTrue(occlusion.IsConverged())
            still = plotter.screenshot(return_img=True).astype(int)
            self.assertLess(numpy.abs(movie.images[-1] - still).max(), 2)
        moved = numpy.abs(movie.images[0].astype(int) - movie.images[-1]).mean()
        self.assertGreater(moved, 1.0)


if __name__ == "__main__":
    unittest.main()
