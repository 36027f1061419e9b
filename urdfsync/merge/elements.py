"""Three-way merge of classes: what changed from base to generated is done to the user's text, thing by thing.

A thing is an element, an equation, a modifier or a part of one (`urdfsync.modelica.tree`).

- What one side added, removed or changed is done; what both added stays, the user's first.
- Things that both sides changed are merged part by part; a part of which both say something else is a contradiction.
- Nothing else of the user's text changes: his comments, blanks and order stay.
- Blanks, comments and the order of declarations are no change. Neither is rounding, where the other side changed it.
- Layout is the user's in a class where he changed some of it.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterable, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.merge.layout import arrange
from urdfsync.merge.lines import merge_whole_lines
from urdfsync.merge.pairs import pair
from urdfsync.modelica.tree import LAYOUT, Leaf, Node, Part, SyntaxTree, TreeKind, as_sum, comments, words_of

ROUNDING = 1e-6
"""Numbers that differ by less, relative to the larger one, are the same number written with other digits."""

_ROLES = (
    *("within", "prefixes", "word", "head", "type", "name", "sizes", "connect", "equation", "import", "external"),
    *("arguments", "sign", "expression", "value", "condition", "constraint", "description", "annotation"),
    *("definition", "body", "end", ";"),
)
"""The order of the roles that the parts of an element have."""
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_MOVABLE = frozenset({"arguments", "annotation"})
"""Lists that mean nothing if they are empty."""


class Contradiction(msgspec.Struct, frozen=True):
    """A thing of which the sides say something else; a text is empty on a side that does not have the thing."""

    path: tuple[str, ...]
    """The keys of the things around it, from the outermost one, and its own."""
    base: str
    mine: str
    generated: str
    starts: tuple[int, int, int]
    """Where the texts of base, mine and generated begin; where the thing around it does on a side that lacks it."""


Piece: TypeAlias = str | Contradiction


def merge_trees(base: SyntaxTree, mine: SyntaxTree, generated: SyntaxTree) -> list[Piece]:
    """Return the merged text of a class in pieces: texts, and where the sides contradict each other."""
    return _join(_merge((), base, mine, generated, keeps_layout=False))


def _join(pieces: Iterable[Piece]) -> list[Piece]:
    """Texts that follow each other, in one."""
    found: list[Piece] = []
    texts: list[str] = []
    for piece in pieces:
        if isinstance(piece, str):
            texts.append(piece)
            continue
        found += ["".join(texts), piece] if texts else [piece]
        texts = []
    return [*found, "".join(texts)] if texts else found


def _merge(path: tuple[str, ...], base: Node | None, mine: Node, generated: Node, *, keeps_layout: bool) -> list[Piece]:
    """Merge a thing that both sides have."""
    if (base and base.meaning == generated.meaning) or mine.meaning == generated.meaning:
        return [mine.text]
    if any(isinstance(node, SyntaxTree) and node.kind is TreeKind.SUM for node in (base, mine, generated)):
        base, mine, generated = base and as_sum(base), as_sum(mine), as_sum(generated)
    if (path[-1:] and path[-1] in LAYOUT and (keeps_layout or not base)) or (not base and mine.bare == generated.bare):
        return [mine.text]
    if isinstance(mine, SyntaxTree) and isinstance(generated, SyntaxTree) and mine.kind is generated.kind:
        if isinstance(base, SyntaxTree) and base.kind is mine.kind:
            return _merge_parts(path, base, mine, generated, keeps_layout)
        if not base and mine.kind is not TreeKind.SLOTS:
            return _merge_parts(path, None, mine, generated, keeps_layout)
    is_same = base is not None and (base.meaning == mine.meaning or _is_rounding(base, mine))
    if base and all("\n" in node.text for node in (base, mine, generated)):
        text = merge_whole_lines(base.text, mine.text, generated.text)
        if text is not None and (not is_same or words_of(text) == generated.meaning):
            return [text]
    if base and is_same:
        return [generated.text, *(f" {note}" for note in _new_comments(mine.text, base.text))]
    if _is_rounding(mine, generated) or (base and _is_rounding(base, generated)):
        return [mine.text]
    return [_contradiction(path, base, mine, generated, mine)]


def _contradiction(
    path: tuple[str, ...], base: Node | None, mine: Node | None, generated: Node | None, around: Node
) -> Contradiction:
    nodes = (base, mine, generated)
    texts, starts = [node.text if node else "" for node in nodes], [(node or around).start for node in nodes]
    return Contradiction(path, texts[0], texts[1], texts[2], (starts[0], starts[1], starts[2]))


def _is_rounding(one: Node, other: Node) -> bool:
    """Whether two texts differ in the last digits of numbers alone."""
    if not (isinstance(one, Leaf) and isinstance(other, Leaf)) or len(one.words) != len(other.words):
        return False
    return all(
        left == right
        or (
            isinstance(left, float)
            and isinstance(right, float)
            and math.isclose(left, right, rel_tol=ROUNDING, abs_tol=0)
        )
        for left, right in zip(one.words, other.words, strict=True)
    )


def _new_comments(mine: str, base: str) -> list[str]:
    """Comments of the user's in a text that goes; those to the end of a line end one."""
    old = comments(base)
    return [f"{note}\n" if note.startswith("//") else note for note in comments(mine) if note not in old]


def _runs_on(blanks: str) -> bool:
    """Whether what follows these blanks and comments would be in a comment."""
    # one comment after the other: a pattern for all of them would try each end of a comment with each end of the others
    *_, last = "", *_COMMENT.findall(blanks)
    return last.startswith("//") and blanks.endswith(last)


class _Item(msgspec.Struct, eq=False):
    """A part of the merged text."""

    key: str
    section: str
    before: str
    pieces: list[Piece]
    after: str = ""
    remark: str = ""
    is_users: bool = False
    """Whether the user alone has it."""


_Items: TypeAlias = dict[str, _Item]
"""Parts of the merged text by their keys."""


def _merge_parts(
    path: tuple[str, ...], base: SyntaxTree | None, mine: SyntaxTree, generated: SyntaxTree, keeps_layout: bool
) -> list[Piece]:
    """Merge things that consist of others."""
    if mine.kind is TreeKind.BODY:
        keeps_layout = base is not None and _has_moved(base, mine)
        if base:
            base, mine, generated = pair(base, mine, generated)
    items: list[_Item] = []
    moved: dict[str, _Item] = {}
    notes = ""  # the user's comments in what goes, for the next item
    for part in mine.parts:
        old, new, here = base and base.find(part.key), generated.find(part.key), (*path, part.key)
        pieces: list[Piece] = [part.node.text]
        if new:
            pieces = _merge(here, old.node if old else None, part.node, new.node, keeps_layout=keeps_layout)
        elif old and part.key.startswith("section "):
            pass
        elif old and part.node.bare == old.node.bare:
            notes += _remaining_notes(part, old)
            continue
        elif old and part.key in _MOVABLE and isinstance(old.node, SyntaxTree) and isinstance(part.node, SyntaxTree):
            nothing = msgspec.structs.replace(old.node, parts=())
            pieces = _merge(here, old.node, part.node, nothing, keeps_layout=keeps_layout)
        elif old:
            pieces = [_contradiction(here, old.node, part.node, None, part.node)]
        section = mine.sections.get(part.key, "")
        item = _Item(part.key, section, notes + part.before, pieces, part.after, part.remark, not (old or new))
        notes = ""
        if base and new and base.sections.get(part.key, "") == section != generated.sections.get(part.key, ""):
            moved[part.key] = item  # such as from `public` to `protected`
        else:
            items.append(item)
    by_key = {item.key: item for item in items}
    arranged = arrange(mine, generated) if mine.kind is TreeKind.BODY and keeps_layout else {}
    for number, part in enumerate(generated.parts):
        old, section = base and base.find(part.key), generated.sections.get(part.key, "")
        if part.key in moved:
            item = msgspec.structs.replace(moved[part.key], section=section)
        elif mine.find(part.key) or (old and _is_settled(part, old)):
            continue
        else:
            pieces = [arranged.get(part.key, part.node.text)]
            if old:
                pieces = [_contradiction((*path, part.key), old.node, None, part.node, mine)]
            before = part.before if number or mine.kind is not TreeKind.LIST else ""
            item = _Item(part.key, section, before, pieces, part.after, part.remark)
        items.insert(_place(items, item, number, generated, mine, by_key), item)
        by_key[item.key] = item
    return _text_of(mine, items, notes)


def _is_settled(part: Part, old: Part) -> bool:
    """Whether the user removed what the export did not change."""
    return part.key.startswith("section ") or part.node.bare == old.node.bare


def _has_moved(base: SyntaxTree, mine: SyntaxTree) -> bool:
    """Whether the user changed the layout of anything in a class."""
    pairs = ((part.node, mine.find(part.key)) for part in base.parts)
    return any(other and _layout(node) != _layout(other.node) for node, other in pairs)


def _layout(node: Node) -> list[object]:
    """The layout of one element."""
    annotation = node.find("annotation") if isinstance(node, SyntaxTree) else None
    parts = annotation.node.parts if annotation and isinstance(annotation.node, SyntaxTree) else ()
    return [(part.key, part.node.meaning) for part in sorted(parts, key=lambda part: part.key) if part.key in LAYOUT]


def _remaining_notes(part: Part, old: Part) -> str:
    """The user's comments at a thing that goes, each with the blanks before it."""
    had = comments(f"{old.before}{old.node.text}{old.after}{old.remark}")
    lead = next(iter(re.findall(r"\n[ \t]*(?=\S|\Z)", part.before)), " ")
    found = [note for note in comments(f"{part.before}{part.node.text}{part.after}{part.remark}") if note not in had]
    return "".join(f"{lead}{note}" for note in found)


# --- where something new goes -------------------------------------------------------------------------------------


def _place(
    items: Sequence[_Item], item: _Item, number: int, generated: SyntaxTree, mine: SyntaxTree, by_key: _Items
) -> int:
    """The place behind what precedes something new in the generated text, and behind what the user added there."""
    if mine.kind is TreeKind.SLOTS:
        return sum(_ROLES.index(one.key) <= _ROLES.index(item.key) for one in items if one.key in _ROLES)
    is_section = item.key.startswith("section ")
    for before in range(number - 1, -1, -1):
        one = by_key.get(generated.parts[before].key)
        if one and (is_section or one.section == item.section):
            place = items.index(one) + 1
            while place < len(items) and items[place].is_users and (is_section or items[place].section == item.section):
                place += 1
            return place
    for behind in range(number + 1, len(generated.parts)):
        one = by_key.get(generated.parts[behind].key)
        if one and one.section == item.section:
            return items.index(one)
    inside = [place for place, one in enumerate(items) if one.section == item.section]
    if inside:
        return inside[-1] + 1
    if item.section == "section public":
        return 0
    return next((place for place, one in enumerate(items) if one.key == "annotation"), len(items))


# --- the text -----------------------------------------------------------------------------------------------------


def _text_of(tree: SyntaxTree, items: Sequence[_Item], notes: str) -> list[Piece]:
    """The merged things as text, with what stands around and between them."""
    empty = _empty_sections(tree, items)
    kept = [item for item in items if item.key not in empty]
    if tree.kind in (TreeKind.LIST, TreeKind.ARRAY, TreeKind.SUM):
        _set_apart(tree, kept)
    found: list[Piece] = [tree.opening]
    blanks = ""
    for number, item in enumerate(kept):
        _go_on(found, blanks + item.before)
        found += item.pieces
        blanks = item.after
        if tree.separator and number < len(kept) - 1:
            _go_on(found, blanks)
            found.append(tree.separator)
            blanks = ""
        blanks += item.remark
    has_bracket = tree.kind in (TreeKind.LIST, TreeKind.ARRAY)
    _go_on(found, blanks + notes + (tree.closing[:-1] if has_bracket else ""))
    found.append(tree.closing[-1:] if has_bracket else tree.closing)
    return [piece for piece in found if piece]


def _go_on(found: list[Piece], blanks: str) -> None:
    """Add blanks and comments; what follows does not run into them, nor they into the line before."""
    last = found[-1] if found else ""
    if isinstance(last, str) and last.endswith("\n") and re.match(r"\s*\n", blanks):
        found[-1] = last[:-1]  # the end of a comment
    found.append(f"{blanks}\n" if _runs_on(blanks) else blanks)


def _empty_sections(tree: SyntaxTree, items: Sequence[_Item]) -> set[str]:
    """The words that begin a section with nothing in it, unlike in the user's text."""
    had, has = (_sections_without_parts([one.key for one in parts]) for parts in (tree.parts, items))
    return has - had


def _sections_without_parts(keys: Sequence[str]) -> set[str]:
    pairs = itertools.pairwise((*keys, "annotation"))
    return {one for one, after in pairs if one.startswith("section ") and after.startswith(("section ", "annotation"))}


def _set_apart(tree: SyntaxTree, items: Sequence[_Item]) -> None:
    """Give items of a list the blanks that this list has between its items."""
    known = {part.key for part in tree.parts}
    usual = next((part.before for part in tree.parts[1:] if not part.before.strip()), None)
    between = (part.after for part in tree.parts[:-1] if part.after.isspace())
    behind = next(between, "" if tree.separator == "," else " ")
    first = re.findall(r"\s*", tree.parts[0].before)[0] if tree.parts else ""
    for number, item in enumerate(items):
        if item.key not in known:
            like_others = item.before or " " if usual is None else usual
            item.before = like_others if number else first
            item.after = behind
        elif not number and item.before.isspace():
            item.before = first
        elif number and item.key == tree.parts[0].key and not item.before[:1].isspace():
            item.before = (" " if usual is None else usual) + item.before
        if number < len(items) - 1 and not item.after:
            item.after = behind
    if items and (not items[-1].after or items[-1].after.isspace()):
        items[-1].after = ""
