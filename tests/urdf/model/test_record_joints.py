"""What the record of a whole robot says of a joint: every group that it has, defaults and absences included."""

from __future__ import annotations

import re
from typing import Any

import pytest
from support.records import record_components
from support.skeletons import skeleton

from urdfsync.urdf.robot import Calibration, Dynamics, Joint, JointType, Limit, Mimic, Origin, SafetyController

EVERYTHING: dict[str, Any] = {
    "limit": Limit(-1, 2, 30, None),
    "dynamics": Dynamics(0.5, 0),
    "mimic": Mimic("leader", -2, 0.1),
    "calibration": Calibration(rising=0.25),
    "safety_controller": SafetyController(10, 20, -0.5, 1.5),
}
REST = {
    "dynamics": "damping = 0.5, friction = 0",
    "mimic": "multiplier = -2, offset = 0.1",
    "calibration": "rising = 0.25, falling = Modelica.Constants.inf",
    "safetyController": "k_velocity = 10, k_position = 20, soft_lower_limit = -0.5, soft_upper_limit = 1.5",
}
UNLIMITED = ", ".join(
    f"{name} = {sign}Modelica.Constants.inf"
    for name, sign in (("lower", "-"), ("upper", ""), ("velocity", ""), ("effort", ""))
)


def groups(kind: JointType, **parts: Any) -> dict[str, str]:
    """The groups of numbers of a joint, without its origin."""
    joints = (Joint("leader", "revolute", "a", "l"), Joint("j", kind, "a", "b", **parts))
    _, text = record_components(skeleton(*joints))["j"]
    found = {name: numbers.strip() for name, numbers in re.findall(r"(\w+)\(([^()]*)\)", text)}
    assert found.pop("origin") == "xyz = {0, 0, 0}, rpy = {0, 0, 0}"
    return found


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_joint_with_limits_has_all_its_groups(kind: JointType) -> None:
    limits = "lower = -1, upper = 2, velocity = Modelica.Constants.inf, effort = 30"
    assert groups(kind, **EVERYTHING) == {"limits": limits, **REST}


def test_a_continuous_joint_has_no_position_limits() -> None:
    limits = UNLIMITED.replace("effort = Modelica.Constants.inf", "effort = 30")
    assert groups("continuous", **EVERYTHING) == {"limits": limits, **REST}


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "continuous"])
def test_what_is_not_stated_is_unlimited_or_left_out(kind: JointType) -> None:
    assert groups(kind) == {"limits": UNLIMITED}


def test_a_planar_joint_loses_energy_in_both_kinds_of_motion() -> None:
    losses = "damping = 0.5, friction = 0"
    assert groups("planar", **EVERYTHING) == {"translation": losses, "rotation": losses}
    assert groups("planar") == {}


@pytest.mark.parametrize("kind", ["fixed", "floating"])
def test_joints_without_an_axis_have_no_groups(kind: JointType) -> None:
    assert groups(kind, **EVERYTHING) == {}


@pytest.mark.parametrize(
    ("kind", "has_axis"),
    [
        ("revolute", True),
        ("prismatic", True),
        ("continuous", True),
        ("planar", True),
        ("fixed", False),
        ("floating", False),
    ],
)
def test_class_name_axis_and_origin(kind: JointType, has_axis: bool) -> None:
    joint = Joint('a "b"', kind, "a", "b", Origin((1, 2, 3)), axis=(0, 0, 1))
    components = record_components(skeleton(joint))
    record, text = components["a__b_"]
    assert record == f"{kind.capitalize()}Joint"
    start = 'name = "a \\"b\\"", origin( xyz = {1, 2, 3}, rpy = {0, 0, 0})'
    assert text.startswith(f"{start}, axis = {{0, 0, 1}}" if has_axis else start)
    assert ("axis" in text) == has_axis
