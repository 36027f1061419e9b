"""yourdfpy as second reader: agreement is silent, disagreement an error, its failures notes; `check` alone asks it."""

from __future__ import annotations

import logging
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.urdfs import joint, links, mimic, parsed, robot

from urdfsync.diagnostics import Severity
from urdfsync.urdf.parse.respelling import with_attributes
from urdfsync.urdf.parse.second_reader import compare_readers, cross_check
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.robot import Joint, Link, Origin, Robot

TREE = '<link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
URDF = f'<robot name="r">{TREE}</robot>'
ODD = URDF.replace(' name="r"', "")
"""A robot that yourdfpy can't read."""
ROBOT = Robot("r", (Link("a"), Link("b")), (Joint("j", "fixed", "a", "b"),))
MOVING = robot(
    *links(base=4.0, upper=2.5, fore=1.5, hand=0.7, puck=0.3),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0", rpy="0.4 0.5 0.6"),
    joint("elbow", "prismatic", "upper", "fore", axis="0.3 -0.4 1.2", inside=[mimic("shoulder", -1.5, 0.2)]),
    joint("wrist", "continuous", "fore", "hand", axis="1 1 0", inside=[mimic("elbow", 2)]),
    joint("glide", "planar", "hand", "puck"),
)
"""Followers of followers, axes that are no unit vectors, and a joint without an axis of its own."""


@pytest.mark.parametrize(("changes", "message"), [
    ({"links": (Link("a"), Link("c"))}, "other links: without c; with b"),
    ({"joints": (Joint("j", "fixed", "b", "a"),)}, "without j (fixed, b → a); with j (fixed, a → b)"),
    ({"joints": (Joint("j", "planar", "a", "b"),)}, "without j (planar, a → b); with j (fixed, a → b)"),
    ({"joints": ()}, "other joints: with j (fixed, a → b)"),
    ({"links": tuple(map(Link, "abcdefgh"))}, "other links: without c, d, e, f, g, …"),
    ({"joints": (Joint("j", "fixed", "a", "b", origin=Origin((1.0, 0.0, 0.0))),)},
     "link 'b': with all joints at zero the link is at (1, 0, 0) m, for yourdfpy at (0, 0, 0) m"),
    ({"joints": (Joint("j", "fixed", "a", "b", origin=Origin(rpy=(0.0, 1e-6, 0.0))),)},
     "for yourdfpy at (0, 0, 0) m, turned otherwise"),
])  # fmt: skip
def test_disagreement_is_told(changes: dict[str, Any], message: str) -> None:
    (finding,) = compare_readers(URDF.encode(), msgspec.structs.replace(ROBOT, **changes))
    assert finding.code == "second-reader-differs"
    assert finding.message.endswith(message)


@pytest.mark.parametrize(("changes", "message"), [
    ({"parent": "b"}, "has another parent"),
    ({"origin": Origin((2.0, 0.0, 0.0))}, "has another parent"),
    ({"child_origin": Origin((0.0, 3.0, 0.0))}, "is turned otherwise with all joints at zero"),
])  # fmt: skip
def test_loops_are_read_twice(changes: dict[str, Any], message: str) -> None:
    ends = '<parent link="a"/><child link="b"/><parent_origin xyz="1 0 0"/><child_origin xyz="0 3 0"/>'
    loop = f'<loop_joint name="pin" type="fixed">{ends}</loop_joint>'
    source = URDF.replace("</joint>", f'<origin rpy="0 0 1"/></joint>{loop}').encode()
    found = read_robot(source, "a.urdf").robot
    assert found is not None
    assert list(compare_readers(source, found)) == []
    changed = msgspec.structs.replace(found, loops=(msgspec.structs.replace(found.loops[0], **changes),))
    assert f"loop 'pin' {message}" in [finding.message for finding in compare_readers(source, changed)]


TEXTS = robot(
    '<link name="a"/>',
    '<link name="b"><inertial><pose>0 0 1 0 0 0</pose><mass>2</mass><inertia><ixx>1</ixx></inertia></inertial></link>',
    '<joint name="j" type="revolute"><pose>1 2 3 0.1 0.2 0.3</pose><parent>a</parent><child>b</child>'
    "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint>",
)


def test_the_spelling_of_sdf_is_read_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    assert cross_check(TEXTS.encode(), "a.urdf") == ()
    wrong = robot(*TEXTS.split("\n")[2:-2]).replace("<mass>2", "<mass>3").encode()
    monkeypatch.setattr("urdfsync.urdf.parse.second_reader.with_attributes", lambda *_: with_attributes(wrong))
    (finding,) = cross_check(TEXTS.encode(), "a.urdf")
    assert (finding.code, finding.message) == ("second-reader-differs", "link b: its texts are read otherwise")


def test_a_quaternion_is_not_cross_checked() -> None:
    text = URDF.replace("<robot", '<robot version="1.1"').replace("<parent", '<origin quat_xyzw="0 0 1 0"/><parent')
    (finding,) = compare_readers(text.encode(), parsed(text))
    assert (finding.code, finding.message) == (
        "second-reader-failed",
        "poses are not cross-checked: yourdfpy reads no quat_xyzw",
    )


@pytest.mark.parametrize(("number", "axis", "link"), [(0, (0.0, 0.0, 1.0), "upper"), (1, (0.0, 1.0, 0.0), "fore")])
def test_an_axis_that_is_read_otherwise_shows_where_joints_move(
    number: int, axis: tuple[float, float, float], link: str
) -> None:
    read = parsed(MOVING)
    assert list(compare_readers(MOVING.encode(), read)) == []
    joints = [msgspec.structs.replace(one, axis=axis) if k == number else one for k, one in enumerate(read.joints)]
    (finding,) = compare_readers(MOVING.encode(), msgspec.structs.replace(read, joints=tuple(joints)))
    assert finding.path == f"link {link}"
    assert "with all joints away from zero" in finding.message


@pytest.mark.parametrize(
    ("urdf", "reason"),
    [
        (ODD, "KeyError"),
        (URDF.replace("<robot", '<robot xmlns="http://www.ros.org"'), "finds no link"),
        (URDF.replace('"a"/>', '"a"><visual/></link>', 1), "TypeError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry/></visual></link>', 1), "IndexError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry><capsule radius="1" length="1"/></geometry></visual></link>', 1),
         "Unknown tag: capsule"),
        (URDF.replace("<link", '<material name="m"><color rgba="x"/></material><link', 1), "ValueError"),
        (f'<?xml version="1.0" encoding="utf-16"?>{URDF}', "TypeError"),
    ],
)  # fmt: skip
def test_what_only_the_strict_reader_accepts_is_a_note(
    urdf: str, reason: str, capfd: pytest.CaptureFixture[str]
) -> None:
    (note,) = cross_check(urdf.encode(), "a.urdf")
    assert (note.code, note.severity, note.line > 0) == ("second-reader-failed", Severity.NOTE, True)
    assert reason in note.message
    assert not logging.getLogger("yourdfpy.urdf").disabled
    assert capfd.readouterr() == ("", "")


def test_a_build_does_not_load_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.urdf").write_text(ODD)
    (tmp_path / "urdfsync.toml").write_text('[robots.a]\nsource = "a.urdf"\npackage = "A"\n')
    program = "import sys; from urdfsync import cli; assert cli.main(['build', '--quiet']) == 0;"
    program += "assert not {'yourdfpy', 'numpy'} & sys.modules.keys()"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
