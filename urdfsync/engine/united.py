"""What git has made of a file that two branches wrote."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from urdfsync import dependencies
from urdfsync.diagnostics import SourceError
from urdfsync.revisions import Revision

MARKER = r"(?m)^(?:<{7,}|>{7,}) "
"""A merge marker of git. `=======` alone is also a rule of a comment."""
_UNDER_WAY = "MERGE_HEAD", "CHERRY_PICK_HEAD", "REBASE_HEAD"
"""What git calls the commit that it is bringing to HEAD."""
_BETWEEN_MARKERS = re.compile(
    r"(?ms)^<{7} [^\n]*\n(?P<ours>.*?)(?:^\|{7}[^\n]*\n.*?)?^={7}\r?\n(?P<theirs>.*?)^>{7} [^\n]*(?:\n|\Z)"
)


def join_sides(text: str) -> str:
    """Return the text with the lines of both sides, and without git's markers."""
    return _BETWEEN_MARKERS.sub(r"\g<ours>\g<theirs>", text)


def is_merge_by_lines(text: str, versions: Iterable[str]) -> bool:
    """Return whether a text has all lines that its versions share, and none that no version has."""
    lines, sides = {*join_sides(text).splitlines()}, [{*version.splitlines()} for version in versions]
    return set.intersection(*sides) <= lines <= set.union(*sides)


def find_versions(file: Path) -> list[str]:
    """Return a text file as the two commits have it that git unites: now, in a merge or a rebase, or in the last merge.

    Nothing if there is no such merge, or if a commit has no such text.
    """
    dependencies.mark_incomplete()  # a commit changes the answer, and no file
    for names in (*(("HEAD", name) for name in _UNDER_WAY), ("HEAD^1", "HEAD^2")):
        try:
            return [Revision(file.parent, name).read(file).decode() for name in names]
        except (SourceError, UnicodeDecodeError):
            continue
    return []
