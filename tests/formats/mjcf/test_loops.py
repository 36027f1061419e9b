"""Equalities of two bodies become loops, with their frames where MuJoCo has them."""

from __future__ import annotations

import pytest
from support.mjcfs import left_out, read, world

FOUR_BAR = """
<body name="crank" pos="0 0 0"><joint name="j1" axis="0 1 0"/>
  <geom type="capsule" size="0.02" fromto="0 0 0 0 0 0.2"/>
  <body name="bar" pos="0 0 0.2"><joint name="j2" axis="0 1 0"/>
    <geom type="capsule" size="0.02" fromto="0 0 0 0.5 0 0"/>
    <site name="end" pos="0.5 0 0"/>
  </body>
</body>
<body name="rocker" pos="0.5 0 0"><joint name="j3" pos="0 0 0" axis="0 1 0"/>
  <geom type="capsule" size="0.02" fromto="0 0 0 0 0 0.2"/><site name="top" pos="0 0 0.2"/>
</body>
"""


def loop_of(equality: str) -> object:
    (loop,) = read(
        world(FOUR_BAR).replace("</mujoco>", f"<equality>{equality}</equality></mujoco>"), None, "world"
    ).loops
    return loop.name, loop.kind, loop.parent, loop.child, loop.origin.xyz, pytest.approx(loop.child_origin.xyz)


@pytest.mark.parametrize("ends", ['body1="bar" body2="rocker" anchor="0.5 0 0"', 'site1="end" site2="top"'])
def test_a_connect_is_a_ball(ends: str) -> None:
    assert loop_of(f'<connect name="c" {ends}/>') == ("c", "ball", "bar", "rocker", (0.5, 0, 0), (0, 0, 0.2))


def test_a_weld_is_a_fixed_loop() -> None:
    assert loop_of('<weld body1="bar" body2="rocker"/>') == (
        *("bar_to_rocker", "fixed", "bar", "rocker"),
        *((0.5, 0, -0.2), (0, 0, 0)),
    )


def test_a_weld_has_its_point_in_both_bodies() -> None:
    """At the start, MuJoCo's constraint is closed wherever the anchor is."""
    assert loop_of('<weld body1="bar" body2="rocker" anchor="0 0 0.1"/>') == (
        *("bar_to_rocker", "fixed", "bar", "rocker"),
        *((0.5, 0, -0.1), (0, 0, 0.1)),
    )


def test_an_equality_with_another_robot_is_left_out() -> None:
    other = '<body name="other"><freejoint/><geom size="0.1"/></body>'
    arm = '<body name="a"><joint/><geom size="0.1"/></body>'
    text = world(arm + other).replace(
        "</mujoco>", '<equality><weld name="w" body1="a" body2="other"/></equality></mujoco>'
    )
    assert left_out(text) == ["equality with a body outside of the robot w"]
