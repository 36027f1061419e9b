"""Generic robots, which read the record of a robot: models to compile, and the same motion by Pinocchio.

Pinocchio's free motion is that of `urdfsync.formats.urdf.physics.reference`, the base at rest or free, integrated by a
Runge-Kutta method: of fourth order for axes, of second order for the attitude of a free base.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from support.modelica import URDFSYNC, Array, Run, Task, bench
from support.packages import Package, generate
from support.urdfs import dynamics, every_number, joint, link, links, mimic, robot
from urdfsync.domain import Target
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.reference import Configuration, Reference, read
from urdfsync.formats.urdf.second.dynamics import loss_efforts, mechanism_efforts
from urdfsync.modelica.literals import vector

FORMS = ("GenericRobot", "ArticulatedRobot")
"""The two formulations."""

GRIPPER = robot(
    *links(base=2.0, plate=1.0),
    *(link(name, 1.5) for name in ("arm", "slide", "wheel", "finger", "thumb")),
    link("sensor", 0.3),
    joint("bolts", "fixed", "base", "plate"),
    joint(
        "shoulder",
        "revolute",
        "plate",
        "arm",
        axis="0.6 0 0.8",
        inside=[every_number(0.4, 0.2, armature=0.6, spring_stiffness=7.5)],
    ),
    joint(
        "rail",
        "prismatic",
        "arm",
        "slide",
        axis="0 1 0",
        inside=[every_number(3.0, 0.5, armature=1.1, spring_stiffness=40, spring_reference=0.2)],
    ),
    joint("mount", "fixed", "slide", "sensor"),
    joint("roll", "continuous", "sensor", "wheel", axis="1 0 0"),
    joint("press", "revolute", "slide", "thumb", axis="0 0 1", inside=[mimic("grip", -4.0, 0.3)]),
    joint(
        "grip",
        "prismatic",
        "slide",
        "finger",
        axis="1 0 0",
        inside=[
            mimic("shoulder", 0.1, 0.02),
            every_number(2, 0.4, armature=0.3, spring_stiffness=30, spring_reference=-0.1),
        ],
    ),
)
"""A chain with branches; press follows grip, which comes after it, and grip follows shoulder."""

LADDER = robot(
    link("base"),
    *(link(name, 2.0) for name in ("car", "mast", "left", "right")),
    joint("drive", "prismatic", "base", "car", axis="1 0 0", inside=[dynamics(2.0, 0.0)]),
    joint("lift", "prismatic", "car", "mast", axis="0.6 0 0.8"),
    joint("left swing", "revolute", "mast", "left", axis="0 1 0"),
    joint("right swing", "revolute", "mast", "right", axis="0 1 0", inside=[mimic("left swing", -1.0)]),
)
"""Two sliding joints first; a base without mass; a name with a space."""

STONE = robot(link("stone", 2.0))
ROBOTS = {"gripper": GRIPPER, "ladder": LADDER}
"""Two robots with all features: joints that turn, slide, follow or are fixed, branches, losses, armatures, springs."""
CLASSES = ("PartialRecordRobot", "PartialGenericRobot", "GenericRobot")

_FIXED = "equation connect(world.frame_b, robot.frame_a);"
_FLOATING = """UrdfSync.Robots.FreeBase base({start});
  equation
    connect(world.frame_b, base.frame_a);
    connect(base.frame_b, robot.frame_a);"""
_BASE = {
    "r_start": (0.3, -0.2, 1.5),
    "rpy_start": (0.4, -0.3, 0.9),
    "v_start": (0.5, -0.3, 0.8),
    "w_start": (0.7, -1.1, 0.6),
}
"""The start of a free base: velocity and angular velocity are resolved in the world."""


@dataclasses.dataclass(frozen=True)
class Robot:
    """A robot as a package, and as Pinocchio's model of the same file."""

    package: Package
    reference: Reference

    @property
    def skeleton(self) -> KinematicTree:
        """Its links and joints in order."""
        return self.package.skeleton


def strict_generic() -> str:
    """The generic robot, in which a passed limit is an error that the compiler reports."""
    texts = [(URDFSYNC / "Robots" / f"{name}.mo").read_text("utf-8") for name in CLASSES]
    joined = "".join(text.replace("within UrdfSync.Robots;", "") for text in texts)
    joined = re.sub(rf"UrdfSync\.Robots\.({'|'.join(CLASSES)})\b", r"\1", joined)
    assert joined.count("AssertionLevel.warning") == 7
    return joined.replace("AssertionLevel.warning", "AssertionLevel.error")


def prepare(content: bytes, name: str = "Bot") -> Robot:
    """A robot that Pinocchio can read."""
    package = generate(content, Target(name, name), approach=("record",))
    axes = [joint.name for joint in motion.driven_axes(package.skeleton)]
    return Robot(package, Reference(read(completed_for_reference(content).content, "robot.urdf"), axes))


def free_task(
    robot: Robot,
    form: str,
    start: Sequence[Course],
    stop: float,
    tolerance: float | None = None,
    is_floating: bool = False,
) -> Task:
    """Free motion on a fixed base or a free one.

    The values are the positions of the driven axes, in the order of `motion.driven_axes`. A free base adds the place of
    the root link and its rotation matrix, by rows.
    """
    name, parts, values = robot.package.target.name, [], []
    for kind, q, v in (("rotational", "phi", "w"), ("translational", "s", "v")):
        count = len(robot.skeleton.axes(kind))  # type: ignore[arg-type]
        own, start = start[:count], start[count:]
        if own:
            positions, speeds = vector([one.position for one in own]), vector([one.speed for one in own])
            parts.append(f"{q}_start = {positions}, {v}_start = {speeds}, ")
        values += [f"robot.{kind}Axis[{number}].{q}" for number in range(1, count + 1)]
    model = f"UrdfSync.Robots.{form} robot(redeclare parameter {name}.{name}Parameters data, "
    model += f"{''.join(parts)}checkLimits = false);"
    connected = _FIXED
    if is_floating:
        connected = _FLOATING.format(start=", ".join(f"{key} = {vector(value)}" for key, value in _BASE.items()))
        values += [f"robot.frame_a.r_0[{i}]" for i in (1, 2, 3)]
        values += [f"robot.frame_a.R.T[{j},{i}]" for i in (1, 2, 3) for j in (1, 2, 3)]
    runs = [Run(stop, stop, tolerance=tolerance)]
    return bench(f"{model}\n    {connected}", runs, values, packages=[name], gravity=motion.GRAVITY)


def free_motion(robot: Robot, start: Sequence[Course], stop: float, steps: int, is_floating: bool = False) -> Array:
    """Return the values of `free_task` after `stop` s of free motion from positions and speeds of `start`.

    The acceleration z solves (Gᵀ·H·G)·z = -Gᵀ·(C + losses) for base and axes without drives.
    """
    reference, model = robot.reference, robot.reference.multibody.model
    p, speeds, _ = np.array([*start, (0, 0, 0)]).T[:, :-1]
    state = at_rest(robot, p, speeds)
    q, v, free = state.q, state.v, reference.projection
    if is_floating:
        place, rpy, velocity, turning = map(np.array, _BASE.values())
        axes = pin.rpy.rpyToMatrix(*rpy)
        q[:3], q[3:7] = place, pin.Quaternion(axes).coeffs()
        v[:3], v[3:6] = axes.T @ velocity, axes.T @ turning
        free = np.hstack([np.eye(model.nv, 6), free])

    inverse = np.linalg.pinv(reference.projection)

    def acceleration(p: Array, q: Array, v: Array) -> Array:
        positions = at_rest(robot, p, speeds).positions
        taken = loss_efforts(reference.dynamics, v) + mechanism_efforts(reference.dynamics, positions)
        load = pin.rnea(model, model.createData(), q, v, np.zeros(model.nv)) + taken
        return np.asarray(free @ np.linalg.solve(free.T @ mass_matrix(reference, q) @ free, -free.T @ load))

    def moved(way: Array) -> tuple[Array, Array]:
        return p + inverse @ way, pin.integrate(model, q, way)

    h = stop / steps
    for _ in range(steps):
        a1 = acceleration(p, q, v)
        v2 = v + h / 2 * a1
        a2 = acceleration(*moved(h / 2 * v), v2)
        v3 = v + h / 2 * a2
        a3 = acceleration(*moved(h / 2 * v2), v3)
        v4 = v + h * a3
        a4 = acceleration(*moved(h * v3), v4)
        p, q = moved(h / 6 * (v + 2 * v2 + 2 * v3 + v4))
        v = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    turned = pin.Quaternion(q[3:7]).toRotationMatrix()
    return np.concatenate([p, q[:3], turned.ravel()]) if is_floating else np.asarray(p)


def at_rest(robot: Robot, p: Array, v: Array) -> Configuration:
    """The state with these positions and speeds of the axes, the base at rest at the origin."""
    reference = robot.reference
    state = reference.state([Course(*pair, 0.0) for pair in zip(p, v, strict=True)])
    state.q[:7], state.v[:6], state.a[:6] = (0, 0, 0, 0, 0, 0, 1), 0, 0
    return state


def forward(reference: Reference, state: Configuration, load: Array) -> Array:
    """Accelerations of axes without drives under a load on all joints: Bᵀ·H·B·a = -Bᵀ·load for independent axes."""
    b = reference.projection
    return np.asarray(np.linalg.solve(b.T @ mass_matrix(reference, state.q) @ b, -b.T @ load))


def mass_matrix(reference: Reference, q: Array) -> Array:
    """The inertia matrix of all joints; Pinocchio gives only the upper half."""
    upper = np.triu(pin.crba(reference.multibody.model, reference.multibody.model.createData(), q))
    return np.asarray(upper + np.triu(upper, 1).T)


def link_place(robot: Robot, p: Array, link: str) -> Array:
    """The pose of a link's frame, with the base at the origin."""
    model = robot.reference.multibody.model
    data = model.createData()
    pin.framesForwardKinematics(model, data, at_rest(robot, p, np.zeros(len(p))).q)
    return np.array(data.oMf[model.getFrameId(link, pin.BODY)].translation)
