"""Contradictions in words."""

from __future__ import annotations

from urdfsync.merge.elements import Contradiction

_LONGEST = 60
"""Characters of a text that a sentence quotes."""
_SILENT = frozenset(
    "body arguments annotation value expression head definition equation connect import components".split()
)
"""Roles that need no name, since what is in them has one."""


def describe(found: Contradiction) -> str:
    """Say what the sides disagree about: component `body`: you set `m = 99`, the export changes 11.5 to 12.1."""
    if not found.path:
        return ""
    names = [key for key in found.path if key not in _SILENT]
    kind, _, name = names[0].partition(" ") if names else ("", "", "")
    place = f"{kind} `{_quoted(name)}`" if name else kind or "the class"
    inner = ".".join(names[1:])
    base, mine, generated = map(_quoted, (found.base, found.mine, found.generated))
    setting = f"{inner} = " if inner and found.path[-1] == "expression" else f"{inner} " if inner else ""
    if not found.mine:
        told = f"you removed {inner or 'it'}, the export changes it"
    elif not found.generated:
        told = f"you changed {inner or 'it'}, the export removes it"
    elif not found.base:
        if names[-1:] == [found.path[-1]]:  # the texts begin with its name
            setting = "".join(f"{name}." for name in names[1:-1])
        else:
            setting = f"{inner} " if inner else ""
        told = f"you added `{setting}{mine}`, the export `{setting}{generated}`"
    else:
        told = f"you set `{setting}{mine}`, the export changes {base} to {generated}"
    return f"{place}: {told}"


def _quoted(text: str) -> str:
    said = " ".join(text.split())
    return said if len(said) <= _LONGEST else f"{said[: _LONGEST - 1]}…"
