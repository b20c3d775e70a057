# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion of a mesh by MeshLab's rays: error and time of a ladder of rays a point.

    pip install pymeshlab numpy && python Benchmarks/Peers/scripts/meshlab.py MESH TRUTH

A line a setting: RMSE, CPU seconds of all threads, and the setting. TRUTH holds lines of a point's number
and its occlusion."""
import importlib.metadata
import sys
import time

import numpy
import pymeshlab

VERSION = "pymeshlab " + importlib.metadata.version("pymeshlab")
truth = numpy.loadtxt(sys.argv[2])
for rays in (64, 256, 1024):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(sys.argv[1])
    start = time.process_time()
    meshes.compute_scalar_ambient_occlusion(rays=rays)
    seconds = time.process_time() - start
    # The sum of cosines of rays that get away, of all around: a quarter of them where all is open.
    open_sum = meshes.current_mesh().vertex_scalar_array()[truth[:, 0].astype(int)]
    found = 1 - 4 * open_sum / rays
    error = numpy.sqrt(numpy.mean((found - truth[:, 1]) ** 2))
    print(f"{error:.5f} {seconds:.3f} {rays} rays, {VERSION}", flush=True)
