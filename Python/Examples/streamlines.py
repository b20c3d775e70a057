# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Streamlines around a sphere as tubes; ambient occlusion shows their depth order."""
import numpy
import penumbra  # noqa: F401
import pyvista as pv

# Potential flow around a sphere of radius 1.
grid = pv.ImageData(dimensions=(41, 41, 41), spacing=(0.15,) * 3, origin=(-3, -3, -3))
x = numpy.asarray(grid.points, dtype=float)
r = numpy.maximum(numpy.linalg.norm(x, axis=1), 1.0)[:, None]
grid["velocity"] = (1 + 0.5 / r**3) * numpy.array([1.0, 0, 0]) - 1.5 * x * x[:, :1] / r**5
lines = grid.streamlines(
    "velocity", source_center=(-2.9, 0, 0), source_radius=1.5, n_points=60, max_length=8.0)
assert isinstance(lines, pv.PolyData)
tubes = lines.tube(radius=0.05)
assert isinstance(tubes, pv.PolyData)

plotter = pv.Plotter(off_screen=True, window_size=[480, 360])
plotter.add_mesh(pv.Sphere(radius=1.0, theta_resolution=60, phi_resolution=60), color="white")
plotter.add_mesh(tubes, color="lightblue")
plotter.camera_position = [(-4, -9, 5), (0, 0, 0), (0, 0, 1)]
plain = numpy.asarray(plotter.screenshot(return_img=True))
occlusion = plotter.penumbra.enable_temporal_ssao(strength=0.8)
dark = numpy.asarray(plotter.screenshot("streamlines.png", return_img=True))
print(f"{occlusion.GetActiveKernelName()}, error {occlusion.GetEstimatedError():.4f}")

assert occlusion.IsConverged() and occlusion.GetEstimatedError() <= 0.01
assert dark.mean() < plain.mean() - 2
