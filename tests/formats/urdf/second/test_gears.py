"""Gears of transmissions that are read otherwise; tests of the first reader compare the same gears."""

from __future__ import annotations

import dataclasses

import pytest
from msgspec.structs import replace
from support.numbers import BOT, differences, of_package
from support.packages import generate
from support.urdfs import joint, links, parsed, robot

ROLES = "<{0} name='elbow'><role>{0}1</role><mechanicalReduction>{1}</mechanicalReduction>{3}</{0}>\
<{0} name='wrist'><role>{0}2</role><mechanical_reduction>{2}</mechanical_reduction></{0}>"
PARTS = ROLES.format("joint", 2, -3, "<offset>0.5</offset>") + ROLES.format(
    "actuator", 10, -7, "<drake:rotor_inertia value='1e-4'/>"
)
PAIR = robot(
    *links(base=1.0, arm=1.0, hand=1.0),
    joint("elbow", "continuous", "base", "arm"),
    joint("wrist", "continuous", "arm", "hand"),
    f'<transmission name="t"><type>DifferentialTransmission</type>{PARTS}</transmission>',
).encode()


def test_a_linkage_has_a_gear_at_its_first_joint_even_if_the_second_is_fixed() -> None:
    text = PAIR.replace(b">DifferentialT", b">FourBarLinkageT").decode()
    text = text.replace('<joint name="wrist" type="continuous"', '<joint name="wrist" type="fixed"')
    assert [joint.transmission is not None for joint in parsed(text).joints] == [True, False]
    assert differences(text.encode()) == []


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
