"""Scenes: loaded, built and edited in the terms of glimray's native format."""

from __future__ import annotations

import copy
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import OutputError, SceneError, UsageError
from ._mesh import Mesh
from ._session import arguments, native, run

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import ConvertKeywords, InspectKeywords

Source = tuple[str, dict[str, bytes] | None]


class Scene:
    """A scene in memory: a document in the native format, and the files that it names.

    ``document`` is a dict with the tables of the format (``objects``, ``materials``, ``lights``, ``cameras``,
    ``background``, ``output`` and so on), to be read and edited. The manual's reference of native scenes lists all keys.
    A mistake in it is reported when the scene is rendered, with its place. Files that the document names are in ``files``,
    which ``add_mesh``, ``add_texture`` and ``set_background`` fill; none is read from the disk.

    >>> scene = Scene()
    >>> scene.add_material("gold", pbr={"base_color": [1.0, 0.77, 0.34], "metallic": 1.0, "roughness": 0.2})
    >>> scene.add_object(sphere={"center": [0, 1, 0], "radius": 1}, material="gold")
    >>> scene.add_object(plane={"point": [0, 0, 0], "normal": [0, 1, 0]})
    >>> scene.set_background("studio")
    """

    def __init__(self, document: Mapping[str, Any] | None = None, files: Mapping[str, bytes] | None = None) -> None:
        self.document: dict[str, Any] = copy.deepcopy(dict(document or {}))
        self.files: dict[str, bytes] = dict(files or {})

    @classmethod
    def load(cls, source: Any, /, **settings: Unpack[ConvertKeywords]) -> Scene:
        """Reads a scene or a model, in any format and form that ``render`` takes.

        Lights, a ground and a camera are added to a model as ``render`` adds them; ``bare=True`` adds nothing.

        Args:
            source: A path, bytes, or an object with vertices and faces.
            **settings: Keywords of ``glimray convert``, such as ``clip``, ``variant``, ``up`` and ``bare``.

        Raises:
            SceneError: The file is missing, damaged or of another kind.
        """
        name, files = as_source(source)
        words = arguments("convert", name, settings, "Scene.load")
        text, companions, _ = native(_native.convert, words, files)
        return cls(json.loads(_native.from_toml(text)), dict(companions))

    @classmethod
    def from_toml(cls, text: str, files: Mapping[str, bytes] | None = None) -> Scene:
        """A scene from the text of a native file, with the files that it names.

        Raises:
            SceneError: The text is not TOML.
        """
        return cls(json.loads(_native.from_toml(text)), files)

    def to_toml(self) -> str:
        """The document as the text of a native file.

        Raises:
            SceneError: The document has values that TOML has not, such as None.
        """
        try:
            text = json.dumps(self.document, default=_plain, allow_nan=False)
        except (TypeError, ValueError) as error:
            raise SceneError(f"bad scene: {error}. Use numbers, text, lists and dicts.") from None
        return _native.to_toml(text)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a native file and, beside it, the files that it names.

        Raises:
            OutputError: Another file has the name of one of these.
            OSError: A file cannot be written.
        """
        path, text = Path(path), self.to_toml()
        for name, data in self.files.items():
            beside = path.parent / name
            if beside.exists() and beside.read_bytes() != data:
                raise OutputError(f"cannot write the scene ({beside}): another file has this name. Choose another folder.")
        path.parent.mkdir(parents=True, exist_ok=True)
        for name, data in self.files.items():
            beside = path.parent / name
            beside.parent.mkdir(parents=True, exist_ok=True)
            beside.write_bytes(data)
        path.write_text(text, encoding="utf-8")

    def add_object(self, **table: Any) -> dict[str, Any]:
        """Adds an object with the keys of the table ``object``, such as ``sphere``, ``material`` and ``transform``.

        Returns the table, to be edited.
        """
        self.document.setdefault("objects", []).append(table)
        return table

    def add_mesh(self, source: Any, **table: Any) -> dict[str, Any]:
        """Adds an object with the triangles of ``source``: a ``Mesh``, or an object with vertices and faces.

        Raises:
            SceneError: It has none.
        """
        name = self._add_file(str(table.get("name", "mesh")), "ply", Mesh.of(source).ply())
        return self.add_object(mesh={"file": name}, **table)

    def add_material(self, name: str, **table: Any) -> dict[str, Any]:
        """Adds or replaces a material with the keys of the table ``material``, such as ``pbr`` and ``emission``."""
        self.document.setdefault("materials", {})[name] = table
        return table

    def add_texture(self, name: str, picture: Any = None, **table: Any) -> dict[str, Any]:
        """Adds a texture with the keys of the table ``texture``.

        Args:
            name: The name for ``{"texture": name}`` in the place of a colour.
            picture: Pixels, (height, width, 3 or 4): bytes are sRGB, floats are linear. Or the bytes of a file.
            **table: Other keys, such as ``scale`` or ``checker``.
        """
        if picture is not None:
            table["picture"] = self._add_picture(name, picture)
        self.document.setdefault("textures", {})[name] = table
        return table

    def add_light(self, **table: Any) -> dict[str, Any]:
        """Adds a light with the keys of the table ``light``, such as ``point`` or ``rectangle``."""
        self.document.setdefault("lights", []).append(table)
        return table

    def add_camera(self, **table: Any) -> dict[str, Any]:
        """Adds a camera with the keys of the table ``camera``, such as ``look_from`` and ``look_at``."""
        self.document.setdefault("cameras", []).append(table)
        return table

    def set_background(self, background: Any, **table: Any) -> None:
        """Sets the background and with it the environment's light.

        Args:
            background: A colour, the name of a built-in environment, a table of the format, or the pixels of an
                equirectangular picture, (height, 2 * height, 3): bytes are sRGB, floats are linear.
            **table: Keys beside a picture, such as ``strength`` and ``rotation_deg``.
        """
        if hasattr(background, "shape") and getattr(background, "ndim", 0) == 3:
            background = {"picture": self._add_picture("background", background)}
        if table:
            background = {"environment": background} if isinstance(background, str) else background
            if not isinstance(background, Mapping):
                raise UsageError(f"{', '.join(table)} has no effect: a colour has none. Give a picture or a built-in environment.")
            background = {**background, **table}
        self.document["background"] = background

    def inspect(self, **settings: Unpack[InspectKeywords]) -> dict[str, Any]:
        """The contents of the scene as ``glimray inspect --json`` tells them."""
        return inspect(self, **settings)

    def _source(self) -> Source:
        """The name of the native file and all files."""
        return "scene.toml", {**self.files, "scene.toml": self.to_toml().encode()}

    def _add_picture(self, name: str, picture: Any) -> str:
        if isinstance(picture, (bytes, bytearray, memoryview)):
            data = bytes(picture)
            return self._add_file(name, _picture_ending(data), data)
        size, pixels, is_linear, _ = as_pixels(picture)
        ending = "exr" if is_linear else "png"
        return self._add_file(name, ending, _native.encode(size, pixels, ending))

    def _add_file(self, name: str, ending: str, data: bytes) -> str:
        stem = re.sub(r"[^\w-]", "_", name) or "file"
        number, file = 1, f"{stem}.{ending}"
        while file in self.files:
            number += 1
            file = f"{stem}-{number}.{ending}"
        self.files[file] = data
        return file


def _plain(value: Any) -> Any:
    """A number or list of NumPy as one of Python."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene has no value of type {type(value).__name__}")


def _picture_ending(data: bytes) -> str:
    for start, ending in ((b"\x89PNG", "png"), (b"\xff\xd8", "jpg"), (b"RIFF", "webp"), (b"\x76\x2f\x31\x01", "exr"),
                          (b"\xabKTX", "ktx2"), (b"#?", "hdr")):
        if data.startswith(start):
            return ending
    raise SceneError("bad picture: these bytes are no PNG, JPEG, WebP, OpenEXR, KTX2 or Radiance HDR file.")


def as_pixels(picture: Any) -> tuple[tuple[int, int], bytes, bool, bool]:
    """Size, floats of four channels, whether they are linear, and whether there is opacity, of an array."""
    import numpy as np

    array = np.asarray(picture)
    if array.ndim == 2:
        array = np.repeat(array[:, :, None], 3, axis=2)
    if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype.kind not in "uif" or array.size == 0:
        raise SceneError(f"bad picture: an array of {array.shape}. Give (height, width, 3 or 4) bytes or floats.")
    is_linear = array.dtype.kind == "f"
    most = 65535 if array.dtype == np.uint16 else 255
    if not is_linear and (array.min() < 0 or array.max() > most):
        raise SceneError(f"bad picture: numbers of {array.min()} to {array.max()}. Give whole numbers of 0 to 255, or floats.")
    if is_linear and not np.isfinite(array).all():
        raise SceneError("bad picture: numbers that are not finite. Give finite ones.")
    pixels = np.ones((*array.shape[:2], 4), np.float32)
    pixels[..., : array.shape[2]] = array if is_linear else array / np.float32(most)
    height, width = array.shape[:2]
    return (width, height), pixels.tobytes(), is_linear, array.shape[2] == 4


def as_mesh(scene: Any) -> Mesh | None:
    """The mesh of an object with vertices and faces alone."""
    is_file = isinstance(scene, (str, os.PathLike, bytes, bytearray, memoryview, Scene))
    return None if is_file or _is_textured(scene) else Mesh.of(scene)


def as_source(scene: Any) -> Source:
    """The name of a scene file, and its files if they are not on the disk."""
    if isinstance(scene, (str, os.PathLike)):
        if not os.fspath(scene):
            raise SceneError("cannot read the scene: the path is empty. Give the path of a file.")
        return os.fsdecode(os.fspath(scene)), None
    if isinstance(scene, (bytes, bytearray, memoryview)):
        data = bytes(scene)
        name = f"scene.{_scene_ending(data)}"
        return name, {name: data}
    if isinstance(scene, Scene):
        return scene._source()
    mesh = as_mesh(scene)
    if mesh is not None:
        return "mesh.ply", {"mesh.ply": mesh.ply()}
    if getattr(scene, "is_empty", False):
        raise SceneError("cannot render this: the scene of trimesh is empty. Add a mesh to it.")
    return "mesh.glb", {"mesh.glb": scene.export(file_type="glb")}


def _is_textured(scene: Any) -> bool:
    """Whether it is a scene or mesh of trimesh of which only a glTF file keeps all."""
    if type(scene).__module__.split(".")[0] != "trimesh":
        return False
    return hasattr(scene, "geometry") or getattr(getattr(scene, "visual", None), "kind", None) == "texture"


def _scene_ending(data: bytes) -> str:
    start = data[:512].lstrip()
    if data.startswith(b"glTF"):
        return "glb"
    if data.startswith(b"PK\x03\x04"):
        return "zip"
    if start.startswith(b"ply"):
        return "ply"
    if start.startswith(b"{"):
        return "gltf"
    if start.startswith(b"solid") or len(data) >= 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return "stl"
    if re.match(rb"\d+\s+amb:", start):
        return "scene"
    if re.search(rb"(?m)^v\s*$\s*^from\s", data[:4096]):
        return "nff"
    if re.search(rb"(?m)^v\s+[-+.\d]", data):
        return "obj"
    return "toml"


def inspect(scene: Any, /, **settings: Unpack[InspectKeywords]) -> dict[str, Any]:
    """The contents of a scene: counts, bounds, cameras, lights, materials, and everything that was skipped.

    Args:
        scene: As for ``render``.
        **settings: Keywords of ``glimray inspect``.

    Returns:
        What ``glimray inspect --json`` prints.
    """
    said = run("inspect", as_source(scene), settings, extra=["--json"])
    contents: dict[str, Any] = json.loads(said.printed)
    return contents
