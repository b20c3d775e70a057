# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the CPU seconds of an image of a mesh with F3D's ambient occlusion and supersampling.

    python f3d_occlusion.py                     prints F3D's version; fails if it is not installed
    python f3d_occlusion.py MESH SIDE EYE ANGLE    SIDE x SIDE pixels, from EYE (x,y,z) toward the origin, z up

The image is the first one after the file has been read."""
import sys
import time

import f3d


def main():
    if len(sys.argv) < 5:
        print(f3d.__version__)
        return
    mesh, side, eye, angle = sys.argv[1:5]
    f3d.Engine.autoload_plugins()
    engine = f3d.Engine.create_osmesa()
    engine.options.update({
        "render.background.color": [1.0, 1.0, 1.0], "render.grid.enable": False, "ui.axis": False,
        "render.effect.ambient_occlusion": True, "render.effect.antialiasing.mode": "ssaa",
        "scene.up_direction": "+Z"})
    engine.scene.add(mesh)
    engine.window.size = int(side), int(side)
    camera = engine.window.camera
    camera.position = tuple(float(value) for value in eye.split(","))
    camera.focal_point, camera.view_up, camera.view_angle = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), float(angle)
    start = time.process_time()
    engine.window.render_to_image()
    print(f"\n{time.process_time() - start}")


main()
