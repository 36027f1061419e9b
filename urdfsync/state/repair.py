"""What can be saved of a robot's state in which version control left its merge markers: text → values.

Two branches that both built a robot leave two states in one file, and each file of the package may have come from
either of them, or be merged from both. So no side is right as a whole: every hash that a side recorded is a
candidate for the base of its file, and what is on disk decides between them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TypeVar

import msgspec

from urdfsync.diagnostics import StateError
from urdfsync.domain import Role
from urdfsync.files import text_digest
from urdfsync.state import manifest, modelfile
from urdfsync.state.manifest import DependencyRecord, Manifest
from urdfsync.state.modelfile import ConversionFacts, Model
from urdfsync.state.record import FileRecord

# patterns that hardly any build needs are compiled where they are used, by the cache of `re`
_MARKER = r"([<|=>])\1{6,}(?:[ \t].*)?\r?\n?"
_FORMAT = r'(?m)^ ?"?format"?[ \t]*[=:][ \t]*(\d{1,9}),?[ \t]*\r?$'
_BASE = r'(?m)^base = "([^"\\]+)"[ \t]*\r?$'
_IMPORTED = r'(?m)^target_hash = "([^"\\]+)"[ \t]*\r?$'

_Parsed = TypeVar("_Parsed")


class RecoveredState(msgspec.Struct, frozen=True):
    """All that is known from both sides of a state, the own side first."""

    manifests: tuple[Manifest, ...]
    """The sides of the TOML file that are manifests."""
    models: Mapping[str, Model]
    """The sides of the JSON file that are models, by the hashes of their texts."""
    written: frozenset[str]
    """The hashes of all texts that urdfsync wrote last to any file, on any side or before the branches parted.

    A merge by lines may leave a hash below the path of a neighbour that only one side has. A text says which class
    it is, and so can't be that of another file; but imported bytes can, and are not in here.
    """

    @property
    def roles(self) -> Mapping[str, Role]:
        """All files of which any side knows, with what they are."""
        return {path: record.role for side in reversed(self.manifests) for path, record in side.files.items()}

    def model(self, rebuilt: Manifest) -> Model | None:
        """The model that belongs to a rebuilt manifest; None if no side is a model.

        Facts of imports and texts of bases come from all sides: those that the manifest records by their hashes. What
        the package lost on either side is gone.
        """
        first = self.models.get(rebuilt.source.snapshot) or next(iter(self.models.values()), None)
        if first is None:
            return None
        imports: dict[str, ConversionFacts] = {}
        bases: dict[str, str] = {}
        for side in self.models.values():
            for key, facts in side.imports.items():
                record = rebuilt.dependencies.get(key)
                if record and (facts.source_hash, facts.converter) == (record.source_hash, record.converter):
                    imports.setdefault(key, facts)
            for path, text in side.bases.items():
                file = rebuilt.files.get(f"{rebuilt.folder}/{path}")
                if file and file.base == text_digest(text.encode()):
                    bases.setdefault(path, text)
        gone = sorted({name for side in self.models.values() for name in side.gone or ()})
        return msgspec.structs.replace(first, imports=imports, bases=bases, gone=gone or msgspec.UNSET)


def recover(toml: str | None, json: str | None, file: str, beside: str) -> RecoveredState:
    """What can be told from a robot's two files, which errors call `file` and `beside`; None for one that is lost.

    Raises StateError if a newer urdfsync wrote any side: it knows better what to do. A side that is no manifest, or
    names files outside of its package, or is no model, is left out.
    """
    for text, name in ((toml, file), (json, beside)):
        for match in re.finditer(_FORMAT, text or ""):  # a side of a newer urdfsync may be no manifest for this one
            if int(match[1]) > manifest.FORMAT:
                raise manifest.newer_state(int(match[1]), name, match.string.count("\n", 0, match.start()) + 1)
    tables = (re.split(r"(?m)^(?=\[)", side) for side in sides(toml or ""))
    # a merge by lines may have put in a table twice: the last one counts
    once = ("\n".join({table.partition("\n")[0]: table for table in side}.values()) for side in tables)
    manifests = (_parse(manifest.loads, side, file) for side in once)
    models = ((text_digest(side.encode()), _parse(modelfile.loads, side, beside)) for side in sides(json or ""))
    return RecoveredState(
        tuple(side for side in manifests if side is not None),
        {key: model for key, model in models if model is not None},
        frozenset(re.findall(_BASE, toml or "")) - frozenset(re.findall(_IMPORTED, toml or "")),
    )


def sides(text: str) -> tuple[str, ...]:
    """The versions of a text with merge markers: ours first, then theirs; one if they are equal.

    What the common ancestor had (between `|||||||` and `=======`) is in none.
    """
    from urdfsync.merge import split_lines

    ours: list[str] = []
    theirs: list[str] = []
    targets = {"<": (ours,), "|": (), "=": (theirs,), ">": (ours, theirs)}
    into: tuple[list[str], ...] = (ours, theirs)
    for line in split_lines(text):
        if marker := re.fullmatch(_MARKER, line):
            into = targets[marker[1]]
        else:
            for side in into:
                side.append(line)
    return tuple(dict.fromkeys(("".join(ours), "".join(theirs))))


def _parse(parse: Callable[[str, str], _Parsed], text: str, file: str) -> _Parsed | None:
    try:
        return parse(text, file)
    except StateError as error:
        if any(found.code == "newer-state" for found in error.diagnostics):
            raise
        return None


def rebuilt(recovered: RecoveredState, mine: Mapping[str, str | None], generated: Mapping[str, str]) -> Manifest | None:
    """One manifest of all sides, given the hashes of what is on disk and of what is generated, by path.

    `mine` should have what is there in the place of all `RecoveredState.roles` and of everything that is generated.
    The heading is that of the newest generator, or else the first. Everything that any side lists remains: files,
    names in `package.order` files, dependencies. None if no side is a manifest: then the state is lost, and files
    that are not as they would be generated conflict.
    """
    manifests = recovered.manifests
    if not manifests:
        return None
    lost = {path for path in generated if mine.get(path) in recovered.written}
    domain = manifests[0].generator.domain
    orders: dict[str, tuple[str, ...]] = {}
    dependencies: dict[str, DependencyRecord] = {}
    for side in manifests:
        for path, names in side.orders.items():
            orders[path] = tuple(dict.fromkeys([*orders.get(path, ()), *names]))
        for key, record in side.dependencies.items():
            copy = mine.get(f"{side.folder}/{record.target}")
            if key not in dependencies or (copy is not None and copy == record.target_hash):  # the copy on disk counts
                dependencies[key] = record
    files: dict[str, FileRecord] = {}
    for path in sorted(recovered.roles.keys() | lost):
        records = [side.files[path] for side in manifests if path in side.files] or [FileRecord("", Role.MODEL)]
        bases = [one.base for one in records if one.base is not None]
        base = mine.get(path)
        if base is None or (base not in recovered.written and base not in bases):
            # Somebody edited it. Its base is a hash that is not that of what is generated: then the three-way merge
            # judges. With the generated one, the file would be kept in silence, although the merge of the branches may
            # have lost what the other branch's build brought in. Without any, it conflicts.
            base = next((one for one in bases if one != generated.get(path)), bases[0] if bases else None)
        # else nobody edited it since: a text that urdfsync wrote is its own base, even if its hash got below another
        # path in the merge. A file is never taken for untouched unless its hash is recorded.
        recorded = next((one for one in records if one.base == base), records[0])
        files[path] = msgspec.structs.replace(recorded, base=base)
    heading = max(manifests, key=lambda side: (side.generator.domain == domain, side.generator.revision))
    return msgspec.structs.replace(heading, files=files, orders=orders, dependencies=dependencies)
