# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the functions that take and return arrays, with any VTK and without PyVista."""
import math
import os
import signal
import threading
import warnings

import numpy as np
import pytest

import penumbra
from penumbra._backend import vtk_module
from penumbra.conversion import poly_data
from penumbra.rendering import renderer_of_mesh


def rmse(a, b):
    return float(np.sqrt(np.mean((np.asarray(a, float) - np.asarray(b, float)) ** 2)))


def grid(columns, rows, function):
    """Return points and triangles of a surface over the unit square."""
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows), indexing="ij")
    points = np.stack(function(u, v), axis=-1).reshape(-1, 3)
    i = np.arange(columns * rows).reshape(columns, rows)
    a, b, c, d = i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]
    faces = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    return points, faces


def sphere(columns, center=(0.0, 0.0, 0.8), radius=0.5):
    def place(u, v):
        theta, phi = math.pi * (0.001 + 0.998 * v), 2 * math.pi * u
        return (center[0] + radius * np.sin(theta) * np.cos(phi), center[1] + radius * np.sin(theta) * np.sin(phi),
                center[2] - radius * np.cos(theta))
    return grid(columns, columns, place)


def floor(columns, size=6.0):
    return grid(columns, columns, lambda u, v: (size * (u - 0.5), size * (v - 0.5), 0.0 * u))


def floor_and_sphere(columns=60, around=40):
    points, faces = floor(columns)
    more, others = sphere(around)
    return np.concatenate([points, more]), np.concatenate([faces, others + len(points)]), len(points)


def closed_form(points):
    """Return the occlusion of a floor by the sphere."""
    return 0.25 * 0.8 / np.linalg.norm(points - [0, 0, 0.8], axis=1) ** 3


TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
FACES = [(0, 1, 2)]


class TestAmbientOcclusion:
    def test_matches_the_closed_form_under_a_sphere(self):
        points, faces, on_floor = floor_and_sphere()
        values, statistics = penumbra.ambient_occlusion(points, faces, radius=20.0, return_statistics=True)
        assert values.shape == (len(points),)
        assert values.dtype == np.float32
        assert rmse(values[:on_floor], closed_form(points[:on_floor])) < 0.01
        assert statistics["Rays/Total"] > 0
        assert statistics["EstimatedError"] < 0.01

    def test_does_not_depend_on_the_layout_of_arrays(self):
        points, faces, _ = floor_and_sphere(12, 30)
        values = penumbra.ambient_occlusion(points, faces)
        padded = np.column_stack([np.full(len(faces), 3), faces]).ravel()
        for other_points, other_faces in (
                (np.asfortranarray(points), faces), (points, padded), (points.tolist(), faces.astype(np.int32)),
                (points, faces[::1].astype(np.uint16))):
            np.testing.assert_array_equal(penumbra.ambient_occlusion(other_points, other_faces), values)
        single = penumbra.ambient_occlusion(points.astype(np.float32), faces)
        assert rmse(single, values) < 0.02  # each within the tolerance

    def test_leaves_its_arguments_alone(self):
        points, faces, _ = floor_and_sphere(12, 30)
        before = points.copy(), faces.copy()
        penumbra.ambient_occlusion(points, faces)
        np.testing.assert_array_equal(points, before[0])
        np.testing.assert_array_equal(faces, before[1])

    def test_result_outlives_everything_else(self):
        values = penumbra.ambient_occlusion(*sphere(40))
        expected = values.copy()
        [np.ones(1000) for _ in range(100)]
        np.testing.assert_array_equal(values, expected)

    def test_computes_a_value_for_each_face(self):
        points, faces = sphere(20)
        assert penumbra.ambient_occlusion(points, faces, on="cells").shape == (len(faces),)

    def test_accepts_points_with_normals_only(self):
        points, _ = floor(30)
        normals = np.broadcast_to([0.0, 0.0, 1.0], points.shape)
        values = penumbra.ambient_occlusion(points, normals=normals, point_radius=0.1)
        assert values.max() < 0.05

    def test_matches_the_closed_form_under_a_sphere_around_a_point(self):
        points, faces = floor(40)
        both = np.concatenate([points, [(0.0, 0.0, 0.8)]])
        values = penumbra.ambient_occlusion(both, faces, radius=20.0, point_radius=0.5)
        assert rmse(values[:-1], closed_form(points)) < 0.01
        assert values[-1] == 0.0

    def test_matches_the_closed_form_under_a_tube(self):
        points, faces = floor(40)
        both = np.concatenate([points, [(-100.0, 0.0, 0.8), (100.0, 0.0, 0.8)]])
        ends = [len(points), len(points) + 1]
        options = {"radius": 200.0, "line_radius": 0.25, "tolerance": 0.005}
        values = penumbra.ambient_occlusion(both, faces, lines=[ends], **options)
        # An infinite cylinder of radius r at the distance d, inclined by t, covers r / d cos(t) of the hemisphere.
        assert rmse(values[:-2], 0.25 * 0.8 / (0.64 + points[:, 1] ** 2)) < 0.01
        assert values[-2:].tolist() == [0.0, 0.0]
        np.testing.assert_array_equal(penumbra.ambient_occlusion(both, faces, lines=[2, *ends], **options), values)
        assert penumbra.ambient_occlusion(both, faces, lines=[ends], on="cells", **options).shape == (len(faces),)

    def test_lines_without_a_radius_do_not_occlude(self):
        points, faces, _ = floor_and_sphere(12, 20)
        np.testing.assert_array_equal(
            penumbra.ambient_occlusion(points, faces, lines=[(0, 20), (5, 7)]),
            penumbra.ambient_occlusion(points, faces))

    @pytest.mark.parametrize(("error", "match", "points", "faces", "options"), [
        (ValueError, "lines must have the shape", TRIANGLE, FACES, {"lines": [[0], [1]]}),
        (ValueError, r"lines\[0\] = 1", TRIANGLE, FACES, {"lines": [1, 0]}),
        (ValueError, "lines is empty", TRIANGLE, FACES, {"lines": []}),
        (TypeError, "lines must be an array of integers", TRIANGLE, FACES, {"lines": [(0.0, 1.0)]}),
        (IndexError, "lines refer to points 0 to 2, but line 1 has the point 3", TRIANGLE, FACES,
         {"lines": [(0, 1), (0, 3)]}),
        (ValueError, "line_radius", TRIANGLE, FACES, {"line_radius": -1.0}),
        (ValueError, "line_radius", TRIANGLE, FACES, {"line_radius": math.nan}),
        (TypeError, "line_radius", TRIANGLE, FACES, {"line_radius": (1.0, 2.0)}),
        (ValueError, "point_radius", TRIANGLE, FACES, {"point_radius": math.inf}),
        (TypeError, "point_radius", TRIANGLE, FACES, {"point_radius": None}),
        (ValueError, "on='points'", TRIANGLE, None, {"normals": [(0, 0, 1)] * 3, "point_radius": 1.0, "on": "cells"}),
        (ValueError, r"shape \(n, 3\), not \(1, 2\)", [(0, 0)], FACES, {}),
        (ValueError, "empty", np.zeros((0, 3)), FACES, {}),
        (TypeError, "numbers", [("a", "b", "c")], FACES, {}),
        (ValueError, r"finite: 1 of 3 .* points\[1\]", [(0, 0, 0), (math.nan, 0, 0), (0, 1, 0)], FACES, {}),
        (IndexError, "points 0 to 2, but face 1 has the point 3", TRIANGLE, [(0, 1, 2), (0, 2, 3)], {}),
        (IndexError, "point -1", TRIANGLE, [(0, 1, -1)], {}),
        (TypeError, "integers", TRIANGLE, [(0.0, 1.0, 2.0)], {}),
        (ValueError, "shape", TRIANGLE, [(0, 1)], {}),
        (ValueError, "flat", TRIANGLE, [[0, 1, 2], [0, 1]], {}),
        (ValueError, r"faces\[0\] = 2", TRIANGLE, [2, 0, 1], {}),
        (ValueError, "empty", TRIANGLE, [], {}),
        (ValueError, "point_radius", TRIANGLE, None, {}),
        (ValueError, "one row for each of the 3 points", TRIANGLE, FACES, {"normals": [(0, 0, 1)]}),
        (ValueError, "tolerance", TRIANGLE, FACES, {"tolerance": 0.0}),
        (ValueError, "tolerance", TRIANGLE, FACES, {"tolerance": math.nan}),
        (TypeError, "tolerance", TRIANGLE, FACES, {"tolerance": "0.1"}),
        (ValueError, "radius", TRIANGLE, FACES, {"radius": -1.0}),
        (ValueError, "radius", TRIANGLE, FACES, {"radius": math.nan}),
        (ValueError, "falloff", TRIANGLE, FACES, {"falloff": "steep"}),
        (ValueError, "on must be", TRIANGLE, FACES, {"on": "edges"}),
    ])
    def test_refuses_wrong_arguments(self, error, match, points, faces, options):
        with pytest.raises(error, match=match):
            penumbra.ambient_occlusion(points, faces, **options)

    def test_warns_of_points_without_a_face(self):
        with pytest.warns(penumbra.PenumbraWarning, match="1 points do not belong to a surface"):
            penumbra.ambient_occlusion([*TRIANGLE, (5, 5, 5)], FACES)

    def test_warning_names_the_line_of_the_caller(self):
        with pytest.warns(penumbra.PenumbraWarning) as caught:
            penumbra.ambient_occlusion([*TRIANGLE, (5, 5, 5)], FACES)
        assert caught[0].filename == __file__

    def test_prints_nothing(self, capfd):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", penumbra.PenumbraWarning)
            penumbra.ambient_occlusion([*TRIANGLE, (5, 5, 5)], FACES)
        assert capfd.readouterr() == ("", "")

    def test_reports_progress(self):
        fractions = []
        penumbra.ambient_occlusion(*sphere(60), progress=fractions.append)
        assert fractions == sorted(fractions)
        assert 0.0 <= fractions[0] and fractions[-1] <= 1.0
        assert len(fractions) > 2

    def test_raises_what_the_callback_raises(self):
        def stop(fraction):
            raise LookupError("enough")

        with pytest.raises(LookupError, match="enough"):
            penumbra.ambient_occlusion(*sphere(60), progress=stop)

    def test_stops_on_ctrl_c(self):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            penumbra.ambient_occlusion(*sphere(400), tolerance=1e-4)


class TestIrradiance:
    def test_matches_the_closed_form_under_a_sphere(self):
        points, faces, on_floor = floor_and_sphere()
        colors = (1.0, 0.5, 0.25)
        values = penumbra.irradiance(points, faces, environment_color=colors, bounces=1)
        assert values.shape == (len(points), 3)
        reference = math.pi * np.outer(1 - closed_form(points[:on_floor]), colors)
        assert rmse(values[:on_floor], reference) < 0.01

    def test_accepts_names_of_colors(self):
        points, faces = sphere(20)
        for name in ("red", "#ff0000"):
            values = penumbra.irradiance(points, faces, environment_color=name, albedo=0.0)
            assert rmse(values, np.broadcast_to((math.pi, 0, 0), values.shape)) < 0.01

    def test_is_pi_minus_the_light_that_spheres_and_tubes_block(self):
        points, faces = floor(20)
        both = np.concatenate([points, [(0.0, 0.0, 0.8), (-9.0, 0.0, 0.9), (9.0, 0.0, 0.9)]])
        options = {"lines": [(400 + 1, 400 + 2)], "line_radius": 0.3, "point_radius": 0.5}
        values = penumbra.irradiance(both, faces, bounces=1, **options)
        blocked = penumbra.ambient_occlusion(both, faces, radius=math.inf, **options)
        assert rmse(values[:400, 0], math.pi * (1.0 - blocked[:400])) < 0.05
        assert blocked.max() > 0.3

    @pytest.mark.parametrize(("error", "options"), [
        (ValueError, {"line_radius": -1.0}), (ValueError, {"point_radius": math.nan}),
        (ValueError, {"albedo": 2.0}), (ValueError, {"bounces": 0}), (ValueError, {"environment_color": "reddish"}),
        (ValueError, {"environment_color": (1.0, -1.0, 0.0)}), (ValueError, {"environment_color": (1.0, 1.0)}),
        (TypeError, {"environment_color": 3}), (ValueError, {"tolerance": 2.0})])
    def test_refuses_wrong_arguments(self, error, options):
        with pytest.raises(error, match=next(iter(options))):
            penumbra.irradiance(TRIANGLE, FACES, **options)


def half_plane(columns=31):
    """Return a floor, and above it, at the height 5, a half-plane that covers x < 0."""
    points, faces = floor(columns)
    edge = [(-200, -200, 5), (0, -200, 5), (0, 200, 5), (-200, 200, 5)]
    corner = len(points)
    return (np.concatenate([points, edge]),
            np.concatenate([faces, [(corner, corner + 1, corner + 2), (corner, corner + 2, corner + 3)]]), corner)


def sunlight_beside_half_plane(x, diameter, strata=128):
    """Return the fraction of a sun in the zenith that points of the floor see, by stratified directions."""
    j, i = np.divmod(np.arange(strata * strata), strata)
    cosine = 1.0 - (1.0 - math.cos(math.radians(diameter / 2))) * (i + 0.5) / strata
    across = np.sqrt(1.0 - cosine ** 2) * np.cos(2.0 * math.pi * (j + 0.5) / strata)
    return np.array([np.mean(at + 5.0 * across / cosine > 0.0) for at in x])


class TestDirectLight:
    def test_matches_a_stratified_sun_beside_a_half_plane(self):
        points, faces, on_floor = half_plane()
        values, statistics = penumbra.direct_light(
            points, faces, lights=(0, 0, 7, 0), light_angle=20, return_statistics=True)
        assert values.shape == (len(points),)
        assert values.dtype == np.float32
        exact = sunlight_beside_half_plane(points[:on_floor, 0], 20)
        assert np.count_nonzero((exact > 0.05) & (exact < 0.95)) > 100
        assert rmse(values[:on_floor], exact) < 0.01
        assert statistics["Rays/Shadow"] > 0
        assert statistics["EstimatedError"] < 0.01

    def test_is_the_sum_over_hard_lights(self):
        points, faces, on_floor = half_plane()
        x = points[:on_floor, 0]
        free = np.flatnonzero(np.abs(x + 2.5) > 0.01)  # not on the edge of the shadow of the second light
        values = penumbra.direct_light(points, faces, lights=[(-1, 0, 1, 0), (5, 0, 20, 2)])[:on_floor]
        to_light = np.array([2.5, 0, 10]) - points[:on_floor]
        # The shadow of the edge from (2.5, 0, 10), twice as high as the edge, ends at x = -2.5.
        lit = np.where(x > -2.5, 10 / np.linalg.norm(to_light, axis=1), 0.0)
        assert (x < 5).all()  # the half-plane hides the first light
        assert rmse(values[free], lit[free]) < 1e-6

    def test_computes_a_value_for_each_face(self):
        points, faces = sphere(40)
        values = penumbra.direct_light(points, faces, lights=[[0, 0, 1e6]], light_radius=1e4, on="cells")
        a, b, c = (points[faces[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        up = normals[:, 2] / np.linalg.norm(normals, axis=1)
        assert values.shape == (len(faces),)
        clear = np.abs(up) > 0.1
        assert rmse(values[clear], np.maximum(up, 0.0)[clear]) < 0.01

    def test_warns_of_a_light_inside_a_surface(self):
        with pytest.warns(penumbra.PenumbraWarning, match="contains or touches a surface"):
            penumbra.direct_light(TRIANGLE, FACES, lights=(0, 0, 1), light_radius=2)

    @pytest.mark.parametrize(("error", "match", "options"), [
        (ValueError, "lights must have the shape", {"lights": []}),
        (ValueError, "lights must have the shape", {"lights": (1, 2)}),
        (ValueError, "lights must have the shape", {"lights": np.zeros((1, 1, 3))}),
        (ValueError, "lights must have the shape", {"lights": [(0, 0, 1), (0, 0, 1, 0)]}),
        (TypeError, "lights must be an array of numbers", {"lights": "sun"}),
        (TypeError, "lights must be an array of numbers", {"lights": None}),
        (ValueError, "lights must be finite", {"lights": (0, 0, math.nan)}),
        (ValueError, "lights must be finite", {"lights": (0, math.inf, 1, 0)}),
        (ValueError, "w must be positive", {"lights": (0, 0, 1, -1)}),
        (ValueError, r"direction \(0, 0, 0\)", {"lights": (0, 0, 0, 0)}),
        (ValueError, "light_radius", {"lights": (0, 0, 1), "light_radius": -1.0}),
        (ValueError, "light_radius", {"lights": (0, 0, 1), "light_radius": math.inf}),
        (ValueError, "light_angle", {"lights": (0, 0, 1), "light_angle": 181}),
        (ValueError, "light_angle", {"lights": (0, 0, 1), "light_angle": math.nan}),
        (TypeError, "light_angle", {"lights": (0, 0, 1), "light_angle": "wide"}),
        (ValueError, "tolerance", {"lights": (0, 0, 1), "tolerance": 0.0}),
        (ValueError, "on must be", {"lights": (0, 0, 1), "on": "edges"})])
    def test_refuses_wrong_arguments(self, error, match, options):
        with pytest.raises(error, match=match):
            penumbra.direct_light(TRIANGLE, FACES, **options)


SQUARE = ([(-0.365, -0.205, 0), (0.365, -0.205, 0), (0.365, 0.205, 0), (-0.365, 0.205, 0)], [(0, 1, 2, 3)])


class TestRender:
    def test_draws_arrays(self):
        camera = ((0, 0, 1 / math.tan(math.radians(15))), (0, 0, 0), (0, 1, 0))
        image = penumbra.render(SQUARE, window_size=(40, 40), camera=camera, transparent_background=True, as_float=True)
        assert image.shape == (40, 40, 4)
        # The window is 2 by 2 in the plane of the square.
        assert abs(image[..., 3].sum() - 0.73 * 0.41 * 400) < 0.01
        np.testing.assert_allclose(image[20, 20, :3], 1.0, atol=0.01)

    def test_has_bytes_from_top_to_bottom(self):
        points = [(0, 0, 0), (1, 0, 0), (0.5, 1, 0)]
        image = penumbra.render((points, FACES), window_size=(64, 48), camera=((0.5, 0.5, 3), (0.5, 0.5, 0), (0, 1, 0)))
        assert image.shape == (48, 64, 3)
        assert image.dtype == np.uint8
        widths = np.count_nonzero(image[..., 0] > 128, axis=1)
        assert widths[30] > widths[18] > 0

    def test_has_the_same_bits_each_time(self):
        images = [penumbra.render(sphere(30), window_size=(80, 60), ambient_occlusion=True) for _ in range(2)]
        np.testing.assert_array_equal(*images)

    def test_adds_ambient_occlusion(self):
        points, faces, _ = floor_and_sphere(12, 30)
        plain = penumbra.render((points, faces), window_size=(80, 60), as_float=True)
        dark = penumbra.render((points, faces), window_size=(80, 60), as_float=True, ambient_occlusion=True, radius=2.0)
        assert (dark <= plain + 1 / 128).all()
        assert (plain - dark).max() > 0.2

    def test_draws_points_as_spheres(self):
        options = {"window_size": (100, 100), "transparent_background": True, "as_float": True}
        camera = ((0, 0, 10), (0, 0, 0), (0, 1, 0))
        image = penumbra.render(([(0, 0, 0)], None), camera=camera, point_radius=1.0, **options)
        # A sphere of radius 1 at the distance 10 has the angular radius asin(1 / 10), half of the view is 15 degrees.
        radius = 50 * math.tan(math.asin(0.1)) / math.tan(math.radians(15))
        assert abs(image[..., 3].sum() - math.pi * radius ** 2) < 0.5
        # Points that belong to a face are no spheres.
        triangle = ([(-9, -9, 0), (-8, -9, 0), (-8, -8, 0), (0, 0, 0)], [(0, 1, 2)])
        np.testing.assert_array_equal(penumbra.render(triangle, camera=camera, point_radius=1.0, **options), image)

    def test_shows_spheres_as_a_whole(self):
        for points in ([(0, 0, 0)], [(0, 0, 0), (1, 0, 0), (1, 1, 0)]):
            image = penumbra.render((points, None), window_size=(40, 40), point_radius=1.0, transparent_background=True)
            assert image[..., 3].max() == 255
            assert max(edge.max() for edge in (image[0], image[-1], image[:, 0], image[:, -1])) == 0

    def test_draws_lines_as_tubes(self):
        image = penumbra.render(([(-50, 0, 0), (50, 0, 0)], None, [(0, 1)]), window_size=(100, 100), line_radius=1.0,
                                camera=((0, 0, 10), (0, 0, 0), (0, 1, 0)), transparent_background=True, as_float=True)
        half = 50 * math.tan(math.asin(0.1)) / math.tan(math.radians(15))
        assert abs(image[..., 3].sum() - 200 * half) < 0.5

    def test_draws_penumbrae_of_lights_with_a_size(self):
        core, points = vtk_module("vtkRenderingCore"), [*SQUARE[0], (-9, -9, -1), (9, -9, -1), (9, 9, -1), (-9, 9, -1)]
        renderer = renderer_of_mesh(
            poly_data(points, [(0, 1, 2, 3), (4, 5, 6, 7)]), "white", ((0, 0, 4), (0, 0, 0), (0, 1, 0)))
        light = core.vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(5, 0, 10)
        renderer.AddLight(light)
        options = {"window_size": (60, 60), "as_float": True, "shadows": True}
        gray = [np.count_nonzero((image[..., 0] > 0.1 * image.max()) & (image[..., 0] < 0.8 * image.max()))
                for image in (penumbra.render(renderer, **options), penumbra.render(renderer, light_angle=20, **options))]
        assert gray[1] > gray[0] + 50
        light.PositionalOn()
        light.SetConeAngle(180)
        assert rmse(penumbra.render(renderer, light_radius=0.5, **options), penumbra.render(renderer, **options)) > 0.01

    def test_returns_statistics(self):
        _, statistics = penumbra.render(sphere(20), window_size=(40, 40), return_statistics=True)
        assert statistics["Rays/Total"] > 0
        assert 0.0 <= statistics["EstimatedError"] < 1 / 256

    def test_reports_progress(self):
        fractions = []
        penumbra.render(sphere(20), window_size=(200, 150), progress=fractions.append)
        assert fractions
        assert fractions == sorted(fractions)

    @pytest.mark.parametrize(("error", "match", "scene", "options"), [
        (TypeError, "scene must be", 3, {}),
        (TypeError, "scene must be", "cube", {}),
        (ValueError, "window_size", SQUARE, {"window_size": (0, 10)}),
        (TypeError, "window_size", SQUARE, {"window_size": 10}),
        (ValueError, "camera", SQUARE, {"camera": (0, 0, 1)}),
        (ValueError, "color", SQUARE, {"color": (2.0, 0.0, 0.0)}),
        (ValueError, "tolerance", SQUARE, {"tolerance": 2.0}),
        (ValueError, "strength", SQUARE, {"strength": -1.0}),
        (ValueError, "point_radius", SQUARE, {"point_radius": -1.0}),
        (ValueError, "line_radius", SQUARE, {"line_radius": math.nan}),
        (TypeError, "line_radius", SQUARE, {"line_radius": "thin"}),
        (ValueError, "light_radius", SQUARE, {"light_radius": -1.0}),
        (ValueError, "light_angle", SQUARE, {"light_angle": 181.0}),
        (ValueError, "light_angle", SQUARE, {"light_angle": math.nan}),
        (IndexError, "line 0 has the point 4", (*SQUARE, [(0, 4)]), {}),
        (TypeError, "scene must be", (*SQUARE, None, None), {}),
    ])
    def test_refuses_wrong_arguments(self, error, match, scene, options):
        with pytest.raises(error, match=match):
            penumbra.render(scene, **options)


class TestCompare:
    def test_finds_equal_images_equal(self):
        image = np.random.default_rng(1).integers(0, 256, (20, 30, 3), np.uint8)
        result = penumbra.compare(image, image.copy(), tolerance=0.0)
        assert result.near
        assert result.rmse == result.maximum == result.pixels == 0.0
        assert result.worst == ()

    def test_measures_what_numpy_measures(self):
        generator = np.random.default_rng(2)
        a, b = (generator.integers(0, 256, (33, 50, 3), np.uint8) for _ in range(2))
        difference = np.abs(a / 255 - b / 255)
        result = penumbra.compare(a, b)
        assert not result.near
        assert math.isclose(result.rmse, math.sqrt((difference ** 2).mean()), rel_tol=1e-5)
        assert math.isclose(result.maximum, difference.max(), rel_tol=1e-5)
        assert math.isclose(result.pixels, (difference.max(axis=2) > 4.0001 / 255).mean(), rel_tol=1e-5)

    def test_names_the_worst_tile_by_column_and_row_from_the_top(self):
        a = np.zeros((48, 64, 3), np.uint8)
        b = a.copy()
        b[5, 40] = 255
        worst = penumbra.compare(a, b).worst
        assert [(tile.x, tile.y) for tile in worst] == [(32, 0)]
        assert math.isclose(worst[0].rmse, 1 / 16)

    def test_shows_the_difference_where_it_is(self):
        a = np.zeros((48, 64, 3), np.float32)
        b = a.copy()
        b[5, 40] = 0.125
        difference = penumbra.compare(a, b).difference
        assert difference.dtype == np.uint8
        assert np.argwhere(difference.max(axis=2)).tolist() == [[5, 40]]
        assert difference[5, 40, 0] == 128

    def test_ignores_masked_pixels(self):
        a = np.zeros((32, 32), np.uint8)
        b = a.copy()
        b[3, 4] = 255
        mask = np.full((32, 32), 255, np.uint8)
        mask[3, 4] = 0
        assert penumbra.compare(a, b, tolerance=0.0, mask=mask).near

    def test_refuses_what_cannot_be_compared(self):
        a = np.zeros((4, 5, 3), np.uint8)
        with pytest.raises(ValueError, match="a has 5 by 4 pixels and b 4 by 5"):
            penumbra.compare(a, a.transpose(1, 0, 2))
        with pytest.raises(TypeError, match="uint8"):
            penumbra.compare(a, a.astype(np.int64))
        with pytest.raises(ValueError, match="shape"):
            penumbra.compare(a, a[..., :0])
        with pytest.raises(ValueError, match="finite"):
            penumbra.compare(np.full((4, 5), np.nan), a)
        with pytest.raises(ValueError, match="tolerance"):
            penumbra.compare(a, a, tolerance=-1.0)


class TestClasses:
    def test_are_available_under_their_names(self):
        caster = penumbra.vtkPenumbraRayCaster()
        assert caster.GetTolerance() == 1 / 256
        assert "vtkPenumbraRayCaster" in dir(penumbra)
        with pytest.raises(AttributeError, match="vtkPenumbraNothing"):
            penumbra.vtkPenumbraNothing  # noqa: B018

    def test_messages_become_warnings_and_errors(self):
        caster = penumbra.vtkPenumbraRayCaster()
        caster.SetResolution(0, 0)
        with pytest.raises(RuntimeError, match="Resolution must be"), penumbra.messages_as_warnings():
            caster.Update()
