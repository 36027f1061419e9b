"""The recorded model of one robot, text ↔ value.

`<robot>.json` beside the manifest, committed with it: the snapshot and what imports found out, so that everything can
be rendered again. What is recorded of a robot otherwise is in the manifest.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from urdfsync import tomlfile
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Import, Snapshot
from urdfsync.state.manifest import FORMAT, REPAIR, check_format


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
    gone: list[str] | msgspec.UnsetType = msgspec.UNSET
    """What the package lost since then, by dotted names below it, if anything: no merge may mention it."""
    left: dict[str, str] | msgspec.UnsetType = msgspec.UNSET
    """Files that renamed elements left since then, if any, with their files now: the old ones wait to be deleted."""
    format: int = FORMAT


def of(
    snapshot: Snapshot,
    imports: Mapping[str, Import],
    bases: Mapping[str, str] | None = None,
    since: Snapshot | None = None,
    since_revision: int | msgspec.UnsetType = msgspec.UNSET,
    gone: Iterable[str] = (),
    left: Mapping[str, str] = {},
) -> Model:
    """What is recorded of a model, as it comes back from the JSON file; both snapshots are plain data already."""
    facts = {}
    for key, imported in sorted(imports.items()):
        plain = msgspec.json.decode(msgspec.json.encode(imported.facts, order="sorted"))
        facts[key] = ConversionFacts(imported.source_hash, imported.converter, plain)
    texts = dict(sorted((bases or {}).items()))
    complete = None if since is None else dict(since)
    unset = msgspec.UNSET
    return Model(dict(snapshot), facts, texts, complete, since_revision, sorted(gone) or unset, dict(left) or unset)


def dumps(model: Model) -> str:
    """The JSON file's text."""
    return msgspec.json.format(msgspec.json.encode(model, order="sorted"), indent=1).decode() + "\n"


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
