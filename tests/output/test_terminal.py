"""The changes of a model on a terminal, line by line."""

from __future__ import annotations

from typing import Any

from urdfsync.domain import ChangeClass, ChangeKind
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Changes
from urdfsync.output.build_section import change_parts
from urdfsync.output.sections import Mark, Section
from urdfsync.output.terminal import details

STRUCTURAL = ChangeClass.STRUCTURAL


def change(path: str, old: Any, new: Any, kind: ChangeKind, reach: ChangeClass = ChangeClass.PARAMETER) -> Change:
    return Change(tuple(path.split(" / ")), kind, reach, old, new)


def test_a_change_is_one_line_of_a_build() -> None:
    found = Changes(
        (
            change("link a", "a", "b: c", ChangeKind.RENAMED, STRUCTURAL),
            change("link a / visual 1", None, {"name": "x"}, ChangeKind.ADDED),
            change("robot / gazebo", "x", "y", ChangeKind.CHANGED, ChangeClass.UNMODELLED),
            change("joint a / limit / effort", 54.0, 60.0, ChangeKind.CHANGED),
        )
    )
    points, tables = change_parts(found)
    assert [str(line).strip() for line in details(Section("arm", "", Mark.NONE, points, tables))] == [
        "~3 (1 structural and 2 parameter and 1 unmodelled change)",
        "link a: renamed to b: c",
        "link a: visual 1 added: name x",
        "robot: not modelled 1 change",
        "joint a: limit / effort 54 → 60 (+11.1 %)",
    ]
