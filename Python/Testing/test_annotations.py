# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the annotations of PyVista in ray-cast images, against the images of VTK's rasterizer."""
import numpy as np
import pytest

pyvista = pytest.importorskip("pyvista")

SIZE = (240, 180)


def make(add):
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE, lighting="none")
    plotter.set_background("white")
    plotter.add_mesh(pyvista.Plane(i_resolution=4, j_resolution=4), color="tan", lighting=False)
    add(plotter)
    plotter.view_xy()
    return plotter


def differing(rays, raster):
    """Return the fraction of pixels outside of the range of the pixel of the rasterizer and its neighbors."""
    rows, columns = rays.shape[:2]
    padded = np.pad(raster.astype(int), ((1, 1), (1, 1), (0, 0)), "edge")
    parts = [padded[j:j + rows, i:i + columns] for j in range(3) for i in range(3)]
    low, high = np.min(parts, axis=0), np.max(parts, axis=0)
    return np.mean(np.any((rays < low - 8) | (rays > high + 8), axis=2))


def ruler(plotter):
    plotter.add_ruler((-0.5, -0.55, 0.0), (0.5, -0.55, 0.0), title="Length", font_size_factor=0.8)


def legend_scale(plotter):
    plotter.enable_parallel_projection()
    plotter.add_legend_scale()


def filled_scalar_bar(plotter):
    mesh = pyvista.Plane(i_resolution=4, j_resolution=4)
    mesh["height"] = mesh.points[:, 1]
    plotter.add_mesh(mesh, lighting=False, scalar_bar_args={
        "fill": True, "background_color": "white", "color": "red", "label_font_size": 12, "title_font_size": 12})


def labels(plotter):
    points = np.array([(x, y, z) for x in (-0.3, 0.1) for y, z in ((-0.3, 0.2), (0.0, -0.2), (0.3, 0.2))])
    plotter.add_point_labels(points, [f"P{i}" for i in range(len(points))], font_size=12, point_size=2)


def plain_labels(plotter):
    points = np.array([(x, y, z) for x in (-0.3, 0.1) for y, z in ((-0.3, 0.2), (0.0, -0.2), (0.3, 0.2))])
    plotter.add_point_labels(points, [f"P{i}" for i in range(len(points))], font_size=12, point_size=2, shape=None)


# The first two crashed with vtk 9.7.1, whose class of axes has another function than that of 9.7.0.
@pytest.mark.parametrize("add", [ruler, legend_scale, filled_scalar_bar, labels, plain_labels])
def test_annotations_are_drawn_before_vtk_has_rendered(add):
    plotter = make(add)
    image = plotter.penumbra.ray_cast()
    plotter.show(auto_close=False)
    plotter.render()
    raster = plotter.screenshot(return_img=True)
    assert differing(image, raster) < (0.002 if add is filled_scalar_bar else 0.015)
    # Black text and lines, and red text, which the scene does not have otherwise.
    ink = [((part[..., 1:] < 70).all(axis=2) & ((part[..., 0] < 70) | (part[..., 0] > 180))).sum()
           for part in (image, raster)]
    assert ink[1] > 5
    assert ink[0] > 0.8 * ink[1]
    plotter.close()


def test_labels_behind_a_surface_are_hidden():
    def one(height, always_visible):
        return make(lambda plotter: plotter.add_point_labels(
            np.array([(0.0, 0.0, height), (0.1, 0.0, 0.0)]), ["HH", ""], point_size=1, font_size=20, text_color="black",
            shape_opacity=0.0, always_visible=always_visible)).penumbra.ray_cast()

    dark = [(one(*arguments) < 60).all(axis=2).sum() for arguments in ((0.2, True), (0.2, False), (-0.2, False))]
    assert dark[0] > 20
    assert dark[1] == dark[0]
    assert dark[2] == 0


# With more samples than one, the window has the depths of samples, not of centers of pixels: at silhouettes, these decide.
@pytest.mark.parametrize("size", [(240, 180), (300, 300), (640, 480)])
def test_labels_at_silhouettes_are_those_of_vtk_with_one_sample_per_pixel(size):
    mesh = pyvista.Sphere(theta_resolution=8, phi_resolution=8)
    plotter = pyvista.Plotter(off_screen=True, window_size=size, lighting="none")
    plotter.render_window.SetMultiSamples(0)
    plotter.set_background("white")
    plotter.add_mesh(mesh, color="tan")
    plotter.add_point_labels(mesh.points, ["X"] * mesh.n_points, point_size=1, font_size=12)
    plotter.show(auto_close=False)
    assert differing(plotter.penumbra.ray_cast(), plotter.screenshot(return_img=True)) < 0.0005
    plotter.close()


def test_lines_of_charts_cover_the_pixels_of_vtk():
    for location, length in (((0.0, 0.0), (1.0, 1.0)), ((0.1, 0.1), (0.8, 0.8))):
        plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
        chart = pyvista.Chart2D(size=length, loc=location)
        chart.line([0, 1], [0, 1])
        plotter.add_chart(chart)
        plotter.show(auto_close=False)
        # The border of a chart of the size of the window is outside of its last pixels.
        lines = [[np.flatnonzero((image[..., :3] < 140).all(axis=2).mean(axis=axis) > 0.75).tolist() for axis in (0, 1)]
                 for image in (plotter.penumbra.ray_cast(), plotter.screenshot(return_img=True))]
        assert lines[0] == lines[1]
        assert all(0 < line < SIZE[axis] - 1 for axis in (0, 1) for line in lines[0][axis])
        plotter.close()
