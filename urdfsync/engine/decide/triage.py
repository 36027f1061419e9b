"""Sorts a robot's files by hashes: in step, edited, to write or to delete, in conflict, or asked about."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import NamedTuple

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import DISPUTED, Action, Reason
from urdfsync.engine.decide.differences import Differences, is_in_place
from urdfsync.engine.decide.doubts import find_doubts
from urdfsync.engine.decide.package_names import renamed_names
from urdfsync.engine.decide.parts import is_of_part
from urdfsync.engine.decide.rules import File, decide
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.package.generate import Package
from urdfsync.matching import Doubt
from urdfsync.modelica.files import as_file
from urdfsync.modelica.stamp import Stamp
from urdfsync.state.record import role_of


class Triage(NamedTuple):
    """What the hashes of the files tell, and which parts the user's edits mean."""

    actions: tuple[Action, ...]
    origins: frozenset[str]
    """The former keys of files whose elements have other names."""
    doubts: Mapping[str, Doubt]
    names: Mapping[str, str]
    """New names by old names; empty if no edit, no text in `aside` and no use of an exchanged name needs them."""


def triage(inputs: Inputs, generation: Generation, differences: Differences) -> Triage:
    """Decide on every file by hashes; ask about edits that may belong to other parts."""
    package, origins = generation.package, frozenset(differences.moves.values())
    decided = decide(_find_files(inputs, generation, differences), differences.moves)
    decided = tuple(_as_moved(inputs, differences, action) for action in decided)
    doubts = find_doubts(inputs, generation, differences, decided)
    actions = tuple(_adjust(inputs, package, action, doubts, differences.ids) for action in decided)
    names: Mapping[str, str] = {}
    is_disputed = any(one.reason in DISPUTED and one.role is not Role.IMPORT for one in actions)
    if differences.other_elements or inputs.last.aside or is_disputed:
        names = renamed_names(inputs, generation, differences)
    if differences.other_elements:
        actions = tuple(_with_other_names(inputs, package, actions, names))
    return Triage(actions, origins, doubts, names)


def _find_files(inputs: Inputs, generation: Generation, differences: Differences) -> dict[str, File]:
    """Return every recorded or generated file as it is before the build, by key."""
    last, files, moved = inputs.last, dict[str, File](), frozenset(differences.moves.values())
    present = frozenset(differences.ids.values())

    def add(key: str, role: Role, owner: str, generated: str | None) -> None:
        base, file_id = last.base_of(key, role), differences.ids.get(inputs.folder.path(key))
        if file_id and key not in moved and (stamp := inputs.files.stamp(key)) and not is_of_part(stamp, file_id):
            base = last.record.files.get(key)  # it is a copy of another part's file, or of another project's
        files[key] = File(role, owner, base, inputs.files.on_disk(key, role), generated)

    for path, artifact in generation.package.artifacts.items():
        add(inputs.folder.key(path), artifact.role, artifact.owner, generation.package.hash(path))
    for name, entry in generation.imported.imports.items():
        add(inputs.folder.key(entry.target), Role.IMPORT, name, entry.target_hash)
    for key in last.files.keys() - files.keys():
        stamp, recorded = inputs.files.stamp(key), last.record.files
        is_folder = as_file(key) in files or as_file(key) in recorded
        is_copy = stamp is not None and stamp.id in present and key not in moved
        if key not in recorded and (is_folder or is_copy):
            continue  # the user turned the class into a folder, copied it, or gave it another name
        path = last.folder.path(key)
        # `last.package` takes 20 ms with 100 links: only files that are no longer generated need it
        old = last.package.artifacts.get(path) if last.package else None
        add(key, old.role if old else role_of(path), old.owner if old else "", None)
    return files


def _as_moved(inputs: Inputs, differences: Differences, action: Action) -> Action:
    """Return the action of a move for an edited file that is at the new path of its part already, with its old text.

    A killed build, git or the user has brought it there.
    """
    path, stamp = inputs.folder.path(action.path), None
    if action.reason is Reason.CONFLICT and path in differences.ids:
        stamp = inputs.files.stamp(action.path)
    if stamp is None or stamp.id != differences.ids[path] or (base := inputs.last.base(action.base)) is None:
        return action
    is_moved = not is_in_place(base, inputs.robot.target, path)
    return msgspec.structs.replace(action, reason=Reason.MOVE) if is_moved else action


def find_unknown(inputs: Inputs, known: Collection[str]) -> Iterator[str]:
    """Yield the Modelica files in the package that are neither generated nor recorded."""
    others = tuple(f"{inputs.files.key(one.folder)}/" for one in inputs.config.robots if one.name != inputs.robot.name)
    for key in sorted(inputs.files.classes(inputs.folder) - set(known)):
        if not key.startswith(others) and key.removesuffix("/package.mo") + ".mo" not in known:
            yield key


def _adjust(
    inputs: Inputs, package: Package, action: Action, doubts: Mapping[str, Doubt], ids: Mapping[str, str]
) -> Action:
    """Correct an action by contents and options: the rules see only hashes."""
    left = inputs.files.left_by_git
    if left.get(action.path) and action.reason in (Reason.KEEP, Reason.UNCHANGED, Reason.UPDATE):
        return msgspec.structs.replace(action, reason=Reason.MARKERS)
    if left.get(action.path, True) is None:
        action = msgspec.structs.replace(action, is_left_by_git=True)
    file_id = ids.get(inputs.folder.path(action.path))
    if action.reason is Reason.UNCHANGED and file_id:
        is_stamped = inputs.files.stamp(action.path) == Stamp(file_id, str(action.generated))
        return action if is_stamped else msgspec.structs.replace(action, reason=Reason.UPDATE)
    if action.path in doubts:
        return msgspec.structs.replace(action, reason=Reason.ASKED)
    if action.reason is Reason.DELETE and action.mine is not None and action.role is not Role.IMPORT:
        # a record alone proves nothing: its author, or git's union of two records, may name any file of the user's
        is_written = action.mine in package.paths_by_hash or inputs.last.has_written(action.mine)
        return action if is_written else msgspec.structs.replace(action, reason=Reason.ORPHAN)
    return action


def _with_other_names(
    inputs: Inputs, package: Package, actions: Iterable[Action], names: Mapping[str, str]
) -> Iterator[Action]:
    """Yield the actions. An edit that uses an outdated name is merged, even if the generated text did not change."""
    for action in actions:
        is_chosen = inputs.files.is_chosen(action.path)
        is_edit = action.reason is Reason.KEEP and action.role is not Role.IMPORT and not is_chosen
        if is_edit and action.base == action.generated:
            from urdfsync.modelica.lexer import words_in  # imports the parser

            text = inputs.files.text(action.path) or ""
            generated = package.content(inputs.folder.path(action.path)).decode()
            words, is_settled = words_in(generated), action.mine in inputs.last.record.confirmed
            mine = Counter(words_in(text))
            mine.subtract(words)
            if not is_settled and any(count > 0 and word in names for word, count in mine.items()):
                action = msgspec.structs.replace(action, reason=Reason.CONFLICT)
        yield action
