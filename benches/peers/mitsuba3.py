#!/usr/bin/env python3
"""Traces ray sets with Mitsuba, and renders two meshes with Mitsuba and glimray in turn.

Mitsuba's LLVM variant calls Embree with packets of 8 rays or as many as the processor takes, in a coherent and an
incoherent way; both are measured. The renders are direct lighting of diffuse meshes: one camera ray through each
pixel and one shadow ray per light at each hit, as `glimray render --max-depth 0` traces.

With `--variant cuda_ad_rgb` OptiX traces the ray sets on an NVIDIA GPU. Seconds are then those of the kernels, and nothing is
rendered.
"""

import argparse
import json
import os
import subprocess
from math import pi
from typing import NamedTuple

import drjit as dr
import mitsuba as mi
import numpy as np

import raysets
import spd
import tables

SIDE = 1024


def mesh(triangles):
    shape = mi.Mesh("triangles", len(triangles) * 3, len(triangles))
    values = mi.traverse(shape)
    values["vertex_positions"] = triangles.ravel()
    values["faces"] = np.arange(len(triangles) * 3, dtype=np.uint32)
    values.update()
    return shape


def trace_sets(parsed):
    """A record for each ray set, number of threads and kind of query."""
    is_cuda = parsed.variant.startswith("cuda")
    dr.set_flag(dr.JitFlag.KernelHistory, is_cuda)
    records = []
    for triangles, sets in raysets.scenes(parsed.folder):
        scene = mi.load_dict({"type": "scene", "mesh": mesh(triangles)})
        on_device = {}
        for ray_set in sets:
            columns = np.ascontiguousarray(ray_set.rays.T)
            ray = mi.Ray3f(mi.Point3f(columns[0:3]), mi.Vector3f(columns[3:6]), mi.Float(columns[6]), 0.0, mi.Color0f())
            dr.eval(ray)
            on_device[ray_set.name] = ray

        for threads in [0] if is_cuda else map(int, parsed.threads.split(",")):
            if not is_cuda:
                dr.set_thread_count(threads)
            for coherent in (True,) if is_cuda else (True, False):

                def query(ray_set):
                    ray = on_device[ray_set.name]
                    if ray_set.any_hit:
                        found = scene.ray_test(ray, coherent=coherent)
                    else:
                        found = scene.ray_intersect_preliminary(ray, coherent=coherent).t
                    dr.eval(found)
                    dr.sync_thread()
                    return found

                def trace(ray_set):
                    dr.kernel_history_clear()
                    seconds, found = raysets.timed(query, ray_set)
                    if is_cuda:
                        seconds = sum(kernel["execution_time"] for kernel in dr.kernel_history()) / 1e3
                    found = found.numpy()
                    if ray_set.any_hit:
                        return seconds, np.count_nonzero(found), 0.0
                    is_hit = np.isfinite(found)
                    return seconds, np.count_nonzero(is_hit), found[is_hit].sum(dtype=np.float64)

                peer = "Mitsuba, " + ("OptiX" if is_cuda else "coherent" if coherent else "incoherent")
                records += raysets.measure(peer, sets, threads, parsed.rounds, trace)
    return records


def write_ply(path, triangles):
    """Binary, with three vertices per triangle."""
    count = len(triangles)
    header = f"""ply
format binary_little_endian 1.0
element vertex {count * 3}
property float x
property float y
property float z
element face {count}
property list uchar int vertex_indices
end_header
"""
    faces = np.empty(count, [("corners", "u1"), ("indices", "<i4", 3)])
    faces["corners"] = 3
    faces["indices"] = np.arange(count * 3).reshape(-1, 3)
    path.write_bytes(header.encode() + triangles.astype("<f4").tobytes() + faces.tobytes())


class Setting(NamedTuple):
    """The view of a mesh, and the direction of the light that shines on it."""

    look_from: list
    look_at: list
    up: list
    fov_y: float
    light: list


def settings(folder):
    """Name, triangles and setting of each render."""
    hills = np.fromfile(folder / "heightfield" / "triangles.f32", "<f4").reshape(-1, 3, 3)
    corner = [0.55, 0.45, 0.75]
    yield "heightfield", hills, Setting(corner, [0.0, -0.05, 0.0], [0.0, 1.0, 0.0], 60.0, [-2.0, -1.0, -1.0])
    tetra = spd.tetra(spd.SIZES["tetra"])
    triangles = np.array([t for polygon in tetra.groups[0][1] for t in spd.triangles(polygon.corners)], np.float32)
    view = [list(map(float, v)) for v in tetra.view[:3]]
    yield "tetra", triangles, Setting(*view, tetra.view.angle, [-float(x) for x in tetra.lights[0]])


def glimray_scene(mesh_file, setting):
    """A native scene: a grey diffuse mesh in sunlight."""
    return f"""[camera]
look_from = {setting.look_from}
look_at = {setting.look_at}
up = {setting.up}
fov_y_deg = {setting.fov_y}

[output]
size = [{SIDE}, {SIDE}]
samples = 1
max_depth = 0

[materials.grey.phong]
diffuse = [0.5, 0.5, 0.5]

[[lights]]
directional = {{ direction = {setting.light} }}

[[objects]]
mesh = {{ file = "{mesh_file.name}" }}
material = "grey"
"""


def mitsuba_scene(mesh_file, setting):
    """The same scene. Mitsuba divides a diffuse colour by π; glimray does not."""
    grey = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}}
    to_world = mi.ScalarTransform4f().look_at(setting.look_from, setting.look_at, setting.up)
    film = {"type": "hdrfilm", "width": SIDE, "height": SIDE, "rfilter": {"type": "box"}}
    return mi.load_dict(
        {
            "type": "scene",
            "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
            "sensor": {
                "type": "perspective",
                "fov": setting.fov_y,
                "fov_axis": "y",
                "to_world": to_world,
                "film": film,
                "sampler": {"type": "independent", "sample_count": 1},
            },
            "light": {"type": "directional", "direction": setting.light, "irradiance": {"type": "rgb", "value": pi}},
            "mesh": {
                "type": "ply",
                "filename": str(mesh_file),
                "face_normals": True,
                "bsdf": {"type": "twosided", "bsdf": grey},
            },
        }
    )


def render_meshes(parsed):
    """Renders each mesh with both programs in turn; a record for each."""
    threads = int(parsed.threads.split(",")[-1])
    dr.set_thread_count(threads)
    environment = {**os.environ, "LP_NUM_THREADS": str(threads), "NODEVICE_SELECT": "1"}
    folder = parsed.folder / "renders"
    folder.mkdir(parents=True, exist_ok=True)
    for name, triangles, setting in settings(parsed.folder):
        mesh_file, scene_file = folder / f"{name}.ply", folder / f"{name}.toml"
        write_ply(mesh_file, triangles)
        scene_file.write_text(glimray_scene(mesh_file, setting))
        scene = mitsuba_scene(mesh_file, setting)
        picture, report = folder / f"{name}.exr", folder / f"{name}.json"
        command = [parsed.glimray, "render", scene_file, "-o", picture, "--report", report, "--quiet"]

        def with_mitsuba():
            image = mi.render(scene, spp=1)
            dr.eval(image)
            dr.sync_thread()
            return image

        def with_glimray():
            subprocess.run(command, check=True, env=environment)
            return json.loads(report.read_text())["seconds"]["trace"]

        # The first of each compiles its kernels.
        image = with_mitsuba()
        with_glimray()
        pairs = []
        for _ in range(parsed.rounds):
            seconds, _ = raysets.timed(with_mitsuba)
            pairs.append((seconds, with_glimray()))
        means = [float(np.mean(np.array(values)[..., :3])) for values in (image, mi.Bitmap(str(picture)))]
        yield {
            "peer": "Mitsuba",
            "render": name,
            "what": "trace",
            "threads": threads,
            "peer_seconds": [a for a, _ in pairs],
            "glimray_seconds": [b for _, b in pairs],
            "means": means,
        }


def main():
    parser = raysets.arguments(argparse.ArgumentParser(description=__doc__))
    parser.add_argument("--glimray", default="target/release/glimray", help="the program [default: %(default)s]")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba [default: %(default)s]")
    parsed = parser.parse_args()
    mi.set_variant(parsed.variant)
    raysets.report(trace_sets(parsed), parsed.json)
    if parsed.variant.startswith("cuda"):
        return
    renders = list(render_meshes(parsed))
    print(tables.renders(renders))
    for r in renders:
        print(f"{r['render']}: mean radiance {r['means'][0]:.5f} (Mitsuba), {r['means'][1]:.5f} (glimray)")
    if parsed.json:
        with parsed.json.open("a") as file:
            file.writelines(json.dumps(r) + "\n" for r in renders)


if __name__ == "__main__":
    main()
