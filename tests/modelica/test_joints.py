"""Joints in simulation against Pinocchio, on small robots of our own: all six types, mimic of every kind, losses."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support import modelica, physics
from support.modelica import Run, Task
from support.packages import generate
from support.physics import Array, Motion
from support.urdfs import dynamics, joint, limit, link, mimic, robot

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

BOT = Target("Bot", "Bot")

TYPES = robot(
    link("base", 4.0),
    link("upper", 2.5),
    link("fore", 1.5),
    link("hand", 0.7),
    link("tool", 0.4, rpy="-1.2 0.8 2.5"),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[limit(), dynamics(0.5, 0.3)]),
    joint("elbow", "continuous", "upper", "fore", axis="0.3 -0.4 1.2", inside=[dynamics(0.2, 0.1)]),
    joint("slide", "prismatic", "fore", "hand", axis="-2 0 0", inside=[limit(), dynamics(3.0, 2.0)]),
    joint("flange", "fixed", "hand", "tool", rpy="1.1 0.2 -2.9"),
)
"""An axis that is no unit vector, one that is skew, and losses on every type that turns or slides."""

BARE = robot(
    link("base"),
    link("carrier"),
    link("adapter"),
    link("load", 1.2),
    joint("lift", "prismatic", "base", "carrier", axis="0 0 1", inside=[limit()]),
    joint("turn", "revolute", "carrier", "adapter", inside=[limit()]),
    joint("bolt", "fixed", "adapter", "load"),
)
"""Massless links that move, and a joint without an axis: it is x."""

GRIPPER = robot(
    link("palm", 1.0),
    link("left", 0.2),
    link("right", 0.3),
    link("tip", 0.15),
    joint("left_slide", "prismatic", "palm", "left", axis="0 1 0", inside=[mimic("drive", 0.03, 0.01), limit()]),
    joint("drive", "revolute", "palm", "right", axis="0 0 1", inside=[limit(), dynamics(0.1, 0.05)]),
    joint("tip_turn", "revolute", "left", "tip", axis="1 0 0", inside=[mimic("left_slide", -20.0, 0.2), limit()]),
)
"""Sliding follows turning, turning follows sliding: a chain, with a negative multiplier; followers come first."""

CHAIN = robot(
    *(link(f"part{k}", 1.0 + 0.3 * k) for k in range(6)),
    joint("lead", "continuous", "part0", "part1", axis="0 0 1", inside=[dynamics(0.3, 0.2)]),
    joint("equal", "revolute", "part1", "part2", axis="0 1 0", inside=[mimic("lead"), limit(), dynamics(0.2, 0.1)]),
    joint("back", "revolute", "part2", "part3", axis="0 1 1", inside=[mimic("equal", -1.5, 0.3), limit()]),
    joint("rail", "prismatic", "part0", "part4", axis="1 0 0", inside=[limit()]),
    joint(
        "rack", "prismatic", "part4", "part5", axis="0 1 0", inside=[mimic("rail", -0.5), limit(), dynamics(4.0, 1.0)]
    ),
)
"""Turning follows turning twice over, sliding follows sliding; followers have losses of their own."""

HELD = robot(
    link("base", 1.0),
    link("plate", 1.0),
    link("bracket", 1.0),
    link("pin", 1.0),
    link("arm", 1.0),
    joint("weld", "fixed", "base", "plate"),
    joint("tilt", "revolute", "plate", "bracket", axis="0 1 0", inside=[mimic("weld", 3.0, 0.4), limit()]),
    joint("stop", "prismatic", "plate", "pin", axis="0 0 1", inside=[mimic("weld", 3.0, -0.2), limit()]),
    joint("turn", "revolute", "bracket", "arm", axis="0 0 1", inside=[limit()]),
)
"""Joints that follow one that never moves stay at their offsets."""

ROBOTS = {"types": TYPES, "massless": BARE, "gripper": GRIPPER, "chain": CHAIN, "held": HELD}

each_robot = pytest.mark.parametrize("urdf", ROBOTS.values(), ids=ROBOTS)


def run(library: Path, folder: Path, task: Task) -> modelica.Series:
    (outcome,) = modelica.execute(library, [folder], [task])
    assert not outcome.error, outcome.error
    (series,) = outcome.runs
    assert not series.error, series.error
    return series


def start(series: modelica.Series, names: list[str]) -> Array:
    return np.array([series.values[name][0] for name in names])


@each_robot
def test_driven_joints_move_and_push_as_pinocchio_says(urdf: str, modelica_library: Path, tmp_path: Path) -> None:
    package = generate(urdf.encode(), BOT)
    reference = physics.Reference(urdf, package)
    motion = physics.random_motion(len(reference.axes), seed=1)
    errors, _ = physics.measure(modelica_library, package.write(tmp_path), reference, motion)
    assert errors.worst() <= physics.TOLERANCE, errors


@each_robot
def test_free_joints_accelerate_as_pinocchio_says(urdf: str, modelica_library: Path, tmp_path: Path) -> None:
    package = generate(urdf.encode(), BOT)
    reference = physics.Reference(urdf, package)
    motion = physics.random_motion(len(reference.axes), seed=2)
    task = physics.forward_check(package, motion)
    found = start(run(modelica_library, package.write(tmp_path), task), list(task.values))
    expected = reference.accelerations(motion)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max())


FAULTS = {
    "position": ('rpy="0.5 -0.6 0.7"', 'rpy="0.5 -0.6 0.70000001"'),
    "rotation": ('rpy="0.5 -0.6 0.7"', 'rpy="0.5 -0.60000001 0.7"'),
    "effort": ('friction="0.1"', 'friction="0.10000001"'),
    "mass": ('mass value="2.2"', 'mass value="2.20000001"'),
}


@pytest.mark.parametrize(("kind", "fault"), FAULTS.items())
def test_the_comparison_notices_a_fault(
    kind: str, fault: tuple[str, str], modelica_library: Path, tmp_path: Path
) -> None:
    """One number of the chain is wrong in its eighth digit."""
    assert fault[0] in CHAIN
    package = generate(CHAIN.replace(*fault, 1).encode(), BOT)
    reference = physics.Reference(CHAIN, generate(CHAIN.encode(), BOT))
    motion = physics.random_motion(len(reference.axes), seed=1)
    folder = package.write(tmp_path)
    errors, _ = physics.measure(modelica_library, folder, reference, motion)
    assert getattr(errors, kind) > physics.TOLERANCE


def check_model(declarations: str, equations: str, values: list[str]) -> Task:
    imports = "import Modelica;\n import UrdfSync;"
    source = f"model Check\n {imports}\n {physics.WORLD}\n {declarations}\nequation\n {equations}\nend Check;\n"
    return Task(source, "Check", [Run(1e-6, 1e-6)], values)


def normal_to(axis: Array) -> Array:
    """The first direction of a planar joint, as `UrdfSync.Functions.normalTo` documents it."""
    other = np.array([1.0, 0, 0]) if abs(axis[0]) < 0.9 else np.array([0, 1.0, 0])
    direction = other - (other @ axis) * axis
    return np.asarray(direction / np.linalg.norm(direction))


def planar(axis: str, *inside: str) -> str:
    return robot(
        link("floor"),
        link("plate", 3.0),
        link("arm", 1.0),
        joint("skate", "planar", "floor", "plate", axis=axis, inside=inside),
        joint("turn", "revolute", "plate", "arm", axis="1 0 0", inside=[limit()]),
    )


def as_three_joints(axis: Array, *inside: str) -> str:
    """The planar robot with two sliding joints and a turning one in place of the planar joint."""
    first = normal_to(axis)
    text = [" ".join(map(repr, map(float, direction))) for direction in (first, np.cross(axis, first), axis)]
    none = {"xyz": "0 0 0", "rpy": "0 0 0"}
    return robot(
        link("floor"),
        link("one"),
        link("two"),
        link("plate", 3.0),
        link("arm", 1.0),
        joint("skate_1", "prismatic", "floor", "one", axis=text[0], inside=[limit(), *inside]),
        joint("skate_2", "prismatic", "one", "two", axis=text[1], inside=[limit(), *inside], **none),
        joint("skate_3", "revolute", "two", "plate", axis=text[2], inside=[limit(), *inside], **none),
        joint("turn", "revolute", "plate", "arm", axis="1 0 0", inside=[limit()]),
    )


@pytest.mark.parametrize("losses", [(), (dynamics(1.5, 0.8),)], ids=["free", "losses"])
@pytest.mark.parametrize("axis", ["0 0 1", "1 0 0", "0.2 -0.5 1"])
def test_a_planar_joint_is_two_slides_and_a_turn(
    axis: str, losses: tuple[str, ...], modelica_library: Path, tmp_path: Path
) -> None:
    normal = np.array([float(number) for number in axis.split()])
    urdf = as_three_joints(normal / np.linalg.norm(normal), *losses)
    reference = physics.Reference(urdf, generate(urdf.encode(), BOT))
    assert [j.name for j in reference.axes] == ["skate_3", "turn", "skate_1", "skate_2"]
    phi, turn, x, y = (v := physics.random_motion(4, seed=3)).q
    d_phi, d_turn, d_x, d_y = v.v
    task = check_model(
        f"Bot.Bot robot(phi_start = {{{turn}}}, w_start = {{{d_turn}}}, "
        f"skate(s_start = {{{x}, {y}}}, v_start = {{{d_x}, {d_y}}}, phi_start = {phi}, w_start = {d_phi}));",
        "connect(world.frame_b, robot.frame_a);",
        ["robot.skate.revolute.a", "robot.turn.revolute.a", "robot.skate.prismatic_x.a", "robot.skate.prismatic_y.a"],
    )
    folder = generate(planar(axis, *losses).encode(), BOT).write(tmp_path)
    found = start(run(modelica_library, folder, task), list(task.values))
    assert found == pytest.approx(reference.accelerations(v), rel=1e-9, abs=1e-9)


def test_a_level_planar_joint_is_that_of_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    """With the axis z the directions are x and y; Pinocchio resolves speeds in the moving frame."""
    urdf = planar("0 0 1")
    model = pin.buildModelFromXML(urdf)
    model.gravity.linear = np.array([0, 0, -physics.GRAVITY])
    (x, y, phi, turn), (d_x, d_y, d_phi, d_turn) = (v := physics.random_motion(4, seed=4)).q, v.v
    turned = pin.rpy.rpyToMatrix(0, 0, phi)[:2, :2]
    speed = turned.T @ [d_x, d_y]
    twist = np.array([*speed, d_phi, d_turn])
    a = pin.aba(model, model.createData(), np.array([x, y, np.cos(phi), np.sin(phi), turn]), twist, np.zeros(4))
    slides = turned @ (a[:2] + d_phi * np.array([-speed[1], speed[0]]))
    task = check_model(
        f"Bot.Bot robot(phi_start = {{{turn}}}, w_start = {{{d_turn}}}, "
        f"skate(s_start = {{{x}, {y}}}, v_start = {{{d_x}, {d_y}}}, phi_start = {phi}, w_start = {d_phi}));",
        "connect(world.frame_b, robot.frame_a);",
        ["robot.skate.prismatic_x.a", "robot.skate.prismatic_y.a", "robot.skate.revolute.a", "robot.turn.revolute.a"],
    )
    folder = generate(urdf.encode(), BOT).write(tmp_path)
    found = start(run(modelica_library, folder, task), list(task.values))
    assert found == pytest.approx([*slides, a[2], a[3]], rel=1e-9, abs=1e-9)


FLYING = {"r": [0.3, -0.2, 0.5], "rpy": [0.7, -0.4, 1.1], "v": [0.6, -0.8, 0.3], "w": [0.9, 0.5, -1.3]}
"""Start values of six degrees of freedom, resolved in the frame that the motion is relative to."""


def modifiers(prefix: str = "") -> str:
    return ", ".join(f"{prefix}{key}_start = {{{', '.join(map(repr, value))}}}" for key, value in FLYING.items())


def base_accelerations(free: str, body: str) -> list[str]:
    """Names of the accelerations of a free base: of its motion, and of the link that moves with it."""
    linear = [f"{free}.freeMotion.a_rel_a[{i}]" for i in (1, 2, 3)]
    return linear + [f"{body}.body.z_a[{i}]" for i in (1, 2, 3)]


def free_reference(model: pin.Model, others: Motion) -> tuple[Array, Array]:
    """Accelerations of the free base, and of all other joints.

    Linear ones are resolved in the frame that the motion is relative to, angular ones in the moving frame.
    """
    model.gravity.linear = np.array([0, 0, -physics.GRAVITY])
    turned = pin.rpy.rpyToMatrix(*FLYING["rpy"])
    w = turned.T @ FLYING["w"]
    v = turned.T @ FLYING["v"]
    attitude = pin.Quaternion(turned).coeffs()
    turns = (
        [np.cos(q), np.sin(q)] if joint.nq == 2 else [q] for joint, q in zip(model.joints[2:], others.q, strict=True)
    )
    positions = np.array([*FLYING["r"], *attitude, *itertools.chain(*turns)])
    a = pin.aba(model, model.createData(), positions, np.array([*v, *w, *others.v]), np.zeros(model.nv))
    return np.array([*(turned @ (a[:3] + np.cross(w, v))), *a[3:6]]), np.asarray(a[6:])


def test_a_floating_joint_is_free(modelica_library: Path, tmp_path: Path) -> None:
    urdf = robot(
        link("ceiling"),
        link("drone", 3.0),
        link("arm", 1.0),
        joint("air", "floating", "ceiling", "drone"),
        joint("turn", "revolute", "drone", "arm", axis="1 0 0", inside=[limit()]),
    )
    others = physics.random_motion(1, seed=5)
    base, turn = free_reference(pin.buildModelFromXML(urdf), others)
    task = check_model(
        f"Bot.Bot robot(phi_start = {{{others.q[0]}}}, w_start = {{{others.v[0]}}}, air({modifiers()}));",
        "connect(world.frame_b, robot.frame_a);",
        [*base_accelerations("robot.air.freeMotion", "robot.drone"), "robot.turn.revolute.a"],
    )
    folder = generate(urdf.encode(), BOT).write(tmp_path)
    found = start(run(modelica_library, folder, task), list(task.values))
    assert found == pytest.approx([*base, *turn], rel=1e-9, abs=1e-9)


MOBILE = robot(
    link("chassis", 12.0).replace(
        "</link>", '<collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision></link>'
    ),
    *(
        link(f"{side}_wheel", 0.8, center="0 0 0", rpy="0 0 0").replace(
            "</link>", '<collision><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision></link>'
        )
        for side in ("left", "right")
    ),
    joint("left_axle", "continuous", "chassis", "left_wheel", xyz="0 0.2 0", rpy="-1.5707963 0 0", axis="0 0 1"),
    joint("right_axle", "continuous", "chassis", "right_wheel", xyz="0 -0.2 0", rpy="-1.5707963 0 0", axis="0 0 1"),
)


def test_a_mobile_robot_in_the_air_falls_freely(modelica_library: Path, tmp_path: Path) -> None:
    """It is too high for its ground contacts; what is left must be a free base with joints."""
    wheels = physics.random_motion(2, seed=6)
    base, turns = free_reference(pin.buildModelFromXML(MOBILE, pin.JointModelFreeFlyer()), wheels)
    task = check_model(
        "inner UrdfSync.Contacts.Ground ground(load = 100); UrdfSync.Robots.FreeBase base("
        f"{modifiers()}); Modelica.Mechanics.MultiBody.Parts.FixedTranslation up(r = {{0, 0, 9}}, animation = false); "
        f"Bot.Bot robot(phi_start = {{{wheels.q[0]}, {wheels.q[1]}}}, w_start = {{{wheels.v[0]}, {wheels.v[1]}}});",
        "connect(world.frame_b, up.frame_a); connect(up.frame_b, base.frame_a); connect(base.frame_b, robot.frame_a);",
        [
            *base_accelerations("base", "robot.chassis"),
            "robot.left_axle.revolute.a",
            "robot.right_axle.revolute.a",
        ],
    )
    folder = generate(MOBILE.encode(), BOT, base="floating").write(tmp_path)
    found = start(run(modelica_library, folder, task), list(task.values))
    assert found == pytest.approx([*base, *turns], rel=1e-9, abs=1e-9)
