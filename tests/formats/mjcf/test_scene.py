"""MuJoCo's own findings keep their lines, and a model with several robots asks which one is meant."""

from __future__ import annotations

import mujoco
import pytest
from support.mjcfs import body, problem, read, world

TWO = world("".join(f'<body name="{name}"><joint/><geom size="0.1"/></body>' for name in ("left", "right")))
CUBE = '<body name="cube"><freejoint/><geom size="0.1"/></body>'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            body('\n<joint quantum="3"/>'),
            "arm.xml:3: MuJoCo: Schema violation: unrecognized attribute: 'quantum', element",
        ),
        (body('<joint name="j"/>\n<joint name="j"/>'), "arm.xml:3: MuJoCo: repeated name 'j' in joint"),
        (body('\n<joint axis="0 0 0"/>'), "arm.xml:3: MuJoCo: axis too small"),
        (
            world('\n<body name="a"><joint/></body>'),
            "arm.xml:3: MuJoCo: mass and inertia of moving bodies must be larger",
        ),
        ("<mujoco/>", "arm.xml:1: the model has no body; name the file that has the robot"),
        (world('<body><geom size="1"/></body>'), "arm.xml:1: the model has no joint: nothing in it moves"),
    ],
)
def test_a_fault_has_a_line(text: str, told: str) -> None:
    assert problem(text).startswith(told)


def test_a_newer_format_is_told() -> None:
    assert problem(body("<wormhole/>")).endswith(f"correct it: MuJoCo {mujoco.__version__} does not know it")
    assert "does not know" not in problem(body("<joint/><geom/>"))


def test_a_model_with_two_robots_asks_which() -> None:
    told = problem(TWO)
    assert told.startswith("arm.xml:1: the model has 2 robots: 'left', 'right'; choose one by `arguments = { body = ")
    assert [each.name for each in read(TWO, robot="right").links] == ["world", "right"]
    assert [each.name for each in read(TWO, robot="world").links] == ["world", "left", "right"]
    assert problem(TWO, robot="rigt").endswith("there is no body 'rigt' below the world; perhaps 'right' is meant")


@pytest.mark.parametrize(
    "equality",
    [
        '<connect body1="left" body2="right" anchor="0 0 0"/>',
        '<weld site1="s" site2="t"/>',
        '<joint joint1="a" joint2="b"/>',
    ],
)
def test_bodies_that_an_equality_joins_are_one_robot(equality: str) -> None:
    left = '<body name="left"><joint name="a"/><geom size="0.1"/><site name="s"/></body>'
    right = '<body name="right"><joint name="b"/><geom size="0.1"/><site name="t"/></body>'
    text = world(left + right).replace("</mujoco>", f"<equality>{equality}</equality></mujoco>")
    robot = read(text)
    assert {each.name for each in robot.links} == {"world", "left", "right", "s", "t"}
    assert robot.loops or any(joint.mimic for joint in robot.joints)
    alone = text.replace("<equality>", "<equality>").replace("/></equality>", ' active="false"/></equality>')
    assert "the model has 2 robots" in problem(alone)


def test_a_loose_object_is_no_robot_beside_one() -> None:
    assert [each.name for each in read(body("<joint/>").replace("<worldbody>", f"<worldbody>{CUBE}")).links] == [
        *("world", "part")
    ]
    assert [each.name for each in read(world(CUBE)).links] == ["cube"]
