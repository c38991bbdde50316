#!/usr/bin/env python3
"""Path-traces one scene of path_scenes.py or material_scenes.py with Cycles (PyPI `bpy`), in a process of its own.

    cycles_render.py FOLDER SCENE --size WxH --samples N --seed N [--threads N] -o PICTURE.exr

Prints the wall and CPU seconds of rendering as JSON. Nothing is cut off or filtered: no clamping, no light threshold, no
adaptive sampling, no denoising, a box filter of a pixel.
"""

import argparse
import json
import os
import time
from math import pi, radians
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

import addon_utils  # noqa: E402: bpy puts it on the path
import material_scenes
import path_scenes


def turned(v):
    """Blender's z is up."""
    return Vector((v[0], -v[2], v[1]))


def node_material(name, kind, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    shader, output = nodes.new(kind), nodes.new("ShaderNodeOutputMaterial")
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    links.new(shader.outputs[0], output.inputs["Surface"])
    return material, shader


def material_of(material):
    if material.matte:
        return node_material("matte", "ShaderNodeBsdfDiffuse", Color=(*material.matte, 1))[0]
    if material.metal:
        found, shader = node_material("metal", "ShaderNodeBsdfAnisotropic", Color=(*material.metal, 1),
                                      Roughness=material.roughness)
        # As in Mitsuba, microfacets have no compensation.
        shader.distribution = "GGX"
        return found
    if material.ior:
        return node_material("glass", "ShaderNodeBsdfGlass", Roughness=0.0, IOR=material.ior)[0]
    found, shader = node_material("glow", "ShaderNodeEmission", Color=(*material.radiance, 1))
    # The front alone shines.
    nodes, links = found.node_tree.nodes, found.node_tree.links
    place, front = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeMath")
    front.operation, front.inputs[0].default_value = "SUBTRACT", 1.0
    links.new(place.outputs["Backfacing"], front.inputs[1])
    links.new(front.outputs[0], shader.inputs["Strength"])
    found.cycles.emission_sampling = "FRONT"
    return found


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_lamp(kind, radiance, area, place):
    lamp = bpy.data.lights.new("lamp", kind)
    strength = max(radiance)
    lamp.color = [c / strength for c in radiance]
    # Of a surface that shines with this radiance in all directions of a hemisphere.
    lamp.energy = strength * pi * area
    thing = add("lamp", lamp)
    thing.matrix_world, thing.visible_camera = place, True
    return lamp


def build(scene):
    for i, mesh in enumerate(scene.meshes):
        data = bpy.data.meshes.new(f"mesh{i}")
        data.from_pydata([turned(v) for v in mesh.vertices], [], mesh.triangles.tolist())
        data.materials.append(material_of(mesh.material))
        add(f"mesh{i}", data)
    for lamp in scene.rectangles:
        u, v = turned(lamp.edge_u), turned(lamp.edge_v)
        area = 4 * u.length * v.length
        # A lamp of Blender shines along its -z.
        place = Matrix((u.normalized(), -v.normalized(), -u.cross(v).normalized())).transposed().to_4x4()
        light = add_lamp("AREA", lamp.radiance, area, Matrix.Translation(turned(lamp.center)) @ place)
        light.shape, light.size, light.size_y = "RECTANGLE", 2 * u.length, 2 * v.length
    for lamp in scene.spheres:
        area = 4 * pi * lamp.radius**2
        light = add_lamp("POINT", lamp.radiance, area, Matrix.Translation(turned(lamp.center)))
        light.shadow_soft_size = lamp.radius
    if scene.model:
        bpy.ops.import_scene.gltf(filepath=str(scene.model.path))
    surround(scene.environment)
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", radians(scene.fov_y_deg)
    thing = add("camera", camera)
    away = turned(scene.look_from) - turned(scene.look_at)
    thing.matrix_world = Matrix.Translation(turned(scene.look_from)) @ away.to_track_quat("Z", "Y").to_matrix().to_4x4()
    bpy.context.scene.camera = thing


def surround(picture):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if picture:
        texture, mapping, place = (nodes.new(f"ShaderNode{kind}") for kind in ("TexEnvironment", "Mapping", "TexCoord"))
        texture.image = bpy.data.images.load(str(picture))
        # The centre of the picture is +y, glimray's -z.
        mapping.inputs["Rotation"].default_value = (0, 0, -pi / 2)
        links.new(place.outputs["Generated"], mapping.inputs["Vector"])
        links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        links.new(texture.outputs["Color"], background.inputs["Color"])


def set_up(width, height, samples, seed, threads, output):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    render, cycles = scene.render, scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", samples, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, f"{kind}_bounces", path_scenes.BOUNCES)
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", threads
    render.filepath, render.use_file_extension = str(output), False
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec, settings.color_mode = "OPEN_EXR", "32", "ZIP", "RGB"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("scene")
    parser.add_argument("--surroundings", default="assets/scenes/studio.hdr")
    parser.add_argument("--size", default="256x192")
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parsed = parser.parse_args()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    for add_on in ("cycles", "io_scene_gltf2"):
        addon_utils.enable(add_on)
    makers = material_scenes if parsed.scene in material_scenes.NAMES else path_scenes
    build(makers.all_scenes(parsed.folder, parsed.surroundings)[parsed.scene])
    width, height = map(int, parsed.size.split("x"))
    set_up(width, height, parsed.samples, parsed.seed, parsed.threads, parsed.output.resolve())
    # Blender writes about its progress to the standard output.
    own, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    wall, cpu = time.perf_counter(), time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds = {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
    os.dup2(own, 1)
    print(json.dumps(seconds))


if __name__ == "__main__":
    main()
