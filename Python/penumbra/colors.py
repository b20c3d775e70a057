# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of colors and radiances."""
import math

import pyvista


def parse_radiance(color):
    """Return three floats from a PyVista color name or from three numbers >= 0, which may exceed 1."""
    if isinstance(color, str):
        return pyvista.Color(color).float_rgb
    values = [float(value) for value in color]
    if len(values) != 3 or not all(0.0 <= value < math.inf for value in values):
        raise ValueError(f"environment_color must be a color name or three numbers >= 0, not {color!r}")
    return values
