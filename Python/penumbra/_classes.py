# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The public classes of Penumbra, from the modules that were built for the VTK in use."""
import importlib
from typing import TYPE_CHECKING

from ._backend import ROOT, vtk_module

# These load the VTK libraries and register the OpenGL render windows and fonts.
for _name in ("vtkFiltersGeometry", "vtkFiltersGeneral", "vtkIOImage", "vtkIOXML", "vtkRenderingAnnotation",
              "vtkRenderingFreeType", "vtkRenderingOpenGL2"):
    vtk_module(_name)

MODULES = ("vtkPenumbraFiltersMedium", "vtkPenumbraFiltersRayTracing", "vtkPenumbraFiltersRayCasting",
           "vtkPenumbraFiltersIrradiance", "vtkPenumbraRenderingScreenSpace", "vtkPenumbraRenderingIrradiance", "vtkPenumbraFiltersComparison")

if TYPE_CHECKING:
    from ._cvista.vtkPenumbraFiltersIrradiance import *
    from ._cvista.vtkPenumbraFiltersMedium import *
    from ._cvista.vtkPenumbraFiltersRayCasting import *
    from ._cvista.vtkPenumbraFiltersRayTracing import *
    from ._cvista.vtkPenumbraRenderingIrradiance import *
    from ._cvista.vtkPenumbraRenderingScreenSpace import *
    from ._cvista.vtkPenumbraFiltersComparison import *
else:
    for _name in MODULES:
        _module = importlib.import_module(f"._{ROOT}.{_name}", __package__)
        globals().update({name: value for name, value in vars(_module).items()
                          if name.startswith("vtkPenumbra")})

vtkPenumbraTracedEstimator.RegisterEstimator()  # noqa: F405
