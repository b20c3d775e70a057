# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Traces reference values of the unoccluded fraction with trimesh and Embree, at random pixels inside of surfaces.

reference.py MESH.ply FILE.npz: pixels, and two independent estimates each, with the radius of the image and without.
"""
import sys

import numpy
import trimesh
from trimesh.ray.ray_pyembree import RayMeshIntersector

import trimesh_image
import view

PIXELS = 6000
STRATA = 32  # per side of a pixel
PIXELS_AT_ONCE = 500


def estimate(mesh, intersector, pixels, random, radii):
    """Return the fraction of camera rays that hit the mesh in each pixel, and the means for each radius."""
    strata = numpy.stack(numpy.meshgrid(numpy.arange(STRATA), numpy.arange(STRATA)), -1).reshape(-1, 2)
    corners = numpy.stack((pixels % view.WIDTH, pixels // view.WIDTH), -1)
    positions = corners[:, None] + (strata + random.random((len(pixels), STRATA ** 2, 2))) / STRATA
    rays, visible = trimesh_image.trace(mesh, intersector, positions.reshape(-1, 2), random, radii)
    count = len(pixels)
    totals = [numpy.bincount(rays // STRATA ** 2, weights, count) for weights in (None, *visible)]
    return [total / STRATA ** 2 for total in totals]


def main():
    mesh = trimesh.load(sys.argv[1], process=False)
    intersector = RayMeshIntersector(mesh)
    random = numpy.random.default_rng(7)
    pixels = random.permutation(view.WIDTH * view.HEIGHT)
    radii = (view.RADIUS, numpy.inf)
    kept = []
    for first in range(0, len(pixels), PIXELS_AT_ONCE):
        piece = pixels[first:first + PIXELS_AT_ONCE]
        piece = piece[find_surfaces(intersector, piece)]
        one, other = (estimate(mesh, intersector, piece, random, radii) for _ in range(2))
        inside = (one[0] == 1.0) & (other[0] == 1.0)
        kept.append([piece[inside], *(values[inside] for values in one[1:] + other[1:])])
        if sum(len(rows[0]) for rows in kept) >= PIXELS:
            break
    index, near, far, near_again, far_again = (numpy.concatenate(rows) for rows in zip(*kept))
    numpy.savez(sys.argv[2], pixels=index, radius=(near, near_again), sky=(far, far_again))


def find_surfaces(intersector, pixels):
    """Return which pixels have a surface in the center."""
    centers = numpy.stack((pixels % view.WIDTH, pixels // view.WIDTH), -1) + 0.5
    directions = trimesh_image.make_camera_rays(centers)
    return intersector.intersects_any(numpy.broadcast_to(view.EYE, directions.shape), directions)


if __name__ == "__main__":
    main()
