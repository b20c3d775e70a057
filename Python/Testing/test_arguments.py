# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of what functions and accessors accept as colors, sizes, integers and meshes."""
import io
import math
import time
import types

import numpy as np
import pytest

import penumbra
from penumbra.baking import needed_bounces
from penumbra.conversion import parse_color, poly_data
from penumbra._backend import vtk_module

POINTS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 0.4)], float)
TRIANGLES = np.array([(0, 1, 2), (0, 2, 3), (0, 1, 4)])
SQUARE = (POINTS[:4], TRIANGLES[:2])

# Truth: the tables of CSS and of matplotlib.
RGB = {"w": (255, 255, 255), "r": (255, 0, 0), "k": (0, 0, 0), "tab:blue": (31, 119, 180), "tab:Orange": (255, 127, 14),
       "red": (255, 0, 0), "tomato": (255, 99, 71), "#102030": (16, 32, 48), "#fA0": (255, 170, 0)}


@pytest.mark.parametrize("name", RGB)
def test_colors_have_the_names_of_matplotlib_and_vtk(name):
    assert [round(255 * channel) for channel in parse_color("color", name)] == list(RGB[name])
    pixel = penumbra.render(SQUARE, window_size=(8, 8), color=name, camera=[(.5, .5, 3), (.5, .5, 0), (0, 1, 0)])[4, 4]
    assert np.abs(pixel.astype(int) - RGB[name]).max() <= 2


@pytest.mark.parametrize("name", ["#zzzzzz", "#12", "#1234567", "", "tab:rose", "ruby red"])
def test_other_names_of_colors_are_refused(name):
    with pytest.raises(ValueError, match="color must be"):
        penumbra.render(SQUARE, window_size=(8, 8), color=name)
    with pytest.raises(ValueError, match="environment_color must be"):
        penumbra.irradiance(*SQUARE, environment_color=name)


@pytest.mark.parametrize("size", [(24, 16), [24, 16], np.array([24, 16]), (24.0, np.int32(16))])
def test_sizes_are_any_two_integers(size):
    assert penumbra.render(SQUARE, window_size=size).shape == (16, 24, 3)


@pytest.mark.parametrize(("error", "size"), [
    (ValueError, (24.5, 16)), (ValueError, (True, 16)), (TypeError, (24, 16, 1)), (TypeError, "ab"), (TypeError, 24),
    (TypeError, (math.inf, 16)), (TypeError, (math.nan, 16)), (ValueError, (0, 16)), (ValueError, (24, 65536)),
    (TypeError, np.zeros((2, 2)))])
def test_other_sizes_are_refused(error, size):
    with pytest.raises(error, match="window_size must be"):
        penumbra.render(SQUARE, window_size=size)


def test_bounces_are_integers():
    with pytest.raises(ValueError, match="bounces must be an integer, not 2.5"):
        penumbra.render(SQUARE, window_size=(8, 8), bounces=2.5)
    with pytest.raises(ValueError, match="bounces must be an integer"):
        penumbra.irradiance(*SQUARE, bounces=1.5)
    np.testing.assert_array_equal(penumbra.irradiance(*SQUARE, bounces=2.0), penumbra.irradiance(*SQUARE, bounces=2))


def test_bounces_that_add_nothing_are_omitted():
    assert needed_bounces(64, 0.0, 0.01) == 1
    assert needed_bounces(64, 1.0, 0.01) == 64
    assert needed_bounces(3, 0.5, 0.01) == 3
    for albedo in (0.2, 0.5, 0.9):
        for tolerance in (0.1, 0.001):
            bounces = needed_bounces(10000, albedo, tolerance)
            rest = [math.pi * albedo ** n / (1.0 - albedo) for n in (bounces, bounces - 1)]
            assert rest[0] <= 0.01 * tolerance < rest[1]


def test_flat_faces_are_those_of_rows():
    flat = np.insert(TRIANGLES, 0, 3, axis=1).ravel()
    mixed = np.array([3, 0, 1, 4, 4, 0, 1, 2, 3])
    values = penumbra.ambient_occlusion(POINTS, TRIANGLES, radius=1.0)
    np.testing.assert_array_equal(penumbra.ambient_occlusion(POINTS, flat, radius=1.0), values)
    cells = poly_data(POINTS, mixed).GetPolys()
    assert [cells.GetCellSize(i) for i in range(cells.GetNumberOfCells())] == [3, 4]
    with pytest.raises(ValueError, match=r"faces\[4\] = 2 is no such number"):
        penumbra.ambient_occlusion(POINTS, [3, 0, 1, 4, 2, 0, 1])
    with pytest.raises(ValueError, match=r"faces\[4\] = 3 is no such number"):
        penumbra.ambient_occlusion(POINTS, [3, 0, 1, 4, 3, 0, 1])


@pytest.mark.parametrize("sizes", [[3], [3, 4]])
def test_long_flat_faces_are_read_quickly(sizes):
    count = 300000
    cells = [[size, *range(size)] for size in sizes]
    flat = np.concatenate(cells * (count // len(sizes)))
    begin = time.process_time()
    data = poly_data(POINTS, flat)
    assert time.process_time() - begin < 0.7  # 0.1; one element of the array after the other took 1.4
    assert data.GetNumberOfPolys() == count


def test_meshes_of_other_packages_are_arrays():
    expected = penumbra.ambient_occlusion(POINTS, TRIANGLES, radius=1.0)
    block = types.SimpleNamespace(type="triangle", data=TRIANGLES)
    trimesh = types.SimpleNamespace(vertices=POINTS, faces=TRIANGLES)
    meshio = types.SimpleNamespace(points=POINTS, cells=[block], cells_dict={"triangle": TRIANGLES})
    image = penumbra.render((POINTS, TRIANGLES), window_size=(24, 16))
    for mesh in (trimesh, meshio, poly_data(POINTS, TRIANGLES)):
        np.testing.assert_array_equal(penumbra.ambient_occlusion(mesh, radius=1.0), expected)
        np.testing.assert_array_equal(penumbra.render(mesh, window_size=(24, 16)), image)
    meshio.cells.append(types.SimpleNamespace(type="quad", data=np.array([(0, 1, 2, 3)])))
    assert penumbra.ambient_occlusion(meshio, on="cells").shape == (4,)
    meshio.cells.append(types.SimpleNamespace(type="tetra", data=np.array([(0, 1, 2, 3)])))
    with pytest.raises(TypeError, match="must be triangles or quads, not quad, tetra, triangle: pass its surface"):
        penumbra.render(meshio)
    grid = vtk_module("vtkCommonDataModel").vtkUnstructuredGrid()
    with pytest.raises(TypeError, match="not a vtkUnstructuredGrid"):
        penumbra.ambient_occlusion(grid)
    with pytest.raises(ValueError, match="without polygons"):
        penumbra.ambient_occlusion(vtk_module("vtkCommonDataModel").vtkPolyData())


def test_equal_images_are_compared_quickly():
    image = np.random.default_rng(3).integers(0, 256, (2160, 3840, 3), np.uint8)
    begin = time.process_time()
    result = penumbra.compare(image, image.copy(), tolerance=0.0)
    assert time.process_time() - begin < 3.0  # 0.3; all metrics took 10
    assert result.near
    assert result.difference.shape == image.shape
    assert not result.difference.any()
    with pytest.raises(ValueError, match="finite"):
        penumbra.compare(np.full((4, 5), np.inf), np.full((4, 5), np.inf))


def test_worst_tiles_are_those_of_a_grid():
    a = np.zeros((40, 50, 3), np.float32)
    b = a.copy()
    b[33:, 49] = 0.5  # in the tile of 8 rows and 2 columns
    b[0, 0] = 0.25
    worst = penumbra.compare(a, b).worst
    assert [(tile.x, tile.y) for tile in worst] == [(48, 32), (0, 0)]
    assert math.isclose(worst[0].rmse, math.sqrt(7 * 0.25 / 16), rel_tol=1e-5)
    assert math.isclose(worst[1].rmse, 0.25 / 16, rel_tol=1e-5)


# A floor, and a wall of height 1 that is nearly endless, seen from above.
CORNER = ([(0, -99, 0), (4, -99, 0), (4, 99, 0), (0, 99, 0), (0, -99, 1), (0, 99, 1)], [(0, 1, 2, 3), (0, 3, 5, 4)])


def corner_camera():
    camera = vtk_module("vtkRenderingCore").vtkCamera()
    camera.SetFocalPoint(2, 0, 0)
    camera.SetPosition(2, 0, 9)
    camera.SetClippingRange(1, 20)
    camera.ParallelProjectionOn()
    camera.SetParallelScale(1.5)
    return camera


def test_providers_meet_the_light_tolerance():
    tolerance = 0.01
    records = penumbra.vtkPenumbraIrradianceCache()
    joined = penumbra.vtkPenumbraBruteForceIrradiance()
    joined.SetJoinPixels(True)
    options = {"window_size": (64, 48), "as_float": True, "camera": corner_camera(), "radius": math.inf}
    plain = penumbra.render(CORNER, **options)
    x = (np.arange(64) + 0.5) / 16
    expected = 1 - (1 - x / np.sqrt(x ** 2 + 1)) / 2
    found = {}
    for cache in (None, "world", "screen", "none", records, joined):
        image, statistics = penumbra.render(
            CORNER, ambient_occlusion=True, light_tolerance=tolerance, cache=cache, return_statistics=True, **options)
        errors = (image / plain)[..., 0] - expected
        assert math.sqrt((errors ** 2).mean()) < tolerance
        assert ("Cache/Records" in statistics) == (cache in ("world", "screen", records))
        assert statistics.get("Cache/Records", 4) > 3
        found[cache] = image
    np.testing.assert_array_equal(found[records], found["world"])
    np.testing.assert_array_equal(found[joined], found["none"])
    np.testing.assert_array_equal(found[None], found["none"])


def test_other_providers_are_refused():
    with pytest.raises(ValueError, match="cache must be one of 'world', 'screen', 'none', not 'disk'"):
        penumbra.render(SQUARE, cache="disk")
    with pytest.raises(TypeError, match="not a vtkPenumbraRayCaster"):
        penumbra.render(SQUARE, cache=penumbra.vtkPenumbraRayCaster())
    with pytest.raises(ValueError, match="cache must be one of"):
        penumbra.render(SQUARE, cache=3)


def test_light_is_bounded_by_its_tolerance():
    options = {"window_size": (64, 48), "camera": corner_camera(), "ambient_occlusion": True, "return_statistics": True}
    rays = [penumbra.render(CORNER, light_tolerance=tolerance, **options)[1] for tolerance in (0.05, 0.005)]
    assert rays[1]["EstimatedLightError"] < 0.00501 < rays[0]["EstimatedLightError"] < 0.0501
    assert rays[1]["Rays/Occlusion"] > 4 * rays[0]["Rays/Occlusion"]


@pytest.mark.parametrize("camera", [
    [(.5, .5, 3), (.5, .5, 0), (0, 1, 0)], np.array([(.5, .5, 3), (.5, .5, 0), (0, 1, 0)])])
def test_cameras_are_three_points(camera):
    assert penumbra.render(SQUARE, window_size=(8, 8), camera=camera)[4, 4].min() > 100


@pytest.mark.parametrize("camera", ["xy", [1, 2, 3], np.zeros(9), [(0, 0, 1), (0, 0, 0)], [(0, 0, 1), None, (0, 1, 0)]])
def test_other_cameras_are_refused(camera):
    with pytest.raises(ValueError, match="camera must be three points"):
        penumbra.render(SQUARE, camera=camera)


@pytest.fixture
def plotter():
    pyvista = pytest.importorskip("pyvista")
    plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30))
    plotter.add_mesh(pyvista.Plane())
    yield plotter
    plotter.close()


def test_accessors_accept_arrays_as_sizes(plotter):
    assert plotter.penumbra.ray_cast(window_size=np.array([24, 16])).shape == (16, 24, 3)
    with pytest.raises(ValueError, match="window_size must be two integers"):
        plotter.penumbra.ray_cast(window_size=(24.5, 16))
    with pytest.raises(ValueError, match="scale must be an integer, not 1.5"):
        plotter.penumbra.ray_cast(scale=1.5)
    with pytest.raises(ValueError, match="scale must be in"):
        plotter.penumbra.ray_cast(scale=0)


def test_screenshot_writes_nothing_to_true(plotter, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    image = plotter.penumbra.screenshot(True)
    np.testing.assert_array_equal(image, plotter.penumbra.screenshot())
    assert not list(tmp_path.iterdir())
    memory = io.BytesIO()
    assert plotter.penumbra.screenshot(memory, return_img=False) is None
    assert memory.getvalue().startswith(b"\x89PNG")


def test_accessors_have_a_provider(plotter, tmp_path):
    options = {"ambient_occlusion": True, "cache": "screen", "return_statistics": True}
    assert "Cache/Records" in plotter.penumbra.ray_cast(**options)[1]
    assert "Cache/Records" in plotter.penumbra.save_graphic(tmp_path / "figure.svg", maximum_paths=0, **options)


def test_accessors_and_functions_have_the_same_colors(plotter):
    pyvista = pytest.importorskip("pyvista")
    for color in ("w", "tab:blue", "#10203040", "0x102030", pyvista.Color("tomato")):
        expected = pyvista.Color(color).float_rgb
        assert parse_color("color", color) == pytest.approx(expected)
    with pytest.raises(ValueError, match="environment_color must be"):
        plotter.penumbra.ray_cast(indirect_light=True, environment_color="#zzzzzz")


@pytest.mark.parametrize("state, error", [
    ({"radius": -1}, ValueError), ({"strength": 2.0}, ValueError), ({"tolerance": 0.0}, ValueError),
    ({"ambient_oclusion": True}, TypeError), ({"light_shafts": "no"}, TypeError), ({"radius": "large"}, TypeError)])
def test_render_passes_provider_refuses_wrong_states(state, error):
    pytest.importorskip("pyvista_render_passes")
    passes = pytest.importorskip("pyvista").Plotter(off_screen=True).render_passes
    before = passes.get_state()["providers"]["penumbra"]
    with pytest.raises(error, match=next(iter(state))):
        passes.set_state({"providers": {"penumbra": state}})
    assert passes.get_state()["providers"]["penumbra"] == before
    passes.set_state({"providers": {"penumbra": {"radius": 2, "ambient_occlusion": True}}})
    assert passes.get_state()["providers"]["penumbra"]["radius"] == 2
