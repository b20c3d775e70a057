# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Places on surfaces that `penumbra chart` hands to programs of others, and what it wants back.

    python SCRIPT                           prints the program's version, fails where it is not there
    python SCRIPT SCENE SETTING ANSWERS     prints CPU seconds and rays a place

SCENE holds doubles: the numbers of triangles and of places, the sky's radiance, the number of reflections; for
each triangle its corners, reflectance and emission (rgb); for each place its position and normal. ANSWERS takes
floats: irradiance over pi at each place, rgb."""
import sys

import numpy


class Scene:
    def __init__(self, path):
        numbers = numpy.fromfile(path)
        triangles, places, self.sky, self.bounces = numbers[:4]
        rest = numbers[4:4 + 15 * int(triangles)].reshape(-1, 15)
        self.corners, self.reflectance, self.emission = rest[:, :9], rest[:, 9:12], rest[:, 12:]
        self.places = numbers[4 + 15 * int(triangles):].reshape(int(places), 6)


def run(version, ask):
    """`ask(scene, setting, path)` returns light at each place (rgb), CPU seconds and rays a place; `path` begins
    the names of files that it may write."""
    if len(sys.argv) < 4:
        print(version)
        return
    light, seconds, rays = ask(Scene(sys.argv[1]), sys.argv[2], sys.argv[1])
    numpy.ascontiguousarray(light, "f4").tofile(sys.argv[3])
    print(f"\n{seconds} {rays}")
