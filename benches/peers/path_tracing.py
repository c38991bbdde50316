#!/usr/bin/env python3
"""Path-traces the same boxes with Mitsuba (variants scalar_rgb and llvm_ad_rgb) and glimray.

Prints samples per second of all, measured in turn, and how well the pictures agree: the ratio of their means, and the
share of pixels whose difference is within the noise. With --references it writes pictures of the mean of Mitsuba's scalar
variant and of the variance of that mean, and the scenes, for the tests (tests/references/paths).
"""

import argparse
import json
import subprocess
import tempfile
import time
from dataclasses import dataclass
from math import pi, sqrt, tau
from pathlib import Path
from statistics import NormalDist, median

import mitsuba as mi
import numpy as np

import tables

# Of Mitsuba. The first is the slower; it compiles nothing.
VARIANTS = "scalar_rgb", "llvm_ad_rgb"
mi.set_variant(VARIANTS[0])

LAMP = {"edge_u": 0.4, "edge_v": 0.35, "strength": [2.6, 2.08, 1.56]}
CAMERA = {"look_from": [0, 1, 4.9], "look_at": [0, 1, 0], "fov_y_deg": 28.6}
MATTE = {"white": [0.73, 0.72, 0.69], "red": [0.62, 0.06, 0.05], "green": [0.13, 0.45, 0.09]}
WALLS = [
    ([0, 0, 0], [0, 1, 0], "white"),
    ([0, 2, 0], [0, -1, 0], "white"),
    ([0, 1, -1], [0, 0, 1], "white"),
    ([-1, 1, 0], [1, 0, 0], "red"),
    ([1, 1, 0], [-1, 0, 0], "green"),
]
SPHERES = ([0.42, 0.36, 0.3], 0.36), ([-0.42, 0.5, -0.3], 0.5)
# Reflectance 1 at every angle: Mitsuba's rough metals have no Fresnel's factor of a colour.
METALS = {"polished": 0.2, "satin": 0.35, "dull": 0.7}
ROUGHNESS_OF_GLASS = 0.5
# Width and height in texels.
SKY_SIZE = 128, 64


@dataclass
class Box:
    """The materials of the two spheres; the bounces after the first hit, None is without a limit; glimray's --bsdf; and
    whether they stand in the box with its lamp, or on its floor under a sky. Mitsuba's microfacets are those of glTF's
    specification, without compensation; its Fresnel's factor is exact, where that has Schlick's approximation. Objects that
    shine stand in the box instead of its lamp, and of the spheres."""

    materials: tuple
    bounces: int | None
    bsdf: str = "full"
    has_sky: bool = False
    objects: tuple = ()


@dataclass
class Object:
    """A "box" or "rectangle" from -1 to 1, the latter facing z, or a "sphere" of radius 1, scaled, turned about the axis x and then y, and
    moved. "triangles" are a box."""

    kind: str
    material: str
    center: tuple
    scale: tuple
    turn: tuple = (0, 0)


# The radiance of what shines, from its front.
GLOWS = {"warm": [9, 6, 3], "cold": [2, 4, 7], "bright": [40, 40, 40]}
PLATES = (
    Object("rectangle", "satin", (-0.45, 0.35, 0), (0.4, 0.5, 1), (-50, 0)),
    Object("rectangle", "dull", (0.45, 0.3, 0.1), (0.4, 0.5, 1), (-65, 0)),
    Object("rectangle", "polished", (0, 0.05, 0.45), (0.7, 0.3, 1), (-88, 0)),
)


SCENES = {
    "matte": Box(("white", "white"), 4),
    "glass": Box(("glass", "mirror"), None),
    "metal": Box(("satin", "dull"), None, "spec"),
    "frosted": Box(("frosted", "white"), None, "spec"),
    "sky": Box(("satin", "white"), 4, "spec", True),
    "glowing_box": Box((), 4, "spec", objects=(*PLATES, Object("box", "warm", (0, 1.3, -0.2), (0.3, 0.1, 0.2), (20, 30)))),
    "glowing_triangles": Box((), 4, "spec",
                             objects=(*PLATES, Object("triangles", "warm", (0.2, 1.2, 0), (0.25, 0.1, 0.25), (-20, 50)))),
    "glowing_sphere": Box((), 4, "spec", objects=(*PLATES, Object("sphere", "bright", (-0.1, 1.4, 0), (0.08, 0.08, 0.08)))),
    # The back of the panel is close to the ceiling and must not light it.
    "panel": Box((), 4, "spec", objects=(*PLATES, Object("rectangle", "warm", (0, 1.98, 0), (0.4, 0.35, 1), (90, 0)))),
    "lamps": Box((), 4, "spec", objects=(
        *PLATES,
        Object("box", "cold", (-0.6, 1.3, -0.3), (0.1, 0.3, 0.1), (0, 40)),
        Object("sphere", "bright", (0.6, 1.5, 0.2), (0.05, 0.05, 0.05)),
        Object("rectangle", "warm", (0, 1.6, -0.9), (0.3, 0.2, 1)),
        Object("triangles", "warm", (0.1, 1.0, 0.3), (0.05, 0.05, 0.05), (30, 30)),
    )),
}


def sky(u, v):
    """A smooth sky with a wide sun; u and v are 0 to 1 from the upper left corner of a panorama."""
    longitude, latitude = tau * (u - 0.5), pi * (0.5 - v)
    toward = np.stack([np.cos(latitude) * np.sin(longitude), np.sin(latitude), -np.cos(latitude) * np.cos(longitude)], -1)
    up, toward_sun = toward[..., 1:2], toward @ np.array([[-0.6], [0.64], [0.48]])
    return (0.3 + 0.2 * up) * [0.7, 0.9, 1.3] + 12 * np.exp(40 * (toward_sun - 1)) * [1, 0.85, 0.6]


def panorama(width, height, top, step):
    """The sky in texels, the first row of which is at `top` and each next one `step` below."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, top + step * np.arange(height))
    return sky(u, v).astype(np.float32)


def native(name):
    """The scene in glimray's format."""
    scene = SCENES[name]
    lines = ["# Written by benches/peers/path_tracing.py."]
    if scene.has_sky:
        lines.append('background = { picture = "sky.exr" }')
    lines.append("[camera]")
    lines += [f"{key} = {value}" for key, value in CAMERA.items()]
    if not scene.has_sky and not scene.objects:
        lines += [
            "[[lights]]",
            f"rectangle = {{ center = [0, 1.98, 0], edge_u = [{LAMP['edge_u']}, 0, 0], edge_v = [0, 0, {LAMP['edge_v']}], "
            f"color = {LAMP['strength']} }}",
        ]
    lines.append("[materials]")
    lines += [f"{key} = {{ phong = {{ diffuse = {value} }} }}" for key, value in MATTE.items()]
    lines += [
        'glass = { refract = { ior = 1.5 } }',
        'mirror = { phong = { diffuse = [0, 0, 0] }, reflect = { color = [0.9, 0.9, 0.9] } }',
        f"frosted = {{ pbr = {{ base_color = [1, 1, 1], transmission = 1, thickness = 1, ior = 1.5, roughness = {ROUGHNESS_OF_GLASS} }} }}",
    ]
    lines += [f"{key} = {{ pbr = {{ base_color = [1, 1, 1], metallic = 1, roughness = {roughness} }} }}"
              for key, roughness in METALS.items()]
    lines += [f"{key} = {{ phong = {{ diffuse = [0, 0, 0] }}, emission = {radiance}, two_sided_emission = false }}"
              for key, radiance in GLOWS.items()]
    for center, normal, material in WALLS[:1] if scene.has_sky else WALLS:
        lines += [
            "[[objects]]",
            f"rectangle = {{ center = {center}, normal = {normal}, size = [2, 2] }}",
            f'material = "{material}"',
        ]
    for (center, radius), material in zip(SPHERES, scene.materials):
        lines += [
            "[[objects]]",
            f"sphere = {{ center = {center}, radius = {radius} }}",
            f'material = "{material}"',
        ]
    for one in scene.objects:
        forms = {
            "box": ["box = { min = [-1, -1, -1], max = [1, 1, 1] }"],
            "sphere": ["sphere = { center = [0, 0, 0], radius = 1 }"],
            "rectangle": ["rectangle = { center = [0, 0, 0], normal = [0, 0, 1], size = [2, 2] }"],
            "triangles": [f"triangle = {{ vertices = {corners} }}" for corners in triangles()],
        }
        for form in forms[one.kind]:
            lines += [
                "[[objects]]",
                form,
                f"transform = {{ translate = {list(one.center)}, rotate_deg = {[*one.turn, 0]}, scale = {list(one.scale)} }}",
                f'material = "{one.material}"',
            ]
    return "\n".join(lines) + "\n"


def triangles():
    """The corners of the triangles of a box from -1 to 1, counter-clockwise as seen from outside."""
    for axis in range(3):
        for side in (-1, 1):
            def corner(u, v):
                point = [0, 0, 0]
                point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = side, side * u, v
                return point
            yield [corner(-1, -1), corner(1, -1), corner(1, 1)]
            yield [corner(-1, -1), corner(1, 1), corner(-1, 1)]


def rgb(values):
    return {"type": "rgb", "value": values}


def bsdf(material):
    if material == "glass":
        return {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}
    if material == "mirror":
        return {"type": "conductor", "material": "none", "specular_reflectance": rgb([0.9, 0.9, 0.9])}
    if material == "frosted":
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": ROUGHNESS_OF_GLASS**2, "int_ior": 1.5,
                "ext_ior": 1.0}
    if material in METALS:
        return {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": METALS[material] ** 2,
                "specular_reflectance": rgb([1, 1, 1])}
    if material in GLOWS:
        return {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
    return {"type": "diffuse", "reflectance": rgb(MATTE[material])}


def rectangle(center, normal, half, material, **more):
    up = [0, 0, 1] if abs(normal[1]) > 0.5 else [0, 1, 0]
    origin = mi.ScalarPoint3f(*center)
    place = mi.ScalarTransform4f().look_at(origin=origin, target=origin + mi.ScalarVector3f(*normal), up=up)
    return {"type": "rectangle", "to_world": place @ mi.ScalarTransform4f().scale([*half, 1]), "bsdf": material, **more}


def peer(name, side):
    """The scene for Mitsuba."""
    box = SCENES[name]
    # Mitsuba counts the segments of a path: the camera's, and that to the light.
    depth = -1 if box.bounces is None else box.bounces + 2
    camera = mi.ScalarTransform4f().look_at(origin=CAMERA["look_from"], target=CAMERA["look_at"], up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}, "pixel_format": "rgb",
            "component_format": "float32"}
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": depth},
        "sensor": {"type": "perspective", "fov": CAMERA["fov_y_deg"], "fov_axis": "y", "to_world": camera, "film": film,
                   "sampler": {"type": "independent"}},
    }
    if box.has_sky:
        # Unlike glimray's, the centres of its first and its last row are the poles.
        texels = panorama(*SKY_SIZE, 0, 1 / (SKY_SIZE[1] - 1))
        turn = mi.ScalarTransform4f().rotate([0, 1, 0], 180)
        scene["sky"] = {"type": "envmap", "bitmap": mi.Bitmap(texels), "to_world": turn}
    elif not box.objects:
        area = 4 * LAMP["edge_u"] * LAMP["edge_v"]
        radiance = [strength * pi / area for strength in LAMP["strength"]]
        # A visible lamp of glimray reflects nothing.
        black = {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
        scene["lamp"] = rectangle([0, 1.98, 0], [0, -1, 0], [LAMP["edge_u"], LAMP["edge_v"]], black,
                                  emitter={"type": "area", "radiance": rgb(radiance)})
    for i, (center, normal, material) in enumerate(WALLS[:1] if box.has_sky else WALLS):
        scene[f"wall{i}"] = rectangle(center, normal, [1, 1], bsdf(material))
    for i, ((center, radius), material) in enumerate(zip(SPHERES, box.materials)):
        scene[f"sphere{i}"] = {"type": "sphere", "center": center, "radius": radius, "bsdf": bsdf(material)}
    for i, one in enumerate(box.objects):
        place = (mi.ScalarTransform4f().translate(one.center) @ mi.ScalarTransform4f().rotate([0, 1, 0], one.turn[1])
                 @ mi.ScalarTransform4f().rotate([1, 0, 0], one.turn[0]) @ mi.ScalarTransform4f().scale(one.scale))
        kind = {"box": "cube", "triangles": "cube"}.get(one.kind, one.kind)
        surface = bsdf(one.material)
        if one.kind == "rectangle" and one.material in METALS:
            surface = {"type": "twosided", "bsdf": surface}
        scene[f"object{i}"] = {"type": kind, "to_world": place, "bsdf": surface}
        if one.material in GLOWS:
            scene[f"object{i}"]["emitter"] = {"type": "area", "radiance": rgb(GLOWS[one.material])}
    return mi.load_dict(scene)


def rendered(program, file, name, side, samples, seed):
    """Picture and seconds of tracing of glimray."""
    box = SCENES[name]
    with tempfile.TemporaryDirectory() as folder:
        picture, report = Path(folder, "a.exr"), Path(folder, "a.json")
        subprocess.run(
            [program, "render", file, "--integrator", "path", "--size", f"{side}x{side}", "--samples", str(samples),
             "--max-depth", str(1000 if box.bounces is None else box.bounces), "--bsdf", box.bsdf, "--seed", str(seed), "--quiet",
             "--report", report, "-o", picture],
            check=True,
        )
        bitmap = mi.Bitmap(str(picture)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        return np.array(bitmap, dtype=np.float64), json.loads(report.read_text())["seconds"]["trace"]


def moments(pictures):
    """Mean of independent pictures, and the variance of that mean."""
    pictures = np.array(pictures)
    return pictures.mean(axis=0), pictures.var(axis=0, ddof=1) / len(pictures)


def write_scene(folder, name):
    """The scene of `native`, and the picture that it names."""
    file = folder / f"{name}.toml"
    file.write_text(native(name))
    if SCENES[name].has_sky:
        texels = panorama(*SKY_SIZE, 0.5 / SKY_SIZE[1], 1 / SKY_SIZE[1])
        mi.Bitmap(texels).write(str(folder / "sky.exr"))
    return file


def compare(program, names, side, samples, rounds):
    rows = []
    for name in names:
        scenes, theirs, ours, seconds = {}, [], [], {variant: [] for variant in ("glimray", *VARIANTS)}
        with tempfile.TemporaryDirectory() as folder:
            file = write_scene(Path(folder), name)
            rendered(program, file, name, side, 1, 0)
            # The first round compiles the kernels and does not count.
            for seed in range(rounds + 1):
                for variant in VARIANTS:
                    mi.set_variant(variant)
                    if variant not in scenes:
                        scenes[variant] = peer(name, side)
                    start = time.perf_counter()
                    picture = np.array(mi.render(scenes[variant], spp=samples, seed=seed), dtype=np.float64)
                    if seed > 0:
                        seconds[variant].append(time.perf_counter() - start)
                        theirs.append(picture)
                if seed > 0:
                    picture, took = rendered(program, file, name, side, samples, seed)
                    ours.append(picture)
                    seconds["glimray"].append(took)
        (a, a_variance), (b, b_variance) = moments(ours), moments(theirs)
        # Both round: the lamp itself has no noise.
        z = (a - b) / np.sqrt(a_variance + b_variance + (1e-4 * b) ** 2 + 1e-20)
        # So that all pixels of equal pictures pass with a chance of 99 %.
        limit = NormalDist().inv_cdf(1 - (1 - 0.99 ** (1 / z.size)) / 2) * sqrt(rounds / max(rounds - 3, 1))
        rates = [f"{side * side * samples / 1e6 / median(times):.2f}" for times in seconds.values()]
        ratios = [tables.spread([b / a for a, b in zip(seconds["glimray"], seconds[variant])]) for variant in VARIANTS]
        rows.append([name, *rates, *ratios, f"{a.mean() / b.mean():.4f}", f"{100 * (abs(z) < limit).mean():.2f} %"])
    head = [f"glimray / {variant}" for variant in VARIANTS]
    print(tables.table(["scene", "glimray, Msamples/s", *VARIANTS, *head, "ratio of means", "pixels within noise"], rows))


def write_references(folder, names, side, samples, rounds):
    folder.mkdir(parents=True, exist_ok=True)
    mi.set_variant(VARIANTS[0])
    for name in names:
        scene = peer(name, side)
        pictures = [np.array(mi.render(scene, spp=samples, seed=seed)) for seed in range(1, rounds + 1)]
        mean, variance = moments(pictures)
        for kind, picture in (("mean", mean), ("variance", variance)):
            mi.Bitmap(picture.astype(np.float32)).write(str(folder / f"{name}-{kind}.exr"))
        write_scene(folder, name)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--glimray", default="target/release/glimray")
    parser.add_argument("--scenes", nargs="+", default=list(SCENES), choices=SCENES)
    parser.add_argument("--side", type=int, default=128, help="width and height in pixels")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=8)
    parser.add_argument("--bounces", type=int, help="after the first hit, instead of the scene's own")
    parser.add_argument("--references", type=Path, help="write them here instead")
    parsed = parser.parse_args()
    if parsed.bounces is not None:
        for box in SCENES.values():
            box.bounces = parsed.bounces
    if parsed.references:
        write_references(parsed.references, parsed.scenes, parsed.side, parsed.samples, parsed.rounds)
    else:
        compare(parsed.glimray, parsed.scenes, parsed.side, parsed.samples, parsed.rounds)


if __name__ == "__main__":
    main()
