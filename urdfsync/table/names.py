"""The Modelica identifiers of elements and columns; `docs/tables.md` states the rule for users."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from urdfsync.domain import Target
from urdfsync.modelica.identifiers import hashed, is_free, stem, tell_apart
from urdfsync.modelica.names import KEYWORDS


def component_names(keys: Iterable[str], target: Target) -> Mapping[str, str]:
    """Return the components of elements by their keys; no class of an element hides a package or the whole's model."""
    spelled = {("element", key): stem(key, "element") for key in keys}
    spelled = {key: name if is_free(name) else hashed(key[1], "element") for key, name in spelled.items()}
    taken = target.package.partition(".")[0], target.name, "Models", "Records"
    return {key: name for (_, key), name in tell_apart(spelled, taken).items()}


def column_name(column: str) -> str:
    """Return the parameter of a column in records; a word that a parameter can't have gets a final `_`."""
    name = stem(column, "column")
    return f"{name}_" if name in KEYWORDS or name == "time" else name
