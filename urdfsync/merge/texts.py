"""Three-way merge of a file: a class of Modelica by its elements, any other text by lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.merge.elements import Contradiction, Piece, merge_trees
from urdfsync.merge.lines import merge_lines, split_lines
from urdfsync.merge.renames import rename
from urdfsync.merge.words import describe
from urdfsync.modelica.lexer import find_markers
from urdfsync.modelica.parser import parse
from urdfsync.modelica.tree import read_tree


class ConflictingLines(msgspec.Struct, frozen=True):
    """Where the sides disagree: line numbers, from 1, in the three texts; an empty range is the place before a line."""

    base: range
    mine: range
    generated: range
    what: str = ""
    """What they disagree about; empty for whole lines."""


class Merge(msgspec.Struct, frozen=True):
    """The result of a merge."""

    text: str | None
    """The merged text; None if there is a conflict or a flaw."""
    proposal: str
    """The merged text, with all three versions of a conflict between markers: for people, never for a `.mo` file."""
    conflicts: tuple[ConflictingLines, ...]
    flaw: str = ""
    """Why the merged text can't be right as Modelica, as the end of a sentence that begins with "the merge"."""


def merge(
    base: str, mine: str, generated: str, *, is_modelica: bool = False, names: Mapping[str, str] | None = None
) -> Merge:
    """Bring what changed from `base` to `generated` into `mine`; `names` has new names by the old ones.

    Kinds of line endings are no difference. Lines of `mine` keep theirs, others get the one that prevails in
    `mine`. With `is_modelica`, classes are merged by their elements, and a merge is checked for flaws that neither side
    has.
    """
    ending = "\r\n" if 2 * mine.count("\r\n") > mine.count("\n") else "\n"
    base, generated = (text.replace("\r\n", "\n").replace("\n", ending) for text in (base, generated))
    if names:
        base, mine = rename(base, mine, names)
    plain = [text.replace("\r\n", "\n") for text in (base, mine, generated)]
    is_mixed = "\r\n" in mine and mine.count("\r\n") < mine.count("\n")
    if plain[2] in (plain[0], plain[1]):
        return Merge(mine, mine, ())
    if plain[1] == plain[0] and not is_mixed:
        return Merge(generated, generated, ())
    texts = (base, mine, generated) if is_mixed else plain
    pieces = _merge_classes(*texts) if is_modelica else None
    if pieces and not is_mixed:
        pieces = [piece.replace("\n", ending) if isinstance(piece, str) else piece for piece in pieces]
    elif not pieces:
        pieces = _merge_by_lines(mine, plain, ending)
        texts = plain
    conflicts = tuple(_find_lines(piece, texts) for piece in pieces if isinstance(piece, Contradiction))
    merged = _with_markers(pieces, ending)
    flaw = find_flaw(merged, (mine, generated)) if is_modelica and not conflicts and merged != mine else ""
    return Merge(None if conflicts or flaw else merged, merged, conflicts, flaw)


def _merge_classes(*texts: str) -> list[Piece] | None:
    """Merge texts that are one class each; None if one of them is not."""
    trees = [tree for tree in map(read_tree, texts) if tree]
    return merge_trees(*trees) if len(trees) == len(texts) else None


def _merge_by_lines(mine: str, texts: Sequence[str], ending: str) -> list[Piece]:
    lines = [split_lines(text) for text in texts]
    written, place = split_lines(mine), 0
    pieces: list[Piece] = []
    for parts, text in merge_lines(*lines):
        pieces.append("".join(written[place : parts[1].start]))
        place = parts[1].stop
        if text is None:
            base, own, new = ("".join(one[part.start : part.stop]) for one, part in zip(lines, parts, strict=True))
            first, second, third = (len("".join(one[: part.start])) for one, part in zip(lines, parts, strict=True))
            pieces.append(Contradiction((), base, own, new, (first, second, third)))
        else:
            pieces.append(text.replace("\n", ending))
    return [*pieces, "".join(written[place:])]


def _find_lines(found: Contradiction, texts: Sequence[str]) -> ConflictingLines:
    """The lines of a contradiction in base, mine and generated."""
    ranges = []
    versions = (found.base, found.mine, found.generated)
    for text, part, start in zip(texts, versions, found.starts, strict=True):
        first = text.count("\n", 0, start) + 1
        ranges.append(range(first, first + len(split_lines(part))))
    return ConflictingLines(ranges[0], ranges[1], ranges[2], describe(found))


def _with_markers(pieces: Sequence[Piece], ending: str) -> str:
    """Return the pieces as one text; lines with contradictions in them in all three versions."""
    result: list[str] = []
    row: list[Piece] = []
    for piece in pieces:
        if isinstance(piece, Contradiction) and not piece.path:  # whole lines
            result += _shown([piece], ending)
            continue
        *rows, rest = piece.split("\n") if isinstance(piece, str) else [piece]
        for part in rows:
            result += _shown([*row, f"{part}\n"], ending)
            row = []
        row.append(rest)
    return "".join([*result, *_shown(row, ending)])


def _shown(row: Sequence[Piece], ending: str) -> list[str]:
    """One line as it is, or in three versions between markers."""
    if all(isinstance(piece, str) for piece in row):
        return [piece for piece in row if isinstance(piece, str)]
    found: list[str] = []
    sides = ("<<<<<<< mine", "mine"), ("||||||| base", "base"), ("=======", "generated")
    for marker, side in sides:
        text = _version(row, side).removesuffix("\n").removesuffix("\r")
        found.append(f"{marker}{ending}{text.replace(chr(13), '').replace(chr(10), ending)}{ending if text else ''}")
    return [*found, f">>>>>>> generated{ending}"]


def _version(row: Sequence[Piece], side: str) -> str:
    """One line as a side has it; without the comma of what this side does not have."""
    text, lacks = "", False
    for piece in row:
        if not isinstance(piece, str):
            said: str = getattr(piece, side)
            lacks = not said
        elif lacks and piece.lstrip().startswith(","):
            text, said = text.rstrip(" "), piece.lstrip()[1:]
        else:
            said = piece
            text = re.sub(r",\s*$", "", text) if lacks and piece[:1] in (")", "}") else text
        text += said
    return text if text.strip() else ""


def find_flaw(text: str, sides: Sequence[str]) -> str:
    """Return why a merged text can't be right as Modelica; empty if it can. Names and types are not checked.

    What is wrong with one of the sides already, as often as in the merge, is no flaw: it is its author's business.
    """
    faults = [*find_markers(text), *parse(text).faults]
    known: Counter[str] = Counter()
    for side in sides if faults else ():
        known |= Counter(fault.reason for fault in (*find_markers(side), *parse(side).faults))
    seen: Counter[str] = Counter()
    for reason, line, _ in faults:
        seen[reason] += 1
        if seen[reason] > known[reason]:
            return f"{reason} (line {line})"
    return ""
