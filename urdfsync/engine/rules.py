"""What to do with each file: decided from its recorded base, what is on disk, and what would be written now.

*Base* is the generated text that the file on disk last took into account, *mine* is on disk, *generated* would be
written. All are compared by hashes, never by times. Everything here is pure.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Collection, Iterable, Mapping

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import CONFLICTS, DELETES, Action, Kind
from urdfsync.state.record import Choice, FileRecord, RecordState


class DesiredFile(msgspec.Struct, frozen=True):
    """A file that the package should have."""

    role: Role
    owner: str
    hash: str
    at_hand: bool = True
    """Whether its content is available; otherwise only the hash is known."""


class OnDisk(msgspec.Struct, frozen=True):
    """What is on disk at a path: the hash of a file, or None; then whether the class is a folder (`X/package.mo`)."""

    hash: str | None = None
    is_folder: bool = False


NO_FILE = OnDisk()


def decide_file(base: str | None, mine: OnDisk, generated: str | None) -> Kind:
    """Decide on one file by the table of the design; a hash is None where there is no such text."""
    if generated is None:
        if base is None or mine == NO_FILE:
            return Kind.FORGET
        return Kind.DELETE if mine.hash == base else Kind.ORPHAN
    if mine == NO_FILE:
        return Kind.CREATE if base is None else Kind.RESTORE
    if mine.hash == generated:
        return Kind.UNCHANGED if base == generated else Kind.ADOPT
    if base is None:
        return Kind.UNOWNED
    if mine.hash == base:
        return Kind.UPDATE
    return Kind.KEEP if generated == base else Kind.CONFLICT


def renamed_files(
    recorded: Mapping[str, FileRecord], targets: Mapping[str, str], desired: Collection[str]
) -> dict[str, str]:
    """Return new and old path of the files that belong elsewhere now.

    `targets` has, for recorded paths, the path of the element's file now. A file that waits for a conflict still is at
    its origin; the record of the origin itself then describes another element's file, or an older one.
    """
    waiting = {record.origin for record in recorded.values() if record.origin}
    found = {}
    for path, record in recorded.items():
        if path in targets and (record.origin or path not in waiting):
            old, new = record.origin or path, targets[path]
            if new in desired and new != old:
                found[new] = old
    return found


def decide(
    recorded: Mapping[str, FileRecord],
    desired: Mapping[str, DesiredFile],
    on_disk: Mapping[str, OnDisk],
    moves: Mapping[str, str] | None = None,
) -> tuple[Action, ...]:
    """Decide on every file of a robot; `on_disk` may leave out what is not there.

    `moves` has new and old path of files whose element was renamed, see `renamed_files`. A file that the user edited
    goes to its new path (MOVE, and LEAVE at the old one), unless something else of the user's is there. A file that the
    user moved there by hand is compared with what was written at the old path.
    """
    waiting = {record.origin: record for record in recorded.values() if record.origin}
    moves, bases = moves or {}, {}
    for new, old in moves.items():  # a file that moves may have waited before, to move here or elsewhere
        there = recorded.get(new)
        record = there if there and there.origin == old else waiting.get(old)
        bases[new] = record.base if record else recorded[old].written_hash if old in recorded else None

    def hash_at(path: str) -> str | None:
        return on_disk.get(path, NO_FILE).hash

    def replaced_hash(path: str) -> str | None:
        """Return the hash of the file at a path, if it is as urdfsync wrote it there; None otherwise."""
        return hash_at(path) if path in recorded and hash_at(path) == recorded[path].written_hash else None

    def is_free(path: str) -> bool:
        return path not in on_disk or on_disk[path] == NO_FILE or replaced_hash(path) is not None

    edited = {new: old for new, old in moves.items() if bases[new] and hash_at(old) not in (None, bases[new])}
    # a file that can't move blocks the one that would take its place, and so on
    while True:
        moved_away = set(edited.values())
        blocked = [path for path in edited if path not in moved_away and not is_free(path)]
        if not blocked:
            break
        for path in blocked:
            del edited[path]

    actions = []
    for path in sorted(recorded.keys() | desired.keys()):
        record, target, mine = recorded.get(path), desired.get(path), on_disk.get(path, NO_FILE)
        role, owner = (target.role, target.owner) if target else (recorded[path].role, recorded[path].owner)
        generated, base = target.hash if target else None, record.written_hash if record else None
        old_path = moves.get(path) if target else None
        is_unedited = old_path and bases[path] and hash_at(old_path) == bases[path] and is_free(path)
        if old_path and (path in edited or (is_unedited and mine.hash != generated)):
            # The file comes from another place. What is here is remembered in case that it has to wait.
            kind = Kind.MOVE if path in edited else Kind.CREATE if mine == NO_FILE else Kind.UPDATE
            hash_ = hash_at(old_path) if path in edited else mine.hash
            one = Action(path, kind, role, owner, bases[path], generated, old_path, mine=hash_)
            actions.append(msgspec.structs.replace(one, replaced_hash=replaced_hash(path)))
            continue
        if path in moved_away and target is None:
            actions.append(Action(path, Kind.LEAVE, role, owner, base))
            continue
        if path in moved_away:
            base, mine = None, NO_FILE
        elif old_path and hash_at(old_path) is None and (record is None or record.origin == old_path):
            is_moved_by_hand = mine.hash is not None and replaced_hash(path) is None
            base = bases[path] if is_moved_by_hand and bases[path] else base
        kind = decide_file(base, mine, generated)
        if kind is not Kind.FORGET or base is not None:  # else it was never written, and is not wanted any more
            at_hand = target is None or target.at_hand
            actions.append(Action(path, kind, role, owner, base, generated, mine=mine.hash, at_hand=at_hand))
    return tuple(actions)


def keep_needed(
    actions: Iterable[Action], has_classes: Callable[[str, Collection[str]], bool], used: Collection[str] = ()
) -> tuple[Action, ...]:
    """Keep what the user's files need: the record of an edited model, and the `package.mo` of a folder with classes.

    The record of a model that the user keeps for himself goes with the model. `used` are records that a text of the
    user's mentions. `has_classes(path, gone)` tells whether the folder of the `package.mo` at `path` holds classes
    other than the files in `gone`.
    """
    actions = tuple(actions)
    models = [action for action in actions if action.role is Role.MODEL]
    orphans = {action.owner for action in models if action.kind is Kind.ORPHAN}
    released = {action.owner for action in models if action.released} - orphans
    gone = {action.path: action for action in actions if action.kind in DELETES}
    needed = {
        path
        for path, action in gone.items()
        if action.kind is Kind.DELETE and action.role is Role.RECORD and (action.owner in orphans or path in used)
    }
    free = {path for path, action in gone.items() if action.role is Role.RECORD and action.owner in released}
    packages = [path for path, action in gone.items() if action.role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):  # innermost first
        if has_classes(path, gone.keys() - needed - free):
            needed.add(path)
    found = []
    for action in actions:
        if action.path in free:
            action = msgspec.structs.replace(action, kind=Kind.FORGET, choice=Choice.KEEP)
        elif action.path in needed:
            action = msgspec.structs.replace(action, kind=Kind.NEEDED)
        found.append(action)
    return tuple(found)


def hold(actions: Iterable[Action], numbers_only: Collection[str]) -> tuple[Action, ...]:
    """Put off structural changes of a robot while one of its files is in conflict.

    Still written are files after which the package compiles: records of which only numbers change (their paths are
    `numbers_only`), imported files, and files that are restored as they were.
    """
    actions = tuple(actions)
    if not any(action.kind in CONFLICTS for action in actions):
        return actions
    origins = {action.origin for action in actions}

    def waits(action: Action) -> bool:
        if not action.writes:
            return False
        if action.origin is not None or action.path in origins:
            return True
        if action.role is Role.IMPORT:
            return action.kind is Kind.DELETE
        if action.kind is Kind.RESTORE:
            return action.role is Role.ORDER or action.base != action.generated
        is_record = action.kind in (Kind.UPDATE, Kind.MERGE) and action.role is Role.RECORD
        return not (is_record and action.path in numbers_only)

    return tuple(msgspec.structs.replace(action, held=True) if waits(action) else action for action in actions)


def records_after(actions: Iterable[Action]) -> dict[str, FileRecord]:
    """Return the manifest's entry of each file once the actions are done; `package.order` files have none."""
    records = {}
    for action in actions:
        base, state = action.generated, RecordState.GENERATED
        if action.role is Role.ORDER:
            continue
        if action.held or action.kind in CONFLICTS:
            state = RecordState.WAITING if action.held else RecordState.CONFLICT
            chosen_for = sides_hash(action.mine, action.generated) if action.choice else None
            waits = action.origin, action.replaced_hash, action.choice, chosen_for
            records[action.path] = FileRecord(action.owner, action.role, action.base, state, *waits)
            continue
        if action.kind is Kind.KEEP:
            base, state = action.base, RecordState.EDITED
        elif action.kind is Kind.INCLUDED or (action.result or base) != base:
            state = RecordState.EDITED
        elif action.kind in (Kind.ORPHAN, Kind.NEEDED):
            base, state = action.base, RecordState.ORPHAN
        elif base is None:
            continue
        records[action.path] = FileRecord(action.owner, action.role, base, state)
    return records


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for the texts of both sides, from theirs."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


def remembered_choices(recorded: Mapping[str, FileRecord], actions: Iterable[Action]) -> dict[str, Choice]:
    """Return the recorded choices of the user that still hold."""
    return {
        action.path: record.choice
        for action in actions
        if (record := recorded.get(action.path) or recorded.get(action.origin or "")) is not None
        and record.choice is not None
        and record.chosen_for == sides_hash(action.mine, action.generated)
    }
