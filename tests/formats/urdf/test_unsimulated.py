"""What the generic robot or the package can't move is a warning at its line, and a way out."""

from __future__ import annotations

import re
from typing import Any

import pytest
from support import urdfs

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options

PLANAR = urdfs.robot(
    *urdfs.links(base=1, puck=1, lever=1),
    urdfs.joint("glide", "planar", "base", "puck", axis="0 0 1"),
    urdfs.joint("swing", "continuous", "puck", "lever", axis="0 0 1"),
)
FREE_INSIDE = urdfs.robot(
    *urdfs.links(base=1, boat=1, mast=1),
    urdfs.joint("drift", "floating", "base", "boat"),
    urdfs.joint("lean", "continuous", "base", "mast", axis="1 0 0"),
)
STATUE = urdfs.robot(urdfs.link("base", 1), urdfs.link("head", 1), urdfs.joint("neck", "fixed", "base", "head"))
LIGHT = urdfs.robot(
    *urdfs.links(base=1, arm=1),
    *map(urdfs.link, ("hand", "finger", "knob", "dial")),
    urdfs.link("thumb", 1),
    urdfs.joint("lift", "continuous", "base", "arm", axis="0 1 0"),
    urdfs.joint("twist", "continuous", "arm", "hand", axis="0 0 1"),
    urdfs.joint("bend", "continuous", "hand", "finger", axis="0 1 0"),
    urdfs.joint("turn", "continuous", "arm", "knob", axis="0 0 1"),
    urdfs.joint("follow", "continuous", "arm", "thumb", axis="0 0 1", inside=[urdfs.mimic("turn", 2)]),
    urdfs.joint("spin", "continuous", "arm", "dial", axis="0 0 1", inside=[urdfs.mimic("lift")]),
)
"""Nothing is behind twist and bend; turn leads a joint that moves a mass, and spin follows one."""
FEATHER = urdfs.robot(
    urdfs.link("base"), urdfs.link("arm"), urdfs.joint("lift", "continuous", "base", "arm", axis="0 1 0")
)
CODES = (
    "shared-rotor-not-in-record",
    "planar-not-generic",
    "floating-not-generic",
    "ball-not-generic",
    "moves-no-mass",
)


def warnings(urdf: str, *approach: str) -> list[str]:
    options = Options(approach=approach)  # type: ignore[arg-type]
    found = DOMAIN.read(urdf.encode(), "own.urdf", options).diagnostics
    assert all(one.severity is Severity.WARNING for one in found)
    return [str(one) for one in found if one.code in CODES]


RECORD, BOTH, PACKAGE = ("record",), ("package", "record"), ("package",)
ROD = """<link name="rod"><inertial><origin xyz="0 0 0.2"/><mass value="2"/>
<inertia ixx="0.1" iyy="0.1" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
RODS = urdfs.robot(
    urdfs.link("base", 1),
    ROD,
    urdfs.joint("spin", "continuous", "base", "rod", axis="0 0 1"),
    urdfs.link("pivot"),
    ROD.replace("rod", "other"),
    urdfs.joint("swing", "continuous", "base", "pivot", axis="0 1 0"),
    urdfs.joint("fasten", "fixed", "pivot", "other"),
)
"""All the mass is on an axis, as exporters write it; it turns about another one."""
WRIST = urdfs.robot(
    *urdfs.links(base=1, hand=1, tip=1),
    urdfs.joint("flex", "continuous", "base", "hand", axis="0 1 0"),
    urdfs.joint("roll", "continuous", "hand", "tip", axis="1 0 0"),
    '<transmission name="t" type="t/DifferentialTransmission"><joint name="flex"/><joint name="roll"/>'
    '<actuator name="m"/><actuator name="n"><drake:rotor_inertia value="1e-4"/></actuator></transmission>',
)
"""One of two motors has a rotor, which moves with both joints."""
NOTHING = (
    "moves no inertia about its axis, or only inertia behind another joint on the same axis, so the generic "
    "robot can move it by position only; give the child link of the joint an <inertial>, or make the joint fixed"
)
WARNINGS = [
    (PLANAR, RECORD, "6: warning: joint 'glide' is planar; the generic robot has no such joints, so the record has "
     "no tables; write two prismatic joints and a continuous one, or use the package approach"),
    (PLANAR, BOTH, "6: warning: joint 'glide' is planar; the generic robot has no such joints"),
    (FREE_INSIDE, RECORD, "6: warning: joint 'drift' is floating; the generic robot has no such joints, so the record "
     "has no tables; write three prismatic joints and three continuous ones, or use the package approach; if the "
     "root link has no other joint, remove both and set `base = \"floating\"` in a project"),
    (PLANAR.replace("planar", "ball"), RECORD, "6: warning: joint 'glide' is ball; the generic robot has no such "
     "joints, so the record has no tables; write three continuous joints, or use the package approach"),
    (LIGHT, RECORD, f"11: warning: joint 'twist' {NOTHING} [moves-no-mass]"),
    (RODS, RECORD, f"6: warning: joint 'spin' {NOTHING} [moves-no-mass]"),
    (FEATHER, RECORD, "2: warning: no link has a mass, so the joints of the generic robot can be moved by position "
     "only; give the links an <inertial> [moves-no-mass]"),
    (WRIST, RECORD, "7: warning: the motor of joint 'roll' also moves another joint, but in the record the motor's "
     "rotor does not; generate a package for the robot [shared-rotor-not-in-record]"),
]  # fmt: skip


@pytest.mark.parametrize(("urdf", "approach", "words"), WARNINGS)
def test_what_can_not_be_simulated_is_named_with_its_line_and_what_to_do(
    urdf: str, approach: tuple[str, ...], words: str
) -> None:
    """Joints behind a massless one are not named; one that a mass follows can move freely, a follower has no drive."""
    (found,) = warnings(urdf, *approach)
    assert found.startswith(f"own.urdf:{words}")


@pytest.mark.parametrize("urdf", [PLANAR, FREE_INSIDE, STATUE, LIGHT, FEATHER, WRIST])
def test_the_package_approach_has_no_reason_to_warn(urdf: str) -> None:
    assert warnings(urdf, *PACKAGE) == []


# Passive joints of the package

DRIVE = '<transmission name="t"><joint name="wheel"/></transmission>'
CART = urdfs.robot(
    *urdfs.links(base=1, tyre=1, roller=None),
    urdfs.joint("wheel", "continuous", "base", "tyre", axis="0 1 0", xyz="0 0 0.1"),
    urdfs.joint("caster", "continuous", "base", "roller", axis="0 0 1"),
).replace("</robot>", f"{DRIVE}</robot>")
"""Going by the source, the wheel is driven and the caster is passive."""
CLUTCH = urdfs.robot(
    *urdfs.links(base=1, ring=None, arm=1),
    urdfs.joint("first", "continuous", "base", "ring", axis="0 0 1"),
    urdfs.joint("second", "continuous", "ring", "arm", axis="0 0 1", xyz="0 0 0.3", rpy="0 0 0"),
)
"""Two joints on one axis, and nothing between them."""
BOB = urdfs.robot(*urdfs.links(base=None, bob=1), urdfs.joint("pivot", "ball", "base", "bob"))
POINT = re.sub(r'\b(i..)="[^"]*"', r'\1="0"', BOB)
"""A pendulum on a ball, and one whose mass is a point."""


def passive_warnings(urdf: str, **options: Any) -> list[Diagnostic]:
    found = DOMAIN.read(urdf.encode(), "own.urdf", Options(**options)).diagnostics
    return [one for one in found if one.code == "passive-moves-no-mass"]


def test_a_caster_without_a_mass_is_named_with_its_line_and_what_to_do() -> None:
    (found,) = passive_warnings(CART)
    assert found.severity is Severity.WARNING
    assert str(found) == (
        "own.urdf:7: warning: joint 'caster' is not driven and moves no mass at its start, so nothing determines "
        "its motion in Run and Test; give a link behind the joint an <inertial>, drive the joint "
        "(`driven`), or make it fixed [passive-moves-no-mass]"
    )


@pytest.mark.parametrize(
    ("urdf", "options", "names"),
    [
        (CART, {"driven": ("wheel", "caster")}, []),
        (CART, {"driven": ("caster",)}, []),
        (CART, {"driven": ("wheel",)}, ["caster"]),
        (CART, {"approach": RECORD}, []),
        (CART, {"approach": BOTH}, ["caster"]),
        (BOB, {}, []),
        (BOB, {"approach": RECORD}, []),
        (POINT, {}, ["pivot"]),
        (CLUTCH, {"driven": ()}, ["first"]),
        (CLUTCH, {"driven": ("first",)}, []),
        (CLUTCH, {"driven": ("second",)}, []),  # it does not undo the motion of the first one
    ],
)
def test_what_is_driven_counts_and_so_does_the_approach(urdf: str, options: dict[str, Any], names: list[str]) -> None:
    assert [found.message.split("'")[1] for found in passive_warnings(urdf, **options)] == names


SERVO = urdfs.robot(
    *urdfs.links(base=1, arm=1),
    urdfs.joint("lift", "continuous", "base", "arm", axis="0 1 0"),
    '<ros2_control name="c"><joint name="lift"><command_interface name="position"><param name="position_gain">5</param>'
    "</command_interface></joint></ros2_control>",
)
SENSING = STATUE.replace("</robot>", '<gazebo reference="head"><sensor name="imu" type="imu"/></gazebo></robot>')


@pytest.mark.parametrize(("text", "options", "message"), [
    (SENSING, {}, "the record approach has no sensors (imu)"),
    (SENSING, {"drives": "motor"}, "the record approach has no sensors (imu) and no flanges of motors"),
    (SENSING, {"approach": ("package", "record")}, None),
    (STATUE, {}, None),
    (SERVO, {}, "the record approach has no laws of drives (lift)"),
    (SERVO, {"commands": {"lift": "position"}}, None),
])  # fmt: skip
def test_what_the_record_approach_leaves_out_is_a_note(text: str, options: dict[str, Any], message: str | None) -> None:
    reading = DOMAIN.read(text.encode(), "own.urdf", Options(**{"approach": ("record",), **options}))
    found = [one for one in reading.diagnostics if one.code == "not-in-record"]
    assert [one.message for one in found] == ([message] if message else [])
