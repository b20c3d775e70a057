# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of PyVista whose figures are measured by figures.py: one call per feature of plotters."""
import numpy
import pyvista
from pyvista import examples

SIZE = (800, 600)


def make_plotter():
    return pyvista.Plotter(off_screen=True, window_size=SIZE)


def make_waves():
    x, y = numpy.meshgrid(numpy.arange(-10, 10, 0.25), numpy.arange(-10, 10, 0.25))
    return pyvista.StructuredGrid(x, y, numpy.sin(numpy.hypot(x, y)))


def hills(plotter):
    plotter.add_mesh(examples.load_random_hills(), smooth_shading=True, show_scalar_bar=False)


def scalar_bar(plotter):
    plotter.add_mesh(examples.load_random_hills(), scalars="Elevation", smooth_shading=True,
                     scalar_bar_args={"title": "Elevation in m"})


def legend(plotter):
    plotter.add_mesh(pyvista.Cube(), color="tomato", label="cube")
    plotter.add_mesh(pyvista.Sphere(radius=0.6), color="steelblue", label="sphere")
    plotter.add_legend(bcolor="white")


def corner_text(plotter):
    plotter.add_mesh(pyvista.Cone(resolution=40), color="gold")
    plotter.add_text("Cone of 40 faces", position="upper_left")
    plotter.add_title("A figure")


def point_labels(plotter):
    plotter.add_mesh(pyvista.Icosahedron(), color="lightgreen", show_edges=True)
    plotter.add_point_labels([(0, 0, 1.1), (1.1, 0, 0)], ["top", "side"], shape=None, font_size=24)


def translucent(plotter):
    plotter.add_mesh(pyvista.Sphere(radius=0.4), color="red")
    plotter.add_mesh(pyvista.Cube(), color="white", opacity=0.4)
    plotter.add_text("translucent", position="lower_left")


def edges(plotter):
    plotter.add_mesh(pyvista.Sphere(theta_resolution=24, phi_resolution=16), color="white", show_edges=True)


def wireframe(plotter):
    plotter.add_mesh(pyvista.ParametricTorus().decimate(0.5), style="wireframe", color="black", line_width=2)


def points(plotter):
    plotter.add_points(numpy.random.default_rng(3).normal(size=(300, 3)), color="navy", point_size=12)


def spheres(plotter):
    plotter.add_points(numpy.random.default_rng(4).uniform(size=(60, 3)), color="orange", point_size=40,
                       render_points_as_spheres=True)


def tubes(plotter):
    plotter.add_mesh(pyvista.Spline(examples.load_spline().points, 400).tube(radius=0.1), scalars="arc_length",
                     show_scalar_bar=False, smooth_shading=True)


def arrows(plotter):
    plotter.add_mesh(examples.load_sphere_vectors().arrows, color="orange", show_scalar_bar=False)


def contours(plotter):
    waves = make_waves()
    waves["height"] = waves.points[:, 2]
    plotter.add_mesh(waves, scalars="height", n_colors=8, show_scalar_bar=False)
    plotter.add_mesh(waves.contour(8), color="black", line_width=3)


def bounds(plotter):
    plotter.add_mesh(make_waves(), color="wheat")
    plotter.show_bounds(grid="back", location="outer", xtitle="x in m")


def grid(plotter):
    plotter.add_mesh(examples.load_uniform(), scalars="Spatial Cell Data", show_edges=True)


def ruler(plotter):
    plotter.add_mesh(pyvista.Cube(), color="lightblue")
    plotter.add_ruler((-0.5, -0.5, 0.7), (0.5, -0.5, 0.7), title="width")


def axes(plotter):
    plotter.add_mesh(pyvista.ParametricSuperToroid(), color="plum", smooth_shading=True)
    plotter.add_axes()


def texture(plotter):
    plotter.add_mesh(examples.load_globe(), texture=examples.load_globe_texture(), smooth_shading=True)


def hexahedra(plotter):
    plotter.add_mesh(examples.load_hexbeam(), color="white", show_edges=True, line_width=2)
    plotter.add_text("beam", position="upper_right")


def chart(plotter):
    plotter.add_mesh(pyvista.Sphere(), color="white")
    area = pyvista.Chart2D(size=(0.45, 0.4), loc=(0.05, 0.55), x_label="time", y_label="height")
    area.line(range(10), [value * value for value in range(10)])
    plotter.add_chart(area)


# Texts that the figure must hold as text.
SCENES = {
    hills: (), scalar_bar: ("Elevation in m",), legend: ("cube", "sphere"), corner_text: ("Cone of 40 faces", "A figure"),
    point_labels: ("top", "side"), translucent: ("translucent",), edges: (), wireframe: (), points: (), spheres: (),
    tubes: (), arrows: (), contours: (), bounds: ("x in m",), grid: ("Spatial Cell Data",), ruler: ("width",),
    axes: ("X",), texture: (), hexahedra: ("beam",), chart: ("height",),
}
