"""glimray: a GPU ray tracer for models and scenes.

>>> import glimray as gl
>>> picture = gl.render("helmet.glb", size=(640, 480), samples=64)  # shows itself in a notebook
>>> picture.save("helmet.png")
>>> picture.numpy().shape
(480, 640, 4)

Lengths are in scene units, angles in degrees; coordinates are right-handed with +y up. Calls run on any GPU, or on the
CPU through Mesa's lavapipe. A picture is a function of its scene and its settings: the same call gives the same bytes, and
those of the program ``glimray``.
"""

from ._errors import (
    DeviceError,
    Error,
    GlimrayWarning,
    NoAdapter,
    OutputError,
    SceneError,
    TooBig,
    UsageError,
)
from ._mesh import Mesh
from ._native import version as _version
from ._picture import Comparison, Picture, Sheet, Video, animate, compare, render, sheet, turntable
from ._query import Hits, RayQuery
from ._scene import Scene, inspect
from ._session import keywords

__version__ = _version()

__all__ = [
    "Comparison",
    "DeviceError",
    "Error",
    "GlimrayWarning",
    "Hits",
    "Mesh",
    "NoAdapter",
    "OutputError",
    "Picture",
    "RayQuery",
    "Scene",
    "SceneError",
    "Sheet",
    "TooBig",
    "UsageError",
    "Video",
    "animate",
    "compare",
    "inspect",
    "keywords",
    "render",
    "sheet",
    "turntable",
]
