"""Nothing of an MJCF is left out silently: what acts on the robot is an error, what has no effect is noted."""

from __future__ import annotations

import mujoco
import pytest
from support.mjcf_schema import NEEDS_ARMATURE
from support.mjcfs import SOURCE, body, document, left_out, noted, read, reading, urdf, world

from urdfsync.formats.mjcf.urdf import translated
from urdfsync.formats.urdf.parse.source import read_robot

SITES = '<site name="s" pos="0 0 1"/><site name="t"/>'


@pytest.mark.parametrize(
    ("inside", "outside", "what"),
    [
        ('<joint name="j" type="ball" stiffness="3"/>', "", "spring j"),
        ('<joint name="j" stiffness="3"/>', '<option><flag spring="disable"/></option>', "disabled flag spring"),
        ('<joint name="j" type="ball" range="0 1"/>', "", "range, armature or friction of a ball j"),
        ('<joint name="j" type="ball" armature="1"/>', "", "range, armature or friction of a ball j"),
        ('<joint name="j" type="free" damping="1"/>', "", "losses of a free joint j"),
        ("<joint/>", '<option gravity="0 0 0"/>', "gravity 0 0 0"),
        ("<joint/>", '<option><flag gravity="disable"/></option>', "disabled flag gravity"),
        ("<joint/>", '<option><flag constraint="disable"/></option>', "disabled flag constraint"),
        ("<freejoint/>", '<option><flag contact="disable"/></option>', "disabled flag contact"),
        (
            "<freejoint/>",
            '<contact><exclude body1="world" body2="part"/></contact>',
            "contact without the ground",
        ),
        ("<joint/>", '<option density="1.2"/>', "density of option"),
        pytest.param(
            '<joint name="j"/>',
            '<actuator><motor name="m" joint="j" armature="1"/></actuator>',
            "armature of actuator m",
            marks=NEEDS_ARMATURE,
        ),
        (
            f"<joint/>{SITES}",
            '<tendon><spatial name="p" limited="true" range="0 1"><site site="s"/><site site="t"/></spatial></tendon>',
            "tendon p",
        ),
        (
            '<joint name="j"/>',
            '<tendon><fixed name="p" damping="1"><joint joint="j" coef="1"/></fixed></tendon>',
            "tendon p",
        ),
        (
            '<joint/><geom name="g" size="0.1"/><geom name="h" size="0.1"/>',
            '<contact><pair name="p" geom1="g" geom2="h"/></contact>',
            "contact pair p",
        ),
    ],
)
def test_what_acts_on_the_robot_otherwise_is_left_out_with_an_error(inside: str, outside: str, what: str) -> None:
    text = body(inside).replace("</mujoco>", f"{outside}</mujoco>")
    assert left_out(text) == [what]
    read(text)  # with `allow`, it is a warning


def test_gravity_has_its_line() -> None:
    text = body("<joint/>", '<option timestep="0.1"/>\n<option gravity="0 0 -1"/>\n')
    (finding,) = [
        each for each in read_robot(urdf(text).encode(), SOURCE).diagnostics if each.severity.value == "error"
    ]
    _, places = translated(document(text))
    assert [line for number, _, line in places if number <= finding.line][-1] == 3


def test_margins_are_noted() -> None:
    assert noted(body('<joint range="-1 1" margin="0.2"/>')) == "not modelled: 1 <margin>"
    assert noted(body('<joint/><geom size="0.1" margin="0.2"/>')) == ""


def test_a_speed_at_home_is_noted_at_its_line() -> None:
    key = '\n<keyframe>\n<key name="home" qvel="1"/></keyframe></mujoco>'
    text = body("<joint/>").replace("</mujoco>", key)
    (found,) = reading(text).unmodelled
    written, places = translated(document(text))
    assert written.split("\n")[found.line - 1].strip() == '<qvel name="home"/>'
    assert [line for number, _, line in places if number <= found.line][-1] == 4


def test_a_pose_at_home_that_is_no_number_of_a_joint_is_noted() -> None:
    key = '<keyframe><key name="home" qpos="0 1 0 0"/></keyframe></mujoco>'
    assert noted(body('<joint type="ball"/>').replace("</mujoco>", key)) == "not modelled: 1 <qpos>"


def test_gravity_compensation_is_left_out_with_an_error() -> None:
    inertial = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    assert left_out(world(f'<body name="a" gravcomp="1"><joint/>{inertial}</body>')) == ["gravcomp of body a"]


def test_a_tendon_without_effect_is_only_drawn() -> None:
    spatial = '<tendon><spatial name="p"><site site="s"/><site site="t"/></spatial></tendon>'
    assert left_out(body(f"<joint/>{SITES}").replace("</mujoco>", f"{spatial}</mujoco>")) == []


def test_what_only_draws_is_noted() -> None:
    assets = (
        '<asset><texture name="t" file="absent.png"/><skin file="absent.skn"/><material name="m" texture="t"/></asset>'
    )
    keys = '<keyframe><key name="other" qpos="1"/></keyframe>'
    text = body('<joint/><light pos="0 0 1"/><camera name="eye"/><geom size="0.1" material="m"/>', assets)
    text = text.replace("</mujoco>", f"{keys}</mujoco>")
    assert noted(text) == "not modelled: 1 <texture>, 1 <skin>, 1 <light>, 1 <camera>, 1 <group_state>"


def test_terrain_is_noted() -> None:
    asset = '<asset><hfield name="hills" file="absent.png" size="1 1 1 1"/></asset>'
    ground = '<worldbody><geom name="floor" type="hfield" hfield="hills"/>'
    text = body('<joint/><geom name="foot" size="0.1"/>', asset).replace("<worldbody>", ground)
    touch = '<contact><exclude body1="world" body2="part"/></contact></mujoco>'
    assert noted(text.replace("</mujoco>", touch)) == "not modelled: 1 <hfield>, 1 <exclude>"


def test_a_body_beside_the_robot_is_noted() -> None:
    table = '<body name="table"><geom size="1"/></body><body name="cube"><freejoint/><geom size="0.1"/></body>'
    assert noted(body("<joint/>").replace("<worldbody>", f"<worldbody>{table}")) == "not modelled: 2 <body>"


def test_a_constraint_that_gives_way_is_noted() -> None:
    assert noted(body('<joint range="-1 1" solreflimit="0.1 1"/>')) == "not modelled: 1 <solreflimit>"


def test_gravity_of_two_decimals_is_noted() -> None:
    text = body("<joint/>", '<option gravity="0 0 -9.8"/>')
    assert (left_out(text), noted(text)) == ([], "not modelled: 1 <gravity>")


def grounded(floor: str, foot: str) -> str:
    """A floating ball above a floor."""
    ground = f'<worldbody><geom name="floor" type="plane" size="1 1 1" {floor}/>'
    return body(f'<freejoint/><geom name="foot" size="0.1" {foot}/>').replace("<worldbody>", ground)


@pytest.mark.parametrize(
    ("floor", "foot", "friction"),
    [
        ("", 'friction="0.3"', 1.0),  # the greater one
        ('friction="0.2"', 'friction="0.3"', 0.3),
        ('friction="0.2" priority="1"', 'friction="0.3"', 0.2),
        ("", 'friction="0.3" priority="1"', 0.3),
        ('contype="2" conaffinity="2"', 'friction="0.3"', None),
        ('contype="2" conaffinity="2"', 'conaffinity="2" friction="1.5"', 1.5),
    ],
)
def test_a_foot_touches_the_floor_as_in_mujoco(floor: str, foot: str, friction: float | None) -> None:
    """With the friction of both, and only if their bits meet."""
    (part,) = read(grounded(floor, foot)).links
    assert len(part.collisions) == (friction is not None)
    assert (part.contact.mu if part.contact else None) == friction


@pytest.mark.parametrize(
    ("floor", "note"), [("", ""), ('euler="0 20 0"', "not modelled: 1 <ground>"), ('pos="0 0 -1"', "")]
)
def test_a_slope_is_noted(floor: str, note: str) -> None:
    assert noted(grounded(floor, "")) == note


def test_a_moving_floor_acts_on_the_robot() -> None:
    if "surfacevel" in mujoco.mj_printSchema(flg_html=False, flg_pad=False):  # since MuJoCo 4
        assert left_out(grounded('surfacevel="1 0 0 0 0 0"', "")) == ["surfacevel of geom floor"]


def test_contacts_of_another_body_with_the_ground_are_its_own() -> None:
    exclude = '<contact><exclude body1="world" body2="ball"/></contact></mujoco>'
    ball = '<body name="ball"><freejoint/><geom size="0.1"/></body></worldbody>'
    text = body('<freejoint/><body name="leg"><joint/><geom size="0.1"/></body>')
    text = text.replace("</worldbody>", ball).replace("</mujoco>", exclude)
    assert "left_out" not in urdf(text, robot="part")
