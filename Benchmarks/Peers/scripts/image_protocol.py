# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Protocol of `penumbra chart` for scripts that render an image with a peer program.

    python SCRIPT                               prints the program's version; fails if it is not installed
    python SCRIPT SCENE.json SETTING IMAGE    renders; prints CPU seconds and samples per pixel

The scene consists of triangles with constant, already shaded colors, so that the images of all programs differ
only in their antialiasing. IMAGE contains floats, RGB, row by row from the bottom."""
import json
import math
import sys


class Scene:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            for name, value in json.load(file).items():
                setattr(self, name, value)
        self.width, self.height = self.size
        self.target = [e + f for e, f in zip(self.eye, self.forward)]
        half = math.tan(math.radians(self.angle) / 2) * self.width / self.height
        self.horizontal_angle = math.degrees(2 * math.atan(half))


def run(version, draw):
    """`draw(scene, setting)` returns bytes of floats, CPU seconds and samples per pixel."""
    if len(sys.argv) < 4:
        print(version)
        return
    image, seconds, samples = draw(Scene(sys.argv[1]), sys.argv[2])
    with open(sys.argv[3], "wb") as file:
        file.write(image)
    print(f"\n{seconds} {samples}")
