"""A robot whose efforts are linear in its parameters, by the reference: the model that `urdfsync identify` fits.

The efforts of the axes are Bᵀ·(Y·φ + losses), see `reference`. Y follows from the motion of each link: force and torque
on a body at its link's frame are linear in its ten inertial parameters, mass, first moments and inertia.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from xml.etree.ElementTree import SubElement, tostring

import numpy as np

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain.experiment import Sample
from urdfsync.domain.regressor import JOINT_NUMBERS, Axis, Loss, MovingLink
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.kinematics.poses import position_ranges, start_positions
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.closing import OpenLoopError
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.multibody import Array, cross_matrix
from urdfsync.formats.urdf.physics.reference import ReadRobot, Reference, read
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint
from urdfsync.formats.urdf.second.companions import read_companions
from urdfsync.formats.urdf.second.gears import Gear, read_gears
from urdfsync.formats.urdf.second.reading import rotation

_TAGS = {"limits": "limit"}
"""Tags of URDF that have another name in records."""
_TENSOR = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_REST = (Course(0.0, 0.0, 0.0),) * 4
_UNREAD = ("visual", "collision", "contact", "transmission", "name", "calibration", "safetyController")
"""Values of records that have no part in the efforts of joints, or that a catalogue may have."""


def read_regressor(sample: Sample, edits: Mapping[tuple[str, str], Mapping[str, tuple[float, ...]]]) -> RobotRegressor:
    """Return the model of a source, with the user's edits of records: numbers by path, by kind and name of the element.

    Raises SourceError for a source that the reference can't read, or whose motion its joints do not determine.
    """
    reading = read_robot(sample.content, sample.file, sample.options, *sample.companions)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    stated = read_companions(sample.companions, sample.options)
    content, _ = completed_for_reference(sample.content, {joint.name for joint in reading.robot.joints}, stated)
    content = _edited(content, edits)
    catalogue = [companion for companion in sample.companions if companion.option == "catalogue"]
    robot = read_robot(content, sample.file, sample.options, *catalogue).robot
    assembly = Assembly(robot or reading.robot, sample.options, sample.target)
    free = [joint.name for joint in assembly.tree.joints if joint.type not in (*MOTION_KINDS, "fixed")]
    if free:
        message = f"joint {free[0]} moves in several directions: no log of positions determines the efforts"
        raise SourceError.of("identify", message, sample.file)
    gears = read_gears(xml.parse(content).root, stated.rows)
    return RobotRegressor(assembly, read(content, sample.file, (), stated.rows), gears)


def _edited(content: bytes, edits: Mapping[tuple[str, str], Mapping[str, tuple[float, ...]]]) -> bytes:
    """Return a URDF with the numbers of edited records."""
    root = xml.parse(content).root
    for (kind, name), values in edits.items():
        part = next(each for each in root.findall(kind) if each.get("name") == name)
        for path, numbers in values.items():
            *places, attribute = path.split(".")
            if (places or [attribute])[0].rstrip("0123456789") in _UNREAD:
                continue
            if attribute in ("mass", "axis"):
                places, attribute = [*places, attribute], "xyz" if attribute == "axis" else "value"
            element = part
            for tag in (_TAGS.get(place, place) for place in places):
                child = element.find(tag)
                element = SubElement(element, tag) if child is None else child
            attribute = re.sub("[A-Z]", lambda capital: f"_{capital[0].lower()}", attribute)
            element.set(attribute, " ".join(map(repr, numbers)))
    return tostring(root)


class RobotRegressor:
    """The efforts of a robot's axes, and their derivatives by all parameters."""

    def __init__(self, assembly: Assembly, robot: ReadRobot, gears: Mapping[str, Gear]) -> None:
        tree = assembly.tree
        joints = [joint for joint in motion.driven_axes(tree) if joint.name not in assembly.closed.dependent]
        self.reference = Reference(robot, [joint.name for joint in joints], assembly.closed)
        self.axes = tuple(_axes(assembly, joints, gears))
        multibody = robot.multibody
        rows = multibody.coordinates
        self._rows = {joint.name: rows[joint.name].start for joint in tree.joints if joint.name in rows}
        body_of = {tree.links[0].name: ""}
        """The first link of each link's body; the base rests."""
        bodies, firsts = list[MovingLink](), set[str]()
        for joint, link in zip(tree.joints, tree.links[1:], strict=True):
            first = body_of[link.name] = body_of[joint.parent] if joint.type == "fixed" else link.name
            if not first or link.inertial is None:
                continue
            inertial = link.inertial
            numbers = inertial.mass, *inertial.origin.xyz, *(getattr(inertial.inertia, name) for name in _TENSOR)
            bodies.append(MovingLink(link.name, np.array(numbers), rotation(inertial.origin.rpy), first not in firsts))
            firsts.add(first)
        self.bodies = tuple(bodies)
        self.losses: tuple[Loss, ...] = tuple(
            Loss(name, path, float(getattr(multibody, attribute)[row]))
            for name, row in self._rows.items()
            for path, attribute in JOINT_NUMBERS.items()
        )

    def rows(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """Return the derivatives of the axes' efforts by all parameters, and the efforts, for each sample.

        Parameters are the ten of each of `bodies`, as in `fit.inertial_parameters`, then `losses`. Raises SourceError
        if loops can't be closed.
        """
        reference, multibody = self.reference, self.reference.multibody
        count, axes, slope = len(q), len(self.axes), reference.dynamics["steepness"]
        gravity = np.array([0, 0, -motion.GRAVITY])
        derivatives = np.zeros((count, axes, 10 * len(self.bodies) + len(self.losses)))
        efforts = np.zeros((count, axes))
        places = [self._rows[loss.joint] for loss in self.losses]
        for k, courses in enumerate(np.stack([q, v, a], axis=2)):
            try:
                state = reference.state(courses, _REST)
            except OpenLoopError:
                raise SourceError.of("identify", f"the loops of the robot can't be closed at {courses[:, 0]}") from None
            data = multibody.move(state.q, state.v, state.a)
            for n, body in enumerate(self.bodies):
                turn, jacobian = multibody.pose(data, body.name)[1], multibody.jacobian(data, body.name)
                gain, turning = np.split(multibody.acceleration(data, body.name), 2)
                moved = [turn.T @ each for each in (gain - gravity, turning, jacobian[3:] @ state.v)]
                ways = np.concatenate([turn.T @ jacobian[:3], turn.T @ jacobian[3:]]) @ state.ways
                derivatives[k, :, 10 * n : 10 * n + 10] = ways.T @ _derivatives(*moved)
            by_kind = [state.v, np.tanh(slope * state.v / 2), state.a]
            for n, row in enumerate(places):
                derivatives[k, :, 10 * len(self.bodies) + n] = state.ways[row] * by_kind[n % len(JOINT_NUMBERS)][row]
            efforts[k] = state.ways.T @ reference.load(state, state.a)
        return derivatives, efforts


def _axes(assembly: Assembly, joints: Sequence[Joint], gears: Mapping[str, Gear]) -> Iterator[Axis]:
    tree = assembly.tree
    starts, ranges = start_positions(tree), position_ranges(tree)
    for joint in joints:
        drive = assembly.connectors.drives[joint.name]
        command = drive.command or ""
        yield Axis(
            name=joint.name,
            component=tree.joint(joint.name).component,
            unit="m" if MOTION_KINDS[joint.type] == "translational" else "rad",
            start=starts[joint.name],
            range=ranges[joint.name],
            speed=joint.limit.velocity if joint.limit and joint.limit.velocity else np.inf,
            effort=joint.limit.effort if joint.limit and joint.limit.effort else np.inf,
            reduction=gears.get(joint.name, Gear()).reduction,
            command=command,
            input=(getattr(drive, command) if command else "") or "",
        )


def _derivatives(gain: Array, turning: Array, speed: Array) -> Array:
    """Return the derivatives of force and torque on a body by its parameters, all resolved in its link's frame.

    The frame has an acceleration minus gravity, an angular acceleration and an angular velocity.
    """
    rows = np.zeros((6, 10))
    rows[:3, 0], rows[3:, 1:4] = gain, -cross_matrix(gain)
    rows[:3, 1:4] = cross_matrix(turning) + cross_matrix(speed) @ cross_matrix(speed)
    for column, (i, j) in enumerate(((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)), 4):
        tensor = np.zeros((3, 3))
        tensor[i, j] = tensor[j, i] = 1.0
        rows[3:, column] = tensor @ turning + np.cross(speed, tensor @ speed)
    return rows
