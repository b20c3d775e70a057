# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba, programmed as in its tutorial "Scripting a renderer": ambient occlusion by rays of a limited length.

mitsuba_image.py MESH.ply IMAGE.npy CAMERA_RAYS RAYS: CAMERA_RAYS per pixel, RAYS from each of their hits.
Without arguments, it prints the version.
"""
import sys

import drjit
import mitsuba
import numpy

import view


def sample_hemisphere(square):
    """Return a direction with a density proportional to the cosine. (The function of mitsuba.warp needs LLVM 16.)"""
    radius, (sine, cosine) = drjit.sqrt(square.x), drjit.sincos(2.0 * drjit.pi * square.y)
    return mitsuba.Vector3f(radius * cosine, radius * sine, drjit.sqrt(1.0 - square.x))


def main():
    if len(sys.argv) < 5:
        print("Mitsuba", mitsuba.__version__)
        return
    path, output, camera_rays, rays = sys.argv[1:]
    mitsuba.set_variant("llvm_ad_mono")
    drjit.set_thread_count(1)
    scene = mitsuba.load_dict({"type": "scene", "mesh": {"type": "ply", "filename": path, "face_normals": True}})
    sensor = mitsuba.load_dict({
        "type": "perspective", "fov": view.ANGLE, "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e6,
        "to_world": mitsuba.ScalarTransform4f().look_at(origin=view.EYE, target=view.TARGET, up=view.UP),
        "film": {"type": "hdrfilm", "width": view.WIDTH, "height": view.HEIGHT, "rfilter": {"type": "box"}}})
    pixels = view.WIDTH * view.HEIGHT
    index = drjit.arange(mitsuba.UInt32, pixels)
    corner = mitsuba.Vector2f(index % view.WIDTH, index // view.WIDTH)
    total = numpy.zeros(pixels, "f4")
    for step in range(int(camera_rays)):
        sampler = mitsuba.load_dict({"type": "independent"})
        sampler.seed(step, pixels)
        position = (corner + sampler.next_2d()) / mitsuba.Vector2f(view.WIDTH, view.HEIGHT)
        ray, _ = sensor.sample_ray(0.0, 0.0, position, 0.0)
        hit = scene.ray_intersect(ray)
        inside = hit.is_valid()
        frame = mitsuba.Frame3f(drjit.select(drjit.dot(hit.n, ray.d) > 0, -hit.n, hit.n))
        visible = drjit.zeros(mitsuba.Float, pixels)
        for _ in range(int(rays)):
            occluder = hit.spawn_ray(frame.to_world(sample_hemisphere(sampler.next_2d())))
            occluder.maxt = view.RADIUS
            visible += drjit.select(scene.ray_test(occluder, inside) | ~inside, 0.0, 1.0 / int(rays))
        total += visible.numpy()
    numpy.save(output, (total / int(camera_rays)).reshape(view.HEIGHT, view.WIDTH))


main()
