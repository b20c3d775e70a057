# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion in a browser: the server renders with a pass and refines while the view is still.

    pip install pyvista trame trame-vtk trame-vuetify vtk-penumbra
    python view_in_browser.py [MESH] [--port 8080] [--server]
"""
import asyncio
import os
import time
from collections.abc import Callable
from typing import Any

import pyvista as pv
from trame.app import get_server
from trame.ui.vuetify3 import SinglePageLayout

# Seconds without a frame after which the view is refined: longer than between two frames of an interaction.
PAUSE = 0.1
# Seconds after which a frame that refines ends, so that the server answers; the next one continues.
SLICE = 0.3


class Refinement:
    """Renders a window again until its pass has converged, when no other frame was rendered for a while."""

    def __init__(self, window: Any, occlusion: Any, push: Callable[[], object], state: Any) -> None:
        self.window = window
        self.occlusion = occlusion
        self.push = push
        self.state = state
        self.begin = time.monotonic()
        self.waiting: asyncio.TimerHandle | None = None
        window.AddObserver("StartEvent", self.start)
        window.AddObserver("AbortCheckEvent", self.check)
        window.AddObserver("EndEvent", self.end)

    def start(self, *_: object) -> None:
        self.begin = time.monotonic()

    def check(self, *_: object) -> None:
        if time.monotonic() - self.begin > SLICE:
            self.window.SetAbortRender(1)

    def end(self, *_: object) -> None:
        """Wait for a pause; a view that has converged needs no further frame."""
        if self.waiting is not None:
            self.waiting.cancel()
            self.waiting = None
        converged = self.occlusion.IsConverged()
        with self.state:
            self.state.frames += 1
            self.state.converged = converged
        if not converged:
            self.waiting = asyncio.get_running_loop().call_later(PAUSE, self.push)


def make_plotter(mesh: pv.DataSet) -> tuple[pv.Plotter, Any]:
    plotter = pv.Plotter(off_screen=True, window_size=[800, 600])
    plotter.add_mesh(mesh, color="white", smooth_shading=True, split_sharp_edges=True)
    floor = pv.Plane((*mesh.center[:2], mesh.bounds.z_min), i_size=2.0 * mesh.length, j_size=2.0 * mesh.length)
    plotter.add_mesh(floor, color="white")
    plotter.set_background("slategray")
    plotter.camera_position = "iso"
    plotter.iren.initialize()  # so that it takes the mouse events of the browser
    occlusion = plotter.penumbra.enable_temporal_ssao(tolerance=0.01)
    occlusion.SetRefineStaticView(False)  # it needs the event loop of VTK; this server has its own
    return plotter, occlusion


def main() -> None:
    server = get_server()
    server.cli.add_argument("mesh", nargs="?", help="a file that PyVista reads; default: a nut")
    path = server.cli.parse_known_args()[0].mesh
    plotter, occlusion = make_plotter(pv.read(path) if path else pv.examples.load_nut())
    window = plotter.render_window

    # The VTK of PyVista, "cvista" or "vtkmodules".
    os.environ.setdefault("VTK_MODULE_NAME", type(window).__module__.split(".")[0])
    from trame.widgets import vtk, vuetify3

    server.state.update({"converged": False, "frames": 0})
    with SinglePageLayout(server) as layout:
        layout.title.set_text("Penumbra")
        with layout.toolbar:
            vuetify3.VSpacer()
            vuetify3.VChip("{{ converged ? 'Converged' : 'Refining' }}, {{ frames }} frames", id="state")
        with layout.content:
            view = vtk.VtkRemoteView(window, interactive_ratio=1, still_quality=95)
    Refinement(window, occlusion, view.update, server.state)
    server.start()


if __name__ == "__main__":
    main()
