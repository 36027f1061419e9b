"""The layout of a package: each fault has its place and its words, and what is sound gives none."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from support import arm, corpus
from support.arm import ELBOW

from urdfsync.analysis.checks.contents import package_texts
from urdfsync.analysis.checks.package import PackageTexts
from urdfsync.analysis.checks.texts import check_around, check_layout

LIBRARY = corpus.REPOSITORY / "modelica" / "UrdfSync"
WITHIN = f"within {arm.NAME}.Joints;"
ORDER = "Joints/package.order"


def findings(edits: Mapping[str, str | bytes | None]) -> list[str]:
    """All findings, as people read them, without the folder."""
    return [str(one).removeprefix(str(arm.DISK)).removeprefix("/") for one in check_layout(arm.package(edits))]


# --- what is sound ----------------------------------------------------------------------------------------------------


def test_the_library_with_its_examples_is_sound() -> None:
    assert check_layout(PackageTexts("UrdfSync", LIBRARY, package_texts(LIBRARY))) == []


@pytest.mark.parametrize("edits", [
    pytest.param({ELBOW: arm.text().replace("\n", "\r\n")}, id="line ends of Windows"),
    pytest.param({ORDER: None}, id="no package.order"),
    pytest.param({ORDER: arm.text(ORDER).replace("\n", " \r\n\r\n")}, id="blanks in package.order"),
    pytest.param({ELBOW: arm.text() + "// the end\n"}, id="comments"),
])  # fmt: skip
def test_what_the_language_allows_is_no_fault(edits: Mapping[str, str | None]) -> None:
    assert findings(edits) == []


def test_constants_of_a_package_may_be_ordered() -> None:
    package = f"{WITHIN.replace('.Joints', '')}\npackage Joints\n  constant Real pi = 3;\nend Joints;\n"
    assert findings({"Joints/package.mo": package, ORDER: "pi\n" + arm.text(ORDER)}) == []


# --- files ------------------------------------------------------------------------------------------------------------


def test_the_first_place_that_does_not_parse_is_named_in_every_file() -> None:
    shoulder = "Joints/Shoulder.mo"
    edits = {**arm.changed("useAxisFlange = true,", "useAxisFlange = true"), shoulder: "hello world"}
    lacks = "the file lacks `,` or `)` before `n`"
    assert findings(edits) == [
        f"{ELBOW}:{arm.line('n = parameters.axis')}: error: joint elbow: {lacks} [syntax]",
        f"{shoulder}:1: error: the file lacks a class before `hello` [syntax]",
    ]


def test_markers_of_a_conflict_are_the_cause_of_what_does_not_parse() -> None:
    edits = arm.changed("\nequation\n", "\n<<<<<<< mine\nequation\n=======\nequation\n>>>>>>> theirs\n")
    (found,) = findings(edits)
    place = f"{ELBOW}:{arm.line('equation')}"
    assert found.startswith(
        f"{place}: error: joint elbow: the file has the conflict marker `<<<<<<<`; correct this first"
    )


def test_what_is_declared_twice_is_an_error_and_what_is_connected_twice_a_warning() -> None:
    twice = "\n  Real friction;\nequation\n  connect(frame_a, origin.frame_a);\n"
    declared, connected = findings(arm.changed("\nequation\n", twice))
    assert declared.endswith("error: joint elbow: the file declares `friction` twice [syntax]")
    assert connected.endswith("the file connects `frame_a` and `origin.frame_a` twice [repeated]")
    assert " warning: " in connected


ELBW = arm.text().replace("model Elbow", "model Elbw").replace("end Elbow", "end Elbw")
SMALL_ELBOW = arm.text().replace("Elbow", "elbow")
INSIDE = f"within {arm.NAME};\npackage Joints\n  model Elbow\n  end Elbow;\nend Joints;\n"
JOINT = "error: joint elbow:"
CAN_NOT = "can't be the name of a class; rename the file, or move it elsewhere [wrong-name]"


@pytest.mark.parametrize(
    ("edits", "expected"),
    [
        (
            {ELBOW: ELBW},
            f"{ELBOW}:{arm.line('model Elbow')}: {JOINT} the class is called `Elbw`, but its file `Elbow`; give class "
            "and file the same name [wrong-name]",
        ),
        (
            {ELBOW: arm.text().encode().replace(b"Motion along", b"Bew\xe9gung")},
            f"{ELBOW}:{arm.line('Motion along')}: {JOINT} the file is not in UTF-8; save it as UTF-8 [not-utf8]",
        ),
        ({ORDER: b"Elbow\nSt\xfctze\n"}, f"{ORDER}:2: error: the file is not in UTF-8; save it as UTF-8 [not-utf8]"),
        ({"Joints/Elbow (copy).mo": arm.text()}, f"Joints/Elbow (copy).mo: error: `Elbow (copy)` {CAN_NOT}"),
        (
            {"Joints/package.mo": INSIDE},
            "Joints/package.mo:3: error: `Elbow` is declared here, and also has the file Joints/Elbow.mo; "
            "put the whole class into one file, and delete the other file [class-twice]",
        ),
        (
            {ORDER: arm.text(ORDER).replace("Turret\n", "")},
            f"{ORDER}: warning: `Turret` is not named; add a line for this class: without a line, tools list the "
            "class last, or warn [order-lacks]",
        ),
        (
            {"Joints/elbow.mo": SMALL_ELBOW, ORDER: arm.text(ORDER) + "elbow\n"},
            "Joints/elbow.mo: warning: `elbow` and `Elbow` differ only by case; rename one class: file systems that "
            "ignore case do not hold both [same-but-for-case]",
        ),
    ],
)
def test_each_fault_has_its_place_and_its_words(edits: Mapping[str, str | bytes | None], expected: str) -> None:
    assert findings(edits) == [expected]


def test_the_order_is_not_judged_by_a_package_file_that_does_not_parse() -> None:
    edits = {"Joints/package.mo": "package Joints\n  constant Real x = ;\n", ORDER: "x\n" + arm.text(ORDER)}
    assert [one.split("[")[-1] for one in findings(edits)] == ["syntax]"]


def test_a_top_level_package_may_say_that_it_is_in_none() -> None:
    texts = {"package.mo": b"within;\npackage Arm\nend Arm;\n"}
    assert check_layout(PackageTexts("Arm", Path("Arm"), texts)) == []
    assert check_layout(PackageTexts("Arm", Path("Arm"), {"package.mo": b"package Arm\nend Arm;\n"})) == []
    (found,) = check_layout(PackageTexts("Plant.Arm", Path("Arm"), texts))
    assert found.code == "wrong-within"


# --- folders ----------------------------------------------------------------------------------------------------------


def test_a_folder_of_classes_is_a_package() -> None:
    hint = "add this file, or move the classes elsewhere"
    assert findings({"Joints/package.mo": None}) == [
        f"Joints: error: the folder holds classes, but no package.mo; {hint} [no-package-file]"
    ]
    (found,) = check_layout(PackageTexts("Arm", Path("Arm"), {}))
    assert (found.code, found.file) == ("no-package-file", "Arm")


@pytest.mark.parametrize("name", ["X.mo", "old ones", "model"])
def test_of_a_folder_that_can_be_no_package_one_thing_is_said(name: str) -> None:
    within = f"within {arm.NAME};"
    edits = {f"{name}/package.mo": f"{within}\npackage X\nend X;\n", f"{name}/Inner/Y.mo": "nonsense"}
    message = f"`{name}` can't be the name of a package; rename the folder, or move it elsewhere"
    assert findings(edits) == [f"{name}: error: {message} [wrong-name]"]
    order = f"{arm.text('package.order')}{name}\n"
    assert findings({**edits, "package.order": order}) == [f"{name}: error: {message} [wrong-name]"]


# --- files around the package -----------------------------------------------------------------------------------------

OUTPUT = arm.HOME / "modelica"
AROUND = {
    "Plant/package.mo": "within;\npackage Plant\nend Plant;\n",
    "Plant/package.order": "Robots\nGone\n",
    "Plant/Robots/package.mo": "within Plant;\npackage Robots\nend Robots;\n",
    "Plant/Control.mo": "within Plant;\nblock Control\nend Control;\n",
}


def around(files: Mapping[str, str | bytes]) -> list[str]:
    """What is said of files beside the package, some of them other than they should be."""
    texts = {**AROUND, **files}
    contents = {path: text.encode() if isinstance(text, str) else text for path, text in texts.items()}
    return [str(one).removeprefix(f"{OUTPUT}/") for one in check_around(OUTPUT, contents)]


def test_packages_around_are_sound() -> None:
    assert around({}) == []


def test_files_around_say_in_which_package_they_stand() -> None:
    found = around({"Plant/Robots/Shelf.mo": "within Plant;\nmodel Shelf\nend Shelf;\n"})
    message = "the file says `within Plant;`, but stands in `Plant.Robots`; write `within Plant.Robots;`"
    assert found == [f"Plant/Robots/Shelf.mo:1: error: {message} [wrong-within]"]


def test_a_package_around_is_called_like_its_folder() -> None:
    """A compiler would look for the robot's package in vain."""
    found = around({"Plant/Robots/package.mo": "within Plant;\npackage Robot\nend Robot;\n"})
    message = "the class is called `Robot`, but its folder `Robots`; give class and folder the same name"
    assert found == [f"Plant/Robots/package.mo:2: error: {message} [wrong-name]"]


def test_what_keeps_no_compiler_from_reading_files_around_is_not_said() -> None:
    twice = "  connect(a, b);\n" * 2
    files = {
        "Plant/Control.mo": f"within Plant;\nmodel Other\nequation\n{twice}end Other;\n",
        "Plant/Old.v1.mo": "within Plant;\nmodel Old\nend Old;\n",
        "Plant/X.mo/package.mo": "within Plant;\npackage X\nend X;\n",
    }
    assert around(files) == []
