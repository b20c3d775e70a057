# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""A movie of a turning nut by PyVista's writer of movies: by OpenGL, converged, and by rays."""
from typing import Any

import numpy
import PIL.Image
import penumbra  # noqa: F401
import pyvista as pv


class Gif:
    """Writes a GIF with Pillow, as the writers of imageio that open_gif() and open_movie() need."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.frames: list[PIL.Image.Image] = []

    def append_data(self, image: Any) -> None:
        self.frames.append(PIL.Image.fromarray(numpy.asarray(image)))

    def close(self) -> None:
        self.frames[0].save(self.path, save_all=True, append_images=self.frames[1:], duration=125, loop=0)


plotter = pv.Plotter(off_screen=True, window_size=[240, 180])
plotter.add_mesh(pv.examples.load_nut(), color="silver")
plotter.penumbra.look("studio")
occlusion = plotter.penumbra.enable_temporal_ssao(tolerance=0.02)
plotter.mwriter = window = Gif("movie-opengl.gif")  # or plotter.open_movie("movie.mp4"), with imageio-ffmpeg
rays = Gif("movie-rays.gif")
for _ in range(6):
    plotter.camera.azimuth += 10
    plotter.penumbra.look("studio")  # the lights follow the camera
    plotter.write_frame()
    assert occlusion.IsConverged()
    rays.append_data(plotter.penumbra.ray_cast(tolerance=1 / 64))
rays.close()
plotter.close()  # closes the writer, too

for a, b in zip(window.frames, rays.frames):
    assert numpy.abs(numpy.asarray(a, float) - numpy.asarray(b, float)).mean() < 6
assert numpy.abs(numpy.asarray(rays.frames[0], float) - numpy.asarray(rays.frames[-1], float)).mean() > 2
