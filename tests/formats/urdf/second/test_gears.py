"""Gears of transmissions, read twice: by the positions of the motors, and by those of the joints."""

from __future__ import annotations

import dataclasses

import pytest
from msgspec.structs import replace
from support.numbers import BOT, differences, of_package
from support.packages import generate
from support.urdfs import joint, links, parsed, robot

SIMPLE = {
    "<actuator name='m'><mechanicalReduction>50</mechanicalReduction></actuator>": True,
    "<mechanicalReduction>-2</mechanicalReduction>": True,
    "<actuator><drake:gear_ratio value='9'/><drake:rotor_inertia value='1e-4'/></actuator>": True,
    "<mechanicalReduction>0</mechanicalReduction>": False,
    "<mechanicalReduction>1_000</mechanicalReduction>": False,
}


@pytest.mark.parametrize("inside", SIMPLE)
def test_both_readers_find_the_same_gear(inside: str) -> None:
    text = robot(
        *links(base=1.0, arm=1.0),
        joint("elbow", "continuous", "base", "arm"),
        f"<transmission name='t'><joint name='elbow'><offset>0</offset></joint>{inside}</transmission>",
    )
    (elbow,) = parsed(text).joints
    assert (elbow.transmission is not None) == SIMPLE[inside]
    assert differences(text.encode()) == []


ROLES = "<{0} name='elbow'><role>{0}1</role><mechanicalReduction>{1}</mechanicalReduction>{3}</{0}>\
<{0} name='wrist'><role>{0}2</role><mechanical_reduction>{2}</mechanical_reduction></{0}>"
PARTS = ROLES.format("joint", 2, -3, "<offset>0.5</offset>") + ROLES.format(
    "actuator", 10, -7, "<drake:rotor_inertia value='1e-4'/>"
)
WRIST = """<rightActuator name='r' mechanicalReduction='60'/><leftActuator name='l' mechanicalReduction='50'/>
  <flexJoint name='elbow' mechanicalReduction='-1'/><rollJoint name='wrist' mechanicalReduction='2' offset='0.3'/>"""
SHARED = {
    "DifferentialTransmission": PARTS,
    "FourBarLinkageTransmission": PARTS,
    "WristTransmission": WRIST,
    "UnknownTransmission": PARTS,
    "three actuators: WristTransmission": f"{WRIST}<leftActuator name='l'/>",
}


@pytest.mark.parametrize("kind", SHARED)
@pytest.mark.parametrize("joint_type", ["continuous", "fixed"])
def test_both_readers_find_the_same_gears_of_two_joints(kind: str, joint_type: str) -> None:
    text = robot(
        *links(base=1.0, arm=1.0, hand=1.0),
        joint("elbow", "continuous", "base", "arm"),
        joint("wrist", joint_type, "arm", "hand"),
        f'<transmission name="t"><type>interface/{kind.rpartition(" ")[2]}</type>{SHARED[kind]}</transmission>',
    )
    geared = any(each.transmission for each in parsed(text).joints)
    assert geared == ((joint_type == "continuous" and "Unknown" not in kind and ":" not in kind) or "FourBar" in kind)
    assert differences(text.encode()) == []


PAIR = robot(
    *links(base=1.0, arm=1.0, hand=1.0),
    joint("elbow", "continuous", "base", "arm"),
    joint("wrist", "continuous", "arm", "hand"),
    f'<transmission name="t"><type>DifferentialTransmission</type>{PARTS}</transmission>',
).encode()


@pytest.mark.parametrize(("old", "new", "quantity"), [
    ("</role><mechanical_reduction>-3<", "</role><mechanical_reduction>3<", "transmission.otherReduction"),
    (">DifferentialT", ">FourBarLinkageT", "transmission.otherReduction"),
    ("<offset>0.5<", "<offset>-0.5<", "transmission.offset"),
    ("'1e-4'", "'1e-3'", "transmission.rotorInertia"),
])  # fmt: skip
def test_gears_that_are_read_otherwise_are_found(old: str, new: str, quantity: str) -> None:
    assert old in PAIR.decode()
    package = generate(PAIR.decode().replace(old, new).encode(), BOT)
    found = of_package(package, PAIR, package.texts).differences
    assert quantity in {each.quantity for each in found}
    lines = {each.source_line for each in found if each.quantity != "otherJoint"}
    assert lines == {PAIR[: PAIR.index(b"<transmission")].count(b"\n") + 1}


def test_a_gear_at_another_joint_is_found() -> None:
    elbow, wrist = parsed(PAIR.decode()).joints
    assert elbow.transmission is not None
    wrong = replace(elbow, transmission=replace(elbow.transmission, joint="elbow"))
    own = generate(PAIR, BOT)
    package = dataclasses.replace(own, robot=replace(own.robot, joints=(wrong, wrist)))
    (found,) = of_package(package, PAIR, package.texts).differences
    assert (found.element, found.quantity, found.expected, found.given) == (
        *("joint elbow", "otherJoint", "wrist", "elbow"),
    )
