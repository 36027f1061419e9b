"""Finds the file of each place of a package: the one on disk that belongs to a part, wherever it is.

A file's stamp says which part and template it belongs to; without a stamp, its path counts. So a place keeps its file
even if the element gets another name, or the package another folder.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import msgspec

from urdfsync.domain import Role, Target
from urdfsync.engine.decide.parts import file_ids, is_of_part
from urdfsync.engine.decide.rules import Place
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import Folder
from urdfsync.modelica.files import as_file, class_parts
from urdfsync.modelica.stamp import Stamp
from urdfsync.project.state.record import role_of


def find_places(
    inputs: Inputs, generation: Generation, ids: Mapping[str, str], moves: Mapping[str, str]
) -> dict[str, Place]:
    """Return every recorded or generated file as it is before the build, by key.

    `ids` are the lasting ids of generated files by path, `moves` are those of `find_moves`.
    """
    last, files, places = inputs.last, inputs.files, dict[str, Place]()
    present, moved = frozenset(ids.values()), frozenset(moves.values())

    def add(key: str, role: Role, owner: str, generated: str | None) -> None:
        path = inputs.folder.path(key)
        base, mine, stamp, file_id = last.base_of(key, role), files.on_disk(key, role), None, ids.get(path)
        if file_id and (stamp := files.stamp(key)) and key not in moved and not is_of_part(stamp, file_id):
            is_plain = stamp.base == mine and last.has_written(stamp.base)  # a killed build has exchanged two files
            # else it is a copy of another part's file, or of another project's
            base = base if is_plain else last.record.files.get(key)
        place = Place(role, owner, base, mine, generated)
        if stamp and stamp.id == file_id and place.is_edited and (text := last.base(base)) is not None:
            is_displaced = not is_in_place(text, inputs.robot.target, path)
            place = msgspec.structs.replace(place, is_displaced=is_displaced)
        places[key] = place

    def is_copy(key: str, stamp: Stamp) -> bool:
        """Whether a file that is not recorded was generated for another path; git may bring one with a former name."""
        text = _base_text(inputs, key, stamp)
        return stamp.id in present if text is None else not is_in_place(text, last.target, last.folder.path(key))

    for path, artifact in generation.package.artifacts.items():
        add(inputs.folder.key(path), artifact.role, artifact.owner, generation.package.hash(path))
    for name, entry in generation.imported.imports.items():
        add(inputs.folder.key(entry.target), Role.IMPORT, name, entry.target_hash)
    for key in last.files.keys() - places.keys():
        stamp, recorded = files.stamp(key), last.record.files
        is_folder = as_file(key) in places or as_file(key) in recorded
        path = last.folder.path(key)
        is_users = is_folder or (stamp is not None and key not in moved and is_copy(key, stamp))
        if key not in recorded and is_users:
            continue  # the user turned the class into a folder, copied it, or gave it another name
        # `last.package` takes 20 ms with 100 links: only files that are no longer generated need it
        old = last.package.artifacts.get(path) if last.package else None
        add(key, old.role if old else role_of(path), old.owner if old else "", None)
    return places


def find_moves(inputs: Inputs, ids: Mapping[str, str]) -> dict[str, str]:
    """Return old keys by new keys of the files whose stamps, or else paths, say that they belong at another path."""
    files, last, moves, strays = inputs.files, inputs.last, dict[str, str](), dict[str, str]()
    targets = {file_id: inputs.folder.key(path) for path, file_id in ids.items()}
    for folder in dict.fromkeys((last.folder, inputs.folder)):
        for key, stamp in _stamps(inputs, folder).items():
            file_id = last.edits.get(files.hash(key, Role.MODEL) or "", stamp.id)
            target = targets.get(file_id)
            if target is None or as_file(target) == as_file(key):
                continue
            there, text_there = files.stamp(target), files.hash(target, Role.MODEL) or ""
            is_there = (
                there is not None and file_id == last.edits.get(text_there, there.id) and there.base != text_there
            )
            is_edited, is_chosen = files.hash(key, Role.MODEL) != stamp.base, files.is_chosen(key)
            is_own = is_chosen or is_in_place(_base_text(inputs, key, stamp), last.target, folder.path(key))
            # a stranger may have written the stamp
            is_trusted = is_chosen or (is_own if is_edited else last.has_written(stamp.base))
            if is_there or not is_trusted:
                continue  # the class is the user's own: a copy, or with another name
            place = as_file(key)  # if the class is a folder, the file that it was
            (moves if is_own else strays).setdefault(target, place if place in last.record.files else key)
    # an unedited file elsewhere was moved by the user if its part has no other file; else it is a copy
    return {target: key for target, key in strays.items() if files.on_disk(target, Role.MODEL) is None} | moves


def _base_text(inputs: Inputs, key: str, stamp: Stamp) -> str | None:
    """Return the generated text that a file came from: its own one, if it is unedited; None if that is lost."""
    is_edited = inputs.files.hash(key, Role.MODEL) != stamp.base
    return inputs.last.base(stamp.base) if is_edited else inputs.files.text(key)


def _stamps(inputs: Inputs, folder: Folder) -> dict[str, Stamp]:
    """Return the stamps of the files below a folder by key; a recorded file without its stamp has that of its path."""
    files, last, stamps = inputs.files, inputs.last, inputs.files.stamps(folder)
    recorded = (key for key in last.record.files if key.endswith(".mo") and key not in stamps)
    lost = [key for key in recorded if isinstance(files.on_disk(key, Role.MODEL), str)] if folder == last.folder else []
    if lost and last.package:
        ids = file_ids(last.package.artifacts.values(), last.record.ids)
        owned = ((key, ids[path]) for key in lost if (path := folder.path(key)) in ids)
        stamps |= {key: Stamp(file_id, last.record.files[key]) for key, file_id in owned}
    return stamps


def is_in_place(base: str | None, target: Target, path: str) -> bool:
    """Return whether the file at this path is where its base was generated: a copy has another name or folder."""
    *folders, name = (*target.package.split("."), *class_parts(path))
    within = f"within {re.escape('.'.join(folders))};\n" if folders else ""
    return re.match(rf"{within}.*?^(?:\w+ )+{name}\b", base or "", re.DOTALL | re.MULTILINE) is not None
