"""How conflicts look on wide and narrow terminals and in pipes, and what is proposed to settle them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.result import Result, SavedVersions
from urdfsync.merge import Merge, merge
from urdfsync.output.conflicts import FULL, LINES, conflict_lines
from urdfsync.output.console import Console

pytestmark = pytest.mark.usefixtures("folder")

ELBOW = "modelica/Arm/Elbow.mo"
IN_FOLDER = "modelica/Arm/Elbow/package.mo"
BASE = "within Arm;\nmodel Elbow\n  Real a = 1;\n\n  Real b = 2;\nend Elbow;\n"
EDITED = BASE.replace("a = 1;", "a = 1; // measured")
EXPORTED = BASE.replace("b = 2;", "b = 3;")
FOLDER = "you turned the class into a folder"
CHANGED = "You edited it, and its generated text changed too."
OPPOSED = BASE.replace("a = 1;", "a = 7;"), BASE.replace("a = 1;", "a = 9;")


def texts_of(mine: str, generated: str, base: str | None = BASE, path: str = ELBOW, **more: Any) -> Conflict:
    merged = None if base is None else merge(base, mine, generated)
    return Conflict(path, base, mine, generated, merged, **more)


def rejected(proposal: str | None, why: str) -> Conflict:
    """A conflict whose merge, if there is one, is not offered."""
    merged = None if proposal is None else Merge(None, proposal, ())
    return Conflict(ELBOW, BASE, EDITED, EXPORTED, merged, rejected=why)


def seen(*found: Conflict, kind: Reason = Reason.CONFLICT, dry: bool = False, **options: Any) -> list[str]:
    """What a build says of these conflicts, as it appears on a terminal of this width, or in a pipe."""
    actions = Actions(
        Action(
            one.path, kind, Role.MODEL, "link elbow", origin=one.origin, mine=None if one.rejected == FOLDER else "hash"
        )
        for one in found
    )
    return seen_of(actions, found, dry, **options)


def files_of(conflict: Conflict) -> dict[str, str]:
    """Where a build saves the versions."""
    name, merge = Path(conflict.path).name.removesuffix(".mo"), conflict.merge
    base = {} if conflict.base is None else {"base": f"{name}.base.mo"}
    merged = {} if merge is None else {"merge": f"{name}.merge{'.txt' if merge.text is None else '.mo'}"}
    return base | {"generated": f"{name}.generated.mo"} | merged


def seen_of(actions: Actions, texts: tuple[Conflict, ...] = (), dry: bool = False, **options: Any) -> list[str]:
    package = Path(actions[0].path).parent.absolute()
    saved = {one.path: SavedVersions(files_of(one)) for one in texts}
    place: dict[str, Any] = {"robot": "arm", "package": "Arm", "folder": package, "root": Path.cwd()}
    result = Result(**place, actions=actions, dry=dry, conflict_texts=texts, saved=saved)
    return [str(line).rstrip() for line in conflict_lines(result, Console(**options))]


# What happened, and what to do


def test_what_each_side_changed_and_what_to_do() -> None:
    assert seen(texts_of(EDITED, EXPORTED)) == [
        "",
        "  conflict   modelica/Arm/Elbow.mo  link elbow",
        "    You edited it, and its generated text changed too.",
        "    The changes fit together: --merge takes both.",
        "",
        "    you         comments: changed",
        "    the export  component `b`: b 2 → 3",
        "",
        "    saved in .urdfsync/conflicts/arm: Elbow.base.mo, Elbow.generated.mo, Elbow.merge.mo",
        "    urdfsync resolve modelica/Arm/Elbow.mo --merge",
        "      --merge  both sides' changes",
        "      --edit   both sides in your editor, between markers",
        "      --keep   your file as it is",
        "      --take   the generated file",
    ]


def test_verbose_shows_what_a_merge_changes() -> None:
    assert seen(texts_of(EDITED, EXPORTED), verbose=True)[5:14] == [
        "    --- mine",
        "    +++ merge",
        "    @@ -3,4 +3,4 @@",
        "       Real a = 1; // measured",
        "",
        "    -  Real b = 2;",
        "    +  Real b = 3;",
        "     end Elbow;",
        "",
    ]


def test_of_many_changes_the_first_are_shown() -> None:
    many = BASE.replace("  Real b", "".join(f"  Real x{number};\n" for number in range(10)) + "  Real b")
    found = Conflict(ELBOW, BASE, many, EXPORTED, merge(BASE, many, EXPORTED, is_modelica=True))
    assert seen(found)[9:12] == [
        "                component `x4`: added",
        "                … 5 more changes",
        "    the export  component `b`: b 2 → 3",
    ]


def test_of_a_contradiction_nothing_else_is_shown() -> None:
    base, mine, generated = (text.replace("  Real b", "\n\n\n\n  Real b") for text in (BASE, *OPPOSED))
    generated = generated.replace("b = 2", "b = 3")
    found = Conflict(ELBOW, base, mine, generated, merge(base, mine, generated, is_modelica=True))
    lines = seen(found)
    assert lines[3].endswith("Component `a`: you set `a = 7`, the export changes 1 to 9.")
    assert not any("b = 3" in line for line in lines)


def test_of_a_contradiction_only_its_lines_and_those_around_it_are_shown() -> None:
    base, mine, generated = (text.replace("b = 2;", "b = 2;\n  Real c = 3;") for text in (BASE, *OPPOSED))
    generated = generated.replace("b = 2", "b = 3").replace("c = 3", "c = 4")
    found = Conflict(ELBOW, base, mine, generated, merge(base, mine, generated, is_modelica=True))
    assert seen(found)[7:19] == [
        "    @@ -1,5 +1,11 @@",
        "     within Arm;",
        "     model Elbow",
        "    +<<<<<<< mine",
        "       Real a = 7;",
        "    +||||||| base",
        "    +  Real a = 1;",
        "    +=======",
        "    +  Real a = 9;",
        "    +>>>>>>> generated",
        "",
        "       Real b = 3;",
    ]


def test_between_two_contradictions_there_is_a_gap() -> None:
    between = "".join(f"  Real x{number};\n" for number in range(9))
    base, mine, generated = (text.replace("  Real b = 2", f"{between}  Real b = 2") for text in (BASE, *OPPOSED))
    mine, generated = mine.replace("b = 2", "b = 7"), generated.replace("b = 2", "b = 9")
    found = Conflict(ELBOW, base, mine, generated, merge(base, mine, generated, is_modelica=True))
    lines = seen(found, verbose=True)
    gap = lines.index("       Real x0;") + 1
    assert lines[gap].startswith("    @@ -")
    assert lines[gap + 1] == "       Real x7;"


NEW_NAME = texts_of(*OPPOSED, origin="modelica/Arm/Shoulder.mo")
SHOULDER = "urdfsync resolve modelica/Arm/Shoulder.mo --merge --prefer mine"


@pytest.mark.parametrize(
    ("found", "kind", "reason", "after"),
    [
        (
            *(rejected(merge(BASE, EDITED, EXPORTED).proposal, "the merge declares `x` twice"), Reason.CONFLICT),
            f"{CHANGED} --merge would not be right: the merge declares `x` twice.",
            f"Elbow.merge.txt urdfsync resolve {ELBOW} --edit --edit both sides in your editor, between markers",
        ),
        (
            *(texts_of(EDITED, EXPORTED, base=None), Reason.UNOWNED),
            "This file exists, and urdfsync did not write it. There is no base, so it can't be merged.",
            f"arm: Elbow.generated.mo urdfsync resolve {ELBOW} --keep --keep your file as it is --edit both",
        ),
        (
            *(texts_of(EDITED, EXPORTED, base=None), Reason.CONFLICT),
            f"{CHANGED} Its merge base, the text that urdfsync wrote last, is not recorded, so it can't be merged.",
            "- Real a = 1; // measured + Real a = 1; - Real b = 2; + Real b = 3;",
        ),
        (
            *(NEW_NAME, Reason.CONFLICT),
            f"It will be moved to {ELBOW}.",
            f"{SHOULDER} --merge --prefer mine both sides' changes; yours (or `generated`) where they contradict",
        ),
        (
            *(rejected(None, FOLDER), Reason.CONFLICT),
            f"{CHANGED} You turned the class into a folder.",
            f"urdfsync resolve {IN_FOLDER} --keep --keep your file as it is",
        ),
    ],
    ids=["no model", "a file of the user's", "a lost base", "another name", "a folder"],
)
def test_why_a_merge_is_not_offered(found: Conflict, kind: Reason, reason: str, after: str) -> None:
    lines = seen(found, kind=kind)
    file = IN_FOLDER if found.rejected == FOLDER else found.origin or ELBOW
    assert lines[1] == f"  conflict   {file}  link elbow"
    words = " ".join(" ".join(lines).split())
    assert reason in words
    assert after in words
    assert "--merge both sides" not in words
    assert ("--take" in words) is (found.rejected != FOLDER)


def test_what_is_no_text_can_be_kept_or_taken() -> None:
    path = "modelica/Arm/Resources/hand.stl"
    action = Action(path, Reason.CONFLICT, Role.IMPORT, "package://arm/hand.stl", mine="hash")
    assert seen_of(Actions([action])) == [
        "",
        f"  conflict   {path}  package://arm/hand.stl",
        f"    {CHANGED}",
        "    It is not a text, so it can't be merged.",
        f"    urdfsync resolve {path} --keep",
        "      --keep  your file as it is",
        "      --take  the generated file",
    ]


@pytest.mark.parametrize(
    ("path", "typed"), [("modelica/My Arm/a'b.mo", "'modelica/My Arm/a'\"'\"'b.mo'"), ("-x/Arm.mo", "./-x/Arm.mo")]
)
def test_commands_can_be_copied(path: str, typed: str) -> None:
    assert f"    urdfsync resolve {typed} --merge" in seen(texts_of(EDITED, EXPORTED, path=path))


# How much of it


def test_long_differences_are_cut() -> None:
    base = "".join(f"{number}\n" for number in range(200))
    found = texts_of(base, base.replace("\n", "!\n"), base=base)
    lines = seen(found)
    (cut,) = [line for line in lines if "more line" in line]
    assert cut == f"    … {403 - LINES} more lines; see .urdfsync/conflicts/arm/Elbow.merge.mo"
    assert len(lines) < LINES + 15
    assert len(seen(found, verbose=True)) > 400


def test_of_many_conflicts_the_first_are_shown_in_full() -> None:
    paths = [f"modelica/Arm/Joint{number}.mo" for number in range(6)]
    found = [texts_of(*(OPPOSED if path.endswith("5.mo") else (EDITED, EXPORTED)), path=path) for path in paths]
    lines = seen(*found)
    shown = [line for line in lines if line.startswith("    urdfsync resolve")]
    assert shown == [f"    urdfsync resolve {path} --merge" for path in paths[:FULL]]
    assert [line.split()[0] for line in lines if line.startswith("      --")] == [
        "--merge",
        "--edit",
        "--keep",
        "--take",
    ]
    short = "  the changes fit together: --merge takes both"
    assert lines[-6:] == [
        "",
        f"  conflict   {paths[3]}{short}",
        f"  conflict   {paths[4]}{short}",
        f"  conflict   {paths[5]}  the changes contradict each other",
        "",
        "  urdfsync resolve arm --merge  merges what can be merged: 5 of 6",
    ]
    assert len([line for line in seen(*found, verbose=True) if "resolve modelica" in line]) == len(paths)


# Text of others


EVIL = "\t\x1b[31m\x07\u202e\x9b2J\r\udcff"


@pytest.mark.parametrize("width", [None, 80, 120])
def test_text_of_files_can_not_command_a_terminal(width: int | None) -> None:
    mine, generated = (BASE.replace("a = 1;", f"a = {value}; // {EVIL} {value}") for value in (1, 2))
    lines = seen(texts_of(mine, generated))
    assert all(line.isprintable() for line in lines)
    assert "\\x1b[31m\\x07\\u202e\\x9b2J\\r\\udcff" in "".join("".join(lines).split())


def test_a_very_long_line_is_cut() -> None:
    numbers = ", ".join(str(number) for number in range(1000, 1400))
    base = f"  Real x[:] = cat(1, first, {{{numbers}}});\n"
    lines = seen(texts_of(base.replace("first", "mine"), base.replace("first", "theirs"), base=base))
    assert max(map(len, lines)) < 250
    assert all(f"cat(1, {name}" in "\n".join(lines) for name in ("first", "mine", "theirs"))


@pytest.mark.parametrize("length", [400, 40])
def test_a_very_long_line_is_cut_where_both_sides_differ(length: int) -> None:
    """Also behind a tab, between markers, and in words."""
    product = " * ".join(f"part{number}" for number in range(length))
    base = f"within Arm;\nmodel Elbow\n\tReal x = {product} * old;\nend Elbow;\n"
    mine, generated = base.replace("old", "mine"), base.replace("old", "new")
    told = "\n".join(seen(Conflict(ELBOW, base, mine, generated, merge(base, mine, generated, is_modelica=True))))
    plain = "\n".join(seen(Conflict(ELBOW, None, mine, generated, None)))
    for name in ("old", "mine", "new"):
        assert f"* {name};" in told
    assert told.count("* mine") > told.count("* mine;"), "in words"
    assert all(f"* {name};" in plain for name in ("mine", "new"))
