"""Lists the edited values of records, and the edits that no source can state."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from urdfsync.analysis.patches.literals import NUMBER
from urdfsync.analysis.patches.sources import Key
from urdfsync.engine.edits import EditedFile
from urdfsync.merge.edits import Edit, in_words
from urdfsync.modelica.values import literals, read_values, without_comments

_NO_NUMBER = "only numbers of records go into a patch"
_NAMED = re.compile(r"`(.+)`")


class EditedValue(NamedTuple):
    """The edit of one value in a record: a number, or an array of numbers."""

    key: Key
    old: tuple[float, ...]
    """The numbers in the base; empty if the base leaves the value out."""
    new: tuple[float, ...]
    words: tuple[str, ...]
    """The new numbers as the user wrote them."""
    told: str
    """The edit in words."""
    is_in_conflict: bool
    """Whether the record is in conflict."""

    @property
    def changed(self) -> list[int]:
        """The places of the changed numbers; all places of a value that the base leaves out."""
        return [k for k, new in enumerate(self.new) if not self.old or self.old[k] != new]


class Staying(NamedTuple):
    """An edit that the patch leaves out."""

    file: str
    """The path of the edited file from the configuration's folder."""
    edit: str
    """The edit in words; empty for the whole file."""
    reason: str

    @property
    def told(self) -> str:
        """The edit with its reason, without the file."""
        return f"{self.edit}{': ' * bool(self.edit)}stays, since {self.reason}"


def edited_values(file: EditedFile, path: str) -> Iterator[EditedValue | Staying]:
    """Yield the edits of a record's values; `path` is the record's path below the package's folder."""
    if file.base is None:
        return
    base = {value.path: value.text for value in read_values(file.base)}
    for value in read_values(file.mine):
        before = base.get(value.path, "")
        old, new, words = literals(before), literals(value.text), NUMBER.findall(without_comments(value.text))
        is_same = value.text == before or (old == new and old is not None)
        if is_same or isinstance(new, str) or isinstance(old, str):
            continue
        told = f"{value.path} {before or '(none)'} → {value.text}"
        if new is None or tuple(map(float, words)) != new:
            yield Staying(file.path, told, "it is no plain decimal number")
        elif old and len(old) != len(new):
            yield Staying(file.path, told, "it has another count of numbers")
        else:
            yield EditedValue((path, value.path), old or (), new, tuple(words), told, file.is_in_conflict)


def other_edits(file: EditedFile, values: Sequence[str]) -> Iterator[Staying]:
    """Yield the edits of a file that are none of the edited `values`."""
    if file.base is None:
        yield Staying(file.path, "", "its base is lost")
    elif (edits := file.edits) is None:
        yield Staying(file.path, "", "it is no single class without errors")
    elif not edits:
        yield Staying(file.path, "", "only blanks, the order of things or the spelling of numbers differ")
    else:
        others = [edit for edit in edits if not _is_of(edit, values)]
        for element, told in in_words(others):
            yield Staying(file.path, f"{element}: {told}", _NO_NUMBER)


def _is_of(edit: Edit, values: Sequence[str]) -> bool:
    """Whether an edit is one of a record's `values`, or adds the part around one."""
    name, first = _NAMED.search(edit.element), edit.part.partition(" ")[0]
    places = [first, *([f"{name[1]}.{first}".rstrip(".")] if name else [])]
    beginnings = tuple(f"{place}." for place in places) if edit.base is None else ()
    return any(value in places or value.startswith(beginnings) for value in values)
