# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Check for OpenGL, because VTK does not report that it is missing and crashes in the first render."""
from __future__ import annotations

import ctypes
from typing import Any

# Libraries that VTK loads if neither an X server nor EGL is available.
OSMESA_LIBRARIES = ("libOSMesa.so", "libOSMesa.so.6")


def _is_available(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def require_opengl(window: Any) -> None:
    """Raise RuntimeError if VTK fell back to an OSMesa window and OSMesa is not installed."""
    if window is not None and window.GetClassName() == "vtkOSOpenGLRenderWindow" and not any(
            map(_is_available, OSMESA_LIBRARIES)):
        raise RuntimeError(
            "OpenGL is not available: install libegl1 or libosmesa6, start an X server, or use "
            "plotter.penumbra.ray_cast(), which does not need OpenGL")
