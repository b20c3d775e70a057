# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``plotter.penumbra``: render passes and ray casting for PyVista plotters."""
import numpy
import pyvista

from cvista.util.numpy_support import vtk_to_numpy

from .colors import parse_radiance
from .falloffs import falloff_index
from .opengl import require_opengl
from .statistics import statistics_dict, update_or_raise
from .vtkPenumbraFiltersRayCasting import vtkPenumbraRayCaster
from .vtkPenumbraRenderingScreenSpace import (
    vtkPenumbraLightShaftPass, vtkPenumbraTemporalSSAOPass)

PHASES = ("isotropic", "rayleigh", "henyey-greenstein")


def _check(condition, message):
    if not condition:
        raise ValueError(message)


@pyvista.register_plotter_component("penumbra")
class PlotterAccessor:
    """Accessor ``plotter.penumbra``, which applies to the active renderer of the plotter."""

    def __init__(self, plotter):
        self._plotter = plotter

    @property
    def _renderer(self):
        return self._plotter.renderer

    def enable_temporal_ssao(
        self, *, radius=None, tolerance=0.01, strength=1.0, kernel="automatic",
    ):
        """Add ambient occlusion, which converges while the view is static.

        Parameters
        ----------
        radius : float, optional
            Maximum distance of occluders in world units. Default: a tenth of the diagonal of the bounds.
        tolerance : float
            Accepted RMSE of a static view over any 16x16 pixels. Range: [1e-4, 1].
        strength : float
            Colors are multiplied by ``1 - strength * occlusion``. Range: [0, 1].
        kernel : str
            ``"automatic"``, ``"traced"`` (ray tracing), or a kernel of ``vtkPenumbraKernels``.

        Returns the pass, a ``vtkPenumbraTemporalSSAOPass``.
        """
        _check(radius is None or radius > 0.0, f"radius must be > 0, not {radius!r}")
        _check(1e-4 <= tolerance <= 1.0, f"tolerance must be in [0.0001, 1], not {tolerance!r}")
        _check(0.0 <= strength <= 1.0, f"strength must be in [0, 1], not {strength!r}")
        require_opengl(self._plotter.render_window)
        occlusion = vtkPenumbraTemporalSSAOPass.AddTo(self._renderer)
        occlusion.SetRadiusUnit(
            occlusion.FRACTION_OF_BOUNDS if radius is None else occlusion.WORLD)
        occlusion.SetRadius(0.1 if radius is None else radius)
        occlusion.SetTolerance(tolerance)
        occlusion.SetStrength(strength)
        occlusion.SetKernelName(kernel)
        if occlusion.GetKernelName() != kernel:
            self.disable_temporal_ssao()
            raise ValueError(
                f"kernel must be 'automatic', 'traced' or a name of vtkPenumbraKernels, not {kernel!r}")
        self._plotter.render()
        return occlusion

    def disable_temporal_ssao(self):
        """Remove the pass added by ``enable_temporal_ssao``."""
        vtkPenumbraTemporalSSAOPass.RemoveFrom(self._renderer)
        self._plotter.render()

    def enable_light_shafts(
        self, *, scattering=None, extinction=None, phase="isotropic", asymmetry=0.6,
        tolerance=1.0 / 256.0,
    ):
        """Add light shafts of all lights except headlights in a homogeneous medium.

        Parameters
        ----------
        scattering, extinction : float, optional
            Coefficients per world unit, >= 0. Default: a scattering optical depth of 0.25 over the
            diagonal of the bounds, without absorption.
        phase : {"isotropic", "rayleigh", "henyey-greenstein"}
            Phase function. ``asymmetry`` is the mean cosine of "henyey-greenstein"; range:
            [-0.999, 0.999].
        tolerance : float
            Accepted error of a color. Range: [1e-4, 1].

        Returns the pass, a ``vtkPenumbraLightShaftPass``.
        """
        for name, coefficient in (("scattering", scattering), ("extinction", extinction)):
            _check(coefficient is None or coefficient >= 0.0,
                   f"{name} must be >= 0, not {coefficient!r}")
        _check(phase in PHASES, f"phase must be one of {', '.join(PHASES)}, not {phase!r}")
        _check(-0.999 <= asymmetry <= 0.999, f"asymmetry must be in [-0.999, 0.999], not {asymmetry!r}")
        _check(1e-4 <= tolerance <= 1.0, f"tolerance must be in [0.0001, 1], not {tolerance!r}")
        require_opengl(self._plotter.render_window)
        shafts = vtkPenumbraLightShaftPass.AddTo(self._renderer)
        shafts.SetScattering(-1.0 if scattering is None else scattering)
        shafts.SetExtinction(-1.0 if extinction is None else extinction)
        shafts.SetPhase(PHASES.index(phase))
        shafts.SetAsymmetry(asymmetry)
        shafts.SetTolerance(tolerance)
        self._plotter.render()
        return shafts

    def disable_light_shafts(self):
        """Remove the pass added by ``enable_light_shafts``."""
        vtkPenumbraLightShaftPass.RemoveFrom(self._renderer)
        self._plotter.render()

    def ray_cast(
        self, *, tolerance=1.0 / 256.0, window_size=None, ambient_occlusion=False, radius=None,
        falloff="none", strength=None, shadows=False, indirect_light=False,
        environment_color="black", albedo=0.5, bounces=3, transparent_background=False,
        as_float=False, return_statistics=False,
    ):
        """Return an image of the scene by ray casting, antialiased to a tolerance.

        Does not need a window or OpenGL. The image is an array of rows from top to bottom, as returned by
        ``plotter.screenshot``: bytes, or unclamped colors with ``as_float``. With
        ``transparent_background``, the fourth channel is the covered fraction of each pixel.

        Parameters
        ----------
        tolerance : float
            Accepted RMSE over any 16x16 pixels, for colors in [0, 1]. Range: [1e-6, 1].
        window_size : tuple of int, optional
            Width and height in pixels. Default: the size of the plotter's window.
        ambient_occlusion, radius, falloff, strength
            Ambient occlusion. The radius is in world units, default: a tenth of the diagonal of the
            bounds. Falloff as in ``mesh.penumbra.bake_ambient_occlusion``.
        shadows : bool
            If True, the lights cast hard shadows.
        indirect_light : bool
            If True, add the light of the environment and of diffuse interreflection.
        environment_color, albedo, bounces
            Parameters of indirect light, as in ``mesh.penumbra.bake_irradiance``.
        return_statistics : bool
            If True, return ``(image, statistics)``. The statistics include ``EstimatedError``, the
            estimated RMSE.
        """
        _check(1e-6 <= tolerance <= 1.0, f"tolerance must be in [0.000001, 1], not {tolerance!r}")
        _check(radius is None or radius > 0.0, f"radius must be > 0, not {radius!r}")
        _check(strength is None or 0.0 <= strength <= 1.0, f"strength must be in [0, 1], not {strength!r}")
        _check(0.0 <= albedo <= 1.0, f"albedo must be in [0, 1], not {albedo!r}")
        _check(1 <= bounces <= 64, f"bounces must be in [1, 64], not {bounces!r}")
        width, height = window_size or self._plotter.window_size
        _check(width >= 1 and height >= 1, f"window_size must be at least 1 by 1, not {window_size!r}")
        if not self._renderer.camera.is_set and not self._renderer.camera_set:
            self._plotter.reset_camera()
        caster = vtkPenumbraRayCaster()
        caster.SetRenderer(self._renderer)
        caster.SetResolution(int(width), int(height))
        caster.SetTolerance(tolerance)
        caster.SetShadows(shadows)
        caster.SetAmbientOcclusion(ambient_occlusion)
        caster.SetAmbientOcclusionRadius(0.0 if radius is None else radius)
        caster.SetAmbientOcclusionFalloff(falloff_index(falloff))
        caster.SetAmbientOcclusionStrength(-1.0 if strength is None else strength)
        caster.SetIndirectLight(indirect_light)
        caster.SetEnvironmentColor(parse_radiance(environment_color))
        caster.SetAlbedo(albedo)
        caster.SetBounces(bounces)
        caster.SetBackground(not transparent_background)
        update_or_raise(caster)
        colors = vtk_to_numpy(caster.GetOutput().GetPointData().GetArray("Color"))
        channels = 4 if transparent_background else 3
        image = colors.reshape(int(height), int(width), 4)[::-1, :, :channels]
        if not as_float:
            image = (numpy.clip(image, 0.0, 1.0) * 255.0 + 0.5).astype(numpy.uint8)
        if not return_statistics:
            return image
        return image, statistics_dict(caster) | {"EstimatedError": caster.GetEstimatedError()}
