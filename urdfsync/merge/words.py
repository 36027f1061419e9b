"""Contradictions in words."""

from __future__ import annotations

from urdfsync.merge.elements import Contradiction

_LONGEST = 60
"""Characters of a text that a sentence quotes."""
_SILENT = frozenset({"body", "arguments", "annotation", "value", "expression", "constraint"})
"""Parts that need no name, since what is in them has one."""
_ROLES = {
    "connect": "equation",
    "description": "description",
    "head": "kind and name",
    "name": "name",
    "prefixes": "prefixes",
    "sizes": "size",
    "type": "type",
}
"""Parts of an element in words."""


def describe(found: Contradiction) -> str:
    """Say what the sides disagree about: component `body`: you set `m = 99`, the export changes 11.5 to 12.1."""
    if not found.path:
        return ""
    names = [key for key in found.path if key not in _SILENT and key not in _ROLES]
    kind, _, name = names[0].partition(" ") if names else ("class", "", "")
    place = f"{kind} `{name}`" if name else f"the {kind}"
    inner, role = ".".join(names[1:]), _ROLES.get(found.path[-1], "")
    what = f"the {role} of `{inner}`" if role and inner else f"the {role}" if role else f"`{inner}`" if inner else "it"
    base, mine, generated = map(_quoted, (found.base, found.mine, found.generated))
    if not found.mine:
        told = f"you removed {what}, the export changes it"
    elif not found.generated:
        told = f"you changed {what}, the export removes it"
    elif not found.base:
        told = f"you added `{mine}`, the export `{generated}`"
    elif inner and not role:
        told = f"you set `{inner} = {mine}`, the export changes {base} to {generated}"
    else:
        told = f"you changed {what} to `{mine}`, the export to `{generated}`"
    return f"{place}: {told}"


def _quoted(text: str) -> str:
    said = " ".join(text.split())
    return said if len(said) <= _LONGEST else f"{said[: _LONGEST - 1]}…"
