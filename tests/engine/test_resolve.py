"""What becomes of files that both sides changed: every kind with every choice, and what never happens."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.conflicts import Conflict, find_conflict, resolve
from urdfsync.merge import merge
from urdfsync.state.record import Choice

BASE = "model Arm\n\n  Real m = 1;\n\nend Arm;\n"
MINE = BASE.replace("end", "  // a sensor here\n\nend")
NEW = BASE.replace("= 1", "= 2")
BOTH = MINE.replace("= 1", "= 2")
AGAINST = BASE.replace("= 1", "= 7")

CONFLICT = Action("Arm.mo", Kind.CONFLICT, Role.MODEL, "link arm", "base", "new", mine="mine")
MOVE = Action("Hand.mo", Kind.MOVE, Role.MODEL, "link hand", "base", "new", origin="Arm.mo", mine="mine")
ORPHAN = Action("Arm.mo", Kind.ORPHAN, Role.MODEL, "link arm", "base", mine="mine")


def settled(
    action: Action, standoff: Conflict | None = None, choice: Choice | None = None, merging: bool = False
) -> tuple[Action, str | None]:
    standoffs = {action.path: standoff} if standoff else {}
    (result,), texts = resolve([action], standoffs, {action.path: choice} if choice else {}, merging)
    return result, texts.get(action.path)


def texts(action: Action, mine: str, generated: str = NEW, base: str | None = BASE) -> Conflict:
    return find_conflict(action, base, mine, generated)


@pytest.mark.parametrize(
    ("mine", "choice", "merging", "kind", "text"),
    [
        pytest.param(MINE, None, False, Kind.CONFLICT, None, id="nobody said anything"),
        pytest.param(MINE, None, True, Kind.MERGE, BOTH, id="merges are welcome"),
        pytest.param(MINE, Choice.MERGE, False, Kind.MERGE, BOTH, id="merge this one"),
        pytest.param(MINE, Choice.TAKE, True, Kind.UPDATE, None, id="take this one"),
        pytest.param(MINE, Choice.KEEP, True, Kind.KEEP, None, id="keep this one"),
        pytest.param(AGAINST, None, True, Kind.CONFLICT, None, id="contradiction, merges are welcome"),
        pytest.param(AGAINST, Choice.MERGE, False, Kind.CONFLICT, None, id="contradiction, merge this one"),
        pytest.param(AGAINST, Choice.TAKE, False, Kind.UPDATE, None, id="contradiction, take this one"),
        pytest.param(AGAINST, Choice.KEEP, False, Kind.KEEP, None, id="contradiction, keep this one"),
        pytest.param(BOTH, None, False, Kind.INCLUDED, None, id="already has what is new"),
        pytest.param(BOTH, Choice.TAKE, False, Kind.INCLUDED, None, id="already has what is new, take it"),
    ],
)
def test_a_conflict(mine: str, choice: Choice | None, merging: bool, kind: Kind, text: str | None) -> None:
    result = settled(CONFLICT, texts(CONFLICT, mine), choice, merging)
    assert (result[0].kind, result[1]) == (kind, text)


@pytest.mark.parametrize("choice", [None, Choice.MERGE])
@pytest.mark.parametrize("kind", [Kind.CONFLICT, Kind.UNOWNED])
def test_without_a_base_nothing_is_merged(kind: Kind, choice: Choice | None) -> None:
    action = Action("Arm.mo", kind, Role.MODEL, "link arm", None, "new", mine="mine")
    standoff = texts(action, MINE, base=None)
    assert standoff.merge is None
    assert settled(action, standoff, choice, merging=True)[0].kind is kind


@pytest.mark.parametrize(
    ("mine", "choice", "kind", "text"),
    [
        pytest.param(MINE, None, Kind.MOVE, BOTH, id="merges"),
        pytest.param(MINE, Choice.MERGE, Kind.MOVE, BOTH, id="merges by name"),
        pytest.param(MINE, Choice.KEEP, Kind.MOVE, MINE, id="goes as it is"),
        pytest.param(MINE, Choice.TAKE, Kind.MOVE, None, id="gives way"),
        pytest.param(AGAINST, None, Kind.CONFLICT, None, id="contradicts"),
        pytest.param(AGAINST, Choice.MERGE, Kind.CONFLICT, None, id="contradicts, merge it"),
        pytest.param(AGAINST, Choice.KEEP, Kind.MOVE, AGAINST, id="contradicts, goes as it is"),
        pytest.param(AGAINST, Choice.TAKE, Kind.MOVE, None, id="contradicts, gives way"),
        pytest.param(BOTH, None, Kind.MOVE, BOTH, id="already has what is new"),
    ],
)
def test_a_file_that_goes_with_its_element(mine: str, choice: Choice | None, kind: Kind, text: str | None) -> None:
    result = settled(MOVE, texts(MOVE, mine), choice)
    assert (result[0].kind, result[1]) == (kind, text)
    assert (result[0].origin, result[0].choice) == ("Arm.mo", choice)


@pytest.mark.parametrize(
    ("choice", "kind"),
    [(None, Kind.ORPHAN), (Choice.MERGE, Kind.ORPHAN), (Choice.KEEP, Kind.FORGET), (Choice.TAKE, Kind.DELETE)],
)
def test_an_orphan(choice: Choice | None, kind: Kind) -> None:
    assert settled(ORPHAN, None, choice, merging=True)[0].kind is kind


@pytest.mark.parametrize("choice", [None, *Choice])
@pytest.mark.parametrize(
    "kind", sorted(set(Kind) - {Kind.CONFLICT, Kind.UNOWNED, Kind.MOVE, Kind.ORPHAN}), ids=lambda kind: kind.value
)
def test_a_choice_is_for_nothing_else(kind: Kind, choice: Choice | None) -> None:
    action = Action("Arm.mo", kind, Role.MODEL, "link arm", "base", "new", mine="mine")
    assert settled(action, texts(action, MINE), choice, merging=True) == (action, None)


def test_a_merge_that_is_no_model_is_rejected_with_the_reason() -> None:
    mine = BASE.replace("\n\nend", "\n\n  Real q;\n\nend")
    generated = BASE.replace("\n\n  Real m", "\n\n  Real q;\n\n  Real m")
    assert merge(BASE, mine, generated).text is not None
    standoff = texts(CONFLICT, mine, generated)
    assert standoff.merge is not None
    assert standoff.merge.text is None
    assert "q" in standoff.rejected
    assert settled(CONFLICT, standoff, Choice.MERGE)[0].kind is Kind.CONFLICT


LINES = st.lists(st.sampled_from(["a\n", "b\n", "c = 1\n", "c = 2\n"]), max_size=6).map("".join)


@given(
    base=st.none() | LINES,
    mine=LINES,
    generated=LINES,
    kind=st.sampled_from([Kind.CONFLICT, Kind.UNOWNED, Kind.MOVE]),
    choice=st.none() | st.sampled_from(Choice),
    merging=st.booleans(),
)
def test_no_text_of_the_users_gives_way_unless_he_says_so(
    base: str | None, mine: str, generated: str, kind: Kind, choice: Choice | None, merging: bool
) -> None:
    origin = "old.txt" if kind is Kind.MOVE else None
    action = Action("a.txt", kind, Role.MODEL, "robot", base, generated, origin, mine=mine)
    standoff = find_conflict(action, base, mine, generated)
    result, text = settled(action, standoff, choice, merging)
    merged = standoff.merge.text if standoff.merge else None
    if result.kind is Kind.UPDATE or (result.kind is Kind.MOVE and text is None):
        assert choice is Choice.TAKE
    elif result.kind in (Kind.MERGE, Kind.MOVE):
        assert text == (mine if choice is Choice.KEEP else merged)
    else:
        assert text is None
        assert not result.writes
