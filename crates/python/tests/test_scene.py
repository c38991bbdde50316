"""Scenes that are built and edited, and meshes of other libraries."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import glimray as gl
import pytest

np = pytest.importorskip("numpy")

ROOT = Path(__file__).parents[3]
SPHERES = ROOT / "assets/scenes/spheres_and_triangles.scene"
SHAPES = ROOT / "assets/scenes/shapes.toml"

SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
HALVES = [[0, 1, 2], [0, 2, 3]]
ALBEDO = {"size": (9, 9), "integrator": "path", "samples": 1, "layers": ["albedo", "depth", "normal"], "denoise": False}


def facing(**document):
    """A scene whose camera looks at the origin from +z, five units away."""
    scene = gl.Scene({"background": [1, 1, 1], **document})
    scene.add_camera(look_from=[0, 0, 5], look_at=[0, 0, 0], fov_y_deg=30)
    return scene


def test_a_loaded_scene_renders_to_the_same_pixels():
    direct = gl.render(SPHERES, size=(32, 24))
    loaded = gl.render(gl.Scene.load(SPHERES), size=(32, 24))
    assert (direct.numpy() == loaded.numpy()).all()


def test_values_of_native_scenes_are_set():
    darker = gl.render(SHAPES, size=(16, 12), set={"output.exposure_ev": -1, "output.transfer": "linear", "output.tone": "none"})
    usual = gl.render(SHAPES, size=(16, 12), transfer="linear", tone="none", exposure=0)
    # Levels of 255 may stand for more.
    is_exact = usual.display() < 250
    assert abs(darker.display() - usual.display() / 2)[is_exact].max() <= 1


def test_an_edit_shows():
    scene = facing(materials={"paint": {"pbr": {"base_color": [1, 0, 0], "roughness": 1}}})
    scene.add_object(sphere={"center": [0, 0, 0], "radius": 1}, material="paint")
    assert gl.render(scene, **ALBEDO).layer("albedo")[4, 4] == pytest.approx([1, 0, 0], abs=0.05)
    scene.document["materials"]["paint"]["pbr"]["base_color"] = [0, 0, 1]
    assert gl.render(scene, **ALBEDO).layer("albedo")[4, 4] == pytest.approx([0, 0, 1], abs=0.05)


def test_a_saved_scene_renders_to_the_same_pixels(tmp_path):
    scene = facing()
    scene.add_mesh(gl.Mesh(SQUARE, HALVES), name="square")
    scene.save(tmp_path / "scene.toml")
    assert (gl.render(scene, size=(9, 9)).numpy() == gl.render(tmp_path / "scene.toml", size=(9, 9)).numpy()).all()


@pytest.mark.parametrize("make", [list, np.asarray, lambda rows: np.asfortranarray(rows, ">i8"), lambda rows: np.repeat(rows, 2, axis=0)[::2]])
def test_vertices_and_faces_are_lists_or_arrays(make):
    scene = facing()
    scene.add_mesh(gl.Mesh(make(SQUARE), make(HALVES)))
    picture = gl.render(scene, **ALBEDO)
    assert picture.layer("depth")[4, 4] == pytest.approx(5, abs=1e-4)
    assert picture.layer("normal")[4, 4] == pytest.approx([0, 0, 1], abs=1e-3)


def test_colours_of_bytes_are_srgb_and_floats_are_linear():
    # Level 188 of sRGB is a linear 0.5029 (IEC 61966-2-1).
    for colors in (np.full((4, 3), 188, np.uint8), np.full((4, 3), 0.5029, np.float32)):
        scene = facing(materials={"white": {"pbr": {"base_color": [1, 1, 1], "roughness": 1}}})
        scene.add_mesh(gl.Mesh(SQUARE, HALVES, colors=colors), material="white")
        albedo = gl.render(scene, **ALBEDO).layer("albedo")[4, 4]
        # Some light is reflected by the surface without its colour.
        assert albedo == pytest.approx([0.5029] * 3, abs=0.05)


@pytest.mark.parametrize("colors, said", [([[1, 0, 0]] * 4, "floats"), ([[300, 0, 0]] * 4, "300"), ([[2.0, 0, 0]] * 4, "2.0")])
def test_colours_that_are_neither_bytes_nor_fractions_are_refused(colors, said):
    with pytest.raises(gl.SceneError, match=said):
        gl.Mesh(SQUARE, HALVES, colors=colors)


def test_without_numpy_meshes_are_the_same(tmp_path):
    code = f"""
import sys
sys.modules["numpy"] = None
import glimray as gl
mesh = gl.Mesh({SQUARE}, {HALVES}, colors={[[188, 0, 255]] * 4}, uvs={[[0, 0]] * 4})
open({str(tmp_path / "a.ply")!r}, "wb").write(mesh.ply())
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
    mesh = gl.Mesh(SQUARE, HALVES, colors=[[188, 0, 255]] * 4, uvs=[[0, 0]] * 4)
    assert (tmp_path / "a.ply").read_bytes() == mesh.ply()


def test_scenes_in_one_folder_keep_their_meshes(tmp_path):
    for name, size in (("a", 1), ("b", 9)):
        scene = facing()
        scene.add_mesh(gl.Mesh(size * np.asarray(SQUARE, float), HALVES))
        if name == "b":
            with pytest.raises(gl.OutputError, match="mesh.ply"):
                scene.save(tmp_path / "b.toml")
        else:
            scene.save(tmp_path / "a.toml")
            scene.save(tmp_path / "a.toml")
    assert gl.inspect(tmp_path / "a.toml")["bounds"]["max"][0] == 1
    with pytest.raises(gl.SceneError):
        gl.Scene({"output": {"samples": None}}).save(tmp_path / "c" / "c.toml")
    assert not (tmp_path / "c").exists()


def test_the_origin_of_texture_coordinates_is_the_lower_left():
    picture = np.zeros((2, 2, 3), np.uint8)
    picture[1, 0] = [255, 0, 0]
    scene = facing()
    scene.add_texture("corner", np.kron(picture, np.ones((16, 16, 1), np.uint8)))
    scene.add_material("shown", pbr={"base_color": {"texture": "corner"}, "roughness": 1})
    uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]
    scene.add_mesh(gl.Mesh(SQUARE, HALVES, uvs=uvs), material="shown")
    albedo = gl.render(scene, **ALBEDO).layer("albedo")
    red = albedo[..., 0] > 0.5
    assert red[5:7, 2:4].all() and not red[2:4, 2:7].any() and not red[5:7, 5:7].any()


@pytest.mark.parametrize(
    "mesh, said",
    [
        (([[0, 0]], [[0, 0, 0]]), "vertices"),
        ((SQUARE, [[0, 1, 4]]), "no vertex 4"),
        ((SQUARE, [[0, 1]]), "three indices"),
        ((SQUARE, None), "4 vertices"),
    ],
)
def test_bad_meshes_are_refused(mesh, said):
    with pytest.raises(gl.SceneError, match=said):
        gl.Mesh(*map(lambda rows: rows if rows is None else np.asarray(rows), mesh))


def test_rows_of_normals_must_be_as_many_as_vertices():
    with pytest.raises(gl.SceneError, match="normals"):
        gl.Mesh(SQUARE, HALVES, normals=[[0, 0, 1]])


def test_an_object_with_vertices_and_faces_is_a_mesh():
    thing = SimpleNamespace(vertices=np.asarray(SQUARE, float), faces=np.asarray(HALVES))
    picture = gl.render(thing, size=(16, 16), samples=1)
    assert picture.report["scene"]["triangles"] >= 2
    with pytest.raises(gl.SceneError, match="no vertices and faces"):
        gl.render(object())


def test_trimesh_meshes_keep_their_colours():
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box()
    box.visual.face_colors = np.tile([255, 0, 0, 255], (12, 1)).astype(np.uint8)
    picture = gl.render(box, size=(32, 32), samples=4, integrator="path", layers=["albedo"], denoise=False)
    albedo = picture.layer("albedo")[16, 16]
    assert albedo[0] > 5 * max(albedo[1], albedo[2], 0.01)
    assert gl.render(trimesh.Scene(box), size=(16, 16), samples=1).report["scene"]["triangles"] >= 12


def test_open3d_and_pyvista_objects_are_known_by_their_attributes():
    vertices, faces = np.asarray(SQUARE, float), np.asarray(HALVES)
    open3d = SimpleNamespace(
        vertices=vertices, triangles=faces, vertex_normals=np.empty((0, 3)), vertex_colors=np.full((4, 3), 0.5),
        triangle_uvs=np.empty((0, 2)),
    )
    data = SimpleNamespace(active_normals=None, active_texture_coordinates=None, active_scalars=None)

    class Mixed:
        """A mesh of PyVista with triangles and quads."""

        points, is_all_triangles, point_data = vertices, False, data

        @property
        def regular_faces(self):
            raise ValueError("faces of several sizes")

        def triangulate(self):
            return pyvista

    class Surface:
        """The class of PyVista's objects has the property."""

        points, regular_faces, is_all_triangles, point_data = vertices, faces, True, data

    pyvista = Surface()
    for thing in (open3d, pyvista, Mixed()):
        assert gl.render(thing, size=(16, 16), samples=1).report["scene"]["triangles"] >= 2


def test_bytes_are_known_by_their_beginning(tmp_path):
    ply = gl.Mesh(SQUARE, HALVES).ply()
    obj = b"v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n"
    for data, count in ((ply, 2), (obj, 1), (SHAPES.read_bytes(), 5), ((ROOT / "assets/scenes/neutral.nff").read_bytes(), None)):
        assert gl.inspect(data)["triangles"] == count or count is None


def test_an_environment_of_an_array_lights_the_scene():
    sky = np.full((8, 16, 3), 2.0, np.float32)
    scene = gl.Scene()
    scene.add_camera(look_from=[0, 0, 5], look_at=[0, 0, 0])
    scene.set_background(sky)
    assert gl.render(scene, size=(4, 4)).numpy()[0, 0, :3] == pytest.approx([2, 2, 2], rel=1e-3)
    # Level 188 of sRGB is a linear 0.5029 (IEC 61966-2-1).
    grey = np.full((8, 16, 3), 188, np.uint8)
    assert gl.render(scene, size=(4, 4), environment=grey).numpy()[0, 0, :3] == pytest.approx([0.5029] * 3, rel=0.01)
    scene.set_background(grey, strength=2)
    assert gl.render(scene, size=(4, 4)).numpy()[0, 0, :3] == pytest.approx([1.0058] * 3, rel=0.01)
    scene.set_background("furnace", strength=3)
    assert gl.render(scene, size=(4, 4)).numpy()[0, 0, :3] == pytest.approx([3] * 3, rel=0.01)
    with pytest.raises(gl.UsageError, match="strength"):
        scene.set_background([1, 1, 1], strength=2)
    with pytest.raises(gl.SceneError, match="environment"):
        gl.render(scene, size=(4, 4), environment=np.ones((3, 4, 3)))
    red = np.zeros((8, 16, 3), np.float32)
    red[..., 0] = 1
    explained = gl.render(scene, size=(4, 4), environment=red).explain(1, 1)
    assert explained["pixel"] == [1, 1]
    assert gl.render(scene, size=(4, 4), environment=red).numpy()[0, 0, :3] == pytest.approx([1, 0, 0], abs=1e-3)


def test_a_scene_tells_its_contents():
    scene = facing()
    scene.add_object(sphere={"center": [0, 0, 0], "radius": 1})
    assert scene.inspect()["spheres"] == 1


def test_toml_and_document_are_the_same_scene():
    text = SHAPES.read_text()
    scene = gl.Scene.from_toml(text)
    assert gl.Scene.from_toml(scene.to_toml()).document == scene.document
    with pytest.raises(gl.SceneError):
        gl.Scene({"output": {"samples": None}}).to_toml()
