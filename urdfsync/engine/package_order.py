"""`package.order` files: urdfsync owns the lines of its own classes, the user all others."""

from __future__ import annotations

from collections.abc import Collection, Sequence, Set


def merge(text: str | None, names: Sequence[str], owned: Collection[str] = ()) -> str:
    """The file's text with `names` in it, and without the other names of `owned`; None stands for no file.

    `owned` are the names that urdfsync wrote last, in their order. The user's lines keep their places.
    Our lines follow the order of `names`, unless the user has moved them; a new one goes next to its
    neighbour in `names`. Line endings are those of the file. The result is empty if no line is left.
    """
    if text is None:
        return "".join(f"{name}\n" for name in names)
    wanted, found = set(names), text.splitlines()
    if found == list(names) and len(wanted) == len(found):
        return text
    lines = _without(found, wanted | set(owned), wanted)
    present = [_name(line) for line in lines if _name(line) in wanted]
    kept = set(present)
    ordered = [name for name in names if name in kept]
    if present != ordered and present == [name for name in owned if name in kept]:
        ours = iter(ordered)
        lines = [next(ours) if _name(line) in kept else line for line in lines]
    for index, name in enumerate(names):
        if name not in kept:
            lines.insert(_place(lines, names, index), name)
    if lines == found:
        return text
    ending = "\r\n" if "\r\n" in text else "\n"
    return ending.join(lines) + ending if any(map(_name, lines)) else ""


def _name(line: str) -> str:
    return line.strip("\ufeff \t\r\f\v")


def _without(lines: Sequence[str], ours: Set[str], wanted: Set[str]) -> list[str]:
    """The lines without our names that are not wanted, or that are there twice."""
    kept, seen = [], set()
    for line in lines:
        name = _name(line)
        if name in ours and (name in seen or name not in wanted):
            continue
        seen.add(name)
        kept.append(line)
    return kept


def _place(lines: Sequence[str], names: Sequence[str], index: int) -> int:
    """Where a name belongs: after the nearest one before it, else before the nearest one after it, else last."""
    positions = {_name(line): position for position, line in enumerate(lines)}
    for name in reversed(names[:index]):
        if name in positions:
            return positions[name] + 1
    for name in names[index + 1 :]:
        if name in positions:
            return positions[name]
    used = [position for position, line in enumerate(lines) if _name(line)]
    return used[-1] + 1 if used else 0
