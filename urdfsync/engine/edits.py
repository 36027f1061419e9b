"""The files of a package that the user has edited, with what urdfsync wrote last; and the numbers of his own files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.decide import decide_package
from urdfsync.engine.generation import Generation
from urdfsync.merge.elements import ROUNDING
from urdfsync.modelica.lexer import is_name, lex


class EditedFile(msgspec.Struct, frozen=True):
    """A text file that is not as it was written."""

    path: str
    """Where it is: a path from the configuration's folder, POSIX."""
    owner: str
    """Element that it belongs to, in the domain's words."""
    base: str | None
    """The generated text that it last took into account; None if that is lost, or if urdfsync never wrote it."""
    mine: str


class OtherNumber(msgspec.Struct, frozen=True):
    """A number in a text that the model does not have."""

    name: str
    """What it is given to; of `limit(upper = 3)` the last word."""
    value: str
    line: int


def find_edited(generation: Generation) -> Iterator[EditedFile]:
    """Yield the edited files of a robot, in the order of their paths. Raises UrdfsyncError."""
    files = generation.inputs.files
    for action in decide_package(generation).actions:
        key = action.origin or action.path
        is_text = action.role not in (Role.IMPORT, Role.ORDER) and action.reason is not Reason.MOVED_AWAY
        if is_text and action.mine not in (None, action.base, action.generated):
            base = generation.inputs.base(action.base) if action.base else None
            if action.base == action.generated:  # it need not be stored yet, as before a package is adopted
                base = generation.content(action.path).decode()
            yield EditedFile(key, action.owner, base, files.any_text(key))


def find_other_numbers(text: str, element: object) -> list[OtherNumber]:
    """Return the numbers in a text that an element of a snapshot has not, signs and rounding apart.

    Zero and one stand for much that a source leaves out, and numbers in annotations for pictures: these are not told.
    """
    known, found = [*_numbers(element), 0.0, 1.0], list[OtherNumber]()
    name, in_annotation, depth = "", False, 0
    for token in lex(text)[0]:
        if token.text == "annotation":
            in_annotation, depth = True, 0
        elif in_annotation:
            depth += {"(": 1, ")": -1}.get(token.text, 0)
            in_annotation = depth > 0
        elif is_name(token.text):
            name = token.text
        elif token.text[:1].isdigit() and not any(
            math.isclose(float(token.text), one, rel_tol=ROUNDING) for one in known
        ):
            found.append(OtherNumber(name, token.text, token.line))
    return list(dict.fromkeys(found))


def _numbers(value: object) -> Iterator[float]:
    if isinstance(value, Mapping):
        value = [*value.values()]
    if isinstance(value, Sequence) and not isinstance(value, str):
        for one in value:
            yield from _numbers(one)
    elif isinstance(value, float | int):
        yield abs(value)
