"""The hash of the program that generates packages."""

from __future__ import annotations

from pathlib import Path

import pytest

import urdfsync
from urdfsync.engine.program import program_hash


def test_it_follows_from_the_modules_and_not_from_the_files_that_an_installation_adds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "_data/docs").mkdir(parents=True)
    module = tmp_path / "__init__.py"
    module.touch()
    monkeypatch.setattr(urdfsync, "__file__", str(module))
    hashes = []
    for file in ("_data/docs/page.md", "more.py"):
        hashes.append(program_hash.__wrapped__("urdf", ""))
        (tmp_path / file).touch()
    assert hashes[0] == hashes[1] != program_hash.__wrapped__("urdf", "")
