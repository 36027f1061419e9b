"""Models that users write beside a generated package: they extend Test and the robot, and what they change counts.

Pinocchio says what each axis needs for the motion that the simulation has.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support.modelica import GRAVITY, Array, Run, Series, Task, simulate
from support.packages import generate
from support.urdfs import dynamics, joint, link, links, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.physics.reference import SLIDING_STEEPNESS, TURNING_STEEPNESS

pytestmark = pytest.mark.slow

AXES = {"shoulder": ("revolute", "phi", "w", "tau"), "elbow": ("revolute", "phi", "w", "tau")} | {
    "slide": ("prismatic", "s", "v", "f")
}
"""Names of each joint's component, position, speed and effort."""


def arm(*, mass: float, center: str, damping: float, axis: str, xyz: str, rpy: str) -> str:
    """A robot with two axes that turn and one that slides; the numbers are those that a test changes."""
    return robot(
        *links(base=4.0, upper=2.5),
        link("forearm", mass, center=center),
        link("hand", 0.7),
        joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[dynamics(damping, 0.3)]),
        joint("elbow", "revolute", "upper", "forearm", xyz=xyz, rpy=rpy, axis=axis, inside=[dynamics(0.2, 0.1)]),
        joint("slide", "prismatic", "forearm", "hand", axis="-1 0 0", inside=[dynamics(3.0, 2.0)]),
    )


BEFORE = arm(mass=1.5, center="0.02 -0.05 0.1", damping=0.5, axis="0 1 0", xyz="0.1 -0.2 0.3", rpy="0.5 -0.6 0.7")
AFTER = arm(mass=6.25, center="0.1 0.2 -0.3", damping=4.0, axis="0.48 0.6 0.64", xyz="-0.3 0.1 0.2", rpy="-0.4 0.9 0.1")
INERTIA = ", ".join(
    f"{name} = {value * 6.25!r}"
    for name, value in {"ixx": 0.021, "iyy": 0.018, "izz": 0.015, "ixy": 0.002, "ixz": -0.001, "iyz": 0.0015}.items()
)
CHANGES = f"""robot(
    forearm(parameters(inertial(mass = 6.25, origin(xyz = {{0.1, 0.2, -0.3}}), inertia({INERTIA})))),
    shoulder(parameters(dynamics(damping = 4))),
    elbow(parameters(axis = {{0.48, 0.6, 0.64}}, origin(xyz = {{-0.3, 0.1, 0.2}}, rpy = {{-0.4, 0.9, 0.1}}))))"""
"""What is `AFTER` of `BEFORE`, as modifiers of a bench."""

PAYLOAD = pin.Inertia(1.75, np.array([0.05, -0.1, 0.2]), np.diag([0.01, 0.02, 0.03]))
USERS = f"""
package Users_
  import Modelica;
  import UrdfSync;
  import Bot;

  model ChangedTest
    extends Bot.BotTest({CHANGES});
  end ChangedTest;

  model LoadedUpper
    extends Bot.Links.Upper(m = parameters.inertial.mass + payload.m);
    Modelica.Mechanics.MultiBody.Parts.Body payload(
      animation = false, m = {PAYLOAD.mass}, r_CM = {{0.05, -0.1, 0.2}}, I_11 = 0.01, I_22 = 0.02, I_33 = 0.03);
  equation
    connect(frame_a, payload.frame_a);
  end LoadedUpper;

  model MyArm
    extends Bot.Bot(redeclare LoadedUpper upper);
  end MyArm;

  model RedeclaredTest
    extends Bot.BotTest(redeclare MyArm robot);
    Real mass = robot.m;
  end RedeclaredTest;
end Users_;
"""


def values(name: str) -> list[str]:
    """Position, speed, acceleration and effort of an axis."""
    component, q, v, effort = AXES[name]
    return [*(f"robot.{name}.{component}.{part}" for part in (q, v, "a")), f"robot.{name}Axis.{effort}"]


def model_of(urdf: str) -> pin.Model:
    model = pin.buildModelFromXML(urdf)
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    return model


def loaded(model: pin.Model) -> pin.Model:
    """The same with the payload on the upper arm."""
    frame = model.frames[model.getFrameId("upper", pin.BODY)]
    model.appendBodyToJoint(frame.parentJoint, PAYLOAD, frame.placement)
    return model


def measured(series: Series) -> tuple[Array, Array, Array, Array]:
    """Positions, speeds, accelerations and efforts of all axes: a row per instant."""
    parts = np.array([[series.values[value] for value in values(name)] for name in AXES])
    q, v, a, efforts = parts.transpose(1, 2, 0)
    return q, v, a, efforts


def efforts_of(model: pin.Model, q: Array, v: Array, a: Array) -> Array:
    """What all axes need for a motion, losses included: a row per instant."""
    assert list(model.names)[1:] == list(AXES)
    sharp = np.array([SLIDING_STEEPNESS if kind == "prismatic" else TURNING_STEEPNESS for kind, *_ in AXES.values()])
    losses: Array = model.damping * v + model.friction * np.tanh(sharp * v / 2)
    data = model.createData()
    driven: Array = np.array([pin.rnea(model, data, *row) for row in zip(q, v, a, strict=True)])
    return np.asarray(driven + losses)


def moves(q: Array) -> bool:
    """Whether every axis goes somewhere."""
    return bool((np.ptp(q, axis=0) > 0.05).all())


def test_what_a_bench_changes_is_part_of_the_robot(modelica_library: Path, tmp_path: Path) -> None:
    """Mass, centre and inertia of a link, and damping, axis and origin of joints, all at once; or a link.

    Redeclared joints are those of test_custom_arm and test_custom_histories.
    """
    folder = generate(BEFORE.encode(), Target("Bot", "Bot")).write(tmp_path)
    axes = [value for name in AXES for value in values(name)]
    tasks = [
        Task(USERS, "Users_.ChangedTest", [Run(8, 0.5)], axes),
        Task(USERS, "Users_.RedeclaredTest", [Run(8, 0.5, tolerance=1e-10)], [*axes, "mass"]),
    ]
    test, redeclared = simulate(modelica_library, [folder], tasks)
    for series, changed, accuracy in (
        (test, model_of(AFTER), 1e-10),
        (redeclared, loaded(model_of(BEFORE)), 1e-8),
    ):
        q, v, a, efforts = measured(series)
        expected = efforts_of(changed, q, v, a)
        assert moves(q)
        assert efforts == pytest.approx(expected, rel=accuracy, abs=accuracy * np.abs(expected).max())
        plain = efforts_of(model_of(BEFORE), q, v, a)
        shows = np.abs(plain - expected).max(axis=0) > 0.1
        assert shows.all() or (series is redeclared and shows.any()), "each axis shows a change of numbers"
    assert redeclared.values["mass"] == pytest.approx(4.0 + 2.5 + 1.5 + 0.7 + PAYLOAD.mass)
