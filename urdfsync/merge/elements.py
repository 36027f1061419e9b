"""Three-way merge of classes: applies the changes from base to generated to the user's text, node by node.

A node is an element, an equation, a modifier, or an expression in one of these (`urdfsync.modelica.tree`).

- A change, an addition or a removal by one side is taken. If both sides add nodes, all stay, the user's first.
- A node that both sides changed is merged child by child. A child that they changed differently is a contradiction.
- Nodes stand in the generated order. A node that the user added or moved stands behind its predecessor in his text.
- Arrays, and the inputs and outputs of a function, are sequences (`urdfsync.merge.lines`).
- Where the user changed blanks or comments, his blanks and comments stay.
- If the user changed a number, rounding of this number by the export is no change.
- If the user changed the layout of a diagram or icon, its layout stays (`urdfsync.merge.layout`).

Between two people, comments and layout count as content: a change by one side is taken. Comments are merged statement
by statement.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.common.spelling import same_count
from urdfsync.merge.layout import PICTURES, arrange, find_users_layout
from urdfsync.merge.lines import Contradiction, Piece, merge_order, merge_sequences, merge_whole_lines
from urdfsync.merge.pairs import pair
from urdfsync.modelica.tree import (
    LAYOUT,
    Child,
    Leaf,
    Node,
    SyntaxTree,
    TreeKind,
    as_sum,
    comments,
    is_same,
    is_section,
    section_name,
)

ROUNDING = 1e-6
"""The greatest difference of two numbers by rounding, relative to the larger number."""

_ROLES = (
    "within prefixes word head type name sizes connect equation import external components arguments sign expression "
    "value condition constraint description annotation definition body end ;"
).split()
"""The roles of an element's children, in order."""
_COMMENT = re.compile(r"//[^\n]*+|/\*.*?(?:\*/|\Z)", re.DOTALL)
_BLOCKS = frozenset({"if", "for", "when"})
_MOVABLE = frozenset({"arguments", "annotation"})
"""Lists without a meaning if they are empty."""


ElementPath: TypeAlias = tuple[str, ...]
Layout: TypeAlias = frozenset[str] | None
"""The annotations with the user's layout. None for a merge between two people: all layout and comments count."""


def merge_trees(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree, *, is_export: bool) -> list[Piece]:
    """Return the merged text of a class in pieces: texts and contradictions.

    Unless `is_export`, `generated` is the version of another person.
    """
    return _merge((), base, mine, generated, frozenset() if is_export else None)


def _merge(path: ElementPath, base: Node | None, mine: Node, generated: Node, users_layout: Layout) -> list[Piece]:
    """Merge a node that exists on both sides."""
    if base and base.text == mine.text and not users_layout:
        return [generated.text]
    is_two_people, key = users_layout is None, path[-1] if path else ""
    is_class = is_two_people and any(map(_has_body, (mine, generated)))
    if not is_class and ((base and is_same(base, generated)) or is_same(mine, generated)):
        return [mine.text]
    is_picture = bool(users_layout and users_layout & PICTURES.intersection(path))
    if (users_layout and key in users_layout and not is_picture) or (
        not base and not is_two_people and (key in LAYOUT or is_same(mine, generated, layout=False))
    ):
        return [mine.text]
    if any(isinstance(node, SyntaxTree) and node.kind is TreeKind.SUM for node in (base, mine, generated)):
        base, mine, generated = base and as_sum(base), as_sum(mine), as_sum(generated)
    if isinstance(mine, SyntaxTree) and isinstance(generated, SyntaxTree) and mine.kind is generated.kind:
        if isinstance(base, SyntaxTree) and base.kind is mine.kind:
            return _merge_children(path, base, mine, generated, users_layout)
        if not base and mine.kind in (TreeKind.LIST, TreeKind.BODY):
            return _merge_children(path, None, mine, generated, users_layout)
    if is_picture and isinstance(mine, Leaf) and isinstance(generated, Leaf):
        return [mine.text]
    return _merge_whole(path, base, mine, generated)


def _merge_statement(
    path: ElementPath, base: Node | None, mine: Node, other: Node, users_layout: Layout
) -> list[Piece]:
    """Merge one child of a class between two people, with comments: `_merge` would keep only the comments of `mine`."""
    merged = _merge_comments(base.text if base else "", mine.text, other.text)
    if merged is None:
        return [_contradiction(path, base, mine, other)]
    if merged == mine.text:
        return _merge(path, base, mine, other, users_layout)
    pieces = _merge(path, base, other, mine, users_layout)
    return [piece if isinstance(piece, str) else piece.swapped for piece in pieces]


def _merge_comments(base: str, mine: str, other: str) -> str | None:
    """Return the text whose comments both people can accept; None if both changed the comments."""
    if base == mine:
        return other
    old, own, new = map(comments, (base, mine, other))
    if new in (old, own):
        return mine
    return other if own == old else None


def _has_body(node: Node) -> bool:
    """Whether a node is a class or a body."""
    return isinstance(node, SyntaxTree) and (node.kind is TreeKind.BODY or node.find("body") is not None)


def _merge_whole(path: ElementPath, base: Node | None, mine: Node, generated: Node) -> list[Piece]:
    """Merge a node without children: take one side's text, or merge blocks, algorithms and strings by lines."""
    is_users = base is None or not is_same(base, mine)
    has_lines = all("\n" in node.text for node in (mine, generated)) and (not is_users or _has_lines(path, generated))
    if base and has_lines and "\n" in base.text:
        text = merge_whole_lines(base.text, mine.text, generated.text)
        if text is not None and (is_users or is_same(Leaf(text), generated)):
            return [text]
    if base and not is_users:
        pieces = list[Piece]([generated.text])
        for note in (note for note in comments(mine.text) if note not in comments(base.text)):
            lead = re.search(rf"\n[ \t]*(?={re.escape(note)})", mine.text)
            append_blanks(pieces, f"{lead[0] if lead else ' '}{note}")
        return pieces
    if _is_rounding(mine, generated) or (base and _is_rounding(base, generated)):
        return [mine.text]
    return [_contradiction(path, base, mine, generated)]


def _has_lines(path: ElementPath, node: Node) -> bool:
    """Whether a text that the user changed is merged line by line; other texts are merged as a whole."""
    if not isinstance(node, Leaf):
        return False
    is_block = path[-1] == "equation" and node.words[0] in _BLOCKS
    return is_block or path[-1].startswith("statements of ") or len(node.words) == 1


def _contradiction(path: ElementPath, base: Node | None, mine: Node | None, generated: Node | None) -> Contradiction:
    texts = [node.text if node else "" for node in (base, mine, generated)]
    return Contradiction(path, *texts)


def _contradiction_of_lines(path: ElementPath, texts: Sequence[str]) -> list[Piece]:
    """Return the common first lines of three texts, then a contradiction of the rest."""
    base, mine, other = texts
    start = mine[: min(same_count(mine, base), same_count(mine, other))].rfind("\n") + 1
    return [mine[:start], Contradiction(path, *(text[start:] for text in texts))]


def _is_rounding(old: Node, new: Node) -> bool:
    """Whether two texts differ only by rounding of numbers; Integers must be equal."""
    if not (isinstance(old, Leaf) and isinstance(new, Leaf)) or len(old.words) != len(new.words):
        return False
    return all(
        value == new_value
        or (
            not isinstance(value, str)
            and not isinstance(new_value, str)
            and not (isinstance(value, int) and isinstance(new_value, int))
            and math.isclose(value, new_value, rel_tol=ROUNDING, abs_tol=0)
        )
        for value, new_value in zip(old.words, new.words, strict=True)
    )


class _Item(msgspec.Struct, eq=False):
    """A piece of the merged text with a key."""

    key: str
    before: str
    pieces: list[Piece]
    after: str = ""
    remark: str = ""


class _Versions(NamedTuple):
    """The three versions of a node that has children, with the keys that lead to the node."""

    path: ElementPath
    base: SyntaxTree
    mine: SyntaxTree
    generated: SyntaxTree
    users_layout: Layout

    @property
    def trees(self) -> tuple[SyntaxTree, SyntaxTree, SyntaxTree]:
        """Base, mine and generated."""
        return self.base, self.mine, self.generated

    @property
    def is_two_people(self) -> bool:
        """Whether `generated` is the version of another person."""
        return self.users_layout is None

    @property
    def has_statements(self) -> bool:
        """Whether comments count statement by statement: in a class, between two people."""
        return self.is_two_people and _has_body(self.mine)

    @property
    def is_picture(self) -> bool:
        """Whether the node belongs to a diagram or icon that the user has changed."""
        return bool(self.users_layout and self.users_layout & PICTURES.intersection(self.path))


def _merge_children(
    path: ElementPath, base: SyntaxTree | None, mine: SyntaxTree, generated: SyntaxTree, users_layout: Layout
) -> list[Piece]:
    """Merge a node that has children."""
    trees = base or SyntaxTree(mine.kind, ()), mine, generated
    if mine.kind is TreeKind.BODY:
        users_layout = None if users_layout is None else find_users_layout(*trees[:2])
        trees = pair(*trees) if base else trees
    versions = _Versions(path, *trees, users_layout)
    items, notes = dict[str, _Item](), ""  # notes: comments of the user from removed children, for the next item
    for child in versions.mine.children:
        if _is_removed(versions, child):
            notes += _remaining_notes(child, versions.base.find(child.key))
            continue
        items[child.key] = item = _merge_child(versions, child)
        item.before, notes = notes + item.before, ""
    arranged = arrange(*versions[2:4], users_layout) if mine.kind is TreeKind.BODY and users_layout else {}
    for child in versions.generated.children:
        if child.key not in items and not _was_removed(versions, child):
            items[child.key] = _added_child(versions, child, arranged.get(child.key, child.node.text))
    has_sequence = mine.kind is TreeKind.BODY or (mine.kind is TreeKind.ARRAY and PICTURES.isdisjoint(path))
    sequence = _sequence(versions.trees) if has_sequence else []
    order = sequence if sequence and mine.kind is TreeKind.ARRAY else _order(versions.trees, items)
    # the order may name an element that one side moved and the other side removed
    if sequence is None or set(order) - items.keys() or [key for key in order if key in sequence] != sequence:
        place = (*path, "order") if mine.kind is TreeKind.BODY else path
        return [_contradiction(place, *versions.trees)]
    closing = _merge_closing(versions) if versions.has_statements else []
    return _text_of(versions.trees, [items[key] for key in order], notes, closing)


def _is_removed(versions: _Versions, child: Child) -> bool:
    """Whether the other side removed a child that the user has not changed."""
    _, base, mine, generated, users_layout = versions
    if is_section(child.key) or generated.find(child.key) or not base.find(child.key):
        return False
    is_graphic = versions.is_picture and mine.kind is TreeKind.ARRAY
    return is_graphic or _is_unchanged(child.key, base, mine, users_layout)


def _was_removed(versions: _Versions, child: Child) -> bool:
    """Whether the user removed a generated child that the export has not changed."""
    is_layout = versions.is_picture or (child.key in LAYOUT and not versions.is_two_people)
    if is_section(child.key) or not versions.base.find(child.key):
        return False
    return is_layout or _is_unchanged(child.key, versions.base, versions.generated, versions.users_layout)


def _merge_child(versions: _Versions, child: Child) -> _Item:
    """Merge a child that the user's version has."""
    path, base, mine, generated, users_layout = versions
    old, new, here = base.find(child.key), generated.find(child.key), (*path, child.key)
    pieces: list[Piece] = [child.node.text]
    if new and not is_section(child.key):
        is_statement = versions.has_statements and not any(map(_has_body, (child.node, new.node)))
        merge = _merge_statement if is_statement else _merge
        pieces = merge(here, old.node if old else None, child.node, new.node, users_layout)
    elif old and not is_section(child.key):
        if child.key in _MOVABLE and isinstance(old.node, SyntaxTree) and isinstance(child.node, SyntaxTree):
            pieces = _merge(here, old.node, child.node, old.node.with_children(()), users_layout)
        elif not versions.is_picture and child.key not in (users_layout or ()):
            pieces = [_contradiction(here, old.node, child.node, None)]
    # inside of an element, keep the user's blanks: they depend on each other
    blanks = _blanks(old, child, new if mine.kind is TreeKind.BODY else None)
    if versions.has_statements and new:
        blanks, pieces = _merge_around(here, old, child, new, pieces)
    before, after, remark = blanks
    if mine.separator:  # it stands before a comment to the end of the line
        remark = _joined(_take_last_notes(pieces), remark)
    return _Item(child.key, before, pieces or [child.node.text], after, remark)


def _added_child(versions: _Versions, child: Child, text: str) -> _Item:
    """Return a generated child that the user's version lacks; `text` has its place in the user's diagram."""
    pieces: list[Piece] = [text]
    if (old := versions.base.find(child.key)) and not is_section(child.key):
        pieces = [_contradiction((*versions.path, child.key), old.node, None, child.node)]
    return _Item(child.key, child.before, pieces, child.after, child.remark)


def _merge_closing(versions: _Versions) -> list[Piece]:
    """Merge the comments before the end of a class between two people."""
    closings = [tree.closing for tree in versions.trees]
    merged = _merge_comments(*closings)
    return _contradiction_of_lines((), closings) if merged is None else [merged]


def _sequence(trees: Sequence[SyntaxTree]) -> list[str] | None:
    """Merge an ordered sequence by keys; None if both sides changed the same place."""
    kind = trees[1].kind
    keys = [tree.signature if kind is TreeKind.BODY else [child.key for child in tree.children] for tree in trees]
    base, mine, generated = keys
    if mine == base or generated in (base, mine):
        return generated if mine == base else mine
    # if an array has equal items, it is unknown which of them stayed
    has_repetitions = kind is TreeKind.ARRAY and not all(key.endswith(" #1") for key in itertools.chain(*keys))
    return None if has_repetitions else merge_sequences(base, mine, generated)


def _is_unchanged(key: str, base: SyntaxTree, side: SyntaxTree, users_layout: Layout) -> bool:
    """Whether one side has a node of base, and the node's section, unchanged.

    Layout and comments count only between two people.
    """
    old, new = base.find(key), side.find(key)
    if not (old and new) or section_name(base.sections[key]) != section_name(side.sections[key]):
        return False
    is_two_people = users_layout is None
    is_commented = is_two_people and comments(_with_blanks(old)) != comments(_with_blanks(new))
    return is_same(old.node, new.node, layout=is_two_people) and not is_commented


def _with_blanks(child: Child | None) -> str:
    """Return a child with the blanks and comments around it."""
    return f"{child.before}{child.node.text}{child.after}{child.remark}" if child else ""


def _merge_around(
    path: ElementPath, base: Child | None, mine: Child, other: Child, pieces: list[Piece]
) -> tuple[Sequence[str], list[Piece]]:
    """Merge the comments around a child between two people; comments that both changed are a contradiction."""
    before = _merge_comments(base.before if base else "", mine.before, other.before)
    remark = _merge_comments(base.remark if base else "", mine.remark, other.remark)
    if before is None or remark is None:
        texts = [_with_blanks(child) for child in (base, mine, other)]
        return ("", "", ""), _contradiction_of_lines(path, texts)
    return (before, mine.after, remark), pieces


def _blanks(base: Child | None, mine: Child, generated: Child | None) -> Sequence[str]:
    """Return the blanks and comments around a child and its separator: the user's if changed, else the generated."""
    own = mine.before, mine.after, mine.remark
    is_changed = not (base and generated) or own != (base.before, base.after, base.remark)
    return own if is_changed or not generated else (generated.before, generated.after, generated.remark)


def _remaining_notes(child: Child, old: Child | None) -> str:
    """Return the user's comments at a removed node, each with a line break or blank before."""
    had = comments(_with_blanks(old))
    lead = next(iter(re.findall(r"\n[ \t]*(?=\S|\Z)", child.before)), " ")
    notes = [note for note in comments(_with_blanks(child)) if note not in had]
    return "".join(f"{lead}{note}" for note in notes)


def _take_last_notes(pieces: list[Piece]) -> str:
    """Remove the comments at the end of a merged node, if the last one ends its line; return them."""
    first = len(pieces)
    while first > 1 and isinstance(last := pieces[first - 1], str) and not _COMMENT.sub("", last).strip():
        first -= 1
    notes = "".join(map(str, pieces[first:]))
    if "//" not in notes or not notes.endswith("\n"):
        return ""
    del pieces[first:]
    return notes.removesuffix("\n")


# --- the order ----------------------------------------------------------------------------------------------------


def _order(trees: Sequence[SyntaxTree], keys: Iterable[str]) -> list[str]:
    """Return the keys of the merged children in order, section by section."""
    if trees[1].kind is TreeKind.SLOTS:
        return sorted(keys, key=_ROLES.index)
    homes = {key: _home(key, trees) for key in keys}
    sections = [list(dict.fromkeys(("", *tree.sections.values()))) for tree in trees]
    ordered: list[str] = []
    for section in sorted(merge_order(*sections), key="tail".__eq__):
        inside = [[key for key, place in tree.sections.items() if place == section == homes.get(key)] for tree in trees]
        ordered += merge_order(*inside)
    return ordered


def _home(key: str, trees: Sequence[SyntaxTree]) -> str:
    """Return the section of a merged child: the user's section, unless only the export moved the child."""
    old, own, new = (tree.sections.get(key) for tree in trees)
    if own is None or new is None:
        return own if new is None and own is not None else new or ""
    is_moved = old is not None and section_name(own) == section_name(old) != section_name(new)
    return new if is_moved else own


# --- the text -----------------------------------------------------------------------------------------------------


def _text_of(trees: Sequence[SyntaxTree], items: list[_Item], notes: str, end: list[Piece]) -> list[Piece]:
    """Return the text of the merged nodes, with blanks and separators; `end` is the merged closing."""
    base, mine, generated = trees
    empty = _empty_sections([[child.key for child in tree.children] for tree in (mine, generated)], items)
    items = [item for item in items if item.key not in empty or comments(item.before + item.remark)]
    if mine.separator:
        _space_items(mine, items)
    is_changed = mine.separator or mine.closing != base.closing
    closing = mine.closing if is_changed else generated.closing
    pieces: list[Piece] = [mine.opening]
    blanks = ""
    for number, item in enumerate(items):
        append_blanks(pieces, _joined(blanks, item.before))
        pieces += item.pieces
        blanks = item.after
        if mine.separator and number < len(items) - 1:
            append_blanks(pieces, blanks)
            pieces.append(mine.separator)
            blanks = ""
        blanks = _joined(blanks, item.remark)
    has_bracket = mine.kind in (TreeKind.LIST, TreeKind.ARRAY)
    append_blanks(pieces, _joined(blanks, notes + (closing[:-1] if has_bracket else "")))
    pieces += end or [closing[-1:] if has_bracket else closing]
    return [piece for piece in pieces if piece]


def _joined(blanks: str, more: str) -> str:
    """Return blanks and comments after others, on a new line if these end with a comment to the end of the line."""
    runs_on = more.strip() and not re.match(r"[ \t]*\n", more) and _runs_on(blanks)
    return f"{blanks}\n{more}" if runs_on else blanks + more


def _runs_on(blanks: str) -> bool:
    """Whether blanks and comments end with a comment that takes the rest of the line."""
    # match comment by comment: a single pattern would try all combinations of comment ends
    *_, comment = "", *_COMMENT.findall(blanks)
    return comment.startswith("//") and blanks.endswith(comment)


def append_blanks(pieces: list[Piece], blanks: str) -> None:
    """Add blanks and comments, and keep them apart from the lines before and after."""
    last = pieces[-1] if pieces else ""
    if isinstance(last, str) and last.endswith("\n") and re.match(r"\s*\n", blanks):
        pieces[-1] = last[:-1]  # it ended a comment
    pieces.append(f"{blanks}\n" if _runs_on(blanks) else blanks)


def _empty_sections(sides: Sequence[Sequence[str]], items: Sequence[_Item]) -> set[str]:
    """Return the keys of sections that are empty in the merge, but not in the two sides."""
    return _sections_without_children([item.key for item in items]).difference(*map(_sections_without_children, sides))


def _sections_without_children(keys: Sequence[str]) -> set[str]:
    pairs = itertools.pairwise((*keys, "annotation"))
    return {key for key, after in pairs if is_section(key) and (is_section(after) or after == "annotation")}


def _space_items(mine: SyntaxTree, items: Sequence[_Item]) -> None:
    """Give the items of a merged list the blanks between items of the user's list."""
    usual = next((child.before for child in mine.children[1:] if not child.before.strip()), None)
    between = (child.after for child in mine.children[:-1] if child.after.isspace())
    behind = next(between, "" if mine.separator == "," else " ")
    first = re.findall(r"\s*", mine.children[0].before)[0] if mine.children else ""
    for number, item in enumerate(items):
        if not mine.find(item.key):
            like_others = item.before or " " if usual is None else usual
            item.before = like_others if number else first
            item.after = behind
        elif not number and item.before.isspace():
            item.before = first
        elif number and item.key == mine.children[0].key and not item.before[:1].isspace():
            item.before = (" " if usual is None else usual) + item.before
        if number < len(items) - 1 and not item.after:
            item.after = behind
    if items and (not items[-1].after or items[-1].after.isspace()):
        items[-1].after = ""
