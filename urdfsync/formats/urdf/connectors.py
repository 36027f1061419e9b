"""Names the components other than links and joints: connectors, couplings, sensors, visuals, variables of Run.

A connector is named after its element. If an element has the name of the connector, the connector gets a number. So a
new connector never renames an element or its file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.formats.urdf.drives import can_be_driven, has_motor, sharing_joint
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.names import GENERATED, Identifier, identify
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import MOTION_KINDS, SENSOR_KINDS, Command, Motion

_VARIABLES: Mapping[Motion, Mapping[Command, str]] = {
    "rotational": {"position": "phi", "velocity": "w", "effort": "tau"},
    "translational": {"position": "s", "velocity": "v", "effort": "f"},
}
"""Suffixes of the variables of Run."""
_IN_RUN: Mapping[Command, Sequence[Command]] = {
    "position": ("position", "effort"),
    "velocity": ("velocity", "effort"),
    "effort": ("position", "velocity", "effort"),
}
"""Variables of Run for a joint, by its command: the command is the input, other variables are outputs."""


class Drive(msgspec.Struct, frozen=True):
    """Names of the connectors and variables of a joint that can be driven."""

    motion: Motion
    axis: str
    """The flange that moves."""
    support: str
    """The flange of the drive's housing."""
    motor: str | None
    """The flange at the motor's side of the gear; None without such a flange."""
    command: Command | None
    """The quantity that is the input of Run; None if Run does not drive the joint."""
    position: str | None
    """Variable of Run for the position; None if Run has no such variable, or has the position in its input vector."""
    velocity: str | None
    """Likewise."""
    effort: str | None
    """Likewise."""
    gear: str | None = None
    """Component of a gear whose motor moves another joint as well."""
    other: str | None = None
    """URDF name of the other joint that the motor moves."""


class Connectors(msgspec.Struct, frozen=True):
    """Names of components by the URDF name of their link or joint, in canonical order."""

    frames: dict[str, str]
    """Frames of leaf links, and of links that the options name."""
    drives: dict[str, Drive]
    """Flanges and variables of joints that can be driven."""
    couplings: dict[str, str]
    """Couplings of joints that follow another joint."""
    sensors: dict[str, str]
    """Components of sensors."""
    sensor_frames: dict[str, str]
    """Frames of cameras and laser scanners."""

    def __hash__(self) -> int:
        """Return a hash of the elements with connectors."""
        return hash((*self.frames, *self.drives, *self.sensors))


def connector_names(closed: ClosedLoops, options: Options) -> Connectors:
    """Return the names for a robot.

    A name in the option `frames` that no link has is skipped: `check_options` reports it.
    """
    tree, taken = closed.tree, taken_names(closed.tree)
    if options.frames == "all":  # the root, too: a link that becomes the root keeps its frame
        framed = {link.name for link in tree.links}
    else:
        framed = {leaf.name for leaf in tree.leaves()}.union(() if options.frames == "leaves" else options.frames)
    drives = {}
    for joint in filter(can_be_driven, tree.joints):
        identifier, motion = tree.joint(joint.name), MOTION_KINDS[joint.type]
        command = (joint.command or "position") if joint.name in closed.driven else None
        in_vector = command if options.inputs == "vector" else None
        drives[joint.name] = Drive(
            motion,
            free_name(identifier, "Axis", taken),
            free_name(identifier, "Support", taken),
            free_name(identifier, "Motor", taken) if has_motor(joint, options) else None,
            command,
            *(
                f"{identifier.component}_{ending}"
                if command and variable in _IN_RUN[command] and variable != in_vector
                else None
                for variable, ending in _VARIABLES[motion].items()
            ),
        )
        if other := sharing_joint(joint, options.drives):
            gear = free_name(identifier, "Gear", taken)
            drives[joint.name] = msgspec.structs.replace(drives[joint.name], gear=gear, other=other)
    frames = {link.name: free_name(tree.link(link.name), "Frame", taken) for link in tree.links if link.name in framed}
    couplings = {joint.name: free_name(tree.joint(joint.name), "Mimic", taken) for joint, _ in tree.followers()}
    flanges = (flange for drive in drives.values() for flange in (drive.axis, drive.support, drive.motor, drive.gear))
    used = {name.lower() for name in (*frames.values(), *couplings.values(), *filter(None, flanges))}
    # Sensors are named last, then their frames: a new sensor renames only sensors.
    sensors = identify([("sensor", sensor.name) for sensor in tree.sensors], used | taken)
    used |= {identifier.component.lower() for identifier in sensors.values()}
    return Connectors(
        frames,
        drives,
        couplings,
        {name: identifier.component for (_, name), identifier in sensors.items()},
        {
            sensor.name: free_name(sensors["sensor", sensor.name], "Frame", taken | used)
            for sensor in tree.sensors
            if SENSOR_KINDS[sensor.kind].has_frame
        },
    )


def input_vector(names: Connectors) -> str:
    """Return the name of the vector of all inputs of Run."""
    commands = {drive.command for drive in names.drives.values() if drive.command}
    return "positions" if commands <= {"position"} else "commands"


def taken_names(tree: KinematicTree) -> frozenset[str]:
    """Return the names of links, joints and generated components, in lower case."""
    return GENERATED | {identifier.component.lower() for identifier in tree.names.values()}


def free_name(identifier: Identifier, suffix: str, taken: frozenset[str]) -> str:
    """Return the component's name with a suffix. If that name is taken, add the first free number from 2."""
    name, number = identifier.component + suffix, 2
    while name.lower() in taken:
        name, number = f"{identifier.component}{suffix}_{number}", number + 1
    return name
