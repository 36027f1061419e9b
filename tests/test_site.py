"""The site is built without a warning, with a page for each command and each function."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import urdfsync

REPOSITORY = Path(__file__).parents[1]


@pytest.mark.slow
def test_the_site(tmp_path: Path) -> None:
    """One test: the site is built once. A warning of Sphinx, such as a link to nowhere, is an error."""
    command: list[str | Path] = [sys.executable, REPOSITORY / "tools/build_site.py", tmp_path]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    commands = {path.stem.replace("-", "_") for path in (tmp_path / "commands").iterdir()}
    modules = {path.stem for path in (REPOSITORY / "urdfsync/commands").glob("*.py")}
    assert commands <= modules
    assert "--dry-run" in (tmp_path / "commands/build.html").read_text(encoding="utf-8")
    functions = (tmp_path / "functions.html").read_text(encoding="utf-8")
    assert all(f'id="urdfsync.{name}"' in functions for name in urdfsync.__all__ if name != "__version__")
    pages = {path.stem for path in (REPOSITORY / "docs").glob("*.md")}
    assert {path.stem for path in (tmp_path / "docs").glob("*.html")} == pages
