# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Provider of ambient occlusion and light shafts for pyvista-render-passes."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pyvista_render_passes import BasePassProvider

from ._classes import vtkPenumbraLightShaftPass, vtkPenumbraTemporalSSAOPass
from .conversion import check_radius, check_range
from .messages import observe_warnings
from .passes import medium_bounds

DEFAULTS: dict[str, Any] = {
    "ambient_occlusion": False,
    "radius": None,
    "strength": 1.0,
    "tolerance": 0.01,
    "light_shafts": False,
}


class OcclusionProvider(BasePassProvider):
    """Registered by an entry point. Disabled until its state is set::

        plotter.render_passes.set_state({"providers": {"penumbra": {"ambient_occlusion": True}}})
    """

    name = "penumbra"
    stages = ("base",)

    def __init__(self) -> None:
        self._state = dict(DEFAULTS)

    def default_state(self) -> dict[str, Any]:
        return dict(DEFAULTS)

    def get_state(self) -> dict[str, Any]:
        return dict(self._state)

    def set_state(self, state: Mapping[str, Any]) -> None:
        unknown = [name for name in state if name not in DEFAULTS]
        if unknown:
            raise TypeError(f"the provider penumbra has no setting {', '.join(map(repr, unknown))}: use "
                            f"{', '.join(DEFAULTS)}")
        changed = {**self._state, **state}
        for name in ("ambient_occlusion", "light_shafts"):
            if changed[name] not in (True, False):
                raise TypeError(f"{name} must be True or False, not {changed[name]!r}")
        check_radius(changed["radius"])
        check_range("strength", changed["strength"], 0.0, 1.0)
        check_range("tolerance", changed["tolerance"], 1e-4, 1.0)
        self._state = changed

    def veto(self, settings: Mapping[str, Any]) -> str | None:
        if settings.get("ssao") and self._state["ambient_occlusion"]:
            return "ambient occlusion would be applied twice: disable ssao or the provider penumbra"
        return None

    def build_pass(self, stage: Any, renderer: Any, chain: Any, delegate: Any) -> Any:
        state = self._state
        last_pass = delegate
        if state["ambient_occlusion"]:
            occlusion = vtkPenumbraTemporalSSAOPass()
            observe_warnings(occlusion)
            if state["radius"] is not None:
                occlusion.SetRadiusUnit(occlusion.WORLD)
                occlusion.SetRadius(state["radius"])
            occlusion.SetStrength(state["strength"])
            occlusion.SetTolerance(state["tolerance"])
            occlusion.SetDelegatePass(last_pass)
            last_pass = occlusion
        if state["light_shafts"]:
            shafts = vtkPenumbraLightShaftPass()
            observe_warnings(shafts)
            shafts.GetMedium().SetBounds(medium_bounds(renderer))
            shafts.SetDelegatePass(last_pass)
            last_pass = shafts
        return last_pass
