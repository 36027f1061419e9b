"""What a check found out about one robot: pure data, from the process that checks to the one that reports."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Sequence

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.outcome import Exit

TOLERANCE = 1e-10
"""The greatest difference that counts as agreement, against the greatest value of its kind or 1."""

POSES = (Quantity.POSITION, Quantity.ORIENTATION)
EFFORTS = (Quantity.EFFORT, Quantity.REACTION, Quantity.ACCELERATION)
MASSES = (Quantity.MASS, Quantity.CENTRE)


class Standing(enum.StrEnum):
    """What a check says of a robot in one word."""

    RIGHT = "right"
    INCOMPLETE = "incomplete"
    """Nothing is wrong as far as it was checked, but something could not be that should have been."""
    DIFFERS = "differs"
    FAILED = "failed"


class Compiled(msgspec.Struct, frozen=True):
    """A model of the package that compiles and is balanced."""

    model: str
    """Name below the package."""
    unknowns: int
    """Scalar unknowns, and so many equations; 0 if the tool does not say."""
    states: int
    """As the compiler counts them before it reduces the index."""


class Comparison(msgspec.Struct, frozen=True):
    """A package against the reference, element by element."""

    deviations: tuple[Deviation, ...]

    def worst(self, quantities: Sequence[Quantity] = tuple(Quantity)) -> Deviation | None:
        """The deviation that is greatest against its kind; None if nothing of these kinds was compared."""
        found = [one for one in self.deviations if one.quantity in quantities]
        return max(found, key=lambda one: math.inf if math.isnan(one.relative) else one.relative, default=None)

    @property
    def agrees(self) -> bool:
        """Whether every difference is within the tolerance."""
        return all(one.relative <= TOLERANCE for one in self.deviations)


class Effect(msgspec.Struct, frozen=True):
    """What edits of the user do to the robot, compared with what is generated."""

    files: tuple[str, ...]
    """The edited files that it comes from, below the package's folder; several if they work together."""
    deviations: tuple[Deviation, ...]
    """Those beyond the tolerance, from the root outwards; none if the edits change nothing that is compared."""
    owners: tuple[str, ...] = ()
    """The elements that the files belong to, in the domain's words."""


class Verdict(msgspec.Struct, frozen=True):
    """What was checked of one robot, and what came out."""

    robot: str
    package: str
    built: bool = True
    """False if there is no package on disk yet: what would be generated was checked."""
    in_step: bool = True
    """Whether the package on disk is what a build would leave."""
    conflicting: bool = False
    """Whether it is out of step because edits and new texts contradict each other."""
    compiled: tuple[Compiled, ...] = ()
    generated: Comparison | None = None
    """The package as it is generated, without edits, against the reference; None if that was not compared."""
    effects: tuple[Effect, ...] = ()
    """What the edits of the user do, each apart where that can be told."""
    notes: tuple[str, ...] = ()
    """What was made up or amended for the comparison, and why: one sentence each, without a full stop."""
    unchecked: tuple[str, ...] = ()
    """What a check like this does not cover, and why: one sentence each, without a full stop."""
    gaps: tuple[str, ...] = ()
    """What it should have covered and could not, and why: one sentence each, without a full stop."""
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """From beginning to end."""
    megabytes: float = 0.0
    """Peak memory of a process that worked for it."""
    reference: str = ""
    """What `generated` was compared with, for example `Pinocchio 3.4`; empty if nothing was."""

    @property
    def failed(self) -> bool:
        """Whether something could not be checked, or does not compile."""
        return any(one.severity is Severity.ERROR for one in self.diagnostics)

    @property
    def changed(self) -> bool:
        """Whether edits of the user change what is compared."""
        return any(effect.deviations for effect in self.effects)

    def standing(self, strict: bool) -> Standing:
        """What there is to say in one word; with `strict`, a difference that comes from an edit counts as well."""
        if self.failed:
            return Standing.FAILED
        wrong = self.generated is not None and not self.generated.agrees
        if wrong or not self.in_step or (strict and self.changed):
            return Standing.DIFFERS
        return Standing.INCOMPLETE if self.gaps else Standing.RIGHT


def exit_code(verdicts: Iterable[Verdict], strict: bool) -> Exit:
    """2 if anything failed, 1 if anything differs or, with `strict`, is incomplete, else 0."""
    found = {verdict.standing(strict) for verdict in verdicts}
    if Standing.FAILED in found:
        return Exit.ERROR
    wrong = {Standing.DIFFERS, Standing.INCOMPLETE} if strict else {Standing.DIFFERS}
    return Exit.OUT_OF_STEP if found & wrong else Exit.IN_STEP
