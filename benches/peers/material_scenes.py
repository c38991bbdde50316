"""Balls of glTF materials under the light of a picture, as scenes of path_scenes.py.

The balls stand in a grid that faces the camera, a ball in each square of the picture.
"""

from dataclasses import dataclass
from math import atan, degrees
from pathlib import Path

import numpy as np

import path_scenes

NAMES = ("core", "extensions")
RADIUS = 0.4
# Of the camera to the centres, in sides of a square.
DISTANCE = 30
# Of a square, in pixels.
SIDE = 48

ROUGHNESSES = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
COLORS = {"white": (0.9, 0.9, 0.9), "red": (0.7, 0.1, 0.05), "blue": (0.05, 0.15, 0.5)}


@dataclass
class Materials:
    """Columns of materials; each has a name, the names of its balls, and the materials as in glTF."""

    columns: list

    def size(self):
        """Of the picture, in pixels."""
        return len(self.columns) * SIDE, len(self.columns[0][2]) * SIDE

    def places(self):
        """Of the balls, column by column."""
        width, height = (n / SIDE for n in self.size())
        return [(x + 0.5 - width / 2, height / 2 - y - 0.5, 0.0) for x in range(int(width)) for y in range(int(height))]


def material(color=(1, 1, 1), metallic=0.0, roughness=1.0, textures=None, **extensions):
    made = {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": metallic,
                                     "roughnessFactor": roughness, **(textures or {})}}
    emissive = extensions.pop("emissive", None)
    if emissive:
        made["emissiveFactor"] = list(emissive)
    if extensions:
        made["extensions"] = {f"KHR_materials_{name}": values for name, values in extensions.items()}
    return made


def core():
    """A column for each base colour and metal; roughness from top to bottom."""
    columns = []

    def column(name, **values):
        made = [material(roughness=roughness, **values) for roughness in ROUGHNESSES]
        columns.append((name, [str(r) for r in ROUGHNESSES], made))

    for name, color in COLORS.items():
        for metallic in (0, 0.5, 1):
            column(f"{name}, metallic {metallic}", color=color, metallic=metallic)
    column("texture of base colour", textures={"baseColorTexture": {"index": 0}})
    column("texture of metal and roughness", color=(0.95, 0.7, 0.3), metallic=1,
           textures={"metallicRoughnessTexture": {"index": 1}})
    return Materials(columns)


def extended():
    """Three balls for each kind of extension."""
    red = COLORS["red"]
    coat = lambda roughness: {"clearcoatFactor": 1, "clearcoatRoughnessFactor": roughness}
    sheen = lambda roughness: {"sheenColorFactor": [0.8, 0.8, 0.8], "sheenRoughnessFactor": roughness}
    passes, solid = {"transmissionFactor": 1}, {"thicknessFactor": 2 * RADIUS}
    tinted = {"attenuationColor": [0.9, 0.3, 0.2], "attenuationDistance": RADIUS}
    glow = lambda strength: material((0.1, 0.1, 0.1), 0, 0.5, emissive=(1, 0.5, 0.2),
                                     emissive_strength={"emissiveStrength": strength})
    index = lambda ior: material(red, 0, 0.3, ior={"ior": ior})
    three = lambda name, values, make: (name, [str(value) for value in values], [make(value) for value in values])
    return Materials([
        three("coat, its roughness", (0.0, 0.3, 0.6), lambda r: material(red, 0, 0.6, clearcoat=coat(r))),
        three("coat on metal, its roughness", (0.0, 0.3, 0.6), lambda r: material(red, 1, 0.4, clearcoat=coat(r))),
        three("sheen, its roughness", (0.3, 0.6, 1.0), lambda r: material((0.1, 0.1, 0.3), 0, 0.8, sheen=sheen(r))),
        three("thin wall, roughness", (0.0, 0.2, 0.5), lambda r: material((0.9,) * 3, 0, r, transmission=passes)),
        three("solid glass, roughness", (0.0, 0.2, 0.5),
              lambda r: material((1, 1, 1), 0, r, transmission=passes, volume=solid)),
        three("tinted glass, roughness", (0.0, 0.2, 0.5),
              lambda r: material((1, 1, 1), 0, r, transmission=passes, volume=solid | tinted)),
        three("emission, its strength", (0.5, 2, 8), glow),
        three("index of refraction", (1.2, 1.8, 2.5), index),
        three("specular", (0.0, 0.5, 1.0), lambda s: material(red, 0, 0.3, specular={"specularFactor": s})),
        three("anisotropy of metal", (0.3, 0.6, 0.9),
              lambda a: material((0.9,) * 3, 1, 0.4, anisotropy={"anisotropyStrength": a})),
    ])


def all_materials():
    return dict(zip(NAMES, (core(), extended())))


def all_scenes(folder, surroundings):
    """The scenes by name. Files that they need are written to `folder`."""
    scenes = {}
    ball = path_scenes.ball((0, 0, 0), RADIUS, 96, 48)
    for name, found in all_materials().items():
        materials = [m for _, _, column in found.columns for m in column]
        images = [path_scenes.checks(), path_scenes.scratches()] if name == "core" else []
        scene = path_scenes.Scene(name, (0, 0, DISTANCE), (0, 0, 0), degrees(2 * atan(found.size()[1] / SIDE / 2 / DISTANCE)))
        scene.model = path_scenes.write_glb(folder / f"{name}.glb", [(*ball, i) for i in range(len(materials))], materials,
                                            images, found.places())
        scene.environment = Path(surroundings).resolve()
        scenes[name] = scene
    return scenes


def masks(found):
    """For each ball the pixels in the middle of which it is seen, without those at its rim."""
    width, height = found.size()
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, height / 2 - np.arange(height) - 0.5)
    toward = np.stack([x / SIDE, y / SIDE, np.full(x.shape, -float(DISTANCE))], -1)
    toward /= np.linalg.norm(toward, axis=-1, keepdims=True)
    eye = np.array((0, 0, DISTANCE))
    # The distance of the centre from the ray.
    return [np.linalg.norm(np.cross(np.array(place) - eye, toward), axis=-1) < 0.97 * RADIUS for place in found.places()]
