# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the program `penumbra` that the wheel brings, in an empty environment."""
import importlib.metadata
import pathlib
import subprocess
import sys

import numpy
import pytest

from penumbra import _backend

PROGRAM = pathlib.Path(sys.executable).parent / "penumbra"
BACKEND = "vtk" if _backend.ROOT == "vtkmodules" else _backend.ROOT
SQUARE = """OFF
4 1 0
-0.5 -0.5 0
0.5 -0.5 0
0.5 0.5 0
-0.5 0.5 0
4 0 1 2 3
"""
#: A view in which the square covers the middle half of the columns and rows, seen from the front.
VIEW = ["--camera-orthographic", "--camera-parallel-scale", "1", "--camera-position", "0,0,5",
        "--camera-focal-point", "0,0,0", "--resolution", "100,100"]


def run(*arguments, backend=BACKEND, **options):
    """Run the program without the variables of this process, such as the paths of libraries and displays."""
    return subprocess.run([PROGRAM, *arguments], capture_output=True, env={"PYVISTA_VTK_BACKEND": backend}, **options)


def pixels(bitmap):
    """Return the pixels of a BMP file of 24 bits whose rows need no padding."""
    start, width, height = (int.from_bytes(bitmap[at:at + 4], "little") for at in (10, 18, 22))
    return numpy.frombuffer(bitmap, numpy.uint8, offset=start).reshape(height, width, 3)


def test_version_is_that_of_the_wheel():
    result = run("--version")
    assert importlib.metadata.version("vtk-penumbra") in result.stdout.decode().split(), result


@pytest.mark.parametrize("engine", ["ray", "raster"])
def test_image_of_square_is_exact(tmp_path, engine):
    (tmp_path / "square.off").write_text(SQUARE)
    result = run("render", "square.off", "--output", "square.bmp", "--engine", engine, *VIEW, cwd=tmp_path)
    if engine == "raster" and result.returncode == 3:
        pytest.skip(result.stderr.decode())
    assert (result.returncode, result.stderr) == (0, b"")
    expected = numpy.zeros((100, 100, 3), numpy.uint8)
    expected[25:75, 25:75] = 255
    assert numpy.array_equal(pixels((tmp_path / "square.bmp").read_bytes()), expected)


def test_standard_streams_are_passed_on(tmp_path):
    result = run("render", "-", "--output", "-", *VIEW, cwd=tmp_path, input=SQUARE.encode())
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(b"\x89PNG")


def test_readers_of_optional_modules_are_included():
    listed = run("list").stdout.decode()
    for extension in (".cgns", ".vtkhdf", ".xmf", ".exo", ".case", ".glb", ".3ds"):
        assert extension in listed


def test_bad_input_is_one_line(tmp_path):
    result = run("render", "missing.stl", "--output", "image.png", cwd=tmp_path)
    assert result.returncode == 2
    assert len(result.stderr.splitlines()) == 1 and b"missing.stl" in result.stderr


def test_unusable_vtk_is_one_line():
    result = run("--version", backend="paraview")
    assert result.returncode == 3
    assert result.stderr.startswith(b"penumbra: PYVISTA_VTK_BACKEND is 'paraview', a VTK that penumbra was not built for")
    assert len(result.stderr.splitlines()) == 1
