# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Blender's Cycles for `penumbra chart`: samples in a box of one pixel. SETTING: their number."""
import math
import os
import tempfile
import time

import bpy
import mathutils
import numpy

import image_protocol


def add_mesh(scene):
    mesh = bpy.data.meshes.new("faces")
    mesh.from_pydata(scene.positions, [], scene.triangles)
    colors = numpy.ones((len(mesh.loops), 4), "f4")
    colors[:, :3] = numpy.repeat(numpy.array(scene.colors, "f4"), 3, 0)
    mesh.attributes.new("colors", "FLOAT_COLOR", "CORNER").data.foreach_set("color", colors.ravel())
    glow = bpy.data.materials.new("glow")
    glow.use_nodes = True
    nodes = glow.node_tree.nodes
    nodes.clear()
    color, emission = nodes.new("ShaderNodeAttribute"), nodes.new("ShaderNodeEmission")
    color.attribute_name = "colors"
    glow.node_tree.links.new(color.outputs["Color"], emission.inputs["Color"])
    surface = nodes.new("ShaderNodeOutputMaterial").inputs["Surface"]
    glow.node_tree.links.new(emission.outputs["Emission"], surface)
    mesh.materials.append(glow)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("faces", mesh))


def add_camera(scene):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(scene.angle)
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    eye = bpy.data.objects.new("camera", camera)
    back = -mathutils.Vector(scene.forward)
    right = mathutils.Vector(scene.up).cross(back).normalized()
    turn = mathutils.Matrix((right, back.cross(right), back)).transposed().to_4x4()
    eye.matrix_world = mathutils.Matrix.Translation(scene.eye) @ turn
    bpy.context.scene.collection.objects.link(eye)
    bpy.context.scene.camera = eye


def draw(scene, setting):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add_mesh(scene)
    add_camera(scene)
    settings = bpy.context.scene
    settings.world = None
    settings.render.engine = "CYCLES"
    settings.cycles.samples = int(setting)
    settings.cycles.use_adaptive_sampling = False
    settings.cycles.use_denoising = False
    settings.cycles.pixel_filter_type = "BOX"
    settings.cycles.filter_width = 1.0
    settings.cycles.max_bounces = 0
    settings.render.threads_mode, settings.render.threads = "FIXED", 1
    settings.render.resolution_x, settings.render.resolution_y = scene.size
    settings.render.resolution_percentage = 100
    settings.render.image_settings.file_format = "OPEN_EXR"
    settings.render.image_settings.color_depth = "32"
    with tempfile.TemporaryDirectory() as folder:
        settings.render.filepath = os.path.join(folder, "image.exr")
        start = time.process_time()
        bpy.ops.render.render(write_still=True)
        seconds = time.process_time() - start
        image = bpy.data.images.load(settings.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        values = numpy.empty(4 * scene.width * scene.height, "f4")
        image.pixels.foreach_get(values)
    return values.reshape(-1, 4)[:, :3].tobytes(), seconds, int(setting)


image_protocol.run(bpy.app.version_string, draw)
