# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the seconds from an empty ParaView to the first image of a contour: first_view.py plain|penumbra FILE"""
import os
import sys
import time

from paraview.simple import *

begin = time.monotonic()
kind = "RenderView"
if sys.argv[1] == "penumbra":
    LoadPlugin(os.environ["PENUMBRA_PLUGIN"], remote=False, ns=globals())
    kind = "PenumbraRenderView"
view = CreateView(kind)
view.ViewSize = [800, 600]
Show(Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[170]), view)
ResetCamera(view)
SaveScreenshot(sys.argv[2], view)
print(f"{time.monotonic() - begin:.2f}", flush=True)
os._exit(0)
