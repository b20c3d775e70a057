# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""F3D with OpenGL in software: an image with ambient occlusion of the depth buffer and supersampling.

f3d_image.py MESH.ply IMAGE.png [plain]: plain is without occlusion. Without arguments, it prints the version.
"""
import sys

import f3d

import view


def main():
    if len(sys.argv) < 3:
        print("F3D", f3d.__version__)
        return
    f3d.Engine.autoload_plugins()
    engine = f3d.Engine.create_osmesa()
    engine.options.update({
        "render.background.color": [0.0, 0.0, 0.0], "render.grid.enable": False, "ui.axis": False,
        "render.effect.ambient_occlusion": "plain" not in sys.argv, "render.effect.antialiasing.mode": "ssaa"})
    engine.scene.add(sys.argv[1])
    engine.window.size = view.SIZE
    camera = engine.window.camera
    camera.position, camera.focal_point, camera.view_up = view.EYE, view.TARGET, view.UP
    camera.view_angle = view.ANGLE
    engine.window.render_to_image().save(sys.argv[2])


main()
