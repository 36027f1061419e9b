"""What was read is recorded; the record is incomplete if something changed meanwhile, or was rendered or written."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from support.networks import run_all

from urdfsync import dependencies
from urdfsync.dependencies import VARIABLE


@pytest.fixture
def folder(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(in_step, tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    run_all()  # the first one in a copy notes that it wrote this folder
    return tmp_path / "project"


@pytest.mark.parametrize("options", [{"full": True}, {"jobs": 1}, {"jobs": 2}], ids=str)
def test_a_build_that_renders_or_writes_is_incomplete(folder: Path, options: dict[str, Any]) -> None:
    if "jobs" in options:
        (folder / "modelica/Leg/Leg.mo").unlink()
    with dependencies.Dependencies() as found:
        assert not any(result.failed for result in run_all(**options))
    assert not found.complete


def test_environment_variables_are_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("LENGTH", raising=False)
    for value in (None, "", "0.5", "0.6"):
        if value is not None:
            monkeypatch.setenv("LENGTH", value)
        before = dependencies.check_path(VARIABLE, "LENGTH")
        with dependencies.Dependencies() as found:
            assert dependencies.read_variable("LENGTH") == value
        assert found.entries == {(VARIABLE, "LENGTH"): before}
        monkeypatch.setenv("LENGTH", "another")
        assert dependencies.check_path(VARIABLE, "LENGTH") != before


def test_what_changes_or_fails_meanwhile_makes_the_record_incomplete(tmp_path: Path) -> None:
    file = tmp_path / "file"
    with dependencies.Dependencies() as found:
        assert not dependencies.is_file(file)
        file.write_text("a")
        assert dependencies.is_file(file)
    assert not found.complete, "it came meanwhile"
    with dependencies.Dependencies() as found:
        assert dependencies.read_file(file) == b"a"
        assert found.complete
        file.write_text("ab")
        assert dependencies.read_file(file) == b"ab"
    assert not found.complete, "it changed meanwhile"
    with dependencies.Dependencies() as found, pytest.raises(OSError, match="too long"):
        dependencies.is_file(tmp_path / ("a" * 5000))
    assert not found.complete, "the system did not tell"
