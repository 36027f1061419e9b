"""Reports an identification: the joints, the numbers, and what stayed or was left out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from urdfsync.analysis.checks.results import JointFit
from urdfsync.analysis.identification.results import Excitation, FittedNumber, Identification, Unexcited
from urdfsync.common.spelling import counted, growth
from urdfsync.domain.regressor import NUMBERS
from urdfsync.output.console import StyledLine, file_lines, findings, html, line, table_lines

_JOINTS = ("joint", "measured", "before", "after", "explained", "unit")
_NUMBERS = ("element", "number", "before", "after", "± error", "± conditional", "change")
_TENSOR = NUMBERS[4:]


class IdentificationDisplay(Identification, frozen=True):
    """An identification with a display for notebooks."""

    def _repr_html_(self) -> str:
        return html([*identification_lines(self), *findings(self.diagnostics)])


def identification_lines(result: Identification) -> Iterator[StyledLine]:
    """Yield the lines about an identification, without its diagnostics."""
    late = f"efforts {1000 * abs(result.delay):.1f} ms {'late' if result.delay > 0 else 'early'}"
    about = f"{result.seconds:.3g} s at {result.rate:.4g} Hz, filtered at {result.cutoff:.3g} Hz; {late}"
    yield line((result.robot, "bold"), (f": {result.log}, {about}", ""))
    yield from _table(_JOINTS, map(_joint, result.joints))
    if result.held_out:
        yield line(("  the seconds that were not fitted:", ""))
        yield from _table(_JOINTS, map(_joint, result.held_out))
    if result.numbers:
        yield from _table(_NUMBERS, map(_number, result.numbers))
    if result.unexcited:
        yield line(("  stays, since the motion does not determine it:", ""))
        yield from (line((f"    {text}", "dim")) for text in _grouped(result.unexcited))
    for link in result.freed:
        text = f"  {link}: all its numbers are fitted, since no body has the determined ones and the source's others"
        yield line((text, "yellow"))
    yield from (line((f"  left out: {text}", "dim")) for text in result.dropped)
    if homeless := sorted({number.element for number in result.numbers if not number.is_written}):
        yield line((f"  no record has numbers of {', '.join(homeless)}, so they are not written", "yellow"))
    if result.written:
        yield line(
            (f"  {counted(len(result.written), 'record')} written", "bold"), ("; `urdfsync diff --edits`", "dim")
        )
    else:
        why = "`--write` writes the numbers into the records"
        if not any(number.is_sure and number.is_written for number in result.numbers):
            why = "no change is sure, so each number stays"
        why = "the log is hardly that of the robot" if result.is_doubtful else why
        yield line((f"  nothing written: {why}", "dim"))
    yield from file_lines(result.files)


def excitation_lines(result: Excitation) -> Iterator[StyledLine]:
    """Yield the lines about a motion."""
    numbers = counted(result.numbers, "number")
    about = f"{result.seconds:g} s that determine {numbers}; condition {result.condition:.3g}"
    yield line((result.robot, "bold"), (f": {about} (the first try: {result.first_condition:.3g})", ""))
    if result.resting:
        yield line((f"  at rest, since Run does not drive them: {', '.join(result.resting)}", "dim"))
    yield line(("  collisions are not looked for: play the motion with `urdfsync simulate --input` first", "yellow"))
    yield from file_lines(result.files)


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[StyledLine]:
    return table_lines([(header, "dim"), *((row, "") for row in rows)])


def _joint(joint: JointFit) -> tuple[str, ...]:
    roots = (f"{value:.3g}" for value in (joint.measured, joint.before, joint.after))
    explained = "-" if joint.explained is None else f"{100 * joint.explained:.1f} %"
    return (joint.element.partition(" ")[2], *roots, explained, joint.unit)


def _number(number: FittedNumber) -> tuple[str, ...]:
    change = number.after - number.before
    percent = growth(number.before, number.after)
    share = f"{change:+.3g}" if percent is None else f"{percent:+.1f} %"
    sure = share if number.is_sure else f"{share} (not sure)"
    values = f"{number.before:.5g}", f"{number.after:.5g}", f"{number.error:.2g}", f"{number.conditional:.2g}"
    return number.element, _short(number.path), *values, sure


def _short(path: str) -> str:
    return path.partition(".")[2]


def _grouped(unexcited: Sequence[Unexcited]) -> Iterator[str]:
    for each in unexcited:
        paths = each.paths
        names = [_short(path) for path in paths if path not in _TENSOR or not {*_TENSOR} <= {*paths}]
        whole = ["the inertia"] if {*_TENSOR} <= {*paths} else []
        yield f"{each.element}: " + ("all" if len(paths) == len(NUMBERS) else ", ".join([*names, *whole]))
