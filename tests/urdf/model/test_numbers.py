"""The numbers of joints: every group that a joint has, defaults and absences included."""

from __future__ import annotations

from typing import Any

import pytest

from urdfsync.urdf.model.numbers import axis, joint_numbers
from urdfsync.urdf.robot import Calibration, Dynamics, Joint, JointType, Limit, Mimic, Origin, SafetyController

EVERYTHING: dict[str, Any] = {
    "limit": Limit(-1, 2, 30, None),
    "dynamics": Dynamics(0.5, 0),
    "mimic": Mimic("leader", -2, 0.1),
    "calibration": Calibration(rising=0.25),
    "safety_controller": SafetyController(10, 20, -0.5, 1.5),
}
REST = {
    "dynamics": {"damping": "0.5", "friction": "0"},
    "mimic": {"multiplier": "-2", "offset": "0.1"},
    "calibration": {"rising": "0.25", "falling": "Modelica.Constants.inf"},
    "safetyController": {"k_velocity": "10", "k_position": "20", "soft_lower_limit": "-0.5", "soft_upper_limit": "1.5"},
}
UNLIMITED = {
    "lower": "-Modelica.Constants.inf",
    "upper": "Modelica.Constants.inf",
    "velocity": "Modelica.Constants.inf",
    "effort": "Modelica.Constants.inf",
}


def groups(kind: JointType, **parts: Any) -> dict[str, dict[str, str]]:
    data = joint_numbers(Joint("j", kind, "a", "b", **parts))
    return {group.name: dict(modifier.split(" = ") for modifier in group.modifiers) for group in data.groups}


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_joint_with_limits_has_all_its_groups(kind: JointType) -> None:
    limits = {"lower": "-1", "upper": "2", "velocity": "Modelica.Constants.inf", "effort": "30"}
    assert groups(kind, **EVERYTHING) == {"limits": limits, **REST}


def test_a_continuous_joint_has_no_position_limits() -> None:
    assert groups("continuous", **EVERYTHING) == {"limits": UNLIMITED | {"effort": "30"}, **REST}


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "continuous"])
def test_what_is_not_stated_is_unlimited_or_left_out(kind: JointType) -> None:
    assert groups(kind) == {"limits": UNLIMITED}


def test_a_planar_joint_loses_energy_in_both_kinds_of_motion() -> None:
    losses = {"damping": "0.5", "friction": "0"}
    assert groups("planar", **EVERYTHING) == {"translation": losses, "rotation": losses}
    assert groups("planar") == {}


@pytest.mark.parametrize("kind", ["fixed", "floating"])
def test_joints_without_an_axis_have_no_groups(kind: JointType) -> None:
    assert groups(kind, **EVERYTHING) == {}


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "continuous", "planar"])
def test_joints_that_move_along_or_about_an_axis_have_one(kind: JointType) -> None:
    assert axis(Joint("j", kind, "a", "b", axis=(0, 0, 1))) == (0, 0, 1)


@pytest.mark.parametrize("kind", ["fixed", "floating"])
def test_other_joints_have_no_axis(kind: JointType) -> None:
    assert axis(Joint("j", kind, "a", "b", axis=(0, 0, 1))) is None


def test_name_kind_and_origin_pass_as_they_are() -> None:
    origin = Origin((1, 2, 3))
    data = joint_numbers(Joint('a "b"', "fixed", "a", "b", origin))
    assert (data.name, data.kind, data.origin) == ('a "b"', "Fixed", origin)
