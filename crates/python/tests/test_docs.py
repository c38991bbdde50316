"""Notebooks and the blocks of Python on pages do what they show."""

from __future__ import annotations

import base64
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import glimray as gl
import pytest

pytest.importorskip("numpy")

ROOT = Path(__file__).parents[3]
HELMET = ROOT / "assets/scenes/helmet.glb"
NOTEBOOKS = sorted((ROOT / "docs/notebooks").glob("*.ipynb"))
CI = ROOT / "docs/src/guide/ci.md"

# Drivers round differently: docs/src/guide/ci.md.
LEVELS, PERCENT = 8, 1

MOST_BYTES = 150 * 1024


def pictures(notebook: Any) -> list[tuple[str, bytes]]:
    """The PNG files of the outputs, with the numbers of their cells."""
    found = []
    for number, cell in enumerate(notebook.cells):
        for output in cell.get("outputs", []):
            data = output.get("data", {}).get("image/png")
            if data:
                found.append((f"cell-{number}", base64.b64decode(data)))
    return found


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_show_the_pictures_that_they_store(path, tmp_path):
    for module in ("nbformat", "nbclient", "ipykernel", "PIL"):
        pytest.importorskip(module, reason=f"{module} is missing: pip install nbclient ipykernel pillow")
    import nbclient
    import nbformat

    assert path.stat().st_size <= MOST_BYTES
    notebook = nbformat.read(path, as_version=4)
    stored = pictures(notebook)
    # In an empty folder: notebooks need no files.
    client = nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": tmp_path}})
    client.execute()
    assert not [output.text for cell in notebook.cells for output in cell.get("outputs", []) if output.get("name") == "stderr"]
    shown = pictures(notebook)
    assert stored and [cell for cell, _ in stored] == [cell for cell, _ in shown]
    for (cell, old), (_, new) in zip(stored, shown):
        files = []
        for kind, data in (("old", old), ("new", new)):
            files.append(tmp_path / f"{cell}.{kind}.png")
            files[-1].write_bytes(data)
        difference = gl.compare(*files, tolerance=LEVELS)
        assert difference.beyond <= PERCENT, f"{path.name}, {cell}: {difference}"


def blocks(page: Path) -> Iterator[tuple[int, str]]:
    """The blocks of Python on a page, with the numbers of their first lines."""
    text = page.read_text(encoding="utf-8")
    for block in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text[: block.start(1)].count("\n"), block[1]


def program(code: str) -> str | None:
    """The name of the file that a block is, if its first line says so."""
    named = re.match(r"# (\w+\.py)\n", code)
    return named and named[1]


@pytest.mark.parametrize("page", ["docs/src/guide/python.md", "crates/python/README.md"])
def test_blocks_of_pages_run_in_order(page, tmp_path, monkeypatch):
    if not HELMET.exists():
        pytest.skip("there is no helmet.glb: it is in the checkout of glimray")
    shutil.copy(HELMET, tmp_path)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "page"}
    for line, code in blocks(ROOT / page):
        # Without a GPU they take minutes.
        code = code.replace("samples=64", "samples=1")
        if "import trimesh" in code:
            pytest.importorskip("trimesh", reason="trimesh is missing: the page was run up to the block that imports it")
        name = program(code)
        if name:
            Path(name).write_text(code, encoding="utf-8")
            subprocess.run([sys.executable, name], check=True, timeout=300)
        else:
            exec(compile("\n" * line + code, page, "exec"), names)


def test_the_recipe_for_pytest_finds_a_change(tmp_path):
    ((_, recipe),) = [block for block in blocks(CI) if program(block[1])]
    name = program(recipe)
    assert name
    (tmp_path / name).write_text(recipe, encoding="utf-8")
    corners = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
    model = tmp_path / "models" / "square.ply"
    model.parent.mkdir()
    model.write_bytes(gl.Mesh(corners, [[0, 2, 1], [0, 3, 2]]).ply())

    def failures(**variables: str) -> list[str]:
        # The one that is tested here is tested there.
        search = {"PYTHONPATH": str(Path(gl.__file__).parents[1])}
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", name]
        environment = {**os.environ, **search, **variables}
        ran = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=300)
        assert ran.returncode in (0, 1), ran.stdout + ran.stderr
        return re.findall(r"^FAILED \S+::(\S+)", ran.stdout, re.MULTILINE)

    assert failures() == ["test_models[square]", "test_a_ball_on_the_floor"]
    assert failures(UPDATE="1") == []
    assert failures() == []
    # The square is larger, the ball as before.
    model.write_bytes(gl.Mesh([[x, y, 0.8 * z] for x, y, z in corners], [[0, 2, 1], [0, 3, 2]]).ply())
    assert failures() == ["test_models[square]"]
    (tmp_path / name).write_text(recipe.replace('"radius": 1}', '"radius": 1.05}'), encoding="utf-8")
    assert failures() == ["test_models[square]", "test_a_ball_on_the_floor"]
