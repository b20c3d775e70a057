# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Print digests of images and values, which do not depend on the VTK, the processor or the number of threads."""
import hashlib

import numpy as np
from test_arrays import floor_and_sphere, grid, sphere

import penumbra


def scenes():
    points, faces, _ = floor_and_sphere(20, 24)
    yield "floor", points, faces
    for rings in (6, 13, 24):
        yield f"sphere {rings}", *sphere(rings)
    for waves in (1, 3):
        yield f"waves {waves}", *grid(24, 24, lambda u, v, n=waves: (u, v, 0.1 * np.sin(6 * n * u) * np.cos(5 * n * v)))


def digest(array):
    return hashlib.sha256(np.ascontiguousarray(array)).hexdigest()[:16]


for name, points, faces in scenes():
    for options in ({}, {"ambient_occlusion": True}, {"shadows": True}, {"transparent_background": True},
                    {"indirect_light": True, "environment_color": "white", "tolerance": 1 / 64}):
        print(name, options, digest(penumbra.render((points, faces), window_size=(96, 72), **options)))
    print(name, "ambient occlusion", digest(penumbra.ambient_occlusion(points, faces)))
    print(name, "irradiance", digest(penumbra.irradiance(points, faces, tolerance=0.05)))
    print(name, "direct light", digest(penumbra.direct_light(points, faces, lights=(1, 2, 3, 0), light_angle=10)))
