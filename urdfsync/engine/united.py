"""What git has made of a file that two branches wrote."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from urdfsync import dependencies
from urdfsync.diagnostics import SourceError
from urdfsync.modelica.tree import SyntaxTree, read_tree
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


def lacks(text: str, versions: Iterable[str], generated: str) -> bool:
    """Return whether a class lacks an element that its versions share, or that one of them and the generated one have.

    In another text lines count for elements. One with markers is on its way.
    """
    if join_sides(text) != text:
        return False
    of_sides = [_elements(version) for version in versions]
    wanted = set.intersection(*of_sides) | (set.union(*of_sides) & _elements(generated))
    return not wanted <= _elements(text)


def is_merge_by_lines(text: str, versions: Iterable[str]) -> bool:
    """Return whether a text has all lines that its versions share, and none that no version has."""
    lines, sides = {*join_sides(text).splitlines()}, [{*version.splitlines()} for version in versions]
    return set.intersection(*sides) <= lines <= set.union(*sides)


def _elements(text: str) -> set[str]:
    tree = read_tree(text)
    body = tree.find("body") if tree else None
    if body is None or not isinstance(body.node, SyntaxTree):
        return {*text.splitlines()}
    return {part.key for part in body.node.parts}


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
