"""Triangles from other libraries, as a binary PLY file in memory."""

from __future__ import annotations

import functools
import struct
from collections.abc import Sequence
from typing import Any

from ._errors import SceneError

Rows = Any


@functools.cache
def _numpy() -> Any:
    """NumPy where it is installed, imported when it is needed: that takes longer than a small picture."""
    try:
        import numpy
    except ImportError:
        return None
    return numpy


class Mesh:
    """Triangles with optional normals, colours and texture coordinates.

    Args:
        vertices: Positions, (N, 3), in scene units; +y is up unless ``up`` of ``render`` says otherwise.
        faces: Indices of corners, (M, 3) or (M, K) with K corners each; counter-clockwise from the front.
            ``None`` takes each three vertices as a triangle.
        normals: Shading normals, (N, 3). Without them they are computed; edges sharper than 60 degrees stay sharp.
        colors: Colours of vertices, (N, 3) or (N, 4). Whole numbers are bytes of sRGB, 0 to 255; floats are linear, 0 to 1.
        uvs: Texture coordinates, (N, 2); (0, 0) is the lower left of a picture.

    Raises:
        SceneError: The shapes do not fit each other.
    """

    def __init__(
        self,
        vertices: Rows,
        faces: Rows = None,
        *,
        normals: Rows = None,
        colors: Rows = None,
        uvs: Rows = None,
    ) -> None:
        columns = [_floats("vertices", vertices, (3,))]
        self._count = len(columns[0])
        self._names = ["x", "y", "z"]
        for name, rows, widths, properties in (
            ("normals", normals, (3,), ["nx", "ny", "nz"]),
            ("uvs", uvs, (2,), ["s", "t"]),
            ("colors", _linear(colors), (3, 4), ["linear_red", "linear_green", "linear_blue", "linear_alpha"]),
        ):
            if rows is None:
                continue
            rows = _floats(name, rows, widths)
            if len(rows) != self._count:
                raise SceneError(f"bad mesh ({name}): {len(rows)} rows for {self._count} vertices. Give one for each.")
            if name == "colors":
                rows = _opaque(rows)
            columns.append(rows)
            self._names += properties
        self._vertices = _interleaved(columns)
        self._faces, self._face_count = _faces(faces, self._count)

    @classmethod
    def of(cls, source: Any) -> Mesh:
        """The mesh of another library's object: trimesh, Open3D, PyVista, or anything with ``vertices`` and ``faces``.

        Raises:
            SceneError: It has neither.
        """
        np = _numpy()
        if isinstance(source, Mesh):
            return source
        if hasattr(source, "to_legacy"):
            # A mesh of Open3D's tensors.
            source = source.to_legacy()
        if hasattr(source, "extract_surface") or hasattr(type(source), "regular_faces"):
            return cls._of_pyvista(source)
        vertices = _first(source, "vertices", "points")
        faces = _first(source, "faces", "triangles", "cells")
        if vertices is None or faces is None:
            raise SceneError(
                f"cannot render this ({type(source).__name__}): it has no vertices and faces. "
                "Give a path, bytes, a Scene, a Mesh, or an object with vertices and faces."
            )
        if np is None:
            return cls(vertices, faces)
        if hasattr(source, "triangle_uvs") and hasattr(source, "vertex_colors"):
            return cls._of_open3d(source)
        colors = None
        visual: Any = getattr(source, "visual", None)
        kind = getattr(visual, "kind", None)
        if kind == "face":
            faces = np.asarray(faces)
            colors = np.repeat(np.asarray(visual.face_colors), 3, axis=0)
            return cls(np.asarray(vertices)[faces.reshape(-1)], colors=colors)
        if kind == "vertex":
            colors = np.asarray(visual.vertex_colors)
        return cls(vertices, faces, colors=colors)

    @classmethod
    def _of_open3d(cls, source: Any) -> Mesh:
        np = _numpy()
        vertices, faces = np.asarray(source.vertices), np.asarray(source.triangles)
        optional = {}
        if len(source.vertex_normals) == len(vertices):
            optional["normals"] = np.asarray(source.vertex_normals)
        if len(source.vertex_colors) == len(vertices):
            shown = np.clip(np.asarray(source.vertex_colors), 0, 1)
            optional["colors"] = np.rint(255 * shown).astype(np.uint8)
        uvs = np.asarray(source.triangle_uvs)
        if len(uvs) == 3 * len(faces) > 0:
            # Texture coordinates are those of corners.
            corners = faces.reshape(-1)
            optional = {name: rows[corners] for name, rows in optional.items()}
            return cls(vertices[corners], uvs=uvs, **optional)
        return cls(vertices, faces, **optional)

    @classmethod
    def _of_pyvista(cls, source: Any) -> Mesh:
        np = _numpy()
        if not hasattr(type(source), "regular_faces"):
            source = _surface(source)
        if not source.is_all_triangles:
            source = source.triangulate()
        data = source.point_data
        # Normals of points are means over all edges, which PyVista itself shows only when it is asked for.
        optional = {}
        if data.active_texture_coordinates is not None:
            optional["uvs"] = data.active_texture_coordinates
        colors = data.active_scalars
        if colors is not None and colors.ndim == 2 and colors.shape[1] in (3, 4) and colors.dtype == np.uint8:
            optional["colors"] = colors
        return cls(source.points, source.regular_faces, **optional)

    def numbers(self, corners: bytes) -> Any:
        """The faces of the triangles with these corners, nine floats each: in their order, some left out.

        Returns:
            An array of (M,) int32; ``None`` if none is left out, or faces are no triangles.
        """
        np = _numpy()
        kept = np.frombuffer(corners, np.float32).reshape(-1, 9)
        size = 1 + 4 * 3
        if len(kept) == self._face_count or len(self._faces) != size * self._face_count:
            return None
        rows = np.frombuffer(self._faces, [("count", "u1"), ("corners", "<u4", (3,))])
        width = len(self._names)
        positions = np.frombuffer(self._vertices, "<f4").reshape(-1, width)[:, :3]
        given = positions[rows["corners"]].reshape(-1, 9)
        numbers, face = np.empty(len(kept), np.int32), 0
        for number, triangle in enumerate(kept):
            while (given[face] != triangle).any():
                face += 1
            numbers[number] = face
            face += 1
        return numbers

    def ply(self) -> bytes:
        """The mesh as a binary PLY file."""
        header = f"ply\nformat binary_little_endian 1.0\nelement vertex {self._count}\n"
        header += "".join(f"property float {name}\n" for name in self._names)
        header += f"element face {self._face_count}\nproperty list uchar uint vertex_indices\nend_header\n"
        return b"".join([header.encode(), self._vertices, self._faces])


def _surface(source: Any) -> Any:
    """The surface of a data set of PyVista. Versions before 0.47 know no algorithms and have this one."""
    try:
        return source.extract_surface(algorithm="dataset_surface")
    except TypeError:
        return source.extract_surface()


def _first(source: Any, *names: str) -> Any:
    return next((getattr(source, name) for name in names if getattr(source, name, None) is not None), None)


def _floats(name: str, rows: Rows, widths: tuple[int, ...]) -> Rows:
    """Rows of floats of one of these widths."""
    np = _numpy()
    wanted = " or ".join(str(width) for width in widths)
    try:
        if np is not None:
            rows = np.asarray(rows, dtype=np.float32)
            fits = rows.ndim == 2 and rows.shape[1] in widths
        else:
            rows = [tuple(map(float, row)) for row in rows]
            fits = len({len(row) for row in rows} | {0}) <= 2 and all(len(row) in widths for row in rows)
    except (TypeError, ValueError) as error:
        raise SceneError(f"bad mesh ({name}): {error}. Give rows of {wanted} numbers.") from None
    if not fits:
        raise SceneError(f"bad mesh ({name}): the rows do not have {wanted} numbers. Give an array of (N, {wanted}).")
    return rows


def _linear(colors: Rows) -> Rows:
    """Linear colours: whole numbers are bytes of sRGB."""
    np = _numpy()
    if colors is None:
        return None
    if np is None:
        rows = [tuple(row) for row in colors]
        is_bytes = all(isinstance(value, int) for row in rows for value in row)
        _check_colors(min(map(min, rows), default=0), max(map(max, rows), default=0), is_bytes)
        shown = [tuple(value / 255 for value in row) for row in rows] if is_bytes else rows
        return [tuple(map(_from_srgb, row[:3])) + row[3:] for row in shown] if is_bytes else rows
    colors = np.asarray(colors)
    is_bytes = colors.dtype.kind in "ui"
    if colors.dtype.kind not in "uif":
        return colors
    _check_colors(colors.min(initial=0), colors.max(initial=0), is_bytes)
    if not is_bytes:
        return colors
    shown = colors.astype(np.float64) / 255
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    if colors.ndim == 2 and colors.shape[1] == 4:
        linear[:, 3] = shown[:, 3]
    return linear


def _from_srgb(value: float) -> float:
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def _check_colors(least: float, most: float, is_bytes: bool) -> None:
    if is_bytes and most == 1:
        raise SceneError("bad mesh (colors): whole numbers of 0 and 1 are nearly black bytes. Give floats for linear colours.")
    limit = 255 if is_bytes else 1
    if least < 0 or most > limit:
        raise SceneError(f"bad mesh (colors): {least} to {most}. Give whole numbers of 0 to 255, or floats of 0 to 1.")


def _opaque(rows: Rows) -> Rows:
    """Colours with an opacity, which is 1 where there is none."""
    np = _numpy()
    if np is not None:
        full = np.ones((len(rows), 4), np.float32)
        full[:, : rows.shape[1]] = rows
        return full
    return [tuple(row) + (1.0,) * (4 - len(row)) for row in rows]


def _interleaved(columns: Sequence[Rows]) -> bytes:
    np = _numpy()
    if np is not None:
        return bytes(np.hstack(columns).astype("<f4").tobytes())
    rows = (sum(parts, ()) for parts in zip(*columns))
    return b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)


_NO_FACES = "bad mesh (faces): they are no rows of at least three indices, as many in each. Give an array of (M, 3) integers."


def _faces(faces: Rows, count: int) -> tuple[bytes, int]:
    np = _numpy()
    if faces is None:
        if count % 3:
            raise SceneError(f"bad mesh (faces): {count} vertices are no triangles. Give faces, or three for each.")
        faces = [(i, i + 1, i + 2) for i in range(0, count, 3)] if np is None else np.arange(count).reshape(-1, 3)
    if np is None:
        faces = [tuple(face) for face in faces]
        if any(len(face) < 3 or not all(isinstance(corner, int) for corner in face) for face in faces):
            raise SceneError(_NO_FACES)
        _check_indices(min((min(face) for face in faces), default=0), max((max(face) for face in faces), default=0), count)
        return b"".join(struct.pack(f"<B{len(face)}I", len(face), *face) for face in faces), len(faces)
    try:
        faces = np.asarray(faces)
    except ValueError:
        raise SceneError(_NO_FACES) from None
    if faces.size == 0:
        return b"", 0
    if faces.ndim != 2 or not 3 <= faces.shape[1] <= 255 or faces.dtype.kind not in "ui":
        raise SceneError(_NO_FACES)
    _check_indices(int(faces.min()), int(faces.max()), count)
    corners = faces.shape[1]
    rows = np.empty(len(faces), dtype=[("count", "u1"), ("corners", "<u4", (corners,))])
    rows["count"], rows["corners"] = corners, faces
    return rows.tobytes(), len(faces)


def _check_indices(least: int, most: int, count: int) -> None:
    if least < 0 or most >= max(count, 1):
        wrong = least if least < 0 else most
        raise SceneError(f"bad mesh (faces): there is no vertex {wrong}: there are {count}, from 0.")
