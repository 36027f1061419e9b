"""A generated mobile robot on the ground: its wheels rest on their collision shapes, and stay there while they roll."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import modelica
from support.modelica import Run, Series, Task
from support.packages import generate

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

RADIUS = 0.12
MILLIMETRE = 1e-3

INERTIAL = """<inertial><origin xyz="{at}"/><mass value="{mass}"/>
  <inertia ixx="{i}" iyy="{i}" izz="{i}" ixy="0" ixz="0" iyz="0"/></inertial>"""

WHEEL = f"""<link name="{{side}}">{INERTIAL.format(at="0 0 0", mass=1.5, i=0.01)}
  <collision><origin rpy="1.5707963267948966 0 0"/>
    <geometry><cylinder radius="{RADIUS}" length="0.05"/></geometry></collision></link>
<joint name="drive_{{side}}" type="continuous"><parent link="chassis"/><child link="{{side}}"/>
  <origin xyz="0.05 {{y}} 0"/><axis xyz="0 1 0"/></joint>"""

CART = f"""<robot name="cart"><link name="chassis">{INERTIAL.format(at="0.03 0 0.05", mass=12, i=0.3)}
  <collision><origin xyz="0 0 0.1"/><geometry><box size="0.5 0.3 0.1"/></geometry></collision></link>
{WHEEL.format(side="left", y=0.2)}{WHEEL.format(side="right", y=-0.2)}
<link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="ball_mount" type="fixed"><parent link="chassis"/><child link="ball"/><origin xyz="-0.2 0 -0.07"/></joint>
</robot>"""

HEIGHTS = {f"robot.{wheel}.frame_a.r_0[3]": RADIUS for wheel in ("left", "right")} | {"robot.ball.frame_a.r_0[3]": 0.05}

TURNED = [f"robot.drive_{wheel}Axis.phi" for wheel in ("left", "right")]


@pytest.fixture(scope="module")
def rolling(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Series:
    """Three seconds of the Test model: at rest in the beginning, then both wheels turn forwards."""
    package = generate(CART.encode(), Target("Cart", "Cart"), base="floating")
    folder = package.write(tmp_path_factory.mktemp("cart"))
    values = [*HEIGHTS, "robot.chassis.frame_a.r_0[1]", *TURNED]
    probe = modelica.compile_task("Cart.CartTest")
    (series,) = modelica.simulate(modelica_library, [folder], [Task(probe.source, probe.model, [Run(3, 0.1)], values)])
    return series


@pytest.mark.parametrize("value", HEIGHTS)
def test_wheels_and_ball_stand_on_their_shapes_all_the_time(rolling: Series, value: str) -> None:
    assert np.abs(rolling.values[value] - HEIGHTS[value]).max() < MILLIMETRE


def test_the_cart_goes_as_far_as_its_wheels_roll(rolling: Series) -> None:
    turned = np.mean([rolling.values[name] for name in TURNED], axis=0)
    gone = rolling.values["robot.chassis.frame_a.r_0[1]"]
    assert turned[-1] > 0.5
    assert gone[-1] == pytest.approx(RADIUS * turned[-1], rel=0.02)
