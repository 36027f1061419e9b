"""What was found out about a robot, as values: findings are a table, the worst first."""

from __future__ import annotations

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.output.sections import Mark, Section, TextTable, findings_table

ERROR = Diagnostic(Severity.ERROR, "no-link", "there is no link", "arm.urdf", 3, hint="export it again")


def test_findings_have_their_place_and_the_worst_are_first() -> None:
    note = Diagnostic(Severity.NOTE, "texture", "textures become colours")
    assert findings_table([note, ERROR]).rows == [
        ("✗ error", "arm.urdf:3", "there is no link; export it again", "no-link"),
        ("note", "", "textures become colours", "texture"),
    ]


def test_one_line_is_enough_where_there_are_no_details() -> None:
    empty = TextTable("Files", ("File",), [])
    assert not Section("arm", "in step", Mark.FINE, tables=[empty]).has_details
    assert Section("arm", "in step", Mark.FINE, tables=[empty, TextTable("Files", ("File",), [("a",)])]).has_details
    assert Section("arm", "in step", Mark.FINE, verdict=ERROR).has_details
