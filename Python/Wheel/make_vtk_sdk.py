# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Make an SDK for the package ``vtk`` from the SDK of ``cvista`` and an installed ``vtk``.

The package ``vtk`` has libraries but neither headers nor CMake files on Linux. Both packages are built from VTK 9.7;
vtk-headers.patch returns the headers that cvista changed, as far as Penumbra includes them, to VTK 9.7.0. Linker scripts
stand for the libraries of cvista, which combine several modules, and name those of ``vtk``, so that one SDK serves all
versions of CPython. These libraries use the C++ ABI of GCC before 5: compile with _GLIBCXX_USE_CXX11_ABI=0.
"""
import argparse
import importlib.util
import pathlib
import re
import shutil
import sys

PYTHON_CORE = "libvtkWrappingPython.so"
COMMON = "libvtkCommonCore.so"
PREFIXES = {"libvtkOpenGL": "libvtkRendering"}
PATCH = pathlib.Path(__file__).parent / "vtk-headers.patch"


def apply_patch(patch, folder):
    """Apply a unified diff of files in one folder; every line of context must match."""
    lines = patch.read_text().split("\n")
    name, output, source, position = None, [], [], 0

    def finish():
        if name is not None:
            (folder / name).unlink()
            (folder / name).write_text("\n".join(output + source[position:]))

    for line in lines:
        if line.startswith("--- a/"):
            finish()
            name = line[6:]
            source, output, position = (folder / name).read_text().split("\n"), [], 0
        elif line.startswith("@@"):
            start, count = re.match(r"@@ -(\d+)(?:,(\d+))?", line).groups()
            start = int(start) - (0 if count == "0" else 1)
            output += source[position:start]
            position = start
        elif line[:1] in (" ", "-") and not line.startswith("---"):
            if source[position] != line[1:]:
                raise SystemExit(f"{patch}: {name}, line {position + 1} is not {line[1:]!r}")
            output += [line[1:]] if line[0] == " " else []
            position += 1
        elif line.startswith("+") and not line.startswith("+++"):
            output.append(line[1:])
    finish()


def linker_script(library, names):
    """Return the linker script that stands for a library of cvista, such as libvtkCommon-cvista.so."""
    if "WrappingPython" in library:
        return f"INPUT(AS_NEEDED({PYTHON_CORE}))\n"
    # Linking all libraries instead of those of the same prefix takes minutes.
    prefix = library.removesuffix("-cvista.so")
    prefix = PREFIXES.get(prefix, prefix)
    inputs = [name for name in names if name.startswith(prefix)] or [COMMON]
    return f"INPUT(AS_NEEDED({' '.join(inputs)}))\n"


def find_libraries():
    return pathlib.Path(importlib.util.find_spec("vtkmodules").submodule_search_locations[0])


def link_libraries(folder, libraries):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, path in libraries.items():
        (folder / name).symlink_to(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sdk", required=True, type=pathlib.Path, help="the folder cvista_sdk")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="the SDK to make, if it does not exist")
    parser.add_argument("--libraries", required=True, type=pathlib.Path,
                        help="the folder for links to the libraries of the vtk of this CPython, to be given to the linker")
    options = parser.parse_args()
    libraries = find_libraries()
    core = f"libvtkWrappingPythonCore{sys.version_info[0]}.{sys.version_info[1]}.so"
    names = [path.name for path in sorted(libraries.glob("libvtk*.so")) if "Python" not in path.name]
    link_libraries(options.libraries.resolve(), {name: libraries / name for name in names}
                   | {PYTHON_CORE: libraries / core})
    sdk = options.sdk.resolve()
    stamp = f"{sdk}\n{names}\n{PATCH.read_text()}\n{pathlib.Path(__file__).read_text()}"
    if (options.output / "stamp").exists() and (options.output / "stamp").read_text() == stamp:
        return
    output = options.output.resolve().with_suffix(".new")
    shutil.rmtree(output, ignore_errors=True)
    (output / "content").mkdir(parents=True)
    shutil.copytree(sdk / "cmake", output / "cmake")
    for name in ("bin", "cvista"):
        (output / "content" / name).symlink_to(sdk / "content" / name)
    data, = (sdk / "content").glob("vtk-*.data")
    headers, = (data / "headers").glob("vtk-*")
    target = output / "content" / data.name / "headers"
    shutil.copytree(data / "headers", target)
    apply_patch(PATCH, target / headers.name)
    properties = target / "cmake" / "cvista-vtk-python-module-properties.cmake"
    properties.write_text(properties.read_text().replace('"cvista"', '"vtkmodules"'))

    scripts = output / "content" / "build" / next((sdk / "content" / "build").glob("lib*")).name / "cvista"
    scripts.mkdir(parents=True)
    for library in (sdk / "content" / "build").glob("lib*/cvista/libvtk*.so"):
        (scripts / library.name).write_text(linker_script(library.name, names))
    (output / "stamp").write_text(stamp)
    shutil.rmtree(options.output, ignore_errors=True)
    output.rename(options.output.resolve())


main()
