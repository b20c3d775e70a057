# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``plotter.penumbra``: passes and ray-cast pictures for PyVista's plotters."""
import numpy
import pyvista

from cvista.util.numpy_support import vtk_to_numpy

from .colors import radiance
from .falloffs import falloff_of
from .opengl import require
from .statistics import counts_of, update
from .vtkPenumbraFiltersRayCasting import vtkPenumbraRayCaster
from .vtkPenumbraRenderingScreenSpace import (
    vtkPenumbraLightShaftPass, vtkPenumbraTemporalSSAOPass)

PHASES = ("isotropic", "rayleigh", "henyey-greenstein")


def _check(condition, message):
    if not condition:
        raise ValueError(message)


@pyvista.register_plotter_component("penumbra")
class PlotterAccessor:
    """Registered as ``plotter.penumbra``; it works on the plotter's active renderer."""

    def __init__(self, plotter):
        self._plotter = plotter

    @property
    def _renderer(self):
        return self._plotter.renderer

    def enable_temporal_ssao(
        self, *, radius=None, tolerance=0.01, strength=1.0, kernel="automatic",
    ):
        """Darken by ambient occlusion, which converges while the view is still.

        Parameters
        ----------
        radius : float, optional
            Reach of an occluder in world units; default: a tenth of the diagonal of the bounds.
        tolerance : float
            The error accepted in a still view: RMSE of any 16x16 pixels, 0.0001 to 1.
        strength : float
            Colours are multiplied by ``1 - strength * occlusion``.
        kernel : str
            ``"automatic"``, ``"traced"`` (true rays), or a kernel of ``vtkPenumbraKernels``.

        Returns the pass, a ``vtkPenumbraTemporalSSAOPass``.
        """
        _check(radius is None or radius > 0.0, f"radius is a length, not {radius!r}")
        _check(1e-4 <= tolerance <= 1.0, f"tolerance is 0.0001 to 1, not {tolerance!r}")
        _check(0.0 <= strength <= 1.0, f"strength is 0 to 1, not {strength!r}")
        require(self._plotter.render_window)
        occlusion = vtkPenumbraTemporalSSAOPass.AddTo(self._renderer)
        occlusion.SetRadiusUnit(
            occlusion.FRACTION_OF_BOUNDS if radius is None else occlusion.WORLD)
        occlusion.SetRadius(0.1 if radius is None else radius)
        occlusion.SetTolerance(tolerance)
        occlusion.SetStrength(strength)
        occlusion.SetKernelName(kernel)
        if occlusion.GetKernelName() != kernel:
            self.disable_temporal_ssao()
            raise ValueError(f"there is no kernel {kernel!r}")
        self._plotter.render()
        return occlusion

    def disable_temporal_ssao(self):
        """Remove what ``enable_temporal_ssao`` added."""
        vtkPenumbraTemporalSSAOPass.RemoveFrom(self._renderer)
        self._plotter.render()

    def enable_light_shafts(
        self, *, scattering=None, extinction=None, phase="isotropic", asymmetry=0.6,
        tolerance=1.0 / 256.0,
    ):
        """Show light shafts of all lights but headlights in a homogeneous haze.

        Parameters
        ----------
        scattering, extinction : float, optional
            Shares of light scattered and lost per world unit; default: a quarter over the diagonal
            of the bounds, and nothing absorbed.
        phase : {"isotropic", "rayleigh", "henyey-greenstein"}
            Where scattered light goes; ``asymmetry`` is the last one's mean cosine, -0.999 to 0.999.
        tolerance : float
            The error accepted in a colour, 0.0001 to 1.

        Returns the pass, a ``vtkPenumbraLightShaftPass``.
        """
        for name, share in (("scattering", scattering), ("extinction", extinction)):
            _check(share is None or share >= 0.0, f"{name} is 0 or more, not {share!r}")
        _check(phase in PHASES, f"phase is one of {', '.join(PHASES)}, not {phase!r}")
        _check(-0.999 <= asymmetry <= 0.999, f"asymmetry is -0.999 to 0.999, not {asymmetry!r}")
        _check(1e-4 <= tolerance <= 1.0, f"tolerance is 0.0001 to 1, not {tolerance!r}")
        require(self._plotter.render_window)
        shafts = vtkPenumbraLightShaftPass.AddTo(self._renderer)
        shafts.SetScattering(-1.0 if scattering is None else scattering)
        shafts.SetExtinction(-1.0 if extinction is None else extinction)
        shafts.SetPhase(PHASES.index(phase))
        shafts.SetAsymmetry(asymmetry)
        shafts.SetTolerance(tolerance)
        self._plotter.render()
        return shafts

    def disable_light_shafts(self):
        """Remove what ``enable_light_shafts`` added."""
        vtkPenumbraLightShaftPass.RemoveFrom(self._renderer)
        self._plotter.render()

    def ray_cast(
        self, *, tolerance=1.0 / 256.0, window_size=None, ambient_occlusion=False, radius=None,
        falloff="none", strength=None, shadows=False, indirect_light=False, environment_color="black", albedo=0.5,
        bounces=3, transparent_background=False, as_float=False, return_statistics=False,
    ):
        """Return a picture of the scene by ray casting, antialiased to a tolerance.

        Needs no window: nothing is rendered. The picture is an array of rows from top to bottom, as
        ``plotter.screenshot`` returns it: bytes, or with ``as_float`` unclamped colours; with
        ``transparent_background`` a fourth channel is the covered share of each pixel.

        Parameters
        ----------
        tolerance : float
            The error accepted: RMSE of any 16x16 pixels, colours in [0, 1].
        window_size : tuple of int, optional
            Width and height; default: the plotter's.
        ambient_occlusion, radius, falloff, strength
            Darken by ambient occlusion; radius in world units, default a tenth of the diagonal;
            falloff as in ``mesh.penumbra.bake_ambient_occlusion``.
        shadows : bool
            Cast hard shadows of the lights.
        indirect_light : bool
            Add light from the environment, and what surfaces throw at each other.
        environment_color, albedo, bounces
            Of indirect light, as in ``mesh.penumbra.bake_irradiance``.
        return_statistics : bool
            Return ``(picture, counts)``; ``EstimatedError`` among the counts is the error that the
            ray caster believes it made.
        """
        _check(1e-6 <= tolerance <= 1.0, f"tolerance is 0.000001 to 1, not {tolerance!r}")
        _check(radius is None or radius > 0.0, f"radius is a length, not {radius!r}")
        _check(strength is None or 0.0 <= strength <= 1.0, f"strength is 0 to 1, not {strength!r}")
        _check(0.0 <= albedo <= 1.0, f"albedo is 0 to 1, not {albedo!r}")
        _check(1 <= bounces <= 64, f"bounces is 1 to 64, not {bounces!r}")
        width, height = window_size or self._plotter.window_size
        _check(width >= 1 and height >= 1, f"window_size is 1 by 1 or more, not {window_size!r}")
        if not self._renderer.camera.is_set and not self._renderer.camera_set:
            self._plotter.reset_camera()
        caster = vtkPenumbraRayCaster()
        caster.SetRenderer(self._renderer)
        caster.SetResolution(int(width), int(height))
        caster.SetTolerance(tolerance)
        caster.SetShadows(shadows)
        caster.SetAmbientOcclusion(ambient_occlusion)
        caster.SetAmbientOcclusionRadius(0.0 if radius is None else radius)
        caster.SetAmbientOcclusionFalloff(falloff_of(falloff))
        caster.SetAmbientOcclusionStrength(-1.0 if strength is None else strength)
        caster.SetIndirectLight(indirect_light)
        caster.SetEnvironmentColor(radiance(environment_color))
        caster.SetAlbedo(albedo)
        caster.SetBounces(bounces)
        caster.SetBackground(not transparent_background)
        update(caster)
        colors = vtk_to_numpy(caster.GetOutput().GetPointData().GetArray("Color"))
        picture = colors.reshape(int(height), int(width), 4)[::-1, :, : 4 if transparent_background else 3]
        if not as_float:
            picture = (numpy.clip(picture, 0.0, 1.0) * 255.0 + 0.5).astype(numpy.uint8)
        if not return_statistics:
            return picture
        return picture, counts_of(caster) | {"EstimatedError": caster.GetEstimatedError()}
