# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Colours as PyVista takes them, and radiances, which have no upper end."""
import math

import pyvista


def radiance(color):
    """Three floats of a colour by any of PyVista's names, or of numbers from 0 up."""
    if isinstance(color, str):
        return pyvista.Color(color).float_rgb
    values = [float(value) for value in color]
    if len(values) != 3 or not all(0.0 <= value < math.inf for value in values):
        raise ValueError(f"environment_color is a colour or three numbers from 0 up, not {color!r}")
    return values
