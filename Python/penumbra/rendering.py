# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ray-cast images of meshes, renderers, windows and plotters as NumPy arrays."""
from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from ._backend import vtk_module
from ._classes import vtkPenumbraIrradianceCache, vtkPenumbraMedium, vtkPenumbraRayCaster
from .baking import ColorLike, Falloff, needed_bounces
from .conversion import (FALLOFFS, check_choice, check_integer, check_radius, check_range, check_size, colors_of,
                         mesh_arrays, parse_color, poly_data, statistics_dict, to_bytes)
from .messages import Progress, update, warn
from .passes import medium_bounds, passes_of

Image = npt.NDArray[Any]
Camera = Any

# The words of --cache of the program, or a vtkPenumbraIrradianceProvider.
Cache = Literal["world", "screen", "none"] | Any
CACHES = ("world", "screen", "none")

# Render passes that show something that rays do not draw.
NOT_DRAWN = {
    "vtkEDLShading": "eye-dome lighting",
    "vtkDepthOfFieldPass": "depth of field",
    "vtkGaussianBlurPass": "blur",
    "vtkToneMappingPass": "tone mapping",
    "vtkOutlineGlowPass": "outlines",
}

ANTIALIASING = ("vtkSSAAPass", "vtkOpenGLFXAAPass")

# What the ray caster says of the settings of a renderer that _follow_renderer and _follow_passes follow.
PASS_IGNORED = "The render pass of the renderer is ignored"
SETTINGS_IGNORED = ("Screen-space ambient occlusion of the renderer is replaced by ray-cast ambient occlusion",)


@dataclasses.dataclass
class Settings:
    """What is drawn; None means what the renderer shows."""

    tolerance: float = 1.0 / 256.0
    light_tolerance: float = 0.0
    ambient_occlusion: bool | None = None
    radius: float | None = None
    falloff: str = "none"
    strength: float | None = None
    shadows: bool | None = None
    light_shafts: bool | None = None
    indirect_light: bool = False
    environment_color: Any = "black"
    albedo: float = 0.5
    bounces: int = 3
    transparent_background: bool = False
    dpi: int = 72
    light_radius: float = 0.0
    light_angle: float = 0.0
    point_radius: float = 0.0
    line_radius: float = 0.0
    cache: Any = None
    time_limit: float = 0.0

    def __post_init__(self) -> None:
        check_range("tolerance", self.tolerance, 1e-6, 1.0)
        check_range("light_tolerance", self.light_tolerance, 0.0, 1.0)
        check_range("time_limit", self.time_limit, 0.0, float("inf"))
        check_radius(self.radius)
        check_choice("falloff", self.falloff, FALLOFFS)
        if self.strength is not None:
            check_range("strength", self.strength, 0.0, 1.0)
        self.environment_color = parse_color("environment_color", self.environment_color)
        check_range("albedo", self.albedo, 0.0, 1.0)
        # Lights may be much brighter than white.
        brightest = max(1.0, *self.environment_color)
        self.bounces = needed_bounces(
            check_integer("bounces", self.bounces, 1, 64), self.albedo, 0.01 * self.tolerance / brightest)
        check_range("light_radius", self.light_radius, 0.0, 1e30)
        check_range("light_angle", self.light_angle, 0.0, 180.0)
        check_range("point_radius", self.point_radius, 0.0, 1e30)
        check_range("line_radius", self.line_radius, 0.0, 1e30)
        if self.cache is not None and not hasattr(self.cache, "IsA"):
            check_choice("cache", self.cache, CACHES)
        elif self.cache is not None and not self.cache.IsA("vtkPenumbraIrradianceProvider"):
            raise TypeError("cache must be 'world', 'screen', 'none' or a vtkPenumbraIrradianceProvider, not a "
                            f"{self.cache.GetClassName()}")


def _make_provider(cache: Any, automatic: bool) -> Any:
    """Return a provider of ambient occlusion and indirect light, None for the default of the ray caster.

    `automatic` lets the default, None, choose between records and joined pixels.
    """
    if cache is None and automatic:
        records = vtkPenumbraIrradianceCache()
        records.JoinPixelsOn()
        return records
    if cache in ("world", "screen"):
        records = vtkPenumbraIrradianceCache()
        records.SetSpace(records.SCREEN if cache == "screen" else records.WORLD)
        return records
    return None if cache == "none" else cache


def _diagonal(renderer: Any) -> float:
    bounds = np.array(renderer.ComputeVisiblePropBounds()).reshape(3, 2)
    return float(np.linalg.norm(bounds[:, 1] - bounds[:, 0]))


def _follow_occlusion(caster: Any, renderer: Any, render_pass: Any, settings: Settings) -> None:
    """Set the radius and the strength of a pass that computes ambient occlusion."""
    radius = settings.radius
    if render_pass.IsA("vtkSSAOPass"):
        own, strength = render_pass.GetRadius(), 1.0
    else:
        own, strength = render_pass.GetRadius(), render_pass.GetStrength()
        if render_pass.GetRadiusUnit() == render_pass.FRACTION_OF_BOUNDS:
            own *= _diagonal(renderer)
        elif render_pass.GetRadiusUnit() == render_pass.PIXELS and radius is None:
            warn("the radius of the ambient occlusion is in pixels, which rays do not know: a tenth of the bounds is "
                 "used instead; pass radius in world units", stacklevel=6)
            own = 0.0
    caster.SetAmbientOcclusion(True)
    caster.SetAmbientOcclusionRadius(own if radius is None else check_radius(radius))
    caster.SetAmbientOcclusionStrength(strength if settings.strength is None else settings.strength)


def _follow_passes(caster: Any, renderer: Any, settings: Settings) -> bool:
    """Draw what the render passes draw, or warn. Return True if there are passes other than VTK's plain ones."""
    found = 0
    for render_pass in passes_of(renderer):
        name = render_pass.GetClassName()
        found += 1
        if render_pass.IsA("vtkPenumbraTemporalSSAOPass") or render_pass.IsA("vtkSSAOPass"):
            if settings.ambient_occlusion is None:
                _follow_occlusion(caster, renderer, render_pass, settings)
        elif render_pass.IsA("vtkPenumbraLightShaftPass"):
            if settings.light_shafts is None:
                caster.SetMedium(render_pass.GetMedium())
        elif render_pass.IsA("vtkShadowMapPass"):
            if settings.shadows is None:
                caster.SetShadows(True)
        elif name in ANTIALIASING:
            pass  # rays antialias anyway
        elif name in NOT_DRAWN:
            warn(f"rays do not draw {NOT_DRAWN[name]} ({name})", stacklevel=5)
        else:
            found -= 1
    return found > 0


def _warn_of_environment(renderer: Any) -> None:
    """Warn if VTK converts the colors of the environment texture, which the ray caster cannot know."""
    if renderer.GetUseImageBasedLighting() and hasattr(renderer, "GetEnvMapPrefiltered"):
        if renderer.GetEnvMapPrefiltered().GetConvertToLinear():
            warn("rays take the colors of the environment texture as linear: set UseSRGBColorSpace of the texture "
                 "instead of is_srgb=True", stacklevel=5)


def make_caster(renderer: Any, size: tuple[int, int], settings: Settings) -> tuple[Any, tuple[str, ...]]:
    """Return a ray caster that draws a renderer, and the warnings of it that do not apply."""
    caster = vtkPenumbraRayCaster()
    caster.SetRenderer(renderer)
    caster.SetResolution(*size)
    caster.SetTolerance(settings.tolerance)
    caster.SetLightTolerance(settings.light_tolerance)
    caster.SetTimeLimit(settings.time_limit)
    if settings.shadows is not None:
        caster.SetShadows(bool(settings.shadows))
    caster.SetLightRadius(settings.light_radius)
    caster.SetLightAngle(settings.light_angle)
    if settings.ambient_occlusion is not None:
        caster.SetAmbientOcclusion(bool(settings.ambient_occlusion))
    caster.SetAmbientOcclusionRadius(check_radius(settings.radius))
    caster.SetAmbientOcclusionFalloff(FALLOFFS.index(settings.falloff))
    caster.SetAmbientOcclusionStrength(-1.0 if settings.strength is None else settings.strength)
    if settings.light_shafts:
        medium = vtkPenumbraMedium()
        medium.SetBounds(medium_bounds(renderer))
        caster.SetMedium(medium)
    caster.SetIndirectLight(bool(settings.indirect_light))
    caster.SetEnvironmentColor(settings.environment_color)
    caster.SetAlbedo(settings.albedo)
    caster.SetBounces(settings.bounces)
    # Only joined pixels end at a time limit, and both quantities are joined if one is.
    automatic = settings.indirect_light and not caster.GetAmbientOcclusion() and settings.time_limit == 0.0
    caster.SetIrradianceProvider(_make_provider(settings.cache, automatic))
    caster.SetDPI(settings.dpi)
    caster.SetLayers(False)  # cast_renderers draws all renderers, with the effects of each
    caster.SetPointRadius(settings.point_radius)
    caster.SetLineRadius(settings.line_radius)
    _warn_of_environment(renderer)
    follows = _follow_passes(caster, renderer, settings)
    return caster, (PASS_IGNORED, *SETTINGS_IGNORED) if follows else SETTINGS_IGNORED


def _add(total: dict[str, Any], counts: dict[str, Any]) -> None:
    for name, value in counts.items():
        total[name] = total.get(name, 0) + value if isinstance(value, (int, float)) else value


def _progress_of_part(progress: Progress | None, index: int, parts: int) -> Progress | None:
    """Return the callback of one of several parts of equal length."""
    return None if progress is None else lambda fraction: progress((index + fraction) / parts)


def cast_renderers(
    renderers: Sequence[Any], size: tuple[int, int], settings: Settings, progress: Progress | None,
    stacklevel: int = 3,
) -> tuple[Image, dict[str, Any]]:
    """Return an image of the renderers of a window with four floats a pixel, and statistics."""
    width, height = size
    canvas = np.zeros((height, width, 4), np.float32)
    total: dict[str, Any] = {}
    squares = light_squares = 0.0
    shown = sorted((renderer for renderer in renderers if renderer.GetDraw()), key=lambda item: item.GetLayer())
    for index, renderer in enumerate(shown):
        left, bottom, right, top = renderer.GetViewport()
        # The rounding of vtkViewport, not that of Python, which rounds halves to even numbers.
        columns = slice(int(left * width + 0.5), int(right * width + 0.5))
        rows = slice(height - int(top * height + 0.5), height - int(bottom * height + 0.5))
        part = (columns.stop - columns.start, rows.stop - rows.start)
        if min(part) < 1:
            continue
        renderer.InvokeEvent("StartEvent")  # axes widgets copy the camera of the scene then
        caster, ignored = make_caster(renderer, part, settings)
        opaque = renderer.GetLayer() == 0 and not settings.transparent_background
        caster.SetBackground(opaque)
        update(caster, _progress_of_part(progress, index, len(shown)), stacklevel, ignored)
        colors = colors_of(caster.GetOutput(), 4)
        below = canvas[rows, columns]
        alpha = colors[..., 3:]
        if opaque or renderer.GetLayer() == 0:
            canvas[rows, columns] = colors
        else:
            covered = alpha + below[..., 3:] * (1.0 - alpha)
            mixed = colors[..., :3] * alpha + below[..., :3] * below[..., 3:] * (1.0 - alpha)
            below[..., :3] = np.divide(mixed, covered, out=np.zeros_like(mixed), where=covered > 0.0)
            below[..., 3:] = covered
        _add(total, statistics_dict(caster))
        if np.isfinite(caster.GetEstimatedError()):
            squares += caster.GetEstimatedError() ** 2 * part[0] * part[1]
            light_squares += caster.GetEstimatedLightError() ** 2 * part[0] * part[1]
    if "Rays/Total" in total:
        total["Rays/PerPixel"] = total["Rays/Total"] / (width * height)
    total["EstimatedError"] = float(np.sqrt(squares / (width * height)))
    total["EstimatedLightError"] = float(np.sqrt(light_squares / (width * height)))
    return canvas, total


def finish(canvas: Image, transparent_background: bool, as_float: bool) -> Image:
    image = canvas if transparent_background else canvas[..., :3]
    return np.ascontiguousarray(image) if as_float else to_bytes(image)


def _set_camera(renderer: Any, camera: Camera, radius: float = 0.0) -> None:
    """Set the camera of a renderer whose points and lines have a radius, which VTK's bounds do not contain."""
    bounds = np.array(renderer.ComputeVisiblePropBounds())
    if vtk_module("vtkCommonCore").vtkMath.AreBoundsInitialized(bounds):
        bounds += np.array([-radius, radius] * 3)
    if hasattr(camera, "IsA") and camera.IsA("vtkCamera"):
        renderer.SetActiveCamera(camera)
        return
    view = renderer.GetActiveCamera()
    if camera is None:
        view.SetPosition(1.0, 1.0, 1.0)
        view.SetFocalPoint(0.0, 0.0, 0.0)
        view.SetViewUp(0.0, 0.0, 1.0)
        renderer.ResetCamera(bounds)
        return
    try:
        vectors = np.asarray(camera, float)
        if vectors.shape != (3, 3):
            raise ValueError
        position, focal_point, view_up = vectors.tolist()
        view.SetPosition(position)
        view.SetFocalPoint(focal_point)
        view.SetViewUp(view_up)
    except (TypeError, ValueError):
        raise ValueError("camera must be three points, (position, focal_point, view_up), or a vtkCamera, "
                         f"not {camera!r}") from None
    renderer.ResetCameraClippingRange(bounds)


def renderer_of_mesh(mesh: Any, color: ColorLike, camera: Camera, radius: float = 0.0) -> Any:
    """Return a renderer with one mesh and a headlight."""
    core = vtk_module("vtkRenderingCore")
    if mesh.IsA("vtkCompositeDataSet"):
        mapper = core.vtkCompositePolyDataMapper()
        surfaces = vtk_module("vtkFiltersGeometry").vtkGeometryFilter()
        surfaces.SetInputDataObject(mesh)
        mapper.SetInputConnection(surfaces.GetOutputPort())
    else:
        mapper = core.vtkPolyDataMapper() if mesh.IsA("vtkPolyData") else core.vtkDataSetMapper()
        mapper.SetInputDataObject(mesh)
    mapper.ScalarVisibilityOff()
    actor = core.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(parse_color("color", color, 1.0))
    renderer = core.vtkRenderer()
    renderer.AddActor(actor)
    _set_camera(renderer, camera, radius)
    return renderer


def _resolve(
    scene: Any, size: Any, color: ColorLike, camera: Camera, point_radius: float, line_radius: float,
) -> tuple[list[Any], tuple[int, int]]:
    """Return the renderers of a scene and the size of the image."""
    pixels = check_size("window_size", (1024, 768) if size is None else size)
    if not hasattr(scene, "IsA") and (found := mesh_arrays(scene)) is not None:
        return _resolve(found, size, color, camera, point_radius, line_radius)
    if hasattr(scene, "render_window") and hasattr(scene, "renderers"):  # a PyVista plotter
        prepare_plotter(scene)
        window = scene.render_window
        if window is None:
            raise RuntimeError("the plotter is closed: render it before close() or show()")
    elif hasattr(scene, "IsA"):
        window = scene if scene.IsA("vtkRenderWindow") else None
        if scene.IsA("vtkDataObject"):
            radius = max(point_radius, line_radius)
            return [renderer_of_mesh(scene, color, camera, radius)], pixels
        if scene.IsA("vtkRenderer"):
            if camera is not None:
                _set_camera(scene, camera)
            return [scene], pixels
    elif isinstance(scene, tuple) and len(scene) in (2, 3):
        arrays: tuple[Any, ...] = (*scene, None)
        points, faces, lines = arrays[:3]
        mesh = poly_data(points, faces, None, lines, point_radius > 0.0)
        radius = max(point_radius if mesh.GetNumberOfVerts() else 0.0, line_radius if mesh.GetNumberOfLines() else 0.0)
        return [renderer_of_mesh(mesh, color, camera, radius)], pixels
    else:
        window = None
    if window is None:
        raise TypeError("scene must be a mesh, (points, faces), (points, faces, lines), a vtkRenderer, a "
                        f"vtkRenderWindow or a PyVista plotter, not {type(scene).__name__}")
    if camera is not None:
        raise ValueError("camera applies to meshes and renderers; set that of the plotter instead")
    collection = window.GetRenderers()
    renderers = [collection.GetItemAsObject(i) for i in range(collection.GetNumberOfItems())]
    return renderers, check_size("window_size", window.GetSize()) if size is None else pixels


def prepare_plotter(plotter: Any) -> None:
    """Place the cameras that have no position yet where the first ``show`` of a plotter places them."""
    if not getattr(plotter, "_first_time", False):
        return
    for renderer in plotter.renderers:
        if not renderer.camera.is_set:
            renderer.camera_position = renderer.get_default_cam_pos()
            renderer.ResetCamera()
            renderer.camera.is_set = False  # ``show`` places it again, if meshes are added until then


@overload
def render(
    scene: Any, *, window_size: tuple[int, int] | None = None, camera: Camera = None, color: ColorLike = "white",
    tolerance: float = 1.0 / 256.0, light_tolerance: float = 0.0, ambient_occlusion: bool | None = None,
    radius: float | None = None, falloff: Falloff = "none", strength: float | None = None, shadows: bool | None = None,
    light_shafts: bool | None = None, light_radius: float = 0.0, light_angle: float = 0.0,
    indirect_light: bool = False, environment_color: ColorLike = "black", albedo: float = 0.5, bounces: int = 3,
    cache: Cache = None, point_radius: float = 0.0, line_radius: float = 0.0, time_limit: float = 0.0,
    transparent_background: bool = False, as_float: bool = False, progress: Progress | None = None,
    return_statistics: Literal[False] = False,
) -> Image: ...


@overload
def render(
    scene: Any, *, window_size: tuple[int, int] | None = None, camera: Camera = None, color: ColorLike = "white",
    tolerance: float = 1.0 / 256.0, light_tolerance: float = 0.0, ambient_occlusion: bool | None = None,
    radius: float | None = None, falloff: Falloff = "none", strength: float | None = None, shadows: bool | None = None,
    light_shafts: bool | None = None, light_radius: float = 0.0, light_angle: float = 0.0,
    indirect_light: bool = False, environment_color: ColorLike = "black", albedo: float = 0.5, bounces: int = 3,
    cache: Cache = None, point_radius: float = 0.0, line_radius: float = 0.0, time_limit: float = 0.0,
    transparent_background: bool = False, as_float: bool = False, progress: Progress | None = None,
    return_statistics: Literal[True],
) -> tuple[Image, dict[str, Any]]: ...


def render(
    scene: Any, *, window_size: tuple[int, int] | None = None, camera: Camera = None, color: ColorLike = "white",
    tolerance: float = 1.0 / 256.0, light_tolerance: float = 0.0, ambient_occlusion: bool | None = None,
    radius: float | None = None, falloff: Falloff = "none", strength: float | None = None, shadows: bool | None = None,
    light_shafts: bool | None = None, light_radius: float = 0.0, light_angle: float = 0.0,
    indirect_light: bool = False, environment_color: ColorLike = "black", albedo: float = 0.5, bounces: int = 3,
    cache: Cache = None, point_radius: float = 0.0, line_radius: float = 0.0, time_limit: float = 0.0,
    transparent_background: bool = False, as_float: bool = False, progress: Progress | None = None,
    return_statistics: bool = False,
) -> Image | tuple[Image, dict[str, Any]]:
    """Render an image by ray casting, antialiased to a tolerance.

    No window, display or OpenGL is used. The image has the same bits for any number of threads; between instruction
    sets, single pixels may differ.

    Parameters
    ----------
    scene : mesh, (points, faces), (points, faces, lines), vtkRenderer, vtkRenderWindow or pyvista.Plotter
        What to render. A mesh is any vtkDataSet or composite data set, a mesh of trimesh, triangles and quads of
        meshio, or arrays as in `ambient_occlusion`, of which
        faces and lines may be None; it gets a headlight, which casts no shadows, and one color. All renderers of a
        window or plotter are drawn in their viewports.
    window_size : tuple of int, optional
        Width and height in pixels. Range: 1 to 65535. Default: the size of the window, else 1024 by 768.
    camera : (position, focal_point, view_up) or vtkCamera, optional
        Camera of a mesh or renderer, in world coordinates. Default: that of the renderer; a mesh is seen from
        (1, 1, 1) with z up.
    color : str or array_like of three floats in [0, 1]
        Color of a mesh.
    tolerance : float
        Accepted RMSE of any 16 by 16 pixels, for colors in [0, 1], of what geometry and shading decide.
        Range: [1e-6, 1].
    light_tolerance : float
        Accepted RMSE that ambient occlusion, indirect light, penumbrae and light shafts add. Default: 0, 2.56 times
        `tolerance`. Range: [0, 1].
    ambient_occlusion, shadows, light_shafts : bool, optional
        Draw these effects. Default: those that the render passes of the renderer draw.
    radius : float, optional
        Radius of the ambient occlusion, in world units. Range: > 0. Default: that of the pass, else a tenth of the
        diagonal of the bounds.
    falloff : {"none", "linear", "quadratic", "square-root"}
        As in `ambient_occlusion`.
    strength : float, optional
        Colors are multiplied by 1 - strength * occlusion. Range: [0, 1]. Default: that of the pass, else 1, and 0.6 on
        surfaces that are colored by scalars.
    light_radius : float
        Radius of positional lights, in world units. With `shadows`, such lights cast penumbrae. Range: [0, 1e30].
        Default: 0, hard shadows.
    light_angle : float
        Angular diameter of directional lights, in degrees; that of the sun is 0.53. Range: [0, 180]. Default: 0, hard
        shadows.
    indirect_light : bool
        Add the light of the environment and of diffuse interreflection.
    environment_color, albedo, bounces
        As in `irradiance`.
    cache : {"world", "screen", "none"} or vtkPenumbraIrradianceProvider, optional
        Provider of ambient occlusion and indirect light. "world" or "screen": interpolated between records in world
        space or over the image; "none": rays, which neighboring pixels share. None, the default: "none", but "world"
        for indirect light without ambient occlusion and time limit if few records are enough, as in rooms.
    point_radius : float
        Radius of the spheres that represent points, in world units. Range: [0, 1e30]. Default: 0, points have their
        size in pixels.
    line_radius : float
        Radius of the tubes that represent lines and wireframes, in world units. Range: [0, 1e30]. Default: 0, lines
        have their width in pixels.
    time_limit : float
        Time in seconds after which the work on a renderer ends with the best image so far. Range: >= 0. Default: 0, no
        limit.
    transparent_background : bool
        If True, the image has a fourth channel, the covered fraction of each pixel.
    as_float : bool
        If True, return float32 without clamping instead of bytes.
    progress : callable, optional
        Called with the completed fraction, from 0 to 1. An exception that it raises stops the rendering.
    return_statistics : bool
        If True, return ``(image, statistics)``. The statistics are a dictionary of counts such as ``Rays/PerPixel``,
        with ``EstimatedError``, the estimated RMSE, and ``EstimatedLightError``, the part that light effects cause.

    Returns
    -------
    numpy.ndarray, shape (height, width, 3) or (height, width, 4), uint8 or float32
        Rows from top to bottom.

    Raises
    ------
    TypeError
        If the scene is none of these, or an argument has another type.
    ValueError
        If an argument is out of range, or if coordinates are not finite.
    IndexError
        If a face or a line refers to a point that does not exist.
    RuntimeError
        If the rendering fails.
    KeyboardInterrupt
        On Ctrl-C in the main thread.

    Warns
    -----
    PenumbraWarning
        If the scene has something that rays do not draw, or if the tolerance is not met.

    Examples
    --------
    >>> import penumbra
    >>> points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    >>> penumbra.render((points, faces), window_size=(320, 240), ambient_occlusion=True).shape
    (240, 320, 3)
    """
    settings = Settings(
        tolerance, light_tolerance, ambient_occlusion, radius, falloff, strength, shadows, light_shafts, indirect_light,
        environment_color, albedo, bounces, transparent_background, 72, light_radius, light_angle, point_radius,
        line_radius, cache, time_limit)
    renderers, pixels = _resolve(scene, window_size, color, camera, point_radius, line_radius)
    canvas, statistics = cast_renderers(renderers, pixels, settings, progress)
    image = finish(canvas, transparent_background, as_float)
    return (image, statistics) if return_statistics else image
