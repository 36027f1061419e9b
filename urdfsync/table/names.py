"""The Modelica identifiers of elements and columns."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator

from urdfsync.modelica.names import DEVICES, FUNCTIONS, GENERATED_CLASSES, KEYWORDS, RESERVED_CLASSES, in_ascii

_RESERVED = KEYWORDS | {name.lower() for name in FUNCTIONS} | RESERVED_CLASSES | DEVICES | GENERATED_CLASSES
_LONGEST = 100


def component_name(key: str, noun: str = "element") -> str:
    """Return the identifier of a component: the letters and digits of its key, with a small first letter."""
    stem = re.sub(r"[^A-Za-z0-9]+", "_", in_ascii(key)).strip("_")
    if not stem[:1].isalpha():
        stem = f"{noun}_{stem}".rstrip("_")
    return stem[0].lower() + stem[1:]


def column_name(column: str) -> str:
    """Return the identifier of a column, as of a component; a reserved word of Modelica gets a final `_`."""
    name = component_name(column, "column")
    return f"{name}_" if name in KEYWORDS else name


def find_clashes(keys: Iterable[str], noun: str = "element") -> Iterator[tuple[str, str]]:
    """Yield each key that can't become a name in Modelica, with the reason."""
    by_name = defaultdict[str, list[str]](list)
    for key in keys:
        by_name[component_name(key, noun).lower()].append(key)
    for name, found in by_name.items():
        if len(name) > _LONGEST:
            yield found[0], f"its name in Modelica has more than {_LONGEST} letters"
        elif name in _RESERVED:
            yield found[0], f"`{component_name(found[0], noun)}` has a meaning in Modelica"
        for key in found[1:]:
            yield key, f"in Modelica it has the same name as `{found[0]}`"
