# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Choice of the VTK that Penumbra uses: the package ``cvista`` or the package ``vtk``.

The wheel has libraries for both; those for ``vtk`` serve the versions of CPython that it was built for. The choice is that of
PyVista: PYVISTA_VTK_BACKEND if it is set, else ``cvista`` if it is installed, else ``vtk``. Without PyVista, a ``vtk`` that
is imported already is used.
"""
from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import os
import pathlib
import re
import sys
from types import ModuleType

from ._layout import differences, read_layout

CVISTA = "9.7.0.5"
VTK = ((9, 7), (9, 8))
HERE = pathlib.Path(__file__).parent


def _pythons() -> list[str]:
    """Return the versions of CPython for which this installation has modules for ``vtk``."""
    found = {match.groups() for path in (HERE / "_vtkmodules").glob("vtkPenumbraFiltersRayCasting.cpython-*")
             if (match := re.search(r"cpython-(\d)(\d+)-", path.name))}
    return [".".join(version) for version in sorted(found, key=lambda version: int(version[1]))]


def _versions() -> str:
    """Return the versions of VTK that work, as a part of a sentence."""
    cvista = f"cvista {CVISTA} ('pip install cvista[all]=={CVISTA}')"
    pythons = _pythons()
    if not pythons:
        return cvista
    return f"vtk 9.7 with CPython {' or '.join(pythons)} ('pip install \"vtk>=9.7,<9.8\"'), or {cvista}"


def _choose() -> str:
    backend = os.environ.get("PYVISTA_VTK_BACKEND")
    if backend:
        return "vtkmodules" if backend == "vtk" else backend
    loaded = [name for name in ("cvista", "vtkmodules") if f"{name}.vtkCommonCore" in sys.modules]
    if len(loaded) == 1 and "pyvista" not in sys.modules:
        return loaded[0]
    return "cvista" if importlib.util.find_spec("cvista") else "vtkmodules"


def _installed(root: str) -> str | None:
    """Return the version of the package that contains ``root``, or None if there is none."""
    try:
        return importlib.metadata.version("vtk" if root == "vtkmodules" else root)
    except importlib.metadata.PackageNotFoundError:
        pass
    if importlib.util.find_spec(root) is None:
        return None
    # VTK of a system or of ParaView has no metadata.
    return str(importlib.import_module(f"{root}.vtkCommonCore").vtkVersion.GetVTKVersion())


def _check(root: str) -> None:
    if root not in ("cvista", "vtkmodules"):
        raise ImportError(f"PYVISTA_VTK_BACKEND is {root!r}, a VTK that penumbra was not built for. "
                          f"These work: {_versions()}.")
    version = _installed(root)
    if version is None:
        raise ImportError(f"penumbra needs VTK, which is not installed. These versions work: {_versions()}.")
    python = f"{sys.version_info[0]}.{sys.version_info[1]}"
    if root == "cvista":
        works = version == CVISTA
    else:
        numbers = tuple(int(number) for number in re.findall(r"\d+", version)[:2])
        works = VTK[0] <= numbers < VTK[1] and python in _pythons()
    if not works:
        raise ImportError(
            f"penumbra does not work with {'vtk' if root == 'vtkmodules' else root} {version} and CPython {python}, "
            f"which are installed here. These work: {_versions()}.")
    _check_classes(root, version)


def _check_classes(root: str, version: str) -> None:
    """Raise ImportError if a class of the installed VTK is laid out otherwise than when the modules were compiled."""
    layout = read_layout(HERE / f"_{root}")
    spec = importlib.util.find_spec(root)
    if layout is None or spec is None:
        return
    folder = pathlib.Path((spec.submodule_search_locations or ["."])[0])
    found = list(differences(folder, layout))
    if found:
        package = "vtk" if root == "vtkmodules" else root
        more = f", and {len(found) - 1} more differences" if len(found) > 1 else ""
        raise ImportError(
            f"penumbra was built for the classes of {package} {layout['version']}; those of {package} {version}, which is "
            f"installed here, differ: {found[0]}{more}. Install a newer penumbra, or pip install "
            f"'{package}=={layout['version']}'.")


if sys.version_info < (3, 12):
    raise ImportError(
        "penumbra needs CPython 3.12 or newer; this is " + ".".join(map(str, sys.version_info[:2])))

#: ``cvista`` or ``vtkmodules``
ROOT = _choose()
_check(ROOT)


def vtk_module(name: str) -> ModuleType:
    """Import a module of the VTK in use, such as ``vtkCommonCore``."""
    try:
        return importlib.import_module(f"{ROOT}.{name}")
    except ImportError as error:
        if ROOT == "cvista":
            raise ImportError(f"{error}. penumbra needs all parts of cvista: "
                              f"pip install 'cvista[all]=={CVISTA}'") from error
        raise
