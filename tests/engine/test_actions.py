"""Actions: what happens to a file follows from its reason, whether it waits, and the user's word."""

from __future__ import annotations

import msgspec
import pytest

from urdfsync.domain import Role
from urdfsync.engine.actions import CONFLICTS, ORPHANS, Action, Actions, Kind, Reason, sides_hash


def act(reason: Reason, path: str = "a.mo") -> Action:
    return Action(path, reason, Role.MODEL)


@pytest.mark.parametrize("reason", Reason)
def test_what_waits_writes_nothing_and_keeps_its_text(reason: Reason) -> None:
    now, later = act(reason), msgspec.structs.replace(act(reason), is_waiting=True)
    assert now.writes == (reason.kind in (Kind.WRITE, Kind.DELETE))
    assert not later.writes
    assert later.keeps_text
    assert later.is_deletion == now.is_deletion == (reason is Reason.DELETE)
    assert now.is_conflict == (reason in CONFLICTS)


def test_the_users_text_stays_in_what_is_theirs_or_disputed() -> None:
    kept = {reason for reason in Reason if act(reason).keeps_text}
    assert kept == {Reason.KEEP, *ORPHANS, *CONFLICTS, Reason.FORGET, Reason.UNKNOWN}
    assert {Reason.ORPHAN, Reason.NEEDED} == ORPHANS
    assert {Reason.CONFLICT, Reason.MARKERS, Reason.UNOWNED, Reason.ASKED, Reason.RENAMED} == CONFLICTS


def test_what_waits_says_for_what() -> None:
    update = act(Reason.UPDATE)
    assert update.text == "it differs from its generated text"
    waiting = msgspec.structs.replace(update, is_waiting=True)
    assert waiting.text == "it differs from its generated text; waits for the conflicts"


def test_actions_have_the_order_of_their_paths() -> None:
    actions = Actions([act(Reason.UPDATE, "b"), act(Reason.UNCHANGED, "c"), act(Reason.KEEP, "a")])
    assert [action.path for action in actions] == ["a", "b", "c"]
    assert [action.path for action in actions.decided] == ["a", "b"]


def test_sides_differ_if_one_of_both_texts_does() -> None:
    sides = [(mine, generated) for mine in ("a", "b", None) for generated in ("a", "b", None)]
    assert len({sides_hash(*pair) for pair in sides}) == len(sides)
