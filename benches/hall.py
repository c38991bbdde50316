"""Prints a scene: a hall of 40 by 6 by 40 m with twelve pillars, lit by N small hidden lamps that together always have the
same power.

    python3 benches/hall.py 2000 > hall.toml
"""

import random
import sys

count = int(sys.argv[1])
random.seed(7)
print("""background = [0, 0, 0]
[output]
size = [64, 48]
integrator = "path"
tone = "none"
[camera]
look_from = [0, 1.7, 19]
look_at = [0, 1.2, 0]
fov_y_deg = 55
[materials]
wall = { phong = { diffuse = [0.6, 0.6, 0.6] } }""")
for point, normal in [
    ([0, 0, 0], [0, 1, 0]),
    ([0, 6, 0], [0, -1, 0]),
    ([-20, 0, 0], [1, 0, 0]),
    ([20, 0, 0], [-1, 0, 0]),
    ([0, 0, -20], [0, 0, 1]),
    ([0, 0, 20], [0, 0, -1]),
]:
    print(f'[[objects]]\nplane = {{ point = {point}, normal = {normal} }}\nmaterial = "wall"')
for k in range(12):
    x = -6 if k % 2 else 6
    z = -16 + 5 * (k // 2)
    print(f"[[objects]]\nbox = {{ min = [{x - 0.5}, 0, {z - 0.5}], max = [{x + 0.5}, 6, {z + 0.5}] }}")
    print('material = "wall"')
for _ in range(count):
    center = [round(random.uniform(*ends), 3) for ends in ((-19, 19), (0.5, 5.5), (-19, 19))]
    intensity = round(400 / count * random.uniform(0.3, 1.7), 4)
    print(f"[[lights]]\nsphere = {{ center = {center}, radius = 0.03,", end=" ")
    print(f'color = "#ffd9a0", intensity = {intensity}, visible = false }}')
