# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pack the wheel from the Python sources and build trees with wrapped modules and libraries.

Files are deflated, as the package index requires. ``auditwheel`` adds the libraries that neither the platform nor VTK
provides, and determines the platform tag.
"""
import argparse
import base64
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

from make_layout import make_layout

ROOT = pathlib.Path(__file__).parents[2]
SOURCES = ROOT / "Python" / "penumbra"
LICENSES = ROOT / "Python" / "Licenses"
NAME = "vtk-penumbra"  # the name penumbra belongs to another project of the package index
PACKAGE = "penumbra"
FOLDER = NAME.replace("-", "_")
PROGRAM = "penumbra"  # one for each VTK, which penumbra_program.py starts
CVISTA = "9.7.0.5"

ENTRY_POINTS = f"""[console_scripts]
{PROGRAM} = penumbra_program:main

[pyvista.accessors]
{PACKAGE} = {PACKAGE}.mesh

[pyvista.plotter_components]
{PACKAGE} = {PACKAGE}.plotter

[pyvista_render_passes.providers]
{PACKAGE} = {PACKAGE}.provider:OcclusionProvider

[pytest11]
{PACKAGE} = pytest_penumbra
"""


def requires_vtk(pythons):
    """Return the requirement of a VTK for the extra pyvista: vtk where the wheel has libraries for it, else cvista."""
    if not pythons:
        return f'Requires-Dist: cvista[all]=={CVISTA}; extra == "pyvista"'
    works = " or ".join(f'python_version == "{python}"' for python in pythons)
    others = " and ".join(f'python_version != "{python}"' for python in pythons)
    return (f'Requires-Dist: vtk>=9.7,<9.8; extra == "pyvista" and ({works})\n'
            f'Requires-Dist: cvista[all]=={CVISTA}; extra == "pyvista" and {others}')


def metadata(version, licenses, pythons):
    return f"""Metadata-Version: 2.4
Name: {NAME}
Version: {version}
Summary: Ambient occlusion, irradiance and antialiased ray casting for VTK and PyVista, to a chosen error.
License-Expression: BSD-3-Clause AND Apache-2.0 AND MIT
{"".join(f"License-File: {name}{chr(10)}" for name in licenses)}Keywords: vtk,pyvista,ambient occlusion,ray casting
Classifier: Development Status :: 4 - Beta
Classifier: Intended Audience :: Science/Research
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: C++
Classifier: Programming Language :: Python :: 3 :: Only
Classifier: Programming Language :: Python :: 3.12
Classifier: Programming Language :: Python :: 3.13
Classifier: Topic :: Scientific/Engineering :: Visualization
Classifier: Framework :: Pytest
Classifier: Typing :: Typed
Requires-Python: >=3.12
Requires-Dist: numpy>=1.26
Provides-Extra: cvista
Requires-Dist: cvista[all]=={CVISTA}; extra == "cvista"
Provides-Extra: pyvista
Requires-Dist: pyvista>=0.49; extra == "pyvista"
{requires_vtk(pythons)}
Provides-Extra: pytest
Requires-Dist: pytest>=8; extra == "pytest"
Description-Content-Type: text/markdown

{(ROOT / "Python" / "README.md").read_text()}"""


def soname(library):
    listed = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
    return re.search(r"SONAME.*\[(.*)\]", listed)[1]


def stripped(path, folder):
    """Return the content of a library without symbols that nothing links to."""
    copy = folder / path.name
    shutil.copy(path, copy)
    subprocess.run(["strip", "--strip-unneeded", copy], check=True)
    return copy.read_bytes()


def libraries_of(tree):
    """Return the libraries of a build tree, by SONAME."""
    found = sorted(tree.glob("lib*/libvtkPenumbra*.so"))
    return {soname(path): path.resolve() for path in found if "Parallel" not in path.name}


def modules_of(tree):
    return sorted(tree.glob(f"lib*/python/{PACKAGE}/_*/*.so"))


def generate_stubs(modules, libraries, site):
    """Return the type stubs of the modules for cvista, which type checkers read for any VTK."""
    package = modules[0].parent.name
    with tempfile.TemporaryDirectory() as folder:
        target = pathlib.Path(folder, PACKAGE, package)
        target.mkdir(parents=True)
        (target.parent / "__init__.py").write_text("")
        (target / "__init__.py").write_text("")
        for module in modules:
            shutil.copy(module, target)
        for name, library in libraries.items():
            shutil.copy(library, target / name)
        names = [module.name.split(".")[0] for module in modules]
        run = subprocess.run(
            [sys.executable, "-m", "cvista.generate_pyi", "-p", f"{PACKAGE}.{package}", "-o", str(target), *names],
            env=os.environ | {"PYTHONPATH": folder, "LD_LIBRARY_PATH": str(site / "cvista")},
            capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"The type stubs cannot be generated: {run.stderr}")
        # The stubs of the package vtk are those that most users have.
        stubs = {stub.name: re.sub(r"\bcvista\b(?=\.vtk)", "vtkmodules", stub.read_text())
                 for stub in target.glob("*.pyi")}
    return complete_stubs(stubs, site)


def layout_of(tree, site):
    """Return the layout of the classes of VTK that the modules of a build tree use, and check the libraries of VTK."""
    links = tree / "vtk"  # of the package vtk, by make_vtk_sdk.py
    folder = next(links.iterdir()).resolve().parent if links.exists() else site / "cvista"
    package = "vtk" if links.exists() else "cvista"
    info, = folder.parent.glob(f"{package}-*.dist-info")
    return make_layout(tree, folder, info.name.removeprefix(f"{package}-").removesuffix(".dist-info"))


CLASS = re.compile(r"^class (vtk\w+)", re.MULTILINE)


def complete_stubs(stubs, site):
    """Return type stubs that import the classes that they name, and that export their own only."""
    modules = {name: f"vtkmodules.{path.stem}" for path in sorted((site / "vtkmodules").glob("vtk*.pyi"))
               for name in CLASS.findall(path.read_text())}
    modules |= {name: f".{stub.removesuffix('.pyi')}" for stub, text in stubs.items() for name in CLASS.findall(text)}
    completed = {}
    for stub, text in stubs.items():
        own = CLASS.findall(text)
        used = sorted(set(re.findall(r"'(vtk\w+)'", text)) - set(own))
        missing = [name for name in used if name not in modules]
        if missing:
            sys.exit(f"{stub}: the module of {', '.join(missing)} is not known")
        imports = "".join(f"from {modules[name]} import {name}\n" for name in used)
        completed[stub] = f"{imports}\n__all__ = {own}\n\n{text}"
    return completed


def collect(options, scratch):
    """Return the contents of the wheel by path, without its metadata."""
    files = {f"{PACKAGE}/{path.name}": path.read_bytes() for path in sorted(SOURCES.iterdir())
             if path.suffix in (".py", ".typed")}
    files |= {name: (SOURCES.parent / name).read_bytes() for name in ("penumbra_program.py", "pytest_penumbra.py")}
    files[f"{PACKAGE}/_version.py"] = f'__version__ = "{options.version}"\n'.encode()
    site = pathlib.Path(sysconfig.get_path("purelib"))
    for tree in options.trees:
        modules = modules_of(tree)
        if not modules:
            sys.exit(f"{tree} has no Python modules: build the target penumbra_python_modules_built")
        folder = f"{PACKAGE}/{modules[0].parent.name}"
        libraries = libraries_of(tree)
        files[f"{folder}/__init__.py"] = b""
        files[f"{folder}/layout.json"] = json.dumps(layout_of(tree, site)).encode()
        files |= {f"{folder}/{name}": stripped(path, scratch) for name, path in libraries.items()
                  if f"{folder}/{name}" not in files}
        files |= {f"{folder}/{module.name}": stripped(module, scratch) for module in modules}
        if f"{folder}/{PROGRAM}" not in files:
            files[f"{folder}/{PROGRAM}"] = stripped(tree / "bin" / PROGRAM, scratch)
        if folder.endswith("_cvista"):
            stubs = generate_stubs(modules, libraries, site)
            files |= {f"{folder}/{name}": text.encode() for name, text in stubs.items()}
    return files


def write_wheel(path, files, version, tag):
    info = f"{FOLDER}-{version}.dist-info"
    licenses = {"LICENSE": ROOT / "LICENSE"} | {path.name: path for path in sorted(LICENSES.iterdir())}
    files = files | {f"{info}/licenses/{name}": source.read_bytes() for name, source in licenses.items()}
    pythons = sorted({f"{match[1]}.{match[2]}" for name in files
                      if (match := re.search(r"/_vtkmodules/.*\.cpython-(\d)(\d+)-", name))})
    files[f"{info}/METADATA"] = metadata(version, licenses, pythons).encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\nTag: {tag}\n").encode()
    files[f"{info}/entry_points.txt"] = ENTRY_POINTS.encode()
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},"
        f"{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if ".so" in name or name.endswith(f"/{PROGRAM}") else 0o644) << 16
            archive.writestr(entry, content)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--version", required=True)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("trees", nargs="+", type=pathlib.Path, help="build trees, cvista's first")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    for old in options.output.glob("*.whl"):
        old.unlink()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        tag = f"cp312-abi3-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        wheel = scratch / f"{FOLDER}-{options.version}-{tag}.whl"
        write_wheel(wheel, collect(options, scratch), options.version, tag)
        # VTK comes from another package. All other libraries must be in the wheel or in the platform's policy.
        subprocess.run(
            [sys.executable, "-m", "auditwheel", "repair", "--exclude", "libvtk*-cvista.so",
             "--exclude", "libvtk[!P]*.so", "--wheel-dir", options.output, wheel], check=True,
            env=os.environ | {"PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"})
    made, = options.output.glob("*.whl")
    print(f"{made}: {made.stat().st_size / 1e6:.1f} MB")


main()
