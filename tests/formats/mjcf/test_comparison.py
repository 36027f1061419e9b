"""The comparison of a URDF with its MJCF sees each wrong number."""

from __future__ import annotations

import re

import pytest
from support.mjcf_schema import NEEDS_ARMATURE
from support.mjcfs import ARM, body, document, stl, urdf, world

from urdfsync.formats.mjcf.comparison import compare

ROBOTS = {
    "arm": ARM,
    "several joints": body(
        '<joint type="slide" pos="1 1 1" ref="0.1"/><joint pos="0.1 0.2 0.3" axis="1 1 0" ref="9"/>'
    ),
    "springs": body(
        '<joint type="slide" ref="0.1" stiffness="30" springref="0.3"/>'
        '<joint axis="0 1 0" ref="20" stiffness="2" springref="-5"/>'
    ),
    "ball": body('<joint type="ball" pos="0.1 0 0.2"/><body pos="1 0 0"><joint pos="0 1 0"/><geom size="0.1"/></body>'),
    "floating": body('<freejoint/><body name="leg" euler="10 20 30"><joint damping="1"/><geom size="0.1"/></body>'),
    "left out": body(
        '<joint name="f" type="free" armature="1"/><body><joint name="j"/><geom size="0.1"/></body>'
    ).replace(
        "</mujoco>",
        '<actuator><motor joint="j"/></actuator><option><flag gravity="disable"/></option></mujoco>',
    ),
    "motor with armature": body('<joint name="j"/>').replace(
        "</mujoco>", '<actuator><motor joint="j" armature="2"/></actuator></mujoco>'
    ),
    "ball with friction": body('<joint type="ball" frictionloss="1" stiffness="2"/>', '<size memory="3G"/>'),
    "massless": body('<joint/><body name="hand" pos="0 0 1" quat="1 1 0 0"/><site name="tip" pos="1 0 0"/>'),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=NEEDS_ARMATURE if "motor" in name else ()) for name in ROBOTS]
)
def test_a_translation_agrees_with_its_source(name: str) -> None:
    compared, differences = compare(document(ROBOTS[name]), urdf(ROBOTS[name]))
    assert compared > 50
    assert differences == ()


PAIR = '<body name="b"><joint name="a"/>{}<body name="c"><joint name="d" axis="0 1 0"/>{}</body></body>'
FOLLOWING = '<equality><joint joint1="d" joint2="a" polycoef="0 2 0 0 0"/></equality>'
TENDON = '<tendon><fixed name="t"><joint joint="a" coef="0.5"/><joint joint="d" coef="0.5"/></fixed></tendon>'


@pytest.mark.parametrize(
    ("motors", "effort"),
    [
        ('<motor joint="a" ctrlrange="-2 3" gear="10"/>', "30.0"),
        ('<motor joint="a" ctrlrange="-9 9" forcerange="-2 2" gear="-10"/>', "20.0"),
        ('<position joint="a" kp="50" ctrlrange="-1 1" forcerange="-4 4"/>', "4.0"),
        ('<intvelocity joint="a" kp="5" actrange="-1 1" forcerange="-3 3"/>', "3.0"),
        ('<general joint="a" gainprm="40" biasprm="0 -40 -2" biastype="affine" forcerange="-7 7"/>', "7.0"),
        ('<general joint="a" gainprm="4" dyntype="filter" dynprm="0.1" ctrlrange="-2 1"/>', "8.0"),
        ('<motor joint="a" ctrlrange="-2 2"/><motor joint="a" gear="-3" ctrlrange="-2 2"/>', "8.0"),
        ('<motor tendon="t" forcerange="-4 4"/>', "6.0"),
    ],
)
def test_the_greatest_effort_of_motors_is_compared(motors: str, effort: str) -> None:
    """A motor of a tendon also pushes the joint that moves twice as far."""
    geom = '<geom size="0.1"/>'
    parts = f"{FOLLOWING}{TENDON}" if "tendon" in motors else ""
    text = world(PAIR.format(geom, geom)).replace("</mujoco>", f"{parts}<actuator>{motors}</actuator></mujoco>")
    written = urdf(text)
    assert compare(document(text), written)[1] == ()
    wrong = written.replace(f'effort="{effort}"', f'effort="{float(effort) * 1.001!r}"')
    assert compare(document(text), wrong)[1] == ("greatest effort of joint a differs by 1.0e-03",)


@pytest.mark.parametrize(
    ("old", "new", "quantities"),
    [
        ('mass value="1.5"', 'mass value="1.50001"', {"mass", "bias", "mass matrix"}),
        ('xyz="0.0 0.0 0.4"', 'xyz="0.0 0.0 0.40001"', {"centre of mass", "bias", "mass matrix"}),
        ('iyy="0.02"', 'iyy="0.020001"', {"mass matrix"}),
        ('damping="2.0"', 'damping="2.1"', {"damping"}),
        ('armature="0.1"', 'armature="0.11"', {"mass matrix"}),
        ('spring_stiffness="4.0"', 'spring_stiffness="4.1"', {"spring force"}),
        ('spring_stiffness="4.0"', 'spring_stiffness="4.0" spring_reference="0.1"', {"spring force"}),
        (
            'axis xyz="0.0 1.0 0.0"',
            'axis xyz="0.0 -1.0 0.0"',
            {"axis", "orientation", "centre of mass", "bias", "mass matrix"},
        ),
        ('upper="1.5707963267948966"', 'upper="1.57"', {"range"}),
        ("0.523598775598299", "0.5236", {"axis", "orientation", "centre of mass", "bias", "mass matrix"}),
    ],
)
def test_a_wrong_number_is_told(old: str, new: str, quantities: set[str]) -> None:
    text = urdf(ARM)
    assert old in text
    _, differences = compare(document(ARM), text.replace(old, new, 1))
    assert {
        each.partition(" of ")[0] if "centre" not in each else "centre of mass" for each in differences
    } <= quantities
    assert differences


SHAPES = """\
<mujoco><asset><mesh name="m" file="m.stl" scale="1 2 -1" refpos="1 0 0"/>
<mesh name="turned" file="m.stl" scale="1 2 3" refquat="0.7 0.1 0.3 0.2"/></asset><worldbody>
<body name="part"><joint pos="0.5 0 0"/><inertial pos="0 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>
<geom type="box" size="0.1 0.2 0.3" pos="1 2 3" euler="10 20 30"/>
<geom type="sphere" size="0.25" group="3"/>
<geom type="ellipsoid" size="0.1 0.2 0.4" contype="0" conaffinity="0"/>
<geom type="capsule" size="0.125 0.75" fromto="0 0 0 0 1 1"/>
<geom type="cylinder" size="0.375 0.5"/>
<geom type="mesh" mesh="m" pos="1 2 3" euler="10 20 30"/>
<geom type="mesh" mesh="turned"/>
</body></worldbody></mujoco>
"""
FILES = {"m.stl": stl(), "other.stl": stl(2)}


def test_shapes_agree_with_their_source() -> None:
    """MuJoCo centres the mesh, and lays the capsule along a line; URDF can't turn what it scales."""
    compared, differences = compare(document(SHAPES, FILES), urdf(SHAPES, FILES))
    assert differences == ()
    without = SHAPES[: SHAPES.index("<geom")] + SHAPES[SHAPES.index("</body>") :]
    assert (
        compared - compare(document(without, FILES), urdf(without, FILES))[0]
        == 2 * (15 + 13 + 15 + 14 + 14 + 12) - 13 - 15
    )


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            'size="0.2 0.4 0.6"',
            'size="0.2 0.4 0.3"',
            "visual of link part is a box of 0.2 0.4 0.3 at 0.5 2 3 turned by ",
        ),
        (
            'sphere radius="0.25"',
            'sphere radius="0.5"',
            "collision of link part is a sphere of 0.5 at -0.5 0 0 turned by ",
        ),
        ('radii="0.1 0.2 0.4"', 'radii="0.1 0.2 0.4000001"', "visual of link part is a ellipsoid of 0.1 0.2 0.4000001"),
        ('length="1.0"', 'length="0.5"', "visual of link part is a cylinder of 0.375 0.5 at -0.5 0 0 turned by "),
        ("cylinder radius", "capsule radius", "visual of link part is a capsule of 0.375 1 at -0.5 0 0 turned by "),
        (
            'xyz="0.5 2.0 3.0"',
            'xyz="0.5 2.0 3.00001"',
            "visual of link part is a box of 0.2 0.4 0.6 at 0.5 2 3.00001 turned by ",
        ),
        ('rpy="0.331', 'rpy="0.441', "visual of link part is a box of 0.2 0.4 0.6 at 0.5 2 3 turned by 0.44175"),
        ('scale="1.0 2.0 -1.0"', 'scale="1.0 2.0 -1.0001"', "visual of link part is a mesh of "),
        ('scale="1.0 2.0 -1.0"', 'scale="1.0 2.0 1.0"', "visual of link part is a mesh of "),
        ('filename="m.stl"', 'filename="none.stl"', "visual of link part is absent, and in MuJoCo a mesh of "),
        ('<sphere radius="0.25"/>', "<cone/>", "collision of link part is absent, and in MuJoCo a sphere of 0.25 at "),
    ],
)
def test_a_wrong_shape_is_told_with_its_place(old: str, new: str, words: str) -> None:
    text = urdf(SHAPES, FILES)
    assert old in text
    _, differences = compare(document(SHAPES, FILES), text.replace(old, new, 1))
    assert [each.partition(words)[0] for each in differences] == ["the "]
    assert " in MuJoCo a " in differences[0]
    assert re.search(r" \(arm\.xml:\d\)$", differences[0])
