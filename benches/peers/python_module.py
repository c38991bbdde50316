"""The Python module beside trimesh with Embree (rays) and pyrender (a picture), for the same mesh of 102,400 triangles.

Needs ``pip install glimray trimesh embreex pyrender`` with the wheel of ``make wheel``. Run it as ``python
benches/peers/python_module.py rays`` and ``… picture``. Each figure is the median of five runs after a first one, from arrays of NumPy
to arrays of NumPy.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import glimray as gl
import numpy as np

RUNS = 5
RAYS = 1_000_000
SIZE = (640, 480)
EYE = np.array([0.0, 2.5, 7.0])
FOV_Y = 40.0


def knot() -> tuple[np.ndarray, np.ndarray]:
    """A tube along a trefoil knot: vertices and triangles."""
    rows, columns = 640, 80
    t = np.linspace(0, 2 * np.pi, rows, endpoint=False)[:, None]
    angle = np.linspace(0, 2 * np.pi, columns, endpoint=False)[None, :, None]

    def curve(t: np.ndarray) -> np.ndarray:
        return np.concatenate([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)

    tangent = curve(t + 1e-4) - curve(t - 1e-4)
    side = np.cross(tangent, curve(t))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, tangent)
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    tube = 0.4 * (1 + 0.1 * np.sin(8 * angle + 20 * t[:, None]))
    vertices = curve(t)[:, None] + tube * (np.cos(angle) * side[:, None] + np.sin(angle) * up[:, None])
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    next_row, next_column = (row + 1) % rows, (column + 1) % columns
    a, b = row * columns + column, next_row * columns + column
    c, d = next_row * columns + next_column, row * columns + next_column
    faces = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
    return vertices.reshape(-1, 3), faces


def camera_rays() -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(np.linspace(-1, 1, 1000), np.linspace(1, -1, 1000))
    forward = -EYE / np.linalg.norm(EYE)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    reach = np.tan(np.radians(FOV_Y / 2))
    directions = forward + reach * (x[..., None] * right + y[..., None] * np.cross(right, forward))
    directions = directions.reshape(-1, 3)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return np.tile(EYE, (RAYS, 1)), directions


def random_rays() -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(1)
    origins = random.normal(size=(RAYS, 3))
    origins *= 6 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = random.uniform(-2.5, 2.5, size=(RAYS, 3)) - origins
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


def median(work: Callable[[], Any]) -> tuple[float, float, float]:
    """The first run, the median of the others, and their spread, in seconds."""
    seconds = []
    for _ in range(1 + RUNS):
        started = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - started)
    first, *others = seconds
    return first, statistics.median(others), max(others) - min(others)


def tell(name: str, work: Callable[[], Any]) -> None:
    first, middle, spread = median(work)
    print(f"{name:48} {RAYS / middle / 1e6:7.2f} Mrays/s  median {middle:.3f} s, spread {spread:.3f} s, first {first:.3f} s")


def rays() -> None:
    import trimesh
    from trimesh.ray.ray_pyembree import RayMeshIntersector

    vertices, faces = knot()
    print(len(faces), "triangles,", RAYS, "rays, load", os.getloadavg()[0])
    started = time.perf_counter()
    query = gl.RayQuery(gl.Mesh(vertices, faces))
    print(f"RayQuery is made in {time.perf_counter() - started:.2f} s", end=", ")
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    started = time.perf_counter()
    embree = RayMeshIntersector(mesh)
    embree.intersects_first([[0, 0, 9]], [[0, 0, -1]])
    print(f"RayMeshIntersector in {time.perf_counter() - started:.2f} s")

    def located(origins: np.ndarray, directions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """What ``closest`` returns: distances, triangles and normals."""
        points, ray, triangle = embree.intersects_location(origins, directions, multiple_hits=False)
        distances = np.full(len(origins), np.inf)
        distances[ray] = np.linalg.norm(points - origins[ray], axis=1)
        triangles = np.full(len(origins), -1)
        triangles[ray] = triangle
        normals = np.zeros((len(origins), 3))
        normals[ray] = mesh.face_normals[triangle]
        return distances, triangles, normals

    for kind, (origins, directions), coherent in (("camera", camera_rays(), True), ("random", random_rays(), False)):
        hits = query.closest(origins, directions, coherent=coherent)
        distances, *_ = located(origins, directions)
        both = hits.hit & np.isfinite(distances)
        apart = np.abs(hits.distances[both] - distances[both])
        print(
            f"{kind} rays: {100 * hits.hit.mean():.1f} % hit; {(hits.hit != np.isfinite(distances)).sum()} hit in one only; "
            f"distances of {(apart > 1e-3).sum()} differ by more than 0.001"
        )
        tell("  glimray closest", lambda: query.closest(origins, directions, coherent=coherent))
        tell("  trimesh intersects_location, distances, normals", lambda: located(origins, directions))
        tell("  trimesh intersects_first (triangles only)", lambda: embree.intersects_first(origins, directions))
        tell("  glimray occluded", lambda: query.occluded(origins, directions, coherent=coherent))
        tell("  trimesh intersects_any", lambda: embree.intersects_any(origins, directions))


def picture() -> None:
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    vertices, faces = knot()
    mesh = gl.Mesh(vertices, faces)
    scene = gl.Scene()
    scene.add_mesh(mesh)
    scene.add_light(directional={"direction": [-1, -2, -2]})
    scene.add_camera(look_from=EYE.tolist(), look_at=[0, 0, 0], fov_y_deg=FOV_Y)
    print(len(faces), "triangles, 640x480 pixels, load", os.getloadavg()[0])

    def show(name: str, work: Callable[[], Any]) -> None:
        first, middle, spread = median(work)
        print(f"{name:48} median {middle:.3f} s, spread {spread:.3f} s, first {first:.3f} s")

    kept = {}

    def glimray() -> None:
        kept["glimray"] = gl.render(scene, size=SIZE, integrator="whitted", samples=1)
        kept["glimray"].display()

    show("glimray render, with a shadow ray per pixel", glimray)
    kept["glimray"].save("glimray.png")
    print({name: value for name, value in kept["glimray"].report["seconds"].items() if value and value > 0.001})

    # pyrender 0.1.45 wants a name that NumPy 2 has no more.
    np.infty = np.inf
    import pyrender
    import trimesh

    room = pyrender.Scene(bg_color=[0, 0, 0], ambient_light=[0.1, 0.1, 0.1])
    room.add(pyrender.Mesh.from_trimesh(trimesh.Trimesh(vertices, faces, process=False)))

    def looking(eye: np.ndarray, target: np.ndarray) -> np.ndarray:
        back = (eye - target) / np.linalg.norm(eye - target)
        right = np.cross([0, 1, 0], back)
        right /= np.linalg.norm(right)
        pose = np.eye(4)
        pose[:3] = np.stack([right, np.cross(back, right), back, eye], axis=1)
        return pose

    room.add(pyrender.PerspectiveCamera(yfov=np.radians(FOV_Y)), pose=looking(EYE, np.zeros(3)))
    room.add(pyrender.DirectionalLight(intensity=3), pose=looking(np.array([1.0, 2, 2]), np.zeros(3)))
    renderer = pyrender.OffscreenRenderer(*SIZE)
    from OpenGL.GL import GL_RENDERER, glGetString

    show("pyrender, without shadows", lambda: kept.update(pyrender=renderer.render(room)[0]))
    print("  on", glGetString(GL_RENDERER))
    shadows = pyrender.RenderFlags.SHADOWS_DIRECTIONAL
    show("pyrender, with a shadow map", lambda: kept.update(pyrender=renderer.render(room, flags=shadows)[0]))
    from PIL import Image

    Image.fromarray(kept["pyrender"]).save("pyrender.png")


if __name__ == "__main__":
    {"rays": rays, "picture": picture}[sys.argv[1]]()
