# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion, irradiance, direct light and antialiased ray casting for arrays and VTK scenes, to a chosen error.

``ambient_occlusion``, ``irradiance``, ``direct_light``, ``render`` and ``compare`` take and return NumPy arrays. PyVista
registers ``plotter.penumbra`` and ``mesh.penumbra``, see :mod:`penumbra.plotter` and :mod:`penumbra.mesh`. All classes are
available under their VTK names, such as ``penumbra.vtkPenumbraRayCaster``. VTK is loaded at the first use.
"""
import importlib as _importlib
from typing import TYPE_CHECKING, Any

from . import _backend  # raises ImportError if VTK cannot be used
from ._version import __version__

if TYPE_CHECKING:
    from ._classes import *
    from .baking import ambient_occlusion, direct_light, irradiance
    from .comparison import Comparison, Tile, compare
    from .messages import PenumbraWarning, messages_as_warnings
    from .rendering import render

_NAMES = {
    "ambient_occlusion": "baking",
    "direct_light": "baking",
    "irradiance": "baking",
    "render": "rendering",
    "compare": "comparison",
    "Comparison": "comparison",
    "Tile": "comparison",
    "PenumbraWarning": "messages",
    "messages_as_warnings": "messages",
}

__all__ = ["Comparison", "PenumbraWarning", "Tile", "__version__", "ambient_occlusion", "compare", "direct_light",
           "irradiance", "messages_as_warnings", "render"]


def __getattr__(name: str) -> Any:
    if name in _NAMES or name.startswith("vtkPenumbra"):
        module = _importlib.import_module(f".{_NAMES.get(name, '_classes')}", __name__)
        if hasattr(module, name):
            globals()[name] = getattr(module, name)
            return globals()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    classes = _importlib.import_module("._classes", __name__)
    return sorted({*globals(), *_NAMES, *(name for name in vars(classes) if name.startswith("vtkPenumbra"))})
