"""The decision about each file: from its recorded base, the file on disk, and the generated text.

*Base* is the last generated text that the file on disk contains or was merged with. *Mine* is the text on disk.
*Generated* is the text from the present source. The rules compare hashes, never times. All functions here are pure.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import ORPHANS, Action, Reason
from urdfsync.engine.inspect.package_files import OnDisk


class Place(msgspec.Struct, frozen=True):
    """One file of a package before the build."""

    role: Role
    owner: str = ""
    base: str | None = None
    """Hash of the base; None if no build wrote the file."""
    mine: OnDisk = None
    generated: str | None = None
    """Hash of the generated text; None if the file is not generated."""
    is_displaced: bool = False
    """Whether the file has an edit of a text that was generated for another path: a killed build, git or the user has
    brought the file here."""

    @property
    def is_free(self) -> bool:
        """Whether no text of the user is at the path: the file is missing or unedited."""
        return self.mine is None or self.mine == self.base

    @property
    def is_edited(self) -> bool:
        """Whether the user changed a file that urdfsync wrote."""
        return isinstance(self.mine, str) and self.base is not None and self.mine != self.base


def decide_file(base: str | None, mine: OnDisk, generated: str | None) -> Reason:
    """Decide on one file by the table of docs/conflicts.md; a hash is None for a missing text."""
    if generated is None:
        if base is None or mine is None:
            return Reason.FORGET
        return Reason.DELETE if mine == base else Reason.ORPHAN
    if mine is None:
        return Reason.CREATE if base is None else Reason.RESTORE
    if mine == generated:
        return Reason.UNCHANGED
    if base is None:
        return Reason.UNOWNED
    if mine == base:
        return Reason.UPDATE
    return Reason.KEEP if generated == base else Reason.CONFLICT


def decide(places: Mapping[str, Place], moves: Mapping[str, str]) -> tuple[Action, ...]:
    """Decide on every file of a robot, by path.

    `moves` has old paths by new paths of files whose element was renamed. Such a file has one action, at its new path;
    it stays where it is if a text of the user's is in the way.
    """
    origins, actions = _find_origins(places, moves), list[Action]()
    leaving = set(origins.values())
    for path, place in sorted(places.items()):
        origin, found = origins.get(path), place
        if origin is not None:
            found = places[origin]
        elif path in leaving:
            found = Place(place.role)  # the file that is here is another part's
        reason = decide_file(found.base, found.mine, place.generated)
        if origin is not None:
            reason = Reason.MOVE if found.is_edited else Reason.CREATE if place.mine is None else Reason.UPDATE
        elif place.is_displaced and reason is Reason.CONFLICT:
            reason = Reason.MOVE
        if reason is Reason.FORGET and found.base is None:
            continue  # no build wrote this file, or it moves away
        # an unedited text that moves gives way to the generated one
        mine = found.mine if isinstance(found.mine, str) and (origin is None or reason is Reason.MOVE) else None
        actions.append(Action(path, reason, place.role, place.owner, found.base, place.generated, origin, mine=mine))
    return tuple(actions)


def _find_origins(places: Mapping[str, Place], moves: Mapping[str, str]) -> dict[str, str]:
    """Return the old paths by new paths of the files that can move to the path of their element."""
    edited = {path: old for path, old in moves.items() if places[old].is_edited}
    taken = {path for path in moves if not places[path].is_free}
    # if an edited file can't move, no other file can move to its path, and so on
    while blocked := edited.keys() & taken - set(edited.values()):
        edited = {path: old for path, old in edited.items() if path not in blocked}
    plain = {path: old for path, old in moves.items() if places[old].mine == places[old].base is not None}
    taken = {path for path in plain if places[path].mine == places[path].generated} | taken - set(edited.values())
    return {path: old for path, old in plain.items() if path not in taken} | edited


def put_off(actions: Iterable[Action], value_only_keys: Collection[str], *, has_moved: bool) -> tuple[Action, ...]:
    """Let structural changes of a robot wait while one of its files is in conflict.

    A build still writes files that keep the package valid: records with changed numbers (`value_only_keys`), imported
    files, and restored files. If the package `has_moved`, all files wait. If all conflicts are only about numbers, no
    file waits.
    """
    actions = tuple(actions)
    if all(action.path in value_only_keys and not has_moved for action in actions if action.is_conflict):
        return actions

    def waits(action: Action) -> bool:
        if not action.writes:
            return False
        if has_moved or action.origin is not None:
            return True
        if action.role is Role.IMPORT:
            return action.reason is Reason.DELETE
        if action.reason is Reason.RESTORE:
            return action.role is Role.ORDER or action.base != action.generated
        return action.reason not in (Reason.UPDATE, Reason.MERGE) or action.path not in value_only_keys

    return tuple(msgspec.structs.replace(action, is_waiting=True) if waits(action) else action for action in actions)


def file_records_after(actions: Iterable[Action], recorded: Mapping[str, str], *, is_complete: bool) -> dict[str, str]:
    """Return the records of a package's files after a build.

    A complete build renews the records of all files. An incomplete build renews only the records of files that it wrote
    or found in step, or that have taken their generated text into account: a killed build may have written them.
    """
    records = {} if is_complete else dict(recorded)
    for action in actions:
        is_generated = action.reason is Reason.UNCHANGED or action.writes or action.base == action.generated
        if action.role is Role.ORDER or not (is_complete or is_generated):
            continue
        if action.generated is not None:
            records[action.path] = action.generated
        elif is_complete and action.reason in ORPHANS and action.base is not None:
            records[action.path] = action.base
    return records
