# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""How much of it is visible? Ambient occlusion, light shafts and flawless antialiasing for VTK.

All public classes of Penumbra are here under their VTK names. PyVista finds ``plotter.penumbra`` and
``mesh.penumbra`` by itself, see :mod:`penumbra.plotter` and :mod:`penumbra.mesh`.
"""
import os as _os
import sys as _sys

if _sys.version_info < (3, 12):
    raise ImportError(
        "penumbra needs CPython 3.12 or newer; this is " + ".".join(map(str, _sys.version_info[:2])))

try:
    # Windows of this VTK draw, and its libraries are loaded, only once these are imported.
    from cvista import vtkFiltersGeometry, vtkFiltersGeneral, vtkRenderingAnnotation  # noqa: F401
    from cvista import vtkRenderingFreeType, vtkRenderingOpenGL2  # noqa: F401
except ImportError as error:
    raise ImportError(
        "penumbra needs VTK with rendering as the package cvista; install it by "
        "pip install 'cvista[all]'"
    ) from error

if _os.environ.get("PYVISTA_VTK_BACKEND", "cvista") != "cvista":
    raise ImportError(
        "penumbra and PyVista have to use the same VTK: leave PYVISTA_VTK_BACKEND unset, or set it "
        "to cvista"
    )

from .vtkPenumbraFiltersRayTracing import *  # noqa: E402,F401,F403
from .vtkPenumbraFiltersRayCasting import *  # noqa: E402,F401,F403
from .vtkPenumbraFiltersIrradiance import *  # noqa: E402,F401,F403
from .vtkPenumbraRenderingScreenSpace import *  # noqa: E402,F401,F403
from .vtkPenumbraRenderingIrradiance import *  # noqa: E402,F401,F403

vtkPenumbraTracedEstimator.RegisterEstimator()  # noqa: F405
