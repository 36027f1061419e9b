"""Options and results of checks: plain data."""

from __future__ import annotations

import enum
import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import ClassVar

import msgspec

from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.spelling import counted
from urdfsync.domain.experiment import Aspect, Deviation, Numbers, Quantity
from urdfsync.engine.result import Exit
from urdfsync.project.config import ros_package_path

MOST_SINGLE_EDITS = 6
"""The greatest number of edited files that are tried taken back one by one; more are not told apart."""

_FIRST = (
    (Quantity.POSITION, Quantity.ORIENTATION),
    (Quantity.EFFORT, Quantity.REACTION),
    (Quantity.MASS, Quantity.CENTRE),
)
KINDS = (*_FIRST, *((quantity,) for quantity in Quantity if quantity not in itertools.chain(*_FIRST)))
"""Quantities that are reported together, causes before effects."""


class RunOptions(msgspec.Struct, frozen=True, kw_only=True):
    """Limits of compilers for one robot."""

    timeout: float = 600.0
    """Limit of processor time, in s."""
    memory: float | None = None
    """Gigabytes for all processes together; None for the free memory."""
    wait: float = 60.0
    """Seconds to wait for a build that is writing."""
    package_paths: tuple[Path, ...] = msgspec.field(default_factory=ros_package_path)
    """Folders that ROS searches for packages; the configured folders come first."""


class CheckOptions(RunOptions, frozen=True):
    """How to check."""

    physics: bool = False
    """Compare poses, efforts and masses with the domain's reference."""
    strict: bool = False
    """Treat the effects of edits as differences."""
    tools: tuple[Tool, ...] = (Tool(),)
    """One compiler, or two."""
    jobs: int | None = None
    """The greatest number of robots that are checked at the same time; None allows as many as cores and memory do."""
    compilers: int = 1
    """The greatest number of compilers that run at the same time for one robot."""
    fresh: bool = False
    """Check remembered packages again."""
    curves: bool = False
    """Keep the curves over time, for a page."""


class CheckStatus(enum.StrEnum):
    """The verdict on a robot in one word."""

    RIGHT = "right"
    INCOMPLETE = "incomplete"
    """The check found no fault, but could not check all parts."""
    OUT_OF_STEP = "out of step"
    NOT_BUILT = "not built"
    DIFFERS = "differs"
    FAILED = "failed"


class CompiledModel(msgspec.Struct, frozen=True):
    """A model of the package that compiles and is balanced."""

    model: str
    """Name below the package."""
    unknowns: int
    """Number of scalar unknowns, and of equations; 0 for a part of another model, or if the compiler tells none."""
    is_users: bool = False
    """Whether the model is the user's; then `model` has its full name."""


class EditEffect(msgspec.Struct, frozen=True):
    """The effect of the user's edits on the robot, compared with the generated package."""

    files: tuple[str, ...]
    """The edited files that cause the effect, below the package's folder; several if they work together."""
    deviations: tuple[Deviation, ...]
    """The deviations beyond the tolerance, from the root outwards; none without an effect."""
    owners: tuple[str, ...] = ()
    """The elements that the files belong to, in the domain's words."""


class Curve(msgspec.Struct, frozen=True):
    """A quantity of an element over time."""

    quantity: Quantity
    element: str
    unit: str
    times: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]
    """Values of each component at all times."""
    expected: tuple[tuple[float, ...], ...]


class JointFit(msgspec.Struct, frozen=True):
    """The efforts of one joint in a log: root mean squares of all, and of the unexplained parts."""

    KEYS = ("element", "unit", "measured", "before", "after", "explained", "offset", "samples")

    element: str
    unit: str
    measured: float
    before: float
    after: float
    offset: float
    """The constant part of the measured effort that no part of the model explains."""
    samples: int
    is_doubtful: bool = False
    """Whether the log is hardly that of the robot."""

    @property
    def explained(self) -> float | None:
        """The share of the measured effort that the model explains, with its numbers after; None for a doubtful log."""
        return None if self.is_doubtful or not self.measured else max(0.0, 1 - self.after / self.measured)


class Judgement(msgspec.Struct, frozen=True):
    """How far a model is from what was measured."""

    KEYS = ("log", "seconds", "misfit", "joints")

    log: str
    seconds: float
    joints: tuple[JointFit, ...]
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def misfit(self) -> float:
        """The root mean square, over joints, of the unexplained part of each joint's effort: 0 is perfect."""
        shares = [joint.before / joint.measured for joint in self.joints if joint.measured]
        return math.sqrt(sum(share * share for share in shares) / len(shares)) if shares else 0.0


class ToolResult(msgspec.Struct, kw_only=True):
    """The answers of one compiler about a package."""

    KEYS: ClassVar[tuple[str, ...]] = ("tool", "compiled", "failing", "deviations", "effects", "seconds")

    tool: str = ""
    """The compiler with its version, or both compilers; empty if nothing was compiled."""
    compiled: tuple[CompiledModel, ...] = ()
    """The models that compile and are balanced."""
    failing: tuple[str, ...] = ()
    """Full names of the user's models that do not compile by themselves."""
    deviations: tuple[Deviation, ...] | None = None
    """Deviations of the generated package from the reference; None without a comparison."""
    effects: tuple[EditEffect, ...] = ()
    """The effects of the user's edits, each apart if possible."""
    curves: tuple[Curve, ...] = ()
    """Poses and efforts of the generated package in the first simulation, for a page."""
    gaps: tuple[str, ...] = ()
    """Parts that could not be checked, with reasons: one sentence each, without a full stop."""
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """Time from beginning to end."""

    def add(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add findings, each once."""
        self.diagnostics = tuple(dict.fromkeys((*self.diagnostics, *diagnostics)))


class CheckResult(ToolResult):
    """The result for one robot. Only the check changes this object."""

    KEYS = (
        *("robot", "package", "folder", "failed", "built", "in_step", "conflicting", "strict", "status", "summary"),
        *("numbers", "edited", "uncompared_edits", "freedoms", "tool", "compiled", "failing", "reference", "agrees"),
        *("worst", "deviations", "effects", "tools", "between", "between_edited", "log", "notes", "unchecked", "gaps"),
        *("diagnostics", "seconds"),
    )

    robot: str
    package: str
    built: bool = True
    """False if there is no package on disk yet: then the generated package was checked."""
    in_step: bool = True
    """Whether the package on disk is in step."""
    conflicting: bool = False
    """Whether the package is out of step because edits and new texts contradict each other."""
    freedoms: int | None = None
    """Degrees of freedom; None if the domain has none."""
    numbers: Numbers | None = None
    """The comparison with a second reading of the source; None if there was none."""
    edited: tuple[str, ...] = ()
    """The edited files below the package's folder, without those that differ in comments and blanks only."""
    tools: tuple[ToolResult, ...] = ()
    """With two compilers: the answers of each. The result itself then has the deviations of both."""
    between: tuple[Deviation, ...] | None = None
    """Deviations of the second compiler from the first, for the generated package; None without two simulations."""
    between_edited: tuple[Deviation, ...] = ()
    """Deviations of the second compiler from the first, for the package with the user's edits; none without edits."""
    log: Judgement | None = None
    """How far the model is from a log; None without `--log`."""
    notes: tuple[str, ...] = ()
    """Assumptions of the comparison, with reasons: one sentence each, without a full stop."""
    unchecked: tuple[str, ...] = ()
    """Parts that a check with these options does not cover, with reasons: one sentence each, without a full stop."""
    folder: str = ""
    """The package's folder for messages; empty if the check broke off."""
    reference: str = ""
    """The reference of `deviations`, for example `Pinocchio 3.4`; empty if nothing was compared."""
    strict: bool = False
    """Whether effects of edits count as differences, and an incomplete check as a failure."""

    @property
    def failed(self) -> bool:
        """Whether the check failed, or something does not compile."""
        return any(finding.severity is Severity.ERROR for finding in self.diagnostics)

    @property
    def uncompared_edits(self) -> tuple[str, ...]:
        """The edited files whose effect nothing compared."""
        compared = {file for effect in self.effects for file in effect.files}
        compared |= {each.file for each in self.numbers.edits} if self.numbers else set()
        return tuple(file for file in self.edited if file not in compared)

    @property
    def differs(self) -> bool:
        """Whether the generated package differs from its source or from the reference, or two compilers disagree."""
        if self.numbers and self.numbers.differences:
            return True
        compared = *(self.deviations or ()), *(self.between or ()), *self.between_edited
        return not all(each.agrees for each in compared)

    @property
    def is_changed_by_edits(self) -> bool:
        """Whether the user's edits change a compared quantity."""
        return bool(self.numbers and self.numbers.edits) or any(effect.deviations for effect in self.effects)

    @property
    def is_doubtful(self) -> bool:
        """Whether the source has a part that can hardly be meant; only a strict check judges it."""
        return any(finding.element and finding.severity is Severity.WARNING for finding in self.diagnostics)

    @property
    def status(self) -> CheckStatus:
        """The verdict; if `strict`, effects of edits and judgements count as differences, unknown effects as a gap."""
        if self.failed:
            return CheckStatus.FAILED
        if self.differs or (self.strict and (self.is_changed_by_edits or self.is_doubtful)):
            return CheckStatus.DIFFERS
        if not self.in_step:
            return CheckStatus.OUT_OF_STEP if self.built else CheckStatus.NOT_BUILT
        has_unknown_effects = self.strict and self.numbers and self.uncompared_edits  # tables have no comparison at all
        return CheckStatus.INCOMPLETE if self.gaps or has_unknown_effects else CheckStatus.RIGHT

    @property
    def summary(self) -> str:
        """One line: the verdict, the numbers, the compiled models, and the agreement with the reference."""
        errors = sum(finding.severity is Severity.ERROR for finding in self.diagnostics)
        facts = [counted(errors, "error")] if errors else []
        facts += [self.numbers.summary] if self.numbers else []
        if self.compiled:
            own = [model for model in self.compiled if not model.is_users]
            count, users = len(own), len(self.compiled) - len(own)
            yours = f", and {users} of yours" if users else ""
            if failing := len(self.failing):
                yours += f"; {failing} of yours {'does' if failing == 1 else 'do'} not"
            facts.append(f"1 model compiles{yours}" if count == 1 else f"{count} models compile{yours}")
            if self.freedoms is not None:
                facts.append(f"{counted(self.freedoms, 'degree')} of freedom")
        elif not errors:
            facts.append("syntax and layout")
        facts += [f"{part} {part_word(deviation)}" for part, deviation in self.worst.items()]
        return f"{self.status}: {'; '.join(facts)}; {self.seconds:.1f} s"

    @property
    def worst(self) -> Mapping[Aspect, Deviation]:
        """The greatest deviation of each part from the reference, relative to its tolerance."""
        return worst(self.deviations or ())

    @property
    def agrees(self) -> bool | None:
        """Whether the package without edits agrees with the reference; None without a comparison."""
        return None if self.deviations is None else not self.differs


def worst(deviations: Iterable[Deviation]) -> dict[Aspect, Deviation]:
    """Return the greatest deviation of each part, relative to its tolerance, in the order of the parts."""
    greatest = dict[Aspect, Deviation]()
    for part in Aspect:
        own = [deviation for deviation in deviations if deviation.part is part]
        if own:
            greatest[part] = max(own, key=lambda deviation: deviation.relative / deviation.tolerance)
    return greatest


def exit_code(results: Iterable[CheckResult]) -> Exit:
    """Return 2 for a failure, 0 if all is right, or without `strict` also incomplete, and else 1."""
    wrong = {result.status for result in results if result.strict or result.status is not CheckStatus.INCOMPLETE}
    wrong.discard(CheckStatus.RIGHT)
    if CheckStatus.FAILED in wrong:
        return Exit.ERROR
    return Exit.OUT_OF_STEP if wrong else Exit.IN_STEP


def listed(names: Sequence[str]) -> str:
    """Return names in words: `a`, `a and b`, `a, b and c`, `a, b and 5 more`."""
    if len(names) > 3:
        names = [*names[:2], f"{len(names) - 2} more"]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def part_word(deviation: Deviation) -> str:
    """Return the verdict on a part of the model by its greatest deviation."""
    return "right" if deviation.agrees else f"differ ({deviation.element})"
