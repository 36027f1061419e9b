"""The recorded model of one robot, text ↔ value.

`<robot>.json` beside the manifest, committed with it: the snapshot and what imports found out, so that everything can
be rendered again. What is recorded of a robot otherwise is in the manifest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from urdfsync import tomlfile
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Import, Snapshot
from urdfsync.manifest import FORMAT, REPAIR, check_format


class ConversionFacts(msgspec.Struct, frozen=True):
    """What a conversion found out, and of which bytes."""

    source_hash: str
    converter: int | None
    facts: dict[str, Any]


class _Formatted(msgspec.Struct):
    """A JSON file of any format, as far as that is needed to know which one it is."""

    format: int = FORMAT


class Model(msgspec.Struct, frozen=True):
    """The JSON file: the model, the facts of every import, and the base of files that wait or conflict.

    Other bases follow from the model: what it would be rendered to is what was written. `bases` are texts by path
    below the package's folder.
    """

    snapshot: dict[str, Any]
    imports: dict[str, ConversionFacts]
    bases: dict[str, str] = {}
    since: dict[str, Any] | None = None
    """The model of the last build after which nothing waited; None if nothing waits now."""
    since_revision: int | msgspec.UnsetType = msgspec.UNSET
    """The domain's revision in that build, if it is another one now."""
    format: int = FORMAT


def of(
    snapshot: Snapshot,
    imports: Mapping[str, Import],
    bases: Mapping[str, str] | None = None,
    since: Snapshot | None = None,
    since_revision: int | msgspec.UnsetType = msgspec.UNSET,
) -> Model:
    """What is recorded of a model, as it comes back from the JSON file; both snapshots are plain data already."""
    facts = {key: ConversionFacts(i.source_hash, i.converter, _plain(i.facts)) for key, i in sorted(imports.items())}
    texts = dict(sorted((bases or {}).items()))
    return Model(dict(snapshot), facts, texts, None if since is None else dict(since), since_revision)


class Elements:
    """The text of each element of the last model, with the element: what is the same object serves again."""

    def __init__(self) -> None:
        self._parts: dict[str, dict[str, tuple[object, str]]] = {}

    def text(self, part: str, elements: Any) -> str:
        """The text of a part of a snapshot, which is a mapping of elements or something else."""
        if not isinstance(elements, Mapping):
            return _entry(part, elements, 2)
        known = self._parts.get(part, {})
        found = {
            name: last if (last := known.get(name)) and last[0] is element else (element, _entry(name, element, 3))
            for name, element in sorted(elements.items())
        }
        self._parts[part] = found
        return _entry(part, {}, 2).removesuffix("{}") + _braced([text for _, text in found.values()], 2)


def dumps(model: Model, elements: Elements | None = None) -> str:
    """The JSON file's text; `elements` are those of a model that was written before, which spares most of the work."""
    if elements is None:
        return _json(model) + "\n"
    parts = [elements.text(part, value) for part, value in sorted(model.snapshot.items())]
    rest = _json(msgspec.structs.replace(model, snapshot={}))  # which comes last
    return rest.removesuffix("{}\n}") + _braced(parts, 1) + "\n}\n"


def _json(value: object) -> str:
    return msgspec.json.format(msgspec.json.encode(value, order="sorted"), indent=1).decode()


def _entry(name: str, value: object, depth: int) -> str:
    """An entry of an object at this depth, with its indentation."""
    indent = depth * " "
    return indent + f"{_json(name)}: {_json(value)}".replace("\n", f"\n{indent}")


def _braced(entries: Sequence[str], depth: int) -> str:
    """An object of these entries, which is an entry itself."""
    return "{\n" + ",\n".join(entries) + f"\n{depth * ' '}}}" if entries else "{}"


def loads(text: str, file: str) -> Model:
    """The model in the JSON file's text. Raises StateError if it is none, or a newer urdfsync wrote it."""
    try:
        check_format(msgspec.json.decode(text, type=_Formatted).format, file)
        model = msgspec.json.decode(text, type=Model)
    except (msgspec.DecodeError, RecursionError) as error:
        line = tomlfile.marker_line(text)
        message = "unresolved merge markers" if line else f"this is no state of urdfsync: {error}"
        raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=REPAIR)) from None
    return model


def _plain(facts: Mapping[str, Any]) -> dict[str, Any]:
    data: dict[str, Any] = msgspec.json.decode(msgspec.json.encode(facts, order="sorted"))
    return data
