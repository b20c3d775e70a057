# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``mesh.penumbra``: ambient occlusion and irradiance baked onto PyVista meshes."""
import pyvista

from .colors import parse_radiance
from .falloffs import falloff_index
from .statistics import statistics_dict, update_or_raise
from .vtkPenumbraFiltersIrradiance import vtkPenumbraIrradianceFilter


@pyvista.register_dataset_accessor("penumbra", pyvista.MultiBlock)
@pyvista.register_dataset_accessor("penumbra", pyvista.DataSet)
class MeshAccessor:
    """Accessor ``mesh.penumbra`` of PyVista data sets and multiblocks."""

    def __init__(self, mesh):
        self._mesh = mesh

    def bake_ambient_occlusion(
        self, *, tolerance=0.01, radius=None, falloff="none", on="points", compute_normals=False,
        point_radius=0.0, inplace=False,
    ):
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
            Radius of the disks that represent points if the mesh has no polygons.
        inplace : bool
            If True, add the array to this mesh instead of to a copy.

        The blocks of a multiblock occlude each other. Statistics are in the field data, with
        ``EstimatedError``, the estimated RMSE.
        """
        if radius is not None and not radius > 0.0:
            raise ValueError(f"radius must be > 0, not {radius!r}")
        bake = vtkPenumbraIrradianceFilter()
        bake.SetRadius(0.0 if radius is None else min(radius, 1e299))
        bake.SetFalloff(falloff_index(falloff))
        return self._bake(bake, tolerance, on, compute_normals, point_radius, inplace)

    def bake_irradiance(
        self, *, tolerance=0.01, environment_color="white", albedo=0.5, bounces=3, on="points",
        compute_normals=False, point_radius=0.0, inplace=False,
    ):
        """Return the mesh with the array ``Irradiance``: red, green and blue; pi if unoccluded.

        Parameters
        ----------
        tolerance : float
            Accepted RMSE over all points, in the unit of the array. Range: [1e-4, 1].
        environment_color : color or sequence of float
            Radiance of the environment; three floats may exceed 1.
        albedo : float
            Fraction of light that the surface reflects. Range: [0, 1].
        bounces : int
            Number of reflections, including the one toward the camera; 1: direct light only.
            Range: [1, 64].
        on, compute_normals, point_radius, inplace
            As in ``bake_ambient_occlusion``.
        """
        if not 0.0 <= albedo <= 1.0:
            raise ValueError(f"albedo must be in [0, 1], not {albedo!r}")
        if not 1 <= bounces <= 64:
            raise ValueError(f"bounces must be in [1, 64], not {bounces!r}")
        bake = vtkPenumbraIrradianceFilter()
        bake.SetQuantity(bake.IRRADIANCE)
        bake.SetEnvironmentColor(parse_radiance(environment_color))
        bake.SetAlbedo(albedo)
        bake.SetBounces(bounces)
        return self._bake(bake, tolerance, on, compute_normals, point_radius, inplace)

    def _bake(self, bake, tolerance, on, compute_normals, point_radius, inplace):
        if on not in ("points", "cells"):
            raise ValueError(f"on must be 'points' or 'cells', not {on!r}")
        if not 1e-4 <= tolerance <= 1.0:
            raise ValueError(f"tolerance must be in [0.0001, 1], not {tolerance!r}")
        if isinstance(self._mesh, pyvista.Grid):
            raise TypeError(
                f"{type(self._mesh).__name__} is not a surface mesh: pass its extract_surface() instead")
        bake.SetInputDataObject(self._mesh)
        bake.SetTolerance(tolerance)
        bake.SetOnCells(on == "cells")
        bake.SetComputeNormals(compute_normals)
        bake.SetPointRadius(point_radius)
        update_or_raise(bake)
        baked = pyvista.wrap(bake.GetOutputDataObject(0))
        for name, value in statistics_dict(bake).items():
            baked.field_data[name] = [value]
        baked.field_data["EstimatedError"] = [bake.GetEstimatedError()]
        if inplace:
            self._mesh.copy_from(baked) if isinstance(self._mesh, pyvista.DataSet) else (
                self._mesh.shallow_copy(baked))
            return self._mesh
        return baked
