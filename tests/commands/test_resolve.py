"""`urdfsync resolve` where a text is no scenario: paths, saves in between, locks; see `tests/scenarios/resolve.txt`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.commands import SETTLE, Editor, Execute
from support.crashes import Operation, before_each
from support.networks import FRESH, LADDER, MINE, MODEL, edit

from urdfsync.api import build_and_check
from urdfsync.commands import cli
from urdfsync.engine.result import Result
from urdfsync.project.state.lock import build_lock


def conflicts(execute: Execute) -> list[str]:
    """The conflicts that a dry build finds."""
    robots = execute("build", "--dry-run", "--format=json", code=None).json["results"]
    return [found["action"]["path"].removeprefix(f"{LADDER}/") for robot in robots for found in robot["conflicts"]]


def test_what_a_person_wrote_beside_the_versions_of_a_conflict_stays(execute: Execute, clean: Path) -> None:
    execute("build", code=3)
    saved = Path(".urdfsync/conflicts/ladder")
    (version,) = saved.glob("*.generated-*.mo")
    written = {saved / "notes.txt": "ask Ada about R3\n", version: version.read_text() + "// mine, too\n"}
    for path, text in written.items():
        path.write_text(text)
    execute("build", code=3)
    execute("resolve", MODEL, "--take")
    assert {path: path.read_text() for path in saved.iterdir()} == written


# What a path may be


@pytest.mark.parametrize(
    "typed", ["Ladder.mo", "../Ladder/Ladder.mo", ".", "{project}/modelica/Ladder/Ladder.mo", "../../link/Ladder.mo"]
)
def test_paths_count_from_the_working_folder(
    execute: Execute, clean: Path, monkeypatch: pytest.MonkeyPatch, typed: str
) -> None:
    Path("link").symlink_to(LADDER, target_is_directory=True)
    monkeypatch.chdir(LADDER)
    execute("resolve", typed.format(project=clean), "--merge")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--keep"], "name files or folders, or use --all; see `urdfsync status` for the conflicts"),
        ([], "one of the arguments --keep --take --merge --edit --undo --moved is required"),
        ([MODEL, "--all", "--keep"], "--all goes without paths"),
        (["--moved", "R1", "--keep"], "argument --keep: not allowed with argument --moved"),
        (["--all", "--undo"], "--undo goes with paths, not with --all"),
    ],
)
def test_bad_usage(clean: Path, execute: Execute, arguments: list[str], words: str) -> None:
    error = execute("resolve", *arguments, code=2).err
    assert error.startswith("usage: urdfsync resolve ")
    assert f"\nerror: {words}" in error
    assert execute("resolve", *arguments, "--format=json", code=2).json["diagnostics"][0]["code"] == "usage"


@pytest.fixture
def orphan(execute: Execute, project: Path) -> Path:
    """An edited model whose element is gone."""
    execute("build")
    edit(f"{LADDER}/Elements/R2.mo", "equation", "  Real mine;\nequation")
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    execute("build")
    return project / LADDER / "Elements/R2.mo"


# What is saved meanwhile


def save_before(monkeypatch: pytest.MonkeyPatch, path: Path, old: str, new: str) -> None:
    """Let somebody save a file after `resolve` has looked at it, and before it builds."""

    def save_and_build(*arguments: Any) -> Iterator[Result]:
        edit(path, old, new)
        return build_and_check(*arguments)

    monkeypatch.setattr("urdfsync.commands.resolve.build_and_check", save_and_build)


CHANGED = "changed after they were read, so your choice was not applied; look at the file, then choose again"


@pytest.mark.parametrize("choice", ["--take", "--keep", "--edit", "--merge --prefer generated"])
@pytest.mark.parametrize("named", [MODEL, "--all"])
def test_a_file_that_is_saved_after_the_look_stays_in_conflict(
    contradictory: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, choice: str, named: str, editor: Editor
) -> None:
    editor(SETTLE)
    save_before(monkeypatch, Path(MODEL), MINE, '"Element R2, 2 %"')
    printed = execute("resolve", named, *choice.split(), code=3)
    assert CHANGED in printed.err
    assert not any(line.startswith(("  keep ", "  merge ", "  update ")) for line in printed.lines)
    assert '"Element R2, 2 %"' in Path(MODEL).read_text()
    assert conflicts(execute) == ["Ladder.mo"]


def test_a_merge_is_not_taken_of_a_text_that_nobody_has_seen(
    clean: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_before(monkeypatch, Path(MODEL), "Real mine = 1", "Real mine = 2")
    assert CHANGED in execute("resolve", MODEL, "--merge", code=3).err
    assert FRESH not in Path(MODEL).read_text()


def test_an_export_after_the_look_is_not_taken(clean: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    save_before(monkeypatch, Path("ladder.json"), '"R3"', '"R4"')
    assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert "Real mine" in Path(MODEL).read_text()


def test_an_orphan_that_is_saved_after_the_look_is_not_deleted(
    orphan: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_before(monkeypatch, orphan, "Real mine;", "Real mine, yours;")
    assert CHANGED in execute("resolve", str(orphan), "--take", code=3).err
    assert "Real mine, yours;" in orphan.read_text()


def test_an_edit_without_conflict_that_is_saved_after_the_look_stays(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    execute("build")
    edit(MODEL, "equation", "  Real mine;\n\nequation")
    save_before(monkeypatch, Path(MODEL), "Real mine;", "Real mine, yours;")
    assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert "Real mine, yours;" in Path(MODEL).read_text()


@pytest.mark.parametrize("operation", ["write", "exchange", "sync"])
def test_a_save_while_the_choice_is_carried_out_stays(contradictory: Path, execute: Execute, operation: str) -> None:
    saved = Path(MODEL).read_text().replace("1 %", "2 %")

    def save(found: Operation) -> None:
        if found.name == operation:
            Path(MODEL).write_text(saved)

    with before_each(save):
        assert CHANGED in execute("resolve", MODEL, "--take", code=3).err
    assert Path(MODEL).read_text() == saved
    assert conflicts(execute) == ["Ladder.mo"]


def test_another_build_is_waited_for(clean: Path, execute: Execute) -> None:
    with build_lock(clean / ".urdfsync", 0) as lock:
        lock.acquire()
        execute("resolve", MODEL, "--merge", "--wait", "0", code=4)
    assert "parameter Real mine = 1;" in Path(MODEL).read_text()
    assert FRESH not in Path(MODEL).read_text()


def test_a_configuration_elsewhere(
    clean: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute
) -> None:
    monkeypatch.chdir(tmp_path)
    (line,) = [
        line
        for line in execute("build", "--config", "project/urdfsync.toml", code=3).lines
        if line.startswith("    urdfsync resolve")
    ]
    command = line.split()[1:]
    assert command == ["resolve", f"project/{MODEL}", "--merge", "--config", "project/urdfsync.toml"]
    assert cli.main(command) == 0
