# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Can a window draw? VTK does not tell: without OpenGL it crashes at the first picture."""
import ctypes

# What VTK looks for when neither an X server nor EGL is there.
LAST_RESORT = ("libOSMesa.so", "libOSMesa.so.6")


def _is_there(library):
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def require(window):
    """Raise where VTK took its last resort, a window of OSMesa, and that is missing, too."""
    if window is not None and window.GetClassName() == "vtkOSOpenGLRenderWindow" and not any(
            map(_is_there, LAST_RESORT)):
        raise RuntimeError(
            "there is no OpenGL here: install libegl1 or libosmesa6, start an X server, or use "
            "plotter.penumbra.ray_cast(), which needs none")
