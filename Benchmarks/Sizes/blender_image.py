# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Blender's Cycles: ambient occlusion by rays of a limited length, denoised by Open Image Denoise.

blender_image.py MESH.ply IMAGE.png SAMPLES. Without arguments, it prints the version.
"""
import math
import sys

import bpy
import mathutils

import view


def make_material():
    """Return a material that emits the unoccluded fraction."""
    material = bpy.data.materials.new("occlusion")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    occlusion, emission = nodes.new("ShaderNodeAmbientOcclusion"), nodes.new("ShaderNodeEmission")
    occlusion.samples, occlusion.inputs["Distance"].default_value = 1, view.RADIUS
    links.new(occlusion.outputs["AO"], emission.inputs["Strength"])
    links.new(emission.outputs["Emission"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    emission.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    return material


def add_camera(scene):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(view.ANGLE)
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    eye = bpy.data.objects.new("camera", camera)
    axes = mathutils.Matrix(view.get_axes()).transposed().to_4x4()
    eye.matrix_world = mathutils.Matrix.Translation(view.EYE) @ axes
    scene.collection.objects.link(eye)
    scene.camera = eye


def main():
    if len(sys.argv) < 4:
        print("Blender", bpy.app.version_string)
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.ply_import(filepath=sys.argv[1], forward_axis="Y", up_axis="Z")
    bpy.context.object.data.materials.append(make_material())
    scene = bpy.context.scene
    add_camera(scene)
    scene.world = None
    scene.view_settings.view_transform = "Raw"
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = int(sys.argv[3])
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = True
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1.0
    scene.cycles.max_bounces = 0
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.resolution_x, scene.render.resolution_y = view.SIZE
    scene.render.resolution_percentage = 100
    scene.render.filepath = sys.argv[2]
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    bpy.ops.render.render(write_still=True)


main()
