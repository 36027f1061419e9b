"""Rows of a catalogue: both readers have their numbers in SI, and a fault names its line."""

from __future__ import annotations

import math
import sys
from typing import Any

import pytest
from msgspec.structs import replace
from support.numbers import differences
from support.urdfs import joint, link, robot

from urdfsync.common.diagnostics import Severity
from urdfsync.domain import Companion
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.physics import reference
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.robot import Dynamics, Joint, Limit, Motor, Transmission
from urdfsync.formats.urdf.second.companions import read_companions
from urdfsync.formats.urdf.second.reading import read_again

LOSSES = '<dynamics damping="0.5" friction="0.1" armature="0.01"/>'
GEAR = (
    '<transmission name="t"><joint name="elbow"><offset>0.1</offset></joint>'
    "<actuator><mechanicalReduction>50</mechanicalReduction></actuator></transmission>"
)
URDF = robot(
    *(link("base", 2.0), link("a", 1.0), link("b", 1.0), link("c", 1.0)),
    joint("elbow", "revolute", "base", "a", axis="0 0 1", inside=[LOSSES]),
    joint("lift", "prismatic", "a", "b", axis="0 1 0"),
    joint("wheel", "continuous", "b", "c", axis="0 0 1"),
    GEAR,
)
HEADER = (
    "name,torque [N.cm],force [kN],velocity [deg/s],speed [mm/s],"
    "reduction [integer],pitch [turn/m],rotor [g.cm2],armature [kg.m2]"
)
CSV = f"{HEADER}\nS,410,,180,,353,,0.6,\nL,,0.2,,120,,500,4.5,\nN,5,,90,,,,,0.02\n"
COLUMNS = {
    "effort": ("torque", "force"),
    "velocity": ("velocity", "speed"),
    "reduction": ("reduction", "pitch"),
    "rotor_inertia": "rotor",
}
OPTIONS: dict[str, Any] = {
    "catalogue": "motors.csv",
    "motors": {"elbow": "S", "lift": "L", "wheel": "N"},
    "motor_columns": COLUMNS,
}


def catalogue(csv: str = CSV) -> Companion:
    return Companion("catalogue", "motors.csv", csv.encode())


def read(csv: str = CSV, urdf: str | bytes = URDF, **options: Any) -> RobotReading:
    content = urdf if isinstance(urdf, bytes) else urdf.encode()
    return read_robot(content, "a.urdf", Options(**{**OPTIONS, **options}), catalogue(csv))


def joints(reading: RobotReading) -> dict[str, Joint]:
    assert reading.robot is not None, reading.diagnostics
    return {joint.name: joint for joint in reading.robot.joints}


def test_numbers_of_a_row_replace_those_of_the_source() -> None:
    found = joints(read())
    assert found["elbow"].limit == Limit(-3, 3, 4.1, math.pi)
    assert found["elbow"].dynamics == Dynamics(0.5, 0.1, 0.01)
    assert found["elbow"].transmission == Transmission(353, 0.1, 6e-8)
    assert found["elbow"].motor == Motor("S", ("effort", "velocity", "reduction", "rotor_inertia"))
    assert found["lift"].limit == Limit(-3, 3, 200, 0.12)
    assert found["lift"].transmission == Transmission(3141.5926535897934, 0, 4.5e-7)
    assert found["wheel"].limit == Limit(0, 0, 0.05, math.pi / 2)
    assert found["wheel"].dynamics == Dynamics(armature=0.02)
    assert not found["lift"].actuated
    assert found["lift"].measured is None


def test_the_second_reader_and_pinocchio_have_the_same_numbers() -> None:
    content, options = URDF.encode(), Options(**OPTIONS)
    assert differences(content, [catalogue()], **OPTIONS) == []
    again = read_again(content, options, catalogue()).joints["elbow"]
    assert again.number("transmission.rotorInertia") == pytest.approx(6e-8)
    assert again.values["limits.effort"][1:] == (2, "motors.csv")
    stated = read_companions([catalogue()], options)
    completed = completed_for_reference(content, companions=stated).content
    found = reference.read(completed, "a.urdf", rows=stated.rows)
    assert found.rotors.diagonal().max() == pytest.approx(4.5e-7 * (1000 * math.pi) ** 2)
    assert joints(read(urdf=completed)) == joints(read())


@pytest.mark.parametrize(("csv", "columns"), [
    ("name,effort [N.m],effort [N],velocity [rpm],velocity [mm/s]\nS,2,,100,\nL,,5,,20\nN,1,,90,\n", {}),
    ("name,effort [max] [N.m],velocity\nS,5,\nN,7,\n", {"effort": "effort [max]"}),
    ("name,effort [N.m]\nS,1\u00a0200\nN,2\u200b0\n", {}),
])  # fmt: skip
def test_both_readings_take_strange_tables_alike(csv: str, columns: dict[str, str]) -> None:
    """Columns of one name, brackets in a name, and characters that nobody sees."""
    motors = {joint: row for joint, row in OPTIONS["motors"].items() if f"\n{row}," in csv}
    options = {**OPTIONS, "motors": motors, "motor_columns": columns}
    assert joints(read(csv, **options))["elbow"].motor
    assert differences(URDF.encode(), [catalogue(csv)], **options) == []


@pytest.mark.parametrize("content", [URDF.encode("utf-16"), f"{URDF}<!-- </robot> -->".encode()])
def test_rows_join_a_urdf_in_any_encoding_with_any_end(content: bytes) -> None:
    assert joints(read(urdf=content)) == joints(read())
    assert differences(content, [catalogue()], **OPTIONS) == []


def test_both_readings_take_torques_without_a_dot() -> None:
    dotless = CSV.replace("[N.cm]", "[Ncm]")
    assert joints(read(dotless)) == joints(read())
    again = read_again(URDF.encode(), Options(**OPTIONS), catalogue(dotless)).joints["elbow"]
    assert again.values["limits.effort"].value == (pytest.approx(4.1),)


@pytest.mark.parametrize("path", ["limits.effort", "limits.velocity", "transmission.reduction", "dynamics.armature"])
def test_a_wrong_number_of_a_drive_is_found(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    block, field = {"limits": "limit"}.get(path.partition(".")[0], path.partition(".")[0]), path.partition(".")[2]
    name, right = "wheel" if "armature" in path else "elbow", read()
    assert right.robot is not None
    wrong = [
        replace(own, **{block: replace(getattr(own, block), **{field: 7.0})}) if own.name == name else own
        for own in right.robot.joints
    ]
    reading = DOMAIN.read(URDF.encode(), "a.urdf", Options(**OPTIONS), catalogue())
    broken = replace(reading, snapshot=replace(reading.snapshot, joints=tuple(wrong)).by_name())
    monkeypatch.setattr(type(DOMAIN), "read", lambda *_: broken)
    found = differences(URDF.encode(), [catalogue()], approach=("package",), **OPTIONS)
    assert {(each.element, each.quantity, each.given) for each in found} == {(f"joint {name}", path, "7")}


@pytest.mark.parametrize(("old", "new", "message"), [
    ("[N.cm]", "[kg]", "effort of joint `elbow` in the row `S`: kg can't be converted to N.m"),
    ("[N.cm]", "[Nxcm]", "effort of joint `elbow` in the row `S`: `Nxcm` is no unit"),
    ("[deg/s]", "[1/min]", "velocity of joint `elbow` in the row `S`: write `turn` or `rad` in 1/min"),
    ("410", "x", "effort of joint `elbow` in the row `S`: `x` is no number"),
    ("410", "-1", "effort of joint `elbow` in the row `S`: -1 is too small"),
    ("410", "1e999", "effort of joint `elbow` in the row `S`: 1e999 is too large"),
    ("353", "0", "reduction of joint `elbow` in the row `S`: 0 is too small"),
    ("S,410,,180,,353,,0.6,", "S,,,,,,,,", "the row `S` has no number of a drive"),
    ("S,410,,", "S,,4,", "effort of joint `elbow` in the row `S`: kN can't be converted to N.m"),
])  # fmt: skip
def test_a_fault_of_a_row_is_one_diagnostic(old: str, new: str, message: str) -> None:
    (found,) = read(CSV.replace(old, new)).diagnostics
    assert (found.code, found.message, found.file, found.line) == ("bad-row", message, "motors.csv", 2)


@pytest.mark.parametrize(("csv", "line", "message"), [
    (CSV.replace("410", "4,10"), 2, "the row `S` has 10 cells, but the header has 9"),
    (f"{CSV}S,1,,,,,,,\n", 5, "the row `S` stands in line 2, too"),
    (CSV.replace("torque", "tork"), 1, "there is no column `torque`"),
    (CSV.replace(" [N.cm]", ""), 1, "the column `torque` has no unit"),
    ("", 0, "the table has no rows"),
])  # fmt: skip
def test_a_fault_of_the_table_has_its_line(csv: str, line: int, message: str) -> None:
    (found,) = read(csv).diagnostics
    assert (found.file, found.line, found.message) == ("motors.csv", line, message)


def test_a_cell_that_other_rows_fill_is_not_left_empty_in_silence() -> None:
    assert read().diagnostics == ()
    findings = read(CSV.replace("N,5", "N,")).diagnostics
    assert [(one.code, one.file, one.line) for one in findings if one.severity is Severity.WARNING] == [
        ("missing-limit-value", "motors.csv", 4)  # a continuous joint without <limit> gets one from the row
    ]
    (found,) = (one for one in findings if one.severity is Severity.NOTE)
    assert (found.code, found.file, found.line) == ("empty-cell", "motors.csv", 4)
    assert found.message == "the row `N` has no effort: that of joint `wheel` in the source counts"


def test_a_joint_without_limits_of_position_keeps_its_freedom() -> None:
    urdf = URDF.replace('<limit lower="-3" upper="3" velocity="10" effort="1000"/>', "")
    found = [each for each in read(urdf=urdf).diagnostics if each.code == "bad-row"]
    assert [each.message for each in found] == ["joint `elbow` has no <limit>: the row `S` gives no limits of position"]


def test_a_motor_of_two_joints_takes_no_reduction() -> None:
    named = (("joint", 1, "elbow"), ("joint", 2, "wheel"), ("actuator", 1, "m"), ("actuator", 2, "n"))
    parts = "".join(f'<{kind} name="{name}"><role>{kind}{k}</role></{kind}>' for kind, k, name in named)
    shared = f'<transmission name="t"><type>x/DifferentialTransmission</type>{parts}</transmission>'
    urdf = URDF.replace(GEAR, shared)
    found = read(urdf=urdf).diagnostics
    assert [each.message for each in found] == [
        "the motor of joint `elbow` also moves `wheel`: a row can't give its reduction"
    ]
    rows = catalogue(CSV.replace(",353,", ",,"))
    assert differences(urdf.encode(), [rows], approach=("package",), **OPTIONS) == []


@pytest.mark.parametrize(("options", "place"), [
    ({"motors": {"elbow": "T"}}, "motors.elbow"),
    ({"motors": {"elbow": "S"}, "catalogue": ""}, "motors.elbow"),
    ({"motors": {"elbo": "S"}}, "motors.elbo"),
    ({"motors": {"base": "S"}}, "motors.base"),
])  # fmt: skip
def test_wrong_names_are_faults_of_options(options: dict[str, Any], place: str) -> None:
    chosen = {**OPTIONS, **options}
    companions = [catalogue()] if chosen["catalogue"] else []
    reading = DOMAIN.read(URDF.encode(), "a.urdf", Options(**chosen), *companions)
    assert [option for option, fault in reading.option_findings if fault.severity is Severity.ERROR] == [place]


def test_si_needs_no_pint(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pint", None)
    chosen: dict[str, Any] = {"catalogue": "motors.csv", "motors": {"elbow": "S"}}
    rows = "name,effort [N.m],velocity [rad/s],rotor_inertia [kg.m2]\nS,4.25,3.5,1.5e-6\n"
    assert joints(read(rows, motor_columns={}, **chosen))["elbow"].limit == Limit(-3, 3, 4.25, 3.5)
    assert differences(URDF.encode(), [catalogue(rows)], **chosen) == []


def test_strange_names_and_cells_are_read_as_they_are() -> None:
    csv = CSV.replace("\nS,", '\n"<S> & ""ü""",')
    assert joints(read(csv, motors={"elbow": '<S> & "ü"'}))["elbow"].motor == Motor(
        '<S> & "ü"', ("effort", "velocity", "reduction", "rotor_inertia")
    )


def test_numbers_of_the_source_that_a_row_replaces_are_not_told() -> None:
    """Neither that they are missing, nor that they are none."""
    urdf = URDF.replace(' velocity="10" effort="1000"', "", 1).replace('effort="1000"', 'effort="?"', 1)
    assert read(urdf=urdf).diagnostics == ()
    (found,) = read(CSV.replace("S,410,,180", "S,410,,0")).diagnostics
    assert (found.code, found.file, found.line) == ("zero-limits", "motors.csv", 2)


def test_a_row_is_for_a_hinge_of_a_chain_too() -> None:
    ball = URDF.replace('"continuous"', '"ball"')
    loop = '<loop_joint name="l" type="fixed"><link1 link="c"/><link2 link="base"/></loop_joint></robot>'
    yaml = Companion(
        "closed_loops", "a.yaml", b"closed_loop: []\ntype: []\njoint_name: [wheel]\njoint_type: [UJOINT_XY]\n"
    )
    options = Options(**{**OPTIONS, "motors": {"wheel_y": "N"}, "start": {"wheel_x": 0.5}})
    for urdf, companions in ((ball.replace("</robot>", loop), []), (URDF, [yaml])):
        found = joints(read_robot(urdf.encode(), "a.urdf", options, catalogue(), *companions))
        assert found["wheel_y"].dynamics == Dynamics(armature=0.02)
        assert (found["wheel_x"].start, found["wheel_x"].measured) == (0.5, True)
