"""Prints a scene whose light comes from many emissive triangles or shapes. KIND is

    city    streets of 8 by 8 houses at night; N windows glow, each of two triangles, seen from the ground
    string  a hall with N emissive balls on strings between its pillars
    mesh    a closed room with N glowing globes of 288 triangles each
    desk    a small room with N little emissive panels, all of them near

    python3 benches/glow.py city 2000 > city.toml
"""

import math
import random
import sys

kind, count = sys.argv[1], int(sys.argv[2])
random.seed(7)


def head(eye, target, fov=55):
    print(f"""background = [0, 0, 0]
[output]
size = [64, 48]
integrator = "path"
tone = "none"
[camera]
look_from = {list(eye)}
look_at = {list(target)}
fov_y_deg = {fov}
[materials]
wall = {{ phong = {{ diffuse = [0.6, 0.6, 0.6] }} }}""")


def glow(name, radiance, two_sided=False):
    print(f'{name} = {{ emission = [{radiance}, {0.85 * radiance}, {0.6 * radiance}], '
          f'phong = {{ diffuse = [0, 0, 0] }}, two_sided = {str(two_sided).lower()} }}')


def room(x, y, z):
    for point, normal in [
        ([0, 0, 0], [0, 1, 0]),
        ([0, y, 0], [0, -1, 0]),
        ([-x, 0, 0], [1, 0, 0]),
        ([x, 0, 0], [-1, 0, 0]),
        ([0, 0, -z], [0, 0, 1]),
        ([0, 0, z], [0, 0, -1]),
    ]:
        print(f'[[objects]]\nplane = {{ point = {point}, normal = {normal} }}\nmaterial = "wall"')


def box(low, high):
    print(f'[[objects]]\nbox = {{ min = {low}, max = {high} }}\nmaterial = "wall"')


def write(name, corners, normals, triangles):
    """An OBJ file beside the scene."""
    with open(name, "w") as out:
        for x, y, z in corners:
            out.write(f"v {x:.4f} {y:.4f} {z:.4f}\n")
        for x, y, z in normals:
            out.write(f"vn {x:.4f} {y:.4f} {z:.4f}\n")
        for own in triangles:
            out.write("f " + " ".join(f"{i + 1}//{i + 1}" for i in own) + "\n")


if kind == "city":
    head([0, 1.7, 44], [2, 3, 0])
    glow("glow", round(4000 / count, 4))
    print('[[objects]]\nplane = { point = [0, 0, 0], normal = [0, 1, 0] }\nmaterial = "wall"')
    houses = [(-42 + 12 * i, -42 + 12 * j, random.uniform(6, 20)) for i in range(8) for j in range(8)]
    for x, z, h in houses:
        box([x - 4, 0, z - 4], [x + 4, round(h, 3), z + 4])
    corners, normals, triangles = [], [], []
    for _ in range(count):
        x, z, h = random.choice(houses)
        turn = random.randrange(4) * math.pi / 2
        c, s = math.cos(turn), math.sin(turn)
        across, up = random.uniform(-3.5, 3.5), random.uniform(1, h - 0.5)
        first = len(corners)
        for du, dv in [(-0.3, -0.4), (0.3, -0.4), (0.3, 0.4), (-0.3, 0.4)]:
            u, v, w = across + du, up + dv, 4.02
            corners.append((x + c * u + s * w, v, z - s * u + c * w))
            normals.append((s, 0, c))
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    write("city.obj", corners, normals, triangles)
    print('[[objects]]\nmesh = { file = "city.obj" }\nmaterial = "glow"')
elif kind == "string":
    head([0, 1.7, 19], [0, 1.2, 0])
    glow("glow", round(60000 / count, 3))
    room(20, 6, 20)
    for k in range(12):
        x, z = (-6 if k % 2 else 6), -16 + 5 * (k // 2)
        box([x - 0.5, 0, z - 0.5], [x + 0.5, 6, z + 0.5])
    for k in range(count):
        along = 40 * (k + 0.5) / count - 20
        center = [round(6 * math.cos(3 * along), 3), round(4 + math.cos(2.1 * along), 3), round(0.95 * along, 3)]
        print(f'[[objects]]\nsphere = {{ center = {center}, radius = 0.05 }}\nmaterial = "glow"')
elif kind == "mesh":
    head([0, 1.7, 5.5], [0, 1.2, 0], 60)
    glow("glow", round(120 / count, 4))
    room(6, 3, 6)
    box([-1, 0, -1], [0.2, 2, 0.2])
    corners, normals, triangles = [], [], []
    for _ in range(count):
        center = [random.uniform(*ends) for ends in ((-5.5, 5.5), (0.3, 2.7), (-5.5, 4))]
        first = len(corners)
        for y in range(13):
            for x in range(13):
                down, around = math.pi * y / 12, 2 * math.pi * x / 12
                n = (math.sin(down) * math.cos(around), math.cos(down), math.sin(down) * math.sin(around))
                normals.append(n)
                corners.append([c + 0.15 * d for c, d in zip(center, n)])
        for y in range(12):
            for x in range(12):
                a = first + 13 * y + x
                triangles += [(a, a + 1, a + 13), (a + 1, a + 14, a + 13)]
    write("mesh.obj", corners, normals, triangles)
    print('[[objects]]\nmesh = { file = "mesh.obj" }\nmaterial = "glow"')
else:
    head([0, 1.3, 1.9], [0, 0.8, 0], 60)
    glow("glow", round(200 / count, 4))
    room(1.5, 2, 2)
    box([-0.6, 0, -0.8], [0.1, 0.8, -0.2])
    for _ in range(count):
        center = [round(random.uniform(*ends), 3) for ends in ((-1.2, 1.2), (1.0, 1.9), (-1.8, 1))]
        print(f"[[objects]]\nrectangle = {{ center = {center}, normal = [0, -1, 0], size = [0.1, 0.1] }}")
        print('material = "glow"')
