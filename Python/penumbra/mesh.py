# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``mesh.penumbra``: visibility baked onto PyVista's meshes."""
import pyvista

from .colors import radiance
from .falloffs import falloff_of
from .statistics import counts_of, update
from .vtkPenumbraFiltersIrradiance import vtkPenumbraIrradianceFilter


@pyvista.register_dataset_accessor("penumbra", pyvista.MultiBlock)
@pyvista.register_dataset_accessor("penumbra", pyvista.DataSet)
class MeshAccessor:
    """Registered as ``mesh.penumbra`` for PyVista's data sets and multiblocks."""

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
            The error that you accept: RMSE over all points, 0.0001 to 1.
        radius : float, optional
            Reach of an occluder in the mesh's own unit, may be ``inf``; default: a tenth of the
            diagonal of its bounds.
        falloff : {"none", "linear", "quadratic", "square-root"}
            How an occluder at a share s of the radius counts: 1, 1 - s, 1 - s^2, or 1 - sqrt(s).
        on : {"points", "cells"}
            A value for every point, or for the centre of every cell.
        compute_normals : bool
            Compute normals even where the mesh brings some.
        point_radius : float
            Where there are no polygons: the radius of the discs that stand for points.
        inplace : bool
            Add the array to this mesh instead of to a copy.

        The blocks of a multiblock may block one another. Counts of the work done are in the field
        data; ``EstimatedError`` among them is the error that the filter believes it made.
        """
        if radius is not None and not radius > 0.0:
            raise ValueError(f"radius is a length, not {radius!r}")
        bake = vtkPenumbraIrradianceFilter()
        bake.SetRadius(0.0 if radius is None else min(radius, 1e299))
        bake.SetFalloff(falloff_of(falloff))
        return self._bake(bake, tolerance, on, compute_normals, point_radius, inplace)

    def bake_irradiance(
        self, *, tolerance=0.01, environment_color="white", albedo=0.5, bounces=3, on="points",
        compute_normals=False, point_radius=0.0, inplace=False,
    ):
        """Return the mesh with the array ``Irradiance``: red, green and blue; pi in the open.

        Parameters
        ----------
        tolerance : float
            The error that you accept: RMSE over all points, 0.0001 to 1.
        environment_color : color or sequence of float
            The radiance that comes from where nothing is; three floats may be above 1.
        albedo : float
            The share of light that the surface throws back, 0 to 1.
        bounces : int
            Reflections up to the eye's, which is the last, 1 to 64; 1: straight light alone.
        on, compute_normals, point_radius, inplace
            As in ``bake_ambient_occlusion``.
        """
        if not 0.0 <= albedo <= 1.0:
            raise ValueError(f"albedo is 0 to 1, not {albedo!r}")
        if not 1 <= bounces <= 64:
            raise ValueError(f"bounces is 1 to 64, not {bounces!r}")
        bake = vtkPenumbraIrradianceFilter()
        bake.SetQuantity(bake.IRRADIANCE)
        bake.SetEnvironmentColor(radiance(environment_color))
        bake.SetAlbedo(albedo)
        bake.SetBounces(bounces)
        return self._bake(bake, tolerance, on, compute_normals, point_radius, inplace)

    def _bake(self, bake, tolerance, on, compute_normals, point_radius, inplace):
        if on not in ("points", "cells"):
            raise ValueError(f"on is 'points' or 'cells', not {on!r}")
        if not 1e-4 <= tolerance <= 1.0:
            raise ValueError(f"tolerance is 0.0001 to 1, not {tolerance!r}")
        if isinstance(self._mesh, pyvista.Grid):
            raise TypeError(
                f"{type(self._mesh).__name__} has no surface of its own: use its extract_surface()")
        bake.SetInputDataObject(self._mesh)
        bake.SetTolerance(tolerance)
        bake.SetOnCells(on == "cells")
        bake.SetComputeNormals(compute_normals)
        bake.SetPointRadius(point_radius)
        update(bake)
        baked = pyvista.wrap(bake.GetOutputDataObject(0))
        for name, count in counts_of(bake).items():
            baked.field_data[name] = [count]
        baked.field_data["EstimatedError"] = [bake.GetEstimatedError()]
        if inplace:
            self._mesh.copy_from(baked) if isinstance(self._mesh, pyvista.DataSet) else (
                self._mesh.shallow_copy(baked))
            return self._mesh
        return baked
