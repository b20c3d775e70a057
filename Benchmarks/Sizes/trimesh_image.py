# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""trimesh with Embree (embreex): ambient occlusion by rays of a limited length, programmed with numpy.

trimesh_image.py MESH.ply IMAGE.npy SAMPLES: SAMPLES per pixel, each a camera ray and a ray from its hit.
Without arguments, it prints the versions.
"""
import importlib.metadata
import sys

import numpy
import trimesh
from trimesh.ray.ray_pyembree import RayMeshIntersector

import view


def make_camera_rays(positions):
    """Return the directions of rays through positions of the image, in pixels from the upper left corner."""
    right, up, back = (numpy.array(axis) for axis in view.get_axes())
    scale = 2.0 * numpy.tan(numpy.radians(view.ANGLE) / 2.0) / view.HEIGHT
    x = scale * (positions[:, :1] - view.WIDTH / 2)
    y = scale * (view.HEIGHT / 2 - positions[:, 1:])
    directions = x * right + y * up - back
    return directions / numpy.linalg.norm(directions, axis=1, keepdims=True)


def sample_hemisphere(normals, random):
    """Return directions with a density proportional to the cosine."""
    points = random.normal(size=normals.shape)
    directions = points / numpy.linalg.norm(points, axis=1, keepdims=True) + normals
    return directions / numpy.linalg.norm(directions, axis=1, keepdims=True)


def trace(mesh, intersector, positions, random, radii):
    """Return the indices of rays that hit the mesh, and for each radius 1 where the ray from the hit is that long."""
    directions = make_camera_rays(positions)
    origins = numpy.broadcast_to(view.EYE, directions.shape)
    triangles, rays, points = intersector.intersects_id(
        origins, directions, multiple_hits=False, return_locations=True)
    normals = mesh.face_normals[triangles]
    normals = normals * -numpy.sign((normals * directions[rays]).sum(1, keepdims=True))
    outward = sample_hemisphere(normals, random)
    origins = points + 1e-5 * normals
    _, occluded, occluders = intersector.intersects_id(
        origins, outward, multiple_hits=False, return_locations=True)
    distances = numpy.full(len(rays), numpy.inf)
    distances[occluded] = numpy.linalg.norm(occluders - origins[occluded], axis=1)
    return rays, [(distances >= radius).astype(float) for radius in radii]


def main():
    if len(sys.argv) < 4:
        print(f"trimesh {trimesh.__version__} with embreex {importlib.metadata.version('embreex')}")
        return
    mesh = trimesh.load(sys.argv[1], process=False)
    intersector = RayMeshIntersector(mesh)
    random = numpy.random.default_rng(1)
    corners = numpy.stack(numpy.meshgrid(numpy.arange(view.WIDTH), numpy.arange(view.HEIGHT)), -1).reshape(-1, 2)
    total = numpy.zeros(len(corners))
    for _ in range(int(sys.argv[3])):
        positions = corners + random.random(corners.shape)
        rays, (visible,) = trace(mesh, intersector, positions, random, [view.RADIUS])
        total[rays] += visible
    numpy.save(sys.argv[2], (total / int(sys.argv[3])).reshape(view.HEIGHT, view.WIDTH))


if __name__ == "__main__":
    main()
