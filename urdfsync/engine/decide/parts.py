"""The lasting ids of a model's parts and of their files: a part keeps its id when it gets another name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from urdfsync.common.files import digest
from urdfsync.domain import Artifact, ElementKey, Snapshot, displaced
from urdfsync.domain.matching import Doubt, Matching
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import LastBuild
from urdfsync.engine.renames import find_matching
from urdfsync.modelica.stamp import Stamp
from urdfsync.project.state.record import Record

_DIGITS = 8
"""The number of digits of a part's id, which begins the id of each of its files."""


def first_id(owner: str) -> str:
    """Return the id of a part that always had its present name: `owner` is its kind and name."""
    return digest(owner.encode())[:_DIGITS]


def is_of_part(stamp: Stamp, file_id: str) -> bool:
    """Return whether a stamp is that of a file of the same part: a joint of another type has another template."""
    return stamp.id[:_DIGITS] == file_id[:_DIGITS]


def ids_of(elements: Iterable[ElementKey], ids: Mapping[str, str]) -> dict[ElementKey, str]:
    """Return the ids of all these elements; `ids` has those that differ from `first_id`, by owner."""
    return {key: ids.get(" ".join(key)) or first_id(" ".join(key)) for key in elements}


def recorded_ids(last: LastBuild) -> Iterator[tuple[Record, Snapshot, Mapping[ElementKey, str]]]:
    """Yield the records of all branches, each with its model and the ids of all its elements."""
    for record, model, elements in last.branches:
        yield record, model, ids_of(elements, record.ids)


def find_part_ids(
    inputs: Inputs, generation: Generation, matching: Matching, stamped: Mapping[str, str]
) -> dict[str, str]:
    """Return the ids of the parts that have another id than `first_id`, by owner; `stamped` has those of stamps."""
    last, renames, now = inputs.last, matching.renames, generation.now.snapshot
    if not (last.is_united or last.record.ids or renames or stamped):
        return {}
    present, ids, taken = inputs.domain.features(now), dict(stamped), set(stamped.values())
    for record, model, parts in recorded_ids(last):
        if record is not last.records[0]:
            renames = find_matching(inputs.domain, model, now, {}).renames
        gone = displaced(renames)
        for (kind, name), part in parts.items():
            key = kind, renames.get((kind, name), name)
            if key in present and (kind, name) not in gone and part not in taken and " ".join(key) not in ids:
                ids[" ".join(key)] = part
                taken.add(part)
    for key in present:
        if (owner := " ".join(key)) not in ids:
            ids[owner] = first_id(owner)
            while ids[owner] in taken:  # a part that was renamed began with this name
                ids[owner] = first_id(ids[owner])
            taken.add(ids[owner])
    return {owner: part for owner, part in ids.items() if part != first_id(owner)}


def is_older_than_package(inputs: Inputs, generation: Generation) -> bool:
    """Return whether all files that the export changes were built from it: git, or the user, has an older state."""
    package, recorded = generation.package, inputs.last.record.files
    hashes = {inputs.folder.key(path): package.hash(path) for path in package.artifacts if path.endswith(".mo")}
    changed = {key: sha256 for key, sha256 in hashes.items() if recorded.get(key) != sha256}
    stamps = ((inputs.files.stamp(key), sha256) for key, sha256 in changed.items())
    return bool(changed) and all(stamp is not None and stamp.base == sha256 for stamp, sha256 in stamps)


def ids_of_stamps(inputs: Inputs, generation: Generation) -> dict[str, str]:
    """Return the ids of the parts whose files, at their paths, have stamps, by owner: the state is lost or too old."""
    found = dict[str, set[str]]()
    for path, artifact in generation.package.artifacts.items():
        stamp = inputs.files.stamp(inputs.folder.key(path)) if " " in artifact.owner else None
        if stamp and stamp.id[_DIGITS : _DIGITS + 1] == "-":
            found.setdefault(artifact.owner, set()).add(stamp.id[:_DIGITS])
    counts = Counter(part for parts in found.values() for part in parts)
    return {owner: min(parts) for owner, parts in found.items() if len(parts) == 1 and counts[min(parts)] == 1}


def find_former_ids(inputs: Inputs, generation: Generation, parts: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """Return the ids of all parts that had each name and have it no more, by owner; `parts` are present ids."""
    if inputs.last.version is None:
        return dict(inputs.last.record.former_ids)
    present = {" ".join(key) for key in inputs.domain.features(generation.now.snapshot)}
    found = {owner: dict.fromkeys(ids) for owner, ids in inputs.last.record.former_ids.items()}
    for _, _, ids in recorded_ids(inputs.last):
        for key, part in ids.items():
            if (owner := " ".join(key)) not in present or parts.get(owner, first_id(owner)) != part:
                found.setdefault(owner, {})[part] = None
    return {owner: tuple(ids) for owner, ids in found.items()}


def other_meanings(inputs: Inputs, generation: Generation, parts: Mapping[str, str]) -> dict[ElementKey, Doubt]:
    """Return a doubt for each element whose name had meant another part when the last complete build was made.

    The edits of files from before that build have another base, which tells the meaning of their names.
    """
    doubts, former_ids = dict[ElementKey, Doubt](), inputs.last.record.former_ids
    if not former_ids:
        return doubts
    present = inputs.domain.features(generation.now.snapshot)
    ids = ids_of(present, parts)
    for key, part in ids.items():
        if others := set(former_ids.get(" ".join(key), ())) - {part}:
            moved_to = next((name for (kind, name), other in ids.items() if kind == key[0] and other in others), "")
            formers = (owner for owner, former in former_ids.items() if part in former)
            former = next(formers, "").partition(" ")[2]
            doubts[key] = Doubt(" ".join(key), former, (), moved_to, is_certain=True)
    return doubts


def file_ids(artifacts: Iterable[Artifact], parts: Mapping[str, str]) -> dict[str, str]:
    """Return the id of each file by its path: the id of its part, then digits of its template's name."""
    files = tuple(artifacts)
    templates = {file.template: digest(file.template.encode())[:4] for file in files}
    return {file.path: f"{parts.get(file.owner) or first_id(file.owner)}-{templates[file.template]}" for file in files}
