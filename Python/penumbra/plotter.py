# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""``plotter.penumbra``: render passes and ray casting for PyVista plotters."""
from __future__ import annotations

import io
import pathlib
from collections.abc import Sequence
from typing import Any

import numpy
import pyvista

from ._classes import (vtkPenumbraKernels, vtkPenumbraLightShaftPass, vtkPenumbraOcclusionEstimator,
                       vtkPenumbraTemporalSSAOPass)
from .baking import ColorLike, Falloff
from .conversion import check_choice, check_integer, check_radius, check_range, check_size
from .graphics import check_options, check_path, write_graphic
from .looks import NAMES, Restorer, settings_of
from .messages import Progress, observe_warnings, warn
from .opengl import require_opengl
from .passes import add, medium_bounds, passes_of, remove
from .rendering import Cache, Image, Settings, cast_renderers, finish, prepare_plotter

PHASES = ("isotropic", "rayleigh", "henyey-greenstein")
IMAGE_SCALE = 4  # pixels per point of an image in a figure
ESTIMATORS = {"depth": "DEPTH", "shadow-map": "SHADOW_MAP"}


def _split_coefficient(name: str, coefficient: float | Sequence[float] | None) -> tuple[float, list[float]]:
    """Return the largest channel of a coefficient, -1 for the default, and the factors of the channels."""
    if coefficient is None:
        return -1.0, [1.0, 1.0, 1.0]
    values = numpy.atleast_1d(numpy.asarray(coefficient, dtype=float)).tolist()
    if len(values) not in (1, 3):
        raise ValueError(f"{name} must be one number or three; it has {len(values)}")
    for value in values:
        check_range(name, value, 0.0, 1e299)
    largest = max(values)
    return largest, [value / largest if largest > 0.0 else 1.0 for value in values * (3 // len(values))]


def _lowest_height(renderer: Any, up: Sequence[float]) -> float:
    """Return the lowest height of the visible bounds along a direction, 0 without props."""
    bounds = renderer.ComputeVisiblePropBounds()
    if bounds[0] > bounds[1]:
        return 0.0
    corner = [bounds[2 * axis + (up[axis] < 0.0)] for axis in range(3)]
    return float(numpy.dot(up, corner) / numpy.linalg.norm(up))


def _in_figure_path(filename: str | pathlib.Path) -> pathlib.Path:
    path = pathlib.Path(filename)
    if pyvista.FIGURE_PATH and not path.is_absolute():
        path = pathlib.Path(pyvista.FIGURE_PATH) / path
    return path.expanduser()


def _write(image: Image, filename: str | pathlib.Path | io.BytesIO) -> None:
    """Write an image as the method screenshot of a plotter does."""
    import PIL.Image

    pixels = PIL.Image.fromarray(image)
    if isinstance(filename, io.BytesIO):
        pixels.save(filename, format="PNG")
        return
    path = _in_figure_path(filename)
    pixels.save(path if path.suffix else path.with_suffix(".png"))


class PlotterAccessor:
    """Accessor ``plotter.penumbra``, which applies to the active renderer of the plotter."""

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter
        self._look = "plain"
        self._restorers: dict[Any, Restorer] = {}

    @property
    def _renderer(self) -> Any:
        return self._plotter.renderer

    def __repr__(self) -> str:
        return f"<penumbra of a plotter: {self.describe()}>"

    def _size(self, window_size: Any) -> tuple[int, int]:
        return check_size("window_size", self._plotter.window_size if window_size is None else window_size)

    def _scale(self, scale: Any) -> int:
        return check_integer("scale", self._plotter.image_scale if scale is None else scale, 1, 64)

    def _settings(self, arguments: dict[str, Any]) -> Settings:
        """Return settings with those of the look for arguments that are not given."""
        look = settings_of(self._look, self._plotter.renderers)
        given = {name: value for name, value in arguments.items() if value is not None}
        return Settings(**{**look, **given})

    def _require_window(self) -> None:
        if self._plotter.render_window is None:
            raise RuntimeError("the plotter is closed: enable passes before close() or show()")

    def enable_temporal_ssao(
        self, *, radius: float | None = None, tolerance: float = 0.01, strength: float = 1.0,
        kernel: str = "automatic",
    ) -> Any:
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
        check_radius(radius)
        check_range("tolerance", tolerance, 1e-4, 1.0)
        check_range("strength", strength, 0.0, 1.0)
        if not (kernel == "automatic" or vtkPenumbraKernels.Find(kernel) >= 0
                or vtkPenumbraOcclusionEstimator.IsRegistered(kernel)):
            raise ValueError(f"kernel must be 'automatic', 'traced' or a name of vtkPenumbraKernels, not {kernel!r}")
        self._require_window()
        require_opengl(self._plotter.render_window)
        occlusion = vtkPenumbraTemporalSSAOPass.AddTo(self._renderer)
        observe_warnings(occlusion)
        add(self._renderer, "occlusion", occlusion)
        occlusion.SetRadiusUnit(
            occlusion.FRACTION_OF_BOUNDS if radius is None else occlusion.WORLD)
        occlusion.SetRadius(0.1 if radius is None else radius)
        occlusion.SetTolerance(tolerance)
        occlusion.SetStrength(strength)
        occlusion.SetKernelName(kernel)
        self._plotter.render()
        return occlusion

    def disable_temporal_ssao(self) -> None:
        """Remove the pass added by ``enable_temporal_ssao``."""
        vtkPenumbraTemporalSSAOPass.RemoveFrom(self._renderer)
        remove(self._renderer, "occlusion")
        self._plotter.render()

    def enable_light_shafts(
        self, *, scattering: float | Sequence[float] | None = None, extinction: float | Sequence[float] | None = None,
        rayleigh: float = 0.0, scale_height: float = 0.0, base_height: float | None = None,
        up: Sequence[float] = (0.0, 0.0, 1.0), phase: str = "isotropic", asymmetry: float = 0.6,
        tolerance: float = 1.0 / 256.0, estimator: str = "depth", bounds: Sequence[float] | None = None,
    ) -> Any:
        """Add light shafts of all lights except headlights in a medium.

        Parameters
        ----------
        scattering, extinction : float or 3 floats, optional
            Coefficients per world unit, of all colors or of red, green and blue, >= 0. Default: a
            scattering optical depth of 0.25 over the diagonal of the bounds, without absorption.
        rayleigh : float
            Scattering coefficient of small particles in green, in addition; 0.43 of it in red, 2.44
            in blue: blue haze, red suns. Range: >= 0.
        scale_height, base_height, up
            The density falls off as ``exp(-(h - base_height) / scale_height)`` with the height h
            along ``up``; 0: uniform. Default of ``base_height``: the lowest point of the bounds.
        phase : {"isotropic", "rayleigh", "henyey-greenstein"}
            Phase function. ``asymmetry`` is the mean cosine of "henyey-greenstein"; range:
            [-0.999, 0.999].
        tolerance : float
            Accepted error of a color. Range: [1e-4, 1].
        estimator : {"depth", "shadow-map"}
            Shadows from the depth of the image, or from a shadow map of each light, which costs more
            and whose error follows ``tolerance``.
        bounds : 6 floats, optional
            Box of the medium, ``(x_min, x_max, y_min, y_max, z_min, z_max)``, in world units. Default: a box around the
            scene, three diagonals wide, so that the background stays visible; infinite bounds hide it.

        Returns the pass, a ``vtkPenumbraLightShaftPass``.
        """
        scattering_value, scattering_color = _split_coefficient("scattering", scattering)
        extinction_value, extinction_color = _split_coefficient("extinction", extinction)
        check_range("rayleigh", rayleigh, 0.0, 1e299)
        check_range("scale_height", scale_height, 0.0, 1e299)
        if len(up) != 3 or not numpy.linalg.norm(up) > 0.0:
            raise ValueError(f"up must be a vector that is not zero; it is {up}")
        check_choice("phase", phase, PHASES)
        check_range("asymmetry", asymmetry, -0.999, 0.999)
        check_range("tolerance", tolerance, 1e-4, 1.0)
        check_choice("estimator", estimator, tuple(ESTIMATORS))
        box = medium_bounds(self._renderer) if bounds is None else [float(bound) for bound in bounds]
        if len(box) != 6 or not all(low < high for low, high in zip(box[::2], box[1::2])):
            raise ValueError(f"bounds must be 6 numbers, each lower one below the upper one; they are {bounds}")
        self._require_window()
        require_opengl(self._plotter.render_window)
        shafts = vtkPenumbraLightShaftPass.AddTo(self._renderer)
        observe_warnings(shafts)
        add(self._renderer, "shafts", shafts)
        medium = shafts.GetMedium()
        medium.SetScattering(scattering_value)
        medium.SetScatteringColor(scattering_color)
        medium.SetExtinction(extinction_value)
        medium.SetExtinctionColor(extinction_color)
        medium.SetRayleighScattering(rayleigh)
        medium.SetScaleHeight(scale_height)
        medium.SetUp(up)
        medium.SetBaseHeight(_lowest_height(self._renderer, up) if base_height is None else base_height)
        medium.SetBounds(box)
        medium.SetPhase(PHASES.index(phase))
        medium.SetAsymmetry(asymmetry)
        shafts.SetTolerance(tolerance)
        shafts.SetEstimator(getattr(vtkPenumbraLightShaftPass, ESTIMATORS[estimator]))
        self._plotter.render()
        return shafts

    def disable_light_shafts(self) -> None:
        """Remove the pass added by ``enable_light_shafts``."""
        vtkPenumbraLightShaftPass.RemoveFrom(self._renderer)
        remove(self._renderer, "shafts")
        self._plotter.render()

    def look(self, name: str) -> PlotterAccessor:
        """Set the lights, the background and the effects of ``penumbra render --look``.

        The lights follow from the camera at the time of the call. Lights and background apply to all subplots, with
        OpenGL, too; effects are drawn by ``ray_cast``, ``screenshot`` and ``save_graphic`` unless their arguments say
        otherwise. Colors of meshes and the camera do not change.

        Parameters
        ----------
        name : {"plain", "studio", "outdoor", "figure", "clay"}
            "studio", "figure" and "clay" have ambient occlusion; "outdoor" has the sun with penumbrae and the light of
            the sky. "plain" restores the lights and the background before the first look.

        Returns the accessor, for chaining.
        """
        check_choice("name", name, NAMES)
        prepare_plotter(self._plotter)
        for renderer in self._plotter.renderers:
            if renderer not in self._restorers:
                self._restorers[renderer] = Restorer(renderer)
            self._restorers[renderer].apply(name)
        self._look = name
        return self

    def describe(self) -> str:
        """Return what ``ray_cast`` draws besides VTK's own shading, and the passes of the active renderer."""
        parts = [] if self._look == "plain" else [f"Look({self._look})"]
        settings = settings_of(self._look, self._plotter.renderers)
        found = {each.GetClassName(): each for each in passes_of(self._renderer)}
        occlusion = found.get("vtkPenumbraTemporalSSAOPass")
        if occlusion is not None:
            unit = " of the bounds" if occlusion.GetRadiusUnit() == occlusion.FRACTION_OF_BOUNDS else ""
            parts.append(f"AmbientOcclusion(radius={occlusion.GetRadius():g}{unit}, "
                         f"strength={occlusion.GetStrength():g}, tolerance={occlusion.GetTolerance():g})")
        elif "vtkSSAOPass" in found:  # of PyVista; rays take its radius
            parts.append(f"AmbientOcclusion(radius={found['vtkSSAOPass'].GetRadius():g}, "
                         f"strength={settings.get('strength', 1.0):g})")
        elif settings.get("ambient_occlusion"):
            strength = settings.get("strength")
            parts.append("AmbientOcclusion(rays only" + (f", strength={strength:g})" if strength else ")"))
        elif self._renderer.GetUseSSAO():
            parts.append(f"AmbientOcclusion(radius={self._renderer.GetSSAORadius():g}, strength=1)")
        if "vtkPenumbraLightShaftPass" in found:
            parts.append(f"LightShafts(tolerance={found['vtkPenumbraLightShaftPass'].GetTolerance():g})")
        if settings.get("shadows") or self._renderer.GetUseShadows() or "vtkShadowMapPass" in found:
            angle = settings.get("light_angle", 0.0)
            parts.append(f"Shadows(light_angle={angle:g})" if angle else "Shadows")
        if settings.get("indirect_light"):
            parts.append(f"IndirectLight(bounces={settings['bounces']})")
        return " + ".join(parts) or "no effects"

    def ray_cast(
        self, *, tolerance: float = 1.0 / 256.0, light_tolerance: float = 0.0,
        window_size: tuple[int, int] | None = None,
        ambient_occlusion: bool | None = None, radius: float | None = None, falloff: Falloff = "none",
        strength: float | None = None, shadows: bool | None = None, light_shafts: bool | None = None,
        light_radius: float = 0.0, light_angle: float | None = None, indirect_light: bool | None = None,
        environment_color: ColorLike | None = None, albedo: float = 0.5, bounces: int | None = None, cache: Cache = None,
        point_radius: float = 0.0, line_radius: float = 0.0, time_limit: float = 0.0,
        transparent_background: bool = False, as_float: bool = False, return_statistics: bool = False, scale: int | None = None,
        progress: Progress | None = None,
    ) -> Any:
        """Return an image of the plotter by ray casting, antialiased to a tolerance.

        Does not need a window or OpenGL. All subplots and widgets with a renderer are drawn. Effects that are enabled
        are drawn, by rays. The image is an array of rows from top to bottom, as returned by ``plotter.screenshot``:
        bytes, or unclamped colors with ``as_float``. With ``transparent_background``, the fourth channel is the covered
        fraction of each pixel.

        Parameters
        ----------
        tolerance : float
            Accepted RMSE over any 16x16 pixels, for colors in [0, 1], of what geometry and shading decide.
            Range: [1e-6, 1].
        light_tolerance : float
            Accepted RMSE that ambient occlusion, indirect light, penumbrae and light shafts add. Default: 0,
            2.56 times ``tolerance``. Range: [0, 1].
        window_size : tuple of int, optional
            Width and height in pixels. Default: the size of the plotter's window.
        ambient_occlusion, shadows, light_shafts : bool, optional
            Draw these effects. Default: those that are enabled: ``enable_temporal_ssao``, ``enable_light_shafts``,
            ``look``, and ``enable_ssao`` and ``enable_shadows`` of PyVista.
        radius, falloff, strength
            Ambient occlusion. The radius is in world units, default: that of the pass, else a tenth of the diagonal of
            the bounds. Falloff as in ``mesh.penumbra.bake_ambient_occlusion``.
        light_radius, light_angle : float
            Radius of positional lights in world units, and angular diameter of directional lights in degrees,
            [0, 180]. With ``shadows``, such lights cast penumbrae. 0: hard shadows. Default: those of the look, else 0.
        indirect_light : bool, optional
            If True, add the light of the environment and of diffuse interreflection. Default: that of the look.
        environment_color, albedo, bounces
            Parameters of indirect light, as in ``mesh.penumbra.bake_irradiance``. Default: those of the look, else
            black, 0.5 and 3.
        cache : {"world", "screen", "none"} or vtkPenumbraIrradianceProvider, optional
            Provider of ambient occlusion and indirect light, as in ``penumbra.render``.
        point_radius, line_radius : float
            Radius of the spheres that represent points, and of the tubes that represent lines and wireframes, in world
            units. Range: [0, 1e30]. Default: 0, as the plotter draws them.
        time_limit : float
            Time in seconds after which the work on a renderer ends with the best image so far. Default: 0, no limit.
        return_statistics : bool
            If True, return ``(image, statistics)``. The statistics include ``EstimatedError``, the
            estimated RMSE, and ``EstimatedLightError``, the part that light effects cause.
        scale : int, optional
            Factor of both sizes, of line widths and of point sizes. Default: ``plotter.image_scale``.
        progress : callable, optional
            Called with the completed fraction, from 0 to 1. An exception that it raises stops the rendering.

        Returns
        -------
        numpy.ndarray, shape (height, width, 3) or (height, width, 4), uint8 or float32
        """
        scale = self._scale(scale)
        settings = self._settings(dict(
            tolerance=tolerance, light_tolerance=light_tolerance, ambient_occlusion=ambient_occlusion, radius=radius,
            falloff=falloff, strength=strength, shadows=shadows, light_shafts=light_shafts,
            indirect_light=indirect_light, environment_color=environment_color, albedo=albedo, bounces=bounces,
            transparent_background=transparent_background, dpi=72 * scale, light_radius=light_radius,
            light_angle=light_angle, point_radius=point_radius, line_radius=line_radius, cache=cache,
            time_limit=time_limit))
        window = self._plotter.render_window
        if window is None:
            raise RuntimeError("the plotter is closed: call ray_cast() before close() or show()")
        width, height = self._size(window_size)
        prepare_plotter(self._plotter)
        collection = window.GetRenderers()
        renderers = [collection.GetItemAsObject(i) for i in range(collection.GetNumberOfItems())]
        canvas, statistics = cast_renderers(renderers, (scale * width, scale * height), settings, progress)
        image = finish(canvas, transparent_background, as_float)
        return (image, statistics) if return_statistics else image

    def screenshot(
        self, filename: str | pathlib.Path | io.BytesIO | bool | None = None, transparent_background: bool | None = None,
        return_img: bool = True, window_size: tuple[int, int] | None = None, scale: int | None = None,
        **options: Any,
    ) -> Image | None:
        """Take a screenshot by ray casting; a replacement of ``plotter.screenshot``.

        Parameters
        ----------
        filename : str, pathlib.Path or io.BytesIO, optional
            Where to write the image. Its suffix determines the format, default: PNG. A relative path is relative to
            ``pyvista.FIGURE_PATH`` if that is set. Default, and True as in PyVista: the image is not written.
        transparent_background : bool, optional
            If True, the image has a fourth channel, the covered fraction of each pixel. Default: that of the theme of
            the plotter.
        return_img : bool
            If True, return the image.
        window_size : tuple of int, optional
            Width and height in pixels, before they are multiplied by ``scale``. Default: the size of the plotter's
            window, which does not change.
        scale : int, optional
            Factor of both sizes, of line widths and of point sizes. Default: ``plotter.image_scale``.
        **options
            Options of ``ray_cast``, such as ``tolerance`` and ``shadows``.

        Returns
        -------
        numpy.ndarray, shape (height, width, 3) or (height, width, 4), uint8
            Rows from top to bottom; None with ``return_img=False``.

        Raises
        ------
        TypeError
            If an option is not one of ``ray_cast``, or is ``as_float`` or ``return_statistics``.
        ValueError
            If an option is out of range, or if the suffix of the file is not that of an image format.
        RuntimeError
            If the plotter is closed, or if the rendering fails.
        OSError
            If the file cannot be written.
        """
        for name in ("as_float", "return_statistics"):
            if name in options:
                raise TypeError(f"screenshot() writes and returns bytes: use ray_cast() for {name}")
        if transparent_background is None:
            transparent_background = bool(self._plotter.theme.transparent_background)
        image: Image = self.ray_cast(
            window_size=window_size, transparent_background=transparent_background, scale=scale, **options)
        if isinstance(filename, (str, pathlib.Path, io.BytesIO)):  # True writes nothing, as in PyVista
            _write(image, filename)
        return image if return_img else None

    def save_graphic(
        self, filename: str | pathlib.Path, *, outline_width: float = 0.0, outline_color: ColorLike = "black",
        maximum_paths: int = 50000, transparent_background: bool | None = None,
        window_size: tuple[int, int] | None = None, scale: int | None = None, return_statistics: bool = False,
        progress: Progress | None = None, **options: Any,
    ) -> dict[str, Any] | None:
        """Write a figure in vector graphics: SVG or PDF, with exact visibility and text that can be selected.

        A replacement of ``plotter.save_graphic``. Surfaces are visible triangles, or the ray-cast image if triangles
        cannot show them, as with shadows, textures, spheres or opacity, with a warning that says why. Text is text in
        both cases. One pixel of the window is one point, 1/72 inch. Does not need a window or OpenGL.

        Parameters
        ----------
        filename : str or pathlib.Path
            Where to write the figure; ends in ``.svg`` or ``.pdf``. A relative path is relative to
            ``pyvista.FIGURE_PATH`` if that is set.
        outline_width : float
            Width of the visible silhouettes, boundaries and creases in points. Range: [0, 1000]. Default: 0, none.
        outline_color : str or array_like of three floats in [0, 1]
            Color of the outlines.
        maximum_paths : int
            Surfaces that need more paths are an image. 0: always an image. Range: [0, 1000000].
        transparent_background : bool, optional
            If True, the figure has no background. Default: that of the theme of the plotter.
        window_size : tuple of int, optional
            Width and height in points. Default: the size of the plotter's window.
        scale : int, optional
            Pixels per point of the ray-cast image. Range: 1 to 64. Default: ``plotter.image_scale``, and at least 4, 288
            dpi, if the surfaces are an image.
        return_statistics : bool
            If True, return a dictionary of counts such as ``Vector/Faces``; ``Vector/ImageReason`` is the reason why
            the surfaces are an image, or empty.
        progress : callable, optional
            Called with the completed fraction, from 0 to 1. An exception that it raises stops the rendering.
        **options
            Options of ``ray_cast``, such as ``tolerance`` and ``shadows``.

        Raises
        ------
        TypeError
            If an option does not exist.
        ValueError
            If the suffix of the file is another one, or an option is out of range.
        NotImplementedError
            If the plotter has several subplots.
        RuntimeError
            If the plotter is closed, if the rendering fails, or if a font lacks a character of a text in PDF.
        OSError
            If the file cannot be written.

        Warns
        -----
        PenumbraWarning
            If the surfaces are an image although paths were asked for.
        """
        path = check_path(_in_figure_path(filename))
        check_options(options)
        window = self._plotter.render_window
        if window is None:
            raise RuntimeError("the plotter is closed: call save_graphic() before close() or show()")
        if transparent_background is None:
            transparent_background = bool(self._plotter.theme.transparent_background)
        width, height = self._size(window_size)
        prepare_plotter(self._plotter)

        def write(pixels_per_point: int, callback: Progress | None) -> dict[str, Any]:
            settings = self._settings(
                dict(transparent_background=transparent_background, dpi=72 * pixels_per_point, **options))
            return write_graphic(window, path, (pixels_per_point * width, pixels_per_point * height), settings,
                                 outline_width, outline_color, maximum_paths, callback)

        pixels_per_point = self._scale(scale)
        statistics = write(pixels_per_point, progress)
        if statistics["Vector/ImageReason"]:
            if scale is None and pixels_per_point < IMAGE_SCALE:
                pixels_per_point = IMAGE_SCALE
                statistics = write(pixels_per_point, None)
            if maximum_paths > 0:
                warn(f"the surfaces are an image of {72 * pixels_per_point} dpi, under text and lines that are vector "
                     f"graphics: {statistics['Vector/ImageReason']}. maximum_paths=0 asks for an image")
        return statistics if return_statistics else None


# Not a decorator: type checkers would see a class without attributes, because PyVista declares to return any type.
pyvista.register_plotter_component("penumbra")(PlotterAccessor)
