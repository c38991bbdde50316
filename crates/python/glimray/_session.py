"""Calls of the native part: keywords become the arguments of a command line, warnings become Python's."""

from __future__ import annotations

import atexit
import difflib
import functools
import json
import os
import sys
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from . import _native
from ._errors import GlimrayWarning, UsageError, in_keywords

Progress = bool | Callable[[float], Any] | None

# A driver must not be at work when the process ends.
atexit.register(_native.close)


# The width of lavapipe's vectors. Other drivers of Mesa in this process must not read ours: wide ones crash when they draw.
_WIDTH = "LP_NATIVE_VECTOR_WIDTH"


@functools.cache
def _set_environment() -> frozenset[str]:
    """Sets what Mesa's lavapipe reads when it is loaded, and returns the names of what was missing."""
    found, said = _native.driver_environment()
    _warn(said)
    missing = {name: os.fsdecode(value) for name, value in found}
    os.environ.update(missing)
    return frozenset(missing)


def call(function: Callable[..., Any], *arguments: Any) -> Any:
    """Calls a function of the native part that may open a device."""
    missing = _set_environment()
    try:
        return function(*arguments)
    finally:
        # Lavapipe reads it once.
        if _WIDTH in missing and _native.is_open():
            os.environ.pop(_WIDTH, None)


@functools.cache
def keywords(command: str) -> dict[str, dict[str, Any]]:
    """The keywords of a command by name: flag, form of the value, choices and help."""
    found = json.loads(_native.keywords(command))
    if not found:
        raise UsageError(f"there is no command {command}: choose render, animate, turntable, sheet, explain, inspect or convert.")
    return {keyword["name"]: keyword for keyword in found}


def arguments(
    command: str, name: str | os.PathLike[str], settings: Mapping[str, Any], function: str | None = None
) -> list[str]:
    """The command line of a call of `command` for the scene `name`.

    Raises:
        TypeError: There is no such keyword.
        UsageError: A value has no form that the flag takes.
    """
    known = keywords(command)
    name = os.fspath(name)
    # A name is no flag, and not standard input.
    words = [command, f"./{name}" if name.startswith("-") else name]
    for key, value in settings.items():
        if key not in known:
            near = difflib.get_close_matches(key, known, n=1)
            hint = f" Did you mean {near[0]}?" if near else ""
            raise TypeError(f"{function or command}() has no keyword {key}.{hint}")
        words += _words(known[key], value)
    return words


def _words(keyword: Mapping[str, Any], value: Any) -> Iterable[str]:
    flag = keyword["flag"]
    if value is None:
        return []
    if keyword["is_switch"]:
        if not isinstance(value, bool) and type(value).__name__ not in ("bool_", "bool"):
            raise UsageError(f"{keyword['name']} is True or False, not {value!r}.")
        if value:
            return [flag]
        # A switch that a model or a scene may have on has a counterpart.
        return ["--no-denoise"] if flag == "--denoise" else []
    if keyword["is_repeatable"]:
        if isinstance(value, Mapping):
            value = [f"{key}={_toml(item)}" for key, item in value.items()]
        values = [value] if isinstance(value, (str, os.PathLike)) else value
        return [f"{flag}={_text(keyword, item, ',')}" for item in _items(keyword, values)]
    if isinstance(value, bool):
        raise UsageError(f"{keyword['name']} is {keyword['value']}, not {value}.")
    separator = {"WxH": "x", "A..B": ".."}.get(keyword["value"], ",")
    return [f"{flag}={_text(keyword, value, separator)}"]


def _items(keyword: Mapping[str, Any], value: Any) -> list[Any]:
    try:
        return list(value)
    except TypeError:
        raise UsageError(f"{keyword['name']} is {keyword['value']}, not {value!r}.") from None


def _text(keyword: Mapping[str, Any], value: Any, separator: str) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(os.fspath(value))
    if getattr(value, "ndim", None) == 0:
        # A number of NumPy.
        value = value.item()
    if hasattr(value, "__iter__"):
        return separator.join(_text(keyword, item, separator) for item in value)
    if hasattr(value, "__index__"):
        return str(value.__index__())
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise UsageError(f"{keyword['name']} is {keyword['value']}, not {value!r}.") from None
    return str(int(number)) if number.is_integer() and abs(number) < 2**53 else repr(number)


def _toml(value: Any) -> str:
    """A value of TOML in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(key)} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if hasattr(value, "tolist"):
        return _toml(value.tolist())
    try:
        if value is None:
            raise TypeError
        return json.dumps(value, allow_nan=False)
    except (TypeError, ValueError):
        raise UsageError(f"set takes numbers, text, lists and dicts, not {value!r}.") from None


def run(
    command: str,
    source: tuple[str, dict[str, bytes] | None],
    settings: Mapping[str, Any],
    *,
    extra: Iterable[str] = (),
    progress: Progress = None,
    function: str | None = None,
) -> _native.Ran:
    """Runs a command for a scene, and warns of what it warns of."""
    name, files = source
    words = [*arguments(command, name, settings, function), *extra]
    with shown(progress) as report:
        said: _native.Ran = native(_native.run, words, files, report)
    return said


def native(function: Callable[..., Any], *arguments: Any) -> Any:
    """Calls the native part; the last item of the result, or the result, has what was said."""
    result = call(function, *arguments)
    _warn(result[-1] if isinstance(result, tuple) else result)
    return result


def _warn(said: _native.Ran) -> None:
    for text in said.warnings:
        warnings.warn(in_keywords(text), GlimrayWarning, stacklevel=_caller())


def _caller() -> int:
    """The level of the first caller outside of this package, for `warnings.warn` in the caller of this function."""
    frame, level = sys._getframe(1), 1
    package = os.path.dirname(__file__)
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == package:
        frame, level = frame.f_back, level + 1
    return level


class shown:
    """Shows progress as asked: by a function, by a bar, or not at all."""

    def __init__(self, progress: Progress) -> None:
        self._bar: Any = None
        self._report: Callable[[float], Any] | None = None
        if progress is True:
            self._bar = _bar()
            self._report = self._bar.to
        elif callable(progress):
            self._report = progress
        elif progress not in (None, False):
            raise UsageError(f"progress is True, False or a function of the finished fraction, not {progress!r}.")

    def __enter__(self) -> Callable[[float], Any] | None:
        return self._report

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _bar() -> Any:
    """A bar of tqdm where it is installed, else one of our own."""
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        return _Bar()

    class Bar(tqdm):  # type: ignore[misc]
        def to(self, done: float) -> None:
            self.update(done - self.n)

    return Bar(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}", leave=False)


class _Bar:
    """A bar on standard error."""

    _WIDTH = 40

    def to(self, done: float) -> None:
        full = round(done * self._WIDTH)
        sys.stderr.write(f"\r{100 * done:3.0f} % |{'#' * full}{' ' * (self._WIDTH - full)}|")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\r" + " " * (self._WIDTH + 10) + "\r")
        sys.stderr.flush()
