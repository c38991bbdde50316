#!/usr/bin/env python3
"""Generates scenes like those of the Standard Procedural Database (E. Haines, "A Proposal for Standard Graphics
Environments", IEEE CG&A 7(11), 1987), each as two files with the same contents: NFF for glimray, .pov for POV-Ray.

    spd.py OUT_FOLDER [KIND…]       balls gears mount rings tetra tree, each at its default size
    spd.py --size N OUT_FOLDER KIND
    spd.py --check FOLDER           compares the generator with SPD's own files, FOLDER/KIND-sN.nff

Constants and construction rules are those of SPD, which is in the public domain. The code is our own.
"""

import argparse
import re
import sys
from math import acos, asin, cos, log, pi, radians, sin, sqrt, tan
from pathlib import Path
from typing import NamedTuple

# The default sizes of SPD: 7,382, 9,345, 8,196, 8,401, 4,096 and 8,191 primitives.
SIZES = {"balls": 4, "gears": 4, "mount": 6, "rings": 7, "tetra": 6, "tree": 11}
BACKGROUND = (0.078, 0.361, 0.753)


class Material(NamedTuple):
    """The values of an NFF fill: colour, Kd, Ks, Phong exponent, transmittance and index of refraction."""

    color: tuple
    diffuse: float
    specular: float = 0.0
    shine: float = 100000.0
    transmit: float = 0.0
    index: float = 0.0


class Sphere(NamedTuple):
    center: tuple
    radius: float


class Cone(NamedTuple):
    """An open cone or cylinder."""

    base: tuple
    base_radius: float
    apex: tuple
    apex_radius: float


class Polygon(NamedTuple):
    """Plane. With more than four corners it must be star-shaped around the mean of its corners."""

    corners: list


class View(NamedTuple):
    """`angle` is the full field of view in degrees."""

    look_from: tuple
    look_at: tuple
    up: tuple
    hither: float
    angle: float = 45.0


class Scene(NamedTuple):
    """`groups` is a list of pairs: a material and the list of shapes that have it."""

    view: View
    lights: list
    groups: list


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(a, factor):
    return tuple(x * factor for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a):
    return scale(a, 1 / sqrt(dot(a, a)))


def rotate(v, axis, angle):
    """Rotates around a unit axis, counterclockwise by `angle` in radians (Rodrigues' formula)."""
    along = scale(axis, dot(axis, v) * (1 - cos(angle)))
    return add(add(scale(v, cos(angle)), scale(cross(axis, v), sin(angle))), along)


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def square(half, height):
    return Polygon([(half, half, height), (-half, half, height), (-half, -half, height), (half, -half, height)])


def balls(size):
    """The sphereflake: each sphere carries nine others of a third of its radius."""
    d = sqrt(0.5)
    tilt = normalize((1, -1, 0)), asin(2 / sqrt(6))
    trio = [rotate(v, *tilt) for v in [(d, d, 0), (d, 0, -d), (0, d, -d)]]
    directions = [rotate(v, Z, turn * 2 * pi / 3) for turn in range(3) for v in trio]
    spheres = []

    def grow(depth, center, radius, outwards):
        spheres.append(Sphere(center, radius))
        if depth == 0:
            return
        axis = cross(Z, outwards)
        if abs(outwards[2]) < 1:
            turn = normalize(axis), acos(outwards[2])
        else:
            turn = Y, 0 if outwards[2] > 0 else pi
        for direction in directions:
            direction = rotate(direction, *turn)
            grow(depth - 1, add(center, scale(direction, radius * 4 / 3)), radius / 3, direction)

    grow(size, (0.0, 0.0, 0.0), 0.5, Z)
    floor = Material((1, 0.75, 0.33), 0.8, index=1)
    mirror = Material((1, 0.9, 0.7), 0.5, 0.5, 3.0827, index=1)
    return Scene(
        View((2.1, 1.3, 1.7), (0, 0, 0), Z, 0.01),
        [(4, 3, 2), (1, -4, 4), (-3, 1, 5)],
        [(floor, [square(12, -0.5)]), (mirror, spheres)],
    )


def gears(size):
    """A cube of interlocking gears, a fifth of them of glass. Their faces are concave and have 144 corners."""
    teeth, depth = 36, 0.1
    outer = 1 / (size - (size - 1) * depth / 2)
    thickness = min(0.1, 1 / (2 * size))
    tooth = 2 * pi / teeth
    profile = [(-0.19, 0.995), (0.19, 0.995), (0.3, 1 - depth), (0.7, 1 - depth)]

    def face(center, first, step):
        angles = ((first + step * (i + part), radius * outer) for i in range(teeth) for part, radius in profile)
        return [add(center, (radius * cos(angle), radius * sin(angle), 0)) for angle, radius in angles]

    def gear(center, first):
        top, below = face(center, first, tooth), (0, 0, -thickness)
        sides = [Polygon([a, add(a, below), add(b, below), b]) for a, b in zip(top, top[1:] + top[:1])]
        return [Polygon(top), *sides, Polygon(face(add(center, below), first, -tooth))]

    def color(ix, iy, iz):
        whole = [(ix * 3 + iy * 2 + iz + 1) * 5, (iy * 3 + iz * 2 + ix + 1) * 3, (iz * 3 + ix * 2 + iy + 1) * 2]
        rgb = [0.01 + part % 7 / 7 for part in whole]
        return tuple(c / max(rgb) for c in rgb)

    groups = [(Material((1, 0.85, 0.7), 0.3, 0.6, 3.0827), [square(2, 0)])]
    spacing = outer * (2 - depth)
    for iz in range(size):
        for iy in range(size):
            for ix in range(size):
                center = (outer - 1 + ix * spacing, outer - 1 + iy * spacing, 1 - iz / size)
                is_glass = (ix * 4 + iy * 2 + iz) % 5 == 0
                optics = {"diffuse": 0.2, "transmit": 0.8, "index": 1.1} if is_glass else {"diffuse": 1}
                first = (ix + iy + iz) % 2 * pi / teeth
                groups.append((Material(color(ix, iy, iz), **optics), gear(center, first)))
    return Scene(
        View((-1.1, -2.1, 2.6), (0, 0, 0), Z, 1),
        [(2, 4, 4), (-2, 4, 3), (2, -2.5, 2.5), (-1, -4, 2), (-1.111, -2.121, 2.626)],
        groups,
    )


def gauss(seed):
    """A normally distributed number (Marsaglia's polar method on a linear congruential generator)."""
    state = seed
    while True:
        pair = []
        for _ in range(2):
            state = (28411 + state * 8121) % 134456
            pair.append(state * 2 / 134456 - 1)
        r = dot(pair, pair)
        if r < 1:
            return pair[0] * sqrt(-2 * log(r) / r)


def mount(size):
    """A fractal mountain of triangles by midpoint displacement, and four balls of glass above it."""
    roughness = sqrt((2 / 2 ** (1 / 1.2)) ** 2 - 1)
    points = 1 << size
    heights = {(x, y): 0.0 for x in (0, points) for y in (0, points)}

    def displace(x, y, corners, rise):
        hashed = ((x << (23 - size)) + (y << (15 - size)) + (x << (7 - size))) & 0xFFFF
        heights[x, y] = sum(heights[corner] for corner in corners) / len(corners) + rise * gauss(21 + hashed)

    def grow(width, x, y):
        corners = [(x, y), (x + width, y), (x + width, y + width), (x, y + width)]
        if width == 1:
            a, b, c, d = ((2 * i / points - 1, 2 * j / points - 1, heights[i, j]) for i, j in corners)
            return [Polygon([a, b, c]), Polygon([c, d, a])]
        half = width // 2
        rise = 2 * half / points * roughness
        for a, b in zip(corners, corners[1:] + corners[:1]):
            displace((a[0] + b[0]) // 2, (a[1] + b[1]) // 2, [a, b], rise)
        displace(x + half, y + half, corners, 1.4142136 * rise)
        parts = [(x, y), (x + half, y), (x + half, y + half), (x, y + half)]
        return [triangle for part in parts for triangle in grow(half, *part)]

    center, radius = (-0.8, 0.8, 1.0), 0.17
    top = (0, 0, radius * sqrt(3 / 2))
    side = rotate(top, normalize((1, 1, 0)), acos(-1 / 3))
    offsets = [top, *(rotate(side, Z, turn * 2 * pi / 3) for turn in range(3))]
    glass = Material((1, 1, 1), 0.1, 0.1, 101.148, 0.9, 1.5)
    return Scene(
        View((-1.6, 1.6, 1.7), (0, 0, 0), Z, 0.01),
        [(-100, -100, 100)],
        [
            (glass, [Sphere(add(center, offset), radius) for offset in offsets]),
            (Material((0.5, 0.45, 0.35), 1), grow(points, 0, 0)),
        ],
    )


def rings(size):
    """A pyramid of objects of six interlocking pentagons, made of cylinders and spheres."""
    radius, spread = 0.07412, 1 / sin(pi / 8)
    pentagon = [scale((cos(i * 0.4 * pi), sin(i * 0.4 * pi), 0), 1 / (1 + radius)) for i in range(5)]
    tilt = 2 * acos(cos(pi / 3) / sin(pi / 5))
    tilted = [rotate(v, X, tilt) for v in pentagon]
    pentagons = [pentagon, *([rotate(v, Z, pi * (2 * i + 1) / 5) for v in tilted] for i in range(5))]
    colors = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 1), (1, 0, 1), (1, 1, 0)]

    look_from = (-1, -spread, 0.5)
    far = spread * (size + 1)
    half = 1.01 * (far + spread) * tan(pi / 8)
    corners = [(half, half), (-half, half), (-half, -half), (half, -half)]
    wall = [add(look_from, (x, far + spread, z)) for x, z in corners]
    groups = [(Material((1, 1, 1), 1), [Polygon(wall)])]
    for depth in range(size):
        for z in range(-depth, depth + 1, 2):
            for x in range(-depth, depth + 1, 2):
                for color, ring in zip(colors, pentagons):
                    points = [add(v, (x, spread * (depth + 1), z)) for v in ring]
                    shapes = []
                    for base, apex in zip(points, points[-1:] + points[:-1]):
                        shapes += [Cone(base, radius, apex, radius), Sphere(base, radius)]
                    groups.append((Material(color, 0.5, 0.2, 3.0827), shapes))
    lights = [(3, -spread, 3), (-4, -spread, 1), (2, -spread, -4)]
    return Scene(View(look_from, add(look_from, Y), Z, 1), lights, groups)


def tetra(size):
    """A tetrahedron of tetrahedra."""
    corners = [(-1, -1, 1), (-1, 1, -1), (1, -1, -1), (1, 1, 1)]

    def grow(depth, center, half):
        if depth > 1:
            return [t for v in corners for t in grow(depth - 1, add(center, scale(v, half / 2)), half / 2)]
        a, b, c, d = (add(center, scale(v, half)) for v in corners)
        return [Polygon(face) for face in [[a, b, c], [d, c, b], [c, d, a], [b, a, d]]]

    up = (-0.816497, -0.816497, 0.816497)
    return Scene(
        View((1.022846, -3.177154, -2.174512), (-0.004103, -0.004103, 0.216539), up, 1),
        [(2, -18, -5)],
        [(Material((1, 0.2, 0.2), 1), grow(size, (0, 0, 0), 1.0))],
    )


def tree(size):
    """A binary tree of cones, with a sphere at each end (Aono and Kunii, IEEE CG&A 4(5), 1984)."""
    # Angle to the parent, angle around it, length of the child for a parent of length 1.
    branches = [(radians(40), radians(90), 0.65), (radians(25), radians(230), 0.7)]
    shapes = []

    def grow(depth, point, axes, length, radius):
        apex = add(point, scale(axes[2], length))
        shapes.extend([Cone(point, radius, apex, radius * 0.67), Sphere(apex, radius * 0.67)])
        if depth == 0:
            return
        for angle, around, shorter in branches:
            turned = [rotate(rotate(v, X, angle), Z, around) for v in (X, Y, Z)]
            world = [
                add(add(scale(axes[0], v[0]), scale(axes[1], v[1])), scale(axes[2], v[2])) for v in turned
            ]
            grow(depth - 1, apex, world, length * shorter, radius * 0.67)

    grow(size, (0.0, 0.0, 0.0), (X, Y, Z), 1.0, 0.15)
    field = Material((0.2, 0.7, 0.2), 1)
    bark = Material((0.55, 0.4, 0.2), 1)
    lights = [(-5, 5, 50), (30, -30, 30), (-40, -30, 20), (10, 30, 40), (-30, 40, 10), (50, 25, 20), (-10, -60, 30)]
    return Scene(
        View((4.5, 0.4, 2.0), (0, 0, 1.5), Z, 1),
        lights,
        [(field, [square(50, 0)]), (bark, shapes)],
    )


KINDS = {"balls": balls, "gears": gears, "mount": mount, "rings": rings, "tetra": tetra, "tree": tree}


def numbers(*values):
    return " ".join(f"{value + 0.0:.9g}" for value in values)


def nff(scene):
    """The lines of an NFF file."""
    view = scene.view
    yield "b " + numbers(*BACKGROUND)
    yield "v"
    yield "from " + numbers(*view.look_from)
    yield "at " + numbers(*view.look_at)
    yield "up " + numbers(*view.up)
    yield "angle " + numbers(view.angle)
    yield "hither " + numbers(view.hither)
    yield "resolution 512 512"
    for light in scene.lights:
        yield "l " + numbers(*light)
    for m, shapes in scene.groups:
        yield "f " + numbers(*m.color, m.diffuse, m.specular, m.shine, m.transmit, m.index)
        for shape in shapes:
            match shape:
                case Sphere(center, radius):
                    yield "s " + numbers(*center, radius)
                case Cone(base, base_radius, apex, apex_radius):
                    yield "c " + numbers(*base, base_radius, *apex, apex_radius)
                case Polygon(corners):
                    yield f"p {len(corners)}"
                    yield from (numbers(*corner) for corner in corners)


def triangles(corners):
    """A fan from the first corner, or around the middle where there are more than four corners."""
    if len(corners) <= 4:
        return [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
    middle = scale([sum(values) for values in zip(*corners)], 1 / len(corners))
    return [[middle, b, c] for b, c in zip(corners, corners[1:] + corners[:1])]


def vector(v):
    return "<" + numbers(*v).replace(" ", ", ") + ">"


def finish(m):
    """A texture that shades as the NFF material. POV-Ray multiplies diffuse light by 1 − transmit; NFF does not."""
    yield f"  texture {{ pigment {{ color rgb {vector(m.color)} transmit {numbers(m.transmit)} }}"
    diffuse = m.diffuse / (1 - m.transmit)
    shading = f"phong {numbers(m.specular)} phong_size {numbers(m.shine)} reflection {numbers(m.specular)} "
    yield f"    finish {{ ambient 0 diffuse {numbers(diffuse)} {shading if m.specular else ''}}} }}"
    if m.transmit:
        yield f"  interior {{ ior {numbers(m.index)} }}"


def pov(scene):
    """The lines of a POV-Ray file without a version, which POV-Ray 3.7 reads without gamma, as glimray reads NFF."""
    view = scene.view
    forwards = normalize(subtract(view.look_at, view.look_from))
    right = normalize(cross(forwards, view.up))
    extent = 2 * tan(radians(view.angle) / 2)
    # The throughput at which glimray ends a ray by default, and its depth of 5: POV-Ray counts the camera ray too.
    yield "global_settings { adc_bailout 1/512 max_trace_level 6 }"
    yield f"background {{ color rgb {vector(BACKGROUND)} }}"
    yield f"camera {{ location {vector(view.look_from)} direction {vector(forwards)}"
    yield f"  right {vector(scale(right, extent))} up {vector(scale(cross(right, forwards), extent))} }}"
    for light in scene.lights:
        yield f"light_source {{ {vector(light)} color rgb {numbers(1 / sqrt(len(scene.lights)))} }}"
    for number, (material, shapes) in enumerate(scene.groups):
        texture = list(finish(material))
        flat = [shape for shape in shapes if isinstance(shape, Polygon)]
        if flat:
            # POV-Ray renders many small meshes faster than loose triangles, and loose triangles than one large mesh.
            yield "mesh {" if len(scene.groups) > 2 else "union {"
            for shape in flat:
                for corners in triangles(shape.corners):
                    yield "  triangle { " + ", ".join(map(vector, corners)) + " }"
            yield from texture
            yield "}"
        curved = [shape for shape in shapes if not isinstance(shape, Polygon)]
        if curved:
            name = f"Finish{number}"
            interior = [f"#declare Inside{number} = {line.strip()}" for line in texture[2:]]
            yield from [f"#declare {name} =", *texture[:2], *interior]
            ends = f"texture {{ {name} }}" + (f" interior {{ Inside{number} }}" if interior else "")
            for shape in curved:
                match shape:
                    case Sphere(center, radius):
                        yield f"sphere {{ {vector(center)}, {numbers(radius)} {ends} }}"
                    case Cone(base, radius, apex, same) if radius == same:
                        yield f"cylinder {{ {vector(base)}, {vector(apex)}, {numbers(radius)} open {ends} }}"
                    case Cone(base, base_radius, apex, apex_radius):
                        radii = numbers(base_radius), numbers(apex_radius)
                        yield f"cone {{ {vector(base)}, {radii[0]}, {vector(apex)}, {radii[1]} open {ends} }}"


def write(folder, kind, size):
    """Writes KIND.nff and KIND.pov."""
    scene = KINDS[kind](size)
    for ending, lines in [("nff", nff(scene)), ("pov", pov(scene))]:
        (folder / f"{kind}.{ending}").write_text("\n".join(lines) + "\n")
    primitives = sum(len(shapes) for _, shapes in scene.groups)
    print(f"{kind}: {primitives:,} primitives, {len(scene.lights)} lights")


def differences(kind, size, text):
    """Places at which the generated NFF differs from SPD's by more than the six digits that SPD prints."""
    words = "\n".join(nff(KINDS[kind](size))).split(), text.split()
    if len(words[0]) != len(words[1]):
        yield f"{len(words[0])} words in place of {len(words[1])}"
    for place, (ours, theirs) in enumerate(zip(*words)):
        same = ours == theirs
        if not same and not ours.isalpha() and not theirs.isalpha():
            same = abs(float(ours) - float(theirs)) <= 2e-5 * max(1, abs(float(theirs)))
        if not same:
            yield f"word {place}: {ours} in place of {theirs}"


def check(folder):
    """Compares with SPD's files and returns whether all agree."""
    is_same = True
    files = [(path, re.fullmatch(r"(\w+)-s(\d+)\.nff", path.name)) for path in sorted(folder.iterdir())]
    known = [(path, found[1], int(found[2])) for path, found in files if found and found[1] in KINDS]
    known += [(path, path.stem, SIZES[path.stem]) for path, _ in files if path.suffix == ".nff" and path.stem in KINDS]
    if not known:
        sys.exit(f"{folder}: no files of SPD")
    for path, kind, size in known:
        found = list(differences(kind, size, path.read_text()))
        print(f"{path.name}: " + (f"{len(found)} differences, first {found[0]}" if found else "the same"))
        is_same &= not found
    return is_same


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, help="SPD's size factor")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("folder", type=Path)
    parser.add_argument("kinds", nargs="*", metavar="KIND", choices=[[], *KINDS])
    arguments = parser.parse_args()
    if arguments.check:
        sys.exit(0 if check(arguments.folder) else 1)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for kind in arguments.kinds or KINDS:
        write(arguments.folder, kind, arguments.size or SIZES[kind])


if __name__ == "__main__":
    main()
