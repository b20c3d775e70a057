# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's enable_ssao() beside plotter.penumbra.enable_temporal_ssao(): time and distance from rays.

A scanned head on a floor, 1024 x 768, without lights, so that pixels show 1 - occlusion. Seconds are of
frames while the camera moves, the best of three runs, over plain frames of the same run; errors are RMSE
over pixels inside surfaces against rays, of the last moving frame and of the still picture.
occlusion.py MESH
"""
import sys
import time

import numpy
import penumbra
import pyvista

FRAMES = 8
SIZE = (1024, 768)


def stage(path):
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE, lighting="none")
    plotter.set_background("black")
    head = pyvista.read(path)
    low, high = numpy.array(head.bounds).reshape(3, 2).T
    middle, extent = (low + high) / 2, (high - low).max()
    floor = pyvista.Plane(center=(middle[0], middle[1], low[2]), i_size=3 * extent, j_size=3 * extent)
    for mesh in (head, floor):
        plotter.add_mesh(mesh, color="white", ambient=1.0, diffuse=0.0, specular=0.0)
    plotter.camera_position = [
        middle + extent * numpy.array([1.2, -2.2, 1.3]), middle, (0.0, 0.0, 1.0)]
    return plotter, 0.1 * extent


def frame(plotter):
    """One frame, finished."""
    plotter.render_window.Render()
    plotter.render_window.WaitForCompletion()


def picture(plotter):
    return plotter.screenshot(return_img=True)[..., 0].astype(float) / 255


def moving(plotter):
    """Seconds a frame while the camera turns, there and back; compiled shaders are there already."""
    times = []
    for _ in range(3):
        begin = time.perf_counter()
        for step in range(2 * FRAMES):
            plotter.camera.azimuth += 0.25 if step < FRAMES else -0.25
            frame(plotter)
        times.append((time.perf_counter() - begin) / (2 * FRAMES))
    return min(times)


def main():
    plotter, radius = stage(sys.argv[1])
    frame(plotter)
    plain = moving(plotter)
    rays = plotter.penumbra.ray_cast(ambient_occlusion=True, radius=radius, tolerance=1 / 256)
    rays = rays[..., 0].astype(float) / 255
    # Away from borders of things, where one picture shows the one and the other the other.
    seen = numpy.abs(picture(plotter) - 1.0) < 0.01
    inside = seen.copy()
    for axis in (0, 1):
        for shift in (-2, -1, 1, 2):
            inside &= numpy.roll(seen, shift, axis)

    def error():
        return numpy.sqrt(((picture(plotter) - rays)[inside] ** 2).mean())

    plotter.enable_ssao(radius=radius, kernel_size=256)
    frame(plotter)
    theirs = moving(plotter) - plain
    theirs_error = error()
    plotter.disable_ssao()
    occlusion = plotter.penumbra.enable_temporal_ssao(radius=radius)
    occlusion.SetConvergeInOneRender(occlusion.NEVER)
    frame(plotter)
    ours = moving(plotter) - plain
    moving_error = error()
    kernel = occlusion.GetActiveKernelName()
    occlusion.SetConvergeInOneRender(occlusion.ALWAYS)
    frame(plotter)
    still_error = error()

    def row(what, measured, bar, remark):
        verdict = "met" if measured <= bar else "**missed**"
        print(f"| {what} | {measured:.3g} | <= {bar:.3g} | {verdict} | {remark} |")

    row("overhead of a moving frame over that of enable_ssao", ours / theirs, 0.25,
        f"{1e3 * ours:.0f} ms, kernel {kernel}, over {1e3 * theirs:.0f} ms at its default of 256; "
        f"plain {1e3 * plain:.0f} ms")
    row("error of a moving frame", moving_error, theirs_error, "the bar is that of enable_ssao")
    row("error of the still picture", still_error, theirs_error, "the bar is that of enable_ssao")


main()
