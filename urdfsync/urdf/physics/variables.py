"""What a comparison calls the robot and its variables: in the model of a package, or in the generic robot."""

from __future__ import annotations

from typing import Protocol

from urdfsync.domain import Target
from urdfsync.urdf.kinematics.tree import KinematicTree, Motion
from urdfsync.urdf.model.connectors import Connectors
from urdfsync.urdf.model.robot import connector_names
from urdfsync.urdf.options import Options

PLACE = "frame_a.r_0"
"""Where the frame of a link is, in the world."""
VELOCITY = "body.v_0"
"""Of a link's frame, resolved in the world."""
ROTATION = "body.w_a"
"""Angular velocity of a link's frame, resolved in it."""
ACCELERATION = "body.a_0"
"""Of a link's frame, resolved in the world."""
ANGULAR = "body.z_a"
"""Angular acceleration of a link's frame, resolved in it."""


class Variables(Protocol):
    """Names in a model that has the robot as `robot`."""

    model: str
    """The declaration of the robot up to the modifiers that depend on the comparison."""
    moment: str
    """An expression: the sum of mass times place over all links, in kg·m."""

    def vector(self, link: str, part: str) -> tuple[str, ...]:
        """The three elements of a vector of a link, for example of `PLACE`."""
        ...

    def axes(self, link: str) -> tuple[str, ...]:
        """The axes of a link's frame in the world, one after the other."""
        ...

    def flange(self, joint: str) -> str:
        """The connector of the axis of a joint that can be driven."""
        ...

    def frame(self, leaf: str) -> str:
        """The connector of a link without children."""
        ...


def variables(skeleton: KinematicTree, target: Target, options: Options) -> Variables:
    """The names for the approach that is compared: that of the package, if there is a choice."""
    if "package" in options.approach:
        return PackageVariables(skeleton, target, connector_names(skeleton, options))
    return RecordVariables(skeleton, target)


class PackageVariables:
    """A generated robot model; it relies on the components of links with their `frame_a` and `body`."""

    def __init__(self, skeleton: KinematicTree, target: Target, names: Connectors) -> None:
        self._skeleton, self._names = skeleton, names
        self.model = f"{target.package}.{target.name} robot(animation = false, "
        self.moment = " + ".join(self._moment(link.name) for link in skeleton.links)

    def vector(self, link: str, part: str) -> tuple[str, ...]:
        """See `Variables`."""
        return tuple(f"{self._link(link)}.{part}[{i}]" for i in (1, 2, 3))

    def axes(self, link: str) -> tuple[str, ...]:
        """See `Variables`."""
        return tuple(f"{self._link(link)}.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3))

    def flange(self, joint: str) -> str:
        """See `Variables`."""
        return f"robot.{self._names.axes[joint]}"

    def frame(self, leaf: str) -> str:
        """See `Variables`."""
        return f"robot.{self._names.frames[leaf]}"

    def _moment(self, link: str) -> str:
        name = self._link(link)
        centre = f"Modelica.Mechanics.MultiBody.Frames.resolve1({name}.frame_a.R, {name}.body.r_CM)"
        return f"{name}.body.m*({name}.frame_a.r_0 + {centre})"

    def _link(self, link: str) -> str:
        return f"robot.{self._skeleton.link(link).component}"


class RecordVariables:
    """The generic robot with a generated record; links have numbers there, and of their motion only the pose."""

    def __init__(self, skeleton: KinematicTree, target: Target) -> None:
        self._numbers = {link.name: number for number, link in enumerate(skeleton.links, 1)}
        self._frames = {link.name: number for number, link in enumerate(skeleton.leaves(), 1)}
        motions: tuple[Motion, ...] = ("rotational", "translational")
        self._flanges = {
            joint.name: f"robot.{motion}Axis[{number}]"
            for motion in motions
            for number, joint in enumerate(skeleton.axes(motion), 1)
        }
        record = f"redeclare parameter {target.package}.{target.name}Parameters data"
        self.model = f"UrdfSync.Robots.GenericRobot robot({record}, "
        self.moment = " + ".join(
            f"robot.data.linkMasses[{k}]*(robot.r_0[{k}, :] + robot.R_0[{k}, :, :]*robot.data.linkCenters[{k}, :])"
            for k in self._numbers.values()
        )

    def vector(self, link: str, part: str) -> tuple[str, ...]:
        """See `Variables`; whatever is not `PLACE` has names that no series has."""
        name = "robot.r_0" if part == PLACE else f"not told: {part}"
        return tuple(f"{name}[{self._numbers[link]},{i}]" for i in (1, 2, 3))

    def axes(self, link: str) -> tuple[str, ...]:
        """See `Variables`."""
        return tuple(f"robot.R_0[{self._numbers[link]},{j},{i}]" for i in (1, 2, 3) for j in (1, 2, 3))

    def flange(self, joint: str) -> str:
        """See `Variables`."""
        return self._flanges[joint]

    def frame(self, leaf: str) -> str:
        """See `Variables`."""
        return f"robot.frame_b[{self._frames[leaf]}]"
