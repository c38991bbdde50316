"""Which glimray is tested: `python -m pytest` finds one in the current folder first, `pytest` the installed one."""

from __future__ import annotations

from pathlib import Path

import glimray


def pytest_report_header() -> str:
    return f"glimray {glimray.__version__} in {Path(glimray.__file__).parent}"
