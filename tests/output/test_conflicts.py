"""How conflicts look on wide and narrow terminals and in pipes, and what is proposed to settle them."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import merge
from urdfsync.outcome import Result
from urdfsync.output.conflicts import FULL, conflict_lines
from urdfsync.output.console import Console as CommandConsole
from urdfsync.output.differences import LINES

ELBOW = "modelica/Arm/Elbow.mo"
SAVED = ".urdfsync/conflicts/arm/Elbow"
BASE = "within Arm;\nmodel Elbow\n  Real a = 1;\n\n  Real b = 2;\nend Elbow;\n"
EDITED = BASE.replace("a = 1;", "a = 1; // measured")
EXPORTED = BASE.replace("b = 2;", "b = 3;")
OPPOSED = BASE.replace("a = 1;", "a = 7;"), BASE.replace("a = 1;", "a = 9;")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def texts_of(mine: str, generated: str, base: str | None = BASE, path: str = ELBOW, **more: str) -> Conflict:
    merged = None if base is None else merge(base, mine, generated)
    return Conflict(path, "link elbow", base, mine, generated, merged, **more)


def result(*texts: Conflict, kind: Kind = Kind.CONFLICT, dry: bool = False) -> Result:
    actions = [Action(s.path, kind, Role.MODEL, s.owner, origin=s.origin, mine="hash") for s in texts]
    return Result(
        "arm", "Arm", Path("modelica/Arm").absolute(), Path.cwd(), Actions(actions), dry=dry, conflict_texts=texts
    )


def seen(found: Result, width: int | None = None, **options: Any) -> list[str]:
    """The lines as they appear on a terminal of this width, or in a pipe."""
    screen = Console(file=io.StringIO(), width=width, force_terminal=width is not None, color_system=None)
    return [str(line).rstrip() for line in conflict_lines(found, CommandConsole(**options), screen)]


# What happened, and what to do


def test_a_terminal_shows_the_versions_and_what_to_do() -> None:
    assert seen(result(texts_of(EDITED, EXPORTED)), 100) == [
        "",
        "  conflict   modelica/Arm/Elbow.mo  link elbow",
        "    You edited it, and what it is made from changed too. The changes fit together: --merge takes",
        "    both.",
        "",
        "    -- lines 1 to 6: your edit and what is new",
        "               1  within Arm;",
        "               2  model Elbow",
        "    base       3    Real a = 1;",
        "    mine       3    Real a = 1; // measured",
        "               4",
        "    base       5    Real b = 2;",
        "    generated  5    Real b = 3;",
        "               6  end Elbow;",
        "",
        f"    saved: {SAVED}.base.mo, {SAVED}.generated.mo, {SAVED}.merge.mo",
        "    urdfsync resolve modelica/Arm/Elbow.mo --merge",
        "    --merge takes both sides' changes; --keep leaves your file as it is; --take replaces it by the",
        "    generated one",
    ]


def test_all_terminals_and_a_pipe_show_the_versions_one_below_the_other() -> None:
    found = result(texts_of(*OPPOSED))
    stack = [
        "    -- lines 1 to 5: the sides contradict each other",
        "               1  within Arm;",
        "               2  model Elbow",
        "    base       3    Real a = 1;",
        "    mine       3    Real a = 7;",
        "    generated  3    Real a = 9;",
        "               4",
        "               5    Real b = 2;",
    ]
    for width in (None, 80, 120):
        lines = seen(found, width)
        assert [line for line in lines if line in stack] == stack
        assert " ".join(" ".join(lines).split()).endswith(
            f"saved: {SAVED}.base.mo, {SAVED}.generated.mo, {SAVED}.merge.txt "
            "urdfsync resolve modelica/Arm/Elbow.mo --keep "
            "--keep leaves your file as it is: first put into it what you want of both; "
            "--take replaces it by the generated one"
        )
    assert (
        seen(found)[2] == "    You edited it, and what it is made from changed too. The changes contradict each other."
    )


def test_why_a_merge_is_not_offered() -> None:
    twice = texts_of(EDITED, EXPORTED)
    assert twice.merge
    refused = Conflict(
        **{name: getattr(twice, name) for name in ("path", "owner", "base", "mine", "generated")},
        merge=type(twice.merge)(None, twice.merge.proposal, ()),
        rejected="the merge declares `x` twice",
    )
    words = "\n".join(seen(result(refused)))
    assert "The changes fit together line by line, but the merge declares `x` twice." in words
    assert "Elbow.merge.txt" in words
    assert "urdfsync resolve modelica/Arm/Elbow.mo --keep" in words
    assert "--merge" not in words


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (
            Kind.UNOWNED,
            "    urdfsync did not write the file that is there. Without a base, nothing tells who changed what.",
        ),
        (
            Kind.CONFLICT,
            "    You edited it, and what it is made from changed too. "
            "What urdfsync wrote last is lost: without it, nothing tells who changed what.",
        ),
    ],
)
def test_no_base(kind: Kind, words: str) -> None:
    lines = seen(result(texts_of(EDITED, EXPORTED, base=None), kind=kind))
    assert lines[2] == words
    assert "    mine       3    Real a = 1; // measured" in lines
    assert "    generated  3    Real a = 1;" in lines
    assert f"    saved: {SAVED}.generated.mo" in lines
    assert "    urdfsync resolve modelica/Arm/Elbow.mo --keep" in lines


def test_a_file_whose_element_has_another_name() -> None:
    moved = texts_of(*OPPOSED, origin="modelica/Arm/Shoulder.mo")
    lines = seen(result(moved))
    assert lines[1] == "  conflict   modelica/Arm/Shoulder.mo  link elbow"
    assert lines[2].endswith(f"Its element has another name now: it is to become {Path(ELBOW)}.")
    assert "    urdfsync resolve modelica/Arm/Shoulder.mo --keep" in lines
    words = "    --keep moves your file as it is: first put into it what you want of both, and its new name; --take"
    assert lines[-1].startswith(words)


def test_what_is_no_text_can_be_kept_or_taken() -> None:
    path = "modelica/Arm/Resources/hand.stl"
    action = Action(path, Kind.CONFLICT, Role.IMPORT, "package://arm/hand.stl", mine="hash")
    found = Result("arm", "Arm", Path("modelica/Arm").absolute(), Path.cwd(), Actions([action]))
    assert seen(found) == [
        "",
        f"  conflict   {path}  package://arm/hand.stl",
        "    You edited it, and what it is made from changed too. It is no text that could be merged.",
        f"    urdfsync resolve {path} --keep",
        "    --keep leaves your file as it is; --take replaces it by the generated one",
    ]


def test_a_class_that_became_a_folder_can_only_be_kept() -> None:
    action = Action(ELBOW, Kind.CONFLICT, Role.MODEL, "link elbow")
    texts = Conflict(ELBOW, "link elbow", BASE, EDITED, EXPORTED, None, rejected="you made a folder of the class")
    found = Result(
        "arm", "Arm", Path("modelica/Arm").absolute(), Path.cwd(), Actions([action]), conflict_texts=(texts,)
    )
    assert seen(found)[2] == "    You edited it, and what it is made from changed too. You made a folder of the class."
    assert seen(found)[-1] == "    --keep leaves your file as it is: first put into it what you want of both"


def test_a_dry_run_has_put_nothing_aside() -> None:
    lines = seen(result(texts_of("1\n" * 99, "2\n" * 99, base="3\n"), dry=True))
    assert not any(".urdfsync" in line for line in lines)
    assert any("more lines; --verbose shows them" in line for line in lines)


@pytest.mark.parametrize(
    ("path", "typed"), [("modelica/My Arm/a'b.mo", "'modelica/My Arm/a'\"'\"'b.mo'"), ("-x/Arm.mo", "./-x/Arm.mo")]
)
def test_commands_can_be_copied(path: str, typed: str) -> None:
    conflict = texts_of(EDITED, EXPORTED, path=path)
    action = Action(path, Kind.CONFLICT, Role.MODEL, "link elbow")
    folder = Path(path).parent.absolute()
    found = Result("arm", "Arm", folder, Path.cwd(), Actions([action]), conflict_texts=(conflict,))
    assert f"    urdfsync resolve {typed} --merge" in seen(found)


def test_commands_name_the_configuration_if_the_user_did() -> None:
    lines = seen(result(texts_of(EDITED, EXPORTED)), config="other dir/urdfsync.toml")
    assert f"    urdfsync resolve {ELBOW} --merge --config 'other dir/urdfsync.toml'" in lines


def test_paths_count_from_the_working_folder(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = result(texts_of(EDITED, EXPORTED))
    (folder / "modelica").mkdir()
    monkeypatch.chdir(folder / "modelica")
    lines = seen(found)
    assert "    urdfsync resolve Arm/Elbow.mo --merge" in lines
    assert any(f"{folder}/{SAVED}.base.mo" in line for line in lines)


# How much of it


def test_long_differences_are_cut() -> None:
    base = "".join(f"{number}\n" for number in range(200))
    found = result(texts_of(base.replace("\n", "!\n"), base, base=base))
    lines = seen(found)
    (cut,) = [line for line in lines if "more line" in line]
    assert cut == f"    … {401 - LINES} more lines; see .urdfsync/conflicts/arm/Elbow.merge.mo"
    assert len(lines) < LINES + 12
    assert len(seen(found, verbose=True)) > 400


def test_contradictions_come_before_all_else_if_there_is_no_room() -> None:
    base = "".join(f"{number}\n\n\n\n\n\n" for number in range(20))
    mine, generated = base.replace("17\n", "mine\n"), base.replace("17\n", "theirs\n")
    for number in range(10):
        mine = mine.replace(f"\n{number}\n", f"\n{number} edited\n")
    lines = seen(result(texts_of(mine, generated, base=base)))
    assert any(line.endswith("the sides contradict each other") for line in lines)
    assert any("1 edited" in line for line in lines)
    assert not any("9 edited" in line for line in lines)


def test_lines_that_nobody_changed_take_one_row() -> None:
    base = BASE.replace("Real b = 2;", f"Real b[:] = {{{0:0300}}};")
    found = result(texts_of(base.replace("a = 1", "a = 2"), base.replace("a = 1", "a = 3"), base=base))
    for width in (80, 120):
        assert sum("00000" in line for line in seen(found, width)) == 1
        assert all("…" in line for line in seen(found, width) if "00000" in line)


def test_of_many_conflicts_the_first_are_shown_in_full() -> None:
    paths = [f"modelica/Arm/Joint{number}.mo" for number in range(6)]
    found = result(
        *(texts_of(*(OPPOSED if path.endswith("5.mo") else (EDITED, EXPORTED)), path=path) for path in paths)
    )
    lines = seen(found)
    shown = [line for line in lines if line.startswith("    urdfsync resolve")]
    assert shown == [f"    urdfsync resolve {path} --merge" for path in paths[:FULL]]
    short = "  the changes fit together: --merge takes both"
    assert lines[-6:] == [
        "",
        f"  conflict   {paths[3]}{short}",
        f"  conflict   {paths[4]}{short}",
        f"  conflict   {paths[5]}  the changes contradict each other",
        "",
        "  urdfsync resolve --all --robot arm --merge  merges what can be merged: 5 of 6",
    ]
    assert len([line for line in seen(found, verbose=True) if "resolve modelica" in line]) == len(paths)


def test_quiet_means_a_line_for_each() -> None:
    assert seen(result(texts_of(EDITED, EXPORTED)), quiet=True) == [
        f"  conflict   {Path(ELBOW)}  the changes fit together: --merge takes both",
        "",
        "  urdfsync resolve --all --robot arm --merge  merges it",
    ]


# Text of others


EVIL = "\t\x1b[31m\x07\u202e\x9b2J\r\udcff"


@pytest.mark.parametrize("width", [None, 80, 120])
def test_text_of_files_can_not_command_a_terminal(width: int | None) -> None:
    mine, generated = (BASE.replace("a = 1;", f"a = {value}; // {EVIL} {value}") for value in (1, 2))
    lines = seen(result(texts_of(mine, generated)), width)
    assert all(line.isprintable() for line in lines)
    assert "\\x1b[31m\\x07\\u202e\\x9b2J\\r\\udcff" in "".join("".join(lines).split())


def test_a_very_long_line_is_shown_where_it_changes() -> None:
    numbers = ", ".join(str(number) for number in range(1000, 1400))
    base = f"  Real x[:] = cat(1, {{{numbers}}}, first);\n"
    found = result(texts_of(base.replace("first", "mine"), base.replace("first", "theirs"), base=base))
    for width in (None, 80, 120):
        lines = seen(found, width)
        assert max(len(line) for line in lines if ".urdfsync" not in line) <= (width or 280)
        words = "\n".join(lines)
        assert all(f"{name});" in words for name in ("first", "mine", "theirs"))
        assert "1000" not in words
        assert len(lines) < 30
