"""The lasting ids of a model's parts and of their files: a part keeps its id when it gets another name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from urdfsync.domain import Artifact, ElementKey, Role, displaced
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.files import digest
from urdfsync.matching import Doubt, Matching
from urdfsync.modelica.stamp import Stamp

_DIGITS = 8
"""The number of digits of a part's id, which begins the id of each of its files."""


def first_id(owner: str) -> str:
    """Return the id of a part that always had its present name: `owner` is its kind and name."""
    return digest(owner.encode())[:_DIGITS]


def is_of_part(stamp: Stamp, file_id: str) -> bool:
    """Return whether a stamp is that of a file of the same part: a joint of another type has another template."""
    return stamp.id[:_DIGITS] == file_id[:_DIGITS]


def find_part_ids(inputs: Inputs, generation: Generation, matching: Matching) -> dict[str, str]:
    """Return the ids of the parts that have another id than `first_id`, by owner."""
    last, renames = inputs.last, matching.renames
    recorded = dict(last.record.ids)
    if last.record.is_united:  # the branches may have recorded other ids: the files on disk say which count
        recorded |= _stated_ids(inputs, generation)
    if not (recorded or renames):
        return {}
    present, gone, ids = inputs.domain.features(generation.now.snapshot), displaced(renames), dict[str, str]()
    for kind, name in last.elements or present:
        owner, new = f"{kind} {name}", renames.get((kind, name), name)
        if (kind, new) in present and (kind, name) not in gone:
            ids[f"{kind} {new}"] = recorded.get(owner, first_id(owner))
    taken = set(ids.values())
    for kind, name in present:
        if (owner := f"{kind} {name}") not in ids:
            ids[owner] = first_id(owner)
            while ids[owner] in taken:  # a part that was renamed began with this name
                ids[owner] = first_id(ids[owner])
            taken.add(ids[owner])
    return {owner: part for owner, part in ids.items() if part != first_id(owner)}


def find_former_ids(inputs: Inputs, generation: Generation, parts: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """Return the ids of all parts that had each name and have it no more, by owner; `parts` are present ids."""
    last = inputs.last
    if not last.elements:
        return dict(last.record.former_ids)
    present = inputs.domain.features(generation.now.snapshot)
    found = {owner: dict.fromkeys(ids) for owner, ids in last.record.former_ids.items()}
    for kind, name in last.elements:
        owner = f"{kind} {name}"
        part = last.record.ids.get(owner, first_id(owner))
        if (kind, name) not in present or parts.get(owner, first_id(owner)) != part:
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
    ids = {key: parts.get(" ".join(key), first_id(" ".join(key))) for key in present}
    for key, part in ids.items():
        if others := set(former_ids.get(" ".join(key), ())) - {part}:
            moved_to = next((name for (kind, name), other in ids.items() if kind == key[0] and other in others), "")
            formers = (owner for owner, former in former_ids.items() if part in former)
            former = next(formers, "").partition(" ")[2]
            doubts[key] = Doubt(" ".join(key), former, (), moved_to, is_certain=True)
    return doubts


def _stated_ids(inputs: Inputs, generation: Generation) -> dict[str, str]:
    """Return the ids in the stamps of all records that equal their generated texts, by owner."""
    found = dict[str, str]()
    for path, artifact in generation.package.artifacts.items():
        state = inputs.files.state(inputs.folder.key(path)) if artifact.role is Role.RECORD else None
        if state and state.stamp and state.text_sha256 == generation.package.hash(path):
            found[artifact.owner] = state.stamp.id[:_DIGITS]
    return found


def file_ids(artifacts: Iterable[Artifact], parts: Mapping[str, str]) -> dict[str, str]:
    """Return the id of each file by its path: the id of its part, then digits of its template's name."""
    files = tuple(artifacts)
    templates = {file.template: digest(file.template.encode())[:4] for file in files}
    return {file.path: f"{parts.get(file.owner) or first_id(file.owner)}-{templates[file.template]}" for file in files}
