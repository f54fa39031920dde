"""Renders the indirect light of an exported scene with Blender's Cycles, and compares its mean with a reference's.

    blender -b --python render_cycles.py -- [--samples 1024] [--seed 0] [--reference reference.exr]

It lies beside scene.gltf and facts.json. Writes cycles.exr: the one-bounce indirect light alone. Known to work with
Blender 3.4.
"""
import argparse
import json
import math
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))


def options():
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="render_cycles.py")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--reference", default=os.path.join(HERE, "reference.exr"))
    return parser.parse_args(own)


def turned(v):
    """glTF has y up, Blender z."""
    return Vector((v[0], -v[2], v[1]))


def pose(position, direction, up):
    """The matrix of what looks along -z with y up."""
    d, u = turned(direction).normalized(), turned(up).normalized()
    r = d.cross(u).normalized()
    u = r.cross(d)
    rows = [[r[i], u[i], -d[i], turned(position)[i]] for i in range(3)] + [[0, 0, 0, 1]]
    return Matrix(rows), r, u, d


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    return scene


def read_geometry(facts):
    """The importer's meshes and textures; its camera and light are replaced."""
    if "bool" not in np.__dict__:  # the importer of Blender 3.4 beside a numpy that has dropped this name
        np.bool = bool
    bpy.ops.import_scene.gltf(filepath=os.path.join(HERE, "scene.gltf"))
    for item in list(bpy.data.objects):
        if item.type in ("CAMERA", "LIGHT"):
            bpy.data.objects.remove(item)
        elif item.type == "MESH":
            item.cycles.shadow_terminator_offset = 0
            item.cycles.shadow_terminator_geometry_offset = 0
    for material in bpy.data.materials:
        if facts["materials"].get(material.name, {}).get("lambert"):
            make_lambert(material)


def make_lambert(material):
    """The importer's principled shader becomes a diffuse one with the same colour."""
    tree = material.node_tree
    principled = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Roughness"].default_value = 0
    for source, target in (("Base Color", "Color"), ("Normal", "Normal")):
        old, new = principled.inputs[source], diffuse.inputs[target]
        if old.is_linked:
            tree.links.new(old.links[0].from_socket, new)
        elif source == "Base Color":
            new.default_value = old.default_value
    for link in list(principled.outputs[0].links):
        tree.links.new(diffuse.outputs[0], link.to_socket)


def add_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.lens_unit = "VERTICAL", "FOV"
    data.angle = math.radians(camera["vfov"])
    data.clip_start, data.clip_end = 1e-4, 1e6
    item = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(item)
    item.matrix_world = pose(camera["eye"], camera["direction"], camera["up"])[0]
    scene.camera = item


def add_light(scene, light):
    sun = "sun" in light
    given = light["sun"] if sun else light["spot"]
    power = given["irradiance"] if sun else given["intensity"]
    most = max(power)
    data = bpy.data.lights.new("light", "SUN" if sun else "POINT")
    data.color = [p / most for p in power]
    item = bpy.data.objects.new("light", data)
    scene.collection.objects.link(item)
    position = given["centre"] if sun else given["position"]
    matrix, right, up, forward = pose(position, given["direction"], given["up"])
    item.matrix_world = matrix
    if sun:
        data.angle, data.energy = 0, most
        return
    # A point light of P watts has an intensity of P/4π in every direction; the mask leaves a square frustum of it.
    data.shadow_soft_size, data.energy = 0, 4 * math.pi * most
    mask(data, right, up, forward, math.tan(math.radians(given["fov"]) / 2))


def mask(light, right, up, forward, tangent):
    light.use_nodes = True
    tree = light.node_tree

    def node(kind, operation, *inputs):
        made = tree.nodes.new(kind)
        made.operation = operation
        for i, value in enumerate(inputs):
            if hasattr(value, "is_linked"):
                tree.links.new(value, made.inputs[i])
            else:
                made.inputs[i].default_value = value
        return made

    ray = tree.nodes.new("ShaderNodeNewGeometry").outputs["Incoming"]
    along = [node("ShaderNodeVectorMath", "DOT_PRODUCT", ray, tuple(axis)).outputs["Value"]
             for axis in (right, up, forward)]
    edge = node("ShaderNodeMath", "MULTIPLY", along[2], tangent).outputs[0]
    inside = node("ShaderNodeMath", "GREATER_THAN", along[2], 0.0).outputs[0]
    for across in along[:2]:
        size = node("ShaderNodeMath", "ABSOLUTE", across).outputs[0]
        within = node("ShaderNodeMath", "LESS_THAN", size, edge).outputs[0]
        inside = node("ShaderNodeMath", "MULTIPLY", inside, within).outputs[0]
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    tree.links.new(inside, emission.inputs["Strength"])


def set_up(scene, facts, given):
    scene.render.engine = "CYCLES"
    c = scene.cycles
    c.device, c.samples, c.seed = "CPU", given.samples, given.seed
    c.use_adaptive_sampling = c.use_denoising = c.use_fast_gi = False
    if hasattr(c, "use_guiding"):
        c.use_guiding = False
    # One indirect bounce, and nothing that trades bias for noise.
    c.max_bounces = c.diffuse_bounces = c.glossy_bounces = 1
    c.transmission_bounces = c.volume_bounces = 0
    c.transparent_max_bounces = 64
    c.sample_clamp_direct = c.sample_clamp_indirect = 0
    c.blur_glossy = c.light_sampling_threshold = 0
    c.caustics_reflective = True
    # No filter: what a pixel's centre sees.
    c.pixel_filter_type, c.filter_width = "GAUSSIAN", 0.01
    c.film_exposure = 1
    scene.render.resolution_x, scene.render.resolution_y = facts["width"], facts["height"]
    scene.render.resolution_percentage = 100
    if given.threads:
        scene.render.threads_mode, scene.render.threads = "FIXED", given.threads
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"


def keep_indirect(scene):
    """The composite is diffuse and glossy indirect light, each times its colour."""
    layer = bpy.context.view_layer
    for lobe in ("diffuse", "glossy"):
        setattr(layer, f"use_pass_{lobe}_indirect", True)
        setattr(layer, f"use_pass_{lobe}_color", True)
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    layers = tree.nodes.new("CompositorNodeRLayers")

    def mix(kind, a, b):
        made = tree.nodes.new("CompositorNodeMixRGB")
        made.blend_type = kind
        tree.links.new(a, made.inputs[1])
        tree.links.new(b, made.inputs[2])
        return made.outputs[0]

    lobes = [mix("MULTIPLY", layers.outputs[short + "Ind"], layers.outputs[short + "Col"]) for short in ("Diff", "Gloss")]
    tree.links.new(mix("ADD", *lobes), tree.nodes.new("CompositorNodeComposite").inputs["Image"])


def pixels(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Raw" if "Raw" in image.colorspace_settings.bl_rna.properties[
        "name"].enum_items else "Non-Color"
    values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4).astype(np.float64)


def compare(path, reference):
    ours, theirs = pixels(reference), pixels(path)
    if ours.shape != theirs.shape:
        sys.exit(f"{reference}: is {ours.shape[1]}x{ours.shape[0]}, not {theirs.shape[1]}x{theirs.shape[0]}")
    seen = ours[..., 3] > 0.5
    a, b = theirs[seen][:, :3], ours[seen][:, :3]
    for name, x, y in zip("rgb", a.mean(0), b.mean(0)):
        print(f"{name}: cycles {x:.6g}, reference {y:.6g}, ratio {x / y if y else float('nan'):.5f}")
    print(f"ratio of means: {a.mean() / b.mean():.5f}")
    print(f"relative RMSE: {math.sqrt(((a - b) ** 2).mean()) / b.mean():.4f}")


def main():
    given = options()
    with open(os.path.join(HERE, "facts.json"), encoding="utf-8") as file:
        facts = json.load(file)
    scene = empty_scene()
    read_geometry(facts)
    add_camera(scene, facts["camera"])
    add_light(scene, facts["light"])
    set_up(scene, facts, given)
    keep_indirect(scene)
    path = os.path.join(HERE, "cycles.exr")
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    if os.path.exists(given.reference):
        compare(path, given.reference)
    else:
        print(f"{given.reference}: is not there; nothing to compare with")


main()
