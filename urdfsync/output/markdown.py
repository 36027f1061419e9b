"""Markdown for a comment on a merge request: structure first, then tables, folded if they are long.

Quoted text shows as it is written: it makes no markup, links nowhere, and calls nobody. GitHub and GitLab take this.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterable, Sequence

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity

FOLDED = 30
"""Longer tables, and lists, are folded."""
MOST_ROWS = 200
"""So many rows of a table are written; those that are left out are counted."""
LONGEST = 60_000
"""Characters of a comment; GitHub takes 65,536."""
_CODE = re.compile("`([^`]+)`")
_ENTITIES = re.compile("[&<>|@#]")
"""Characters that would make a tag or a cell, or call somebody, even after a backslash."""
_MARKUP = re.compile(r"[\\`*\[\]~$!]|(?<![^\W_])_|_(?![^\W_])|:(?=//)|^[-+=]|(?<=\d)[.)](?= |$)")
"""Characters that would be markup; `_` between letters is none."""


class Mark(enum.StrEnum):
    """The verdict on a robot, as a sign before its name; the worst first."""

    WRONG = "❌ "
    OPEN = "⚠️ "
    NONE = ""
    """No verdict: two versions differ, as they may."""
    FINE = "✅ "


_SEVERITIES = {Severity.ERROR: Mark.WRONG, Severity.WARNING: Mark.OPEN, Severity.NOTE: "ℹ️ "}


class Table(msgspec.Struct, frozen=True):
    """Rows of texts, which are escaped when they are written."""

    title: str
    columns: tuple[str, ...]
    """Heads; of a column whose cells are all empty, nothing is written."""
    rows: Sequence[Sequence[str]]


class Section(msgspec.Struct, frozen=True):
    """All that a comment says of one robot."""

    robot: str
    summary: str
    mark: Mark
    points: Sequence[str] = ()
    """Sentences before the tables, the structure first."""
    tables: Sequence[Table] = ()
    findings: Sequence[Diagnostic] = ()
    verdict: Diagnostic | None = None
    """The finding that the package as a whole is not as it should be; its `hint` says what to do."""

    @property
    def has_details(self) -> bool:
        """Whether there is more to say than one line."""
        return bool(self.points or any(table.rows for table in self.tables) or self.findings or self.verdict)


def escape(text: str) -> str:
    """Return text as Markdown that shows just this text, on one line, wherever it stands; code between ` as code."""
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text.strip())
    pieces = [_MARKUP.sub(lambda match: f"\\{match[0]}", piece) for piece in _CODE.split(text)]
    # a word joiner after @ and # keeps readers of the finished page from finding a name or a number there
    pieces = [
        _ENTITIES.sub(lambda match: f"&#{ord(match[0])};{'&#8288;' if match[0] in '@#' else ''}", piece)
        for piece in pieces
    ]
    pieces[1::2] = [f"<code>{piece}</code>" for piece in pieces[1::2]]
    return "".join(pieces)


def comment(sections: Iterable[Section], findings: Sequence[Diagnostic] = ()) -> str:
    """Return robots, those that need attention first, and findings that belong to none, as one comment."""
    order = list(Mark)
    ranked = sorted(sections, key=lambda section: order.index(section.mark))
    brief = [_headline(section) for section in ranked if not section.has_details]
    blocks = _table(findings_table(findings))
    for section in ranked:
        if section.has_details:
            blocks += [f"### {_headline(section)}", *_details(section)]
    blocks += _folded("robots", len(brief), "\n".join(f"- {line}" for line in brief)) if brief else []
    length = 0
    for number, block in enumerate(blocks):
        length += len(block) + 2
        if length > LONGEST:
            rest = "The rest is too long for a comment; the command without `--format` shows it."
            return "\n\n".join([*blocks[:number], rest]) + "\n"
    return "\n\n".join(blocks) + "\n"


def findings_table(findings: Sequence[Diagnostic]) -> Table:
    """Return findings as a table, the worst first."""
    order = list(Severity)
    rows = [
        (
            f"{_SEVERITIES[finding.severity]}{finding.severity}",
            ":".join([finding.file, *(str(number) for number in (finding.line,) if number)]),
            finding.sentence,
            finding.code,
        )
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity))
    ]
    return Table("Findings", ("", "Place", "Finding", "Code"), rows)


def _headline(section: Section) -> str:
    return f"{section.mark}{escape(section.robot)}: {escape(section.summary)}"


def _details(section: Section) -> list[str]:
    """Return all below the headline: advice, structure, findings, tables."""
    blocks = [f"{escape(section.verdict.hint[:1].upper() + section.verdict.hint[1:])}."] if section.verdict else []
    if section.points:
        points = [*section.points[:MOST_ROWS], *_rest(len(section.points))]
        blocks += _folded("lines", len(points), "\n".join(f"- {escape(point)}" for point in points))
    for table in (findings_table(section.findings), *section.tables):
        blocks += _table(table)
    return blocks


def _table(table: Table) -> list[str]:
    """Return a table as one block, without its empty columns; none if it has no rows."""
    columns = [number for number in range(len(table.columns)) if any(row[number] for row in table.rows)]
    if not columns:
        return []
    lines = [[table.columns[number] for number in columns], ["---"] * len(columns)]
    lines += [[escape(row[number]) for number in columns] for row in table.rows[:MOST_ROWS]]
    text = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    more = "".join(f"\n\n{escape(words)}" for words in _rest(len(table.rows)))
    (block,) = _folded(table.title.lower(), len(table.rows), f"{text}{more}")
    return [block if len(table.rows) > FOLDED else f"**{table.title}**\n\n{block}"]


def _rest(number: int) -> list[str]:
    return [f"… and {number - MOST_ROWS} more"] if number > MOST_ROWS else []


def _folded(what: str, number: int, text: str) -> list[str]:
    """Return text as one block, folded if it is long. Blank lines let the text between tags be Markdown."""
    if number <= FOLDED:
        return [text]
    return [f"<details>\n<summary>{number} {what}</summary>\n\n{text}\n\n</details>"]
