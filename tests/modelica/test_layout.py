"""The file of one class, and files as a package: each fault has its line, its words and a hint."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePosixPath

import pytest

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.modelica.layout import check_class_file, check_order, check_places, with_within

ALONE = "move this class to a file of its own: a file in a package holds one class [second-class]"
ELBOW = "within Arm.Joints;\nmodel Elbow\nend Elbow;\n"
FAULTS = {
    "nothing": (ELBOW.replace("\n", "\r\n"), []),
    "wrong within": (f"// 1\n{ELBOW.replace('Arm.Joints', 'Arm')}", [
        "2: error: the file says `within Arm;`, but stands in `Arm.Joints`; write `within Arm.Joints;` [wrong-within]",
    ]),
    "no within": (ELBOW.partition("\n")[2], [
        "1: error: the file lacks `within Arm.Joints;`; add it as the first line [wrong-within]",
    ]),
    "another name": (ELBOW.replace("Elbow", "Elbw"), [
        "2: error: the class is called `Elbw`, but its file `Elbow`; give class and file the same name [wrong-name]",
    ]),
    "second class": (f"{ELBOW}model Second\nend Second;\n", [
        f"4: error: the file holds `Second` besides `Elbow`; {ALONE}",
    ]),
    "class of this name behind another": (f"{ELBOW.replace('Elbow', 'First')}model Elbow\nend Elbow;\n", [
        f"2: error: the file holds `First` besides `Elbow`; {ALONE}",
    ]),
    "no class": ("within Arm.Joints;\n// nothing\n", [
        "0: error: the file holds no class; write the class `Elbow`, or delete the file [no-class]",
    ]),
    "byte order mark": (f"\ufeff{ELBOW}", [
        "1: warning: the file begins with a byte order mark; save the file without this mark: some compilers refuse it "
        "[byte-order-mark]",
    ]),
    "fault": (ELBOW.replace("\nend", "\n Real;\nend"), ["3: error: the file lacks a name before `;` [syntax]"]),
    "two faults": (ELBOW.replace("\nend", "\n Real;\n Real;\nend"), [
        "3: error: the file lacks a name before `;`; correct this first: other errors in the file may follow from it "
        "[syntax]",
    ]),
    "marker of a conflict": (ELBOW.replace("\nend", "\n Real\n=======\nend"), [
        "4: error: the file has the conflict marker `=======` [syntax]",
    ]),
    "repeated": (ELBOW.replace("\nend", "\n Real x, x;\nequation\n x = 1;\n x = 1;\nend"), [
        "3: error: the file declares `x` twice [syntax]",
        "6: warning: the file has the equation `x = 1` twice [repeated]",
    ]),
}  # fmt: skip


def lines(findings: Iterable[Diagnostic]) -> list[str]:
    """Findings, each behind its line."""
    return [f"{one.line}: {one}" for one in findings]


@pytest.mark.parametrize(("text", "expected"), FAULTS.values(), ids=FAULTS)
def test_the_file_of_a_class(text: str, expected: list[str]) -> None:
    stored, found = check_class_file(text, PurePosixPath("Elbow.mo"), "Arm.Joints.Elbow")
    assert lines(found) == expected
    assert (stored is None) == any("lacks a name" in one or "marker" in one for one in expected)


def test_a_package_is_called_like_its_folder_and_one_at_the_top_is_in_none() -> None:
    path = PurePosixPath("package.mo")
    for text in ("within;\npackage Arm\nend Arm;\n", "package Arm\nend Arm;\n"):
        assert check_class_file(text, path, "Arm")[1] == []
    (found,) = check_class_file("package Arm\nend Arm;\n", path, "SixAxisArm")[1]
    words = "the class is called `Arm`, but its folder `SixAxisArm`; give class and folder the same name"
    assert lines([found]) == [f"1: error: {words} [wrong-name]"]


@pytest.mark.parametrize(("text", "name", "expected"), [
    ("within A.B; // 1\nmodel C", "D.C", "within D; // 1\nmodel C"),
    ("// 1\nwithin\n A;model C", "C", "// 1\nwithin;model C"),
    ("within;\nmodel C", "D.E.C", "within D.E;\nmodel C"),
    ("model C end C;", "D.C", "model C end C;"),
    ("within A", "D.C", "within A"),
])  # fmt: skip
def test_the_within_clause_follows_the_class(text: str, name: str, expected: str) -> None:
    assert with_within(text, name) == expected


def test_a_class_has_one_place() -> None:
    paths = ["Joints/package.mo", "Joints/Elbow.mo", "Joints.mo", "package.mo", "package.order"]
    declared = {"Joints/package.mo": {"Elbow": 3, "Other": 5}, "package.mo": {"Other": 2}}
    hint = "put the whole class into one file, and delete the other file [class-twice]"
    assert [(path, *lines([one])) for path, one in check_places(paths, declared)] == [
        ("Joints.mo", f"0: error: `Joints` has two files, this one and Joints/package.mo; {hint}"),
        ("Joints/package.mo", f"3: error: `Elbow` is declared here, and also has the file Joints/Elbow.mo; {hint}"),
    ]


def test_the_order_names_what_is_there_once() -> None:
    text = "\ufeffElbow\n pi \r\n\nElbow\nTuret\nWheel\n"
    found = lines(check_order(text, {"Elbow", "Turret"}, {"pi", "e"}))
    unknown = "is named, but the package has no such class or constant"
    assert found == [
        "0: warning: `Turret` is not named; add a line for this class: without a line, tools list "
        "the class last, or warn [order-lacks]",
        "4: warning: `Elbow` is named twice, first in line 1; delete one of the lines [order-twice]",
        f"5: error: `Turet` {unknown}; did you mean `Turret`? [order-unknown]",
        f"6: error: `Wheel` {unknown}; delete the line, or restore the class [order-unknown]",
    ]
    assert lines(check_order(text, {"Elbow", "Turret"}, None)) == found[:2]
