# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments, and conversion of arrays to VTK and back."""
from __future__ import annotations

import math
import numbers
import re
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._backend import vtk_module

# Names of matplotlib and PyVista that VTK does not have.
COLORS = {
    "b": "blue", "g": "green", "r": "red", "c": "cyan", "m": "magenta", "y": "yellow", "k": "black", "w": "white",
    "tab:blue": "#1f77b4", "tab:orange": "#ff7f0e", "tab:green": "#2ca02c", "tab:red": "#d62728",
    "tab:purple": "#9467bd", "tab:brown": "#8c564b", "tab:pink": "#e377c2", "tab:gray": "#7f7f7f",
    "tab:olive": "#bcbd22", "tab:cyan": "#17becf",
}
FALLOFFS = ("none", "linear", "quadratic", "square-root")  # as vtkPenumbraIrradianceProvider::Falloffs


def check_range(name: str, value: Any, low: float, high: float) -> Any:
    """Return a number in [low, high]; raise TypeError or ValueError otherwise."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} must be a number, not {value!r}")
    if not low <= float(value) <= high:
        raise ValueError(f"{name} must be in [{low:g}, {high:g}], not {value!r}")
    return value


def check_integer(name: str, value: Any, low: int, high: int) -> int:
    """Return an integer in [low, high], also one that is stored as a float; raise TypeError or ValueError otherwise."""
    number = check_range(name, value, low, high)
    if number != int(number):
        raise ValueError(f"{name} must be an integer, not {value!r}")
    return int(number)


def check_radius(radius: Any) -> float:
    """Return VTK's value of a radius: 0 for None, which stands for the default."""
    if radius is None:
        return 0.0
    if isinstance(radius, bool) or not isinstance(radius, numbers.Real):
        raise TypeError(f"radius must be a number or None, not {radius!r}")
    if not float(radius) > 0.0:
        raise ValueError(f"radius must be > 0, not {radius!r}")
    return min(float(radius), 1e299)


def check_choice(name: str, value: Any, choices: Sequence[str]) -> int:
    """Return the index of a choice."""
    if value not in choices:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, choices))}, not {value!r}")
    return choices.index(value)


def check_size(name: str, size: Any) -> tuple[int, int]:
    """Return width and height in pixels."""
    try:
        width, height = size
        pixels = [int(number) for number in (width, height)]
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} must be two integers, width and height, not {size!r}") from None
    if pixels != [width, height] or isinstance(width, bool) or isinstance(height, bool):
        raise ValueError(f"{name} must be two integers, width and height, not {size!r}")
    if not all(1 <= number <= 65535 for number in pixels):
        raise ValueError(f"{name} must be 1 by 1 to 65535 by 65535 pixels, not {size!r}")
    return pixels[0], pixels[1]


def _named_color(name: str, color: str) -> list[float]:
    """Return red, green and blue of a color of PyVista if it is loaded, of VTK, of matplotlib, or '#rrggbb'."""
    colors = vtk_module("vtkCommonColor").vtkNamedColors()
    found = COLORS.get(color.lower(), color)
    is_hexadecimal = re.fullmatch("#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})", found) is not None
    if "pyvista" in sys.modules and not found.startswith("#"):
        try:
            return list(sys.modules["pyvista"].Color(found).float_rgb)
        except ValueError:  # not one of PyVista's
            pass
    if not is_hexadecimal and not colors.ColorExists(found):
        raise ValueError(f"{name} must be a color name, '#rrggbb' or three numbers >= 0, not {color!r}")
    color = found[:7] if is_hexadecimal else found  # without opacity
    rgb = colors.HTMLColorToRGB(color)
    return [component / 255.0 for component in (rgb.GetRed(), rgb.GetGreen(), rgb.GetBlue())]


def parse_color(name: str, color: Any, high: float = math.inf) -> list[float]:
    """Return red, green and blue from a color name or from three numbers in [0, high]."""
    if isinstance(color, str):
        return _named_color(name, color)
    if hasattr(color, "float_rgb"):  # of PyVista
        color = color.float_rgb
    try:
        values = [float(value) for value in color]
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a color name or three numbers >= 0, not {color!r}") from None
    if len(values) != 3 or not all(0.0 <= value <= high and value < math.inf for value in values):
        limit = ">= 0" if high == math.inf else f"in [0, {high:g}]"
        raise ValueError(f"{name} must be a color name or three numbers {limit}, not {color!r}")
    return values


def parse_lights(lights: npt.ArrayLike) -> list[list[float]]:
    """Return homogeneous positions, four floats each, from an array of shape (k, 3), (k, 4), (3,) or (4,)."""
    try:
        values = np.asarray(lights)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"lights must have the shape (k, 3) or (k, 4): {error}") from None
    if values.dtype.kind not in "fiu":
        raise TypeError(f"lights must be an array of numbers, not of dtype {values.dtype}")
    rows = np.atleast_2d(values).astype(np.float64)
    if rows.ndim != 2 or rows.shape[1] not in (3, 4) or len(rows) == 0:
        raise ValueError(f"lights must have the shape (k, 3) or (k, 4) with at least one light, not {values.shape}")
    if rows.shape[1] == 3:
        rows = np.column_stack([rows, np.ones(len(rows))])
    if not np.isfinite(rows).all() or (rows[:, 3] < 0.0).any():
        raise ValueError("lights must be finite, and w must be positive, or 0 for directional lights")
    if ((rows[:, 3] == 0.0) & (rows[:, :3] == 0.0).all(axis=1)).any():
        raise ValueError("lights must not have the direction (0, 0, 0)")
    positions: list[list[float]] = rows.tolist()
    return positions


def vectors(name: str, array: npt.ArrayLike, rows: int | None = None) -> npt.NDArray[Any]:
    """Return an array of shape (n, 3) of finite floats."""
    try:
        values = np.asarray(array)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name} must have the shape (n, 3): {error}") from None
    if values.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be an array of numbers, not of dtype {values.dtype}")
    if values.ndim != 2 or values.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (n, 3), not {values.shape}")
    if rows is not None and len(values) != rows:
        raise ValueError(f"{name} must have one row for each of the {rows} points, not {len(values)}")
    if values.dtype not in (np.float32, np.float64):
        values = values.astype(np.float64)
    finite = np.isfinite(values).all(axis=1)
    if not finite.all():
        raise ValueError(f"{name} must be finite: {np.count_nonzero(~finite)} of {len(values)} are not, the first is "
                         f"{name}[{np.argmin(finite)}] = {values[np.argmin(finite)]}. Remove them.")
    return np.ascontiguousarray(values)


def _starts_of_cells(name: str, values: npt.NDArray[np.int64], minimum: int) -> npt.NDArray[np.int64]:
    """Return the positions of the numbers of points in flat cells."""
    step = int(values[0]) + 1
    if step > minimum and len(values) % step == 0 and (values[::step] == values[0]).all():
        return np.arange(0, len(values), step)
    numbers = values.tolist()  # whose elements Python reads faster
    end = len(numbers)
    starts = []
    position = 0
    while position < end:
        count = numbers[position]
        if count < minimum or position + count >= end:
            raise ValueError(f"{name} is flat and must hold the number of points of each {name[:-1]}, which is at least "
                             f"{minimum}, followed by its points; {name}[{position}] = {count} is no such number")
        starts.append(position)
        position += count + 1
    return np.array(starts, np.int64)


def mesh_arrays(mesh: Any) -> tuple[Any, Any] | None:
    """Return the points and the faces of a mesh of trimesh, meshio, VTK or PyVista; None for other objects."""
    if hasattr(mesh, "IsA") and mesh.IsA("vtkDataObject"):
        if not mesh.IsA("vtkPolyData"):
            raise TypeError(f"points must be an array or a mesh of polygons, not a {mesh.GetClassName()}")
        if mesh.GetNumberOfStrips():
            raise ValueError("points is a mesh with triangle strips: pass its triangulate()")
        polygons = mesh.GetPolys()
        if mesh.GetNumberOfPoints() == 0 or polygons.GetNumberOfCells() == 0:
            raise ValueError("points is a mesh without polygons")
        connectivity, offsets = (to_numpy(array) for array in (polygons.GetConnectivityArray(),
                                                               polygons.GetOffsetsArray()))
        return to_numpy(mesh.GetPoints().GetData()), np.insert(connectivity, offsets[:-1], np.diff(offsets))
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):  # meshio
        blocks = [np.asarray(block.data) for block in mesh.cells if block.type in ("triangle", "quad")]
        if not blocks or len(blocks) != len(mesh.cells):
            found = ", ".join(sorted({block.type for block in mesh.cells})) or "none"
            raise TypeError(f"the cells of the mesh must be triangles or quads, not {found}: pass its surface")
        flat = [np.insert(block, 0, block.shape[1], axis=1).ravel() for block in blocks]
        return np.asarray(mesh.points), np.concatenate(flat)
    return None


def _cells(
    name: str, cells: npt.ArrayLike, size: int, minimum: int,
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Return offsets and connectivity of cells of shape (m, k), or flat as in PyVista: n, i0, ... in-1, n, ..."""
    one = name[:-1]
    try:
        values = np.asarray(cells)
    except ValueError:
        raise ValueError(f"{name} of different sizes must be flat: the number of points of the first {one}, its "
                         f"points, the number of points of the second {one}, and so on") from None
    if values.size == 0:
        raise ValueError(f"{name} is empty: pass None for points without {name}")
    if values.dtype.kind not in "iu":
        raise TypeError(f"{name} must be an array of integers, not of dtype {values.dtype}")
    values = np.ascontiguousarray(values, np.int64)
    if values.ndim == 2 and values.shape[1] >= minimum:
        offsets = np.arange(0, values.size + 1, values.shape[1])
        connectivity = values.ravel()
    elif values.ndim == 1:
        starts = _starts_of_cells(name, values, minimum)
        connectivity = np.delete(values, starts)
        offsets = np.concatenate([[0], np.cumsum(values[starts])])
    else:
        raise ValueError(f"{name} must have the shape (m, {minimum}), (m, {minimum + 1}) or (k,), not {values.shape}")
    if connectivity.min() < 0 or connectivity.max() >= size:
        wrong = int(np.argmax((connectivity < 0) | (connectivity >= size)))
        raise IndexError(f"{name} refer to points 0 to {size - 1}, but {one} "
                         f"{np.searchsorted(offsets, wrong, 'right') - 1} has the point {connectivity[wrong]}")
    return offsets.astype(np.int64), connectivity


def _cell_array(offsets: npt.NDArray[np.int64], connectivity: npt.NDArray[np.int64]) -> Any:
    support = vtk_module("util.numpy_support")
    id_type = vtk_module("vtkCommonCore").VTK_ID_TYPE
    cells = vtk_module("vtkCommonDataModel").vtkCellArray()
    cells.SetData(support.numpy_to_vtk(offsets, array_type=id_type),
                  support.numpy_to_vtk(connectivity, array_type=id_type))
    return cells


def poly_data(points: npt.ArrayLike, faces: npt.ArrayLike | None, normals: npt.ArrayLike | None = None,
              lines: npt.ArrayLike | None = None, spheres: bool = False) -> Any:
    """Return a vtkPolyData that shares the memory of the arrays where their types allow it.

    Points that belong to neither a face nor a line are vertices if they are spheres or if there are points only.
    """
    support = vtk_module("util.numpy_support")
    positions = vectors("points", points)
    if len(positions) == 0:
        raise ValueError("points is empty: pass at least one point")
    vtk_points = vtk_module("vtkCommonCore").vtkPoints()
    vtk_points.SetData(support.numpy_to_vtk(positions))
    data = vtk_module("vtkCommonDataModel").vtkPolyData()
    data.SetPoints(vtk_points)
    free = np.ones(len(positions), bool)
    for name, cells, minimum, setter in (("faces", faces, 3, data.SetPolys), ("lines", lines, 2, data.SetLines)):
        if cells is not None:
            offsets, connectivity = _cells(name, cells, len(positions), minimum)
            free[connectivity] = False
            setter(_cell_array(offsets, connectivity))
    vertices = np.flatnonzero(free).astype(np.int64)
    if vertices.size and (spheres or (faces is None and lines is None)):
        data.SetVerts(_cell_array(np.arange(vertices.size + 1, dtype=np.int64), vertices))
    if normals is not None:
        data.GetPointData().SetNormals(support.numpy_to_vtk(vectors("normals", normals, len(positions))))
    return data


def image_data(name: str, image: Any) -> Any:
    """Return a vtkImageData from an array of rows from top to bottom, or the image itself if it is one."""
    if hasattr(image, "IsA") and image.IsA("vtkImageData"):
        return image
    values = np.asarray(image)
    if values.dtype.kind not in "fu" or values.dtype == np.float16:
        raise TypeError(f"{name} must be an array of uint8, uint16, float32 or float64, not of {values.dtype}")
    if values.ndim == 2:
        values = values[:, :, None]
    if values.ndim != 3 or not 1 <= values.shape[2] <= 4 or values.size == 0:
        raise ValueError(f"{name} must have the shape (height, width) or (height, width, 1 to 4), "
                         f"not {np.shape(image)}")
    support = vtk_module("util.numpy_support")
    data = vtk_module("vtkCommonDataModel").vtkImageData()
    data.SetDimensions(values.shape[1], values.shape[0], 1)
    rows = np.ascontiguousarray(values[::-1]).reshape(-1, values.shape[2])
    data.GetPointData().SetScalars(support.numpy_to_vtk(rows, deep=True))
    return data


def to_numpy(array: Any) -> npt.NDArray[Any]:
    return vtk_module("util.numpy_support").vtk_to_numpy(array)  # type: ignore[no-any-return]


def colors_of(image: Any, channels: int) -> npt.NDArray[Any]:
    """Return the array Color of a vtkImageData, rows from top to bottom."""
    width, height, _ = image.GetDimensions()
    return to_numpy(image.GetPointData().GetArray("Color")).reshape(height, width, 4)[::-1, :, :channels]


def to_bytes(image: npt.NDArray[Any]) -> npt.NDArray[np.uint8]:
    result: npt.NDArray[np.uint8] = (np.clip(image, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)
    return result


def statistics_dict(algorithm: Any) -> dict[str, Any]:
    """Return the statistics of a filter or pass as a dictionary of numbers or strings."""
    data = algorithm.GetStatistics()
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): array.GetValue(0) for array in arrays}
