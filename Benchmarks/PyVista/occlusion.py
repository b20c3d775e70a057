# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares PyVista's enable_ssao() with plotter.penumbra.enable_temporal_ssao(): time, and error against rays.

The scene is a scanned head on a floor, 1024 x 768, with ambient color alone, so that pixels contain 1 - occlusion. It has
lights, without which enable_ssao() changes nothing. Times are the additional seconds per frame of a moving camera over
plain frames, the best of three runs. Errors are the RMSE against rays over pixels inside surfaces, of the last moving
frame and of the static image.
occlusion.py MESH
"""
import sys
import time

import numpy
import penumbra
import pyvista

FRAMES = 8
SIZE = (1024, 768)


def make_scene(path):
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
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


def render_frame(plotter):
    """Renders one frame and waits for its completion."""
    plotter.render_window.Render()
    plotter.render_window.WaitForCompletion()


def read_image(plotter):
    return plotter.screenshot(return_img=True)[..., 0].astype(float) / 255


def time_motion(plotter):
    """Returns the seconds per frame while the camera rotates back and forth. Shaders are already compiled."""
    times = []
    for _ in range(3):
        begin = time.perf_counter()
        for step in range(2 * FRAMES):
            plotter.camera.azimuth += 0.25 if step < FRAMES else -0.25
            render_frame(plotter)
        times.append((time.perf_counter() - begin) / (2 * FRAMES))
    return min(times)


def main():
    plotter, radius = make_scene(sys.argv[1])
    render_frame(plotter)
    plain = time_motion(plotter)
    rays = plotter.penumbra.ray_cast(ambient_occlusion=True, radius=radius, tolerance=1 / 256)
    rays = rays[..., 0].astype(float) / 255
    # Excludes silhouettes, where the two images may show different surfaces.
    seen = numpy.abs(read_image(plotter) - 1.0) < 0.01
    inside = seen.copy()
    for axis in (0, 1):
        for shift in (-2, -1, 1, 2):
            inside &= numpy.roll(seen, shift, axis)

    def error():
        return numpy.sqrt(((read_image(plotter) - rays)[inside] ** 2).mean())

    plotter.enable_ssao(radius=radius, kernel_size=256)
    render_frame(plotter)
    theirs = time_motion(plotter) - plain
    theirs_error = error()
    plotter.disable_ssao()
    occlusion = plotter.penumbra.enable_temporal_ssao(radius=radius)
    occlusion.SetConvergeInOneRender(occlusion.NEVER)
    render_frame(plotter)
    ours = time_motion(plotter) - plain
    moving_error = error()
    kernel = occlusion.GetActiveKernelName()
    occlusion.SetConvergeInOneRender(occlusion.ALWAYS)
    render_frame(plotter)
    still_error = error()

    def row(what, measured, bar, remark):
        verdict = "met" if measured <= bar else "**missed**"
        print(f"| {what} | {measured:.3g} | <= {bar:.3g} | {verdict} | {remark} |")

    row("overhead of a moving frame over that of enable_ssao", ours / theirs, 0.25,
        f"{1e3 * ours:.0f} ms, kernel {kernel}, over {1e3 * theirs:.0f} ms at its default of 256; "
        f"plain {1e3 * plain:.0f} ms")
    row("error of a moving frame", moving_error, theirs_error, "the target is the error of enable_ssao")
    row("error of the still image", still_error, theirs_error, "the target is the error of enable_ssao")


main()
