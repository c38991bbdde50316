#!/usr/bin/env python3
"""Path-traces scenes with Mitsuba (variants scalar_rgb and llvm_ad_rgb), Cycles (PyPI `bpy`) and glimray, for the same
time each.

Each renderer gets as many samples as it takes in --seconds, found by a short run first. Two pictures of different seeds
have independent errors, so half of their mean squared difference is the mean squared error of either; it is divided by
the square of their mean, plus 0.01. The second pictures are rendered in the opposite order. The machine may be busy:
errors are scaled to the CPU seconds that were asked for, as the mean squared error is in proportion to 1 / time. Seconds
are those of glimray's whole process, of Cycles' render, and of Mitsuba's in a process that has compiled its kernels.
Pictures go into the folder.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

import path_scenes
import tables
from path_scenes import BOUNCES

mi.set_variant("scalar_rgb")

RENDERERS = ("glimray", "scalar_rgb", "llvm_ad_rgb", "Cycles")
# Samples of all pixels that Mitsuba's LLVM variant takes at once: each is a lane with a state in memory.
MOST_LANES = 1 << 24


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def native(scene, folder):
    """The scene in glimray's format; its meshes are written beside it."""
    lines = ["# Written by benches/peers/equal_time.py.", f'background = {{ picture = "{scene.environment.name}" }}'
             if scene.environment else "background = [0, 0, 0]", "[camera]", f"look_from = {list(scene.look_from)}",
             f"look_at = {list(scene.look_at)}", f"fov_y_deg = {scene.fov_y_deg}"]
    for lamp in scene.rectangles:
        lines.append(f"[[lights]]\nrectangle = {{ center = {list(lamp.center)}, edge_u = {list(lamp.edge_u)}, "
                     f"edge_v = {list(lamp.edge_v)}, color = {list(lamp.radiance)}, radiance = 1 }}")
    for lamp in scene.spheres:
        lines.append(f"[[lights]]\nsphere = {{ center = {list(lamp.center)}, radius = {lamp.radius}, "
                     f"color = {list(lamp.radiance)}, radiance = 1 }}")
    for i, mesh in enumerate(scene.meshes):
        m, name = mesh.material, f"{scene.name}-{i}.ply".replace(" ", "_")
        # With three vertices for each triangle, as glimray smooths meshes without normals where triangles share them.
        corners = mesh.vertices[mesh.triangles].reshape(-1, 3)
        mi_mesh(path_scenes.Mesh(corners, np.arange(len(corners)).reshape(-1, 3), m)).write_ply(str(folder / name))
        if m.matte:
            material = f"phong = {{ diffuse = {list(m.matte)} }}"
        elif m.metal:
            material = f"pbr = {{ base_color = {list(m.metal)}, metallic = 1, roughness = {m.roughness} }}"
        elif m.ior:
            material = f"refract = {{ ior = {m.ior} }}"
        else:
            material = f"phong = {{ diffuse = [0, 0, 0] }}, emission = {list(m.radiance)}, two_sided_emission = false"
        lines.append(f'[[objects]]\nmesh = {{ file = "{name}" }}\nmaterial = {{ {material} }}')
    file = folder / f"{scene.name}.toml".replace(" ", "_")
    file.write_text("\n".join(lines) + "\n")
    return file


def mi_mesh(mesh, more=None):
    shape = mi.Mesh("mesh", len(mesh.vertices), len(mesh.triangles), props=more or mi.Properties())
    values = mi.traverse(shape)
    values["vertex_positions"] = np.asarray(mesh.vertices, np.float32).ravel()
    values["faces"] = np.asarray(mesh.triangles, np.uint32).ravel()
    values.update()
    return shape


def bsdf(material):
    if material.ior:
        return {"type": "dielectric", "int_ior": material.ior, "ext_ior": 1.0}
    if material.metal:
        return {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": material.roughness**2,
                "specular_reflectance": rgb(material.metal)}
    # As in glimray, what shines reflects nothing here.
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(material.matte or (0, 0, 0))}}


def with_properties(parts):
    """Properties for a mesh that is made in memory."""
    found = mi.Properties()
    for key, part in parts.items():
        found[key] = mi.load_dict(part)
    return found


def principled(model, material):
    """Of a glTF material."""
    values = material["pbrMetallicRoughness"]
    # The folded reflection of glTF's dielectrics, 0.04.
    found = {"type": "principled", "specular": 0.5}
    if "baseColorTexture" in values:
        color = model.images[values["baseColorTexture"]["index"]]
        surface = model.images[values["metallicRoughnessTexture"]["index"]]
        texture = lambda pixels, raw: {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(pixels[::-1])), "raw": raw}
        found["base_color"] = texture(color, False)
        found["roughness"], found["metallic"] = texture(surface[..., 1:2], True), texture(surface[..., 2:3], True)
    else:
        found["base_color"] = rgb(values["baseColorFactor"][:3])
        found["roughness"], found["metallic"] = values["roughnessFactor"], values["metallicFactor"]
    return {"type": "twosided", "bsdf": found}


def model_mesh(model, vertices, normals, uv, triangles, material):
    shape = mi.Mesh("mesh", len(vertices), len(triangles), has_vertex_normals=True, has_vertex_texcoords=True,
                    props=with_properties({"bsdf": principled(model, model.materials[material])}))
    values = mi.traverse(shape)
    values["vertex_positions"] = np.asarray(vertices, np.float32).ravel()
    values["vertex_normals"] = np.asarray(normals, np.float32).ravel()
    values["vertex_texcoords"] = np.asarray(uv, np.float32).ravel()
    values["faces"] = np.asarray(triangles, np.uint32).ravel()
    values.update()
    return shape


def peer(scene, size):
    """The scene for Mitsuba."""
    camera = mi.ScalarTransform4f().look_at(origin=list(scene.look_from), target=list(scene.look_at), up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": size[0], "height": size[1], "rfilter": {"type": "box"}, "pixel_format": "rgb",
            "component_format": "float32"}
    # Mitsuba counts the segments of a path: the camera's, and that to the light.
    found = {
        "type": "scene", "integrator": {"type": "path", "max_depth": BOUNCES + 2},
        "sensor": {"type": "perspective", "fov": scene.fov_y_deg, "fov_axis": "y", "to_world": camera, "film": film,
                   "sampler": {"type": "independent"}},
    }
    black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
    for i, lamp in enumerate(scene.rectangles):
        u, v = np.array(lamp.edge_u, float), np.array(lamp.edge_v, float)
        place = np.eye(4)
        place[:3, 0], place[:3, 1], place[:3, 3] = u, v, lamp.center
        place[:3, 2] = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        found[f"rectangle{i}"] = {"type": "rectangle", "to_world": mi.ScalarTransform4f(place), "bsdf": black,
                                  "emitter": {"type": "area", "radiance": rgb(lamp.radiance)}}
    for i, lamp in enumerate(scene.spheres):
        found[f"sphere{i}"] = {"type": "sphere", "center": list(lamp.center), "radius": lamp.radius, "bsdf": black,
                               "emitter": {"type": "area", "radiance": rgb(lamp.radiance)}}
    for i, mesh in enumerate(scene.meshes):
        parts = {"bsdf": bsdf(mesh.material)}
        if mesh.material.radiance:
            parts["emitter"] = {"type": "area", "radiance": rgb(mesh.material.radiance)}
        found[f"mesh{i}"] = mi_mesh(mesh, with_properties(parts))
    if scene.model:
        for i, mesh in enumerate(scene.model.meshes):
            found[f"model{i}"] = model_mesh(scene.model, *mesh)
    if scene.environment:
        turn = mi.ScalarTransform4f().rotate([0, 1, 0], 180)
        found["environment"] = {"type": "envmap", "filename": str(scene.environment), "to_world": turn}
    return mi.load_dict(found)


def picture_of(path):
    layers = dict(mi.Bitmap(str(path)).split())
    # glimray names the radiance of pictures with a tone curve, as those of models are.
    bitmap = layers.get("beauty", layers["<root>"]).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    return np.array(bitmap, dtype=np.float64)


class Renderers:
    """Each renderer by name: a picture, its wall seconds and its CPU seconds."""

    def __init__(self, parsed, name, scene):
        self.parsed, self.name, self.scene, self.folder = parsed, name, scene, parsed.folder
        self.size = tuple(map(int, parsed.size.split("x")))
        mi.set_variant("scalar_rgb")
        self.file = scene.model.path if scene.model else native(scene, parsed.folder)
        self.peers = {}

    def render(self, renderer, samples, seed):
        out = self.folder / f"{self.name}-{renderer}-{seed}.exr"
        if renderer in ("glimray", "Cycles"):
            return getattr(self, renderer.lower())(samples, seed, out)
        return self.mitsuba(renderer, samples, seed, out)

    def glimray(self, samples, seed, out, more=()):
        command = [self.parsed.glimray, "render", self.file, "--integrator", "path", "--size", self.parsed.size, "--samples",
                   samples, "--max-depth", BOUNCES, "--seed", seed, "--filter", "box", "--quiet", "-o", out]
        if self.scene.model:
            views = (("--look-from", self.scene.look_from), ("--look-at", self.scene.look_at))
            command += [part for flag, at in views for part in (flag, ",".join(map(str, at)))]
            command += ["--fov-y", self.scene.fov_y_deg, "--environment", self.scene.environment, "--bare"]
        else:
            # Mitsuba's microfacets have no compensation.
            command += ["--bsdf", "spec"]
        command += more
        wall = time.perf_counter()
        process = subprocess.Popen(list(map(str, command)))
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            sys.exit(f"glimray failed: {' '.join(map(str, command))}")
        return picture_of(out), time.perf_counter() - wall, usage.ru_utime + usage.ru_stime

    def mitsuba(self, variant, samples, seed, out):
        mi.set_variant(variant)
        if variant not in self.peers:
            self.peers[variant] = peer(self.scene, self.size)
        most = MOST_LANES // (self.size[0] * self.size[1]) if variant.startswith("llvm") else samples
        parts = [min(most, samples - first) for first in range(0, samples, most)]
        wall, cpu = time.perf_counter(), time.process_time()
        picture = sum(np.array(mi.render(self.peers[variant], spp=part, seed=seed + 2 * i), dtype=np.float64) * part
                      for i, part in enumerate(parts)) / samples
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        mi.Bitmap(picture.astype(np.float32)).write(str(out))
        return picture, wall, cpu

    def cycles(self, samples, seed, out):
        script = Path(__file__).with_name("cycles_render.py")
        command = [sys.executable, "-W", "ignore", script, self.folder, self.name, "--surroundings", self.parsed.surroundings,
                   "--size", self.parsed.size, "--samples", samples, "--seed", seed, "--threads", self.parsed.threads, "-o", out]
        found = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True).stdout
        seconds = json.loads(found.strip().splitlines()[-1])
        return picture_of(out), seconds["wall"], seconds["cpu"]


def relative_error(a, b):
    return (((a - b) ** 2 / 2) / (((a + b) / 2) ** 2 + 0.01)).mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--glimray", default="target/release/glimray")
    parser.add_argument("--surroundings", default="assets/scenes/studio.hdr")
    parser.add_argument("--size", default="256x192")
    parser.add_argument("--seconds", type=float, default=60, help="of all threads, for one picture")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--scenes", help="their names, with commas")
    parser.add_argument("--renderers", default=",".join(RENDERERS))
    parsed = parser.parse_args()
    parsed.folder.mkdir(parents=True, exist_ok=True)
    parsed.folder = parsed.folder.resolve()
    os.environ["LP_NUM_THREADS"] = str(parsed.threads)
    budget = parsed.seconds * parsed.threads
    rows = []
    scenes = path_scenes.all_scenes(parsed.folder, parsed.surroundings)
    for name, scene in scenes.items():
        if parsed.scenes and name not in parsed.scenes.split(","):
            continue
        renderers = Renderers(parsed, name, scene)
        counts, least, found = {}, {}, {}
        for renderer in parsed.renderers.split(","):
            # The first fills the shader cache, and what it takes to begin is in both.
            renderers.render(renderer, 1, 0)
            least[renderer] = renderers.render(renderer, 1, 0)[2]
            samples, cpu = 4, 0
            while cpu - least[renderer] < budget / 12:
                samples *= 2
                cpu = renderers.render(renderer, samples, 0)[2]
            counts[renderer] = max(1, round(samples * budget / (cpu - least[renderer])))
            found[renderer] = []
        for seed in (1, 2):
            for renderer in list(found)[::3 - 2 * seed]:
                found[renderer].append(renderers.render(renderer, counts[renderer], seed))
        records = {}
        for renderer in found:
            pictures, walls, cpus = zip(*found[renderer])
            cpu = sum(cpus) / len(cpus)
            error = relative_error(*pictures) * (cpu - least[renderer] if renderer == "glimray" else cpu) / budget
            rate = counts[renderer] * pictures[0][..., 0].size / 1e6 / (sum(walls) / 2)
            records[renderer] = {"scene": name, "renderer": renderer, "samples": counts[renderer], "wall": walls, "cpu": cpus,
                                 "rate": rate, "mean": (sum(pictures) / 2).mean(), "error": error}
            print(json.dumps(records[renderer]), file=sys.stderr, flush=True)
        own = records.get("glimray")
        for renderer, r in records.items():
            ratios = [f"{own[key] / r[key]:.2f}" if own and r is not own else "" for key in ("rate", "error")]
            rows.append([name, renderer, r["samples"], f"{sum(r['wall']) / 2:.1f}", f"{sum(r['cpu']) / 2:.0f}",
                         f"{r['rate']:.2f}", ratios[0], f"{r['mean']:.4f}", f"{r['error']:.2e}", ratios[1]])
    print(tables.table(["scene", "renderer", "samples", "wall s", "CPU s", "Msamples/s", "glimray's / this", "mean",
                        "relative MSE", "glimray's / this"], rows))


if __name__ == "__main__":
    main()
