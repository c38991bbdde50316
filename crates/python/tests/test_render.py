"""Pictures: the same bytes as the program, keywords of its flags, and errors."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import glimray as gl
import pytest

np = pytest.importorskip("numpy")

ROOT = Path(__file__).parents[3]
SPHERES = ROOT / "assets/scenes/spheres_and_triangles.scene"
PROGRAM = os.environ.get("GLIMRAY")


def program(*arguments: str | os.PathLike[str]) -> None:
    if PROGRAM is None:
        pytest.skip("GLIMRAY names no program to compare with")
    subprocess.run([PROGRAM, *arguments, "--quiet"], check=True)


@pytest.mark.parametrize(
    "settings, flags",
    [
        ({"size": (64, 48)}, ["--size", "64x48"]),
        ({"size": "48x64", "samples": 4, "integrator": "path"}, ["--size", "48x64", "--samples", "4", "--integrator", "path"]),
        ({"size": (64, 48), "integrator": "normals"}, ["--size", "64x48", "--integrator", "normals"]),
        ({"size": (64, 48), "integrator": "heat"}, ["--size", "64x48", "--integrator", "heat"]),
        (
            {"size": (64, 48), "integrator": "path", "samples": 4, "denoise": True, "exposure": "auto"},
            ["--size", "64x48", "--integrator", "path", "--samples", "4", "--denoise", "--exposure", "auto"],
        ),
        (
            {"size": (64, 48), "crop": (8, 8, 40, 40), "look_from": (0.5, 1, 4), "look_at": (0, 0, -1.5)},
            ["--size", "64x48", "--crop", "8,8,40,40", "--look-from", "0.5,1,4", "--look-at", "0,0,-1.5"],
        ),
        (
            {"size": (64, 48), "integrator": "path", "samples": 2, "background": "transparent"},
            ["--size", "64x48", "--integrator", "path", "--samples", "2", "--background", "transparent"],
        ),
        ({"size": (64, 48), "fov_y": 30, "max_depth": 3}, ["--size", "64x48", "--fov-y", "30", "--max-depth", "3"]),
        ({"size": (64, 48), "antialias": "adaptive", "samples": 16}, ["--size", "64x48", "--antialias", "adaptive", "--samples", "16"]),
    ],
)
@pytest.mark.parametrize("ending", ["png", "exr"])
def test_files_have_the_bytes_of_the_program(tmp_path, settings, flags, ending):
    gl.render(SPHERES, **settings).save(tmp_path / f"module.{ending}")
    program("render", SPHERES, *flags, "-o", tmp_path / f"program.{ending}")
    assert (tmp_path / f"module.{ending}").read_bytes() == (tmp_path / f"program.{ending}").read_bytes()


def test_layers_are_those_of_the_program(tmp_path):
    settings = {"size": (32, 24), "layers": ["depth", "normal"], "samples": 4}
    picture = gl.render(SPHERES, **settings)
    picture.save(tmp_path / "module.exr")
    flags = ["--size", "32x24", "--layers", "depth,normal", "--samples", "4"]
    program("render", SPHERES, *flags, "-o", tmp_path / "program.exr")
    assert (tmp_path / "module.exr").read_bytes() == (tmp_path / "program.exr").read_bytes()
    normals = picture.layer("normal")
    assert normals.shape == (24, 32, 3)
    assert picture.layer("depth").shape == (24, 32)


def test_a_sphere_before_the_camera_is_as_far_as_geometry_says():
    scene = gl.Scene()
    scene.add_object(sphere={"center": [0, 0, -5], "radius": 1})
    scene.add_light(point={"position": [0, 5, 0]})
    scene.add_camera(look_from=[0, 0, 0], look_at=[0, 0, -1])
    picture = gl.render(scene, size=(9, 9), layers=["depth", "normal", "object"])
    assert picture.layer("depth")[4, 4] == pytest.approx(4, abs=1e-4)
    assert picture.layer("normal")[4, 4] == pytest.approx([0, 0, 1], abs=1e-3)
    assert picture.layer("object")[4, 4] == 1
    with pytest.raises(gl.UsageError, match="Render it with layers depth"):
        gl.render(scene, size=(9, 9)).layer("depth")


def test_values_are_linear_radiance():
    scene = gl.Scene({"background": [0.25, 0.5, 2.0]})
    scene.add_camera(look_from=[0, 0, 0], look_at=[0, 0, -1])
    picture = gl.render(scene, size=(4, 3))
    assert picture.numpy().shape == (3, 4, 4)
    assert picture.numpy().dtype == np.float32
    assert picture.numpy()[1, 2] == pytest.approx([0.25, 0.5, 2.0, 1.0])
    assert np.asarray(picture).shape == (3, 4, 4)
    assert picture.buffer().shape == (3, 4, 4)
    if sys.version_info >= (3, 12):
        assert memoryview(picture).shape == (3, 4, 4)
    # sRGB of 0.25 is 137, of 0.5 is 188 (IEC 61966-2-1).
    assert picture.display()[0, 0].tolist() == [137, 188, 255]
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert (picture.width, picture.height) == (4, 3)


def test_unknown_keywords_are_named():
    with pytest.raises(TypeError, match=r"render\(\) has no keyword sample. Did you mean samples\?"):
        gl.render(SPHERES, sample=3)
    with pytest.raises(TypeError, match="no keyword output"):
        gl.render(SPHERES, output="a.png")


def test_idle_keywords_raise():
    with pytest.raises(gl.UsageError, match="clamp_indirect has no effect"):
        gl.render(SPHERES, integrator="whitted", clamp_indirect=1.0, size=(8, 8))
    with pytest.raises(gl.UsageError, match="fit has no effect"):
        gl.render(SPHERES, fit=True, size=(8, 8))


@pytest.mark.parametrize(
    "settings",
    [{"samples": np.array(2)}, {"samples": 2.0}, {"samples": np.float64(2)}, {"samples": "2"}, {"no_bvh": np.True_, "samples": 2},
     {"set": {"output.samples": np.int64(2)}}, {"set": ["output.samples=2"]}],
)
def test_numbers_of_numpy_are_values(settings):
    assert gl.render(ROOT / "assets/scenes/shapes.toml", size=np.array([8, 6]), **settings).report["image"]["samples"] == 2


def test_names_are_no_flags_and_keep_their_dashes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("--help", "-x.glb", "my--model-x.glb"):
        with pytest.raises(gl.SceneError, match=name):
            gl.render(name)
    gl.render(SPHERES, size=(8, 8)).save("-a.png")
    assert (tmp_path / "-a.png").exists()
    with pytest.raises(gl.SceneError, match="empty"):
        gl.render("")


@pytest.mark.parametrize("settings, said", [({"samples": object()}, "samples"), ({"set": 5}, "set"), ({"set": {"x": None}}, "set"), ({"samples": 0}, "samples"), ({"size": (0, 4)}, "size"), ({"tone": "x"}, "tone")])
def test_values_out_of_range_are_refused(settings, said):
    with pytest.raises(gl.UsageError, match=said):
        gl.render(SPHERES, **settings)


def test_missing_and_broken_scenes_are_refused():
    with pytest.raises(gl.SceneError, match="no such file"):
        gl.render("missing.glb")
    with pytest.raises(gl.SceneError):
        gl.render(b"glTF and nothing else")
    with pytest.raises(ValueError, match="not greater than 0"):
        gl.render(gl.Scene({"objects": [{"sphere": {"center": [0, 0, 0], "radius": -1}}]}))


def test_files_that_cannot_be_written_are_refused(tmp_path):
    picture = gl.render(SPHERES, size=(8, 8))
    with pytest.raises(gl.OutputError):
        picture.save(tmp_path / "missing" / "a.png")
    with pytest.raises(gl.UsageError, match="png"):
        picture.save(tmp_path / "a.xyz")
    picture.save(tmp_path / "a.png")
    with pytest.raises(OSError):
        picture.save(tmp_path / "a.png", clobber=False)


def test_skipped_parts_warn():
    with pytest.warns(gl.GlimrayWarning, match="no light"):
        gl.render(gl.Scene({"objects": [{"sphere": {"center": [0, 0, -5], "radius": 1}}]}), size=(8, 8))


def test_the_second_picture_of_a_scene_compiles_nothing():
    gl.render(SPHERES, size=(16, 16))
    again = gl.render(SPHERES, size=(16, 16))
    assert again.report["seconds"]["compile"] < 0.005
    assert again.report["command"] == "render"
    assert again.report["image"]["width"] == 16


def test_the_trees_of_equal_meshes_are_built_once():
    model = ROOT / "assets/scenes/lighthouse.obj"
    look = {"size": (64, 48), "samples": 1}
    first = gl.render(model, **look)
    again = gl.render(model, look_from=(3, 2, 5), look_at=(0, 1, 0), **look)
    assert again.report["seconds"]["bvh"] < 0.2 * first.report["seconds"]["bvh"]
    gl.render(SPHERES, **look)
    alone = gl.render(model, look_from=(3, 2, 5), look_at=(0, 1, 0), **look)
    assert (again.numpy() == alone.numpy()).all()


def test_progress_grows_to_one():
    seen = []
    gl.render(SPHERES, size=(64, 64), samples=16, progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == pytest.approx(1.0)


def test_an_exception_of_progress_stops_the_work():
    class Stop(Exception):
        pass

    def stop(_done):
        raise Stop

    with pytest.raises(Stop):
        gl.render(SPHERES, size=(256, 256), samples=4096, progress=stop)


def test_other_threads_run_while_a_picture_is_rendered():
    counted = 0
    is_done = threading.Event()

    def count():
        nonlocal counted
        while not is_done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    gl.render(SPHERES, size=(128, 128), samples=256)
    is_done.set()
    thread.join()
    assert counted > 20


def run_python(code: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, **variables}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, timeout=300)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_ctrl_c_stops_between_submissions():
    code = f"import glimray as gl\nprint('ready', flush=True)\ngl.render({str(SPHERES)!r}, size=(512, 512), samples=65536)"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(5)
    started = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert time.monotonic() - started < 10
    assert "KeyboardInterrupt" in said


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_device_after_fork_is_an_error():
    code = f"""
import os, glimray as gl
gl.render({str(SPHERES)!r}, size=(8, 8))
child = os.fork()
if child == 0:
    try:
        gl.render({str(SPHERES)!r}, size=(8, 8))
    except gl.DeviceError as error:
        print(error, flush=True)
    os._exit(0)
os.waitpid(child, 0)
"""
    ran = run_python(code)
    assert ran.returncode == 0, ran.stderr
    assert "fork" in ran.stdout and "spawn" in ran.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="drivers are named by a variable of Linux's loader")
def test_without_an_adapter_the_driver_to_install_is_named():
    code = f"""
import glimray as gl
try:
    gl.render({str(SPHERES)!r}, size=(8, 8))
except gl.NoAdapter as error:
    print(error)
"""
    nowhere = {"VK_ICD_FILENAMES": "/nowhere.json", "VK_DRIVER_FILES": "/nowhere.json", "LIBGL_DRIVERS_PATH": "/nowhere"}
    ran = run_python(code, **nowhere, __EGL_VENDOR_LIBRARY_FILENAMES="/nowhere.json")
    assert ran.returncode == 0, ran.stderr
    assert "mesa-vulkan-drivers" in ran.stdout


def test_the_process_ends_well_with_pictures_alive():
    ran = run_python(f"import glimray as gl\npicture = gl.render({str(SPHERES)!r}, size=(8, 8), max_depth=0)")
    assert (ran.returncode, ran.stderr) == (0, "")


def test_a_pixel_is_explained_as_data():
    picture = gl.render(SPHERES, size=(16, 12), samples=1)
    explained = picture.explain(8, 6)
    assert explained["pixel"] == [8, 6]
    # The rays' contributions add up to the pixel of linear light.
    color = np.array([ray["contribution"] for sample in explained["samples"] for ray in sample["rays"]]).sum(axis=0)
    assert picture.numpy()[6, 8, :3] == pytest.approx(color, rel=1e-3)


def test_videos_are_files_or_bytes(tmp_path):
    scene = ROOT / "assets/scenes/carousel.toml"
    video = gl.animate(scene, frames=(0, 1), size=(32, 24), samples=1)
    assert b"ftyp" in video.data()[:12]
    assert "<video" in video._repr_html_()
    frames = tmp_path / "a_%04d.png"
    gl.animate(scene, frames, frames=(0, 1), size=(32, 24), samples=1)
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["a_0000.png", "a_0001.png"]
    turn = gl.turntable(SPHERES, tmp_path / "turn.gif", seconds=0.1, size=(16, 16))
    assert turn.path.read_bytes().startswith(b"GIF8")
    assert turn.report["animation"]["frames"] == 2


def test_a_sheet_has_the_bytes_of_the_program(tmp_path):
    model = ROOT / "assets/scenes/lighthouse.obj"
    sheet = gl.sheet(model, size=64, views=["front", "top"])
    program("sheet", model, "--size", "64", "--views", "front,top", "-o", tmp_path / "program.png")
    assert sheet.data() == (tmp_path / "program.png").read_bytes()
    assert len(sheet.report["sheet"]["views"]) == 2
    assert "image/png" in sheet._repr_mimebundle_()


def test_pictures_are_compared(tmp_path):
    picture = gl.render(SPHERES, size=(32, 24))
    picture.save(tmp_path / "a.png")
    same = gl.compare(picture, tmp_path / "a.png")
    assert same.rmse == 0 and same.psnr == float("inf") and same.flip == 0 and same.beyond == 0
    other = picture.display().copy()
    other[3, 5, 1] ^= 16
    assert gl.compare(np.zeros((4, 4, 3), int), np.full((4, 4, 3), 255)).rmse == 1
    with pytest.raises(gl.SceneError, match="256"):
        gl.compare(np.zeros((4, 4, 3), int), np.full((4, 4, 3), 256))
    with pytest.raises(gl.UsageError, match="tolerance"):
        gl.compare(picture, picture, tolerance=-1)
    changed = gl.compare(picture, other, tolerance=8)
    assert changed.largest == pytest.approx(16) and changed.largest_at == (5, 3)
    assert changed.rmse == pytest.approx((16 / 255) / (32 * 24 * 3) ** 0.5)
    assert changed.beyond == pytest.approx(100 / (32 * 24))
    assert changed.flip > 0
    with pytest.raises(gl.SceneError, match="32x24"):
        gl.compare(picture, picture.display()[:8])
