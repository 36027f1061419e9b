"""Where the record of a link or joint and the record of the whole robot say different things.

Every number of an element is written twice: in its own record, and in the component of the whole-robot record that has
the element's name. Shapes are in the link's record only.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.domain import Echo, Spot, Target
from urdfsync.urdf.modifiers import Clause, Value, clauses

_FOLDERS = ("Links/", "Joints/")
_SUFFIX = "Parameters.mo"


def echoes(records: Mapping[str, str], target: Target) -> Iterator[Echo]:
    """The differences, by the path of the element's record; `records` has the texts by path below the package."""
    whole = f"{target.name}{_SUFFIX}"
    if whole not in records:
        return
    components = {clause.name: clause for clause in clauses(records[whole])}
    for path, text in sorted(records.items()):
        component = components.get(_component(path)) if path.startswith(_FOLDERS) else None
        own = next((clause for clause in clauses(text) if not clause.name), None) if component else None
        if component and own:
            yield from _compare(path, own, whole, component)


def _component(path: str) -> str:
    """What the whole-robot record calls the element whose record this is."""
    name = path.rpartition("/")[2].removesuffix(_SUFFIX)
    return name[:1].lower() + name[1:]


def _compare(path: str, own: Clause, whole: str, component: Clause) -> Iterator[Echo]:
    for name in dict.fromkeys([*own.values, *component.values]):
        one, other = own.values.get(name), component.values.get(name)
        if _is_inside(name, component if other is None else own if one is None else None):
            continue
        for at, mine, theirs in _differences(name, one, other):
            yield Echo(
                Spot(path, mine.line if mine else own.line, at, mine.text if mine else None),
                Spot(
                    whole,
                    theirs.line if theirs else component.line,
                    f"{component.name}.{at}",
                    theirs.text if theirs else None,
                ),
            )


def _is_inside(name: str, clause: Clause | None) -> bool:
    """Whether the clause gives as one expression what the name is a part of, or has parts of it: who knows, then."""
    if clause is None:
        return False
    parts = name.split(".") if name else []
    above = {".".join(parts[:count]) for count in range(len(parts))}
    return not above.isdisjoint(clause.values) or any(not name or n.startswith(f"{name}.") for n in clause.values)


def _differences(name: str, one: Value | None, other: Value | None) -> Iterator[tuple[str, Value | None, Value | None]]:
    """Where two values differ; arrays of one length are compared element by element, counted from 1."""
    if one and other and one.items and other.items and len(one.items) == len(other.items):
        for index, (mine, theirs) in enumerate(zip(one.items, other.items, strict=True), 1):
            yield from _differences(f"{name}[{index}]", mine, theirs)
    elif one is None or other is None or one.key != other.key:
        yield name, one, other
