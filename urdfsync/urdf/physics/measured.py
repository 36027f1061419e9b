"""What a simulation of the probe gave at one instant, in the terms of the reference."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics import probe, variables
from urdfsync.urdf.physics.reading import Array
from urdfsync.urdf.physics.reference import Frame
from urdfsync.urdf.physics.variables import Variables


class Measured:
    """The values of the probe at one instant, with the questions that `reference.Instant` answers.

    A value that is missing is NaN.
    """

    def __init__(
        self, series: Mapping[str, Sequence[float]], skeleton: KinematicTree, names: Variables, instant: int
    ) -> None:
        self._series, self._skeleton, self._names, self._instant = series, skeleton, names, instant

    @property
    def time(self) -> float:
        """In s."""
        return self._number("time")

    @property
    def force(self) -> Array:
        """On the root link, in its frame."""
        return -self._array(probe.FORCE)

    @property
    def torque(self) -> Array:
        """On the root link, in its frame."""
        return -self._array(probe.TORQUE)

    @property
    def efforts(self) -> Array:
        """Of the driven axes, in the order of `motion.driven_axes`."""
        return self._array(probe.effort_names(self._skeleton, self._names))

    def frame(self, link: str) -> Frame:
        """How the frame of a link moves; its velocities are known only if a free joint carries it."""
        axes = self._array(self._names.axes(link)).reshape(3, 3).T
        return Frame(
            self._vector(link, variables.PLACE),
            axes,
            self._vector(link, variables.VELOCITY),
            self._vector(link, variables.ROTATION),
        )

    def acceleration(self, link: str) -> tuple[Array, Array]:
        """Of a link that a free joint carries: linear, resolved in the world, and angular, resolved in its frame."""
        return self._vector(link, variables.ACCELERATION), self._vector(link, variables.ANGULAR)

    def mass_and_centre(self) -> tuple[float, Array]:
        """Mass of the whole robot and its centre in the world; zero without any mass."""
        (mass,), moment = self._array(probe.MASS), self._array(probe.MOMENT)
        return float(mass), moment / mass if mass else moment

    def _vector(self, link: str, part: str) -> Array:
        return self._array(self._names.vector(link, part))

    def _array(self, names: Sequence[str]) -> Array:
        return np.array([self._number(name) for name in names])

    def _number(self, name: str) -> float:
        series = self._series.get(name, ())
        return series[self._instant] if len(series) else math.nan
