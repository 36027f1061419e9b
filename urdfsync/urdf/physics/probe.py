"""The Modelica text that moves a generated robot as `motion` says, and the variables that are read from it.

It relies on little of the package, so that packages may be edited: on the variables below, and on `m`.
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from urdfsync.domain import Compared, Probe, Quantity, Target
from urdfsync.modelica.literals import vector
from urdfsync.urdf.connectors import connector_names
from urdfsync.urdf.drives import can_be_driven
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics import motion
from urdfsync.urdf.robot import MOTION_KINDS, MOTIONS

_GROUND_DEPTH = 1e9  # m: the contacts of a mobile robot are that far down, and nothing touches
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
"""Force and torque of the robot on the base that moves it, resolved in the root link's frame."""
MASS = ("mass",)
CENTRE = tuple(f"centre[{i}]" for i in (1, 2, 3))
"""Centre of mass in the world; zero without any mass."""


class RobotVariables(msgspec.Struct, frozen=True):
    """Names in a model that has the robot as `robot`."""

    declaration: str
    """Declaration of the robot, up to the modifiers that depend on the comparison."""
    moment: str
    """An expression: the sum of mass times place over all links, in kg·m."""
    flanges: Mapping[str, str]
    """Connector of the axis of each joint that can be driven."""
    compared: tuple[Compared, ...]
    """Quantities that are compared, from the root outwards."""


def robot_variables(tree: KinematicTree, target: Target, options: Options) -> RobotVariables:
    """Return the names for the approach that is compared: that of the package, if there is a choice.

    With the record, the generic robot is moved: links are numbers there, and only their poses are told.
    """
    compared, moments, three = list[Compared](), list[str](), (1, 2, 3)
    is_package = "package" in options.approach
    if is_package:
        declaration = f"{target.package}.{target.name} robot(animation = false, "
        flanges = {name: f"robot.{drive.axis}" for name, drive in connector_names(tree, options).drives.items()}
    else:
        record = f"redeclare parameter {target.package}.{target.name}Parameters data"
        declaration = f"UrdfSync.Robots.GenericRobot robot({record}, "
        flanges = {
            joint.name: f"robot.{kind}Axis[{number}]"
            for kind in MOTIONS
            for number, joint in enumerate(tree.axes(kind), 1)
        }
    for k, link in enumerate(tree.links, 1):
        if is_package:
            part = f"robot.{tree.link(link.name).component}"
            place = tuple(f"{part}.frame_a.r_0[{i}]" for i in three)
            axes = tuple(f"{part}.frame_a.R.T[{i},{j}]" for i in three for j in three)
            inertial = f"{part}.parameters.inertial"
            centre = f"Modelica.Mechanics.MultiBody.Frames.resolve1({part}.frame_a.R, {inertial}.origin.xyz)"
            moments.append(f"{inertial}.mass*({part}.frame_a.r_0 + {centre})")
        else:
            place = tuple(f"robot.r_0[{k},{i}]" for i in three)
            axes = tuple(f"robot.R_0[{k},{j},{i}]" for i in three for j in three)
            centre = f"robot.R_0[{k}, :, :]*robot.data.linkCenters[{k}, :]"
            moments.append(f"robot.data.linkMasses[{k}]*(robot.r_0[{k}, :] + {centre})")
        compared.append(Compared(Quantity.POSITION, f"link {link.name}", "m", place))
        compared.append(Compared(Quantity.ORIENTATION, f"link {link.name}", "", axes))
    for joint in filter(can_be_driven, tree.joints):
        unit, effort = ("N·m", "tau") if MOTION_KINDS[joint.type] == "rotational" else ("N", "f")
        compared.append(Compared(Quantity.EFFORT, f"joint {joint.name}", unit, (f"{flanges[joint.name]}.{effort}",)))
    compared += [
        Compared(Quantity.REACTION, f"link {tree.links[0].name}", "N", FORCE),
        Compared(Quantity.REACTION, f"link {tree.links[0].name}", "N·m", TORQUE),
        Compared(Quantity.MASS, "robot", "kg", MASS),
        Compared(Quantity.CENTRE, "robot", "m", CENTRE),
    ]
    return RobotVariables(declaration, " + ".join(moments), flanges, tuple(compared))


def probe(tree: KinematicTree, target: Target, options: Options) -> Probe:
    """Return a model in which every axis of the robot moves, and the values to compare."""
    names = robot_variables(tree, target, options)
    libraries = [name for name, _ in options.uses]
    imports = dict.fromkeys([*libraries, target.package.partition(".")[0]])  # rumoca loads no others
    world = f"n = {{0, 0, -1}}, g = {motion.GRAVITY!r}, enableAnimation = false"
    declarations = [f"inner Modelica.Mechanics.MultiBody.World world({world})"]
    if options.base == "floating":
        declarations.append(f"inner UrdfSync.Contacts.Ground ground(height = {-_GROUND_DEPTH!r})")
    declarations += ["MovingBase base", f"{names.declaration}checkLimits = false, fixedStart = false)"]
    connections = ["base.frame_b, robot.frame_a"]
    for k, joint in enumerate(motion.driven_axes(tree), 1):
        course = ", ".join(f"a{power} = {value!r}" for power, value in enumerate(motion.axis_course(joint)))
        declarations.append(f"{MOTION_KINDS[joint.type].capitalize()}Drive drive{k}({course})")
        connections.append(f"drive{k}.flange, {names.flanges[joint.name]}")
    centre = f"({names.moment})/(if mass > 0 then mass else 1)"
    declarations += ["Real mass = robot.m", f"Real centre[3] = {centre}"]
    *path, turn = (f"{q!r} + ({v!r})*time + ({a!r})*time^2/2" for q, v, a in (*motion.PATH, motion.TURN))
    lines = [
        "package Probe_",
        *(f"  import {library};" for library in imports),
        DRIVES,
        _BASE.format(path=", ".join(path), turn=turn, axis=vector(motion.TURN_AXIS)),
        "  model Probe",
        *(f"    {declaration};" for declaration in declarations),
        "  equation",
        *(f"    connect({connection});" for connection in connections),
        "  end Probe;",
        "end Probe_;",
        "",
    ]
    values = tuple(value for quantity in names.compared for value in quantity.values)
    return Probe("\n".join(lines), "Probe_.Probe", motion.DURATION, motion.DURATION / 4, values)
