# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Build a wheel (PEP 427) from the Python sources, the wrapped modules and the libraries."""
import argparse
import base64
import hashlib
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).parent
NAME = "penumbra"


def metadata(version):
    return f"""Metadata-Version: 2.1
Name: {NAME}
Version: {version}
Summary: Ambient occlusion, light shafts and antialiased ray casting for VTK, to a chosen error.
License: BSD-3-Clause
Requires-Python: >=3.12
Requires-Dist: cvista[all]==9.7.0.5
Requires-Dist: numpy
Provides-Extra: pyvista
Requires-Dist: pyvista>=0.49; extra == "pyvista"
Description-Content-Type: text/markdown

{(HERE / "README.md").read_text()}"""


ENTRY_POINTS = f"""[pyvista.accessors]
{NAME} = {NAME}.mesh

[pyvista.plotter_components]
{NAME} = {NAME}.plotter

[pyvista_render_passes.providers]
{NAME} = {NAME}.provider:OcclusionProvider
"""


def find_dependencies(library):
    """Return the TBB libraries that a library depends on, with their paths."""
    listed = subprocess.run(["ldd", library], capture_output=True, text=True, check=True).stdout
    pairs = (line.split(" => ") for line in listed.splitlines() if " => " in line)
    return {name.strip(): path.split()[0] for name, path in pairs if "libtbb" in name}


def find_cvista():
    found = importlib.util.find_spec("cvista")
    return next(iter(found.submodule_search_locations)) if found else ""


def generate_stubs(modules, libraries):
    """Return the type stubs of the wrapped modules; empty if cvista is not installed."""
    with tempfile.TemporaryDirectory() as folder:
        package = pathlib.Path(folder, NAME)
        package.mkdir()
        (package / "__init__.py").write_text("")
        for file in modules + libraries:
            shutil.copy(file, package)
        names = [module.name.split(".")[0] for module in modules]
        run = subprocess.run(
            [sys.executable, "-m", "cvista.generate_pyi", "-p", NAME, "-o", str(package), *names],
            env=os.environ | {"PYTHONPATH": folder, "LD_LIBRARY_PATH": find_cvista()},
            capture_output=True, text=True)
        if run.returncode:
            print("The wheel has no type stubs:", run.stderr.strip().splitlines()[-1], file=sys.stderr)
        return {f"{NAME}/{stub.name}": stub.read_bytes() for stub in package.glob("*.pyi")}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--version", required=True)
    parser.add_argument("--modules", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("libraries", nargs="+", type=pathlib.Path)
    options = parser.parse_args()

    modules = sorted(options.modules.glob("*.so"))
    files = {f"{NAME}/{path.name}": path.read_bytes() for path in sorted((HERE / NAME).iterdir())
             if path.suffix in (".py", ".typed", ".pyi")}
    files |= {f"{NAME}/{path.name}": path.read_bytes() for path in modules + options.libraries}
    for library in options.libraries:
        files |= {f"{NAME}/{name}": pathlib.Path(path).read_bytes()
                  for name, path in find_dependencies(library).items()}
    files |= generate_stubs(modules, options.libraries)

    tag = f"cp312-abi3-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    folder = f"{NAME}-{options.version}.dist-info"
    files[f"{folder}/METADATA"] = metadata(options.version).encode()
    files[f"{folder}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\nTag: {tag}\n").encode()
    files[f"{folder}/entry_points.txt"] = ENTRY_POINTS.encode()
    files[f"{folder}/LICENSE"] = (HERE.parent / "LICENSE").read_bytes()
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},"
        f"{len(content)}\n" for name, content in files.items())
    files[f"{folder}/RECORD"] = f"{record}{folder}/RECORD,,\n".encode()

    options.output.mkdir(parents=True, exist_ok=True)
    for old in options.output.glob("*.whl"):
        old.unlink()
    wheel = options.output / f"{NAME}-{options.version}-{tag}.whl"
    # LZMA instead of deflate: Embree, the largest file, takes 9 MB instead of 16 MB, and pip supports both.
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_LZMA) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB")


main()
