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
from urdfsync.engine.renames import NO_FILE, OnDisk, Renames
from urdfsync.state.record import Choice, FileRecord, RecordState


class DesiredFile(msgspec.Struct, frozen=True):
    """A file that the package should have."""

    role: Role
    owner: str
    hash: str
    at_hand: bool = True
    """Whether its content is available; otherwise only the hash is known."""


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


def decide(
    recorded: Mapping[str, FileRecord],
    desired: Mapping[str, DesiredFile],
    on_disk: Mapping[str, OnDisk],
    moves: Mapping[str, str] | None = None,
) -> tuple[Action, ...]:
    """Decide on every file of a robot; `on_disk` may leave out what is not there.

    `moves` has new and old path of files whose element was renamed. A file that the user edited goes to its new path
    (MOVE, and LEAVE at the old one), if `resolve` finds that its text can. A file that the user moved there by hand is
    compared with what was written at the old path.
    """
    renames = Renames(recorded, on_disk, moves or {})
    actions = []
    elements = {path: (record.role, record.owner) for path, record in recorded.items()}
    elements |= {path: (target.role, target.owner) for path, target in desired.items()}
    for path, (role, owner) in sorted(elements.items()):
        record, target, mine = recorded.get(path), desired.get(path), on_disk.get(path, NO_FILE)
        generated = target.hash if target else None
        base = record.written_hash if record else None

        if target and path in renames.edited:
            old = renames.edited[path]
            kind, origin = Kind.MOVE, old
            mine_hash = on_disk[old].hash
        elif target and mine.hash != generated and (old_path := renames.unedited_source(path)) is not None:
            kind, origin = Kind.CREATE if mine == NO_FILE else Kind.UPDATE, old_path
            mine_hash = mine.hash
        elif path in renames.moved_away and target is None:
            actions.append(Action(path, Kind.LEAVE, role, owner, base))
            continue
        else:
            if path in renames.moved_away:
                base, mine = None, NO_FILE
            elif target and (written := renames.moved_by_hand(path)) is not None:
                base = written
            kind = decide_file(base, mine, generated)
            if kind is not Kind.FORGET or base is not None:  # else it was never written, and is not wanted any more
                at_hand = target is None or target.at_hand
                actions.append(Action(path, kind, role, owner, base, generated, mine=mine.hash, at_hand=at_hand))
            continue
        # The file comes from another place. What is here is remembered in case that it has to wait.
        actions.append(
            Action(
                path,
                kind,
                role,
                owner,
                renames.base(path, origin),
                generated,
                origin,
                mine=mine_hash,
                replaced_hash=renames.replaced_hash(path),
            )
        )
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
        if action.role is not Role.ORDER and (record := _record_after(action)) is not None:
            records[action.path] = record
    return records


def _record_after(action: Action) -> FileRecord | None:
    if action.kind is Kind.UNCHANGED:
        return FileRecord(action.owner, action.role, action.generated)
    base = action.base
    if action.held:
        state = RecordState.WAITING
    elif action.kind in CONFLICTS:
        state = RecordState.CONFLICT
    elif action.kind is Kind.KEEP:
        state = RecordState.EDITED
    elif action.kind is Kind.INCLUDED or (action.result or action.generated) != action.generated:
        state, base = RecordState.EDITED, action.generated
    elif action.kind in (Kind.ORPHAN, Kind.NEEDED):
        state = RecordState.ORPHAN
    elif action.generated is None:
        return None
    else:
        state, base = RecordState.GENERATED, action.generated
    if state not in (RecordState.WAITING, RecordState.CONFLICT):
        return FileRecord(action.owner, action.role, base, state)
    chosen_for = sides_hash(action.mine, action.generated) if action.choice else None
    return FileRecord(
        action.owner, action.role, base, state, action.origin, action.replaced_hash, action.choice, chosen_for
    )


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
