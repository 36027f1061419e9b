"""A robot put together: one value with all that follows from a robot, for templates, pages and checks."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

import msgspec

from urdfsync.common.processes import machine
from urdfsync.domain import Target
from urdfsync.formats.urdf.connectors import Connectors, connector_names, input_vector
from urdfsync.formats.urdf.drives import wanted_joints
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Robot


class Assembly(msgspec.Struct, frozen=True, dict=True):
    """A robot with its tree, its closed loops, its drives and its connectors.

    Each part is made once, when it is first read. Raises KeyError or ValueError for a robot that failed a check.
    """

    robot: Robot
    options: Options
    target: Target = Target("", "")
    """The names of package and robot. Findings about the robot itself do not depend on them."""

    @cached_property
    def closed(self) -> ClosedLoops:
        """The closed loops, and the driven joints: the `wanted_joints`; in loops, at most one per degree of freedom."""
        tree = KinematicTree.of(self.robot, (self.target.name,))
        if len(tree.leaders_first()) < len(tree.joints):
            raise ValueError("a joint follows itself or a missing joint")
        wanted, named = wanted_joints(tree.joints, self.options), self.options.driven
        if not tree.loops:
            return ClosedLoops(tree=tree, driven=wanted)
        if named is None:
            named = (*(joint.name for joint in tree.joints if joint.actuated), *self.options.commands)
        with machine.single_thread():
            from urdfsync.formats.urdf.kinematics.assemble import assemble  # a late import saves most robots 60 ms

        return assemble(tree, wanted, frozenset(named))

    @property
    def tree(self) -> KinematicTree:
        """The tree; joints that move a loop begin in a closed pose."""
        return self.closed.tree

    @cached_property
    def connectors(self) -> Connectors:
        """The names of connectors, couplings, sensors, and variables of Run."""
        return connector_names(self.closed, self.options)

    @cached_property
    def every_connector(self) -> Connectors:
        """The names for a robot with all frames and motors, if Run drives all drivable joints."""
        joints = tuple(joint.name for joint in self.tree.joints)
        every = msgspec.structs.replace(self.options, frames="all", driven=joints, inputs="names", drives="motor")
        return Assembly(self.robot, every, self.target).connectors


def connector_options(assembly: Assembly) -> dict[str, str]:
    """Return the connectors and variables of Run that the options leave out, each with the option that adds it.

    An option is a line of the configuration.
    """
    names, all_names, options = assembly.connectors, assembly.every_connector, assembly.options
    named = () if isinstance(options.frames, str) else options.frames
    absent = {link: frame for link, frame in all_names.frames.items() if link not in names.frames}
    lines = {frame: _option("frames", (*named, link)) for link, frame in absent.items()}
    for joint, drive in all_names.drives.items():
        if not names.drives[joint].command:
            driven = (name for name, other in names.drives.items() if other.command or name == joint)
            variables = filter(None, (drive.position, drive.velocity, drive.effort))
            lines |= dict.fromkeys(variables, _option("driven", driven))
        elif options.inputs == "vector" and (input_ := getattr(drive, drive.command or "position")):
            lines[input_] = 'inputs = "names"'
        if drive.motor and not names.drives[joint].motor:
            lines[drive.motor] = 'drives = "motor"'
    return lines if options.inputs == "vector" else {input_vector(names): 'inputs = "vector"', **lines}


def _option(key: str, names: Iterable[str]) -> str:
    return f"{key} = [{', '.join(msgspec.json.encode(name).decode() for name in names)}]"
