"""The models and variables of a package for simulations, and the functions by which a domain gives them."""

from __future__ import annotations

from typing import Any, Protocol

import msgspec

from urdfsync.domain.model import Snapshot, Target


class Signal(msgspec.Struct, frozen=True):
    """A quantity of a joint in a simulation; names are those of variables and parameters below the main model."""

    variable: str
    unit: str
    limits: tuple[str, ...] = ()
    """Parameters with the lower and the upper limit; a single one limits the absolute value; empty without a limit."""
    added: tuple[tuple[str, str], ...] = ()
    """Pairs of a parameter and a variable; the products are added to the value of `variable`."""


class JointSignals(msgspec.Struct, frozen=True):
    """Quantities of one moving joint in a simulation."""

    element: str
    """The element in the domain's words: `joint elbow`."""
    position: Signal
    velocity: Signal
    effort: Signal | None = None
    """None for a joint without a drive of its own."""
    acceleration: Signal | None = None
    """The first limit holds while the joint slows down, the second while it speeds up; None without such limits."""
    is_dependent: bool = False
    """Whether the joint follows other joints through loops."""


class LoopSignals(msgspec.Struct, frozen=True):
    """Variables of a joint that closes a loop in a simulation, below the main model."""

    element: str
    """The element in the domain's words: `loop rocker_pin`."""
    gap: str
    """Distance of the two frames, in m."""
    force: tuple[str, ...]
    torque: tuple[str, ...]


class Bench(msgspec.Struct, frozen=True):
    """Models and variables of a simulation; models are named below the package."""

    test: str
    """The model that needs no input."""
    run: str
    """The model that is driven by inputs; empty if there is none."""
    layouts: tuple[tuple[JointSignals, ...], ...]
    """For each approach, the axes under their names in its models."""
    loops: tuple[LoopSignals, ...] = ()
    generic: str = ""
    """The model that reads the robot from a record; empty if there is none."""


class Benches(Protocol):
    """Gives `simulate` the models of a package; a domain's attribute `simulation`."""

    def bench(self, snapshot: Snapshot, target: Target, options: Any) -> Bench | None:
        """Return the models and variables of a simulation, or None if nothing in the package can be simulated. Pure."""
        ...
