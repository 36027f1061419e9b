"""Writes Markdown for a comment on a merge request: structure first, then tables, folded if they are long.

The comment is HTML, which GitHub and GitLab accept: quoted text can't become markup in HTML, and cells may have any
text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import jinja2
import markupsafe

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.spelling import visible
from urdfsync.output.sections import Mark, Section, findings_table

FOLDED = 30
"""Tables and lists with more rows are folded."""
MOST_ROWS = 100
"""The greatest number of rows of a table that are written; further rows are counted."""
LONGEST = 50_000
"""The greatest number of characters of details about robots; GitHub allows 65,536 for a comment."""
_TOO_LONG = " (the rest is too long for a comment: the command without `--format` shows it)"
_CODE = re.compile("`([^`]+)`")


def document(sections: Iterable[Section], findings: Sequence[Diagnostic] = (), _code: int = 0) -> str:
    """Return one comment: robots that need attention, other robots, then findings about no robot."""
    environment = html_environment(Path(__file__).parent)
    environment.filters |= {"quoted": _quoted, "findings": findings_table}
    environment.globals |= {"most_open": FOLDED, "most_rows": MOST_ROWS}
    parts: Any = environment.get_template("comment.jinja").module
    text, order, brief = str(parts.rows(findings_table(findings))), list(Mark), []
    for section in sorted(sections, key=lambda section: order.index(section.mark)):
        details = str(parts.robot(section)) if section.has_details else ""
        is_long = len(text) + len(details) > LONGEST
        if details and not is_long:
            text += details
        else:
            brief.append(f"{section.mark}{section.robot}: {section.summary}{_TOO_LONG if is_long else ''}")
    return re.sub("\n+", "\n", f"{text}{parts.robots(brief)}").lstrip()


def html_environment(folder: Path) -> jinja2.Environment:
    """Return an environment for templates of HTML that escapes all texts."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )


def words(text: str) -> markupsafe.Markup:
    """Return text, with the parts between ` as code."""
    return markupsafe.Markup("").join(
        markupsafe.Markup("<code>{}</code>").format(piece) if number % 2 else piece
        for number, piece in enumerate(_CODE.split(text))
    )


def _quoted(text: str) -> markupsafe.Markup:
    """Return text on one line, in which hosts find no names of users and no numbers of issues."""
    return words(re.sub("([@#])", "\\1\u2060", visible(text)))
