"""Finds the changes of a text, by elements of its class."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import msgspec

from urdfsync.merge.words import place_of, quoted, quoted_pair
from urdfsync.modelica.tree import (
    LAYOUT,
    Node,
    SyntaxTree,
    TreeKind,
    UnreadableError,
    comments,
    is_same,
    is_section,
    read_tree,
)

_ITEM = re.compile(r" #\d+$")
"""The number at the end of the key of a node without a name."""
_DOCUMENTATION = "the Documentation"
"""The name of the element for edits of a documentation."""


class Edit(msgspec.Struct, frozen=True):
    """One difference between base and *mine*; a missing text is None."""

    element: str
    """The element, such as "component `body`"."""
    part: str
    """The changed part of the element, such as `inertial.mass`, "type" or "layout"; empty for the whole element."""
    base: str | None
    mine: str | None

    @property
    def told(self) -> str:
        """The change in words, without the element."""
        what = f"{self.part} " if self.part else ""
        if self.element == _DOCUMENTATION:  # long, and HTML
            return f"{what}changed"
        if self.base is None or self.mine is None:
            return f"{what}{'added' if self.base is None else 'removed'}"
        if self.part in ("layout", "order of inputs and outputs"):
            return f"{what}{'moved' if self.part == 'layout' else 'changed'}"
        return f"{what}{' → '.join(quoted_pair(self.base, self.mine))}"

    @property
    def is_for_readers(self) -> bool:
        """Whether only a documentation or a description changed: no simulation reads these."""
        return self.element == _DOCUMENTATION or self.part == "description"


def find_edits(base: str, mine: str) -> list[Edit] | None:
    """Return the differences of two versions of a class; None if a text is not one Modelica class.

    Blanks and the order of declarations are no differences, but the order of a function's inputs and outputs is. All
    changed comments together are one difference.
    """
    base_tree, mine_tree = read_tree(base), read_tree(mine)
    if not (base_tree and mine_tree):
        return None
    try:
        edits = [_edit(path, old, new) for path, old, new in _differences((), base_tree, mine_tree)]
    except UnreadableError:
        return None
    if comments(base) != comments(mine):
        edits.append(Edit("comments", "", None, None))
    return list(dict.fromkeys(edits))


def _edit(path: tuple[str, ...], old: Node | None, new: Node | None) -> Edit:
    base, mine = old.text if old else None, new.text if new else None
    if _ITEM.search(path[-1]):  # a term of a sum, or an item of an array
        element, part = place_of(tuple(key for key in path[:-1] if key != "expression"))
        return Edit(element, f"{part} {quoted(base or mine or '')}".lstrip(), base, mine)
    element, part = place_of(tuple(key for key in path if key not in LAYOUT))
    return Edit(element, "layout" if not LAYOUT.isdisjoint(path) else part, base, mine)


def _differences(
    path: tuple[str, ...], old: Node, new: Node
) -> Iterator[tuple[tuple[str, ...], Node | None, Node | None]]:
    """Yield both versions of each innermost difference, and the keys that lead there, the outermost first."""
    if is_same(old, new):
        return
    if not (isinstance(old, SyntaxTree) and isinstance(new, SyntaxTree) and old.kind is new.kind) or (
        path and path[-1] in LAYOUT
    ):
        yield path, old, new
        return
    keys = [[child.key for child in tree.children] for tree in (old, new)]
    if old.kind is TreeKind.ARRAY and sorted(keys[0]) == sorted(keys[1]):  # in another order
        yield path, old, new
        return
    if sorted(old.signature) == sorted(new.signature) and old.signature != new.signature:
        yield (*path, "order"), old, new
    for child in new.children:
        before = old.find(child.key)
        if before:
            yield from _differences((*path, child.key), before.node, child.node)
        elif not is_section(child.key):
            yield (*path, child.key), None, child.node
    for child in old.children:
        if not new.find(child.key) and not is_section(child.key):
            yield (*path, child.key), child.node, None


def in_words(edits: Sequence[Edit]) -> list[tuple[str, str]]:
    """Return the elements and their changes in words, texts for readers last; layout and comments are one line each."""
    told = [edit for edit in edits if edit.element != "comments" and edit.part != "layout"]
    lines = [(edit.element, edit.told) for edit in sorted(told, key=lambda edit: edit.is_for_readers)]
    if moved := {edit.element for edit in edits if edit.part == "layout"}:
        what = "1 element" if len(moved) == 1 else f"{len(moved)} elements"
        lines.append(("layout", f"{what} placed or drawn differently"))
    return [*lines, *(("comments", "changed") for edit in edits if edit.element == "comments")]
