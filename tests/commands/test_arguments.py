"""Arguments that commands share: robots by their names, dry runs, and what is said of bad usage."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import get_args

import pytest
from support.commands import Execute
from support.networks import LADDER, ROBOT, configure, edit, source

from urdfsync.engine.result import Exit
from urdfsync.output.console import Format


def test_robots_are_chosen_by_name(execute: Execute, project: Path) -> None:
    configure(ROBOT.format("other", "Other"))
    assert execute("build", "other").out.startswith("other: ")
    message = "error: no robot `othr` in the configuration; did you mean `other`? [unknown-robot]"
    assert execute("build", "othr", code=2).err == f"urdfsync.toml: {message}\n"


@pytest.mark.parametrize(
    "arguments",
    [
        *([], ["biuld"], ["build", "--svg", "--check"], ["build", "--nothing"], ["build", "--dry"]),
        *(["status", "--dry-run"], ["status", "--wait", "soon"]),
    ],
)
def test_bad_usage(arguments: list[str], execute: Execute) -> None:
    """Options are spelled out, too."""
    usage = "usage: urdfsync build" if arguments[:1] == ["build"] else "usage: urdfsync"
    assert execute(*arguments, code=2).err.startswith(usage)


@pytest.mark.parametrize(
    "command", [["build"], ["adopt", "ladder"], ["remove", "ladder"], ["resolve", "--all", "--take"]]
)
def test_n_is_a_dry_run(
    project: Path, execute: Execute, snapshot_of: Callable[[Path], object], command: list[str]
) -> None:
    execute("build")
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "end Ladder;\n// mine\n")
    source('"R2"', '"R3"')
    before = snapshot_of(project)
    code, *printed = execute(*command, "--dry-run", code=None)
    assert execute(*command, "-n", code=code)[1:] == tuple(printed)
    assert snapshot_of(project) == before
    assert any(printed)


def test_what_was_meant_is_said(execute: Execute) -> None:
    meant = {("biuld",): "build", ("build", "--dryrun"): "--dry-run", ("resolve", "--al", "--keep"): "--all"}
    for arguments, name in meant.items():
        assert f"; did you mean `{name}`? [usage]" in execute(*arguments, code=2).err
    assert "unrecognized arguments: --json; write --format json [usage]" in execute("build", "--json", code=2).err
    assert "; `urdfsync --help` says more [usage]" in execute("swim", code=2).err


@pytest.mark.parametrize("written", sorted({*get_args(Format)} - {"text"}))
def test_a_command_that_fails_writes_its_document(folder: Path, execute: Execute, written: str) -> None:
    printed = execute("build", "--format", written, code=Exit.ERROR)
    assert "urdfsync init" in printed.out
    assert printed.err == ""


@pytest.mark.parametrize("given", [["--format=json"], ["--format", "json"]])
def test_wrong_arguments_are_told_in_the_document(project: Path, execute: Execute, given: list[str]) -> None:
    (told,) = execute("build", *given, "--bogus", code=Exit.ERROR).json["diagnostics"]
    assert "unrecognized" in told["message"]


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["status", "--format", "sarif"], "invalid choice: 'sarif'"),
        (["build", "--format", "html"], "invalid choice: 'html'"),
    ],
)
def test_a_format_that_a_command_does_not_have_is_refused(
    folder: Path, execute: Execute, arguments: list[str], problem: str
) -> None:
    printed = execute(*arguments, code=Exit.ERROR)
    assert problem in printed.out + printed.err
