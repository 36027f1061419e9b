"""Joints in simulation against Pinocchio, on small robots of our own: all driven types, mimic of every kind, losses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin
import pytest
from support import physics, recorded_omc
from support.modelica import DRIVES, GRAVITY, Run, Task, bench, simulate
from support.packages import generate
from support.urdfs import dynamics, joint, limit, link, links, mimic, robot

from urdfsync.analysis.checks.compilers import omc
from urdfsync.domain import Target
from urdfsync.domain.experiment import Quantity
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.reference import Reference, read
from urdfsync.formats.urdf.second.dynamics import loss_efforts

pytestmark = pytest.mark.slow

OPENMODELICA = pytest.param("omc", marks=pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica"))


def gear(joint: str, reduction: float, rotor: float, offset: float = 0.0) -> str:
    """A transmission with the rotor of its motor."""
    actuator = f"<mechanicalReduction>{reduction}</mechanicalReduction>" + f'<drake:rotor_inertia value="{rotor}"/>'
    offsets = f'<joint name="{joint}"><offset>{offset}</offset></joint>'
    return f'<transmission name="{joint}">{offsets}<actuator name="m">{actuator}</actuator></transmission>'


BARE = robot(
    *links(base=None, carrier=None, adapter=None, load=1.2),
    joint("lift", "prismatic", "base", "carrier", axis="0 0 1"),
    joint("turn", "revolute", "carrier", "adapter"),
    joint("bolt", "fixed", "adapter", "load"),
)
"""Massless links that move, and a joint without an axis: it is x."""

GRIPPER = robot(
    *links(palm=1.0, left=0.2, right=0.3, tip=0.15),
    joint("left_slide", "prismatic", "palm", "left", axis="0 1 0", inside=[mimic("drive", 0.03, 0.01)]),
    joint("drive", "revolute", "palm", "right", axis="0 0 1", inside=[dynamics(0.1, 0.05)]),
    joint("tip_turn", "revolute", "left", "tip", axis="1 0 0", inside=[mimic("left_slide", -20.0, 0.2)]),
)
"""Sliding follows turning, turning follows sliding: a chain, with a negative multiplier; followers come first."""

CHAIN = robot(
    *(link(f"part{k}", 1.0 + 0.3 * k) for k in range(6)),
    joint("lead", "continuous", "part0", "part1", axis="0 0 1", inside=[dynamics(0.3, 0.2)]),
    joint("equal", "revolute", "part1", "part2", axis="0 1 0", inside=[mimic("lead"), dynamics(0.2, 0.1)]),
    joint("back", "revolute", "part2", "part3", axis="0 1 1", inside=[mimic("equal", -1.5, 0.3)]),
    joint("rail", "prismatic", "part0", "part4", axis="1 0 0"),
    joint("rack", "prismatic", "part4", "part5", axis="0 1 0", inside=[mimic("rail", -0.5), dynamics(4.0, 1.0)]),
)
"""Turning follows turning twice over, sliding follows sliding; followers have losses of their own."""

GEARED = robot(
    *links(base=4.0, upper=2.5, fore=1.5, hand=0.7, thumb=0.3),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[dynamics(0.5, 0.3)]),
    joint(
        "elbow", "continuous", "upper", "fore", axis="0.3 -0.4 1.2", inside=['<dynamics damping="0.1" armature="0.7"/>']
    ),
    joint("slide", "prismatic", "fore", "hand", axis="-2 0 0"),
    joint(
        "press", "prismatic", "fore", "thumb", inside=[mimic("elbow", 0.05), '<dynamics damping="0" armature="2.5"/>']
    ),
    gear("shoulder", 100.0, 3e-4, 0.25),
    gear("slide", -400.0, 2e-5, -0.1),
    gear("press", 300.0, 1e-5),
)
"""Gears with rotors, also behind a joint that follows, and armatures, also of a joint that follows."""

HELD = robot(
    *links(base=1.0, plate=1.0, bracket=1.0, pin=1.0, arm=1.0),
    joint("weld", "fixed", "base", "plate"),
    joint("tilt", "revolute", "plate", "bracket", axis="0 1 0", inside=[mimic("weld", 3.0, 0.4)]),
    joint("stop", "prismatic", "plate", "pin", axis="0 0 1", inside=[mimic("weld", 3.0, -0.2)]),
    joint("turn", "revolute", "bracket", "arm", axis="0 0 1"),
)
"""Joints that follow one that never moves stay at their offsets."""

WRIST = robot(
    *links(base=4.0, flex=1.5, roll=0.7),
    joint("flex", "revolute", "base", "flex", axis="0 1 0", inside=[dynamics(0.5, 0.3), limit(effort=30)]),
    joint("roll", "continuous", "flex", "roll", axis="1 0 0"),
    """<transmission name="wrist"><type>transmission_interface/DifferentialTransmission</type>
         <joint name="flex"><role>joint1</role><offset>0.2</offset></joint>
         <joint name="roll"><role>joint2</role><mechanicalReduction>1.5</mechanicalReduction></joint>""",
    *(
        f"<actuator name='m'><role>actuator{k}</role><mechanicalReduction>{reduction}</mechanicalReduction>"
        f"<drake:rotor_inertia value='{rotor}'/></actuator>"
        for k, (reduction, rotor) in enumerate([(90, 2e-4), (-80, 1e-4)], 1)
    ),
    "</transmission>",
)
"""A differential: each of its two rotors moves with both joints."""
PENDULUM = robot(
    *links(frame=None, bob=1.5),
    joint("pivot", "spherical", "frame", "bob", inside=['<dynamics damping="0.2"/>']),
)
"""A pendulum on a ball."""

SHOULDER = robot(
    *links(base=4.0, upper=2.5, fore=1.5, camera=0.2),
    joint("shoulder", "ball", "base", "upper"),
    joint("elbow", "revolute", "upper", "fore", axis="0 1 0", inside=[dynamics(0.3, 0.2)]),
    joint("look", "ball", "base", "camera"),
)
"""An elbow behind a ball, and a second ball beside it."""

LEG = robot(
    *links(base=5.0, cylinder=1.0, rod=0.7, platform=3.0),
    joint("hinge", "revolute", "base", "platform", xyz="-0.5 0 0.6", rpy="0 0 0", axis="0 1 0"),
    joint("foot", "ball", "base", "cylinder", xyz="0 0 0", rpy="0 0 0", inside=['<dynamics damping="0.3"/>']),
    joint("stroke", "prismatic", "cylinder", "rod", xyz="0 0 0.3", rpy="0 0 0", axis="0 0 1"),
    '<transmission name="t"><joint name="stroke"/></transmission>',
    '<loop_joint name="head" type="ball"><link1 link="rod" xyz="0 0 0.2"/>'
    '<link2 link="platform" xyz="0.5 0.1 0"/></loop_joint>',
)
"""A leg of a Stewart platform, whose platform hangs on a hinge: a ball in the tree and one that closes the loop."""


DRIVEN = {"geared": GEARED, "massless": BARE, "gripper": GRIPPER, "chain": CHAIN, "held": HELD, "wrist": WRIST}
"""Robots in which every joint has an axis."""


@pytest.mark.large  # balls move in the next test, all other types in test_seen_faults
@pytest.mark.parametrize("names", [("chain", "held", "wrist"), ("geared", "massless", "gripper")])
def test_joints_move_and_push_as_pinocchio_says(names: Sequence[str], modelica_library: Path, tmp_path: Path) -> None:
    """Some in one process of the compiler. One joint of each type, and free motion, is in test_seen_faults."""
    cases = [physics.prepare(DRIVEN[name].encode(), name.capitalize()).only("motion") for name in names]
    assert [physics.fault(found) for found in physics.compare(modelica_library, tmp_path, cases)] == [None] * len(cases)


@pytest.mark.large  # the recorded answers of OpenModelica move them, too
def test_balls_move_as_pinocchio_says(modelica_library: Path, tmp_path: Path) -> None:
    """Prescribed, free, in a loop; damping has an effect, and a lost origin is found."""
    cases = [physics.prepare(PENDULUM.encode(), "Pendulum").only("motion")]
    cases += [physics.prepare(SHOULDER.encode(), "Shoulder"), physics.prepare(LEG.encode(), "Leg").only("motion")]
    # two faults, each in a pendulum of its own, which moves freely
    for name, old, new in (("Weak", "damping = 0.2", "damping = 0.1"), ("Turned", "rpy = {0.5", "rpy = {0.6")):
        case = physics.prepare(PENDULUM.encode(), name).only("free motion")
        cases.append(case.changed("Joints/PivotParameters.mo", old, new))
    *right, undamped, turned = physics.compare(modelica_library, tmp_path, cases)
    for found in right:
        assert physics.fault(found) is None
        assert max(each.relative for each in found) < 1e-9
    faults = [physics.fault(found) for found in (undamped, turned)]
    assert [fault and (fault.element, fault.quantity) for fault in faults] == [
        ("joint pivot", Quantity.ACCELERATION),
        ("link bob", Quantity.ORIENTATION),
    ]


@pytest.mark.parametrize("tool", ["recorded", OPENMODELICA])
def test_openmodelica_moves_balls_as_pinocchio_says(
    tool: str, modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if tool == "recorded":
        recorded_omc.install("Balls", tmp_path / "bin")
        monkeypatch.setenv("PATH", str(tmp_path / "bin"), prepend=":")
        monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    robots = {"Pendulum": PENDULUM, "Shoulder": SHOULDER, "Leg": LEG}
    cases = [physics.prepare(text.encode(), name).only("motion") for name, text in robots.items()]
    for found in physics.compare(modelica_library, tmp_path, cases, tool="omc", record="Balls"):
        assert physics.fault(found) is None
        assert max(each.relative for each in found) < 1e-9


class Flange(NamedTuple):
    """Where an axis is driven; position = ratio*(position of the joint - offset)."""

    name: str
    effort: str = "tau"
    ratio: float = 1.0
    offset: float = 0.0


WAYS: Mapping[str, tuple[Mapping[str, Any], str, Sequence[Flange]]] = {
    "Package": (
        {},
        "Package.Package robot(",
        [Flange("shoulderAxis"), Flange("elbowAxis"), Flange("slideAxis", "f")],
    ),
    "Motors": (
        {"drives": "motor"},
        "Motors.Motors robot(",
        [
            Flange("shoulderMotor", ratio=100.0, offset=0.25),
            Flange("elbowAxis"),
            Flange("slideMotor", ratio=-400.0, offset=-0.1),
        ],
    ),
    "Tables": (
        {"approach": ("record",)},
        "UrdfSync.Robots.GenericRobot robot(redeclare parameter Tables.TablesParameters data, ",
        [Flange("rotationalAxis[1]"), Flange("rotationalAxis[2]"), Flange("translationalAxis[1]", "f")],
    ),
}
"""By package: options, the declaration of the robot, and the flanges of shoulder, elbow and slide."""


def geared_task(name: str, courses: Sequence[Course]) -> Task:
    """The robot with gears, its axes moved at the flanges of one of the `WAYS`."""
    _, robot_, flanges = WAYS[name]
    body, links = f"{robot_}fixedStart = false, checkLimits = false);\n", "connect(world.frame_b, robot.frame_a);"
    for k, (flange, course) in enumerate(zip(flanges, courses, strict=True)):
        kind, (a0, a1, a2) = "Rotational" if flange.effort == "tau" else "Translational", course
        numbers = [flange.ratio * (a0 - flange.offset), flange.ratio * a1, flange.ratio * a2]
        body += f"    {kind}Drive drive{k}(a0 = {numbers[0]!r}, a1 = {numbers[1]!r}, a2 = {numbers[2]!r});\n"
        links += f"\n    connect(drive{k}.flange, robot.{flange.name});"
    values = [f"robot.{flange.name}.{flange.effort}" for flange in flanges]
    runs = [Run(1e-3, 1e-3)]
    return bench(
        f"{body}  equation\n    {links}", runs, values, packages=[name], gravity=motion.GRAVITY, classes=DRIVES
    )


@pytest.mark.large  # `check` compares rotors, see test_seen_faults
def test_a_rotor_behind_a_gear_counts_as_the_armature_of_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    """Reduction 100 and others, to 1e-10, with armatures that are computed by hand.

    In both approaches, and driven at the motor's side of the gear, where angle and torque are those of the motor.
    """
    packages = [generate(GEARED.encode(), Target(name, name), **WAYS[name][0]) for name in WAYS]
    axes = motion.driven_axes(packages[0].skeleton)
    names, courses = [each.name for each in axes], [motion.axis_course(each) for each in axes]
    assert names == ["shoulder", "elbow", "slide"]
    reference = Reference(read(GEARED.encode(), "robot.urdf"), names)
    model = reference.multibody.model
    for name, inertia in {"shoulder": 3.0, "elbow": 0.7, "slide": 3.2, "press": 3.4}.items():
        model.armature[model.joints[model.getJointId(name)].idx_v] = inertia
    state = reference.state(courses)
    state.q[:7], state.v[:6], state.a[:6] = pin.neutral(model)[:7], 0, 0
    load = pin.rnea(model, model.createData(), state.q, state.v, state.a) + loss_efforts(reference.dynamics, state.v)

    tasks = [geared_task(name, courses) for name in WAYS]
    runs = simulate(modelica_library, [package.write(tmp_path) for package in packages], tasks)
    for (_, _, flanges), task, series in zip(WAYS.values(), tasks, runs, strict=True):
        found = [series.values[v][0] * flange.ratio for v, flange in zip(task.values, flanges, strict=True)]
        assert found == pytest.approx(reference.projection.T @ load, rel=1e-10)


COMMANDED = robot(
    *links(base=4.0, arm=1.0, wheel=1.0, cart=2.0, lift=1.0),
    joint("pan", "revolute", "base", "arm", axis="0 0 1", rpy="0 0 0"),
    joint("roll", "continuous", "base", "wheel", axis="0 0 1", rpy="0 0 0"),
    joint("push", "prismatic", "base", "cart", axis="1 0 0", rpy="0 0 0", inside=[limit(lower=0.5)]),
    joint("rise", "prismatic", "base", "lift", axis="0 0 1", rpy="0 0 0", inside=[limit(lower=0.25)]),
    '<ros2_control name="all" type="system">',
    *(
        f'<joint name="{name}"><command_interface name="{command}"/></joint>'
        for name, command in {"pan": "position", "roll": "velocity", "push": "effort", "rise": "velocity"}.items()
    ),
    "</ros2_control>",
)


@pytest.mark.large  # golden texts have the vector
def test_run_takes_what_ros2_control_commands_as_a_vector(modelica_library: Path, tmp_path: Path) -> None:
    """A position, two speeds, and a force of 4 N on 2 kg; joints begin at their start positions."""
    package = generate(COMMANDED.encode(), Target("Carts", "Carts"), inputs="vector")
    given = (0.4, 4, 0.5, 3)  # pan, push, rise, roll
    body = "Carts.CartsRun run;\n  equation\n"
    body += "".join(f"    run.commands[{k}] = {value};\n" for k, value in enumerate(given, 1))
    names = ("panAxis.phi", "rollAxis.phi", "pushAxis.s", "riseAxis.s")
    values = ["run.push_s", "run.push_v", *(f"run.robot.{name}" for name in names)]
    source = f"model CartsBench\n  import Modelica;\n  import UrdfSync;\n  import Carts;\n  {body}end CartsBench;\n"
    task = Task(source, "CartsBench", [Run(1.0, 0.5, tolerance=1e-8)], values)
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [task])
    assert series.end(*values) == pytest.approx([1.5, 2.0, 0.4, 3.0, 1.5, 0.75], abs=1e-6)


CART = robot(
    *links(base=4.0, wheel=1.0),
    '<link name="roller"><inertial><origin xyz="0.1 0 0"/><mass value="0.5"/>'
    '<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>',
    joint("drive", "continuous", "base", "wheel", axis="0 1 0", rpy="0 0 0"),
    joint("caster", "continuous", "base", "roller", axis="0 1 0", rpy="0 0 0"),
    '<transmission name="t"><joint name="drive"/></transmission>',
)


def test_a_caster_turns_by_itself_in_test(modelica_library: Path, tmp_path: Path) -> None:
    """Its mass lies beside its axis: it falls with m*g*l/(I + m*l^2), while the sweep of Test moves the wheel."""
    package = generate(CART.encode(), Target("Cart", "Cart"))
    source = "model Fall\n  import Modelica;\n  import UrdfSync;\n  import Cart;\n  extends Cart.CartTest;\nend Fall;\n"
    values = ["robot.caster.revolute.a", "robot.caster.revolute.phi", "robot.casterAxis.tau", "robot.driveAxis.phi"]
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [Task(source, "Fall", [Run(0.5, 0.1)], values)])
    assert series.values[values[0]][0] == pytest.approx(0.5 * 9.80665 * 0.1 / (0.001 + 0.5 * 0.1**2), rel=1e-9)
    fallen, torque, driven = (np.abs(series.values[name]) for name in values[1:])
    assert fallen.max() > 1
    assert torque.max() == 0
    assert driven[-1] > 1e-3


SWING = robot(
    link("base", 1.0),
    '<link name="bob"><inertial><origin xyz="0 0 -0.4"/><mass value="2"/>'
    '<inertia ixx="0" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0"/></inertial></link>',
    link("car", 3.0),
    joint("pivot", "continuous", "base", "bob", axis="0 1 0", rpy="0 0 0", inside=[dynamics(0, 0, spring_stiffness=7)]),
    joint("rail", "prismatic", "base", "car", axis="1 0 0", rpy="0 0 0"),
    '<gazebo reference="rail"><springStiffness>48</springStiffness><springReference>0.5</springReference></gazebo>',
)
"""A pendulum with a spring, and a car on a spring."""


def test_springs_swing_as_theory_says(modelica_library: Path, tmp_path: Path) -> None:
    """A small swing of sqrt((k + m*g*l)/(J + m*l^2)), and one of sqrt(k/m) about the reference."""
    package = generate(SWING.encode(), Target("Swing", "Swing"))
    body = """Swing.Swing robot(pivot(phi_start = 1e-4), rail(s_start = 0.3));
  equation
    connect(world.frame_b, robot.frame_a);"""
    runs = [Run(5.0, 0.05, tolerance=1e-10)]
    values = ["robot.pivot.revolute.phi", "robot.rail.prismatic.s"]
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [bench(body, runs, values, packages=["Swing"])])
    swing = np.sqrt((7 + 2 * GRAVITY * 0.4) / (0.05 + 2 * 0.4**2))
    assert series.values[values[0]] == pytest.approx(1e-4 * np.cos(swing * series.times), abs=1e-9)
    assert series.values[values[1]] == pytest.approx(0.5 - 0.2 * np.cos(4 * series.times), abs=1e-6)
