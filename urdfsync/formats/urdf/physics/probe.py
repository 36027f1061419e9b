"""Writes the Modelica text that moves a generated robot by `motion`, and names the variables to read.

The text uses only `m` and the variables below, so that it also works with edited packages.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.domain import Target
from urdfsync.domain.experiment import Probe
from urdfsync.formats.urdf.kinematics.poses import roll_pitch_yaw
from urdfsync.formats.urdf.options import USES
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.subject import Subject
from urdfsync.formats.urdf.robot import MOTION_KINDS, MOTIONS, Origin
from urdfsync.modelica.literals import matrix, vector

_FAR_GROUND = -1e9  # in m: so deep that nothing touches the ground
_PARTS = (Path(__file__).parent / "parts.mo").read_text("utf-8")

FORCE = tuple(f"base.frame_b.f[{i}]" for i in (1, 2, 3))
TORQUE = tuple(f"base.frame_b.t[{i}]" for i in (1, 2, 3))
"""Force and torque of the robot on the moving base, resolved in the root link's frame."""
MASS = ("mass",)
CENTRE = tuple(f"centre[{i}]" for i in (1, 2, 3))
"""Centre of mass in the world; zero without a mass."""


class RobotVariables(msgspec.Struct, frozen=True):
    """Names of variables in a model whose component `robot` is the robot."""

    declaration: str
    """Declaration of the robot, without the modifiers of the comparison."""
    is_package: bool
    """Whether the robot is that of the package, not the generic robot."""
    moment: str
    """In kg·m: an expression for the sum of mass times place over all links."""
    flanges: Mapping[str, str]
    """Axis connector of each joint that can be driven."""
    accelerations: Mapping[str, str]
    """Acceleration of each joint that can be driven, except joints whose edited models have another inside.

    Six derivatives of `flanges` take a compiler 3 s.
    """
    places: Mapping[str, tuple[str, ...]]
    """Place of each link's frame."""
    axes: Mapping[str, tuple[str, ...]]
    """Rotation matrix of each link's frame, as Modelica defines it."""
    joints: Mapping[str, str]
    """Component of each joint; empty for the record."""
    sensors: Mapping[str, str]
    """Component of each sensor; empty for the record."""
    loops: Mapping[str, str]
    """Component of each loop; empty for the record."""


def robot_variables(subject: Subject, approach: str) -> RobotVariables:
    """Return the names for an approach. The record has the names of the generic robot, which numbers its links."""
    tree, target, names = subject.tree, subject.target, subject.connectors
    moments, three = list[str](), (1, 2, 3)
    places, axes, is_package = dict[str, tuple[str, ...]](), dict[str, tuple[str, ...]](), approach == "package"
    sensors = {name: f"robot.{component}" for name, component in names.sensors.items() if is_package}
    joints = {joint.name: f"robot.{tree.joint(joint.name).component}" for joint in tree.joints if is_package}
    if is_package:
        declaration = f"{target.package}.{target.name} robot(animation = false, "
        flanges = {name: f"robot.{drive.axis}" for name, drive in names.drives.items()}
        movers = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic"}
        accelerations = dict[str, str]()
        for joint in tree.joints:
            inside, file = movers.get(joint.type), f"Joints/{tree.joint(joint.name).type}.mo"
            if inside and (file not in subject.texts or f" {inside}(".encode() in subject.texts[file]):
                accelerations[joint.name] = f"{joints[joint.name]}.{inside}.a"
    else:
        record = f"{target.package}.{target.name}Parameters"
        declaration = f"UrdfSync.Robots.GenericRobot robot(redeclare parameter {record} data, checkLimits = false, "
        numbered = [(joint.name, kind, k) for kind in MOTIONS for k, joint in enumerate(tree.axes(kind), 1)]
        flanges = {name: f"robot.{kind}Axis[{k}]" for name, kind, k in numbered}
        accelerations = {name: f"robot.{'a_phi' if kind == 'rotational' else 'a_s'}[{k}]" for name, kind, k in numbered}
    for k, link in enumerate(tree.links, 1):
        if is_package:
            part = f"robot.{tree.link(link.name).component}"
            places[link.name] = tuple(f"{part}.frame_a.r_0[{i}]" for i in three)
            axes[link.name] = tuple(f"{part}.frame_a.R.T[{i},{j}]" for i in three for j in three)
            inertial = f"{part}.parameters.inertial"
            centre = f"Modelica.Mechanics.MultiBody.Frames.resolve1({part}.frame_a.R, {inertial}.origin.xyz)"
            moments.append(f"{inertial}.mass*({part}.frame_a.r_0 + {centre})")
        else:
            places[link.name] = tuple(f"robot.r_0[{k},{i}]" for i in three)
            axes[link.name] = tuple(f"robot.R_0[{k},{j},{i}]" for i in three for j in three)
            centre = f"robot.R_0[{k}, :, :]*robot.data.linkCenters[{k}, :]"
            moments.append(f"robot.data.linkMasses[{k}]*(robot.r_0[{k}, :] + {centre})")
    loops = {loop.name: f"robot.{tree.loop(loop.name).component}" for loop in tree.loops if is_package}
    moment = " + ".join(moments)
    return RobotVariables(declaration, is_package, moment, flanges, accelerations, places, axes, joints, sensors, loops)


def moving_probe(
    subject: Subject,
    names: RobotVariables,
    values: Iterable[str],
    step: float,
) -> Probe:
    """Return a model in which base and axes move through all instants; `step` is the interval of results, in s."""
    world = f"n = {{0, 0, -1}}, g = {motion.GRAVITY!r}, enableAnimation = false"
    declarations = [f"inner Modelica.Mechanics.MultiBody.World world({world})"]
    if subject.options.base == "floating":
        declarations.append(f"inner UrdfSync.Contacts.Ground ground(height = {_FAR_GROUND!r})")
    declaration = f"{names.declaration}fixedStart = false)"
    if subject.balls:
        declaration = "Driven_ robot(animation = false, fixedStart = false)"
    declarations.append(declaration)
    connections = ["base.frame_b, robot.frame_a"]
    for k, (joint, courses) in enumerate(zip(subject.axes, subject.courses, strict=True), 1):
        if joint.type == "ball":
            continue
        drive = MOTION_KINDS[joint.type].capitalize()
        declarations.append(f"{drive}Drive drive{k}(ways = {matrix(motion.ways(courses), 6)})")
        connections.append(f"drive{k}.flange, {names.flanges[joint.name]}")
    for k, loop in enumerate(subject.tree.loops, 1):
        ends = (loop.parent, loop.origin), (loop.child, loop.child_origin)
        parent, child = (_place(f"robot.{subject.tree.link(link).component}", origin) for link, origin in ends)
        declarations.append(f"Real gap{k}[3] = {child} - ({parent})")
    centre = f"({names.moment})/(if mass > 0 then mass else 1)"
    declarations += ["Real mass = robot.m", f"Real centre[3] = {centre}"]
    base = zip(("x", "y", "z", "turn"), subject.base, strict=True)
    tables = ", ".join(f"{name} = {matrix(motion.ways(courses), 6)}" for name, courses in base)
    declarations.append(f"MovingBase base({tables}, axis = {vector(motion.TURN_AXIS)})")
    source = text(subject.target, "", declarations, connections, _driven_balls(subject))
    last = float(max(motion.Instant))
    # integration closes loops: its error, times the square of its decay rate, adds to the accelerations
    tolerance = 3e-12 if subject.tree.loops else None
    return Probe(source, "Probe_.Probe", last, step, tuple(values), tolerance)


def _driven_balls(subject: Subject) -> list[str]:
    """Return the lines of a class that prescribes the motion of ball joints; no lines without ball joints.

    The class extends the robot, since only then it may connect drives to the frames of joints.
    """
    target, axis = subject.target, vector(motion.TURN_AXIS)
    components = [subject.tree.joint(ball.name).component for ball in subject.balls]
    if not components:
        return []
    modifiers = ", ".join(f"{component}(hasStates = false)" for component in components)
    lines, connections = [f"extends {target.package}.{target.name}({modifiers});"], ["equation"]
    for component, courses in zip(components, subject.courses[-len(components) :], strict=True):
        drive, ways = f"{component}Drive_", matrix(motion.ways(courses), 6)
        rpy = f"{component}.parameters.origin.rpy"
        lines.append(f"BallDrive {drive}(ways = {ways}, axis = {axis}, rpy = {rpy});")
        connections += (f"connect({component}.{frame}, {drive}.{frame});" for frame in ("frame_a", "frame_b"))
    return ["model Driven_", *lines, *connections, "end Driven_;"]


def free_probe(
    subject: Subject, names: RobotVariables, courses: Sequence[Course], efforts: Sequence[float], values: Iterable[str]
) -> Probe:
    """Return a model with efforts on the axes.

    `courses` give the positions and speeds of the axes at the start. The model extends the bench of Run and Test, and
    so has the gravity of both.
    """
    starts, turning, sliding = list[str](), dict[str, tuple[float, float]](), dict[str, tuple[float, float]]()
    axes, options = subject.axes, subject.options
    for joint, course in zip(axes, courses, strict=True):
        component = names.joints.get(joint.name, "").removeprefix("robot.")
        if joint.type == "ball":
            sine, cosine = math.sin(course.position / 2), math.cos(course.position / 2)
            angles = roll_pitch_yaw((*(sine * part for part in motion.TURN_AXIS), cosine))
            speeds = [course.speed * part for part in motion.TURN_AXIS]
            starts.append(f"{component}(rpy_start = {vector(angles)}, w_start = {vector(speeds)})")
            continue
        is_turning = MOTION_KINDS[joint.type] == "rotational"
        (turning if is_turning else sliding)[joint.name] = course.position, course.speed
        q, v = ("phi", "w") if is_turning else ("s", "v")
        place = f"{q}_start = {course.position!r}, " if course.position != subject.starts[joint.name] else ""
        starts.append(f"{component}({place}{v}_start = {course.speed!r})")
    if not names.joints and starts:
        starts = [
            f"{name}_start = {vector([start[k] for start in some.values()])}"
            for some, pair in ((turning, ("phi", "w")), (sliding, ("s", "v")))
            for k, name in enumerate(pair)
            if some
        ]
    modifiers = ", ".join([*starts, "fixedStart = true)"])
    declarations, connections = [f"{names.declaration}{modifiers}"], ["world.frame_b, robot.frame_a"]
    bench = "UrdfSync.Robots.PartialBench(world(enableAnimation = false))"
    if options.base == "floating":
        connections = ["base.frame_b, robot.frame_a"]
        start = ", ".join(f"{name} = {vector(value)}" for name, value in motion.FREE_START.items() if name != "r_start")
        start += f", stance(height = {motion.FREE_START['r_start'][2]!r})"
        ground = f"ground(height = {_FAR_GROUND!r}, animation = false)"
        bench = f"UrdfSync.Robots.PartialMobileBench({start}, world(enableAnimation = false), {ground})"
    for k, (joint, effort) in enumerate(zip(axes, efforts, strict=True), 1):
        if joint.type == "ball":
            ends = [f"{names.joints[joint.name]}.frame_{end}.R" for end in "ab"]
            carried = f"Modelica.Mechanics.MultiBody.Frames.resolveRelative({ends[0]}.w, {', '.join(ends)})"
            declarations += [f"Real spin{k}[3] = {ends[1]}.w - {carried}", f"Real gain{k}[3] = der(spin{k})"]
            continue
        declarations.append(f"{MOTION_KINDS[joint.type].capitalize()}Push push{k}(effort = {effort!r})")
        connections.append(f"push{k}.flange, {names.flanges[joint.name]}")
        if joint.name not in names.accelerations:
            declarations += [
                f"Real speed{k} = der(push{k}.flange.{'phi' if MOTION_KINDS[joint.type] == 'rotational' else 's'})",
                f"Real gain{k} = der(speed{k})",
            ]
    source = text(subject.target, bench, declarations, connections)
    return Probe(source, "Probe_.Probe", 1e-6, 1e-6, tuple(values))


def free_course(subject: Subject, number: int) -> Course:
    """Return the start of an axis in the free motion; `number` counts the axes from 0.

    An axis in a loop keeps the package's start position. So does every second axis, except ball joints.
    """
    joint = subject.axes[number]
    course = motion.axis_course(joint)
    is_at_start = subject.is_in_loop(joint) or (number % 2 == 0 and joint.type != "ball")
    return course._replace(position=subject.starts[joint.name]) if is_at_start else course


def _place(link: str, origin: Origin) -> str:
    """Return an expression for the place of a frame on a link."""
    frame = f"{link}.frame_a"
    return f"{frame}.r_0 + Modelica.Mechanics.MultiBody.Frames.resolve1({frame}.R, {vector(origin.xyz)})"


def text(
    target: Target,
    bench: str,
    declarations: Iterable[str],
    connections: Iterable[str],
    classes: Iterable[str] = (),
) -> str:
    """Return the package `Probe_`, whose model `Probe` may extend a bench; `classes` are lines of other classes."""
    libraries = [name for name, _ in USES]
    imports = dict.fromkeys([*libraries, target.package.partition(".")[0]])  # rumoca loads only imported libraries
    lines = [
        "package Probe_",
        *(f"  import {library};" for library in imports),
        _PARTS,
        *(f"  {line}" for line in classes),
        "  model Probe",
        *([f"    extends {bench};"] if bench else []),
        *(f"    {declaration};" for declaration in declarations),
        "  equation",
        *(f"    connect({connection});" for connection in connections),
        "  end Probe;",
        "end Probe_;",
        "",
    ]
    return "\n".join(lines)
