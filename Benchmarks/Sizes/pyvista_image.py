# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista with OpenGL in software: ambient occlusion of the depth buffer and supersampling.

pyvista_image.py MESH.ply IMAGE.png [plain]: plain is without occlusion. Without arguments, it prints the version.
"""
import sys

import pyvista

import view


def main():
    if len(sys.argv) < 3:
        print("PyVista", pyvista.__version__)
        return
    plotter = pyvista.Plotter(off_screen=True, window_size=view.SIZE)
    plotter.set_background("black")
    plotter.add_mesh(pyvista.read(sys.argv[1]), color="white")
    plotter.camera_position = [view.EYE, view.TARGET, view.UP]
    plotter.camera.view_angle = view.ANGLE
    if "plain" not in sys.argv:
        plotter.enable_ssao(radius=view.RADIUS)
    plotter.enable_anti_aliasing("ssaa")
    plotter.show(screenshot=sys.argv[2])


main()
