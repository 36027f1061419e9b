"""Three-way merge of a file: a Modelica class by its elements, any other text by lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.merge.elements import merge_trees
from urdfsync.merge.lines import Contradiction, Piece, merge_lines
from urdfsync.merge.pairs import TooManyPairsError
from urdfsync.merge.renames import find_renamed, rename, without_clashes
from urdfsync.merge.words import describe, place_of
from urdfsync.modelica.lexer import find_markers
from urdfsync.modelica.parser import parse
from urdfsync.modelica.tree import KnownStatements, UnreadableError, find_faults, read_tree

MARKERS = ("<<<<<<< mine", "mine"), ("||||||| base", "base"), ("=======", "generated"), (">>>>>>> generated", "")
"""The markers before each version of a contradiction, and the marker after the last version."""
_BRANCHES = *MARKERS[:3], (">>>>>>> theirs", "")
"""The same markers for the versions of two branches."""


class Merge(msgspec.Struct, frozen=True):
    """The result of a merge."""

    text: str | None
    """The merged text; None if there is a contradiction or a flaw."""
    proposal: str
    """The merged text for people, with all three versions of a contradiction between markers; never written to a `.mo`
    file."""
    contradictions: tuple[str, ...]
    """The contradictions in words; an empty text for a contradiction of lines."""
    flaw: str = ""
    """Why the merged text is wrong Modelica, as the end of a sentence that begins with "the merge"."""
    with_mine: str | None = None
    """The merged text with the user's side of each contradiction; None without contradictions, or if it is wrong
    Modelica."""
    with_generated: str | None = None
    """The merged text with the generated side of each contradiction, or with the other branch's; None as above."""

    @property
    def rejected(self) -> Merge:
        """The same merge without texts to apply: only the proposal for people stays."""
        return msgspec.structs.replace(self, text=None, with_mine=None, with_generated=None)


def merge(
    base: str, mine: str, generated: str, *, is_modelica: bool = False, names: Mapping[str, str] | None = None
) -> Merge:
    """Apply to `mine` the changes from `base` to `generated`; `names` has new names by old names.

    Line endings are no difference. Lines of `mine` keep theirs; other lines get the most frequent ending of `mine`.
    With `is_modelica`, classes are merged by their elements, and the merge is checked for flaws that neither side has.
    """
    if names:
        base, mine = rename(base, mine, without_clashes(names, mine))
    ending = _ending(mine)
    statements: KnownStatements = {}
    pieces = _merge_pieces(base, mine, generated, ending, statements if is_modelica else None)
    told = tuple(describe(piece) for piece in pieces if isinstance(piece, Contradiction))
    merged, sides = _with_markers(pieces, ending, MARKERS), (mine, generated)
    if not told:
        flaw = find_flaw(merged, sides, statements) if is_modelica and merged != mine else ""
        return Merge(None if flaw else merged, merged, told, flaw)
    return Merge(None, merged, told, "", *_preferred(pieces, ending, sides, statements if is_modelica else None))


def _preferred(
    pieces: Sequence[Piece], ending: str, sides: Sequence[str], statements: KnownStatements | None
) -> Sequence[str | None]:
    """Return the texts in which one side wins all contradictions; None for wrong Modelica, if `statements` are known.

    Both are None if both sides added a component of one name, since they may mean different things.
    """
    if any(isinstance(piece, Contradiction) and _is_new_part(piece) for piece in pieces):
        return None, None
    texts = (
        "".join(piece if isinstance(piece, str) else _with_ending(getattr(piece, side), ending) for piece in pieces)
        for side in ("mine", "generated")
    )
    return [text if statements is None or not find_flaw(text, sides, statements) else None for text in texts]


def _is_new_part(contradiction: Contradiction) -> bool:
    """Whether both sides have added a component of this name."""
    return not contradiction.base and contradiction.path[-1:] != () and contradiction.path[-1].startswith("component ")


def merge_branches(base: str, mine: str, other: str, markers: Sequence[tuple[str, str]] = _BRANCHES) -> Merge:
    """Merge the versions of two people; the contradictions are elements.

    If the merge by elements has a flaw, the texts are merged by lines, and the elements are empty texts.
    """
    ending, merged, pieces, elements = _ending(mine), "", list[Piece](), tuple[str, ...]()
    ways: tuple[KnownStatements | None, ...] = {}, None
    for statements in ways:
        pieces = [*_merge_pieces(base, mine, other, ending, statements, is_export=False)]
        conflicts = (piece for piece in pieces if isinstance(piece, Contradiction))
        elements = tuple(place_of(conflict.path)[0] if conflict.path else "" for conflict in conflicts)
        merged = _with_markers(pieces, ending, markers)
        if elements or not find_flaw(merged, (mine, other)):
            break
    if not elements:
        return Merge(merged, merged, ())
    return Merge(None, merged, elements, "", *_preferred(pieces, ending, (mine, other), {}))


def _ending(text: str) -> str:
    """Return the most frequent line ending of a text."""
    return "\r\n" if 2 * text.count("\r\n") > text.count("\n") else "\n"


def _with_ending(text: str, ending: str) -> str:
    return text.replace("\r\n", "\n").replace("\n", ending)


def _merge_pieces(
    base: str, mine: str, generated: str, ending: str, statements: KnownStatements | None, *, is_export: bool = True
) -> Sequence[Piece]:
    """Return the merged text in pieces; new lines get the `ending`.

    `statements` gets the elements and equations that were read; if it is None, texts are merged by lines.
    """
    base, generated = _with_ending(base, ending), _with_ending(generated, ending)
    written = base, mine, generated
    plain_base, plain_mine, plain_generated = plain = [text.replace("\r\n", "\n") for text in written]
    is_mixed = "\r\n" in mine and mine.count("\r\n") < mine.count("\n")
    if plain_generated in (plain_base, plain_mine):
        return [mine]
    if plain_base == plain_mine and not is_mixed:
        return [generated]
    texts = written if is_mixed else plain
    pieces = None if statements is None else _merge_classes(texts, statements, is_export=is_export)
    if pieces is None:
        return merge_lines(*written)
    return [piece.replace("\n", ending) if isinstance(piece, str) and not is_mixed else piece for piece in pieces]


def _merge_classes(texts: Sequence[str], statements: KnownStatements, *, is_export: bool) -> list[Piece] | None:
    """Merge texts of one class each; None for any other text, or if the texts differ too much."""
    base, _, generated = texts
    base_tree, mine_tree, generated_tree = (read_tree(text, statements) for text in texts)
    if not (base_tree and mine_tree and generated_tree):
        return None
    try:
        if names := find_renamed(base_tree, mine_tree, generated_tree):
            base_tree, generated_tree = (
                read_tree(text, statements) for text in rename(base, generated, names, modifiers=False)
            )
        if not (base_tree and generated_tree):
            return None
        return merge_trees(base_tree, mine_tree, generated_tree, is_export=is_export)
    except (TooManyPairsError, UnreadableError):
        return None


def _with_markers(pieces: Sequence[Piece], ending: str, markers: Sequence[tuple[str, str]]) -> str:
    """Return the pieces as one text; for a line with a contradiction, all versions, each after its marker."""
    result: list[str] = []
    row: list[Piece] = []
    for piece in pieces:
        if isinstance(piece, Contradiction) and not piece.path:  # whole lines
            result += _shown([piece], ending, markers)
            continue
        *rows, rest = piece.split("\n") if isinstance(piece, str) else [piece]
        for part in rows:
            result += _shown([*row, f"{part}\n"], ending, markers)
            row = []
        row.append(rest)
    return "".join([*result, *_shown(row, ending, markers)])


def _shown(row: Sequence[Piece], ending: str, markers: Sequence[tuple[str, str]]) -> list[str]:
    """Return one line; if it has contradictions, return its versions between markers."""
    if all(isinstance(piece, str) for piece in row):
        return [piece for piece in row if isinstance(piece, str)]
    versions: list[str] = []
    for marker, side in markers:
        text = _version(row, side) if side else ""
        text = text.replace("\r\n", "\n").removesuffix("\n").replace("\n", ending)
        versions.append(f"{marker}{ending}{text}{ending if text else ''}")
    return versions


def _version(row: Sequence[Piece], side: str) -> str:
    """Return a side's version of one line, without the comma of a missing part."""
    text, lacks = "", False
    for piece in row:
        if not isinstance(piece, str):
            words: str = getattr(piece, side)
            lacks = not words
        elif lacks and piece.lstrip().startswith(","):
            text, words = text.rstrip(" "), piece.lstrip()[1:]
        else:
            words = piece
            text = re.sub(r",\s*$", "", text) if lacks and piece[:1] in (")", "}") else text
        text += words
    return text if text.strip() else ""


def find_flaw(text: str, sides: Sequence[str], statements: KnownStatements | None = None) -> str:
    """Return why a merged text is wrong Modelica; empty if the text is right.

    Names and types are not checked. The known `statements` of the sides are not read again. A fault does not count if
    one side has it as often as the merge.
    """
    faults = [*find_markers(text), *find_faults(text, statements or {})]
    counts = Counter[str]()
    for side in sides if faults else ():
        counts |= Counter(fault.reason for fault in (*find_markers(side), *parse(side).faults))
    for reason, line, _ in faults:
        counts[reason] -= 1
        if counts[reason] < 0:
            return f"{reason} (line {line})"
    return ""
