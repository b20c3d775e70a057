# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba for `penumbra chart`: independent samples in a box of one pixel. SETTING: their number."""
import time

import mitsuba
import numpy

import image_protocol

mitsuba.set_variant("scalar_rgb")


def draw(scene, setting):
    faces, colors = numpy.array(scene.triangles, "u4"), numpy.array(scene.colors, "f4")
    properties = mitsuba.Properties()
    properties["bsdf"] = mitsuba.load_dict({"type": "twosided", "bsdf": {
        "type": "diffuse", "reflectance": {"type": "mesh_attribute", "name": "face_color"}}})
    mesh = mitsuba.Mesh("mesh", len(scene.positions), len(faces), props=properties)
    parameters = mitsuba.traverse(mesh)
    parameters["vertex_positions"] = numpy.array(scene.positions, "f4").ravel()
    parameters["faces"] = faces.ravel()
    parameters.update()
    mesh.add_attribute("face_color", 3, colors.ravel())
    image = mitsuba.load_dict({
        "type": "scene", "mesh": mesh,
        "integrator": {"type": "aov", "aovs": "face:albedo"},
        "sensor": {
            "type": "perspective", "fov": scene.angle, "fov_axis": "y", "near_clip": 1e-3,
            "far_clip": 1e6, "to_world": mitsuba.ScalarTransform4f().look_at(
                origin=scene.eye, target=scene.target, up=scene.up),
            "film": {"type": "hdrfilm", "width": scene.width, "height": scene.height,
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": int(setting)}}})
    start = time.process_time()
    values = numpy.array(mitsuba.render(image))[::-1, :, -3:]
    seconds = time.process_time() - start
    return values.astype("f4").tobytes(), seconds, int(setting)


image_protocol.run(mitsuba.__version__, draw)
