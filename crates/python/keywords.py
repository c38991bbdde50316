"""Writes glimray/_keywords.pyi, from which editors and type checkers know the keywords of functions.

Run it with the built module after a flag of the program has changed: ``python crates/python/keywords.py``.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import glimray
from glimray._errors import in_keywords

FILE = Path(__file__).parent / "glimray" / "_keywords.pyi"

HEAD = '''\
"""Keywords of functions, for editors and type checkers; crates/python/keywords.py writes this file."""

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any, Literal, TypeAlias, TypedDict

Choice: TypeAlias = int | str
"""A number or a name."""
Numbers: TypeAlias = Iterable[float] | str
"""Such as (0, 1, 4), an array, or "0,1,4"."""
Path: TypeAlias = str | PathLike[str]
Pixels: TypeAlias = Any
"""An array of (height, width, 3 or 4)."""
'''

# Commands and their functions.
COMMANDS = {
    "render": "`render`",
    "animate": "`animate`",
    "turntable": "`turntable`",
    "sheet": "`sheet`",
    "inspect": "`inspect` and `RayQuery`",
    "convert": "`Scene.load`",
}

# Types by the form of a value in the help.
TYPES = {
    "1..100": "int",
    "A..B": "tuple[int, int] | list[int] | str",
    "AXIS": 'Literal["x", "y", "z"]',
    "DEG": "float",
    "DIR": "Path",
    "EV|auto": 'float | Literal["auto"]',
    "FACTOR": "float",
    "FILE|NAME|sky[:ELEVATION[,AZIMUTH]]": "Path | Pixels",
    "FPS": "float",
    "FRACTION": "float",
    "FRAMES": "float | tuple[float, float] | str",
    "HEIGHT": "float",
    "INDEX|NAME": "Choice",
    "KEY=VALUE": "str",
    "MARGIN": "float",
    "MIB": "int",
    "N": "int",
    "NAME": "Choice",
    "NOISE": "float",
    "PIXELS": "float",
    "R,G,B": "Numbers",
    "R,G,B|transparent": "Numbers",
    "RADIANCE": "float",
    "SECONDS": "float",
    "WxH": "tuple[int, int] | list[int] | str",
    "X,Y,Z": "Numbers",
    "X,Y,Z,OFFSET|none": "Numbers",
    "X,Y,Z|x|y|z": "Numbers",
    "X0,Y0,X1,Y1": "tuple[int, int, int, int] | list[int] | str",
    "bound|fixed:EPS": "str",
    "x|y|z|X,Y,Z": "Numbers",
}


def type_of(keyword: Mapping[str, Any]) -> str:
    """The type of a keyword's values, without None, which stands for no value."""
    if keyword["is_switch"]:
        return "bool"
    if keyword["choices"]:
        one = "Literal[" + ", ".join(f'"{choice}"' for choice in keyword["choices"]) + "]"
        return f"Iterable[{one}] | str" if "," in keyword["value"] else one
    one = TYPES[keyword["value"]]
    if keyword["value"] == "KEY=VALUE":
        return f"Mapping[str, Any] | Iterable[{one}] | {one}"
    return f"Iterable[{one}] | {one}" if keyword["is_repeatable"] else one


def text() -> str:
    """The text of the file."""
    lines = [HEAD]
    for command, functions in COMMANDS.items():
        lines.append(f"\nclass {command.capitalize()}Keywords(TypedDict, total=False):")
        lines.append(f'    """Keywords of {functions}."""\n')
        for name, keyword in glimray.keywords(command).items():
            lines.append(f"    {name}: {type_of(keyword)} | None")
            help_text = in_keywords(keyword["help"])
            lines += textwrap.wrap(f'"""{help_text}."""', 120, initial_indent="    ", subsequent_indent="    ")
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
