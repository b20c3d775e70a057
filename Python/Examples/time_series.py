# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""A movie of a wave on a membrane; each frame has converged when it is saved."""
import matplotlib.animation
import matplotlib.pyplot
import numpy
import penumbra  # noqa: F401
import pyvista as pv

membrane = pv.Plane(i_size=4, j_size=4, i_resolution=80, j_resolution=80)
x, y = numpy.array(membrane.points).T[:2]
radius = numpy.hypot(x, y)
plotter = pv.Plotter(off_screen=True, window_size=[320, 240])
plotter.add_mesh(membrane, color="white", smooth_shading=True)
plotter.camera_position = [(3, -5, 4), (0, 0, 0), (0, 0, 1)]
occlusion = plotter.penumbra.enable_temporal_ssao(radius=0.8, kernel="march")

plotter.show(auto_close=False)
frames = []
for time in numpy.linspace(0, 2 * numpy.pi, 8, endpoint=False):
    membrane.points = numpy.column_stack([x, y, 0.3 * numpy.cos(4 * radius - time)])
    membrane.compute_normals(inplace=True)
    plotter.render()
    assert occlusion.IsConverged()
    frames.append(numpy.asarray(plotter.screenshot(return_img=True)))

figure = matplotlib.pyplot.figure(figsize=(3.2, 2.4), dpi=100)
axes = figure.add_axes((0, 0, 1, 1))
axes.set_axis_off()
shown = axes.imshow(frames[0])
movie = matplotlib.animation.FuncAnimation(figure, lambda i: shown.set_data(frames[i]), len(frames))
movie.save("time_series.gif", writer="pillow", fps=8)

differences = [numpy.abs(a.astype(int) - b).mean() for a, b in zip(frames, frames[1:])]
assert min(differences) > 1
