"""A robot whose efforts are linear in its parameters, and the function by which a domain gives it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from urdfsync.domain.experiment import Sample

Array = NDArray[np.float64]

NUMBERS = (
    "inertial.mass",
    *(f"inertial.origin.xyz[{k}]" for k in (1, 2, 3)),
    *(f"inertial.inertia.{part}" for part in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")),
)
"""Paths of the ten numbers of a link in its record."""
JOINT_NUMBERS = {"dynamics.damping": "damping", "dynamics.friction": "friction", "dynamics.armature": "armature"}
"""Paths of the fitted numbers of a joint in its record, and their names in Pinocchio."""
QUANTITIES = ("position", "velocity", "effort")


class Axis(NamedTuple):
    """A joint that moves by itself, in rad or m."""

    name: str
    component: str
    """The joint's name in Modelica."""
    unit: str
    start: float
    range: tuple[float, float]
    speed: float
    """The limit, or infinity."""
    effort: float
    """Likewise."""
    reduction: float
    """The gear's reduction; 1 without a gear."""
    command: str
    """The quantity that Run takes for the joint, of `QUANTITIES`; empty if Run does not drive it."""
    input: str
    """The name of this input of Run."""


class MovingLink(NamedTuple):
    """A link that moves."""

    name: str
    numbers: Array
    """The numbers of the record, in the order of `NUMBERS`."""
    rotation: Array
    """The axes of the inertia tensor in the link's frame."""
    is_first: bool
    """Whether the link is the first of its body; the others are fixed to it."""


class Loss(NamedTuple):
    """A number of a joint: damping, dry friction, or the drive's inertia."""

    joint: str
    path: str
    value: float


class Regressor(Protocol):
    """A robot whose efforts are linear in its parameters."""

    axes: tuple[Axis, ...]
    bodies: tuple[MovingLink, ...]
    losses: tuple[Loss, ...]

    def rows(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """Return the derivatives of efforts by parameters, and the efforts, for each sample and axis."""
        ...


class Physics(Protocol):
    """Reads the efforts of a robot; a domain's attribute `identification`."""

    def read_regressor(
        self, sample: Sample, edits: Mapping[tuple[str, str], Mapping[str, tuple[float, ...]]]
    ) -> Regressor:
        """Return the model of a source, with the user's edits of records by kind and name of the element."""
        ...
