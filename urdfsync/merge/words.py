"""Describes elements of a class, and contradictions, in words."""

from __future__ import annotations

import re

from urdfsync.common.spelling import same_count
from urdfsync.merge.lines import Contradiction
from urdfsync.modelica.tree import INITIAL

_LONGEST = 60
"""The greatest number of characters of a text that a sentence quotes."""
_BLANK = re.compile(r'("(?:[^"\\]|\\.)*+(?:"|\\?\Z))| (?=[,)\]])|(?<=[(\[]) |(?<=\w) (?=[(\[])', re.DOTALL)
"""A blank between the words of a key that no user writes; a string stays."""
_SILENT = frozenset("body value expression definition import components".split())
"""Parts that sentences do not name, since they contain elements with names."""
_ROLES = {
    "annotation": "annotation",
    "arguments": "modifiers",
    "constraint": "constraint",
    "connect": "equation",
    "equation": "equation",
    "description": "description",
    "head": "kind and name",
    "name": "name",
    "order": "order of inputs and outputs",
    "prefixes": "prefixes",
    "sizes": "size",
    "type": "type",
}


def place_of(path: tuple[str, ...]) -> tuple[str, str]:
    """Return the element at a path of keys, and the part of this element: ("component `body`", "m")."""
    names = [key for key in path if key not in _SILENT and key not in _ROLES]
    key = names[0] if names else "class"
    kind, _, name = key.removeprefix(INITIAL).partition(" ")
    name = _BLANK.sub(r"\1", name)
    role = _ROLES.get(path[-1], "") if path else ""
    if path[-1:] == ("expression",) and len(names) == 1:
        names.append(name)  # the value of a declaration
    if kind == "statements":
        return f"statements {name}", ""
    if kind == "connect":
        kind, name = "", f"connect({name.replace(' ', ', ')})"
    kind = f"initial {kind}" if key.startswith(INITIAL) else kind
    return f"{kind} `{quoted(name)}`".lstrip() if name else f"the {kind}", " ".join(
        filter(None, (".".join(names[1:]), role))
    )


def describe(contradiction: Contradiction) -> str:
    """Describe a contradiction: component `body`: you set `m = 99`, the export changes 11.5 to 12.1."""
    if not contradiction.path:
        return ""
    element, part = place_of(contradiction.path)
    is_value = part and contradiction.path[-1] not in _ROLES
    what = f"`{part}`" if is_value else f"the {part}" if part else "it"
    mine = quoted_pair(contradiction.base, contradiction.mine)[1]
    base, generated = quoted_pair(contradiction.base, contradiction.generated)
    if mine == generated:  # they differ behind their difference from base
        mine, generated = quoted_pair(contradiction.mine, contradiction.generated)
    if not contradiction.mine:
        told = f"you removed {what}, the export {_change(contradiction.base, contradiction.generated, what)}"
    elif not contradiction.generated:
        kind = "" if part else element.rpartition(" `")[0]
        removed = f"the {kind}" if kind else "it"
        told = f"you {_change(contradiction.base, contradiction.mine, what)}, the export removes {removed}"
    elif not contradiction.base:
        is_named = part.endswith(contradiction.path[-1])  # true if the texts begin with the name
        lead = part.removesuffix(contradiction.path[-1]) if is_named else f"{part} " if part else ""
        told = f"you added `{lead}{mine}`, the export `{lead}{generated}`"
    elif is_value:
        told = f"you set `{part} = {mine}`, the export changes {base} to {generated}"
    else:
        yours, theirs = (
            _change(contradiction.base, contradiction.mine, what),
            _change(contradiction.base, contradiction.generated, what),
        )
        if yours == theirs:
            yours, theirs = (f"changed {what} to `{side}`" for side in (mine, generated))
        shared = f"changed {what} "
        is_alike = yours.startswith(shared) and theirs.startswith(shared)
        told = f"you {yours}, the export {theirs.removeprefix(shared if is_alike else '')}"
    is_base = element.startswith("extends ") and is_value  # for a base class, the value's name is enough
    return told if is_base else f"{element}: {told}"


def _change(base: str, side: str, what: str) -> str:
    """Describe a side's change of a text of several lines: added `y = 3;`, removed some, or changed them."""
    old, new = ([line.strip() for line in text.splitlines() if line.strip()] for text in (base, side))
    if old == new:
        return f"changed {what}"
    start = same_count(old, new)
    end = same_count(old[start:][::-1], new[start:][::-1])
    before, after = quoted_pair(*(" ".join(lines[start : len(lines) - end]) for lines in (old, new)))
    if not start + end or "order" in what:
        return f"changed {what} to `{after}`"
    if before and after:
        return f"changed `{before}` to `{after}`"
    return f"added `{after}`" if after else f"removed `{before}`"


def quoted_pair(old: str, new: str) -> list[str]:
    """Return two texts as quotes that show their first difference."""
    lines = [" ".join(text.split()) for text in (old, new)]
    shared = same_count(lines[0], lines[1])
    start = shared - _LONGEST // 4 if max(map(len, lines)) > _LONGEST and shared > _LONGEST // 2 else 0
    return [quoted(f"…{text[start:]}" if start else text) for text in lines]


def quoted(text: str) -> str:
    """Return a text as a quote in one line."""
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 1]}…"
