"""yourdfpy as second reader: agreement is silent, disagreement an error, its failures notes."""

from __future__ import annotations

import logging
import subprocess
import sys

import msgspec
import pytest
from urdfsync.urdf.parse.second_reader import compare_readers as cross_check

from urdfsync.diagnostics import Severity
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.robot import Joint, Link, Robot

TREE = '<link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
URDF = f'<robot name="r">{TREE}</robot>'
ROBOT = Robot("r", (Link("a"), Link("b")), (Joint("j", "fixed", "a", "b"),))


def test_agreement_is_silent() -> None:
    assert list(cross_check(URDF.encode(), ROBOT)) == []


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (msgspec.structs.replace(ROBOT, links=(Link("a"), Link("c"))), "other links: without c; with b"),
        (
            msgspec.structs.replace(ROBOT, joints=(Joint("j", "fixed", "b", "a"),)),
            "other joints: without j (fixed, b → a); with j (fixed, a → b)",
        ),
        (
            msgspec.structs.replace(ROBOT, joints=(Joint("j", "planar", "a", "b"),)),
            "other joints: without j (planar, a → b); with j (fixed, a → b)",
        ),
        (msgspec.structs.replace(ROBOT, joints=()), "other joints: with j (fixed, a → b)"),
    ],
)
def test_disagreement_is_an_error(robot: Robot, message: str) -> None:
    (finding,) = cross_check(URDF.encode(), robot)
    assert (finding.severity, finding.code) == (Severity.ERROR, "second-reader-differs")
    assert finding.message.endswith(message)


@pytest.mark.parametrize(
    ("urdf", "reason"),
    [
        (URDF.replace(' name="r"', ""), "KeyError"),
        (URDF.replace("<robot", '<robot xmlns="http://www.ros.org"'), "finds no link"),
        (URDF.replace('"a"/>', '"a"><visual/></link>', 1), "TypeError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry/></visual></link>', 1), "IndexError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry><capsule radius="1" length="1"/></geometry></visual></link>', 1),
         "Unknown tag: capsule"),
        (URDF.replace("<link", '<material name="m"><color rgba="x"/></material><link', 1), "ValueError"),
        (f'<?xml version="1.0" encoding="utf-16"?>{URDF}', "TypeError"),
    ],
)  # fmt: skip
def test_what_only_the_strict_reader_takes_is_a_note(urdf: str, reason: str) -> None:
    reading = read_robot(urdf.encode(), "a.urdf")
    assert reading.robot is not None
    (note,) = [d for d in reading.diagnostics if d.code == "second-reader-failed"]
    assert note.severity is Severity.NOTE
    assert reason in note.message
    assert note.line > 0


@pytest.mark.parametrize(
    "urdf",
    [
        f'<?xml version="0.0"?>{URDF}',
        URDF.replace("</robot>", "<x:joint/></robot>"),
        URDF.replace("</robot>", "<!-- c --><gazebo><![CDATA[<link name='z'/>]]></gazebo></robot>"),
    ],
)
def test_what_the_strict_reader_tolerates_is_checked_all_the_same(urdf: str) -> None:
    codes = {d.code for d in read_robot(urdf.encode(), "a.urdf").diagnostics}
    assert codes <= {"xml-version", "xml-prefix"}


def test_the_second_reader_is_silent_and_its_log_is_left_as_it_was(capfd: pytest.CaptureFixture[str]) -> None:
    logger = logging.getLogger("yourdfpy.urdf")
    assert not logger.disabled
    read_robot(f'<?xml version="0.0"?>{URDF}'.encode(), "a.urdf")
    read_robot(URDF.replace(' name="r"', "").encode(), "a.urdf")
    assert not logger.disabled
    assert capfd.readouterr() == ("", "")


def test_it_can_be_left_out_and_is_not_even_imported_then() -> None:
    program = (
        "import sys; from urdfsync.urdf.parse.source import read_robot;"
        f"reading = read_robot({URDF.encode()!r}, 'a.urdf', cross_check=False);"
        "sys.exit(reading.robot is None or {'yourdfpy', 'numpy'} & sys.modules.keys() != set())"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_a_faulty_robot_is_not_read_again() -> None:
    (diagnostic,) = read_robot(b"<robot/>", "a.urdf").diagnostics[1:]
    assert diagnostic.code == "no-link"
