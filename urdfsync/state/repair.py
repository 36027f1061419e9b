"""What can be saved of a robot's state in which version control left its merge markers: text → values.

Two branches that both built a robot leave two states in one file, and each file of the package may have come from
either of them, or be merged from both. So no side is right as a whole: every hash that a side recorded is a
candidate for the base of its file, and what is on disk decides between them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Role
from urdfsync.merge import split_lines
from urdfsync.state import manifest, modelfile
from urdfsync.state.manifest import FORMAT, DependencyRecord, Manifest
from urdfsync.state.modelfile import ConversionFacts, Model
from urdfsync.state.record import FileRecord

_DEEPEST = 3
"""Conflicts within each other whose sides are told apart; a branch with unsettled markers was merged again."""

_MARKER = re.compile(r"(<{7,}|\|{7,}|={7,}|>{7,})(?:[ \t].*)?\r?\n?")
_TOML_FORMAT = re.compile(r"^format[ \t]*=[ \t]*(\d{1,9})[ \t]*\r?$", re.MULTILINE)
_BASE = re.compile(r'^base = "([^"\\]+)"[ \t]*\r?$', re.MULTILINE)
_IMPORTED = re.compile(r'^target_hash = "([^"\\]+)"[ \t]*\r?$', re.MULTILINE)
_JSON_FORMAT = re.compile(r'^ "format": (\d{1,9}),?\r?$', re.MULTILINE)

_Parsed = TypeVar("_Parsed")


class Recovered(msgspec.Struct, frozen=True):
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

    def bases(self, path: str) -> tuple[str, ...]:
        """The hashes of all that urdfsync wrote last to a file, each once."""
        records = (side.files[path] for side in self.manifests if path in side.files)
        return tuple(dict.fromkeys(record.base for record in records if record.base is not None))

    def model(self, rebuilt: Manifest) -> Model | None:
        """The model that belongs to a rebuilt manifest; None if no side is a model.

        Facts of imports and texts of bases come from all sides: those that the manifest records by their hashes.
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
                if file and file.base == manifest.text_hash(text):
                    bases.setdefault(path, text)
        return msgspec.structs.replace(first, imports=imports, bases=bases)


def sides(text: str) -> tuple[str, ...]:
    """The versions of a text with merge markers: what is ours first, what is theirs last, each once.

    What the common ancestor had (between `|||||||` and `=======`) is in none. A marker that has no counterpart is
    left out, and what is between it and the end of the text counts as the side that it would be. A text without
    markers is its only version.
    """
    region, depth = _regions(text)
    choices = product((0, 1), repeat=min(depth, _DEEPEST))
    return tuple(dict.fromkeys("".join(_taken(region, choice)) for choice in choices))


class _Region(NamedTuple):
    """A conflict: its versions are lines and conflicts within them."""

    size: int
    """How many characters its markers have: those in an ancestor have more."""
    versions: tuple[list[str | _Region], list[str | _Region], list[str | _Region]]
    """Ours, theirs, and the ancestor's."""


_OURS, _THEIRS, _ANCESTOR = range(3)


def _regions(text: str) -> tuple[_Region, int]:
    """The text as if it were our version of a conflict without markers, and how deep conflicts are nested."""
    whole = _Region(0, ([], [], []))
    stack, deepest = [(whole, _OURS)], 0
    for line in split_lines(text):
        region, version = stack[-1]
        marker = _MARKER.fullmatch(line)
        if marker is None:
            region.versions[version].append(line)
        elif marker[1][0] == "<":
            inner = _Region(len(marker[1]), ([], [], []))
            region.versions[version].append(inner)
            stack.append((inner, _OURS))
            deepest = max(deepest, len(stack) - 1)
        elif len(marker[1]) == region.size:
            stack.pop()
            if marker[1][0] != ">":
                stack.append((region, _ANCESTOR if marker[1][0] == "|" else _THEIRS))
    return whole, deepest


def _taken(region: _Region, choice: tuple[int, ...]) -> Iterator[str]:
    """The lines of a version, with the choice for the conflicts in it: one number for each level."""
    version, inner = (_OURS, choice) if not region.size else ((*choice, _OURS)[0], choice[1:])
    for part in region.versions[version]:
        if isinstance(part, str):
            yield part
        else:
            yield from _taken(part, inner)


def recover(toml: str | None, json: str | None, file: str, beside: str) -> Recovered:
    """What can be told from a robot's two files, which errors call `file` and `beside`; None for one that is lost.

    Raises StateError if a newer urdfsync wrote any side: it knows better what to do. A side that is no manifest, or
    names files outside of its package, or is no model, is left out.
    """
    _refuse_newer(toml or "", _TOML_FORMAT, file)
    _refuse_newer(json or "", _JSON_FORMAT, beside)
    readings = dict.fromkeys(reading for side in sides(toml or "") for reading in _readings(side))
    manifests = (_parsed(manifest.loads, reading, file) for reading in readings)
    models = ((manifest.text_hash(side), _parsed(modelfile.loads, side, beside)) for side in sides(json or ""))
    return Recovered(
        tuple(side for side in manifests if side is not None),
        {key: model for key, model in models if model is not None},
        frozenset(_BASE.findall(toml or "")) - frozenset(_IMPORTED.findall(toml or "")),
    )


def _readings(side: str) -> tuple[str, str]:
    """A side of the TOML file with each table once: the first of those that have the same name, and the last.

    A merge by lines may put a table in twice, inside of a conflict and outside.
    """
    tables = [(table.split("\n", 1)[0], table) for table in re.split(r"^(?=\[)", side, flags=re.MULTILINE)]
    first, last = dict(reversed(tables)), dict(tables)
    return "\n".join(reversed(first.values())), "\n".join(last.values())


def _refuse_newer(text: str, pattern: re.Pattern[str], file: str) -> None:
    """Look for formats in all of a text, since a side that a newer urdfsync wrote may be no manifest for this one."""
    for match in pattern.finditer(text):
        if int(match[1]) > FORMAT:
            message = f"a newer urdfsync wrote some of this state (format {match[1]}; this one knows {FORMAT})"
            line = text.count("\n", 0, match.start()) + 1
            raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, line, hint="update urdfsync"))


def _parsed(parse: Callable[[str, str], _Parsed], text: str, file: str) -> _Parsed | None:
    try:
        return parse(text, file)
    except StateError as error:
        if any(found.code == "newer-state" for found in error.diagnostics):
            raise
        return None


def choose(candidates: Sequence[str], mine: str | None, generated: str | None) -> str | None:
    """Which of the recorded hashes is the base of a file; `mine` and `generated` are the hashes of today, if any.

    - What is on disk, if it is a candidate: nobody edited it since a build wrote it, so that it may be renewed.
    - Else one that is not what is generated, if there are several: the file then counts as edited, and the
      three-way merge judges. With the generated one as its base it would be kept as it is, in silence, although
      the merge of the branches may have lost what the other branch's build brought in.
    - Else the only one.
    - None if there is none: then the plan shows a conflict, and the file is not overwritten.

    A file is never taken for untouched unless its very bytes are recorded.
    """
    if mine is not None and mine in candidates:
        return mine
    return next((base for base in candidates if base != generated), next(iter(candidates), None))


def rebuilt(recovered: Recovered, mine: Mapping[str, str | None], generated: Mapping[str, str]) -> Manifest | None:
    """One manifest of all sides, given the hashes of what is on disk and of what is generated, by path.

    `mine` should have what is there in the place of all `Recovered.roles` and of everything that is generated.
    The heading is that of the newest generator, or else the first. Everything that any side lists remains: files
    with the base that `choose` tells, names in `package.order` files, dependencies. None if no side is a manifest:
    then the state is lost, and files that are not as they would be generated conflict.
    """
    if not recovered.manifests:
        return None
    lost = {path for path in generated if mine.get(path) in recovered.written}
    known = recovered.roles.keys() | lost
    first = recovered.manifests[0].generator.domain
    heading = max(recovered.manifests, key=lambda side: (side.generator.domain == first, side.generator.revision))
    orders: dict[str, tuple[str, ...]] = {}
    for side in recovered.manifests:
        for path, names in side.orders.items():
            orders[path] = tuple(dict.fromkeys([*orders.get(path, ()), *names]))
    return msgspec.structs.replace(
        heading,
        files={path: _record(recovered, path, mine.get(path), generated.get(path)) for path in sorted(known)},
        orders=orders,
        dependencies=_dependencies(recovered, mine),
    )


def _record(recovered: Recovered, path: str, mine: str | None, generated: str | None) -> FileRecord:
    """What the sides say of a file, with the base that is chosen.

    A text that urdfsync wrote is its own base, whatever path its hash got to in the merge, and if its own path got
    lost.
    """
    records = [side.files[path] for side in recovered.manifests if path in side.files] or [FileRecord("", Role.MODEL)]
    base = mine if mine in recovered.written else choose(recovered.bases(path), mine, generated)
    record = next((record for record in records if record.base == base), records[0])
    return msgspec.structs.replace(record, base=base)


def _dependencies(recovered: Recovered, mine: Mapping[str, str | None]) -> dict[str, DependencyRecord]:
    """What is known of each dependency: of the copy that is on disk if any side is, else what the first one knows."""
    united: dict[str, DependencyRecord] = {}
    for side in reversed(recovered.manifests):
        united |= side.dependencies
    for side in reversed(recovered.manifests):
        for key, record in side.dependencies.items():
            if record.target_hash is not None and record.target_hash == mine.get(f"{side.folder}/{record.target}"):
                united[key] = record
    return united


def repaired(recovered: Recovered, robot: str, folder: str) -> Diagnostic:
    """A note that a state was made again, and from what."""
    count = len(recovered.manifests)
    origin = (
        "from the files alone" if not count else "from what could be read of it" if count == 1 else "from both sides"
    )
    message = f"the recorded state of robot `{robot}` was made again, {origin}"
    hint = "files that are not what was ever written are shown as edited or in conflict" if count else ""
    return Diagnostic(Severity.NOTE, "repaired-state", message, folder, hint=hint)
