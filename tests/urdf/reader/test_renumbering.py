"""A version with other numbers alone is the last robot with these; whatever else changes, all is checked again."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import Severity
from urdfsync.domain import Parts
from urdfsync.urdf import source
from urdfsync.urdf.reader import cross_check
from urdfsync.urdf.reader.checks import Finding
from urdfsync.urdf.robot import Robot

LEG = """<link name="leg"{0}>
<inertial><mass value="{1}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><{2}/></geometry><material name="{3}"/></visual></link>"""
KNEE = """<joint name="knee" type="{0}">
<origin xyz="{1} 0 0"/><parent link="{2}"/><child link="leg"/><axis xyz="0 0 {3}"/>
<limit lower="{4}" upper="1" effort="1" velocity="1"/>{5}</joint>"""
HIP = joint("hip", "continuous", "base", "thigh")
GREY = '<material name="grey"><color rgba="{0} 0 0 1"/></material>'
GIVEN: dict[str, tuple[Any, ...]] = {
    "grey": (0.5,),
    "leg": ("", 1, 'box size="1 1 1"', "grey"),
    "knee": ("revolute", 0.1, "thigh", 2, -1, '<mimic joint="hip" multiplier="2"/>'),
    "end": ("", "knee"),
}
"""A robot with a warning (the axis), a material from elsewhere, a mimic relation and a transmission."""
DRIVE = '<transmission name="drive"><joint name="{0}"/></transmission>'


def legged(**others: tuple[Any, ...]) -> bytes:
    given = GIVEN | others
    leg, knee = LEG.format(*given["leg"]), KNEE.format(*given["knee"])
    more, driven = given["end"]
    end = more, DRIVE.format(driven)
    return robot(GREY.format(*given["grey"]), link("base"), link("thigh"), leg, HIP, knee, *end).encode()


NUMBERS = {
    "a mass": {"leg": ("", 3, 'box size="1 1 1"', "grey")},
    "a size": {"leg": ("", 1, 'box size="1 2 1"', "grey")},
    "an origin": {"knee": ("revolute", 7, "thigh", 2, -1, '<mimic joint="hip" multiplier="2"/>')},
    "a limit": {"knee": ("revolute", 0.1, "thigh", 2, -2, '<mimic joint="hip" multiplier="2"/>')},
    "a multiplier": {"knee": ("revolute", 0.1, "thigh", 2, -1, '<mimic joint="hip" multiplier="4"/>')},
    "no number": {"leg": ("", "1.0", 'box size="1 1 1"', "grey")},
}
MORE = {
    "a colour": {"grey": (0.7,)},
    "a material": {"leg": ("", 1, 'box size="1 1 1"', "red")},
    "a line": {"leg": ("\n", 1, 'box size="1 1 1"', "grey")},
    "another shape": {"leg": ("", 1, 'sphere radius="1"', "grey")},
    "a leftover of xacro": {"leg": ("", 1, 'box size="1 1 1"', "$(grey)")},
    "an error": {"leg": ("", -1, 'box size="1 1 1"', "grey")},
    "a warning": {"leg": ("", 1, 'box size="1 0 1"', "grey")},
    "another warning": {"knee": ("revolute", 0.1, "thigh", 3, -1, '<mimic joint="hip" multiplier="2"/>')},
    "a type": {"knee": ("prismatic", 0.1, "thigh", 2, -1, '<mimic joint="hip" multiplier="2"/>')},
    "a parent": {"knee": ("revolute", 0.1, "base", 2, -1, '<mimic joint="hip" multiplier="2"/>')},
    "no mimic": {"knee": ("revolute", 0.1, "thigh", 2, -1, "")},
    "a mimic of nothing": {"knee": ("revolute", 0.1, "thigh", 2, -1, '<mimic joint="hop" multiplier="2"/>')},
    "an element": {"end": ("<gazebo/>", "knee")},
    "another joint that is driven": {"end": ("", "hip")},
    "a drive of nothing": {"end": ("", "ankle")},
}


@pytest.fixture
def assembled(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """The documents that were put together and checked as a whole."""
    documents: list[object] = []
    assemble = source._assemble

    def noting(document: Any, *others: Any) -> Robot:
        documents.append(document)
        return assemble(document, *others)

    monkeypatch.setattr(source, "_assemble", noting)
    return documents


def read(content: bytes, parts: Parts | None = None, *, twice: bool = False) -> source.RobotReading:
    return source.read_robot(content, "a.urdf", cross_check=twice, parts=parts)


@pytest.mark.parametrize("others", NUMBERS.values(), ids=NUMBERS)
def test_other_numbers_are_put_into_the_last_robot(others: dict[str, Any], assembled: list[object]) -> None:
    parts: Parts = {}
    first, second, third = (read(content, parts) for content in (legged(), legged(**others), legged()))
    assert len(assembled) == 1
    assert [(one.diagnostics, one.lines) for one in (second, third)] == [(first.diagnostics, first.lines)] * 2
    assert second == read(legged(**others))
    assert third == first == read(legged())


@pytest.mark.parametrize("others", MORE.values(), ids=MORE)
def test_where_more_has_changed_all_is_checked(others: dict[str, Any], assembled: list[object]) -> None:
    parts: Parts = {}
    readings = [read(content, parts) for content in (legged(), legged(**others))]
    assert len(assembled) == 2
    assert readings[1] == read(legged(**others))
    assert read(legged(), parts) == readings[0]


def test_what_the_second_reader_finds_is_said_once_by_each_reading(monkeypatch: pytest.MonkeyPatch) -> None:
    heavy: list[float] = []

    def doubting(_: bytes, found: Robot) -> Iterator[Finding]:
        masses = {body.name: body.inertial.mass for body in found.links if body.inertial}
        heavy.append(masses["leg"])
        yield Finding(Severity.WARNING, "doubt", "link leg", f"{masses['leg']:g} kg?", "weigh it")

    monkeypatch.setattr(cross_check, "cross_check", doubting)
    parts: Parts = {}
    masses = (1, 2, 3)
    readings = [read(legged(leg=("", mass, 'box size="1 1 1"', "grey")), parts, twice=True) for mass in masses]
    told = [[found.message for found in reading.diagnostics if found.code == "doubt"] for reading in readings]
    assert told == [["1 kg?"], ["2 kg?"], ["3 kg?"]]
    assert heavy == [1, 2, 3]


SHAPES = {
    "a comment": (b"<visual>", b"<!-- 1 --><visual>"),
    "a comment with a number": (b"<!--1-->", b"<!--2-->"),
    "a digit of a name": (b"base", b"base2"),
    "the order of attributes": (b'ixx="1" ixy="0"', b'ixy="0" ixx="1"'),
    "a blank": (b'xyz="0.1 0', b'xyz="0.1  0'),
    "the head": (b"<robot ", b"<!-- exported -->\n<robot "),
    "the robot's name": (b'"own"', b'"other"'),
}


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """What the second reader was asked about."""
    contents: list[bytes] = []
    real = cross_check.cross_check

    def noting(content: bytes, found: Robot) -> Iterator[Finding]:
        contents.append(content)
        return real(content, found)

    monkeypatch.setattr(cross_check, "cross_check", noting)
    return contents


@pytest.mark.parametrize("others", NUMBERS.values(), ids=NUMBERS)
def test_the_second_reader_has_answered_what_numbers_do_not_change(others: dict[str, Any], asked: list[bytes]) -> None:
    parts: Parts = {}
    first, second, third = (read(content, parts, twice=True) for content in (legged(), legged(**others), legged()))
    assert asked == [legged()]
    assert third == first
    assert second == read(legged(**others), twice=True)


@pytest.mark.parametrize(("old", "new"), SHAPES.values(), ids=SHAPES)
def test_the_second_reader_is_asked_where_more_than_numbers_has_changed(
    old: bytes, new: bytes, asked: list[bytes]
) -> None:
    parts: Parts = {}
    before = legged(leg=("", 1, 'box size="1 1 1"/><!--1--><a', "grey"))
    after = before.replace(old, new)
    for content in (before, after, before):
        assert read(content, parts, twice=True).robot
    assert asked == [before, after, before]
    assert after != before
