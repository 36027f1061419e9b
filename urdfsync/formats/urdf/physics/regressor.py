"""A robot whose efforts are linear in its parameters, by Pinocchio: the model that `urdfsync identify` fits.

The efforts of the axes are Bᵀ·(Y·φ + losses), see `reference`. Pinocchio's `computeJointTorqueRegressor` gives Y for
the ten inertial parameters of each moving body; a link that is fixed to a body has its columns, moved to its frame.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any
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
from urdfsync.formats.urdf.physics.completion import completed_for_pinocchio
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.reference import Array, Reference, read
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint
from urdfsync.formats.urdf.second.companions import read_companions
from urdfsync.formats.urdf.second.gears import Gear, read_gears

_TAGS = {"limits": "limit"}
"""Tags of URDF that have another name in records."""
_TENSOR = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_REST = (Course(0.0, 0.0, 0.0),) * 4
_UNREAD = ("visual", "collision", "contact", "transmission", "name", "calibration", "safetyController")
"""Values of records that have no part in the efforts of joints, or that a catalogue may have."""


def read_regressor(
    sample: Sample, edits: Mapping[tuple[str, str], Mapping[str, tuple[float, ...]]]
) -> PinocchioRegressor:
    """Return the model of a source, with the user's edits of records: numbers by path, by kind and name of the element.

    Raises SourceError for a source that Pinocchio can't read, or whose motion the joints' positions do not determine.
    """
    reading = read_robot(sample.content, sample.file, sample.options, *sample.companions)
    if reading.robot is None:
        raise SourceError(*reading.diagnostics)
    stated = read_companions(sample.companions, sample.options)
    content, _ = completed_for_pinocchio(sample.content, {joint.name for joint in reading.robot.joints}, stated)
    content = _edited(content, edits)
    catalogue = [companion for companion in sample.companions if companion.option == "catalogue"]
    robot = read_robot(content, sample.file, sample.options, *catalogue).robot
    assembly = Assembly(robot or reading.robot, sample.options, sample.target)
    free = [joint.name for joint in assembly.tree.joints if joint.type not in (*MOTION_KINDS, "fixed")]
    if free:
        message = f"joint {free[0]} moves in several directions: no log of positions determines the efforts"
        raise SourceError.of("identify", message, sample.file)
    gears = read_gears(xml.parse(content).root, stated.rows)
    return PinocchioRegressor(assembly, read(content, sample.file, (), stated.rows), gears)


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


class PinocchioRegressor:
    """The efforts of a robot's axes, and their derivatives by all parameters."""

    def __init__(self, assembly: Assembly, robot: Any, gears: Mapping[str, Gear]) -> None:
        tree = assembly.tree
        joints = [joint for joint in motion.driven_axes(tree) if joint.name not in assembly.closed.dependent]
        self.reference = Reference(robot, [joint.name for joint in joints], assembly.closed)
        self.axes = tuple(_axes(assembly, joints, gears))
        model, pin = self.reference.model, self.reference.pin
        self._rows = {name: row for name, row in self.reference.coordinates().items() if row >= 6}
        bodies, self._columns = list[MovingLink](), list[tuple[int, Array]]()
        for link in tree.links:
            frame = model.frames[model.getFrameId(link.name, pin.BODY)]
            if frame.parentJoint < 2 or link.inertial is None:  # the base rests, and a frame has no body
                continue
            inertial = link.inertial
            numbers = inertial.mass, *inertial.origin.xyz, *(getattr(inertial.inertia, name) for name in _TENSOR)
            rotation = np.array(pin.rpy.rpyToMatrix(*inertial.origin.rpy))
            bodies.append(MovingLink(link.name, np.array(numbers), rotation, frame.placement.translation.any() == 0))
            self._columns.append((frame.parentJoint - 1, _moved(pin, frame.placement)))
        self.bodies = tuple(bodies)
        self.losses: tuple[Loss, ...] = tuple(
            Loss(name, path, float(getattr(model, attribute)[row]))
            for name, row in self._rows.items()
            for path, attribute in JOINT_NUMBERS.items()
        )

    def rows(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """Return the derivatives of the axes' efforts by all parameters, and the efforts, for each sample.

        Parameters are the ten of each of `bodies`, in Pinocchio's order, then `losses`. Raises SourceError if loops
        can't be closed.
        """
        reference, pin = self.reference, self.reference.pin
        model, data = reference.model, reference.model.createData()
        count, axes, slope = len(q), len(self.axes), reference.steepness
        derivatives = np.zeros((count, axes, 10 * len(self.bodies) + len(self.losses)))
        efforts = np.zeros((count, axes))
        places = [self._rows[loss.joint] for loss in self.losses]
        for k, courses in enumerate(np.stack([q, v, a], axis=2)):
            try:
                state = reference.state(courses, _REST)
            except OpenLoopError:
                raise SourceError.of("identify", f"the loops of the robot can't be closed at {courses[:, 0]}") from None
            full = pin.computeJointTorqueRegressor(model, data, state.q, state.v, state.a)
            for n, (joint, columns) in enumerate(self._columns):
                block = full[:, 10 * joint : 10 * joint + 10] @ columns
                derivatives[k, :, 10 * n : 10 * n + 10] = state.ways.T @ block
            by_kind = [state.v, np.tanh(slope * state.v / 2), state.a]
            for n, row in enumerate(places):
                derivatives[k, :, 10 * len(self.bodies) + n] = state.ways[row] * by_kind[n % len(JOINT_NUMBERS)][row]
            efforts[k] = state.ways.T @ reference.load(data, state, state.a)
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


def _moved(pin: Any, placement: Any) -> Array:
    """Return the matrix that takes the ten parameters of a link in its frame to those in the frame of its body."""
    # the parameters are linear in the pseudo-inertia, and a frame's placement acts on it as a 4x4 matrix
    matrix = np.array(placement.homogeneous)
    columns = []
    for unit in np.eye(10):
        pseudo = np.array(pin.PseudoInertia.FromDynamicParameters(unit).toMatrix())
        moved = matrix @ pseudo @ matrix.T
        columns.append(pin.PseudoInertia.FromMatrix(moved).toDynamicParameters())
    return np.column_stack(columns)
