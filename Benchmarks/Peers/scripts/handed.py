# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""What `penumbra chart` hands to programs of others, and what it wants back.

    python SCRIPT                               prints the program's version, fails where it is not there
    python SCRIPT SCENE.json SETTING PICTURE    draws; prints CPU seconds and samples a pixel

The scene is triangles of even colours, their light already in them: every program makes the same picture, and
only what happens at borders differs. PICTURE holds floats, rgb, row after row from below."""
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
    """`draw(scene, setting)` returns bytes of floats, CPU seconds and samples a pixel."""
    if len(sys.argv) < 4:
        print(version)
        return
    picture, seconds, samples = draw(Scene(sys.argv[1]), sys.argv[2])
    with open(sys.argv[3], "wb") as file:
        file.write(picture)
    print(f"\n{seconds} {samples}")
