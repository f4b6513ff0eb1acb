"""Renders copies of an exported patch with Cycles along views, averages over texels and compares with prt's pictures.

usage: blender -b --factory-startup --python-exit-code 1 -P render_patch.py -- TASK.json     (see compare_patch.py)
"""
import json
import math
import os
import sys

import bpy
import mathutils
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
COPIES, SCALE = 3, 1.5  # copies to each side; width of the picture in patch widths


def to_blender(vectors):
    """Patch frame on the ground (u = +X, v = -Z, outwards = +Y) to Blender's world, as render_cycles.py has it."""
    vectors = np.asarray(vectors, dtype=np.float64)
    world = np.stack([vectors[..., 0], vectors[..., 2], -vectors[..., 1]], axis=-1)
    return world @ np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]], dtype=np.float64).T


def add_patch(directory):
    load = lambda name: np.load(os.path.join(directory, name + ".npy"))
    positions, normals, faces, albedo = load("patch_positions"), load("patch_normals"), load("patch_faces"), load("patch_albedo")
    assert np.ptp(albedo, axis=0).max() < 1e-6, "one albedo for all"
    material = bpy.data.materials.new("patch")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (*map(float, albedo[0]), 1.0)
    material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    mesh = bpy.data.meshes.new("patch")
    mesh.from_pydata(to_blender(positions).tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(material)
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(to_blender(normals).tolist())
    for y in range(-COPIES, COPIES + 1):
        for x in range(-COPIES, COPIES + 1):
            copy = bpy.data.objects.new("patch", mesh)
            copy.location = mathutils.Vector(to_blender([x, y, 0]))
            copy.cycles.shadow_terminator_offset = 0.0
            copy.cycles.shadow_terminator_geometry_offset = 0.0
            bpy.context.scene.collection.objects.link(copy)


def add_environment(path):
    world = bpy.data.worlds.new("environment")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes = world.node_tree.nodes
    nodes.clear()
    texture, background, output = (nodes.new(n) for n in ("ShaderNodeTexEnvironment", "ShaderNodeBackground", "ShaderNodeOutputWorld"))
    texture.image = bpy.data.images.load(os.path.abspath(path))
    texture.image.colorspace_settings.name = "Linear"
    world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])


def configure(task):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = task["size"]
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", task["spp"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = task["bounces"]
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = "OPEN_EXR", "RGBA", "32", "ZIP"


def pixels_of(path):
    """[rows from the bottom, columns, 3]"""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Linear"
    values = np.empty(image.size[0] * image.size[1] * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)[..., :3].astype(np.float64)


def axes_of(view):
    right = np.array([0, 1, 0]) if abs(view[0]) > 0.9 else np.array([1.0, 0, 0])
    right = right - view * np.dot(right, view)
    right /= np.linalg.norm(right)
    return right, np.cross(view, right)


def camera_at(centre, view):
    scene = bpy.context.scene
    right, up = axes_of(view)
    data = bpy.data.cameras.new("camera")
    data.type, data.ortho_scale = "ORTHO", SCALE
    data.clip_start, data.clip_end = 0.01, 100
    camera = bpy.data.objects.new("camera", data)
    axes = mathutils.Matrix([to_blender(a).tolist() for a in (right, up, view)]).transposed()
    camera.matrix_world = mathutils.Matrix.Translation(to_blender(centre + 10 * view)) @ axes.to_4x4()
    scene.collection.objects.link(camera)
    scene.camera = camera


def over_texels(picture, centre, view, texels):
    """Mean of the pixels whose rays cross the middle plane within each texel, wrapped: [v, u, 3]."""
    size = picture.shape[0]
    right, up = axes_of(view)
    offsets = ((np.arange(size) + 0.5) / size - 0.5) * SCALE
    across = offsets[None, :, None] * right + offsets[:, None, None] * up
    plane = centre + across - (across[..., 2:3] / view[2]) * view
    inside = (np.abs(plane[..., :2] - 0.5) < 1.0).all(axis=-1)
    u, v = (np.floor((plane[..., axis] % 1.0) * texels).astype(int).clip(0, texels - 1) for axis in (0, 1))
    sums, counts = np.zeros((texels, texels, 3)), np.zeros((texels, texels, 1))
    np.add.at(sums, (v[inside], u[inside]), picture[inside])
    np.add.at(counts, (v[inside], u[inside]), 1.0)
    assert counts.min() > 0, "a texel without pixels: render larger"
    return sums / counts


def main(task_path):
    with open(task_path) as file:
        task = json.load(file)
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    with open(os.path.join(task["arrays"], "manifest.json")) as file:
        middle = json.load(file)["patch_middle"]
    add_patch(task["arrays"])
    add_environment(task["environment"])
    configure(task)
    for entry in task["views"]:
        view, centre = np.array(entry["direction"]), np.array([0.5, 0.5, middle])
        camera_at(centre, view)
        renders = []
        for seed in (1, 2):
            bpy.context.scene.cycles.seed = seed
            bpy.context.scene.render.filepath = os.path.join(task["work"], f"cycles_{entry['index']}_{seed}.exr")
            bpy.ops.render.render(write_still=True)
            renders.append(over_texels(pixels_of(bpy.context.scene.render.filepath), centre, view, task["texels"]))
        ours = pixels_of(entry["ours"])
        signal = np.mean(renders[0] * renders[1])
        product = np.mean((ours - renders[0]) * (ours - renders[1]))
        print("RESULT " + json.dumps({
            "index": entry["index"], "angle": math.degrees(math.acos(view[2])), "relative": math.sqrt(max(0.0, product) / signal),
            "noise": math.sqrt(np.mean((renders[0] - renders[1]) ** 2) / 2 / signal),
            "ours": ours.mean(), "cycles": renders[0].mean()}), flush=True)


main(sys.argv[sys.argv.index("--") + 1])
