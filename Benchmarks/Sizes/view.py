# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The image that all programs of `./penumbra benchmark sizes` render: size, camera and radius of the occlusion."""
import math

SIZE = WIDTH, HEIGHT = 1000, 600
HALF_SIDE = 1.0  # the mesh lies in the cube [-HALF_SIDE, HALF_SIDE]^3
EYE, TARGET, UP = (2.6, 2.2, 5.4), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)
ANGLE = 26.0  # vertical, degrees
RADIUS = 0.1 * math.sqrt(12.0) * HALF_SIDE  # a tenth of the diagonal, as F3D and Penumbra have by default


def get_axes():
    """Return the right, up and back vectors of the camera, of length 1."""
    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    def normalize(a):
        return tuple(x / math.hypot(*a) for x in a)

    back = normalize(tuple(e - t for e, t in zip(EYE, TARGET)))
    right = normalize(cross(UP, back))
    return right, cross(back, right), back
