# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion of a mesh by MeshLab's rays: error and time for several numbers of rays per point.

    pip install pymeshlab numpy && python Benchmarks/Peers/scripts/meshlab.py MESH REFERENCE

Prints one line per setting: RMSE, CPU seconds of all threads, and the setting. REFERENCE contains one line per point:
its index and its occlusion."""
import importlib.metadata
import sys
import time

import numpy
import pymeshlab

VERSION = "pymeshlab " + importlib.metadata.version("pymeshlab")
reference = numpy.loadtxt(sys.argv[2])
for rays in (64, 256, 1024):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(sys.argv[1])
    start = time.process_time()
    meshes.compute_scalar_ambient_occlusion(rays=rays)
    seconds = time.process_time() - start
    # Sum of the cosines of unoccluded rays over the sphere: a quarter of their number if nothing is occluded.
    open_sum = meshes.current_mesh().vertex_scalar_array()[reference[:, 0].astype(int)]
    occlusion = 1 - 4 * open_sum / rays
    error = numpy.sqrt(numpy.mean((occlusion - reference[:, 1]) ** 2))
    print(f"{error:.5f} {seconds:.3f} {rays} rays, {VERSION}", flush=True)
