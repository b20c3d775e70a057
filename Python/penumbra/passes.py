# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Render passes of a renderer, and those that this package added to it."""
from __future__ import annotations

import math
import weakref
from collections.abc import Iterator
from typing import Any

from ._backend import vtk_module
from ._classes import vtkPenumbraLightShaftPass, vtkPenumbraTemporalSSAOPass
from .messages import warn

# Passes that this package added to renderers, whose own passes they are parts of, and the passes that were found then.
added_passes: weakref.WeakKeyDictionary[Any, dict[str, Any]] = weakref.WeakKeyDictionary()
_chains: weakref.WeakKeyDictionary[Any, list[Any]] = weakref.WeakKeyDictionary()
# The camera pass that vtkPenumbra...Pass.AddTo() made for a renderer without passes, and the passes in those added.
_steps: weakref.WeakKeyDictionary[Any, tuple[Any, dict[str, Any]]] = weakref.WeakKeyDictionary()
ORDER = ("shafts", "occlusion")  # outermost first


def _chain(render_pass: Any) -> Iterator[Any]:
    """Iterate over a pass and those inside, outermost first."""
    waiting = [render_pass]
    while waiting:
        current = waiting.pop(0)
        if current is None:
            continue
        yield current
        if current.IsA("vtkSequencePass") and current.GetPasses():
            passes = current.GetPasses()
            waiting += [passes.GetItemAsObject(i) for i in range(passes.GetNumberOfItems())]
        if hasattr(current, "GetDelegatePass"):
            waiting.append(current.GetDelegatePass())


def passes_of(renderer: Any) -> Iterator[Any]:
    """Iterate over the render passes of a renderer, outermost first.

    AddTo() inserts passes into render steps that Python cannot see through; FindIn() finds them there.
    """
    seen = set()
    inner = [found for each in (vtkPenumbraLightShaftPass, vtkPenumbraTemporalSSAOPass)
             if (found := each.FindIn(renderer)) is not None]
    for outer in (renderer.GetPass(), *added_passes.get(renderer, {}).values(), *inner):
        for render_pass in _chain(outer):
            if id(render_pass) not in seen:
                seen.add(id(render_pass))
                yield render_pass


def medium_bounds(renderer: Any) -> list[float]:
    """Return a box three diagonals of the visible bounds wide, the default extent of a medium.

    It contains what a camera sees that is placed as usual. Behind it, the background is visible: an infinite medium would
    hide it.
    """
    bounds = renderer.ComputeVisiblePropBounds()
    if bounds[0] > bounds[1]:
        return [-math.inf, math.inf] * 3
    half = 1.5 * math.dist(bounds[::2], bounds[1::2])
    centers = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    return [center + side for center in centers for side in (-half, half)]


def _is_image_pass(render_pass: Any) -> bool:
    return render_pass is not None and (render_pass.IsA("vtkImageProcessingPass") or render_pass.IsA("vtkSSAAPass"))


def _insert(renderer: Any, added: Any) -> None:
    """Insert a pass below the other passes that process the image."""
    outer, inner = None, renderer.GetPass()
    while _is_image_pass(inner):
        outer, inner = inner, inner.GetDelegatePass()
    if inner is None:  # what a renderer without passes draws
        opengl = vtk_module("vtkRenderingOpenGL2")
        inner = opengl.vtkCameraPass()
        inner.SetDelegatePass(opengl.vtkRenderStepsPass())
    added.SetDelegatePass(inner)
    added.SetOpaqueOnly(False)
    (outer.SetDelegatePass if outer else renderer.SetPass)(added)


def _restore(renderer: Any) -> bool:
    """Restore the passes that AddTo() made, if they are known."""
    added = added_passes[renderer]
    camera, delegates = _steps.get(renderer, (None, {}))
    if camera is None or delegates.keys() != added.keys():
        return False
    for name, delegate in delegates.items():
        added[name].SetDelegatePass(delegate)
        added[name].OpaqueOnlyOn()
    renderer.SetPass(camera)
    return True


def _keep(renderer: Any, event: str) -> None:
    """Insert the added passes again if others have replaced them, as PyVista does when it enables or disables one."""
    added = added_passes.get(renderer, {})
    chain = list(_chain(renderer.GetPass()))
    if not added or chain == _chains.get(renderer):
        return
    if "occlusion" in added and any(each.IsA("vtkSSAOPass") for each in chain):
        added.pop("occlusion")
        warn("enable_ssao() has replaced the ambient occlusion of plotter.penumbra: call disable_ssao() and "
             "enable_temporal_ssao() to draw the latter", stacklevel=2)
    if chain or not _restore(renderer):
        for name in ORDER:
            if name in added and added[name] not in chain:
                _insert(renderer, added[name])
    _chains[renderer] = list(_chain(renderer.GetPass()))


def add(renderer: Any, name: str, render_pass: Any) -> None:
    """Keep a pass that is part of those of the renderer when others are enabled or disabled."""
    if renderer not in added_passes:
        added_passes[renderer] = {}
        renderer.AddObserver("StartEvent", _keep)
    added_passes[renderer][name] = render_pass
    _remember(renderer)


def remove(renderer: Any, name: str) -> None:
    """Forget a pass that was removed from a renderer."""
    added_passes.get(renderer, {}).pop(name, None)
    _remember(renderer)


def _remember(renderer: Any) -> None:
    chain = list(_chain(renderer.GetPass()))
    added = added_passes.get(renderer, {})
    _chains[renderer] = chain
    _steps.pop(renderer, None)
    if added and chain and chain[0].IsA("vtkCameraPass") and not any(each in chain for each in added.values()):
        _steps[renderer] = (chain[0], {name: each.GetDelegatePass() for name, each in added.items()})
