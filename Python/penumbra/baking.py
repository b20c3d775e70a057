# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion, irradiance and direct light of meshes that are NumPy arrays."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from ._classes import vtkPenumbraIrradianceFilter
from .conversion import (FALLOFFS, check_choice, check_integer, check_radius, check_range, mesh_arrays, parse_color,
                         parse_lights, poly_data, statistics_dict, to_numpy)
from .messages import Progress, update

Floats = npt.NDArray[np.float32]
Falloff = Literal["none", "linear", "quadratic", "square-root"]
Location = Literal["points", "cells"]
ColorLike = str | Sequence[float] | npt.NDArray[Any]


def occlusion_filter(tolerance: float, radius: float | None, falloff: str) -> Any:
    """Return a filter that bakes ambient occlusion."""
    bake = vtkPenumbraIrradianceFilter()
    bake.SetTolerance(check_range("tolerance", tolerance, 1e-4, 1.0))
    bake.SetRadius(check_radius(radius))
    bake.SetFalloff(check_choice("falloff", falloff, FALLOFFS))
    return bake


def needed_bounces(bounces: int, albedo: float, tolerance: float) -> int:
    """Return the number of bounces beyond which all others add less than a hundredth of the tolerance.

    In the worst case, a closed room of radiance 1, the bounces after n of them add pi * albedo^n / (1 - albedo).
    """
    if albedo <= 0.0:
        return 1
    limit = 0.01 * tolerance * (1.0 - albedo) / math.pi
    return bounces if limit <= 0.0 else min(bounces, max(1, math.ceil(math.log(limit) / math.log(albedo))))


def irradiance_filter(tolerance: float, color: list[float], albedo: float, bounces: int) -> Any:
    """Return a filter that bakes irradiance."""
    bake = vtkPenumbraIrradianceFilter()
    bake.SetQuantity(bake.IRRADIANCE)
    bake.SetTolerance(check_range("tolerance", tolerance, 1e-4, 1.0))
    bake.SetEnvironmentColor(color)
    bake.SetAlbedo(check_range("albedo", albedo, 0.0, 1.0))
    bake.SetBounces(needed_bounces(check_integer("bounces", bounces, 1, 64), albedo, tolerance))
    return bake


def direct_light_filter(
    lights: npt.ArrayLike, tolerance: float, light_radius: float, light_angle: float,
) -> Any:
    """Return a filter that bakes direct light."""
    bake = vtkPenumbraIrradianceFilter()
    bake.SetQuantity(bake.DIRECT_LIGHT)
    for light in parse_lights(lights):
        bake.AddLight(*light)
    bake.SetTolerance(check_range("tolerance", tolerance, 1e-4, 1.0))
    bake.SetLightRadius(check_range("light_radius", light_radius, 0.0, 1e30))
    bake.SetLightAngle(check_range("light_angle", light_angle, 0.0, 180.0))
    return bake


def set_location(bake: Any, on: str, compute_normals: bool, point_radius: float, line_radius: float = 0.0) -> None:
    bake.SetOnCells(check_choice("on", on, ("points", "cells")) == 1)
    bake.SetComputeNormals(bool(compute_normals))
    bake.SetPointRadius(check_range("point_radius", point_radius, 0.0, 1e30))
    bake.SetLineRadius(check_range("line_radius", line_radius, 0.0, 1e30))


def result_statistics(bake: Any) -> dict[str, Any]:
    return statistics_dict(bake) | {"EstimatedError": bake.GetEstimatedError()}


def _bake(bake: Any, name: str, points: npt.ArrayLike, faces: npt.ArrayLike | None, normals: npt.ArrayLike | None,
          lines: npt.ArrayLike | None, on: str, point_radius: float, line_radius: float,
          progress: Progress | None) -> Floats:
    set_location(bake, on, False, point_radius, line_radius)
    if faces is None and (mesh := mesh_arrays(points)) is not None:
        points, faces = mesh
    if faces is None and (normals is None or not point_radius > 0.0 or on == "cells"):
        raise ValueError("points without faces need on='points', normals and point_radius > 0, the radius of the disk "
                         "that represents a point")
    data = poly_data(points, faces, normals, lines, faces is not None and point_radius > 0.0)
    bake.SetInputData(data)
    # Cells of VTK are in the order vertices, lines, faces.
    others = data.GetNumberOfVerts() + data.GetNumberOfLines() if on == "cells" else 0
    expected = others if on == "cells" else _count_round(data)
    update(bake, progress, 3, (f"{expected} {on} do not belong to a surface and 0 are not",))
    output = bake.GetOutputDataObject(0)
    attributes = output.GetCellData() if on == "cells" else output.GetPointData()
    return to_numpy(attributes.GetArray(name))[others:]


def _count_round(data: Any) -> int:
    """Return the number of points of lines and vertices that belong to no face."""
    found = np.zeros(data.GetNumberOfPoints(), bool)
    for cells, value in ((data.GetLines(), True), (data.GetVerts(), True), (data.GetPolys(), False)):
        if cells.GetNumberOfCells():
            found[to_numpy(cells.GetConnectivityArray())] = value
    return int(np.count_nonzero(found))


@overload
def ambient_occlusion(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, radius: float | None = None,
    falloff: Falloff = "none", on: Location = "points", point_radius: float = 0.0, line_radius: float = 0.0,
    progress: Progress | None = None, return_statistics: Literal[False] = False,
) -> Floats: ...


@overload
def ambient_occlusion(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, radius: float | None = None,
    falloff: Falloff = "none", on: Location = "points", point_radius: float = 0.0, line_radius: float = 0.0,
    progress: Progress | None = None, return_statistics: Literal[True],
) -> tuple[Floats, dict[str, Any]]: ...


def ambient_occlusion(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, radius: float | None = None,
    falloff: Falloff = "none", on: Location = "points", point_radius: float = 0.0, line_radius: float = 0.0,
    progress: Progress | None = None, return_statistics: bool = False,
) -> Floats | tuple[Floats, dict[str, Any]]:
    """Compute the ambient occlusion of a mesh or of oriented points.

    The value is the fraction of the cosine-weighted hemisphere around the normal that surfaces within the radius
    block. Surfaces block from both sides.

    Parameters
    ----------
    points : array_like, shape (n, 3), float
        Coordinates. float32 and float64 are used without a copy. Or, without `faces`, a mesh: a vtkPolyData, such as
        one of PyVista, a mesh of trimesh, or triangles and quads of meshio.
    faces : array_like, shape (m, k) or flat, int, optional
        Indices of the k >= 3 points of each face, counterclockwise seen from outside. Or one row in which each face is
        preceded by the number of its points, as ``faces`` in PyVista. Default: no faces; then `normals` and
        `point_radius` are required.
    normals : array_like, shape (n, 3), float, optional
        Normals of the points. Default: computed from the faces.
    lines : array_like, shape (m, k) or flat, int, optional
        Indices of the k >= 2 points of each line, or flat as `faces`. Lines occlude as tubes with `line_radius`; points
        that belong to lines but to no face have the value 0.
    tolerance : float
        Accepted RMSE over all values. Range: [1e-4, 1].
    radius : float, optional
        Maximum distance of an occluder, in the unit of `points`. Range: > 0; may be ``inf``. Default: a tenth of the
        diagonal of the bounds.
    falloff : {"none", "linear", "quadratic", "square-root"}
        Weight of an occluder at the fraction s of the radius: 1, 1 - s, 1 - s**2, or 1 - sqrt(s).
    on : {"points", "cells"}
        Compute a value for each point, or for the center of each face.
    point_radius : float
        Radius, in the unit of `points`. With faces: of spheres around the points that belong to neither a face nor a
        line; they occlude. Without faces: of the disks that represent the points. Range: [0, 1e30]. Default: 0, no
        spheres.
    line_radius : float
        Radius of the tubes along `lines`, in the unit of `points`. Range: [0, 1e30]. Default: 0, lines do not occlude.
    progress : callable, optional
        Called with the completed fraction, from 0 to 1. An exception that it raises stops the computation.
    return_statistics : bool
        If True, return ``(values, statistics)``. The statistics are a dictionary of counts such as ``Rays/Total``, with
        ``EstimatedError``, the estimated RMSE.

    Returns
    -------
    numpy.ndarray, shape (n,) or (m,), float32
        Values from 0, open, to 1, blocked; 0 at points that belong to no face. They do not depend on the number of threads.

    Raises
    ------
    TypeError
        If an argument has the wrong type, such as faces that are not integers.
    ValueError
        If an argument has the wrong shape or is out of range, or if coordinates are not finite.
    IndexError
        If a face or a line refers to a point that does not exist.
    RuntimeError
        If the computation fails.
    KeyboardInterrupt
        On Ctrl-C in the main thread.

    Warns
    -----
    PenumbraWarning
        If points do not belong to a face, or if all points are blocked.

    Examples
    --------
    A floor and a roof that is a tenth of its size above it:

    >>> import penumbra
    >>> points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
    ...           (0, 0, 0.1), (1, 0, 0.1), (1, 1, 0.1), (0, 1, 0.1)]
    >>> faces = [(0, 1, 2, 3), (4, 5, 6, 7)]
    >>> penumbra.ambient_occlusion(points, faces, radius=1, on="cells").round(1).tolist()
    [1.0, 0.0]
    """
    bake = occlusion_filter(tolerance, radius, falloff)
    values = _bake(bake, "AmbientOcclusion", points, faces, normals, lines, on, point_radius, line_radius, progress)
    return (values, result_statistics(bake)) if return_statistics else values


@overload
def irradiance(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, environment_color: ColorLike = "white",
    albedo: float = 0.5, bounces: int = 3, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: Literal[False] = False,
) -> Floats: ...


@overload
def irradiance(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, environment_color: ColorLike = "white",
    albedo: float = 0.5, bounces: int = 3, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: Literal[True],
) -> tuple[Floats, dict[str, Any]]: ...


def irradiance(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, normals: npt.ArrayLike | None = None,
    lines: npt.ArrayLike | None = None, tolerance: float = 0.01, environment_color: ColorLike = "white",
    albedo: float = 0.5, bounces: int = 3, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: bool = False,
) -> Floats | tuple[Floats, dict[str, Any]]:
    """Compute the irradiance of a mesh or of oriented points under an environment, with interreflection.

    The value is the integral of the incident radiance times the cosine over the hemisphere: pi under a white
    environment that nothing blocks.

    Parameters
    ----------
    points, faces, normals, lines, tolerance, on, point_radius, line_radius, progress, return_statistics
        As in `ambient_occlusion`. The tolerance is in the unit of the values, for an environment of
        radiance 1; in others it is multiplied by their radiance (largest channel).
    environment_color : str or array_like of three floats
        Radiance of the environment: a color name, '#rrggbb', or three numbers >= 0, which may exceed 1.
    albedo : float
        Fraction of light that surfaces reflect. Range: [0, 1].
    bounces : int
        Number of reflections, including the one toward the eye; 1 is direct light only. Range: [1, 64]. Those that
        together add less than a hundredth of the tolerance are omitted.

    Returns
    -------
    numpy.ndarray, shape (n, 3) or (m, 3), float32
        Red, green and blue, from 0.

    Raises
    ------
    TypeError, ValueError, IndexError, RuntimeError, KeyboardInterrupt
        As `ambient_occlusion`.

    Examples
    --------
    >>> import penumbra
    >>> points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    >>> penumbra.irradiance(points, [(0, 1, 2)]).round(2)[0].tolist()
    [3.140000104904175, 3.140000104904175, 3.140000104904175]
    """
    bake = irradiance_filter(tolerance, parse_color("environment_color", environment_color), albedo, bounces)
    values = _bake(bake, "Irradiance", points, faces, normals, lines, on, point_radius, line_radius, progress)
    return (values, result_statistics(bake)) if return_statistics else values


@overload
def direct_light(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, lights: npt.ArrayLike,
    normals: npt.ArrayLike | None = None, lines: npt.ArrayLike | None = None, tolerance: float = 0.01,
    light_radius: float = 0.0, light_angle: float = 0.0, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: Literal[False] = False,
) -> Floats: ...


@overload
def direct_light(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, lights: npt.ArrayLike,
    normals: npt.ArrayLike | None = None, lines: npt.ArrayLike | None = None, tolerance: float = 0.01,
    light_radius: float = 0.0, light_angle: float = 0.0, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: Literal[True],
) -> tuple[Floats, dict[str, Any]]: ...


def direct_light(
    points: npt.ArrayLike, faces: npt.ArrayLike | None = None, *, lights: npt.ArrayLike,
    normals: npt.ArrayLike | None = None, lines: npt.ArrayLike | None = None, tolerance: float = 0.01,
    light_radius: float = 0.0, light_angle: float = 0.0, on: Location = "points", point_radius: float = 0.0,
    line_radius: float = 0.0, progress: Progress | None = None, return_statistics: bool = False,
) -> Floats | tuple[Floats, dict[str, Any]]:
    """Compute the direct light of a mesh or of oriented points, with hard or soft shadows.

    The value is the sum over the lights: visible fraction of the light times the cosine between the normal and the
    direction to its center. All lights have the intensity 1 and no attenuation.

    Parameters
    ----------
    points, faces, normals, lines, tolerance, on, point_radius, line_radius, progress, return_statistics
        As in `ambient_occlusion`.
    lights : array_like, shape (k, 3) or (k, 4), float
        Position x, y, z of each light in the unit of `points`, optionally with w: positive, the position is
        (x, y, z) / w; 0, the direction (x, y, z) toward a directional light, of any length. A single light may have
        the shape (3,) or (4,).
    light_radius : float
        Radius of lights with a position, which are spheres, in the unit of `points`. Range: [0, 1e30]. Default: 0, hard
        shadows.
    light_angle : float
        Angular diameter of directional lights, in degrees; that of the sun is 0.53. Range: [0, 180]. Default: 0, hard
        shadows.

    Returns
    -------
    numpy.ndarray, shape (n,) or (m,), float32
        From 0, in shadow of all lights or facing away from them, to k; 1 where one light is visible and straight above
        the surface.

    Raises
    ------
    TypeError, ValueError, IndexError, RuntimeError, KeyboardInterrupt
        As `ambient_occlusion`; ValueError if `lights` is empty, not finite, or has a negative w or the direction 0.

    Warns
    -----
    PenumbraWarning
        If the sphere of a light contains or touches a surface, which casts no shadow there.

    Examples
    --------
    A floor under the sun at an elevation of 30 degrees, and the same floor under a roof:

    >>> import penumbra
    >>> points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    >>> sun = (3 ** 0.5, 0, 1, 0)
    >>> penumbra.direct_light(points, [(0, 1, 2, 3)], lights=sun).round(3).tolist()
    [0.5, 0.5, 0.5, 0.5]
    >>> points += [(-9, -9, 1), (9, -9, 1), (9, 9, 1), (-9, 9, 1)]
    >>> penumbra.direct_light(points, [(0, 1, 2, 3), (4, 5, 6, 7)], lights=sun, on="cells").round(3).tolist()
    [0.0, 0.5]
    """
    bake = direct_light_filter(lights, tolerance, light_radius, light_angle)
    values = _bake(bake, "DirectLight", points, faces, normals, lines, on, point_radius, line_radius, progress)
    return (values, result_statistics(bake)) if return_statistics else values
