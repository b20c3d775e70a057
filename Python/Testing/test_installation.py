# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the choice of VTK, of the time of the import, and of the metadata of the installed wheel."""
import importlib.metadata
import importlib.util
import os
import pathlib
import struct
import subprocess
import sys

import pytest

import penumbra
from penumbra import _backend, _layout


def run(code, **environment):
    variables = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env=variables | environment)


def fake_vtk(folder, version, package="vtk"):
    """Install a package without content."""
    root = "vtkmodules" if package == "vtk" else package
    (folder / root).mkdir()
    (folder / root / "__init__.py").write_text("")
    info = folder / f"{package}-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: {version}\n")


@pytest.mark.parametrize(("package", "version"), [("vtk", "9.6.2"), ("vtk", "9.8.0"), ("cvista", "9.7.0.4")])
def test_unsupported_vtk_is_named_with_those_that_work(tmp_path, package, version):
    fake_vtk(tmp_path, version, package)
    result = run("import penumbra", PYTHONPATH=str(tmp_path), PYVISTA_VTK_BACKEND=package)
    assert result.returncode == 1
    message = result.stderr.strip().splitlines()[-1]
    assert message.startswith(f"ImportError: penumbra does not work with {package} {version} and CPython")
    assert "cvista 9.7.0.5 ('pip install" in message


def installed_copy(folder, name):
    """Return the copy of a library of the VTK in use, in a package of links that claims to be another version."""
    root = _backend.ROOT
    package = "vtk" if root == "vtkmodules" else root
    version = "9.7.9" if package == "vtk" else _backend.CVISTA
    fake_vtk(folder, version, package)
    libraries = pathlib.Path(importlib.util.find_spec(root).submodule_search_locations[0])
    for path in libraries.glob("libvtk*.so"):
        (folder / root / path.name).symlink_to(path)
    (folder / root / name).unlink()
    (folder / root / name).write_bytes((libraries / name).read_bytes())
    return folder / root / name


def library_with(name):
    layout = _layout.read_layout(_backend.HERE / f"_{_backend.ROOT}")
    return next((library, classes[name]) for library, classes in layout["libraries"].items() if name in classes)


def refusal(folder):
    package = "vtk" if _backend.ROOT == "vtkmodules" else _backend.ROOT
    result = run("import penumbra", PYTHONPATH=str(folder), PYVISTA_VTK_BACKEND=package)
    return result.stderr.strip().splitlines()[-1] if result.returncode else "imported"


def test_vtk_with_the_same_classes_is_accepted(tmp_path):
    library, _ = library_with("vtkActor2D")
    installed_copy(tmp_path, library)
    assert refusal(tmp_path) == "imported"


def test_vtk_with_another_virtual_function_is_refused(tmp_path):
    library, (tables, _) = library_with("vtkActor2D")
    path = installed_copy(tmp_path, library)
    data = path.read_bytes()
    address, size = _layout.Library(path).find("_ZTV10vtkActor2D")
    assert size == tables[0]
    symbol = struct.pack("<QQ", address, size)
    assert data.count(symbol) >= 1
    path.write_bytes(data.replace(symbol, struct.pack("<QQ", address, size + 8)))
    message = refusal(tmp_path)
    count = tables[0] // 8 - 2
    assert message.startswith("ImportError: penumbra was built for the classes of ")
    assert f"vtkActor2D has {count + 1} virtual functions instead of {count}" in message
    layout = _layout.read_layout(_backend.HERE / f"_{_backend.ROOT}")
    installed = "vtk 9.7.9" if _backend.ROOT == "vtkmodules" else f"cvista {_backend.CVISTA}"
    assert layout["version"] in message and installed in message


def test_vtk_with_larger_objects_is_refused(tmp_path):
    library, (_, size) = library_with("vtkActor2D")
    path = installed_copy(tmp_path, library)
    data = path.read_bytes()
    found = _layout.Library(path)
    address, length = found.find("_ZN10vtkActor2D3NewEv")
    start = found.offset(address)
    code = data[start:start + length]
    old, new = (b"\xbf" + struct.pack("<I", bytes_) for bytes_ in (size, size + 8))
    assert code.count(old) == 1
    path.write_bytes(data[:start] + code.replace(old, new) + data[start + length:])
    assert f"an object of vtkActor2D has not {size} bytes" in refusal(tmp_path)


def test_classes_that_modules_derive_from_are_compared():
    layout = _layout.read_layout(_backend.HERE / f"_{_backend.ROOT}")
    classes = {name: row for library in layout["libraries"].values() for name, row in library.items()}
    for name in ("vtkActor", "vtkImageMapper", "vtkObject", "vtkPolyDataMapper2D", "vtkProperty", "vtkRenderWindow",
                 "vtkRenderer", "vtkTextActor", "vtkTexture", "vtkTextureObject"):
        assert classes[name][1], name
    # Those without objects of their own, by a class that is derived from them.
    for name, derived in (("vtkImageAlgorithm", "vtkImageCast"), ("vtkMapper", "vtkPolyDataMapper"),
                          ("vtkImageProcessingPass", "vtkSSAOPass")):
        assert classes[name][0] and classes[derived][1], name
    assert len(classes) > 150


def test_unknown_vtk_is_named():
    result = run("import penumbra", PYVISTA_VTK_BACKEND="paraview")
    assert "ImportError: PYVISTA_VTK_BACKEND is 'paraview', a VTK that penumbra was not built for" in result.stderr


def test_imported_vtk_is_used():
    for root in ("vtkmodules", "cvista") if _backend._pythons() else ("cvista",):
        if importlib.util.find_spec(root):
            result = run(f"import {root}.vtkCommonCore, penumbra; print(penumbra._backend.ROOT)",
                         PYVISTA_VTK_BACKEND="")
            assert result.stdout.strip() == root, result.stderr


def test_import_loads_neither_vtk_nor_numpy():
    result = run("import sys, penumbra; print([n for n in ('numpy', f'{penumbra._backend.ROOT}.vtkCommonCore', 'pyvista')"
                 " if n in sys.modules])")
    assert result.stdout.strip() == "[]", result.stderr


def test_rays_need_no_display():
    result = run("import penumbra\nimage = penumbra.render(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))\n"
                 "print(image.shape)")
    assert result.stdout.strip() == "(768, 1024, 3)", result.stderr


def test_version_is_that_of_the_distribution():
    assert penumbra.__version__ == importlib.metadata.version("vtk-penumbra")


def test_wheel_requires_no_vtk():
    required = [name for name in importlib.metadata.requires("vtk-penumbra") if "extra ==" not in name]
    assert required == ["numpy>=1.26"]


def test_wheel_contains_licenses_and_a_platform_tag():
    files = {str(path) for path in importlib.metadata.files("vtk-penumbra")}
    for name in ("LICENSE", "Apache-2.0.txt", "CLI11.txt", "GLM.txt", "VTK.txt", "nlohmann-json.txt",
                 "THIRD-PARTY.txt"):
        assert any(path.endswith(f"dist-info/licenses/{name}") for path in files), name
    wheel = importlib.metadata.distribution("vtk-penumbra").read_text("WHEEL")
    assert "Tag: cp312-abi3-manylinux_2_" in wheel
    metadata = pytest.importorskip("packaging.metadata")
    text = importlib.metadata.distribution("vtk-penumbra").read_text("METADATA")
    assert metadata.Metadata.from_email(text, validate=True).license_expression == "BSD-3-Clause AND Apache-2.0 AND MIT"


def test_vtk_without_libraries_in_the_wheel_is_refused(tmp_path):
    if _backend._pythons():
        pytest.skip("the wheel was built for the package vtk, too")
    fake_vtk(tmp_path, "9.7.2")
    result = run("import penumbra", PYTHONPATH=str(tmp_path), PYVISTA_VTK_BACKEND="vtk")
    assert "penumbra does not work with vtk 9.7.2" in result.stderr
