#!/usr/bin/env python3
"""Writes the height field of `glimray bench` and its ray sets, for the other peers.

    rays.py OUT_FOLDER [--side 1024]

Everything is defined as in src/cli/bench, so that the rays are the same but for rounding: the numbers of hits of all
peers and of glimray's bench agree.
"""

import argparse
from pathlib import Path

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

import raysets

QUADS = 300
LOOK_FROM, LOOK_AT, UP = np.array([0.55, 0.45, 0.75]), np.array([0.0, -0.05, 0.0]), np.array([0.0, 1.0, 0.0])
LIGHT = np.array([1.0, 0.9, -0.6])
# tan 30°, for a field of view of 60°.
HALF_HEIGHT = np.sqrt(1 / 3)
# Fractions of the radius of the scene: the start of secondary rays off the surface, the length of occlusion rays.
OFFSET, OCCLUSION_LENGTH = 1e-5, 0.1
FAR = 3e38


class Random:
    """SplitMix64, a sequence for each index of a series."""

    GAMMA = np.uint64(0x9E3779B97F4A7C15)

    def __init__(self, series, indices):
        start = self.mixed(np.array([series], np.uint64) + self.GAMMA)
        self.state = self.mixed(start + indices.astype(np.uint64))

    @staticmethod
    def mixed(bits):
        bits = (bits ^ (bits >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        bits = (bits ^ (bits >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        return bits ^ (bits >> np.uint64(31))

    def point(self, low, high, where=slice(None)):
        """A point in the box from `low` to `high` for each of the chosen sequences."""
        units = []
        for _ in range(3):
            self.state[where] += self.GAMMA
            units.append((self.mixed(self.state[where]) >> np.uint64(11)) / 2**53)
        return low + (high - low) * np.stack(units, axis=-1)

    def direction(self):
        """A unit vector for each sequence, uniform over all directions."""
        found = np.empty((len(self.state), 3))
        missing = np.arange(len(self.state))
        while len(missing):
            points = self.point(-np.ones(3), np.ones(3), missing)
            square = np.sum(points**2, axis=-1)
            is_inside = (square <= 1) & (square > 1e-6)
            found[missing[is_inside]] = points[is_inside] / np.sqrt(square[is_inside, None])
            missing = missing[~is_inside]
        return found

    def cosine(self, normals):
        """Unit vectors around unit normals, distributed by the cosine of the angle between them."""
        return unit(normals + self.direction())


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def sine(turns):
    """About sin(2π `turns`): a parabola with a correction."""
    within = turns - np.floor(turns)
    x = 2 * np.where(within < 0.5, within, within - 1)
    parabola = 4 * x * (1 - np.abs(x))
    return 0.225 * (parabola * np.abs(parabola) - parabola) + parabola


def hills():
    """The triangles of the height field, of the shape (n, 3, 3)."""
    steps = np.arange(QUADS + 1) / QUADS - 0.5
    x, z = (grid.ravel() for grid in np.meshgrid(steps, steps))
    y = 0.06 * sine(2 * x) * sine(3 * z + 0.25) + 0.01 * sine(17 * (x + z))
    first = (np.arange(QUADS)[:, None] * (QUADS + 1) + np.arange(QUADS)).ravel()
    below = first + QUADS + 1
    corners = np.stack([first, below, first + 1, first + 1, below, below + 1], axis=-1).reshape(-1, 3)
    return np.stack([x, y, z], axis=-1)[corners].astype(np.float32)


def camera_directions(side):
    """Towards the centre of each pixel, by tiles of 8×8 pixels, in Morton order within a tile."""
    lanes = np.arange(64)
    inside = [sum((lanes >> (2 * bit + axis) & 1) << bit for bit in range(3)) for axis in (0, 1)]
    tiles = np.arange(0, side, 8)
    columns = np.add.outer(np.tile(tiles, len(tiles)), inside[0])
    lines = np.add.outer(np.repeat(tiles, len(tiles)), inside[1])
    x, y = (HALF_HEIGHT * (2 * (v.reshape(-1, 1) + 0.5) / side - 1) for v in (columns, lines))
    forwards = unit(LOOK_AT - LOOK_FROM)
    right = unit(np.cross(forwards, UP))
    return unit(x * right - y * np.cross(right, forwards) + forwards)


def dot(a, b):
    return np.sum(a * b, axis=-1, keepdims=True)


def hit_points(triangles, directions):
    """Points in front of the triangles that camera rays hit, their normals towards the camera, and the rays' indices."""
    scene = EmbreeScene()
    TriangleMesh(scene, triangles)
    origins = np.broadcast_to(LOOK_FROM, directions.shape).astype(np.float32)
    found = scene.run(origins, directions.astype(np.float32))
    indices = np.flatnonzero(found >= 0)
    # The distance again, in f64.
    a, b, c = np.moveaxis(triangles[found[indices]].astype(float), 1, 0)
    towards = directions[indices]
    normals = unit(np.cross(b - a, c - a))
    t = dot(a - LOOK_FROM, normals) / dot(towards, normals)
    normals *= -np.sign(dot(normals, towards))
    return LOOK_FROM + t * towards, normals, indices


def rows(origins, directions, t_max=FAR):
    shape = (len(directions), 1)
    return np.hstack([np.broadcast_to(origins, directions.shape), directions, np.broadcast_to(t_max, shape)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--side", type=int, default=1024, help="pixels, a multiple of 8 [default: 1024]")
    parsed = parser.parse_args()
    triangles = hills()
    low, high = (bound(triangles.reshape(-1, 3).astype(float), axis=0) for bound in (np.min, np.max))
    radius = np.linalg.norm(high - low) / 2

    directions = camera_directions(parsed.side)
    points, normals, indices = hit_points(triangles, directions.astype(np.float32).astype(float))
    points += OFFSET * radius * normals
    towards = directions[indices]
    to_light = LIGHT - points
    distances = np.linalg.norm(to_light, axis=-1, keepdims=True)
    anywhere = Random(3, np.arange(len(directions)))

    folder = parsed.folder / "heightfield"
    raysets.write_scene(folder, triangles)
    for name, any_hit, rays in [
        ("primary", False, rows(LOOK_FROM, directions)),
        ("shadow", True, rows(points, to_light / distances, distances)),
        ("ambient-occlusion", True, rows(points, Random(1, indices).cosine(normals), OCCLUSION_LENGTH * radius)),
        ("diffuse", False, rows(points, Random(2, indices).cosine(normals))),
        ("mirror", False, rows(points, towards - 2 * dot(towards, normals) * normals)),
        ("random", False, rows(anywhere.point(low, high), anywhere.direction())),
    ]:
        raysets.write_rays(folder, name, any_hit, rays)
        print(f"heightfield {name}: {len(rays):,} rays")


if __name__ == "__main__":
    main()
