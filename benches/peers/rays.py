#!/usr/bin/env python3
"""Writes ray sets of the height field of `glimray bench`: 180,000 triangles, seen from a corner.

    rays.py OUT_FOLDER [--side 1024]

Hit points come from Embree. Random numbers are the same in every run.
"""

import argparse
from pathlib import Path

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

import raysets

QUADS = 300
LOOK_FROM, LOOK_AT, UP = np.array([0.55, 0.45, 0.75]), np.array([0.0, -0.05, 0.0]), np.array([0.0, 1.0, 0.0])
FIELD_OF_VIEW = np.radians(60)
TO_SUN = np.array([2.0, 1.0, 1.0]) / np.sqrt(6)


def hills():
    """As in src/cli/bench: the same vertices and triangles."""
    steps = np.arange(QUADS + 1) / QUADS - 0.5
    x, z = (grid.ravel() for grid in np.meshgrid(steps, steps))
    turn = 2 * np.pi
    y = 0.06 * np.sin(turn * 2 * x) * np.cos(turn * 3 * z) + 0.01 * np.sin(turn * 17 * (x + z))
    first = (np.arange(QUADS)[:, None] * (QUADS + 1) + np.arange(QUADS)).ravel()
    below = first + QUADS + 1
    corners = np.stack([first, below, first + 1, first + 1, below, below + 1], axis=-1).reshape(-1, 3)
    return np.stack([x, y, z], axis=-1)[corners].astype(np.float32)


def camera_rays(side):
    """A ray through the centre of each pixel, by tiles of 8×8 pixels, in Morton order within a tile."""
    lanes = np.arange(64)
    inside = [sum((lanes >> (2 * bit + axis) & 1) << bit for bit in range(3)) for axis in (0, 1)]
    tiles = np.arange(0, side, 8)
    columns = np.add.outer(np.tile(tiles, len(tiles)), inside[0])
    lines = np.add.outer(np.repeat(tiles, len(tiles)), inside[1])
    half = np.tan(FIELD_OF_VIEW / 2)
    x, y = ((2 * (v.reshape(-1, 1) + 0.5) / side - 1) * half for v in (columns, lines))
    forwards = unit(LOOK_AT - LOOK_FROM)
    right = unit(np.cross(forwards, UP))
    return unit(forwards + x * right - y * np.cross(right, forwards))


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def around(normals, random):
    """Directions with a density in proportion to the cosine of the angle to the normal."""
    return unit(normals + unit(random.normal(size=normals.shape)) * 0.9999)


def rows(origins, directions, t_max):
    shape = (len(directions), 1)
    return np.hstack([np.broadcast_to(origins, directions.shape), directions, np.broadcast_to(t_max, shape)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--side", type=int, default=1024, help="pixels, a multiple of 8 [default: 1024]")
    parsed = parser.parse_args()
    random = np.random.default_rng(1)
    triangles = hills()
    scene = EmbreeScene()
    TriangleMesh(scene, triangles)

    directions = camera_rays(parsed.side)
    origins = np.broadcast_to(LOOK_FROM, directions.shape)
    found = scene.run(origins.astype(np.float32), directions.astype(np.float32), output=1)
    is_hit = found["primID"] >= 0
    hits = triangles[found["primID"][is_hit]].astype(float)
    towards = directions[is_hit]
    normals = unit(np.cross(hits[:, 1] - hits[:, 0], hits[:, 2] - hits[:, 0]))
    normals *= -np.sign(np.sum(normals * towards, axis=-1, keepdims=True))
    points = origins[is_hit] + towards * found["tfar"][is_hit, None] + 1e-5 * normals
    mirrored = towards - 2 * np.sum(towards * normals, axis=-1, keepdims=True) * normals
    low, high = triangles.reshape(-1, 3).min(axis=0), triangles.reshape(-1, 3).max(axis=0)
    count = len(directions)

    folder = parsed.folder / "heightfield"
    raysets.write_scene(folder, triangles)
    for name, any_hit, rays in [
        ("primary", False, rows(origins, directions, np.inf)),
        ("shadow", True, rows(points, np.broadcast_to(TO_SUN, points.shape), np.inf)),
        ("ambient-occlusion", True, rows(points, around(normals, random), 0.07)),
        ("diffuse", False, rows(points, around(normals, random), np.inf)),
        ("mirror", False, rows(points, mirrored, np.inf)),
        ("random", False, rows(random.uniform(low, high, (count, 3)), unit(random.normal(size=(count, 3))), np.inf)),
    ]:
        raysets.write_rays(folder, name, any_hit, rays)
        print(f"heightfield {name}: {len(rays):,} rays")


if __name__ == "__main__":
    main()
