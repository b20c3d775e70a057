# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the seconds of a frame of points that PyVista renders as spheres with SSAO, 1000 x 600, the best of three.

The points are single precision coordinates in a cube from the origin. spheres.py FILE
"""
import sys
import time

import numpy
import pyvista


def main():
    points = numpy.fromfile(sys.argv[1], "f4").reshape(-1, 3)
    side = float(numpy.ceil(points.max()))
    plotter = pyvista.Plotter(off_screen=True, window_size=(1000, 600))
    # Three pixels are the diameter of the spheres in the middle of the cube.
    plotter.add_mesh(pyvista.PolyData(points), style="points", render_points_as_spheres=True, point_size=3, color="white")
    plotter.camera_position = [(2.4 * side,) * 3, (0.5 * side,) * 3, (0.0, 0.0, 1.0)]
    plotter.enable_ssao(radius=3.0)
    times = []
    for _ in range(4):  # shaders are compiled for the first
        plotter.reset_camera_clipping_range()
        begin = time.perf_counter()
        plotter.render_window.Render()
        plotter.render_window.WaitForCompletion()
        times.append(time.perf_counter() - begin)
    print(min(times[1:]))


main()
