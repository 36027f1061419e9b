"""All that a decision reads is recorded: the calls of the system are compared with the record."""

from __future__ import annotations

import builtins
import io
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfsync import cli, dependencies, registry
from urdfsync.dependencies import LSTAT, STAT

READS = ("open", "listdir", "scandir", "readlink")
"""Calls after which the content matters, not only what is there."""


def calls_during(action: Callable[[], object], monkeypatch: pytest.MonkeyPatch) -> set[tuple[str, str]]:
    """The calls of the system that an action makes, each with its path."""
    calls: set[tuple[str, str]] = set()
    with monkeypatch.context() as patch:
        for module, name in (
            *((os, name) for name in ("stat", "lstat", "listdir", "scandir", "readlink", "access", "open")),
            (os.path, "realpath"),
            *((module, "open") for module in (io, builtins)),
        ):
            patch.setattr(module, name, _noting(getattr(module, name), name, calls))
        action()
    return calls


def _noting(function: Callable[..., Any], name: str, calls: set[tuple[str, str]]) -> Callable[..., Any]:
    def noting(*arguments: Any, **options: Any) -> Any:
        if isinstance(arguments[0], str | os.PathLike):
            calls.add((name, os.path.abspath(arguments[0])))  # noqa: PTH100 - a string
        return function(*arguments, **options)

    return noting


@pytest.fixture
def folder(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(in_step, tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    assert cli._main(["build"]) == 0  # the first one in a copy notes that it wrote this folder
    return tmp_path / "project"


@pytest.mark.parametrize("command", [["build"], ["build", "--check"], ["status"], ["build", "--config=urdfsync.toml"]])
def test_all_that_a_command_without_work_asks_for_is_recorded(
    folder: Path, command: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where folders to be searched are missing, or may not be read."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", os.pathsep.join([str(folder / "later"), str(folder / "closed")]))
    (folder / "closed").mkdir(mode=0)
    with dependencies.Dependencies() as found:
        calls = calls_during(lambda: cli._main(command), monkeypatch)
    assert found.complete
    contents = {os.path.abspath(path) for check, path in found.entries if check in (LSTAT, STAT)}  # noqa: PTH100
    known = {os.path.abspath(path) for _, path in found.entries}  # noqa: PTH100
    calls = {(name, path) for name, path in calls if Path(path).is_relative_to(folder.parent)}
    assert len(calls) > 100, "the calls are seen at all"
    absent = {path for path in known - contents if not os.path.lexists(path)}  # there is nothing to read
    seen = contents | absent
    assert {(name, path) for name, path in calls if path not in (seen if name in READS else known)} == set()
    wanted = ("modelica/Lab/package.order", "ros", "robots/leg_meshes/base.stl", ".urdfsync/robots", "own/notes")
    assert {str(folder / path) for path in (*wanted, "closed")} <= contents
    assert str(folder / "later") in absent


@pytest.mark.parametrize("options", [["--full"], ["--jobs", "1"], ["--jobs", "2"]], ids=" ".join)
def test_a_build_that_renders_or_writes_is_incomplete(folder: Path, options: list[str]) -> None:
    if options != ["--full"]:
        (folder / "modelica/Leg/Leg.mo").unlink()
    with dependencies.Dependencies() as found:
        assert cli._main(["build", "--quiet", *options]) == 0
    assert not found.complete


def test_domains_that_are_installed_depend_on_what_else_is(rc_domain: None, rc_site: Path) -> None:
    with dependencies.Dependencies() as found:
        registry.domain("rcnetwork")
    assert (STAT, str(rc_site)) in found.entries


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
