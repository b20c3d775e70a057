# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Record the layout of the classes of VTK that the modules use, for the check when the package is imported.

GCC prints the tables of virtual functions and the sizes of all classes of the headers that the sources include. The
libraries that the wheel was linked with must have the same, so that a wheel is never built with headers of another VTK.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).parents[2]
FOLDERS = ("Command", "Filters", "Rendering")
EXCLUDED = {"Testing", "ParaView", "Parallel"}
sys.path.insert(0, str(ROOT / "Python" / "penumbra"))
from _layout import Library, differences  # noqa: E402

# Abstract classes have no objects: those of a derived class contain theirs.
DERIVED = ("vtkGenericOpenGLRenderWindow", "vtkImageCast", "vtkSSAOPass", "vtkTransformPolyDataFilter")

# Bytes of further tables that work. VTK 9.7.1 inserted a function behind those that AnnotationCopies.cxx calls, and one
# into the locators, of which SurfaceSlopes.cxx calls no function by the table but those of vtkLocator.
MORE_TABLES = {"vtkAxisActor2D": [1664], "vtkAbstractCellLocator": [8 * 82], "vtkStaticCellLocator": [8 * 90]}


def included_headers(headers):
    """Return the headers of VTK that the sources include, of those in a folder."""
    found = set()
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".h", ".cxx") and not EXCLUDED.intersection(path.parts):
                found.update(re.findall(r'#include "(vtk\w+)\.h"', path.read_text()))
    return sorted(name for name in found.union(DERIVED) if (headers / f"{name}.h").exists())


def flags_of(tree):
    """Return the compiler and the options that matter for layouts, of a source that uses all modules of VTK."""
    commands = json.loads((tree / "compile_commands.json").read_text())
    command = next(row["command"] for row in commands if row["file"].endswith("/vtkPenumbraTracedEstimator.cxx"))
    words = shlex.split(command)
    compiler = next(word for word in words if word.endswith(("g++", "c++")))
    kept = [word for word in words if word.startswith(("-I", "-D", "-std"))]
    kept += [f"-I{folder}" for option, folder in zip(words, words[1:]) if option == "-isystem"]
    return compiler, kept


def compiled_layout(tree):
    """Return the bytes of the table of virtual functions and of an object, for each class of the included headers."""
    compiler, flags = flags_of(tree)
    headers = next(pathlib.Path(flag[2:]) for flag in flags
                   if flag.startswith("-I") and (pathlib.Path(flag[2:]) / "vtkObject.h").exists())
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "layout.cxx")
        source.write_text("".join(f'#include "{name}.h"\n' for name in included_headers(headers)))
        dump = pathlib.Path(folder, "layout.txt")
        subprocess.run([compiler, *flags, "-fsyntax-only", f"-fdump-lang-class={dump}", str(source)], check=True,
                       cwd=tree)
        text = dump.read_text()
    tables = {name: 8 * int(count) for name, count in re.findall(r"(?m)^(vtk\w+)::_ZTV\d+\1: (\d+) entries", text)}
    sizes = {name: int(size) for name, size in re.findall(r"(?m)^Class (vtk\w+)\n   size=(\d+) ", text)}
    return {name: (table, sizes[name]) for name, table in tables.items()}


def make_layout(tree, libraries, version):
    """Return the layout that the modules of a build tree were compiled for, of classes in the libraries of a folder."""
    compiled = compiled_layout(tree)
    content = {}
    for path in sorted(libraries.glob("libvtk*.so")):
        library = Library(path)
        classes = {}
        for name, (table, size) in compiled.items():
            if library.table_size(name) is not None:
                known = [table, *MORE_TABLES.get(name, [])]
                classes[name] = (known, size if library.allocates(name, size) else None)
        if classes:
            content[path.name] = classes
    layout = {"version": version, "libraries": content}
    wrong = list(differences(libraries, layout))
    checked = sum(size is not None for classes in content.values() for _, size in classes.values())
    if wrong or checked < 100:
        sys.exit(f"The modules in {tree} were compiled with headers of another VTK than {version} in {libraries}:\n"
                 + "\n".join(wrong or [f"the sizes of only {checked} classes are in the libraries"]))
    return layout
