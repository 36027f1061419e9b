"""The one decision: every row of the table in words, and what must hold for all texts."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason, find_deletions
from urdfsync.engine.decide.conflicts import find_conflict, resolve
from urdfsync.engine.decide.rules import Place, decide, decide_file, file_records_after, put_off
from urdfsync.engine.inspect.package_files import CLASS_FOLDER, ClassFolder


@pytest.mark.parametrize(
    ("base", "mine", "generated", "kind"),
    [
        pytest.param(None, None, "new", Reason.CREATE, id="never written"),
        pytest.param("old", None, "old", Reason.RESTORE, id="deleted by the user"),
        pytest.param("old", None, "new", Reason.RESTORE, id="deleted by the user, source changed"),
        pytest.param("old", CLASS_FOLDER, "old", Reason.KEEP, id="made a package by the user"),
        pytest.param("old", CLASS_FOLDER, "new", Reason.CONFLICT, id="made a package by the user, source changed"),
        pytest.param("folder", CLASS_FOLDER, "new", Reason.CONFLICT, id="the same with a word of a stranger's record"),
        pytest.param(None, CLASS_FOLDER, "new", Reason.UNOWNED, id="a package of the user in the way"),
        pytest.param("old", CLASS_FOLDER, None, Reason.ORPHAN, id="made a package by the user, no longer generated"),
        pytest.param("same", "same", "same", Reason.UNCHANGED, id="nothing to do"),
        pytest.param("old", "new", "new", Reason.UNCHANGED, id="already right"),
        pytest.param(None, "new", "new", Reason.UNCHANGED, id="already right, state lost"),
        pytest.param("old", "old", "new", Reason.UPDATE, id="source changed"),
        pytest.param("old", "edited", "old", Reason.KEEP, id="edited"),
        pytest.param("old", "edited", "new", Reason.CONFLICT, id="edited, source changed"),
        pytest.param(None, "foreign", "new", Reason.UNOWNED, id="a file of the user in the way"),
        pytest.param("old", "old", None, Reason.DELETE, id="no longer generated"),
        pytest.param("old", "edited", None, Reason.ORPHAN, id="edited, no longer generated"),
        pytest.param("old", None, None, Reason.FORGET, id="no longer generated, deleted"),
        pytest.param(None, "foreign", None, Reason.FORGET, id="in the way of what is no longer generated"),
    ],
)
def test_decision_table(base: str | None, mine: str | None, generated: str | None, kind: Reason) -> None:
    assert decide_file(base, mine, generated) is kind


# Files whose element has another name

bases = st.sampled_from("uvw")
hands = st.sampled_from([None, CLASS_FOLDER, *"uvwxy"])
paths = st.sampled_from("abcde")


@st.composite
def situations(draw: st.DrawFn) -> tuple[dict[str, Place], dict[str, str]]:
    """What is recorded, wanted and there, and moves from recorded places to wanted ones."""
    recorded = draw(st.dictionaries(paths, bases))
    wanted = draw(st.dictionaries(paths, st.sampled_from("uvw12")))
    found = draw(st.dictionaries(paths, hands))
    origins = draw(st.permutations(sorted(recorded)))
    pairs = zip(draw(st.permutations(sorted(wanted))), origins, strict=False)
    files = {
        path: Place(Role.MODEL, "", recorded.get(path), found.get(path), wanted.get(path))
        for path in recorded.keys() | wanted.keys()
    }
    return files, {new: old for new, old in pairs if new != old and draw(st.booleans())}


@given(situations())
def test_every_move_leaves_its_old_place_and_nothing_of_the_users_is_lost(
    situation: tuple[dict[str, Place], Mapping[str, str]],
) -> None:
    files, moves = situation
    actions = decide(files, moves)
    kinds = {action.path: action.reason for action in actions}
    assert len(kinds) == len(actions)
    moved = [action.origin for action in actions if action.reason is Reason.MOVE]
    assert len(set(moved)) == len(moved), "no text goes to two places"
    for action in actions:
        if action.reason is Reason.MOVE:
            assert kinds.get(action.origin or "") in (None, Reason.CREATE, Reason.MOVE)
            assert action.mine == files[action.origin or ""].mine != action.base
        mine, base = files[action.path].mine, files[action.path].base
        if action.reason is Reason.DELETE:
            assert mine == base
        if action.writes and mine not in (None, base, action.generated):
            assert action.path in moved
        if isinstance(mine, ClassFolder):
            assert not action.writes
    for path in find_deletions(actions):
        assert path in moved or files[path].mine in (None, files[path].base)


def test_places_that_are_handed_on() -> None:
    """A's edited file goes where B's untouched one is, which goes to a new place."""
    files = {
        "A.mo": Place(Role.MODEL, "part A", "A", "mine"),
        "B.mo": Place(Role.MODEL, "part B", "B", "B", "new B"),
        "C.mo": Place(Role.MODEL, "part C", generated="new C"),
    }
    actions = decide(files, {"B.mo": "A.mo", "C.mo": "B.mo"})
    assert {action.path: (action.reason, action.origin, action.base) for action in actions} == {
        "B.mo": (Reason.MOVE, "A.mo", "A"),
        "C.mo": (Reason.CREATE, "B.mo", "B"),
    }


LINES = st.lists(st.sampled_from(["a\n", "b\n", "c = 1\n", "c = 2\n"]), max_size=6).map("".join)


@given(
    base=st.none() | LINES,
    mine=LINES,
    generated=LINES,
    kind=st.sampled_from([Reason.CONFLICT, Reason.UNOWNED, Reason.MOVE]),
    merging=st.booleans(),
)
def test_no_text_of_the_users_gives_way_but_to_a_merge(
    base: str | None, mine: str, generated: str, kind: Reason, merging: bool
) -> None:
    origin = "old.txt" if kind is Reason.MOVE else None
    action = Action("a.txt", kind, Role.MODEL, "robot", base, generated, origin, mine=mine)
    conflict = find_conflict(action, base, mine, generated)
    (result,), texts = resolve([action], {action.path: conflict}, merging=merging)
    text = texts.get(action.path)
    if result.reason in (Reason.MERGE, Reason.MOVE):
        assert text == conflict.merged(None)
    else:
        assert text is None
        assert not result.writes


WAITING = {
    "Conflict.mo": (Action("Conflict.mo", Reason.CONFLICT, Role.MODEL), False),
    "New.mo": (Action("New.mo", Reason.CREATE, Role.MODEL), True),
    "Number.mo": (Action("Number.mo", Reason.UPDATE, Role.RECORD), False),
    "Follows.mo": (Action("Follows.mo", Reason.UPDATE, Role.RECORD, origin="Old.mo"), True),
    "Structure.mo": (Action("Structure.mo", Reason.UPDATE, Role.RECORD), True),
    "Restored.mo": (Action("Restored.mo", Reason.RESTORE, Role.MODEL, base="old", generated="old"), False),
    "Renewed.mo": (Action("Renewed.mo", Reason.RESTORE, Role.MODEL, base="old", generated="new"), True),
    "package.order": (Action("package.order", Reason.RESTORE, Role.ORDER), True),
    "new.stl": (Action("new.stl", Reason.CREATE, Role.IMPORT), False),
    "old.stl": (Action("old.stl", Reason.DELETE, Role.IMPORT), True),
    "Kept.mo": (Action("Kept.mo", Reason.KEEP, Role.MODEL), False),
}
"""Actions beside a conflict, and whether they wait for it: what the package compiles with does not."""


@pytest.mark.parametrize("moves", [False, True])
def test_what_waits_for_a_conflict(moves: bool) -> None:
    actions = [action for action, _ in WAITING.values()]
    decided = put_off(actions, {"Number.mo", "Follows.mo"}, has_moved=moves)
    waiting = {action.path for action in decided if action.is_waiting}
    assert waiting == {
        path for path, (_, waits) in WAITING.items() if waits or (moves and path not in ("Conflict.mo", "Kept.mo"))
    }


def test_an_edited_file_that_cant_move_blocks_all_that_would_follow_it() -> None:
    """A goes to B, B to C and C to D, where something of the user's is."""
    files = {name: Place(Role.MODEL, "", "base", "edited", "new") for name in "ABC"}
    files["D"] = Place(Role.MODEL, "", mine="mine", generated="new")
    assert all(action.origin is None for action in decide(files, {"B": "A", "C": "B", "D": "C"}))


def test_a_place_that_an_edited_file_leaves_is_free_for_another_one() -> None:
    files = {
        "A.mo": Place(Role.MODEL, "part B", "A", "edited", "other"),
        "B.mo": Place(Role.MODEL, "part A", generated="new"),
    }
    reasons = {action.path: action.reason for action in decide(files, {"B.mo": "A.mo"})}
    assert reasons == {"A.mo": Reason.CREATE, "B.mo": Reason.MOVE}


def test_an_untouched_file_that_moves_takes_no_place_of_the_users() -> None:
    old, new = Place(Role.MODEL, "", "A", "A"), Place(Role.MODEL, mine="mine", generated="new")
    reasons = {action.path: action.reason for action in decide({"Old.mo": old, "New.mo": new}, {"New.mo": "Old.mo"})}
    assert reasons == {"Old.mo": Reason.DELETE, "New.mo": Reason.UNOWNED}


def test_while_something_is_open_files_count_that_are_as_generated() -> None:
    files = {reason.name: reason for reason in (Reason.UNCHANGED, Reason.UPDATE, Reason.KEEP)}
    actions = [Action(path, reason, Role.MODEL, base="old", generated="new") for path, reason in files.items()]
    records = file_records_after(actions, dict.fromkeys(files, "old"), is_complete=False)
    assert [path for path, record in records.items() if record == "new"] == ["UNCHANGED", "UPDATE"]
