# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figures in vector graphics of a renderer."""
from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

from ._classes import vtkPenumbraVectorExporter
from .baking import ColorLike
from .conversion import check_integer, check_range, parse_color, statistics_dict
from .messages import Progress, run
from .rendering import Settings, make_caster

SUFFIXES = (".svg", ".pdf")
# Those are arguments of their own.
OPTIONS = {field.name for field in dataclasses.fields(Settings)} - {"transparent_background", "dpi"}


def check_path(path: pathlib.Path) -> pathlib.Path:
    if path.suffix.lower() not in SUFFIXES:
        raise ValueError(f"filename must end in {' or '.join(SUFFIXES)}; it is '{path}'")
    return path


def check_options(options: dict[str, Any]) -> None:
    for name in options:
        if name not in OPTIONS:
            raise TypeError(f"save_graphic() has no option {name!r}; these exist: {', '.join(sorted(OPTIONS))}")


def shown_renderer(window: Any) -> tuple[Any, bool]:
    """Return the renderer of the lowest layer of a window, and whether others are drawn over it."""
    collection = window.GetRenderers()
    renderers = [collection.GetItemAsObject(i) for i in range(collection.GetNumberOfItems())]
    shown = [renderer for renderer in renderers if renderer.GetDraw()]
    lowest = [renderer for renderer in shown if renderer.GetLayer() == min(each.GetLayer() for each in shown)]
    if len(lowest) != 1:
        raise NotImplementedError(
            f"save_graphic() writes plotters with one subplot; this one has {len(lowest)}: write each to a file")
    above = [renderer for renderer in shown if renderer is not lowest[0] and renderer.VisibleActorCount() > 0]
    return lowest[0], bool(above)


def write_graphic(
    window: Any, path: pathlib.Path, size: tuple[int, int], settings: Settings, outline_width: float,
    outline_color: ColorLike, maximum_paths: int, progress: Progress | None,
) -> dict[str, Any]:
    """Write a figure of the renderer of a window and return statistics."""
    renderer, layers = shown_renderer(window)
    renderer.InvokeEvent("StartEvent")  # axes widgets copy the camera of the scene then
    caster, ignored = make_caster(renderer, size, settings)
    caster.SetBackground(not settings.transparent_background)
    caster.SetLayers(layers)
    exporter = vtkPenumbraVectorExporter()
    exporter.SetRayCaster(caster)
    exporter.SetFileName(str(path))
    exporter.SetOutlineWidth(check_range("outline_width", outline_width, 0.0, 1000.0))
    exporter.SetOutlineColor(parse_color("outline_color", outline_color, 1.0))
    exporter.SetMaximumPaths(check_integer("maximum_paths", maximum_paths, 0, 1000000))
    try:
        run(exporter.Write, caster, progress, 3, ignored)
    except RuntimeError as error:
        if "cannot be written" in str(error):
            raise OSError(str(error)) from None
        raise
    return {**statistics_dict(caster), **statistics_dict(exporter), "EstimatedError": caster.GetEstimatedError(),
            "Vector/ImageReason": exporter.GetImageReason()}
