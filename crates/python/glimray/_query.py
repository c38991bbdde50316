"""Ray queries: what rays hit, without a picture."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import GlimrayWarning, SceneError
from ._scene import as_mesh, as_source
from ._session import arguments, call

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import InspectKeywords


# As the native part writes it.
_ROW = [("distance", "f4"), ("object", "i4"), ("triangle", "i4"), ("normal", "f4", (3,))]


@dataclass(frozen=True)
class Hits:
    """The closest hits of N rays. Rays that hit nothing have an infinite distance, and -1 as object and triangle."""

    distances: Any
    """From the origin, in scene units: (N,), float32."""
    objects: Any
    """Numbers of objects, from 0: (N,), int32. ``RayQuery.names`` has their names."""
    triangles: Any
    """Numbers of triangles: (N,), int32; -1 for shapes such as spheres. Those of a mesh of triangles that was given are its
    faces; others count the triangles of the object, and leave out those without area."""
    normals: Any
    """Unit normals in world space, of the front of a triangle or the outside of a shape: (N, 3), float32."""

    @property
    def hit(self) -> Any:
        """Whether each ray hit something: (N,), bool."""
        return self.objects >= 0


class RayQuery:
    """Traces rays through a scene that stays on the device.

    Args:
        scene: As for ``render``. Nothing is added to a model.
        time: The moment of an animation, in seconds.
        adapter: The number or a part of the name of a GPU adapter.
        **settings: Keywords of ``glimray inspect``, such as ``up`` and ``clip``.

    Raises:
        SceneError: The scene is refused.
        NoAdapter: There is no GPU adapter.

    Attributes:
        names: Names of the objects by number.

    >>> query = RayQuery(mesh)
    >>> hits = query.closest([[0, 0, 5]], [[0, 0, -1]])
    >>> hits.distances, hits.triangles, hits.normals
    """

    def __init__(
        self,
        scene: Any,
        /,
        *,
        time: float = 0.0,
        adapter: int | str | None = None,
        **settings: Unpack[InspectKeywords],
    ) -> None:
        mesh = as_mesh(scene)
        name, files = as_source(scene if mesh is None else mesh)
        if not name.lower().endswith((".toml", ".scene", ".nff")):
            settings.setdefault("bare", True)
        words = arguments("inspect", name, settings, "RayQuery")
        self._native = call(_native.RayQuery, words, files, float(time), None if adapter is None else str(adapter))
        self.names: list[str] = self._native.names()
        self._numbers: Any = None
        for text in self._native.skipped():
            warnings.warn(text, GlimrayWarning, stacklevel=2)
        if mesh is not None:
            self._numbers = mesh.numbers(self._native.corners())

    def closest(self, origins: Any, directions: Any, t_max: Any = None, *, coherent: bool = False) -> Hits:
        """The closest hit of each ray.

        Args:
            origins: (N, 3), in scene units.
            directions: (N, 3), of any length but 0.
            t_max: (N,) or one number: hits at this distance or beyond do not count.
            coherent: Whether rays that follow each other start close together or go to the same place, such as those of a
                camera. They are then traced in packets, which is faster for such rays only.

        Raises:
            SceneError: The shapes do not fit each other, or a ray is not finite.
        """
        import numpy as np

        rows = _rows(origins, directions, t_max)
        found = np.frombuffer(self._call(self._native.closest, rows, coherent), _ROW)
        triangles = found["triangle"]
        if self._numbers is not None:
            triangles = np.where(triangles >= 0, self._numbers[triangles], -1)
        return Hits(found["distance"], found["object"], triangles, found["normal"])

    def occluded(self, origins: Any, directions: Any, t_max: Any = None, *, coherent: bool = False) -> Any:
        """Whether something is in the way of each ray: (N,), bool. Arguments and errors as for ``closest``."""
        import numpy as np

        rows = _rows(origins, directions, t_max)
        return np.frombuffer(self._call(self._native.occluded, rows, coherent), np.bool_)

    @staticmethod
    def _call(function: Any, rows: tuple[Any, ...], coherent: bool) -> Any:
        try:
            return function(*rows, coherent)
        except ValueError as error:
            if isinstance(error, SceneError):
                raise
            raise SceneError(str(error)) from None


def _rows(origins: Any, directions: Any, t_max: Any) -> tuple[bytes, bytes, bytes | None]:
    import numpy as np

    try:
        origins, directions = np.asarray(origins, np.float64), np.asarray(directions, np.float64)
        ends = None if t_max is None else np.broadcast_to(np.asarray(t_max, np.float32), origins.shape[:1]).tobytes()
    except (TypeError, ValueError) as error:
        raise SceneError(f"bad rays: {error}. Give origins and directions of (N, 3), and t_max of (N,).") from None
    for name, rows in (("origins", origins), ("directions", directions)):
        if rows.ndim != 2 or rows.shape[1] != 3:
            raise SceneError(f"bad rays ({name}): an array of {rows.shape}. Give (N, 3).")
    if len(origins) != len(directions):
        raise SceneError(f"bad rays: {len(origins)} origins for {len(directions)} directions. Give one for each.")
    return origins.tobytes(), directions.tobytes(), ends
