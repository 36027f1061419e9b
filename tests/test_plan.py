"""The one decision: every row of the table in words, and what must hold for all texts."""

from __future__ import annotations

from collections.abc import Collection

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.domain import Role
from urdfsync.plan import (
    CONFLICTS,
    Action,
    FileRecord,
    Found,
    Kind,
    State,
    Wanted,
    after,
    decide,
    hold,
    numbers_only,
    plan,
    spare,
)

ABSENT = Found()
FOLDER = Found(as_folder=True)


def on_disk(text: str) -> Found:
    return Found(text)


@pytest.mark.parametrize(
    ("base", "mine", "generated", "kind"),
    [
        pytest.param(None, ABSENT, "new", Kind.CREATE, id="never written"),
        pytest.param("old", ABSENT, "old", Kind.RESTORE, id="deleted by the user"),
        pytest.param("old", ABSENT, "new", Kind.RESTORE, id="deleted by the user, source changed"),
        pytest.param("old", FOLDER, "old", Kind.KEEP, id="made a package by the user"),
        pytest.param("old", FOLDER, "new", Kind.CONFLICT, id="made a package by the user, source changed"),
        pytest.param(None, FOLDER, "new", Kind.UNOWNED, id="a package of the user in the way"),
        pytest.param("old", FOLDER, None, Kind.ORPHAN, id="made a package by the user, no longer generated"),
        pytest.param("same", on_disk("same"), "same", Kind.UNCHANGED, id="nothing to do"),
        pytest.param("old", on_disk("new"), "new", Kind.ADOPT, id="already right"),
        pytest.param(None, on_disk("new"), "new", Kind.ADOPT, id="already right, state lost"),
        pytest.param("old", on_disk("old"), "new", Kind.UPDATE, id="source changed"),
        pytest.param("old", on_disk("edited"), "old", Kind.KEEP, id="edited"),
        pytest.param("old", on_disk("edited"), "new", Kind.CONFLICT, id="edited, source changed"),
        pytest.param(None, on_disk("foreign"), "new", Kind.UNOWNED, id="a file of the user in the way"),
        pytest.param("old", on_disk("old"), None, Kind.DELETE, id="no longer generated"),
        pytest.param("old", on_disk("edited"), None, Kind.ORPHAN, id="edited, no longer generated"),
        pytest.param("old", ABSENT, None, Kind.FORGET, id="no longer generated, deleted"),
        pytest.param(None, on_disk("foreign"), None, Kind.FORGET, id="in the way of what is no longer generated"),
    ],
)
def test_decision_table(base: str | None, mine: Found, generated: str | None, kind: Kind) -> None:
    assert decide(base, mine, generated) is kind


hashes = st.sampled_from("abc")
found = st.one_of(st.just(ABSENT), st.just(FOLDER), hashes.map(on_disk))


@given(base=st.none() | hashes, mine=found, generated=st.none() | hashes)
def test_nothing_of_the_user_is_ever_written_over(base: str | None, mine: Found, generated: str | None) -> None:
    kind = decide(base, mine, generated)
    if kind in (Kind.UPDATE, Kind.DELETE):
        assert mine.hash == base
    if kind in (Kind.CREATE, Kind.RESTORE):
        assert mine == ABSENT


@given(base=st.none() | hashes, mine=found, generated=st.none() | hashes)
def test_after_an_action_the_next_build_has_nothing_to_do(base: str | None, mine: Found, generated: str | None) -> None:
    action = Action("a", decide(base, mine, generated), Role.MODEL, "", base, generated)
    record = after([action]).get("a")
    written = {Kind.DELETE: ABSENT}.get(action.kind, Found(generated)) if action.writes else mine
    second = decide(record.base if record else None, written, generated)
    quiet = {Kind.UNCHANGED, Kind.KEEP, Kind.ORPHAN, Kind.FORGET}
    assert second in (CONFLICTS if action.kind in CONFLICTS else quiet)


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        (Kind.RESTORE, "it was deleted; written again"),
        (Kind.KEEP, "you edited it; there is nothing new for it"),
        (Kind.CONFLICT, "you edited it, and what it is made from changed too"),
        (Kind.UNOWNED, "urdfsync did not write the file that is there"),
        (Kind.ORPHAN, "no longer generated, but you edited it; kept"),
    ],
)
def test_reasons(kind: Kind, reason: str) -> None:
    assert Action("a", kind, Role.MODEL).reason == reason


def test_every_kind_has_a_reason_of_its_own() -> None:
    assert len({Action("a", kind, Role.MODEL).reason for kind in Kind}) == len(Kind)


def test_plan_covers_wanted_and_recorded_files() -> None:
    recorded = {"gone": FileRecord("link a", Role.MODEL, "g"), "stays": FileRecord("link b", Role.RECORD, "s")}
    wanted = {"stays": Wanted(Role.RECORD, "link b", "s2"), "new": Wanted(Role.MODEL, "link c", "n")}
    actions = plan(recorded, wanted, {"gone": Found("g"), "stays": Found("s")})
    assert [(action.path, action.kind, action.owner) for action in actions] == [
        ("gone", Kind.DELETE, "link a"),
        ("new", Kind.CREATE, "link c"),
        ("stays", Kind.UPDATE, "link b"),
    ]


def spared(*actions: Action, classes: tuple[str, ...] = ()) -> dict[str, Kind]:
    """What happens to each file, where the folders hold these classes."""

    def stays(path: str, gone: Collection[str]) -> bool:
        folder = path.removesuffix("package.mo")
        return any(name.startswith(folder) and name != path and name not in gone for name in classes)

    return {action.path: action.kind for action in spare(actions, stays)}


def test_an_edited_model_keeps_its_record() -> None:
    model = Action("Links/Hand.mo", Kind.ORPHAN, Role.MODEL, "link hand", "old")
    record = Action("Links/HandParameters.mo", Kind.DELETE, Role.RECORD, "link hand", "old")
    other = Action("Links/ArmParameters.mo", Kind.DELETE, Role.RECORD, "link arm", "old")
    assert spared(model, record, other) == {
        "Links/Hand.mo": Kind.ORPHAN,
        "Links/HandParameters.mo": Kind.NEEDED,
        "Links/ArmParameters.mo": Kind.DELETE,
    }
    gone = Action("Links/Hand.mo", Kind.FORGET, Role.MODEL, "link hand", "old")
    assert spared(gone, record)["Links/HandParameters.mo"] is Kind.DELETE


def test_a_package_stays_as_long_as_there_are_classes_in_it() -> None:
    files = ("Old/package.mo", "Old/Links/package.mo", "Old/Links/Hand.mo")
    roles = (Role.PACKAGE, Role.PACKAGE, Role.MODEL)
    actions = [Action(path, Kind.DELETE, role, "robot", "old") for path, role in zip(files, roles, strict=True)]
    assert set(spared(*actions, classes=files).values()) == {Kind.DELETE}
    assert spared(*actions, classes=(*files, "Old/Links/Mine.mo")) == {
        "Old/package.mo": Kind.NEEDED,
        "Old/Links/package.mo": Kind.NEEDED,
        "Old/Links/Hand.mo": Kind.DELETE,
    }


def test_what_is_needed_is_remembered_with_its_base() -> None:
    needed = Action("a", Kind.NEEDED, Role.RECORD, "link hand", "old")
    assert after([needed]) == {"a": FileRecord("link hand", Role.RECORD, "old", State.ORPHAN)}


CONFLICT = Action("Arm.mo", Kind.CONFLICT, Role.MODEL, "robot", "old", "new")


@pytest.mark.parametrize(
    ("action", "held"),
    [
        (Action("a", Kind.CREATE, Role.MODEL, "", None, "new"), True),
        (Action("a", Kind.CREATE, Role.RECORD, "", None, "new"), True),
        (Action("a", Kind.UPDATE, Role.MODEL, "", "old", "new"), True),
        (Action("a", Kind.UPDATE, Role.PACKAGE, "", "old", "new"), True),
        (Action("a", Kind.UPDATE, Role.RECORD, "", "old", "new"), True),
        (Action("a", Kind.DELETE, Role.RECORD, "", "old", None), True),
        (Action("a", Kind.DELETE, Role.IMPORT, "", "old", None), True),
        (Action("a", Kind.UPDATE, Role.ORDER), True),
        (Action("a", Kind.RESTORE, Role.ORDER), True),
        (Action("a", Kind.RESTORE, Role.MODEL, "", "old", "new"), True),
        (Action("a", Kind.RESTORE, Role.MODEL, "", "old", "old"), False),
        (Action("numbers", Kind.UPDATE, Role.RECORD, "", "old", "new"), False),
        (Action("numbers", Kind.UPDATE, Role.MODEL, "", "old", "new"), True),
        (Action("a", Kind.CREATE, Role.IMPORT, "", None, "new"), False),
        (Action("a", Kind.UPDATE, Role.IMPORT, "", "old", "new"), False),
        (Action("a", Kind.KEEP, Role.MODEL, "", "old", "old"), False),
        (Action("a", Kind.ADOPT, Role.MODEL, "", "old", "new"), False),
    ],
)
def test_a_conflict_holds_back_what_is_structural(action: Action, held: bool) -> None:
    assert [entry.held for entry in hold([CONFLICT, action], {"numbers"})] == [False, held]
    assert [entry.held for entry in hold([action], set())] == [False], "without a conflict nothing waits"


def test_what_waits_keeps_its_base() -> None:
    waiting = Action("a", Kind.UPDATE, Role.MODEL, "link a", "old", "new", held=True)
    assert after([waiting]) == {"a": FileRecord("link a", Role.MODEL, "old", State.WAITING)}
    assert waiting.reason.endswith("waits until the conflict is settled")


RECORD = """\
record ArmParameters "Robot \\"arm\\" 1"
  parameter Real m = 1.5e-3 "Mass";
  parameter Real r[3] = {0, -0.1, .5};
  parameter Real upper = Modelica.Constants.inf;
end ArmParameters;
"""


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("1.5e-3", "-7", True),
        ("-0.1", "0.25E+4", True),
        ("Modelica.Constants.inf", "-3.2", True),
        ('"Robot \\"arm\\" 1"', '"anything; 2"', True),
        ("{0, -0.1, .5}", "{0, -0.1}", False),
        ("r[3]", "r2[3]", False),
        ("upper", "lower", False),
        ("parameter Real m = 1.5e-3", "parameter Real m", False),
    ],
)
def test_numbers_only(old: str, new: str, same: bool) -> None:
    assert numbers_only(RECORD, RECORD.replace(old, new)) is same


def test_line_endings_are_no_difference() -> None:
    assert numbers_only(RECORD, RECORD.replace("\n", "\r\n"))
