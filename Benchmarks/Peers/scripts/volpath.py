# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The half-plane of the light shaft benchmark by Mitsuba's volpath: error and time.

    pip install mitsuba && python Benchmarks/Peers/scripts/volpath.py 64

The closed form is that of Benchmarks/Reference/ClosedForms/HalfPlaneScattering. A `gain` of 1
shows that both define light and medium in the same way."""
import math
import sys
import time

import mitsuba
import numpy

mitsuba.set_variant("scalar_rgb")
from mitsuba import ScalarTransform4f as Transform

SIDE, SCATTERING, EXTINCTION = 256, 0.3, 0.5
LOW, HIGH = numpy.array([-1.0, -3.0, -3.0]), numpy.array([4.0, 3.0, 2.0])
EYE = numpy.array([-1.3, 0.0, -0.5])


def exact():
    x, y = numpy.meshgrid(numpy.arange(SIDE) + 0.5, numpy.arange(SIDE) + 0.5)
    way = numpy.stack([numpy.ones_like(x), 1 - 2 * x / SIDE, 2 * y / SIDE - 1], -1)
    length = numpy.linalg.norm(way, axis=-1)
    up = way[..., 2]
    far = numpy.min((numpy.where(way > 0, HIGH, LOW) - EYE) / way, -1)
    hit = numpy.where(up > 0, 1.5 / numpy.where(up > 0, up, 1), far)
    near, enters = 1.3, 0.3
    a = EXTINCTION * (HIGH[2] - (EYE[2] + enters * up))
    b = EXTINCTION * (1 - up / length)
    lit = numpy.exp(-b * (near - enters) * length) - numpy.exp(-b * (far - enters) * length)
    value = SCATTERING / (4 * math.pi) * numpy.exp(-a) * lit / b
    value[(hit < near) | (far <= near)] = 0
    return value


def place(center, size):
    return Transform().translate(list(center)).scale(list(size))


black = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.0}}
scene = mitsuba.load_dict({
    "type": "scene",
    "integrator": {"type": "volpath", "max_depth": 2},
    "sensor": {
        "type": "perspective", "fov": 90,
        "to_world": Transform().look_at(origin=list(EYE), target=[0, 0, -0.5], up=[0, 0, 1]),
        "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE, "rfilter": {"type": "box"},
                 "pixel_format": "luminance"},
        "sampler": {"type": "independent", "sample_count": int(sys.argv[1])}},
    "sun": {"type": "directional", "direction": [0, 0, -1], "irradiance": 1.0},
    "half-plane": {"type": "rectangle", "to_world": place([-500, 0, 1], [500, 1000, 1]),
                   "bsdf": black},
    "medium": {"type": "cube", "to_world": place((LOW + HIGH) / 2, (HIGH - LOW) / 2),
               "bsdf": {"type": "null"},
               "interior": {"type": "homogeneous", "sigma_t": EXTINCTION,
                            "albedo": SCATTERING / EXTINCTION, "phase": {"type": "isotropic"}}}})
start = time.process_time()
image = numpy.array(mitsuba.render(scene))[..., 0][::-1]
seconds = time.process_time() - start
truth = exact()
error = math.sqrt(((image - truth) ** 2).sum() / (truth ** 2).sum())
gain = (image * truth).sum() / (truth ** 2).sum()
print(f"relative RMSE {error:.4f}, gain {gain:.4f}, {seconds:.2f} CPU seconds, "
      f"mitsuba {mitsuba.__version__}")
