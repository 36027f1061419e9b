"""Reports the changes between two versions, as a section."""

from __future__ import annotations

from collections.abc import Iterator

import tomli_w

from urdfsync.analysis.versions.comparison import Comparison
from urdfsync.common.spelling import counted
from urdfsync.engine.actions import SO_FAR, USERS, Reason
from urdfsync.engine.decide.conflicts import describe_doubt
from urdfsync.engine.stage.findings import CONNECTORS
from urdfsync.output.build_section import build_section, change_parts, file_table
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.console import StyledLine, line
from urdfsync.output.outline import OutlineRow, effect_rows
from urdfsync.output.sections import Mark, Section, TextTable
from urdfsync.output.terminal import file_line

_CHANGES, _FILES, _EFFECTS = 60, 12, 8
"""The greatest number of lines of changes, files and effects without --verbose."""
_DOUBTS = 6
"""The greatest number of elements that are named because they may be other parts."""
_SILENT = frozenset({Reason.KEEP, Reason.FORGET})


def to_section(compared: Comparison, *, verbose: bool | None = None) -> Section:
    """Return a comparison as a section. Only a comparison with the last build judges the package."""
    result, section = compared.result, build_section(compared.result)
    points, tables = change_parts(compared.changes, _CHANGES, verbose=bool(verbose))
    effects = [tuple(row) for row in effect_rows(compared.effects)]
    tables.append(
        TextTable(
            "Effects", ("Property", "Change", "By"), effects, _effect_line, _EFFECTS, "effect", _heading("Effects")
        )
    )
    rows = [(result.shown(path), str(kind)) for path, kind in compared.files.items()]
    words = f"{counted(len(rows), 'file')} of the package differ{'s' if len(rows) == 1 else ''}"
    columns = "File", ""
    tables.append(TextTable("Differing files", columns, rows, file_line, _FILES, "file", _heading(words)))
    has_plan = not result.in_step and (compared.against is None or result.is_built or result.conflicts)
    actions = [action for action in result.actions.decided if has_plan and action.reason not in _SILENT]
    most = max(_FILES, 1 + sum(action.reason in USERS for action in actions))
    heading = _heading(f"Next build: {result.summary}")
    tables.append(file_table(result, actions, line=_file_line, most=most, noun="file", heading=heading))
    is_judged = compared.against is None or result.failed
    return Section(
        result.robot,
        compared.summary,
        section.mark if is_judged else Mark.NONE,
        [point for point in points if str(point).strip() not in compared.summary],
        tables,
        [finding for finding in section.findings if finding.code != CONNECTORS],  # effects show them
        section.verdict if is_judged else None,
        [*_doubts(compared), *([settle_hint(result.conflicts)] if result.conflicts else ())],
        _CHANGES,
    )


def _heading(words: str) -> list[StyledLine]:
    return [line(("", "")), line((words, "bold"))]


def _effect_line(*row: str) -> StyledLine:
    return line((f"  {OutlineRow(*row)}", ""))


def _file_line(path: str, word: str, why: str) -> StyledLine:
    """Return a line for one file, with its former name, and with the reason if the user edited the file."""
    return file_line(path, word, why if word in USERS or why.startswith(SO_FAR) else "")


def _doubts(compared: Comparison) -> Iterator[str]:
    """Yield the elements that may be other parts, and lines for the configuration that declare the renames."""
    doubts = compared.changes.doubts if compared.changes else ()
    yield from map(describe_doubt, doubts[:_DOUBTS])
    if len(doubts) > _DOUBTS:
        yield f"… and {counted(len(doubts) - _DOUBTS, 'more element')} like these"
    likely = {doubt.element.partition(" ")[2]: doubt.moved_to for doubt in doubts if doubt.moved_to}
    if likely and compared.result.robot:
        yield "if so, put this into urdfsync.toml, with the right names:"
        table = tomli_w.dumps({"robots": {compared.result.robot: {"renamed": likely}}})
        yield from (f"  {text}" for text in table.splitlines())
