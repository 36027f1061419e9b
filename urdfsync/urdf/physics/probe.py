"""The Modelica text that moves a generated robot as `motion` says, and the variables that are read from it.

It relies on little, so that packages may be edited: on what `variables` says, on `m`, and on the start values of
planar and floating joints.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfsync.domain import Probe, Target
from urdfsync.modelica.literals import vector
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.motion import Course
from urdfsync.urdf.physics.variables import (
    ACCELERATION,
    ANGULAR,
    PLACE,
    ROTATION,
    VELOCITY,
    Variables,
    variables,
)

_DEPTH = 1e9
"""How far down the ground is, in m: the contacts of a mobile robot are there, and nothing touches."""
_DRIVE = """
  model {domain}Drive "Moves a flange as q = a0 + a1*t + a2*t^2/2"
    parameter Real a0 = 0;
    parameter Real a1 = 0;
    parameter Real a2 = 0;
    Modelica.Mechanics.{domain}.Interfaces.Flange_b flange;
  equation
    flange.{q} = a0 + a1*time + a2*time^2/2;
  end {domain}Drive;
"""
DRIVES = _DRIVE.format(domain="Rotational", q="phi") + _DRIVE.format(domain="Translational", q="s")
"""Models that move a flange, for a package that imports Modelica."""

_BASE = """
  model MovingBase "Moves and turns a frame"
    Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b;
    Modelica.Units.SI.Angle phi;
    Modelica.Units.SI.AngularVelocity w;
  equation
    Connections.root(frame_b.R);
    frame_b.r_0 = {{{path}}};
    phi = {turn};
    w = der(phi);
    frame_b.R = Modelica.Mechanics.MultiBody.Frames.planarRotation({axis}, phi, w);
  end MovingBase;
"""

FORCE = tuple(f"base.frame_b.f[{i}]" for i in (1, 2, 3))
TORQUE = tuple(f"base.frame_b.t[{i}]" for i in (1, 2, 3))
"""What the robot does to the base that moves it, resolved in the root link's frame."""
MASS = ("mass",)
MOMENT = tuple(f"moment[{i}]" for i in (1, 2, 3))
"""The sum of mass times place over all bodies, in kg·m."""


def probe(skeleton: KinematicTree, target: Target, options: Options, ballast: bool = False) -> Probe:
    """A model in which every axis of the robot moves, and the values to compare.

    With `ballast`, a body hangs on each link without children.
    """
    names = variables(skeleton, target, options)
    modifiers = ", ".join(["checkLimits = false", "fixedStart = false", *_starts(skeleton)])
    lines = [
        "package Probe_",
        *(f"  import {library};" for library in _libraries(target, options)),
        DRIVES,
        _BASE.format(path=", ".join(map(_text, motion.PATH)), turn=_text(motion.TURN), axis=vector(motion.TURN_AXIS)),
        "  model Probe",
        *(f"    {line};" for line in _surroundings(options)),
        "    MovingBase base;",
        f"    {names.model}{modifiers});",
        *(f"    {line};" for line in _drives(skeleton)),
        *([f"    {_ballast(leaf)};" for leaf in range(1, 1 + len(skeleton.leaves()))] if ballast else []),
        "    Real mass = robot.m;",
        f"    Real moment[3] = {names.moment};",
        "  equation",
        "    connect(base.frame_b, robot.frame_a);",
        *(
            f"    connect(drive{k}.flange, {names.flange(joint.name)});"
            for k, joint in enumerate(motion.driven_axes(skeleton), 1)
        ),
        *(
            f"    connect(ballast{k}.frame_a, {names.frame(leaf.name)});"
            for k, leaf in enumerate(skeleton.leaves() if ballast else (), 1)
        ),
        "  end Probe;",
        "end Probe_;",
        "",
    ]
    stop = motion.duration(skeleton)
    return Probe("\n".join(lines), "Probe_.Probe", stop, stop / 4, tuple(_values(skeleton, names)))


def effort_names(skeleton: KinematicTree, names: Variables) -> tuple[str, ...]:
    """What drives each axis, in the order of `motion.driven_axes`."""
    return tuple(
        f"{names.flange(joint.name)}.{'tau' if MOTION_KINDS[joint.type] == 'rotational' else 'f'}"
        for joint in motion.driven_axes(skeleton)
    )


def _values(skeleton: KinematicTree, names: Variables) -> Iterator[str]:
    for link in skeleton.links:
        yield from names.vector(link.name, PLACE)
        yield from names.axes(link.name)
    for joint in motion.free_joints(skeleton):
        for part in (VELOCITY, ROTATION, ACCELERATION, ANGULAR):
            yield from names.vector(joint.child, part)
    yield from (*effort_names(skeleton, names), *FORCE, *TORQUE, *MASS, *MOMENT)


def _libraries(target: Target, options: Options) -> dict[str, None]:
    """Every library has to be named, or the compiler does not load it."""
    optional = ("Visualization2",) if options.visualizer == "visualization2" else ()
    return dict.fromkeys(("Modelica", "UrdfSync", *optional, target.package.partition(".")[0]))


def _surroundings(options: Options) -> Iterator[str]:
    world = f"n = {{0, 0, -1}}, g = {motion.GRAVITY!r}, enableAnimation = false"
    yield f"inner Modelica.Mechanics.MultiBody.World world({world})"
    if options.base == "floating":
        yield f"inner UrdfSync.Contacts.Ground ground(height = {-_DEPTH!r})"


def _starts(skeleton: KinematicTree) -> Iterator[str]:
    """Modifiers with the start values of planar and floating joints."""
    for joint in motion.free_joints(skeleton):
        start = motion.free_start(joint)._asdict()
        values = (f"{key}_start = {_number(value)}" for key, value in start.items())
        yield f"{skeleton.joint(joint.name).component}(fixedStart = true, {', '.join(values)})"


def _drives(skeleton: KinematicTree) -> Iterator[str]:
    for k, joint in enumerate(motion.driven_axes(skeleton), 1):
        course = motion.axis_course(joint)
        values = ", ".join(f"a{power} = {value!r}" for power, value in enumerate(course))
        yield f"{MOTION_KINDS[joint.type].capitalize()}Drive drive{k}({values})"


def _ballast(number: int) -> str:
    tensor = ", ".join(f"I_{i}{i} = {value!r}" for i, value in enumerate(motion.BALLAST_INERTIA, 1))
    centre = vector(motion.BALLAST_CENTRE)
    body = f"animation = false, m = {motion.BALLAST_MASS!r}, r_CM = {centre}, {tensor}"
    return f"Modelica.Mechanics.MultiBody.Parts.Body ballast{number}({body})"


def _text(course: Course) -> str:
    return f"{course.position!r} + ({course.speed!r})*time + ({course.acceleration!r})*time^2/2"


def _number(value: float | tuple[float, ...]) -> str:
    return vector(value) if isinstance(value, tuple) else repr(value)
