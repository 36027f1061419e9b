"""What both references are asked: the interface to a robot in Pinocchio or MuJoCo, in coordinates and loads."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Protocol, TypeAlias
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from urdfsync.formats.urdf.robot import Vector

Array: TypeAlias = NDArray[np.float64]


class Coordinates(NamedTuple):
    """The coordinates of a joint in the velocity of a robot."""

    start: int
    size: int
    slides: bool

    @property
    def rows(self) -> slice:
        """The rows of the joint in arrays of all coordinates."""
        return slice(self.start, self.start + self.size)


class Load(NamedTuple):
    """A force and a torque on a link at a point, resolved in the world."""

    link: str
    point: Array
    force: Array
    torque: Array

    def torque_at(self, point: Array) -> Array:
        """Return the torque about another point."""
        return self.torque + np.cross(self.point - point, self.force)


class Multibody(Protocol):
    """A robot whose base is free, in a library that reads the file itself."""

    name: ClassVar[str]
    """The library and its version."""
    model: Any
    """The library's own model."""
    nv: int
    """The number of coordinates of the velocity, of which the first six are the base's."""
    links: Sequence[str]
    coordinates: Mapping[str, Coordinates]
    """Coordinates by names of joints."""
    damping: Array
    friction: Array
    armature: Array

    def __init__(self, root: Element, balls: Collection[str]) -> None:
        """Read a URDF, and change `root`; `balls` are its ball joints. Raises ValueError or RuntimeError."""

    def set_gravity(self, gravity: float) -> None:
        """Set the gravity (m/s²) along -z of the world."""

    def configuration(self, positions: Array, place: Sequence[float] = (0, 0, 0), axes: Array | None = None) -> Array:
        """Return the library's configuration for positions of the joints, and place and axes of the root link."""

    def move(self, q: Array, v: Array | None = None, a: Array | None = None) -> Any:
        """Return the library's data, with poses and motion of all links."""

    def pose(self, data: Any, link: str) -> tuple[Array, Array]:
        """Return place and axes (as columns) of a link's frame in the world."""

    def jacobian(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return the derivatives of velocity and angular velocity of a link at a point, resolved in the world."""

    def acceleration(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return acceleration and angular acceleration of a link at a point, resolved in the world."""

    def efforts(self, q: Array, v: Array, a: Array) -> Array:
        """Return the efforts of all coordinates, without losses."""

    def wrench(self, q: Array, v: Array, a: Array, joint: str) -> tuple[Array, Array]:
        """Return force and torque of the parent on the child's frame in a joint, resolved in the world."""

    def mass_and_centre(self, q: Array) -> tuple[float, Array]:
        """Return the mass of the robot, and the centre of mass in the world; zero without a mass."""


def cross_matrix(vector: Array) -> Array:
    """Return the matrix M with M·x = vector × x."""
    return np.cross(vector, -np.eye(3))
