# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Protocol of `penumbra chart` for scripts that compute the light at surface points with a peer program.

    python SCRIPT                           prints the program's version; fails if it is not installed
    python SCRIPT SCENE SETTING RESULTS     prints CPU seconds and rays per point

SCENE contains doubles: the numbers of triangles and of points, the sky's radiance, the number of bounces; for each
triangle its corners, reflectance and emission (RGB); for each point its position and normal. RESULTS receives
floats: irradiance over pi at each point, RGB."""
import sys

import numpy


class Scene:
    def __init__(self, path):
        numbers = numpy.fromfile(path)
        triangles, points, self.sky, self.bounces = numbers[:4]
        rest = numbers[4:4 + 15 * int(triangles)].reshape(-1, 15)
        self.corners, self.reflectance, self.emission = rest[:, :9], rest[:, 9:12], rest[:, 12:]
        self.points = numbers[4 + 15 * int(triangles):].reshape(int(points), 6)


def run(version, ask):
    """`ask(scene, setting, path)` returns the light at each point (RGB), CPU seconds and rays per point. `path` is the
    prefix of the files that it may write."""
    if len(sys.argv) < 4:
        print(version)
        return
    light, seconds, rays = ask(Scene(sys.argv[1]), sys.argv[2], sys.argv[1])
    numpy.ascontiguousarray(light, "f4").tofile(sys.argv[3])
    print(f"\n{seconds} {rays}")
