"""Renders what `prt export --npy` wrote with Blender's Cycles, to compare with something nobody here wrote.

usage: blender -b --factory-startup --python-exit-code 1 -P render_cycles.py -- SCENE.json OUT.exr

SCENE.json: {"arrays": DIR of positions, normals, faces, object and albedo .npy, "environment": lat-long EXR,
             "camera": {"eye", "target", "up", "vfov_deg"}, "size": [w, h], "spp": N, "bounces": N, "seed": N}

The shading model is matched to ours: smooth normals as exported, a Lambert surface, no terminator offset, `bounces`
interreflections, a box pixel filter one pixel wide, alpha = coverage, linear Rec.709 floats out.
"""
import json
import math
import os
import sys

import bpy
import mathutils
import numpy as np

# Ours: +Y up, the centre of a lat-long map looks to -Z, u grows towards +X.
# Blender's: +Z up, the centre looks to +X, u grows towards -Y.
TO_BLENDER = np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]], dtype=np.float64)


def to_blender(vectors):
    return np.asarray(vectors, dtype=np.float64) @ TO_BLENDER.T


def lambert(name, albedo):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*(float(c) for c in albedo), 1.0)
    diffuse.inputs["Roughness"].default_value = 0.0
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    return material


def add_mesh(directory):
    """One mesh with a material per object."""
    load = lambda name: np.load(os.path.join(directory, name + ".npy"))
    positions, normals = to_blender(load("positions")), to_blender(load("normals"))
    faces, objects, albedo = load("faces"), load("object").reshape(-1), load("albedo")
    mesh = bpy.data.meshes.new("surface")
    mesh.from_pydata(positions.tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    for index in range(objects.max() + 1):
        mesh.materials.append(lambert(f"object {index}", albedo[np.argmax(objects == index)]))
    mesh.polygons.foreach_set("material_index", objects[faces[:, 0]].tolist())
    mesh.use_auto_smooth = True  # custom normals are ignored without it
    mesh.normals_split_custom_set_from_vertices(normals.tolist())
    thing = bpy.data.objects.new("surface", mesh)
    thing.cycles.shadow_terminator_offset = 0.0
    thing.cycles.shadow_terminator_geometry_offset = 0.0
    bpy.context.scene.collection.objects.link(thing)


def add_environment(path):
    world = bpy.data.worlds.new("environment")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes = world.node_tree.nodes
    nodes.clear()
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(os.path.abspath(path))
    texture.image.colorspace_settings.name = "Linear"
    background = nodes.new("ShaderNodeBackground")
    output = nodes.new("ShaderNodeOutputWorld")
    world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    world.cycles.sampling_method = "AUTOMATIC"


def add_camera(view, size):
    eye, target, up = (mathutils.Vector(to_blender(view[key])) for key in ("eye", "target", "up"))
    backward = (eye - target).normalized()
    right = up.cross(backward).normalized()
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = math.radians(view["vfov_deg"])
    distance = (eye - target).length
    data.clip_start, data.clip_end = distance * 1e-3, distance * 1e3
    camera = bpy.data.objects.new("camera", data)
    rotation = mathutils.Matrix((right, backward.cross(right), backward)).transposed()
    camera.matrix_world = mathutils.Matrix.Translation(eye) @ rotation.to_4x4()
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100


def configure(spp, bounces, seed):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.film_transparent = True
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = spp
    cycles.seed = seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = bounces
    cycles.diffuse_bounces = bounces
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0


def main(scene_path, out_path):
    with open(scene_path) as file:
        task = json.load(file)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    add_mesh(task["arrays"])
    add_environment(task["environment"])
    add_camera(task["camera"], task["size"])
    configure(task["spp"], task["bounces"], task["seed"])
    settings = bpy.context.scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    settings.exr_codec = "ZIP"
    bpy.context.scene.render.filepath = os.path.abspath(out_path)
    bpy.ops.render.render(write_still=True)


main(*sys.argv[sys.argv.index("--") + 1:])
