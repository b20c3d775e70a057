# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""MeshLab's ambient occlusion by rays for `penumbra chart`. SETTING: rays per point, over the sphere.

MeshLab evaluates all points of a mesh with normals that it computes. Each queried point is therefore the corner of
a triangle that has the point's normal and is too small to occlude anything. The seconds are scaled by the fraction
of queried points. Area lights and interreflection are not supported."""
import importlib.metadata
import time

import numpy
import pymeshlab

import point_protocol

# Side of such a triangle, as a fraction of the extent of the points.
TINY = 1e-6


def corner_triangles(scene):
    at, normal = scene.points[:, :3], scene.points[:, 3:]
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
    # Sum of the cosines of unoccluded rays over the sphere: a quarter of their number if nothing is occluded.
    sums = meshes.current_mesh().vertex_scalar_array()[len(corners)::3]
    light = numpy.repeat(4 * sums / int(setting), 3)
    return light, seconds * len(scene.points) / len(points), int(setting)


point_protocol.run("pymeshlab " + importlib.metadata.version("pymeshlab"), ask)
