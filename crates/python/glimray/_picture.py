"""Rendered pictures and videos, and how they differ."""

from __future__ import annotations

import base64
import json
import os
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from . import _native
from ._errors import SceneError, UsageError
from ._scene import Source, as_pixels, as_source
from ._session import Progress, arguments, keywords, native, run, shown

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import AnimateKeywords, RenderKeywords, SheetKeywords, TurntableKeywords

def _file_name(path: str | os.PathLike[str]) -> str:
    """A path that is not taken for a flag or standard output."""
    name = os.fsdecode(os.fspath(path))
    return f"./{name}" if name.startswith("-") else name


F = TypeVar("F", bound="_File")


class Picture:
    """A rendered picture, which shows itself in a notebook.

    Attributes:
        width: In pixels.
        height: In pixels.
        report: What ``glimray render --report`` writes: counts, settings, the adapter, seconds, memory in bytes.
    """

    def __init__(self, picture: _native.Picture, report: str, source: Source, settings: Mapping[str, Any]) -> None:
        self._native = picture
        self._source = source
        self._settings = dict(settings)
        self._linear: bytes | None = None
        self.width, self.height = picture.size()
        self.report: dict[str, Any] = json.loads(report)

    def __repr__(self) -> str:
        return f"<glimray.Picture {self.width}x{self.height}>"

    def _repr_png_(self) -> bytes:
        return self._native.png()

    def numpy(self) -> Any:
        """Linear radiance as an array of float32, (height, width, 4), from the top left; the last channel is opacity.

        These are the values of an OpenEXR file: exposure and tone curve are applied only where settings ask for them.
        """
        import numpy as np

        return np.frombuffer(self.buffer(), np.float32).reshape(self.height, self.width, 4)

    def display(self) -> Any:
        """Values for a display as an array of uint8, (height, width, 3), those of a PNG file; (…, 4) with opacity."""
        import numpy as np

        shape = (self.height, self.width, 4)
        values = np.frombuffer(self._native.display(), np.float32).reshape(shape)
        channels = 4 if self._native.has_opacity() else 3
        return np.floor(np.clip(values[..., :channels], 0, 1) * np.float32(255) + np.float32(0.5)).astype(np.uint8)

    def buffer(self) -> memoryview[Any]:
        """The values of ``numpy()`` without NumPy: a view of floats, (height, width, 4)."""
        if self._linear is None:
            self._linear = self._native.linear()
        return memoryview(self._linear).cast("B").cast("f", (self.height, self.width, 4))

    # From Python 3.12 on (PEP 688); before that only `buffer` gives a view.
    def __buffer__(self, _flags: int) -> memoryview[Any]:
        return self.buffer()

    @property
    def __array_interface__(self) -> dict[str, Any]:
        self.buffer()
        return {
            "version": 3,
            "shape": (self.height, self.width, 4),
            "typestr": "<f4" if sys.byteorder == "little" else ">f4",
            "data": self._linear,
        }

    def save(self, path: str | os.PathLike[str], *, quality: int = 90, clobber: bool = True) -> None:
        """Writes the picture to a file with the bytes that ``glimray render -o PATH`` writes.

        Args:
            path: The ending chooses the format: .png .jpg .jpeg .exr .hdr, or .film, which keeps all samples.
            quality: Of a JPEG file, 1 to 100.
            clobber: Whether an existing file may be replaced.

        Raises:
            OutputError: The file cannot be written.
            UsageError: The name has no ending of a format, or the format does not keep opacity.
        """
        if not 1 <= quality <= 100:
            raise UsageError(f"quality is 1 to 100, not {quality}.")
        self._native.save(_file_name(path), quality, clobber)

    def layer(self, name: str) -> Any:
        """A layer as an array of float32, (height, width) or (height, width, channels).

        Args:
            name: One of those given as ``layers`` to ``render``, or ``beauty``. Depth is the distance from the camera in
                scene units; normals and positions are in world space; objects and materials are numbers from 1.

        Raises:
            UsageError: The picture was rendered without it.
        """
        import numpy as np

        planes = [np.frombuffer(values, np.float32) for _, values in self._native.layer(name)]
        planes = [plane.reshape(self.height, self.width) for plane in planes]
        return planes[0] if len(planes) == 1 else np.stack(planes, axis=-1)

    def explain(self, x: int, y: int, sample: int | None = None) -> dict[str, Any]:
        """All rays of a pixel: hits, throughput, light samples, contributions.

        Args:
            x: Column, from 0 at the left.
            y: Row, from 0 at the top.
            sample: The number of one sample, from 0; all by default.

        Returns:
            What ``glimray explain --json`` prints.
        """
        known = keywords("explain")
        settings = {name: value for name, value in self._settings.items() if name in known}
        settings |= {"pixel": (x, y), "sample": sample}
        with _without_arrays(settings) as plain:
            explained: dict[str, Any] = json.loads(run("explain", self._source, plain, extra=["--json"]).printed)
        return explained


def render(scene: Any, /, *, progress: Progress = None, **settings: Unpack[RenderKeywords]) -> Picture:
    """Renders a picture of a scene, a model or a mesh.

    A model without camera, lights or ground gets them, as in ``glimray render``.

    Args:
        scene: The path of a file, its bytes, a ``Scene``, a ``Mesh``, or an object of trimesh, Open3D or PyVista.
        progress: ``True`` shows a bar; a function is called with the finished fraction, 0 to 1.
        **settings: Flags of ``glimray render`` with underscores: ``size=(640, 480)``, ``samples=64``,
            ``integrator="path"``, ``look_from=(0, 1, 4)``, ``layers=["depth"]``, ``set={"output.tone": "agx"}``.
            ``glimray.keywords("render")`` lists them with their help.

    Raises:
        TypeError: There is no such keyword.
        UsageError: A value is out of range, or has no effect with the others.
        SceneError: The scene is refused.
        NoAdapter: There is no GPU adapter; the text says what to install.
        KeyboardInterrupt: Ctrl-C; the work stops between two submissions.
    """
    source = as_source(scene)
    given = _without_arrays(settings)
    with given as plain, shown(progress) as report:
        words = arguments("render", source[0], plain)
        picture, said = native(_native.render, words, source[1], report)
    return Picture(picture, said.report, source, settings)


class _without_arrays:
    """Settings with the path of a file in the place of an environment's pixels."""

    def __init__(self, settings: Mapping[str, Any]) -> None:
        self._settings = dict(settings)
        self._file: Any = None

    def __enter__(self) -> dict[str, Any]:
        environment = self._settings.get("environment")
        if hasattr(environment, "shape"):
            size, pixels, is_linear, _ = as_pixels(environment)
            if size[0] != 2 * size[1]:
                raise SceneError(f"bad picture (environment): {size[0]} by {size[1]} pixels. Give one twice as wide as high.")
            ending = "exr" if is_linear else "png"
            data = _native.encode(size, pixels, ending)
            self._file = tempfile.NamedTemporaryFile(suffix=f".{ending}", delete=False)
            with self._file:
                self._file.write(data)
            self._settings["environment"] = self._file.name
        return self._settings

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            os.unlink(self._file.name)


class _File:
    """A file that was rendered, on the disk or in memory."""

    def __init__(self, path: Path | None, data: bytes | None, ending: str, report: str) -> None:
        self.path = path
        self._data = data
        self._ending = ending
        self.report: dict[str, Any] = json.loads(report)

    def data(self) -> bytes:
        """The bytes of the file.

        Raises:
            OSError: There is no single file, as of an animation in frames.
        """
        if self._data is not None:
            return self._data
        assert self.path is not None
        return self.path.read_bytes()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the bytes of the file to another one.

        Raises:
            OSError: The file cannot be written.
        """
        Path(path).write_bytes(self.data())


class Video(_File):
    """A rendered animation. An MP4 or GIF shows itself in a notebook.

    Attributes:
        path: The file; ``None`` if there is none but in memory.
        report: What ``--report`` writes.
    """

    def _repr_html_(self) -> str | None:
        if self._ending == ".gif":
            return f'<img src="data:image/gif;base64,{base64.b64encode(self.data()).decode()}">'
        if self._ending == ".mp4":
            text = base64.b64encode(self.data()).decode()
            return f'<video controls loop autoplay muted src="data:video/mp4;base64,{text}"></video>'
        return None


def animate(
    scene: Any,
    output: str | os.PathLike[str] | None = None,
    /,
    *,
    progress: Progress = None,
    **settings: Unpack[AnimateKeywords],
) -> Video:
    """Renders the animation of a scene.

    Args:
        scene: As for ``render``.
        output: A video (.mp4 .gif .y4m) or frames such as ``walk_%04d.png``; ``None`` keeps an MP4 in memory, for a notebook.
        progress: As for ``render``.
        **settings: Flags of ``glimray animate`` with underscores, such as ``frames=(0, 23)`` and ``fps=24``.

    Raises:
        As ``render``.
    """
    return _file(Video, "animate", scene, output, ".mp4", progress, settings)


def turntable(
    scene: Any,
    output: str | os.PathLike[str] | None = None,
    /,
    *,
    progress: Progress = None,
    **settings: Unpack[TurntableKeywords],
) -> Video:
    """Renders a model that turns once, as a seamless loop.

    Args:
        scene: As for ``render``.
        output: As for ``animate``.
        progress: As for ``render``.
        **settings: Flags of ``glimray turntable`` with underscores, such as ``seconds=4`` and ``elevation=20``.

    Raises:
        As ``render``.
    """
    return _file(Video, "turntable", scene, output, ".mp4", progress, settings)


class Sheet(_File):
    """Views of a model in one picture, which shows itself in a notebook.

    Attributes:
        path: The file; ``None`` if there is none but in memory.
        report: What ``--report`` writes; ``report["sheet"]`` has the places of the views and scene units per pixel.
    """

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        kind = "image/png" if self._ending == ".png" else "image/jpeg"
        return {kind: base64.b64encode(self.data()).decode()}


def sheet(
    scene: Any,
    output: str | os.PathLike[str] | None = None,
    /,
    *,
    progress: Progress = None,
    **settings: Unpack[SheetKeywords],
) -> Sheet:
    """Renders named views of a model in one picture, with axes and a scale bar.

    Args:
        scene: As for ``render``.
        output: A file (.png .jpg); ``None`` keeps a PNG in memory.
        progress: As for ``render``.
        **settings: Flags of ``glimray sheet`` with underscores, such as ``size=320`` and ``views=["front", "left"]``.

    Raises:
        As ``render``.
    """
    return _file(Sheet, "sheet", scene, output, ".png", progress, settings)


def _file(
    kind: type[F],
    command: str,
    scene: Any,
    output: str | os.PathLike[str] | None,
    usual: str,
    progress: Progress,
    settings: Mapping[str, Any],
) -> F:
    """Runs a command that writes a file, to memory in the usual format if there is no output."""
    source = as_source(scene)
    with _without_arrays(settings) as settings:
        if output is not None:
            path = Path(output)
            said = run(command, source, settings, extra=[f"--output={_file_name(path)}"], progress=progress)
            return kind(path, None, path.suffix.lower(), said.report)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"file{usual}"
            said = run(command, source, settings, extra=[f"--output={path}"], progress=progress)
            return kind(None, path.read_bytes(), usual, said.report)


@dataclass(frozen=True)
class Comparison:
    """The difference of two pictures. One level is 1/255."""

    rmse: float
    """Root mean square difference of all channels, for values of 0 to 1."""
    psnr: float
    """Peak signal-to-noise ratio in decibels; infinite for equal pictures."""
    flip: float | None
    """Mean of FLIP (Andersson et al. 2020), 0 (equal) to 1; ``None`` for very large pictures."""
    largest: float
    """Largest difference of a channel, in levels."""
    largest_at: tuple[int, int]
    """Column and row of a pixel with that difference."""
    beyond: float
    """Percentage of pixels that differ by more than the tolerance."""


def compare(a: Any, b: Any, *, tolerance: float = 0.0) -> Comparison:
    """Measures the difference of two pictures of the same size.

    Args:
        a: A ``Picture``, the path of a picture file, or an array of (height, width, 3 or 4): bytes are display values, floats
            are linear radiance.
        b: As ``a``.
        tolerance: Difference in levels at which two pixels count as equal.

    Raises:
        SceneError: A file is refused, or the sizes differ.
    """
    if not tolerance >= 0:
        raise UsageError(f"tolerance is at least 0, not {tolerance}.")
    first, second = _compared(a), _compared(b)
    if first[0] != second[0]:
        (aw, ah), (bw, bh) = first[0], second[0]
        raise SceneError(f"cannot compare: one is {aw}x{ah} pixels, the other {bw}x{bh}. Give pictures of one size.")
    rmse, psnr, flip, largest, at, beyond = _native.compare(first, second, float(tolerance))
    return Comparison(rmse, psnr, flip, largest, (at[0], at[1]), beyond)


def _compared(picture: Any) -> tuple[tuple[int, int], bytes, bool, bool]:
    if isinstance(picture, Picture):
        levels = picture.display()
        return as_pixels(levels)
    if isinstance(picture, (str, os.PathLike)):
        return _native.read_picture(os.fspath(picture))
    if hasattr(picture, "shape"):
        return as_pixels(picture)
    raise UsageError(f"cannot compare this ({type(picture).__name__}): give a Picture, a path or an array.")
