# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion, light shafts and antialiased ray casting for VTK.

This package contains all public classes of Penumbra under their VTK names. PyVista registers the accessors
``plotter.penumbra`` and ``mesh.penumbra`` automatically, see :mod:`penumbra.plotter` and
:mod:`penumbra.mesh`.
"""
import os as _os
import sys as _sys

if _sys.version_info < (3, 12):
    raise ImportError(
        "penumbra needs CPython 3.12 or newer; this is " + ".".join(map(str, _sys.version_info[:2])))

try:
    # These imports load the VTK libraries and register the OpenGL render windows.
    from cvista import vtkFiltersGeometry, vtkFiltersGeneral, vtkRenderingAnnotation  # noqa: F401
    from cvista import vtkRenderingFreeType, vtkRenderingOpenGL2  # noqa: F401
except ImportError as error:
    raise ImportError(
        "penumbra needs VTK with rendering from the package cvista; install it with "
        "pip install 'cvista[all]'"
    ) from error

if _os.environ.get("PYVISTA_VTK_BACKEND", "cvista") != "cvista":
    raise ImportError(
        "penumbra and PyVista must use the same VTK: unset PYVISTA_VTK_BACKEND, or set it to cvista"
    )

from .vtkPenumbraFiltersRayTracing import *  # noqa: E402,F401,F403
from .vtkPenumbraFiltersRayCasting import *  # noqa: E402,F401,F403
from .vtkPenumbraFiltersIrradiance import *  # noqa: E402,F401,F403
from .vtkPenumbraRenderingScreenSpace import *  # noqa: E402,F401,F403
from .vtkPenumbraRenderingIrradiance import *  # noqa: E402,F401,F403

vtkPenumbraTracedEstimator.RegisterEstimator()  # noqa: F405
