"""The words that both references share: coordinates of joints, and loads on links."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

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


def cross_matrix(vector: Array) -> Array:
    """Return the matrix M with M·x = vector × x."""
    return np.cross(vector, -np.eye(3))
