# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""MeshLab's ambient occlusion by rays for `penumbra chart`. SETTING: rays a place, all around.

It asks at all points of a mesh, about normals that it computes: each place is the corner of a triangle that is
too small to hide anything and has its normal. The seconds are the places' share. It knows no lamps and no
reflections."""
import importlib.metadata
import time

import numpy
import pymeshlab

import places

# Side of such a triangle, as a share of the places' extent.
TINY = 1e-6


def corner_triangles(scene):
    at, normal = scene.places[:, :3], scene.places[:, 3:]
    side = numpy.cross(normal, numpy.eye(3)[numpy.abs(normal).argmin(1)])
    side *= TINY * numpy.ptp(at, 0).max() / numpy.linalg.norm(side, axis=1)[:, None]
    return numpy.stack([at, at + side, at + numpy.cross(normal, side)], 1).reshape(-1, 3)


def ask(scene, setting, path):
    corners, index = numpy.unique(scene.corners.reshape(-1, 3), axis=0, return_inverse=True)
    tiny = corner_triangles(scene)
    points = numpy.concatenate([corners, tiny])
    faces = numpy.concatenate([index.ravel(), len(corners) + numpy.arange(len(tiny))])
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(points, faces.reshape(-1, 3).astype("i4")))
    start = time.process_time()
    meshes.compute_scalar_ambient_occlusion(rays=int(setting))
    seconds = time.process_time() - start
    # The sum of cosines of rays that get away, of all around: a quarter of them where all is open.
    sums = meshes.current_mesh().vertex_scalar_array()[len(corners)::3]
    light = numpy.repeat(4 * sums / int(setting), 3)
    return light, seconds * len(scene.places) / len(points), int(setting)


places.run("pymeshlab " + importlib.metadata.version("pymeshlab"), ask)
