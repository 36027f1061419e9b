"""Limit warnings are alive: with `AssertionLevel.error` the same model stops where a limit is passed, and only there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from support import modelica
from support.modelica import Run, Series, Task
from support.packages import generate
from support.urdfs import joint, limit, link, mimic, robot
from urdfsync.domain import Target

pytestmark = pytest.mark.slow

LOWER, UPPER, VELOCITY, EFFORT = -0.5, 0.8, 2.0, 10.0
INERTIA = 0.25
"""Moment of inertia or mass that each drive moves: the robot is balanced and slides level, so that gravity does nothing."""


def balanced(name: str) -> str:
    tensor = f'<inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/>'
    return f'<link name="{name}"><inertial><mass value="{INERTIA}"/>{tensor}</inertial></link>'


LIMITS = limit(LOWER, UPPER, VELOCITY, EFFORT)
LEVEL = {"xyz": "0 0 0", "rpy": "0 0 0"}

ROBOT = robot(
    link("base"),
    *(balanced(name) for name in ("arm", "wheel", "sledge")),
    link("finger"),
    joint("my elbow", "revolute", "base", "arm", axis="0 0 1", inside=[LIMITS], **LEVEL),
    joint("roll", "continuous", "base", "wheel", axis="0 0 1", inside=[LIMITS], **LEVEL),
    joint("rail", "prismatic", "base", "sledge", axis="1 0 0", inside=[LIMITS], **LEVEL),
    joint("grip", "prismatic", "arm", "finger", axis="1 0 0", inside=[mimic("my elbow", 0.1), limit(-0.01, 1)], **LEVEL),
)
"""Its axes, in the order of the flange vectors: my elbow, roll; rail. The finger stops the elbow at -0.1 rad."""

DRIVES = """
package Check_
  import Modelica;
  import UrdfSync;

  model Check
    parameter Real a0[3] = zeros(3);
    parameter Real a1[3] = zeros(3);
    parameter Real a2[3] = zeros(3);
    parameter Real elbow_a0 = 0;
    parameter Real elbow_a1 = 0;
    parameter Real elbow_a2 = 0;
    parameter Real roll_a1 = 0;
    parameter Real roll_a2 = 0;
    parameter Real rail_a0 = 0;
    parameter Real rail_a1 = 0;
    parameter Real rail_a2 = 0;
    inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1}, enableAnimation = false);
    Bot.Bot robot(fixedStart = false, checkLimits = %s);
    Real elbow = elbow_a0 + elbow_a1*time + elbow_a2*time^2/2;
    Real roll = roll_a1*time + roll_a2*time^2/2;
    Real rail = rail_a0 + rail_a1*time + rail_a2*time^2/2;
  equation
    robot.rotationalAxis[1].phi = elbow;
    robot.rotationalAxis[2].phi = roll;
    robot.translationalAxis[1].s = rail;
    connect(world.frame_b, robot.frame_a);
  end Check;
end Check_;
"""
