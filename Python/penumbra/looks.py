# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Looks of plotters: the lights, background and effects of ``penumbra render --look``."""
from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._backend import vtk_module
from .passes import passes_of

Vector = npt.NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Look:
    """Lights are azimuth and elevation relative to the camera in degrees, and color, as in LookOptions.cxx."""

    lights: Sequence[tuple[float, float, tuple[float, float, float]]]
    background: tuple[float, float, float]
    settings: dict[str, Any]


LOOKS = {
    "studio": Look(
        [(-35.0, 40.0, (0.87, 0.86, 0.84)), (45.0, 8.0, (0.28, 0.30, 0.33)), (165.0, 35.0, (0.25, 0.25, 0.25))],
        (0.89, 0.90, 0.92), {"ambient_occlusion": True, "strength": 0.85}),
    "outdoor": Look(
        [(-35.0, 42.0, (0.82, 0.76, 0.67))], (0.74, 0.83, 0.92),
        {"shadows": True, "light_angle": 3.0, "indirect_light": True, "environment_color": (0.32, 0.42, 0.58),
         "bounces": 2}),
    "figure": Look(
        [(-30.0, 35.0, (0.82, 0.82, 0.82)), (35.0, 5.0, (0.33, 0.33, 0.33))], (1.0, 1.0, 1.0),
        {"ambient_occlusion": True, "strength": 0.7}),
    "clay": Look(
        [(-30.0, 40.0, (0.98, 0.97, 0.95)), (50.0, 5.0, (0.32, 0.33, 0.35))], (0.93, 0.92, 0.90),
        {"ambient_occlusion": True, "strength": 1.0}),
}
NAMES = ("plain", *LOOKS)


def _frame(camera: Any) -> tuple[Vector, Vector, Vector]:
    """Return the up direction, the direction to the camera perpendicular to it, and that to its right."""
    up = np.array(camera.GetViewUp())
    up /= np.linalg.norm(up)
    front = -np.array(camera.GetDirectionOfProjection())
    front -= front.dot(up) * up
    if np.linalg.norm(front) < 0.1:  # the camera looks along the up direction
        front = np.array((0.0, -1.0, 0.0)) + up[1] * up
    if np.linalg.norm(front) < 0.1:
        front = np.array((0.0, 0.0, 1.0))
    front /= np.linalg.norm(front)
    return up, front, np.cross(up, front)


def _colors_data(renderer: Any) -> bool:
    """Return True if a mesh is colored by scalars, which keep the default strength of ambient occlusion."""
    actors = renderer.GetActors()
    mappers = [actors.GetItemAsObject(i).GetMapper() for i in range(actors.GetNumberOfItems())]
    return any(mapper is not None and mapper.GetScalarVisibility() for mapper in mappers)


def settings_of(name: str, renderers: Sequence[Any]) -> dict[str, Any]:
    """Return the arguments of ``ray_cast`` that a look sets."""
    settings = dict(LOOKS[name].settings) if name in LOOKS else {}
    if any(each.IsA("vtkPenumbraTemporalSSAOPass") for renderer in renderers for each in passes_of(renderer)):
        settings.pop("ambient_occlusion", None)  # that of the pass, with its radius and strength
        settings.pop("strength", None)
    if any(_colors_data(renderer) for renderer in renderers):
        settings.pop("strength", None)
    return settings


class Restorer:
    """Applies looks to a renderer, and keeps the lights and the background that it had before the first one."""

    def __init__(self, renderer: Any) -> None:
        lights = renderer.GetLights()
        self.renderer = renderer
        self.lights = [lights.GetItemAsObject(i) for i in range(lights.GetNumberOfItems())]
        self.background = (renderer.GetBackground(), renderer.GetBackground2(), renderer.GetGradientBackground())

    def _set_lights(self, lights: Sequence[Any]) -> None:
        self.renderer.RemoveAllLights()
        for light in lights:
            self.renderer.AddLight(light)

    def apply(self, name: str) -> None:
        if name not in LOOKS:
            self._set_lights(self.lights)
            first, second, gradient = self.background
            self.renderer.SetBackground(first)
            self.renderer.SetBackground2(second)
            self.renderer.SetGradientBackground(gradient)
            return
        up, front, right = _frame(self.renderer.GetActiveCamera())
        lights = []
        for azimuth, elevation, color in LOOKS[name].lights:
            a, e = np.radians((azimuth, elevation))
            light = vtk_module("vtkRenderingCore").vtkLight()
            light.SetLightTypeToSceneLight()
            light.SetPosition((np.sin(e) * up + np.cos(e) * (np.cos(a) * front + np.sin(a) * right)).tolist())
            light.SetFocalPoint(0.0, 0.0, 0.0)
            light.SetColor(color)
            lights.append(light)
        self._set_lights(lights)
        self.renderer.SetBackground(LOOKS[name].background)
        self.renderer.SetGradientBackground(False)
