"""Reports a simulation: its model, a row for each joint, and the written files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from urdfsync.analysis.checks.compilers.compiler import one_line
from urdfsync.analysis.simulation.fmu import AGREEMENT, WrittenFmu
from urdfsync.analysis.simulation.outcomes import Study
from urdfsync.analysis.simulation.results import Against, JointResult, QuantityDifference, Range, SimulateResult
from urdfsync.common.spelling import counted
from urdfsync.output.console import StyledLine, file_lines, findings, html, line, table_lines

_STUDY_HEADER = ("joint", "greatest", "min", "median", "max", "limit", "unit", "cases beyond")
_MOST_PROBLEMS = 3
_LONGEST_PROBLEM = 200
_HEADER = ("joint", "position", "limits", "speed/limit", "effort/limit")
_AGAINST_HEADER = ("joint", "position by", "speed by", "effort by", "effort before and now")
_WORDS = {"me": "model exchange", "cs": "co-simulation"}
_NOTHING = 5e-7
"""Smaller numbers are rounding errors and shown as 0."""


class SimulationDisplay(SimulateResult, frozen=True):
    """A simulation with a display for notebooks."""

    def _repr_html_(self) -> str:
        return html([*result_lines(self), *findings(self.diagnostics)])


class StudyDisplay(Study, frozen=True):
    """A study with a display for notebooks."""

    def _repr_html_(self) -> str:
        return html([*study_lines(self), *findings(self.diagnostics)])


def result_lines(result: SimulateResult) -> Iterator[StyledLine]:
    """Yield the lines about a simulation, without its diagnostics."""
    took = "as simulated before" if result.is_known else f"{result.seconds:.1f} s"
    about = f": {result.model}, {result.stop:g} s in steps of {result.step:g} s; {took}"
    yield line((result.robot, "bold"), (about, ""))
    robots = list(dict.fromkeys(joint.robot for joint in result.joints))
    for robot in robots:
        if robots != ["robot"]:
            yield line((f"  {robot or 'the model itself'}", "bold"))
        yield from table_lines([(_HEADER, "dim"), *(_row(joint) for joint in result.joints if joint.robot == robot)])
        for loop in result.loops:
            if loop.robot == robot:
                amounts = f"open by {1000 * loop.gap:.2g} mm, {loop.force:.3g} N and {_digits(loop.torque)} N·m"
                yield line((f"  {loop.element}: {amounts} at most", ""))
    if result.against:
        yield from _against_lines(result, result.against)
    yield from file_lines(result.files)


def _against_lines(result: SimulateResult, against: Against) -> Iterator[StyledLine]:
    """Yield a row for each joint that moves otherwise than in the older version."""
    efforts = {(joint.robot, joint.element): joint.effort for joint in result.joints}
    rows: list[tuple[tuple[str, ...], str]] = [(_AGAINST_HEADER, "dim")]
    for joint in against.joints:
        found = {each.quantity: each for each in joint.differences if each.difference > _NOTHING}
        if not found:
            continue
        place = "" if joint.robot in ("", "robot") else f"{joint.robot}."
        name = f"{place}{joint.element.partition(' ')[2] or joint.element}"
        name += f" (was {joint.former.partition(' ')[2]})" if joint.former != joint.element else ""
        differences = [_worst(found.get(quantity)) for quantity in ("position", "speed", "effort")]
        effort, before = efforts[joint.robot, joint.element], found.get("effort")
        sizes = f"{_digits(max(abs(before.least), abs(before.greatest)))} → {_size(effort)}" if before else "-"
        rows.append(((name, *differences, sizes), ""))
    count, words = len(rows) - 1, "the same motion"
    if count:
        equal = f", {len(against.joints) - count} equal" if count < len(against.joints) else ""
        words = f"{counted(count, 'joint')} differ{'s' if count == 1 else ''}{equal}"
    yield line((f"  since {against.revision}: {words}", "bold" if count else "green"))
    yield from table_lines(rows)
    if against.only:
        yield line((f"  only in one version: {', '.join(against.only)}", ""))


def _worst(found: QuantityDifference | None) -> str:
    """Return the greatest difference, and its time: `0.31 rad at 0.4 s`."""
    return "-" if found is None else f"{_digits(found.difference)} {found.unit} at {found.time:.3g} s"


def study_lines(study: Study) -> Iterator[StyledLine]:
    """Yield the lines about many cases, without the study's diagnostics."""
    total = len(study.outcomes)
    known = f" ({study.known} remembered)" if study.known else ""
    took = f"{study.seconds:.1f} s{known}"
    about = f": {study.model}, {study.stop:g} s in steps of {study.step:g} s; {counted(total, 'case')}; {took}"
    yield line((study.robot, "bold"), (about, ""))
    rest = [f"{study.beyond} beyond"] * bool(study.beyond) + [f"{study.failed} failed"] * bool(study.failed)
    verdict = "; ".join([f"  {study.within} of {total} cases within all limits", *rest])
    yield line((verdict, "green" if study.within == total else "bold yellow"))
    rows: list[tuple[tuple[str, ...], str]] = [(_STUDY_HEADER, "dim")]
    for each in study.summaries:
        place = "" if each.robot in ("", "robot") else f"{each.robot}."
        name = f"{place}{each.element.partition(' ')[2] or each.element}"
        limit = "-" if each.limit is None else _digits(each.limit)
        sizes = (_digits(number) for number in (each.least, each.median, each.greatest))
        cells = (name, each.quantity, *sizes, limit, each.unit, str(each.beyond or ""))
        rows.append((cells, "bold yellow" if each.beyond else ""))
    yield from table_lines(rows)
    problems = Counter(outcome.problem for outcome in study.outcomes if outcome.problem)
    for problem, count in problems.most_common(_MOST_PROBLEMS):
        first = next(number for number, outcome in enumerate(study.outcomes, 1) if outcome.problem == problem)
        words = one_line(problem)[:_LONGEST_PROBLEM]
        yield line((f"  {counted(count, 'case')} failed (the first is case {first}): {words}", "bold red"))
    endings = Counter(outcome.termination for outcome in study.outcomes if outcome.termination)
    for termination, count in endings.most_common(_MOST_PROBLEMS):
        words = one_line(termination)[:_LONGEST_PROBLEM]
        yield line((f"  in {counted(count, 'case')} the model ended the simulation: {words}", ""))
    if study.worst:
        outcome = study.outcomes[study.worst - 1]
        share = f"{outcome.heaviest}, {100 * outcome.load:.0f} % of its limit" if outcome.heaviest else "no limits"
        yield line((f"  worst: case {study.worst}: {share}", ""))
        yield line((f"    {study.replay}", "dim"))
    yield from file_lines(study.files)


def _row(joint: JointResult) -> tuple[tuple[str, ...], str]:
    """Return the cells of a joint, and their style."""
    position, limits = "-", "-"
    if joint.position:
        position = f"{_digits(joint.position.least)} … {_digits(joint.position.greatest)} {joint.position.unit}"
        ends = joint.position.lower, joint.position.upper
        if ends != (None, None):
            limits = " … ".join("-" if end is None else _digits(end) for end in ends)
    name = joint.element.partition(" ")[2] or joint.element
    name += " (dependent)" if joint.is_dependent else ""
    return (name, position, limits, _size(joint.speed), _size(joint.effort)), "bold yellow" if joint.passed else ""


def _size(quantity: Range | None) -> str:
    """Return the greatest absolute value, and its limit: `0.31/5 rad/s`."""
    if quantity is None:
        return "-"
    size = max(abs(quantity.least), abs(quantity.greatest))
    limit = "" if quantity.upper is None else f"/{_digits(quantity.upper)}"
    return f"{_digits(size)}{limit} {quantity.unit}"


def _digits(number: float) -> str:
    return f"{0 if abs(number) < _NOTHING else number:.3g}"


def fmu_lines(written: WrittenFmu) -> Iterator[StyledLine]:
    """Yield the lines about an FMU, without its diagnostics."""
    exported, kind, trial = written.exported, written.kind, written.trial
    kinds = " and ".join(name for short, name in _WORDS.items() if short in kind.kind)
    size = exported.bytes / 1e6
    about = (
        f": {exported.model} by {exported.tool}, FMI {kind.version}, {kinds}; {size:.1f} MB; {exported.seconds:.1f} s"
    )
    yield line((written.robot, "bold"), (about, ""))
    if trial:
        if not trial.findings and not trial.problems:
            yield line(("  FMPy finds nothing wrong", "green"))
        for short, difference in trial.agreement.items():
            verdict = "agree with `simulate` to" if difference <= AGREEMENT else "differ from `simulate` by up to"
            yield line((f"  {_WORDS[short]}: {trial.compared} variables {verdict} {difference:.1e}", ""))
    yield line(("  fmu: ", ""), (str(written.file), "bold"))
