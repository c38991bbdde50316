"""Type stubs name what is there."""

from __future__ import annotations

import ast
import importlib.util
import inspect
from pathlib import Path

import pytest
from glimray import _native

FOLDER = Path(__file__).parents[1]


def test_the_file_of_keywords_is_current():
    spec = importlib.util.spec_from_file_location("keywords", FOLDER / "keywords.py")
    assert spec and spec.loader
    keywords = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(keywords)
    if keywords.FILE.read_text(encoding="utf-8") != keywords.text():
        pytest.fail("flags have changed: run python crates/python/keywords.py")


def test_the_stub_of_the_native_part_has_its_names_and_parameters():
    tree = ast.parse((FOLDER / "glimray/_native.pyi").read_text(encoding="utf-8"))

    def told(body: list[ast.stmt]) -> dict[str, list[str] | None]:
        functions = [node for node in body if isinstance(node, ast.FunctionDef)]
        properties = {node.name for node in functions if node.decorator_list}
        return {
            node.name: None if node.name in properties else [argument.arg for argument in node.args.args]
            for node in functions
        }

    def there(owner: object, names: list[str]) -> dict[str, list[str] | None]:
        values = {name: getattr(owner, name) for name in names}
        return {name: list(inspect.signature(value).parameters) if callable(value) else None for name, value in values.items()}

    functions = [name for name in _native.__all__ if not isinstance(getattr(_native, name), type)]
    assert told(tree.body) == there(_native, functions)
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    assert sorted([*classes, *functions]) == sorted(_native.__all__)
    for name, node in classes.items():
        native = getattr(_native, name)
        methods = told(node.body)
        made = methods.pop("__new__", None)
        assert methods == there(native, [method for method in vars(native) if not method.startswith("_")])
        assert made is None or made[1:] == list(inspect.signature(native).parameters)
