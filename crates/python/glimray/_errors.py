"""Exceptions. Each has the exit code with which the program ends for the same reason."""

from __future__ import annotations

import re


class Error(Exception):
    """Any failure of glimray."""

    exit_code = 1


class UsageError(Error, ValueError):
    """Keywords contradict each other, have no effect, or do not fit the scene."""

    exit_code = 2


class SceneError(Error, ValueError):
    """A scene, a model or another input was refused."""

    exit_code = 3


class OutputError(Error, OSError):
    """A file cannot be written."""

    exit_code = 4


class NoAdapter(Error, RuntimeError):
    """There is no usable GPU adapter. The text says which driver to install."""

    exit_code = 5


class DeviceError(Error, RuntimeError):
    """The GPU kept failing, or its device was opened before the process was forked."""

    exit_code = 6


class TooBig(Error, MemoryError):
    """The scene or the picture is too big for the memory or the adapter."""

    exit_code = 7


class GlimrayWarning(UserWarning):
    """A warning of the program: skipped parts of a scene, missing light, a black picture."""


_CLASSES = {
    kind.exit_code: kind
    for kind in (UsageError, SceneError, OutputError, NoAdapter, DeviceError, TooBig)
}


def in_keywords(text: str) -> str:
    """A message of the program with keywords in place of flags: ``max_depth`` for ``--max-depth``."""
    return re.sub(r"(?<![\w/-])--([a-z][a-z0-9-]*)", lambda flag: flag[1].replace("-", "_"), text)


def of_exit_code(text: str, code: int) -> Error:
    """The exception for a message of the program and its exit code."""
    error = _CLASSES.get(code, Error)(in_keywords(text))
    error.exit_code = code
    return error
