"""A build in one line: what changed, and what was written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from urdfsync.diff.changes import Change, Changes
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Event
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.outcome import Result
from urdfsync.watch.summary import build_summary

MASS = ("link elbow", "inertial", "mass")


def change(path: tuple[str, ...], old: Any, new: Any, unit: str = "", kind: Event = Event.CHANGED) -> Change:
    return Change(path, kind, ChangeClass.PARAMETER, old, new, unit)


def action(kind: Kind, name: str = "Elbow", role: Role = Role.RECORD, **more: Any) -> Action:
    return Action(f"modelica/Arm/Links/{name}.mo", kind, role, **more)


def said(changes: list[Change] | Changes | None, *actions: Action, known: bool = False) -> str:
    found = Changes(tuple(changes)) if isinstance(changes, list) else changes
    return build_summary(Result("arm", "Arm", Path("Arm"), Path(), Actions(actions), changes=found), known=known)


WRITTEN = action(Kind.UPDATE)


def test_one_number() -> None:
    heavier = change(MASS, 1.2, 1.35, "kg")
    assert said([heavier], WRITTEN) == "link elbow: mass 1.2 → 1.35 kg (+12.5 %), 1 record written"


def test_the_group_of_a_number_is_named_where_it_tells_it_from_others() -> None:
    moved = change(("link elbow", "visual 1", "origin", "xyz[2]"), 0.0, 0.1, "m")
    assert said([moved], WRITTEN) == "link elbow: visual 1 origin xyz[2] 0 → 0.1 m, 1 record written"
    moved = change(("joint hold", "origin", "xyz[2]"), 0.0, 0.1, "m")
    assert said([moved], WRITTEN) == "joint hold: origin xyz[2] 0 → 0.1 m, 1 record written"
    follows = change(("joint a", "mimic", "joint"), "b", "c")
    assert said([follows], WRITTEN) == "joint a: mimic joint b → c, 1 record written"


def test_two_rows_find_room() -> None:
    both = [change(MASS, 1, 2, "kg"), change(("joint elbow", "limit", "effort"), 54, 60, "N·m")]
    assert said(both, WRITTEN) == (
        "link elbow: mass 1 → 2 kg (+100 %); joint elbow: effort 54 → 60 N·m (+11.1 %), 1 record written"
    )
    vector = [change(("link elbow", "inertial", "origin", f"xyz[{index}]"), 1.0, 2.0, "m") for index in range(3)]
    assert said(vector, WRITTEN) == (
        "link elbow: inertial origin xyz[0, 1, 2] (1, 1, 1) → (2, 2, 2) m, 1 record written"
    )


def test_many_changes_are_counted() -> None:
    many = [change((f"link {name}", "inertial", "mass"), 1, 2 + ord(name), "kg") for name in "abc"]
    many += [change(("link a", "inertial", "inertia", name), 1, 2, "kg·m²") for name in ("ixx", "iyy")]
    files = [action(Kind.UPDATE, name) for name in "ABCD"]
    assert said(many, *files) == "5 changes in 3 elements, 4 records written"


def test_elements_that_come_and_go_and_renames_are_named() -> None:
    found = [
        change(("link tool",), "tool", "gripper", kind=Event.RENAMED),
        change(("joint wrist",), None, {"type": "fixed"}, kind=Event.ADDED),
        *(change((f"link {name}", "inertial", "mass"), 1, 2 + ord(name), "kg") for name in "ab"),
    ]
    files = [action(Kind.CREATE, "Gripper", Role.MODEL), action(Kind.UPDATE), action(Kind.DELETE, "Tool", Role.MODEL)]
    assert said(found, *files) == (
        "link tool renamed to gripper, joint wrist added, 2 more changes in 2 elements, 2 files written, 1 deleted"
    )
    assert said(found[:1], *files) == "link tool renamed to gripper, 2 files written, 1 deleted"


def test_too_many_names_are_counted_as_well() -> None:
    found = [change((f"link {name}",), None, {"x": name}, kind=Event.ADDED) for name in "abcdefgh"]
    found += [change((f"link {name}",), name, name * 2, kind=Event.RENAMED) for name in "xyz"]
    assert said(found, WRITTEN) == "11 changes in 11 elements, 1 record written"
    found = [change((f"link {name * 60}",), None, None, kind=Event.ADDED) for name in "abc"]
    assert said(found, WRITTEN) == "3 changes in 3 elements, 1 record written"


def test_edits_that_moved_merged_or_had_to_be_restored_are_named() -> None:
    moved = action(Kind.MOVE, "Wrist", origin="modelica/Arm/Links/Elbow.mo")
    assert said(None, moved) == "your edits moved from Elbow.mo to Wrist.mo"
    assert said(None, action(Kind.MERGE), action(Kind.RESTORE, "Base")) == (
        "Base.mo restored because you deleted it, Elbow.mo merged with your edits"
    )
    assert said(None, *(action(Kind.MERGE, name) for name in "ABCD")) == "4 merged with your edits"


def test_nothing_is_said_of_files_that_stay() -> None:
    kept = [action(Kind.KEEP), action(Kind.UNCHANGED), action(Kind.ORPHAN), action(Kind.NEEDED)]
    assert said(None, *kept) == ""
    foreign = Changes((Change(("link a", "gazebo"), Event.ADDED, ChangeClass.UNMODELLED, None, "<x/>"),))
    assert said(foreign, *kept) == "link a: gazebo added (not modelled), nothing to write"


def test_templates_that_changed_are_all_there_is_to_say() -> None:
    found = Changes((change(MASS, 1, 2),), generator=True)
    assert said(found, action(Kind.UPDATE, role=Role.MODEL)) == (
        "a template, an option or urdfsync itself changed, 1 model written"
    )


def test_conflicts_are_counted_with_what_waits() -> None:
    files = [WRITTEN, action(Kind.CONFLICT), action(Kind.UPDATE, "Base", held=True)]
    assert said(None, *files) == "1 record written, 1 conflict, 1 change waiting for that"
    assert said(None, *files[1:], known=True) == "1 conflict as before, 1 change waiting for that"
