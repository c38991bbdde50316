"""Rays: distances, triangles and normals against closed forms."""

from __future__ import annotations

import os
import subprocess
import sys

import glimray as gl
import pytest

np = pytest.importorskip("numpy")

SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
HALVES = [[0, 1, 2], [0, 2, 3]]


def sphere_rays(count, seed=0):
    """Rays from a sphere of radius 3 towards points near the origin."""
    random = np.random.default_rng(seed)
    origins = random.normal(size=(count, 3))
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
    targets = random.uniform(-1.2, 1.2, size=(count, 3))
    return origins, targets - origins


def test_rays_hit_a_sphere_where_the_quadratic_says():
    scene = gl.Scene({"objects": [{"name": "ball", "sphere": {"center": [0.1, 0.2, -0.3], "radius": 0.9}}]})
    query = gl.RayQuery(scene)
    origins, directions = sphere_rays(4096)
    hits = query.closest(origins, directions)
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    away = origins - [0.1, 0.2, -0.3]
    half = (away * unit).sum(axis=1)
    root = half**2 - (away**2).sum(axis=1) + 0.9**2
    is_clear = np.abs(root) > 1e-3
    assert (hits.hit == (root > 0))[is_clear].all()
    sure = hits.hit & is_clear
    distances = -half[sure] - np.sqrt(root[sure])
    assert hits.distances[sure] == pytest.approx(distances, abs=1e-4)
    points = origins[sure] + distances[:, None] * unit[sure]
    assert np.abs(hits.normals[sure] - (points - [0.1, 0.2, -0.3]) / 0.9).max() < 1e-3
    assert (hits.triangles == -1).all() and (hits.objects[sure] == 0).all()
    assert np.isinf(hits.distances[~hits.hit]).all()
    assert query.names == ["ball"]
    assert (query.occluded(origins, directions) == hits.hit).all()


def test_triangles_are_numbered_as_in_the_mesh():
    random = np.random.default_rng(1)
    count = 500
    centers = random.uniform(-5, 5, size=(count, 1, 3))
    corners = centers + random.uniform(-0.3, 0.3, size=(count, 3, 3))
    mesh = gl.Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    origins = corners.mean(axis=1) + 1e-3 * normals
    hits = gl.RayQuery(mesh).closest(origins, -normals)
    assert (hits.triangles == np.arange(count)).mean() > 0.99
    own = hits.triangles == np.arange(count)
    assert hits.distances[own] == pytest.approx(1e-3, rel=0.01)
    assert np.abs(hits.normals[own] - normals[own]).max() < 1e-3


def test_faces_without_area_keep_the_numbers_of_the_others():
    faces = [[0, 0, 1], [0, 1, 2], [1, 1, 1], [0, 2, 3]]
    with pytest.warns(gl.GlimrayWarning, match="without area"):
        query = gl.RayQuery(gl.Mesh(SQUARE, faces))
    hits = query.closest([[0.5, -0.5, 2], [-0.5, 0.5, 2], [5, 5, 2]], [[0, 0, -1]] * 3)
    assert hits.triangles.tolist() == [1, 3, -1]


def test_both_sides_of_a_doubled_triangle_are_told_apart():
    query = gl.RayQuery(gl.Mesh(SQUARE[:3], [[0, 1, 2], [0, 2, 1]], normals=[[0, 0, 1]] * 3))
    hits = query.closest([[0.5, -0.5, 2]], [[0, 0, -1]])
    assert hits.triangles[0] in (0, 1)
    # The normal is that of the face that is told.
    assert hits.normals[0] == pytest.approx([0, 0, 1 if hits.triangles[0] == 0 else -1])


def test_visible_lamps_are_no_surfaces():
    scene = gl.Scene()
    scene.add_mesh(gl.Mesh(SQUARE, HALVES), name="wall")
    scene.add_light(sphere={"center": [0, 0, 2], "radius": 0.5})
    query = gl.RayQuery(scene)
    hits = query.closest([[0.1, 0.2, 5]], [[0, 0, -1]])
    assert hits.distances[0] == pytest.approx(5)
    assert query.occluded([[0.1, 0.2, 5]], [[0, 0, -1]], t_max=4).tolist() == [False]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_query_after_fork_is_an_error():
    code = f"""
import os, glimray as gl
query = gl.RayQuery(gl.Mesh({SQUARE}, {HALVES}))
child = os.fork()
if child == 0:
    for call in (query.closest, query.occluded):
        try:
            call([[0, 0, 1]], [[0, 0, -1]])
        except gl.DeviceError:
            print("refused", flush=True)
    os._exit(0)
os.waitpid(child, 0)
"""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert ran.stdout.split() == ["refused", "refused"], ran.stderr


def test_a_number_names_an_adapter():
    with pytest.raises(gl.NoAdapter, match="99"):
        gl.RayQuery(gl.Mesh(SQUARE, HALVES), adapter=99)


def test_hits_at_the_limit_or_beyond_do_not_count():
    query = gl.RayQuery(gl.Mesh(SQUARE, HALVES))
    origin, direction = [[0.1, 0.2, 2]], [[0, 0, -4]]
    assert query.closest(origin, direction).distances[0] == pytest.approx(2)
    assert not query.closest(origin, direction, t_max=1.9).hit[0]
    assert not query.occluded(origin, direction, t_max=[1.9])[0]
    assert query.occluded(origin, direction, t_max=2.1)[0]


def test_moved_and_copied_meshes_have_their_own_places():
    scene = gl.Scene()
    square = scene.add_mesh(gl.Mesh(SQUARE, HALVES), name="a", transform={"translate": [0, 0, -3]})
    scene.add_object(mesh=square["mesh"], name="b", transform={"translate": [10, 0, 0], "rotate_deg": [0, 90, 0]})
    query = gl.RayQuery(scene)
    hits = query.closest([[0.5, -0.5, 0], [20, 0.5, 0.5]], [[0, 0, -1], [-1, 0, 0]])
    assert hits.distances.tolist() == pytest.approx([3, 10])
    assert [query.names[number] for number in hits.objects] == ["a", "b"]
    assert hits.normals.tolist() == [pytest.approx([0, 0, 1], abs=1e-6), pytest.approx([1, 0, 0], abs=1e-6)]


def test_a_time_moves_what_is_animated():
    scene = gl.Scene({"animation": [{"object": "ball", "property": "translate", "keys": [[0, [0, 0, 0]], [1, [0, 0, -4]]]}]})
    scene.add_object(name="ball", sphere={"center": [0, 0, 0], "radius": 1}, transform={"translate": [0, 0, 0]})
    for time, distance in ((0, 4), (0.5, 6), (1, 8)):
        hits = gl.RayQuery(scene, time=time).closest([[0, 0, 5]], [[0, 0, -1]])
        assert hits.distances[0] == pytest.approx(distance, abs=1e-4)
        assert hits.normals[0] == pytest.approx([0, 0, 1], abs=1e-4)


@pytest.mark.parametrize(
    "shape, origin, normal",
    [
        ({"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}, [5, 0.3, 0.2], [1, 0, 0]),
        ({"cylinder": {"from": [0, -1, 0], "to": [0, 1, 0], "radius": 1}}, [0, 0.3, 5], [0, 0, 1]),
        ({"cylinder": {"from": [0, -1, 0], "to": [0, 1, 0], "radius": 1}}, [0.1, 5, 0.1], [0, 1, 0]),
        ({"cone": {"from": [0, 0, 0], "to": [0, 1, 0], "from_radius": 1, "to_radius": 0}}, [5, 0.5, 0], [0.5**0.5, 0.5**0.5, 0]),
        ({"torus": {"center": [0, 0, 0], "axis": [0, 1, 0], "major_radius": 1, "minor_radius": 0.25}}, [5, 0, 0], [1, 0, 0]),
        ({"disc": {"center": [0, 0, 0], "normal": [0, 1, 0], "radius": 1}}, [0.1, 5, 0.2], [0, 1, 0]),
        ({"ellipsoid": {"center": [0, 0, 0], "radii": [2, 1, 1]}}, [0, 5, 0], [0, 1, 0]),
        ({"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}, [3, 2, 1], [0, 1, 0]),
    ],
)
def test_normals_of_shapes_point_outwards(shape, origin, normal):
    query = gl.RayQuery(gl.Scene({"objects": [shape]}))
    direction = -np.asarray(normal) if "cone" not in shape else np.asarray([-1.0, 0, 0])
    hits = query.closest([origin], [direction])
    assert hits.hit[0]
    assert hits.normals[0] == pytest.approx(normal, abs=1e-3)


def test_coherence_changes_no_hit():
    origins, directions = sphere_rays(2048, 3)
    query = gl.RayQuery(gl.Mesh(SQUARE, HALVES))
    alone, packed = (query.closest(origins, directions, coherent=is_coherent) for is_coherent in (False, True))
    assert (alone.triangles == packed.triangles).all()
    assert (alone.distances == packed.distances).all()


@pytest.mark.parametrize(
    "rays, said",
    [
        (([[0, 0]], [[0, 0, 1]]), "origins"),
        (([[0, 0, 0]], [[0, 0, 1], [0, 0, 1]]), "1 origins for 2"),
        (([[0, 0, 0]], [[0, 0, 0]]), "row 0"),
        (([[0, float("nan"), 0]], [[0, 0, 1]]), "row 0"),
        (([[0, 0, 0]], [[0, 0, 1]], [1, 2, 3]), "t_max"),
        (([[0, 0, 0], [0]], [[0, 0, 1]]), "bad rays"),
    ],
)
def test_bad_rays_are_refused(rays, said):
    with pytest.raises(gl.SceneError, match=said):
        gl.RayQuery(gl.Mesh(SQUARE, HALVES)).closest(*rays)


def test_no_rays_hit_nothing():
    hits = gl.RayQuery(gl.Mesh(SQUARE, HALVES)).closest(np.empty((0, 3)), np.empty((0, 3)))
    assert hits.distances.shape == (0,) and hits.normals.shape == (0, 3)
