"""Which conflicts typed paths mean, and which choices are possible."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.commands.resolve import (
    TypedPath,
    check_choices,
    find_targets,
    list_conflicts,
    possible_choices,
    unknown_paths,
)
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import Merge, merge
from urdfsync.outcome import Result
from urdfsync.output.conflicts import Target, saved_texts
from urdfsync.state.record import Choice

ROOT = Path("/project").absolute()
LINK, OTHER, MESH = "modelica/Arm/Links/Elbow.mo", "modelica/Arm/Links/Tip.mo", "modelica/Arm/Resources/tip.stl"
GONE, WAITING, EDITED = "modelica/Arm/Links/Old.mo", "modelica/Arm/Arm.mo", "modelica/Arm/ArmRun.mo"
MOVED, ORIGIN = "modelica/Arm/Links/Wrist.mo", "modelica/Arm/Links/Hand.mo"

CLEAN = merge("a\n\n\nb\n", "A\n\n\nb\n", "a\n\n\nB\n")
CLASH = merge("a\n", "b\n", "c\n")
REJECTED = Merge(None, "a\n", ())


def standoff(path: str, merged: Merge | None = CLEAN, origin: str | None = None, rejected: str = "") -> Conflict:
    base = None if merged is None else "a\n"
    return Conflict(path, "link elbow", base, "mine\n", "generated\n", merged, origin, rejected)


def conflict(path: str, role: Role = Role.MODEL, kind: Kind = Kind.CONFLICT, origin: str | None = None) -> Action:
    return Action(path, kind, role, "link elbow", origin=origin, mine="hash")


def arm(*standoffs: Conflict) -> Result:
    """A robot with conflicts that are texts, one that is a mesh, an orphan, an edited file and one that waits."""
    actions = [conflict(found.path, origin=found.origin) for found in standoffs]
    actions += [conflict(MESH, Role.IMPORT), conflict(GONE, kind=Kind.ORPHAN), conflict(EDITED, kind=Kind.KEEP)]
    actions.append(Action(WAITING, Kind.UPDATE, Role.MODEL, "robot", held=True))
    return Result("arm", "Arm", ROOT / "modelica/Arm", ROOT, Actions(actions), standoffs=standoffs)


ARM = arm(standoff(LINK), standoff(OTHER, CLASH), standoff(MOVED, origin=ORIGIN))
CART = Result(
    "cart",
    "Cart",
    ROOT / "modelica/Cart",
    ROOT,
    Actions([conflict("modelica/Cart/Cart.mo")]),
    standoffs=(standoff("modelica/Cart/Cart.mo"),),
)


def wish(typed: str) -> TypedPath:
    return TypedPath(typed, (Path(ROOT / typed),))


def meant(*typed: str) -> tuple[list[str], list[str]]:
    found, missing = find_targets([ARM, CART], map(wish, typed))
    return [target.action.path for target in found], [wish.typed for wish in missing]


def target(path: str = LINK, merged: Merge | None = CLEAN, kind: Kind = Kind.CONFLICT, rejected: str = "") -> Target:
    action, found = conflict(path, kind=kind), standoff(path, merged, rejected=rejected)
    return Target(
        Result("arm", "Arm", ROOT / "modelica/Arm", ROOT, Actions([action]), standoffs=(found,)), action, found
    )


@pytest.fixture(autouse=True)
def folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.getcwd", lambda: str(ROOT))


# Which files are meant


@pytest.mark.parametrize(
    ("typed", "paths"),
    [
        pytest.param(LINK, [LINK], id="a file"),
        pytest.param("modelica/Arm/Links", [LINK, OTHER, MOVED], id="a folder"),
        pytest.param("modelica/Arm", [LINK, OTHER, MOVED, MESH], id="a package"),
        pytest.param(".", [LINK, OTHER, MOVED, MESH, "modelica/Cart/Cart.mo"], id="everything"),
        pytest.param(MOVED, [MOVED], id="where a moved file is to go"),
        pytest.param(ORIGIN, [MOVED], id="where a moved file is"),
        pytest.param(MESH, [MESH], id="a mesh"),
        pytest.param(GONE, [GONE], id="an orphan by its name"),
    ],
)
def test_a_path_means(typed: str, paths: list[str]) -> None:
    assert meant(typed) == (paths, [])


@pytest.mark.parametrize(
    "typed", ["modelica/Arm/Links/Elbow", "modelica/Ar", EDITED, WAITING, "elsewhere", "../project2"]
)
def test_a_path_means_no_conflict(typed: str) -> None:
    assert meant(typed, LINK) == ([LINK], [typed])


def test_a_file_that_is_named_twice_counts_once() -> None:
    assert meant(LINK, "modelica/Arm/Links", ORIGIN, MOVED) == ([LINK, OTHER, MOVED], [])


def test_what_is_decided_but_waits_can_be_decided_again() -> None:
    held = Action(LINK, Kind.UPDATE, Role.MODEL, choice=Choice.TAKE, held=True)
    moves = Action(MOVED, Kind.MOVE, Role.MODEL, origin=ORIGIN)
    result = Result("arm", "Arm", ROOT / "modelica/Arm", ROOT, Actions([held, moves]))
    for choice in Choice:
        for typed, path in ((LINK, LINK), (ORIGIN, MOVED)):
            found, missing = find_targets([result], [wish(typed)])
            assert (check_choices(found, choice), missing) == ({path: choice}, [])
    assert find_targets([result], [wish("modelica")])[0] == []


def message(results: Sequence[Result], *typed: str) -> str:
    return str(unknown_paths(results, list(map(wish, typed))))


def test_what_is_said_of_paths_that_mean_nothing() -> None:
    listed = f"these are: {LINK}, {OTHER}, {ORIGIN}, {MESH}"
    assert message([ARM], "x") == f"error: `x` is not in conflict; {listed} [no-conflict]"
    assert message([ARM], "x", "y") == f"error: `x` and `y` are not in conflict; {listed} [no-conflict]"
    assert message([], "x") == "error: `x` is not in conflict; nothing is [no-conflict]"
    assert f"`{WAITING}` is not in conflict, it only waits for the conflicts of its robot; these" in message(
        [ARM], WAITING
    )


def test_of_many_conflicts_a_few_are_named() -> None:
    many = arm(*(standoff(f"modelica/Arm/{number}.mo") for number in range(8)))
    assert list_conflicts([many]).endswith("modelica/Arm/4.mo and 4 more")


# What may be done about them


def refusals(choice: Choice, *found: Target) -> list[str]:
    with pytest.raises(UrdfsyncError) as caught:
        check_choices(found, choice)
    return [str(diagnostic) for diagnostic in caught.value.diagnostics]


def test_every_file_that_cant_be_merged_is_named() -> None:
    said = refusals(
        Choice.MERGE,
        target(LINK, None),
        target(OTHER, REJECTED, rejected="the merge declares `x` twice"),
        Target(ARM, conflict(MESH, Role.IMPORT)),
        Target(ARM, conflict(GONE, kind=Kind.ORPHAN)),
    )
    assert [line.partition(": error: ")[0] for line in said] == [LINK, OTHER, MESH, GONE]
    assert (
        "what urdfsync wrote last is lost: without it, nothing tells who changed what; use --keep or --take" in said[0]
    )
    assert "the changes fit together line by line, but the merge declares `x` twice" in said[1]
    assert "it is no text that could be merged; use --keep or --take" in said[2]
    assert "it is no longer generated: there is nothing to merge; --keep makes it yours, --take deletes it" in said[3]


def test_what_the_user_made_a_folder_cant_be_replaced() -> None:
    action = Action(LINK, Kind.CONFLICT, Role.MODEL, "link elbow")
    folder = Target(ARM, action, standoff(LINK, None, rejected="you made a folder of the class"))
    assert refusals(Choice.TAKE, folder) == [
        f"{LINK}: error: it can't be replaced: you made a folder of the class; move it away, then build [no-take]"
    ]
    assert check_choices([folder], Choice.KEEP) == {LINK: Choice.KEEP}
    assert check_choices([Target(ARM, conflict(MESH, Role.IMPORT))], Choice.TAKE) == {MESH: Choice.TAKE}


FOUND = st.builds(target, st.sampled_from([LINK, OTHER, MOVED]), st.sampled_from([CLEAN, CLASH, REJECTED, None]))


@given(st.lists(FOUND), st.sampled_from(Choice))
def test_a_choice_is_refused_if_it_is_impossible_for_any_file(found: list[Target], choice: Choice) -> None:
    possible = possible_choices(found, choice)
    impossible = [target for target in found if not possible_choices([target], choice)]
    assert all(choice is Choice.MERGE and not target.merges for target in impossible)
    if impossible:
        assert len(refusals(choice, *found)) == len(impossible)
    else:
        assert check_choices(found, choice) == possible


# What is put aside


def test_where_the_versions_are() -> None:
    folder = ".urdfsync/conflicts/arm/Links/Elbow"
    assert saved_texts(target()) == (f"{folder}.base.mo", f"{folder}.generated.mo", f"{folder}.merge.mo")
    assert saved_texts(target(merged=None)) == (None, f"{folder}.generated.mo", None)
    for merged in (CLASH, REJECTED):
        marked = saved_texts(target(merged=merged))
        assert marked
        assert marked.merge == f"{folder}.merge.txt"
    assert saved_texts(Target(ARM, conflict(MESH, Role.IMPORT))) is None


def test_a_package_outside_of_the_configurations_folder() -> None:
    path = "../lib/Arm/Arm.mo"
    action, found = conflict(path), standoff(path)
    result = Result("arm", "Arm", ROOT.parent / "lib/Arm", ROOT, Actions([action]), standoffs=(found,))
    aside = saved_texts(Target(result, action, found))
    assert aside
    assert aside.generated == ".urdfsync/conflicts/arm/Arm.generated.mo"
    ((same,), missing) = find_targets([result], [TypedPath("../lib", (ROOT.parent / "lib",))])
    assert (same.action, missing) == (action, [])
