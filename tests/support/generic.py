"""Generic robots, which read the record of a robot: models to compile, and the same motion by Pinocchio.

Pinocchio's free motion is that of `urdfsync.urdf.physics.reference` with the base at rest, integrated by the classical
Runge-Kutta method of fourth order.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from support.modelica import Array, Run, Task
from support.packages import Package, generate
from urdfsync.domain import Target
from urdfsync.literals import vector
from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.motion import Course
from urdfsync.urdf.physics.reading import read
from urdfsync.urdf.physics.reference import STEEPNESS, Reference, State
from urdfsync.urdf.skeleton import Skeleton

FORMS = ("GenericRobot", "ArticulatedRobot")
"""The two formulations."""

_FREE = """package Free_
  import Modelica;
  import UrdfSync;
  import {package};
  model Free
    inner Modelica.Mechanics.MultiBody.World world(n = {{0, 0, -1}}, g = {g!r}, enableAnimation = false);
    {robot}
  equation
    connect(world.frame_b, robot.frame_a);
  end Free;
end Free_;
"""


@dataclasses.dataclass(frozen=True)
class Robot:
    """A robot in both worlds: its package, and Pinocchio's model of the same file."""

    package: Package
    reference: Reference

    @property
    def skeleton(self) -> Skeleton:
        """Its links and joints in order."""
        return self.package.skeleton


def prepare(content: bytes, name: str = "Bot", *, approach: Sequence[str] = ("record",)) -> Robot:
    """A robot that Pinocchio can read."""
    package = generate(content, Target(name, name), approach=tuple(approach))
    axes = [joint.name for joint in motion.driven_axes(package.skeleton)]
    return Robot(package, Reference(read(content, "robot.urdf"), axes, []))


def free_task(
    robot: Robot, form: str, start: Sequence[Course], stop: float, tolerances: Sequence[float | None] = (None,)
) -> Task:
    """Free motion on a fixed base, once per tolerance; `form` is one of `FORMS`, or "package" for the robot model."""
    name = robot.package.target.name
    model = f"{name}.{name} robot(animation = false, "
    if form != "package":
        model = f"UrdfSync.Robots.{form} robot(redeclare parameter {name}.{name}Parameters data, "
    turning = len(robot.skeleton.axes("rotational"))
    text = _FREE.format(package=name, g=motion.GRAVITY, robot=f"{model}{_starts(start, turning)}checkLimits = false);")
    runs = [Run(stop, stop, tolerance=tolerance) for tolerance in tolerances]
    return Task(text, "Free_.Free", runs, axis_values(robot))


def axis_values(robot: Robot) -> list[str]:
    """Variables with the positions of the driven axes, in the order of `motion.driven_axes`."""
    kinds = (("rotational", "phi"), ("translational", "s"))
    return [
        f"robot.{kind}Axis[{number}].{position}"
        for kind, position in kinds
        for number, _ in enumerate(robot.skeleton.axes(kind), 1)  # type: ignore[arg-type]
    ]


def free_motion(robot: Robot, start: Sequence[Course], stop: float, steps: int) -> Array:
    """Positions of the driven axes after `stop` s of free motion from positions and speeds of `start`."""
    p, v, _ = np.array(start).T
    h = stop / steps
    for _ in range(steps):
        a1 = _acceleration(robot, p, v)
        a2 = _acceleration(robot, p + h / 2 * v, v + h / 2 * a1)
        a3 = _acceleration(robot, p + h / 2 * v + h**2 / 4 * a1, v + h / 2 * a2)
        a4 = _acceleration(robot, p + h * v + h**2 / 2 * a2, v + h * a3)
        p, v = p + h * v + h**2 / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    return np.asarray(p)


def at_rest(robot: Robot, p: Array, v: Array) -> State:
    """The state with these positions and speeds of the axes, the base at rest at the origin."""
    reference = robot.reference
    state = reference.state(0, [Course(*pair, 0.0) for pair in zip(p, v, strict=True)], {})
    state.q[:7], state.v[:6], state.a[:6] = (0, 0, 0, 0, 0, 0, 1), 0, 0
    return state


def _acceleration(robot: Robot, p: Array, v: Array) -> Array:
    """Of the driven axes without drives: (Bᵀ·H·B)·a = -Bᵀ·(C + losses), notation as in `reference`."""
    reference, state = robot.reference, at_rest(robot, p, v)
    pin, model = reference.pin, reference.model
    bias = pin.rnea(model, model.createData(), state.q, state.v, np.zeros(model.nv))
    bias += model.damping * state.v + model.friction * np.tanh(STEEPNESS * state.v)
    upper = np.triu(pin.crba(model, model.createData(), state.q))
    inertia = upper + np.triu(upper, 1).T
    project = reference.projection
    return np.asarray(np.linalg.solve(project.T @ inertia @ project, -project.T @ bias))


def _starts(start: Sequence[Course], turning: int) -> str:
    parts = (("phi_start", "w_start", start[:turning]), ("s_start", "v_start", start[turning:]))
    return "".join(
        f"{position} = {vector([course.position for course in courses])}, "
        f"{speed} = {vector([course.speed for course in courses])}, "
        for position, speed, courses in parts
        if courses
    )
