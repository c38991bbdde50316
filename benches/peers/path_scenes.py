"""Scenes of path-traced comparisons, in a form that each renderer is given in its own terms.

Lengths are in scene units, y is up, radiances have no unit: 1 is the white of a picture without a tone curve.
"""

import json
import shutil
import struct
import zlib
from dataclasses import dataclass, field
from math import atan2, cos, pi, sin, tau
from pathlib import Path

import numpy as np

# After the first hit, for all renderers.
BOUNCES = 16


@dataclass
class Material:
    """Exactly one of: a matte surface, a metal, clear glass, a surface that shines."""

    matte: tuple | None = None
    metal: tuple | None = None
    roughness: float = 0.0
    ior: float | None = None
    radiance: tuple | None = None


@dataclass
class Mesh:
    vertices: np.ndarray  # n × 3
    triangles: np.ndarray  # n × 3 indices
    material: Material


@dataclass
class Rectangle:
    """A lamp that shines along edge_u × edge_v; the edges lead from its centre to the middle of its sides."""

    center: tuple
    edge_u: tuple
    edge_v: tuple
    radiance: tuple


@dataclass
class Sphere:
    """A lamp."""

    center: tuple
    radius: float
    radiance: tuple


@dataclass
class Model:
    """A glTF file, and what is in it: see `write_glb`."""

    path: Path
    meshes: list
    materials: list
    images: list = field(default_factory=list)


@dataclass
class Scene:
    name: str
    look_from: tuple
    look_at: tuple
    fov_y_deg: float
    meshes: list = field(default_factory=list)
    rectangles: list = field(default_factory=list)
    spheres: list = field(default_factory=list)
    environment: Path | None = None  # equirectangular, with -z in the centre
    model: Model | None = None  # instead of the meshes


MATTE = {"white": (0.73, 0.72, 0.69), "red": (0.62, 0.06, 0.05), "green": (0.13, 0.45, 0.09), "blue": (0.1, 0.2, 0.5)}


def matte(color):
    return Material(matte=MATTE.get(color, color))


def quad(corner, u, v, material):
    """A parallelogram that faces along u × v."""
    corner, u, v = (np.array(a, float) for a in (corner, u, v))
    return Mesh(np.array([corner, corner + u, corner + u + v, corner + v]), np.array([[0, 1, 2], [0, 2, 3]]), material)


def box(center, half, material, turn_y=0.0, turn_x=0.0):
    """A box, turned about x and then about y by angles in radians."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    about_x = np.array([[1, 0, 0], [0, cos(turn_x), -sin(turn_x)], [0, sin(turn_x), cos(turn_x)]])
    about_y = np.array([[cos(turn_y), 0, sin(turn_y)], [0, 1, 0], [-sin(turn_y), 0, cos(turn_y)]])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [(a, b, c) for f in faces for a, b, c in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
    return Mesh(signs * half @ about_x.T @ about_y.T + center, np.array(triangles), material)


def revolved(around, across, point):
    """Two triangles for each cell of a grid that closes in both directions; `point` maps two angles to a point."""
    grid = [point(tau * i / around, tau * j / across) for i in range(around) for j in range(across)]
    i, j = (a.ravel() for a in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))
    at = lambda i, j: (i % around) * across + j % across
    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
    return np.array(grid), np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])


def torus(center, radius, tube, material, around=96, across=24):
    """A ring about an axis that is inclined a little."""
    def point(s, t):
        x, y, z = (radius + tube * cos(t)) * cos(s), tube * sin(t), -(radius + tube * cos(t)) * sin(s)
        return x, y * cos(0.6) - z * sin(0.6), y * sin(0.6) + z * cos(0.6)
    vertices, triangles = revolved(around, across, point)
    return Mesh(vertices + center, triangles, material)


def gem(center, radius, material):
    """An icosahedron, each face of which is divided into four: 80 facets."""
    g = (1 + 5**0.5) / 2
    points = [p for a in (-1, 1) for b in (-g, g) for p in ((0, a, b), (a, b, 0), (b, 0, a))]
    points = [np.array(p) / np.linalg.norm(p) for p in points]
    edge = min(np.linalg.norm(points[0] - p) for p in points[1:]) * 1.01
    near = lambda i, j: i != j and np.linalg.norm(points[i] - points[j]) < edge
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near(i, j) and near(j, k) and near(i, k)]
    corners = []
    for a, b, c in ((points[i], points[j], points[k]) for i, j, k in faces):
        if np.dot(np.cross(b - a, c - a), a) < 0:
            b, c = c, b
        ab, bc, ca = ((p + q) / np.linalg.norm(p + q) for p, q in ((a, b), (b, c), (c, a)))
        corners += [a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]
    return Mesh(np.array(corners) * radius + center, np.arange(len(corners)).reshape(-1, 3), material)


def walls():
    """A box with an open front: 2 wide, high and deep."""
    return [
        quad((-1, 0, 1), (2, 0, 0), (0, 0, -2), matte("white")),
        quad((-1, 2, -1), (2, 0, 0), (0, 0, 2), matte("white")),
        quad((-1, 0, -1), (2, 0, 0), (0, 2, 0), matte("white")),
        quad((-1, 0, 1), (0, 0, -2), (0, 2, 0), matte("red")),
        quad((1, 0, -1), (0, 0, 2), (0, 2, 0), matte("green")),
    ]


def boxed(name, meshes, lamps=True):
    lamp = Rectangle((0, 1.98, 0), (0.4, 0, 0), (0, 0, 0.35), (14.6, 11.7, 8.8))
    return Scene(name, (0, 1, 4.9), (0, 1, 0), 28.6, walls() + meshes, [lamp] if lamps else [])


def cornell():
    blocks = [box((0.33, 0.301, 0.35), (0.3, 0.3, 0.3), matte("white"), -0.3),
              box((-0.33, 0.601, -0.3), (0.3, 0.6, 0.3), matte("white"), 0.3)]
    return boxed("cornell", blocks)


def glass():
    clear = Material(ior=1.5)
    return boxed("glass", [gem((-0.4, 0.5, 0.1), 0.45, clear), box((0.45, 0.4, 0.1), (0.1, 0.35, 0.3), clear, 0.4)])


def quad_lit():
    """The Cornell box, with a quad that shines in place of its lamp."""
    scene = cornell()
    lamp = scene.rectangles.pop()
    u, v = 2 * np.array(lamp.edge_u), 2 * np.array(lamp.edge_v)
    scene.name, corner = "cornell quad", np.array(lamp.center) - u / 2 - v / 2
    scene.meshes.append(quad(corner, u, v, Material(radiance=lamp.radiance)))
    return scene


def glowing():
    shine = Material(radiance=(16, 10, 5))
    return boxed("glowing mesh", [torus((0.1, 1.35, -0.1), 0.3, 0.05, shine),
                                  box((-0.4, 0.401, -0.2), (0.25, 0.4, 0.25), matte("blue"), 0.4)], lamps=False)


def plates():
    """After Veach (1997), figure 8.2: four plates, rough in different ways, reflect four lamps of different sizes."""
    scene = Scene("plates", (0, 2, 14), (0, -0.6, 0), 28)
    scene.meshes = [quad((-8, -4, 8), (16, 0, 0), (0, 0, -16), matte((0.4, 0.4, 0.4))),
                    quad((-8, -4, -5), (16, 0, 0), (0, 12, 0), matte((0.4, 0.4, 0.4)))]
    for roughness, y, z in ((0.07, 0.6, -2.8), (0.22, -0.5, -1.4), (0.32, -1.6, 0.2), (0.45, -2.6, 2.2)):
        place = np.array((0, y, z))
        unit = lambda v: v / np.linalg.norm(v)
        # The normal is midway between the directions to the camera and to the lamps.
        normal = unit(unit(np.array(scene.look_from) - place) + unit(np.array((0, 2.6, -1.5)) - place))
        material = Material(metal=(0.6, 0.65, 0.7), roughness=roughness)
        scene.meshes.append(box(place, (4, 0.5, 0.02), material, 0, atan2(-normal[1], normal[2])))
    for x, radius, color in ((-3.4, 0.033, (1, 0.5, 0.4)), (-1.3, 0.1, (1, 0.9, 0.4)), (0.9, 0.3, (0.5, 1, 0.6)),
                             (3.4, 0.9, (0.4, 0.6, 1))):
        scene.spheres.append(Sphere((x, 2.6, -1.5), radius, tuple(0.9 * c / radius**2 for c in color)))
    return scene


def glowing_plates():
    """The plates, under spheres of 900 to 2,200 triangles."""
    scene = plates()
    lamps, scene.spheres = scene.spheres[1:], []
    for lamp, cells in zip(lamps, ((30, 15), (40, 20), (44, 25))):
        vertices, _, _, triangles = ball(lamp.center, lamp.radius, *cells)
        scene.meshes.append(Mesh(vertices, triangles, Material(radiance=lamp.radiance)))
    scene.name = "glowing plates"
    return scene


def metals(folder, surroundings):
    """Balls of metals that are rough in different ways, on a matte floor under the light of a picture."""
    floor = quad((-3, 0, 2), (6, 0, 0), (0, 0, -4), matte("white"))
    picture = Path(shutil.copy(surroundings, folder))
    scene = Scene("metals", (0, 1.6, 5.2), (0, 0.35, 0), 32, [floor], environment=picture)
    for i, (color, roughness) in enumerate((((0.95, 0.7, 0.3), 0.1), ((0.9, 0.9, 0.92), 0.25), ((0.95, 0.6, 0.5), 0.4),
                                            ((0.6, 0.65, 0.7), 0.55), ((0.9, 0.85, 0.6), 0.75))):
        vertices, _, _, triangles = ball((0.8 * (i - 2), 0.381, 0.15 * (i % 2)), 0.38)
        scene.meshes.append(Mesh(vertices, triangles, Material(metal=color, roughness=roughness)))
    return scene


def terrain(folder):
    """A height field of 180,000 triangles under a sky with a sun, which has 0.0002 of the directions."""
    def height(x, z):
        return 0.06 * np.sin(tau * 2 * x) * np.sin(tau * (3 * z + 0.25)) + 0.01 * np.sin(tau * 17 * (x + z))
    side = 301
    x, z = (grid.ravel() for grid in np.meshgrid(np.linspace(-0.5, 0.5, side), np.linspace(-0.5, 0.5, side)))
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    a, b, c, d = first, first + side, first + side + 1, first + 1
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    scene = Scene("terrain", (0.55, 0.45, 0.75), (0, -0.05, 0), 40)
    scene.meshes = [Mesh(np.stack([x, height(x, z), z], -1), triangles, matte((0.35, 0.4, 0.22)))]
    scene.environment = sky(folder / "sky.hdr")
    return scene


def helmet(folder, surroundings):
    """A model with maps of its base colour, of its metal and of its roughness."""
    scene = Scene("helmet", (1.6, 1.1, 2.7), (0, 0.1, 0), 36)
    scene.model, scene.environment = helmet_model(folder / "helmet.glb"), Path(surroundings).resolve()
    return scene


def write_hdr(path, picture):
    """Radiance's format, not compressed."""
    exponent = np.ceil(np.log2(np.maximum(picture.max(-1), 1e-30)))
    mantissa = np.clip(picture / 2.0 ** exponent[..., None] * 256, 0, 255).astype(np.uint8)
    texels = np.concatenate([mantissa, (exponent + 128).clip(0, 255).astype(np.uint8)[..., None]], -1)
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {picture.shape[0]} +X {picture.shape[1]}\n"
    path.write_bytes(head.encode() + texels.tobytes())


def sky(path, width=512):
    latitude = pi * (0.5 - (np.arange(width // 2) + 0.5) / (width // 2))
    longitude = tau * ((np.arange(width) + 0.5) / width - 0.5)
    up = np.sin(latitude)[:, None] * np.ones(width)
    picture = np.where(up[..., None] > 0, [0.35, 0.55, 0.95], [0.2, 0.18, 0.15]) * (1 - 0.5 * np.abs(up))[..., None]
    sun_latitude, sun_longitude = 0.45, 2.2
    toward = (np.cos(latitude)[:, None] * np.cos(longitude - sun_longitude) * cos(sun_latitude) + up * sin(sun_latitude))
    picture[np.arccos(np.clip(toward, -1, 1)) < 0.028] = (2500, 2300, 1900)
    write_hdr(path, picture)
    return path


def png(pixels):
    """RGB, 8 bits."""
    height, width, _ = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], 1)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b"")


def write_glb(path, meshes, materials, images=(), places=None):
    """Meshes of (vertices, normals, texture coordinates, triangles, index of the material); materials as in glTF.

    Images are RGB with 8 bits. Each is a texture. Arrays that several meshes share are stored once. With `places`, each
    mesh is moved there."""
    views, accessors, primitives, data, stored = [], [], [], b"", {}

    def view(raw):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(raw)})
        data += raw + b"\0" * (-len(raw) % 4)
        return len(views) - 1

    def accessor(source, kind, number, component):
        if id(source) not in stored:
            values = np.asarray(source, number)
            values = values.ravel() if kind == "SCALAR" else values
            more = {"min": values.min(0).tolist(), "max": values.max(0).tolist()} if kind == "VEC3" else {}
            accessors.append({"bufferView": view(values.tobytes()), "componentType": component, "type": kind,
                              "count": len(values), **more})
            stored[id(source)] = len(accessors) - 1
        return stored[id(source)]

    for vertices, normals, uv, triangles, material in meshes:
        kinds = {"POSITION": (vertices, "VEC3"), "NORMAL": (normals, "VEC3"), "TEXCOORD_0": (uv, "VEC2")}
        attributes = {key: accessor(v, kind, "<f4", 5126) for key, (v, kind) in kinds.items()}
        indices = accessor(triangles, "SCALAR", "<u4", 5125)
        primitives.append({"attributes": attributes, "indices": indices, "material": material})
    nodes = [{"mesh": i} for i in range(len(primitives))]
    for node, place in zip(nodes, places or ()):
        node["translation"] = list(place)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes, "meshes": [{"primitives": [p]} for p in primitives],
        "materials": materials, "accessors": accessors,
    }
    if images:
        document["images"] = [{"bufferView": view(png(image)), "mimeType": "image/png"} for image in images]
        document["textures"] = [{"source": i} for i in range(len(images))]
    used = sorted({name for m in materials for name in m.get("extensions", {})})
    if used:
        document["extensionsUsed"] = used
    document |= {"bufferViews": views, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return Model(path, meshes, materials, list(images))


def ball(center, radius, around=128, across=64):
    """Vertices, normals, texture coordinates and triangles of a sphere."""
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, around + 1), np.linspace(0, 1, across + 1)))
    normals = np.stack([np.sin(pi * v) * np.cos(tau * u), np.cos(pi * v), -np.sin(pi * v) * np.sin(tau * u)], -1)
    first = (np.arange(across)[:, None] * (around + 1) + np.arange(around)).ravel()
    a, b, c, d = first, first + around + 1, first + around + 2, first + 1
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    return normals * radius + np.array(center), normals, np.stack([u, v], -1), triangles


def checks():
    """A picture of a base colour."""
    y, x = np.mgrid[0:256, 0:512]
    red = (np.sin(x / 512 * tau * 12) * np.sin(y / 256 * pi * 6) > 0)[..., None]
    return np.where(red, [200, 60, 40], [230, 225, 215]).astype(np.uint8)


def scratches():
    """A picture of roughness, in green, and metal, in blue."""
    y, x = np.mgrid[0:256, 0:512]
    bare = (np.sin(x / 9.1 + 3 * np.sin(y / 17)) > 0.6)[..., None]
    return np.where(bare, [0, 150, 255], [0, 70, 0]).astype(np.uint8)


def helmet_model(path):
    textured = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}}
    gold = {"pbrMetallicRoughness": {"baseColorFactor": [0.95, 0.7, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.25}}
    dark = {"pbrMetallicRoughness": {"baseColorFactor": [0.05, 0.05, 0.06, 1], "metallicFactor": 0, "roughnessFactor": 0.15}}
    meshes = [(*ball((0, 0.2, 0), 0.8), 0), (*ball((0, 0.15, 0.32), 0.62), 2), (*ball((-0.85, 0.1, 0.1), 0.25), 1),
              (*ball((0.85, 0.1, 0.1), 0.25), 1)]
    floor = np.array([[-3, -0.6, 3], [3, -0.6, 3], [3, -0.6, -3], [-3, -0.6, -3]])
    meshes.append((floor, np.tile([0, 1, 0], (4, 1)), np.zeros((4, 2)), [[0, 1, 2], [0, 2, 3]], 3))
    ground = {"pbrMetallicRoughness": {"baseColorFactor": [0.4, 0.4, 0.4, 1], "metallicFactor": 0, "roughnessFactor": 0.8}}
    return write_glb(path, meshes, [textured, gold, dark, ground], [checks(), scratches()])


def all_scenes(folder, surroundings):
    """The scenes by name. Files that they need are written to `folder`."""
    scenes = [cornell(), quad_lit(), plates(), glowing_plates(), helmet(folder, surroundings), metals(folder, surroundings), glowing(),
              glass(), terrain(folder)]
    return {scene.name.replace(" ", "_"): scene for scene in scenes}
