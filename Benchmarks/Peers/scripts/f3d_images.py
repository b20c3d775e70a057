# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""F3D for `penumbra chart`: OpenGL with F3D's antialiasing. SETTING: none, fxaa or ssaa."""
import array
import os
import tempfile
import time

import f3d

import image_protocol


def write_faces(scene, path):
    """Writes a legacy VTK file with a color per triangle."""
    with open(path, "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\nfaces\nASCII\nDATASET POLYDATA\n"
                   f"POINTS {len(scene.positions)} float\n")
        file.writelines(f"{x} {y} {z}\n" for x, y, z in scene.positions)
        file.write(f"POLYGONS {len(scene.triangles)} {4 * len(scene.triangles)}\n")
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in scene.triangles)
        file.write(f"CELL_DATA {len(scene.colors)}\nCOLOR_SCALARS colors 3\n")
        file.writelines(f"{r} {g} {b}\n" for r, g, b in scene.colors)


def draw(scene, setting):
    f3d.Engine.autoload_plugins()
    engine = f3d.Engine.create_osmesa()
    engine.options.update({
        "model.coloring": "direct", "model.scivis.field": "cells",
        "model.scivis.array_name": "colors", "model.unlit": True, "ui.scalar_bar": False,
        "render.background.color": [0.0, 0.0, 0.0], "render.grid.enable": False, "ui.axis": False,
        "render.effect.antialiasing.mode": setting})
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "faces.vtk")
        write_faces(scene, path)
        engine.scene.add(path)
    engine.window.size = scene.width, scene.height
    camera = engine.window.camera
    camera.position, camera.focal_point, camera.view_up = scene.eye, scene.target, scene.up
    camera.view_angle = scene.angle
    engine.window.render_to_image()
    start = time.process_time()
    image = engine.window.render_to_image()
    seconds = time.process_time() - start
    return (array.array("f", [value / 255 for value in image.content]).tobytes(), seconds,
            5 if setting == "ssaa" else 1)


image_protocol.run(f3d.__version__, draw)
