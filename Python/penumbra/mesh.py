# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``mesh.penumbra``: ambient occlusion, irradiance and direct light baked onto PyVista meshes."""
from __future__ import annotations

from typing import Any

import numpy.typing as npt
import pyvista

from .baking import (ColorLike, Falloff, Location, direct_light_filter, irradiance_filter, occlusion_filter,
                     result_statistics, set_location)
from .conversion import parse_color
from .messages import Progress, update


def _array_names(mesh: Any) -> set[str]:
    """Return the names of the arrays of a mesh or of the blocks of a multiblock."""
    if isinstance(mesh, pyvista.MultiBlock):
        return set().union(*(_array_names(block) for block in mesh if block is not None))
    return set(mesh.array_names)


class MeshAccessor:
    """Accessor ``mesh.penumbra`` of PyVista data sets and multiblocks."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def __repr__(self) -> str:
        found = _array_names(self._mesh)
        baked = [name for name in ("AmbientOcclusion", "Irradiance", "DirectLight") if name in found]
        return f"<penumbra of {type(self._mesh).__name__}: {'has ' + ' and '.join(baked) if baked else 'nothing baked'}>"

    def bake_ambient_occlusion(
        self, *, tolerance: float = 0.01, radius: float | None = None, falloff: Falloff = "none",
        on: Location = "points", compute_normals: bool = False, point_radius: float = 0.0, line_radius: float = 0.0,
        inplace: bool = False, statistics: bool = False, progress: Progress | None = None,
    ) -> Any:
        """Return the mesh with the array ``AmbientOcclusion``: 0 open, 1 blocked.

        Parameters
        ----------
        tolerance : float
            Accepted RMSE over all points, in the unit of the array. Range: [1e-4, 1].
        radius : float, optional
            Maximum distance of occluders in the unit of the mesh; may be ``inf``. Default: a tenth of
            the diagonal of the bounds.
        falloff : {"none", "linear", "quadratic", "square-root"}
            Weight of an occluder at the fraction s of the radius: 1, 1 - s, 1 - s^2, or 1 - sqrt(s).
        on : {"points", "cells"}
            Compute a value for every point, or for the center of every cell.
        compute_normals : bool
            If True, compute normals even if the mesh has normals.
        point_radius : float
            Radius of the disks that represent points if the mesh has no polygons, otherwise of spheres at its
            vertices, which occlude, in the unit of the mesh. Range: >= 0. Default: 0, neither.
        line_radius : float
            Radius of tubes along the lines of the mesh, which occlude, in the unit of the mesh. Range: >= 0.
            Default: 0, lines do not occlude.
        inplace : bool
            If True, add the array to this mesh instead of to a copy.
        statistics : bool
            If True, add the statistics to the field data, with ``EstimatedError``, the estimated RMSE.
        progress : callable, optional
            Called with the completed fraction, from 0 to 1. An exception that it raises stops the computation.

        Returns
        -------
        pyvista.DataSet or pyvista.MultiBlock
            The blocks of a multiblock occlude each other.

        Raises
        ------
        TypeError
            If the mesh is a grid without a surface, or an argument has the wrong type.
        ValueError
            If an argument is out of range.
        RuntimeError
            If the computation fails.
        """
        bake = occlusion_filter(tolerance, radius, falloff)
        return self._bake(bake, on, compute_normals, point_radius, line_radius, inplace, statistics, progress)

    def bake_irradiance(
        self, *, tolerance: float = 0.01, environment_color: ColorLike = "white", albedo: float = 0.5,
        bounces: int = 3, on: Location = "points", compute_normals: bool = False, point_radius: float = 0.0,
        line_radius: float = 0.0, inplace: bool = False, statistics: bool = False, progress: Progress | None = None,
    ) -> Any:
        """Return the mesh with the array ``Irradiance``: red, green and blue; pi if unoccluded.

        Parameters
        ----------
        tolerance : float
            Accepted RMSE over all points, in the unit of the array, for an environment of radiance 1; it is
            multiplied by the radiance of others. Range: [1e-4, 1].
        environment_color : color or sequence of float
            Radiance of the environment; three floats may exceed 1.
        albedo : float
            Fraction of light that the surface reflects. Range: [0, 1].
        bounces : int
            Number of reflections, including the one toward the camera; 1: direct light only.
            Range: [1, 64].
        on, compute_normals, point_radius, line_radius, inplace, statistics, progress
            As in ``bake_ambient_occlusion``.

        Returns
        -------
        pyvista.DataSet or pyvista.MultiBlock
        """
        bake = irradiance_filter(tolerance, parse_color("environment_color", environment_color), albedo, bounces)
        return self._bake(bake, on, compute_normals, point_radius, line_radius, inplace, statistics, progress)

    def bake_direct_light(
        self, lights: npt.ArrayLike, *, tolerance: float = 0.01, light_radius: float = 0.0, light_angle: float = 0.0,
        on: Location = "points", compute_normals: bool = False, point_radius: float = 0.0, line_radius: float = 0.0,
        inplace: bool = False, statistics: bool = False, progress: Progress | None = None,
    ) -> Any:
        """Return the mesh with the array ``DirectLight``: visible fraction times cosine, summed over the lights.

        Parameters
        ----------
        lights : array_like, shape (k, 3) or (k, 4), float
            Position x, y, z of each light in the unit of the mesh, optionally with w: positive, the position is
            (x, y, z) / w; 0, the direction (x, y, z) toward a directional light, of any length. A single light may
            have the shape (3,) or (4,).
        tolerance : float
            Accepted RMSE over all points, in the unit of the array. Range: [1e-4, 1].
        light_radius : float
            Radius of lights with a position, which are spheres, in the unit of the mesh. Range: [0, 1e30].
            Default: 0, hard shadows.
        light_angle : float
            Angular diameter of directional lights, in degrees; that of the sun is 0.53. Range: [0, 180].
            Default: 0, hard shadows.
        on, compute_normals, point_radius, line_radius, inplace, statistics, progress
            As in ``bake_ambient_occlusion``.

        Returns
        -------
        pyvista.DataSet or pyvista.MultiBlock
            One component from 0, in shadow of all lights or facing away from them, to k; 1 where one light is visible
            and straight above the surface. The blocks of a multiblock shadow each other.

        Raises
        ------
        TypeError, ValueError, RuntimeError
            As ``bake_ambient_occlusion``; ValueError if `lights` is empty, not finite, or has a negative w or the
            direction 0.
        """
        bake = direct_light_filter(lights, tolerance, light_radius, light_angle)
        return self._bake(bake, on, compute_normals, point_radius, line_radius, inplace, statistics, progress)

    def _bake(self, bake: Any, on: str, compute_normals: bool, point_radius: float, line_radius: float, inplace: bool,
              statistics: bool, progress: Progress | None) -> Any:
        set_location(bake, on, compute_normals, point_radius, line_radius)
        if isinstance(self._mesh, pyvista.Grid):
            raise TypeError(
                f"{type(self._mesh).__name__} is not a surface mesh: pass its extract_surface() instead")
        bake.SetInputDataObject(self._mesh)
        update(bake, progress, stacklevel=3)
        baked = pyvista.wrap(bake.GetOutputDataObject(0))
        # The filter adds its statistics to the field data, and files would keep them.
        counts = result_statistics(bake)
        for name, value in counts.items():
            if statistics:
                baked.field_data[name] = [value]
            elif name in self._mesh.field_data:
                baked.field_data[name] = self._mesh.field_data[name]
            elif name in baked.field_data:
                del baked.field_data[name]
        if inplace:
            if isinstance(self._mesh, pyvista.DataSet):
                self._mesh.copy_from(baked)
            else:
                self._mesh.shallow_copy(baked)
            return self._mesh
        return baked


# Not decorators: type checkers would see a class without attributes, because PyVista declares to return any type.
for _dataset in (pyvista.DataSet, pyvista.MultiBlock):
    pyvista.register_dataset_accessor("penumbra", _dataset)(MeshAccessor)
