# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Renders a first image with PyVista and the installed wheel: first_plot.py FILE"""
import sys

import penumbra  # noqa: F401
import pyvista

plotter = pyvista.Plotter(off_screen=True, window_size=(800, 600))
plotter.add_mesh(pyvista.examples.load_nut())
plotter.penumbra.enable_temporal_ssao()
plotter.screenshot(sys.argv[1])
