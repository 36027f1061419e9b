"""Where records of links and joints differ from the whole robot's: the shipped six-axis arm, with edits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.config import library_folder
from urdfsync.domain import Target
from urdfsync.urdf.echoes import echoes

TARGET = Target("UrdfSync.Examples.SixAxisArm", "SixAxisArm")
FOLDER = library_folder() / "UrdfSync" / "Examples" / "SixAxisArm"
RECORDS = {path.relative_to(FOLDER).as_posix(): path.read_text() for path in FOLDER.rglob("*Parameters.mo")}
WHOLE = "SixAxisArmParameters.mo"
FOREARM, ELBOW, TOOL = "Links/ForearmParameters.mo", "Joints/ElbowParameters.mo", "Links/Tool0Parameters.mo"


def differences(*edits: tuple[str, str, str]) -> list[str]:
    """The differences after edits: path, old and new text."""
    records = dict(RECORDS)
    for path, old, new in edits:
        assert records[path].count(old) == 1
        records[path] = records[path].replace(old, new)
    return [
        f"{one.path}: {one.name} = {one.value} | {other.path}: {other.name} = {other.value}"
        for one, other in ((echo.one, echo.other) for echo in echoes(records, TARGET))
    ]


def test_records_as_generated_agree() -> None:
    for folder in (path.parent for path in FOLDER.parent.glob("*/Links")):
        records = {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*Parameters.mo")}
        assert len(records) > 1
        assert list(echoes(records, Target("", folder.name))) == []


@pytest.mark.parametrize(
    ("path", "old", "new", "expected"),
    [
        (FOREARM, "mass = 4.2", "mass = 4.50", "inertial.mass = 4.50 | {}: forearm.inertial.mass = 4.2"),
        (FOREARM, "{0.1118, 0, 0}", "{0.1118, 0.0, 2e-3}",
         "inertial.origin.xyz[3] = 2e-3 | {}: forearm.inertial.origin.xyz[3] = 0"),
        (FOREARM, "{0.1118, 0, 0}", "fill(0, 3)",
         "inertial.origin.xyz = fill(0, 3) | {}: forearm.inertial.origin.xyz = {0.1118, 0, 0}"),
        (ELBOW, "effort = 130", "effort = k*130", "limits.effort = k*130 | {}: elbow.limits.effort = 130"),
        (ELBOW, "effort = 130", "effort = Modelica.Constants.inf",
         "limits.effort = Modelica.Constants.inf | {}: elbow.limits.effort = 130"),
        (ELBOW, "      upper = 1.222,\n", "", "limits.upper = None | {}: elbow.limits.upper = 1.222"),
        (TOOL, 'name = "tool0"', 'name = "tool0", inertial(mass = 1)',
         "inertial.mass = 1 | {}: tool0.inertial.mass = None"),
    ],
)  # fmt: skip
def test_an_edited_element(path: str, old: str, new: str, expected: str) -> None:
    assert differences((path, old, new)) == [f"{path}: {expected}".replace("{}", WHOLE)]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("mass = 4.2", "mass = 4.200 /* weighed */"),
        ("mass = 4.2", 'final mass = +42e-1 "weighed"'),
        ("{0.1118, 0, 0}", "{ 0.11180,0.0,\n  -0}"),
        ("size = {0.08, 0.018, 0.056}", "size = {1, 1, 1}"),
    ],
    ids=["another spelling", "a description", "another layout", "a shape"],
)
def test_edits_that_make_no_difference(old: str, new: str) -> None:
    text = RECORDS[FOREARM]
    assert old in text
    records = RECORDS | {FOREARM: text.replace(old, new)}
    assert list(echoes(records, TARGET)) == []


def test_an_edited_whole_record() -> None:
    edit = (WHOLE, "upper = 1.222", "upper = 1.3")
    assert differences(edit) == [f"{ELBOW}: limits.upper = 1.222 | {WHOLE}: elbow.limits.upper = 1.3"]


def test_both_edited_alike_agree() -> None:
    assert differences((WHOLE, "upper = 1.222", "upper = 1.3"), (ELBOW, "upper = 1.222", "upper = 1.30")) == []


def test_what_is_given_as_one_expression_is_not_judged() -> None:
    whole = re.sub(r"UrdfSync\.Records\.RevoluteJoint elbow\(.*?\)\n    \"Joint 3", 'Elbow elbow = mine\n    "Joint 3',
                   RECORDS[WHOLE], flags=re.DOTALL)  # fmt: skip
    assert whole != RECORDS[WHOLE]
    assert list(echoes(RECORDS | {WHOLE: whole}, TARGET)) == []
    limits = re.sub(r"limits\(.*?\)", "limits = mine", RECORDS[ELBOW], flags=re.DOTALL)
    assert list(echoes(RECORDS | {ELBOW: limits}, TARGET)) == []


def test_records_that_are_missing_or_no_records_are_passed_over() -> None:
    assert list(echoes({FOREARM: RECORDS[FOREARM]}, TARGET)) == []
    assert list(echoes({WHOLE: RECORDS[WHOLE]}, TARGET)) == []
    assert list(echoes(RECORDS | {FOREARM: "", "Mine/ElbowParameters.mo": "record", "Links/x.mo": "("}, TARGET)) == []


def test_a_difference_has_its_lines() -> None:
    changed = RECORDS | {FOREARM: RECORDS[FOREARM].replace("mass = 4.2", "mass = 5")}
    (echo,) = echoes(changed, TARGET)
    assert "mass = 5" in changed[FOREARM].splitlines()[echo.one.line - 1]
    assert "mass = 4.2" in changed[WHOLE].splitlines()[echo.other.line - 1]


NUMBERS = [
    (path, match.start(), match.end())
    for path, text in sorted(RECORDS.items())
    for match in re.finditer(r"(?<=mass = |pper = |ping = )-?[\d.e-]+", text.partition(" collision")[0])
    if path != WHOLE
]


@given(st.sampled_from(NUMBERS), st.floats(1e3, 1e6))
def test_every_other_number_is_found(place: tuple[str, int, int], number: float) -> None:
    path, start, end = place
    text = RECORDS[path]
    found = list(echoes({path: f"{text[:start]}{number!r}{text[end:]}", WHOLE: RECORDS[WHOLE]}, TARGET))
    assert [(echo.one.path, echo.one.value, echo.other.value) for echo in found] == [
        (path, repr(number), text[start:end])
    ]


@pytest.mark.parametrize("file", [Path(FOREARM), Path(WHOLE)], ids=str)
def test_half_a_record_is_not_judged(file: Path) -> None:
    text = RECORDS[file.as_posix()]
    pair = {WHOLE: RECORDS[WHOLE], FOREARM: RECORDS[FOREARM]}
    lengths = range(0, min(len(text), 2500), 7)
    assert [echo for length in lengths for echo in echoes(pair | {file.as_posix(): text[:length]}, TARGET)] == []
