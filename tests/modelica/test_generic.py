"""The generic robots against Pinocchio: any robot, read from its record."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np
import pinocchio as pin
import pytest
from support import generic, physics
from support.cases import sampled
from support.modelica import GRAVITY, URDFSYNC, Array, Run, Task, bench, compile_task, execute, simulate, simulate_all
from support.packages import generate
from support.urdfs import joint, link, links, mimic, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.kinematics.poses import start_positions
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.second.dynamics import mechanism_efforts

pytestmark = pytest.mark.slow

STATUE = robot(
    *links(base=1.0, head=1.0, hat=1.0),
    joint("neck", "fixed", "base", "head"),
    joint("tilt", "revolute", "head", "hat", axis="0 1 0", inside=[mimic("neck", 1, 0.4)]),
)
"""No axis: a fixed joint, and one that follows it."""
GEARED = robot(
    *links(base=1.0, arm=1.0),
    joint("turn", "revolute", "base", "arm", axis="0 1 0"),
    '<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="turn"/>'
    '<actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>',
)
"""A joint with a gear, whose numbers stand in the record."""
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

GOLDEN = Path(__file__).resolve().parents[1] / "golden"
START = motion.Course(0.3, 0.2, 0.0)
STOP, STEPS = 0.25, 750
TOLERANCE = 1e-9
"""Of the integration, so that its error is far below what is compared."""
FREE = (("ladder", "ArticulatedRobot", False), ("gripper", "ArticulatedRobot", True), ("gripper", "GenericRobot", True))
"""What is compared at free motion, and whether it falls and turns."""


def test_poses_and_efforts_of_prescribed_motion_agree_with_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    """Base and axes move; efforts of all axes, what acts on the base, mass and centre are compared."""
    cases = [in_form("gripper", "ArticulatedRobot"), physics.prepare(GEARED.encode(), "Geared", approach=("record",))]
    cases = [case.only("motion") for case in cases]
    assert [physics.fault(found) for found in physics.compare(modelica_library, tmp_path, cases)] == [None] * len(cases)


@pytest.mark.large
def test_robots_without_axes_and_branched_ones_agree_with_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    cases = [in_form("ladder", "GenericRobot")]
    cases.append(physics.prepare(GOLDEN / "twig.urdf", "Loose", approach=("record",), base="floating"))
    for name, source, base in (("Stone", generic.STONE, "fixed"), ("Statue", STATUE, "floating")):
        cases.append(physics.prepare(source.encode(), name, approach=("record",), base=base))
    assert [physics.fault(found) for found in physics.compare(modelica_library, tmp_path, cases)] == [None] * len(cases)


def in_form(name: str, form: str) -> physics.Case:
    """The experiment with one of the robots in one of the formulations."""
    case = physics.prepare(generic.ROBOTS[name].encode(), name.title(), approach=("record",))
    trials = []
    for trial in case.experiment.trials:
        assert trial.probe.source.count(".GenericRobot ") == 1
        source = trial.probe.source.replace(".GenericRobot ", f".{form} ")
        trials.append(msgspec.structs.replace(trial, probe=msgspec.structs.replace(trial.probe, source=source)))
    return physics.Case(msgspec.structs.replace(case.experiment, trials=tuple(trials)), case.package)


@pytest.mark.parametrize("case", sampled(FREE, 3))
@pytest.mark.large  # the other tests of this file move the same equations
def test_free_motion_agrees_with_pinocchio(case: tuple[str, str, bool], modelica_library: Path, tmp_path: Path) -> None:
    name, form, is_floating = case
    own = generic.prepare(generic.ROBOTS[name].encode(), name.title())
    task = generic.free_task(own, form, starts(own), STOP, TOLERANCE, is_floating)
    (series,) = simulate(modelica_library, [own.package.write(tmp_path)], [task])
    expected = generic.free_motion(own, starts(own), STOP, STEPS, is_floating)
    assert np.abs(expected[: len(own.reference.axes)] - START.position).min() > 1e-3, "every axis moves"
    assert np.abs(series.end(*task.values) - expected).max() < 1e-6


def starts(own: generic.Robot) -> list[motion.Course]:
    return [START] * len(own.reference.axes)


def test_the_reference_converges() -> None:
    """With half the steps it changes far less than the comparison tolerates."""
    own = generic.prepare(generic.GRIPPER.encode())
    coarse, fine = (
        generic.free_motion(own, starts(own), STOP, steps, is_floating=True) for steps in (STEPS, 2 * STEPS)
    )
    assert np.abs(coarse - fine).max() < 1e-7


def recorded(text: str, name: str, folder: Path) -> Path:
    """The package of a record with this name, written below a folder."""
    return generate(text.encode(), Target(name, name), approach=("record",)).write(folder)


def free(
    name: str, form: str, runs: Sequence[Run], values: Sequence[str] = (), *, classes: str = "", drive: str = "equation"
) -> Task:
    """A robot that is read from the record of a package, without drives but for `drive`."""
    robot = f"{form} robot(redeclare parameter {name}.{name}Parameters data);"
    body = f"{robot}\n{drive}\n    connect(world.frame_b, robot.frame_a);"
    return bench(body, runs, values, packages=[name], classes=classes)


@pytest.mark.large  # the other tests of this file move the same equations
def test_a_free_joint_without_inertia_is_named(modelica_library: Path, tmp_path: Path) -> None:
    """Also where there is mass, but on the axis, and where what slides has moments of inertia only."""
    inertial, slid = "robot.data.tip.inertial", "robot.data.box.inertial.mass"
    light = [Run(), Run(parameters={f"{inertial}.mass": 1.0}), Run(parameters={f"{inertial}.inertia.izz": 0.1})]
    classes = generic.strict_generic()
    tasks = [
        free("Light", "GenericRobot", light, classes=classes),
        free("Slider", "GenericRobot", [Run(), Run(parameters={slid: 1.0})], classes=classes),
    ]
    folders = [recorded(MASSLESS, "Light", tmp_path), recorded(SLIDER, "Slider", tmp_path)]
    massless, on_the_axis, with_inertia, sliding, with_mass = simulate_all(modelica_library, folders, tasks)
    for series, joint_name in ((massless, "twist"), (on_the_axis, "twist"), (sliding, "push")):
        message = "has no inertia about or along its axis: it can be driven by position"
        assert f"Bench.robot (joint {joint_name}) {message}" in series.error
    assert (with_inertia.error, with_mass.error) == ("", "")


@pytest.mark.large  # the other tests of this file move the same equations
def test_articulated_equations_refuse_a_joint_without_inertia_of_its_own(
    modelica_library: Path, tmp_path: Path
) -> None:
    """They divide by it; the Newton-Euler equations move such robots."""
    lights = {"Follower": (FOLLOWER, "spin"), "Leader": (LEADER, "turn")}
    folders = [recorded(text, name, tmp_path) for name, (text, _) in lights.items()]
    tasks = [
        free(name, f"UrdfSync.Robots.{form}", [Run()], ["robot.q[1]"]) for name in lights for form in generic.FORMS
    ]
    runs = simulate_all(modelica_library, folders, tasks)
    for (_, named), newton, articulated in zip(lights.values(), runs[::2], runs[1::2], strict=True):
        assert newton.error == ""
        assert abs(newton.values["robot.q[1]"][-1]) > 1e-6, "it falls"
        assert (
            f"Bench.robot (joint {named}) of robot own has no inertia about or along its own axis" in articulated.error
        )
        assert "use GenericRobot" in articulated.error


@pytest.mark.large  # the other tests of this file move the same equations
def test_a_joint_that_the_next_one_can_undo_is_refused_and_can_be_driven_by_position(
    modelica_library: Path, tmp_path: Path
) -> None:
    """The arm falls where it would fall by itself, so the second joint takes back what the first one does."""
    folder = recorded(TWINS, "Twins", tmp_path)
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


@pytest.mark.large  # the other tests of this file move the same equations
def test_benches_of_records_can_be_simulated_at_once_or_say_why_not(modelica_library: Path, tmp_path: Path) -> None:
    """The generic robots can't take planar joints."""
    names = {"Bolted": "fixed", "Free": "floating"}
    twig, record = GOLDEN / "twig.urdf", ("record",)
    packages = [generate(twig, Target(name, name), approach=record, base=base) for name, base in names.items()]
    values = ("robot.r_0[1,3]", "robot.rotationalAxis[1].phi")
    tasks = [compile_task(f"{name}.{name}Generic", runs=[Run(0.2, 0.1)], values=values) for name in names]
    tasks.append(free("Zoo", "UrdfSync.Robots.GenericRobot", [Run()]))
    folders = [*(package.write(tmp_path) for package in packages), recorded(PUCK, "Zoo", tmp_path)]
    bolted, loose, refused = simulate_all(modelica_library, folders, [*tasks, compile_task("Zoo.ZooParameters")])
    message = "Bench.robot: robot own has planar, floating or ball joints, so its record has no tables. Use the package"
    assert message in refused.error
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


PULLS = {"wheel": "ArticulatedRobot", "sensor": "GenericRobot", "plate": "GenericRobot"}
"""A link behind a moving joint, one behind a fixed joint of another body, and one that does not move."""


def test_a_force_at_the_tool_frame_accelerates_the_robot_as_pinocchio_says(
    modelica_library: Path, tmp_path: Path
) -> None:
    own = generic.prepare(generic.GRIPPER.encode())
    numbers = {each.name: number for number, each in enumerate(own.skeleton.links, 1)}
    values = ["robot.a_phi[1]", "robot.a_phi[2]", "robot.a_s[1]"]
    tasks = [
        bench(PULLED.format(form=form, tool=numbers[tool]), [Run(1e-6, 1e-6)], values, gravity=9.81)
        for tool, form in PULLS.items()
    ]
    still = accelerations(own, "base")
    for tool, series in zip(PULLS, simulate(modelica_library, [own.package.write(tmp_path)], tasks), strict=True):
        expected = accelerations(own, tool)
        assert [series.values[value][0] for value in values] == pytest.approx(expected, abs=1e-8)
        assert (np.abs(expected - still).max() > 0.1) == (tool != "plate")


def accelerations(own: generic.Robot, link: str) -> Array:
    """Of the axes at rest at their start, with the Jacobian of the link."""
    reference = own.reference
    model = reference.multibody.model
    state = generic.at_rest(own, np.zeros(len(reference.axes)), np.zeros(len(reference.axes)))
    data = model.createData()
    springs = mechanism_efforts(reference.dynamics, state.positions)
    bias = pin.nonLinearEffects(model, data, state.q, np.zeros(model.nv)) + springs
    frame = model.getFrameId(link, pin.BODY)
    jacobian = pin.computeFrameJacobian(model, data, state.q, frame, pin.LOCAL_WORLD_ALIGNED)[:3]
    return generic.forward(reference, state, bias - jacobian.T @ np.array(FORCE))


GRIPPER_BODY = """<origin xyz="0 0 0.0393"/>
      <mass value="0.82"/>
      <inertia ixx="0.0005742" ixy="0" ixz="0" iyy="0.0011987" iyz="0" izz="0.0011859"/>"""
HEAVY_BODY = """<origin xyz="0 0 0.05"/>
      <mass value="4"/>
      <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.006" iyz="0" izz="0.006"/>"""
STUDY = (('xyz="0.15 0 0.04"', 'xyz="0.4 0 0.03"'), (GRIPPER_BODY, HEAVY_BODY))
"""What is changed in the six-axis arm, which is that of the study otherwise."""
MOMENT = 0.2


@pytest.mark.large  # the other tests of this file redeclare records
def test_a_study_redeclares_the_record(modelica_library: Path) -> None:
    """The robot drops as Pinocchio says that it does."""
    runs, values = [Run(MOMENT, MOMENT, tolerance=TOLERANCE)], [f"r_tool[{i}]" for i in (1, 2, 3)]
    task = compile_task("UrdfSync.Examples.RobotStudy.LongArm", runs=runs, values=values)
    (series,) = simulate(modelica_library, [], [task])
    before, after = dropped()
    found = np.array([series.values[value] for value in values])
    assert found[:, 0] == pytest.approx(before, abs=1e-9)
    assert found[:, -1] == pytest.approx(after, abs=1e-6)
    assert before[2] - after[2] > 0.01, "it drops"


def dropped() -> tuple[Array, Array]:
    """Where Pinocchio has the tool at the start and at the end."""
    text = (URDFSYNC / "Resources/robots/six_axis_arm/six_axis_arm.urdf").read_text("utf-8")
    for old, new in STUDY:
        assert text.count(old) == 1
        text = text.replace(old, new)
    own = generic.prepare(text.encode())
    own.reference.set_gravity(GRAVITY)
    positions = start_positions(own.skeleton)
    start = [motion.Course(positions[name], 0.0, 0.0) for name in own.reference.axes]
    end = generic.free_motion(own, start, MOMENT, 2000)
    return generic.link_place(own, np.array(start)[:, 0], "drive_pinion"), generic.link_place(own, end, "drive_pinion")
