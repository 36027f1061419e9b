"""Reports the changes between two versions: as lines for people, and as a section."""

from __future__ import annotations

from collections.abc import Iterator

import tomli_w

from urdfsync.engine.actions import USERS, Reason
from urdfsync.engine.findings import CONNECTORS
from urdfsync.engine.renames import describe_doubt
from urdfsync.output.build_section import build_section, change_parts
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.console import StyledLine, first_lines, line
from urdfsync.output.outline import effect_rows
from urdfsync.output.phrases import change_lines
from urdfsync.output.results import action_line, change_line, headline
from urdfsync.output.sections import Mark, Section, Table
from urdfsync.spelling import counted
from urdfsync.versions.comparison import Comparison

_CHANGES, _FILES, _EFFECTS = 60, 12, 8
"""The most lines of changes, files and effects without --verbose."""
_DOUBTS = 6
"""The most named elements that may be other parts."""
_SILENT = frozenset({Reason.UNCHANGED, Reason.KEEP, Reason.FORGET})
_EDITED = USERS | {Reason.MOVED_AWAY}
"""Actions on edited files: these are always named."""


def to_section(compared: Comparison) -> Section:
    """Return a comparison for a comment; only a comparison with the last build judges the package."""
    result, section = compared.result, build_section(compared.result)
    points, tables = change_parts(result.changes)
    points = [point for point in points if point not in compared.summary]
    effects = Table("Effects", ("Property", "Change", "By"), effect_rows(compared.effects))
    tables += [effects, section.tables[-1]]
    told = [finding for finding in section.findings if finding.code != CONNECTORS]  # effects tell them
    is_judged = compared.against is None or result.failed
    mark, verdict = (section.mark, section.verdict) if is_judged else (Mark.NONE, None)
    return Section(result.robot, compared.summary, mark, points, tables, told, verdict)


def robot_lines(compared: Comparison, *, verbose: bool = False) -> Iterator[StyledLine]:
    """Yield the changes in a source, without findings: by element, effects on the model, files; of many the first."""
    head, changes = compared.summary, compared.result.changes
    yield headline(compared.result, head, is_fine=compared.in_step)
    told = [text for text in change_lines(changes, everything=verbose) if text not in head] if changes else []
    yield from first_lines(list(map(change_line, told)), _CHANGES, "line", verbose=verbose)
    yield from _doubts(compared)
    if effects := [line((f"  {text}", "")) for text in effect_rows(compared.effects)]:
        yield from (line(("", "")), line(("Effects", "bold")))
        yield from first_lines(effects, _EFFECTS, "effect", verbose=verbose)
    yield from _files(compared, verbose)


def _doubts(compared: Comparison) -> Iterator[StyledLine]:
    """Yield the elements that may be other parts, and their lines for the configuration."""
    doubts = compared.result.changes.doubts if compared.result.changes else ()
    yield from (line((f"  {describe_doubt(doubt)}", "yellow")) for doubt in doubts[:_DOUBTS])
    if len(doubts) > _DOUBTS:
        yield line((f"  … and {counted(len(doubts) - _DOUBTS, 'more element')} like these", "dim"))
    likely = {doubt.element.partition(" ")[2]: doubt.moved_to for doubt in doubts if doubt.moved_to}
    if likely and compared.result.robot:
        yield line(("  if so, put this into urdfsync.toml, with the names that are right:", "dim"))
        table = tomli_w.dumps({"robots": {compared.result.robot: {"renamed": likely}}})
        yield from (line((f"    {text}", "dim")) for text in table.splitlines())


def _files(compared: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the concerned files; edited ones come first, with a reason."""
    result = compared.result
    actions = [action for action in result.actions if action.reason not in _SILENT]
    if compared.in_step or not actions:
        return
    heading = f"Next build: {result.summary}"
    if compared.against is not None:
        heading = f"{counted(len(actions), 'file')} of the package differ{'s' if len(actions) == 1 else ''}"
    yield from (line(("", "")), line((heading, "bold")))
    actions.sort(key=lambda action: (action.reason not in _EDITED, action.path.rpartition("/")))
    # of others the word says already that they wait
    lines = [action_line(result, each, each.reason.text if each.reason in _EDITED else "") for each in actions]
    edited = sum(action.reason in _EDITED for action in actions)
    yield from first_lines(lines, max(_FILES, edited + 1), "file", verbose=verbose)
    if any(action.is_conflict for action in actions):
        yield line((f"  {settle_hint(result.conflicts)}", "dim"))
