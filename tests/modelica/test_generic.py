"""The generic robots against Pinocchio: any robot, read from its record.

Two robots have all there is: joints that turn and slide, on a chain and on branches, links behind fixed joints, mimic
joints in a chain and at a joint that does not move, damping and dry friction.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec
import numpy as np
import pytest
import test_joints
import test_limits
from support import generic, physics
from support.modelica import (
    GRAVITY,
    URDFSYNC,
    Array,
    Run,
    Series,
    Task,
    bench,
    compile_task,
    execute,
    simulate,
    simulate_all,
)
from support.packages import generate
from support.urdfs import dynamics, joint, link, links, mimic, robot

from urdfsync.domain import Target
from urdfsync.urdf.kinematics.poses import start_positions
from urdfsync.urdf.physics import motion

pytestmark = pytest.mark.slow

GRIPPER = robot(
    *links(base=2.0, plate=1.0),
    *(link(name, 1.5) for name in ("arm", "slide", "wheel", "finger", "thumb")),
    link("sensor", 0.3),
    joint("bolts", "fixed", "base", "plate"),
    joint("shoulder", "revolute", "plate", "arm", axis="0.6 0 0.8", inside=[dynamics(0.4, 0.2)]),
    joint("rail", "prismatic", "arm", "slide", axis="0 1 0", inside=[dynamics(3.0, 0.5)]),
    joint("mount", "fixed", "slide", "sensor"),
    joint("roll", "continuous", "sensor", "wheel", axis="1 0 0"),
    joint("grip", "prismatic", "slide", "finger", axis="1 0 0", inside=[mimic("shoulder", 0.1, 0.02)]),
    joint("press", "revolute", "slide", "thumb", axis="0 0 1", inside=[mimic("grip", -4.0, 0.3)]),
)
"""A chain with branches; press follows grip, and grip follows shoulder."""

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
STATUE = robot(
    *links(base=1.0, head=1.0, hat=1.0),
    joint("neck", "fixed", "base", "head"),
    joint("tilt", "revolute", "head", "hat", axis="0 1 0", inside=[mimic("neck", 1, 0.4)]),
)
"""No axis: a fixed joint, and one that follows it."""
MASSLESS = robot(
    *(link(name, mass) for name, mass in {"base": 1.0, "arm": 1.0, "tip": None}.items()),
    joint("lift", "revolute", "base", "arm", axis="0 1 0"),
    joint("twist", "revolute", "arm", "tip", axis="0 0 1"),
)
SLIDER = robot(
    link("base", 1.0),
    '<link name="box"><inertial><mass value="0"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>',
    joint("push", "prismatic", "base", "box", axis="0 0 1"),
)
"""Inertia, but no mass behind a joint that slides."""
FOLLOWER = robot(
    *(link(name, mass) for name, mass in {"base": 1.0, "arm": 1.0, "dial": None}.items()),
    joint("lift", "continuous", "base", "arm", axis="0 1 0"),
    joint("spin", "continuous", "arm", "dial", axis="0 0 1", inside=[mimic("lift", 2.0)]),
)
"""A joint without mass follows one with mass."""
LEADER = robot(
    *(link(name, mass) for name, mass in {"base": 1.0, "crank": None, "arm": 1.0}.items()),
    joint("turn", "continuous", "base", "crank", axis="0 1 0"),
    joint("follow", "continuous", "base", "arm", axis="0 0 1", inside=[mimic("turn", 2.0)]),
)
"""A joint with mass follows one without."""
TWINS = robot(
    *(link(name, mass) for name, mass in {"base": 1.0, "ring": None, "arm": 1.0}.items()),
    joint("first", "continuous", "base", "ring", axis="0.6 0 0.8"),
    joint("second", "continuous", "ring", "arm", axis="0.6 0 0.8", xyz="0.3 0 0.4", rpy="0 0 0"),
)
"""Two joints on one axis, nothing between them."""
PUCK = robot(link("base"), link("puck", 1), joint("glide", "planar", "base", "puck", axis="0 0 1"))
DRIVEN = """
    parameter Real k = 0;
    Modelica.Mechanics.Rotational.Sources.Position drive(exact = true);
  equation
    drive.phi_ref = k*time^2;
    connect(drive.flange, robot.rotationalAxis[1]);"""

ROBOTS = {"gripper": GRIPPER, "ladder": LADDER}
FLOATING = {"gripper": True, "ladder": False}
GOLDEN = Path(__file__).resolve().parents[1] / "golden"
START = motion.Course(0.3, 0.2, 0.0)
STOP, STEPS = 0.5, 1500
TOLERANCE = 1e-9
"""Of the integration, so that its error is far below what is compared."""
PRESCRIBED = (("gripper", "GenericRobot"), ("gripper", "ArticulatedRobot"), ("ladder", "GenericRobot"))
"""What is compared at prescribed motion; at free motion it is everything."""
CLASSES = ("PartialRecordRobot", "PartialGenericRobot", "GenericRobot")
PASSING = ("lower", "backward", "slide", "effort", "leader", "follower")
INSIDE = ("at rest", "leading as strong as allowed")
"""Of the motions of the tests of limits, those that stand for the others."""
AXES = {
    "elbow": "rotationalAxis[2]",
    "lid": "rotationalAxis[1]",
    "roll": "rotationalAxis[3]",
    "rail": "translationalAxis[1]",
}
"""Of the robot of the tests of limits, in the order of its record."""


def test_poses_and_efforts_of_prescribed_motion_agree_with_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    """Base and axes move; efforts of all axes, what acts on the base, mass and centre are compared."""
    cases = [in_form(name, form) for name, form in PRESCRIBED]
    twig = GOLDEN / "twig.urdf"
    others: dict[str, tuple[bytes | Path, str]] = {
        "Chain": (test_joints.CHAIN.encode(), "fixed"),
        "Mixed": (test_joints.GRIPPER.encode(), "fixed"),
        "Bolted": (twig, "fixed"),
        "Loose": (twig, "floating"),
        "Stone": (STONE.encode(), "fixed"),
        "Statue": (STATUE.encode(), "floating"),
    }
    for name, (source, base) in others.items():
        cases.append(physics.prepare(source, name, approach=("record",), base=base))
    assert [physics.fault(found) for found in physics.compare(modelica_library, tmp_path, cases)] == [None] * len(cases)


def in_form(name: str, form: str) -> physics.Case:
    """The experiment with one of the robots in one of the formulations."""
    case = physics.prepare(ROBOTS[name].encode(), name.title(), approach=("record",))
    probe = case.experiment.probe
    assert probe.source.count(".GenericRobot ") == 1
    source = probe.source.replace(".GenericRobot ", f".{form} ")
    experiment = msgspec.structs.replace(case.experiment, probe=msgspec.structs.replace(probe, source=source))
    return physics.Case(experiment, case.package)


def test_free_motion_agrees_with_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    """The ladder on a fixed base, the gripper on one that falls and turns."""
    robots = [generic.prepare(text.encode(), name.title()) for name, text in ROBOTS.items()]
    todo = [(own, FLOATING[name], form) for name, own in zip(ROBOTS, robots, strict=True) for form in generic.FORMS]
    tasks = [generic.free_task(own, form, starts(own), STOP, TOLERANCE, base) for own, base, form in todo]
    runs = simulate(modelica_library, [own.package.write(tmp_path) for own in robots], tasks)
    for (own, base, _), task, series in zip(todo, tasks, runs, strict=True):
        expected = generic.free_motion(own, starts(own), STOP, STEPS, base)
        assert np.abs(expected[: len(own.reference.axes)] - START.position).min() > 1e-3, "every axis moves"
        assert np.abs(series.end(*task.values) - expected).max() < 1e-6


def starts(own: generic.Robot) -> list[motion.Course]:
    return [START] * len(own.reference.axes)


def test_the_reference_converges() -> None:
    """With half the steps it changes far less than the comparison tolerates."""
    own = generic.prepare(GRIPPER.encode())
    coarse, fine = (
        generic.free_motion(own, starts(own), STOP, steps, FLOATING["gripper"]) for steps in (STEPS, 2 * STEPS)
    )
    assert np.abs(coarse - fine).max() < 1e-7


def strict_generic() -> str:
    """The generic robot as it is, but passing a limit is an error, which the compiler tells."""
    texts = [(URDFSYNC / "Robots" / f"{name}.mo").read_text("utf-8") for name in CLASSES]
    joined = "".join(text.replace("within UrdfSync.Robots;", "") for text in texts)
    joined = re.sub(rf"UrdfSync\.Robots\.({'|'.join(CLASSES)})\b", r"\1", joined)
    assert joined.count("AssertionLevel.warning") == 5
    return joined.replace("AssertionLevel.warning", "AssertionLevel.error")


@pytest.fixture(scope="module")
def at_limits(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Series]:
    """What comes of the motions of the tests of limits, by their names."""
    robot = "GenericRobot robot(redeclare parameter Bot.BotParameters data, fixedStart = false, checkLimits = true);"
    passing = {name: Run(1.0, 0.1, test_limits.PASSING[name][0]) for name in PASSING}
    inside = {
        name: Run(stop, stop / 10, motion) for name, (motion, stop) in test_limits.INSIDE.items() if name in INSIDE
    }
    folder = tmp_path_factory.mktemp("limits")
    packages = [
        generate(text.encode(), Target(name, name), approach=("record",)).write(folder)
        for text, name in ((test_limits.ROBOT, "Bot"), (MASSLESS, "Light"), (SLIDER, "Slider"))
    ]
    inertial = "robot.data.tip.inertial"
    heavy = {f"{inertial}.mass": 1.0}
    classes = strict_generic()
    light = [Run(), Run(parameters=heavy), Run(parameters={f"{inertial}.inertia.izz": 0.1})]
    tasks = [
        test_limits.driven(robot, AXES, [*passing.values(), *inside.values()], classes=classes),
        free("Light", "GenericRobot", light, classes=classes),
        free("Slider", "GenericRobot", [Run(), Run(parameters={"robot.data.box.inertial.mass": 1.0})], classes=classes),
    ]
    names = [*passing, *inside, "massless", "mass on the axis", "with inertia", "inertia that slides", "with mass"]
    return dict(zip(names, simulate_all(modelica_library, packages, tasks), strict=True))


def free(
    name: str, form: str, runs: Sequence[Run], values: Sequence[str] = (), *, classes: str = "", drive: str = "equation"
) -> Task:
    """A robot that is read from the record of a package, without drives but for `drive`."""
    robot = f"{form} robot(redeclare parameter {name}.{name}Parameters data);"
    body = f"{robot}\n{drive}\n    connect(world.frame_b, robot.frame_a);"
    return bench(body, runs, values, packages=[name], classes=classes)


def test_a_limit_that_is_passed_is_named(at_limits: Mapping[str, Series]) -> None:
    for limit_name in PASSING:
        _, time, message = test_limits.PASSING[limit_name]
        found = re.search(r"assert failed at t=([\d.]+): (.*)", at_limits[limit_name].error)
        assert found, at_limits[limit_name].error or f"{limit_name}: the simulation ran to its end"
        assert float(found[1]) == pytest.approx(time, rel=1e-3)
        assert found[2].strip() == "Bench.robot " + message[message.index("(joint") :]


def test_nothing_is_said_inside_the_limits(at_limits: Mapping[str, Series]) -> None:
    assert [at_limits[name].error for name in INSIDE] == [""] * len(INSIDE)


def test_a_free_joint_without_inertia_is_named(at_limits: Mapping[str, Series]) -> None:
    """Also where there is mass, but on the axis, and where what slides has moments of inertia only."""
    named = {"massless": "twist", "mass on the axis": "twist", "inertia that slides": "push"}
    for case, joint_name in named.items():
        message = "has no inertia about or along its axis: it can be driven by position"
        assert f"Bench.robot (joint {joint_name}) {message}" in at_limits[case].error
    assert [at_limits[case].error for case in ("with inertia", "with mass")] == ["", ""]


@pytest.mark.parametrize(("text", "named"), [(FOLLOWER, "spin"), (LEADER, "turn")], ids=["follower", "leader"])
def test_articulated_equations_refuse_a_joint_without_inertia_of_its_own(
    modelica_library: Path, tmp_path: Path, text: str, named: str
) -> None:
    """They divide by it; the Newton-Euler equations move such robots."""
    folder = generate(text.encode(), Target("Light", "Light"), approach=("record",)).write(tmp_path)
    tasks = [free("Light", f"UrdfSync.Robots.{form}", [Run()], ["robot.q[1]"]) for form in generic.FORMS]
    newton, articulated = (outcome.runs[0] for outcome in execute(modelica_library, [folder], tasks))
    assert newton.error == ""
    assert abs(newton.values["robot.q[1]"][-1]) > 1e-6, "it falls"
    assert f"Bench.robot (joint {named}) of robot own has no inertia about or along its own axis" in articulated.error
    assert "use GenericRobot" in articulated.error


def test_a_joint_that_the_next_one_can_undo_is_refused_and_can_be_driven_by_position(
    modelica_library: Path, tmp_path: Path
) -> None:
    """The arm falls where it would fall by itself, so the second joint takes back what the first one does."""
    folder = generate(TWINS.encode(), Target("Twins", "Twins"), approach=("record",)).write(tmp_path)
    values = ["robot.q[1]", "robot.q[2]"]
    runs = [Run(0.1, 0.1), Run(0.1, 0.1, {"k": 1})]
    tasks = [
        free("Twins", "UrdfSync.Robots.ArticulatedRobot", [Run()], values),
        free("Twins", "UrdfSync.Robots.GenericRobot", runs, values, drive=DRIVEN),
    ]
    (refused,), moved = (outcome.runs for outcome in execute(modelica_library, [folder], tasks))
    assert "Bench.robot (joint first) of robot own has no inertia about or along its own axis if" in refused.error
    assert "use GenericRobot, and drive the joint by position" in refused.error
    still, turning = (run.values["robot.q[1]"] + run.values["robot.q[2]"] for run in moved)
    assert abs(still[-1]) > 1e-3, "it falls"
    assert turning[-1] == pytest.approx(still[-1], abs=1e-6)
    assert moved[1].values["robot.q[1]"][-1] == pytest.approx(0.01)


def test_benches_of_records_can_be_simulated_at_once_or_say_why_not(modelica_library: Path, tmp_path: Path) -> None:
    """The generic robots can't take planar joints."""
    names = {"Bolted": "fixed", "Free": "floating"}
    twig, record = GOLDEN / "twig.urdf", ("record",)
    packages = [generate(twig, Target(name, name), approach=record, base=base) for name, base in names.items()]
    packages.append(generate(PUCK.encode(), Target("Zoo", "Zoo"), approach=record))
    values = ("robot.r_0[1,3]", "robot.rotationalAxis[1].phi")
    tasks = [compile_task(f"{name}.{name}Generic", runs=[Run(0.2, 0.1)], values=values) for name in names]
    tasks += [free("Zoo", f"UrdfSync.Robots.{form}", [Run()]) for form in generic.FORMS]
    folders = [package.write(tmp_path) for package in packages]
    bolted, loose, *refused = simulate_all(modelica_library, folders, [*tasks, compile_task("Zoo.ZooParameters")])
    for series in refused:
        message = "Bench.robot: robot own has planar or floating joints, so its record has no tables. Use the package"
        assert message in series.error
    height, angle = (bolted.values[name] for name in values)
    assert set(height) == {0.0}
    assert angle[-1] > 0.001, "the axis has set out"
    fallen = loose.values[values[0]]
    assert fallen[-1] - fallen[0] == pytest.approx(-9.81 * 0.2**2 / 2, abs=0.01), "nothing holds it"


FORCE = (3.0, -4.0, 5.0)
PULLED = """\
UrdfSync.Robots.{form} robot(redeclare parameter Bot.BotParameters data, tool = {tool}, checkLimits = false);
    Modelica.Mechanics.MultiBody.Forces.WorldForce pull(animation = false);
  equation
    connect(world.frame_b, robot.frame_a);
    connect(robot.frame_b, pull.frame_b);
    pull.force = {{3, -4, 5}};"""
"""A force of the world acts on a link."""


@pytest.mark.parametrize("link", ["wheel", "sensor", "plate"])
def test_a_force_at_the_tool_frame_accelerates_the_robot_as_pinocchio_says(
    modelica_library: Path, tmp_path: Path, link: str
) -> None:
    """A link behind a moving joint, one behind a fixed joint of another body, and one that does not move."""
    own = generic.prepare(GRIPPER.encode())
    tool = [each.name for each in own.skeleton.links].index(link) + 1
    values = ["robot.a_phi[1]", "robot.a_phi[2]", "robot.a_s[1]"]
    tasks = [
        bench(PULLED.format(form=form, tool=tool), [Run(1e-6, 1e-6)], values, gravity=9.81) for form in generic.FORMS
    ]
    expected = accelerations(own, link)
    for series in simulate(modelica_library, [own.package.write(tmp_path)], tasks):
        assert [series.values[value][0] for value in values] == pytest.approx(expected, abs=1e-8)
    assert (np.abs(expected - accelerations(own, "base")).max() > 0.1) == (link != "plate")


def accelerations(own: generic.Robot, link: str) -> Array:
    """Of the axes at rest at their start, with the Jacobian of the link."""
    reference = own.reference
    pin, model = reference.pin, reference.model
    state = generic.at_rest(own, np.zeros(len(reference.axes)), np.zeros(len(reference.axes)))
    data = model.createData()
    bias = pin.nonLinearEffects(model, data, state.q, np.zeros(model.nv))
    frame = model.getFrameId(link, pin.BODY)
    jacobian = pin.computeFrameJacobian(model, data, state.q, frame, pin.LOCAL_WORLD_ALIGNED)[:3]
    return generic.forward(reference, state, bias - jacobian.T @ np.array(FORCE))


GRIPPER_BODY = """<origin xyz="0 0 0.0393"/>
      <mass value="0.82"/>
      <inertia ixx="0.0005742" ixy="0" ixz="0" iyy="0.0011987" iyz="0" izz="0.0011859"/>"""
HEAVY_BODY = """<origin xyz="0 0 0.05"/>
      <mass value="4"/>
      <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.006" iyz="0" izz="0.006"/>"""
LONGER = (('xyz="0.15 0 0.04"', 'xyz="0.4 0 0.03"'), (GRIPPER_BODY, HEAVY_BODY))
STUDY: Mapping[str, tuple[str, Sequence[tuple[str, str]]]] = {
    "GenericRobot": ("six_axis_arm", ()),
    "RobotStudy.LongArm": ("six_axis_arm", LONGER),
    "RobotStudy.Wheeled": ("wheeled_robot", ()),
}
"""Per model that is the bench with a record: the URDF of its robot, and what is changed in it."""
TOOLS = {"six_axis_arm": "drive_pinion", "wheeled_robot": "camera_optical_frame"}
MOMENT = 0.2


def test_a_study_redeclares_the_record(modelica_library: Path) -> None:
    """The same bench with three records: each robot drops as Pinocchio says that it does."""
    runs, values = [Run(MOMENT, MOMENT, tolerance=TOLERANCE)], [f"r_tool[{i}]" for i in (1, 2, 3)]
    tasks = [compile_task(f"UrdfSync.Examples.{name}", runs=runs, values=values) for name in STUDY]
    for (file, changes), series in zip(STUDY.values(), simulate(modelica_library, [], tasks), strict=True):
        before, after = dropped(file, changes)
        found = np.array([series.values[value] for value in values])
        assert found[:, 0] == pytest.approx(before, abs=1e-9)
        assert found[:, -1] == pytest.approx(after, abs=1e-6)
        assert before[2] - after[2] > 0.01, "it drops"


def dropped(file: str, changes: Sequence[tuple[str, str]]) -> tuple[Array, Array]:
    """Where Pinocchio has the tool at the start and at the end."""
    text = (URDFSYNC / "Resources" / "robots" / file / f"{file}.urdf").read_text("utf-8")
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    own = generic.prepare(text.encode())
    own.reference.model.gravity.linear = np.array([0, 0, -GRAVITY])
    positions = start_positions(own.skeleton)
    start = [motion.Course(positions[name], 0.0, 0.0) for name in own.reference.axes]
    end = generic.free_motion(own, start, MOMENT, 2000)
    return generic.link_place(own, np.array(start)[:, 0], TOOLS[file]), generic.link_place(own, end, TOOLS[file])
