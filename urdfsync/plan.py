"""What to do with each file: one decision from what urdfsync wrote last, what is there, and what it would write now.

*Base* is the text that the file on disk last took into account, *mine* what is on disk, *generated*
what would be written. All three are compared by their hashes, never by times.
"""

from __future__ import annotations

import dataclasses
import enum
import re
from collections.abc import Callable, Collection, Iterable, Mapping

import msgspec

from urdfsync.domain import Role


class Kind(enum.StrEnum):
    """What happens to a file."""

    UNCHANGED = "unchanged"
    CREATE = "create"
    RESTORE = "restore"
    ADOPT = "adopt"
    UPDATE = "update"
    KEEP = "keep"
    CONFLICT = "conflict"
    UNOWNED = "unowned-conflict"
    DELETE = "delete"
    ORPHAN = "orphan"
    NEEDED = "needed"
    FORGET = "forget"


WRITES = frozenset({Kind.CREATE, Kind.RESTORE, Kind.UPDATE, Kind.DELETE})
"""Actions that change a file."""
CONFLICTS = frozenset({Kind.CONFLICT, Kind.UNOWNED})
"""Actions that leave a file alone although something else should be in it."""

_REASONS = {
    Kind.UNCHANGED: "nothing to do",
    Kind.CREATE: "new",
    Kind.RESTORE: "it was deleted; written again",
    Kind.ADOPT: "it already is what would be written",
    Kind.UPDATE: "what it is made from changed",
    Kind.KEEP: "you edited it; there is nothing new for it",
    Kind.CONFLICT: "you edited it, and what it is made from changed too",
    Kind.UNOWNED: "urdfsync did not write the file that is there",
    Kind.DELETE: "no longer generated",
    Kind.ORPHAN: "no longer generated, but you edited it; kept",
    Kind.NEEDED: "no longer generated, but something of yours needs it; kept",
    Kind.FORGET: "no longer generated, and already gone",
}


class State(enum.StrEnum):
    """How a file stood after the last build."""

    GENERATED = "generated"
    EDITED = "edited"
    CONFLICT = "conflict"
    WAITING = "waiting"
    """A change for it waits for the robot's conflicts to be resolved."""
    ORPHAN = "orphan"


class FileRecord(msgspec.Struct, frozen=True, omit_defaults=True):
    """What the manifest says of one file; `base` is a hash, None if urdfsync never wrote the file."""

    owner: str
    role: Role
    base: str | None = None
    state: State = State.GENERATED


@dataclasses.dataclass(frozen=True, slots=True)
class Found:
    """What is on disk: a file's hash, or None and whether the class is now a folder (`X/package.mo` for `X.mo`)."""

    hash: str | None = None
    as_folder: bool = False


@dataclasses.dataclass(frozen=True, slots=True)
class Wanted:
    """A file that is generated, with its hash."""

    role: Role
    owner: str
    hash: str


@dataclasses.dataclass(frozen=True, slots=True)
class Action:
    """What happens to one file (`path` as in the manifest), and the hashes that the decision rests on."""

    path: str
    kind: Kind
    role: Role
    owner: str = ""
    base: str | None = None
    generated: str | None = None
    held: bool = False
    """Put off until the robot's conflicts are resolved."""

    @property
    def reason(self) -> str:
        """Why, as the end of a sentence that begins with the path."""
        return _REASONS[self.kind] + ("; waits until the conflict is settled" if self.held else "")

    @property
    def writes(self) -> bool:
        """Whether a file changes now."""
        return self.kind in WRITES and not self.held


def decide(base: str | None, mine: Found, generated: str | None) -> Kind:
    """The action for one file; the hashes are None where there is no such text."""
    if generated is None:
        if base is None or (mine.hash is None and not mine.as_folder):
            return Kind.FORGET
        return Kind.DELETE if mine.hash == base else Kind.ORPHAN
    if mine.hash is None and not mine.as_folder:
        return Kind.CREATE if base is None else Kind.RESTORE
    if mine.hash == generated:
        return Kind.UNCHANGED if base == generated else Kind.ADOPT
    if base is None:
        return Kind.UNOWNED
    if mine.hash == base:
        return Kind.UPDATE
    return Kind.KEEP if generated == base else Kind.CONFLICT


def plan(
    recorded: Mapping[str, FileRecord], wanted: Mapping[str, Wanted], found: Mapping[str, Found]
) -> tuple[Action, ...]:
    """The actions for all files of a robot, by path; `found` leaves out what is not on disk."""
    actions = []
    for path in sorted(wanted.keys() | recorded.keys()):
        record, target = recorded.get(path), wanted.get(path)
        base = record.base if record else None
        generated = target.hash if target else None
        kind = decide(base, found.get(path, Found()), generated)
        if kind is Kind.FORGET and base is None:
            continue  # it only waited to be written
        known = target or record
        role, owner = (known.role, known.owner) if known else (Role.MODEL, "")
        actions.append(Action(path, kind, role, owner, base, generated))
    return tuple(actions)


def spare(actions: Iterable[Action], stays: Callable[[str, Collection[str]], bool]) -> tuple[Action, ...]:
    """Keep what the user's files need: the record of an edited model, the `package.mo` of a folder with classes.

    `stays(path, gone)` says whether the folder of the `package.mo` at `path` has other classes than those
    of the files in `gone`.
    """
    actions = tuple(actions)
    owners = {action.owner for action in actions if action.kind is Kind.ORPHAN and action.role is Role.MODEL}
    gone = {action.path: action for action in actions if action.kind is Kind.DELETE}
    kept = {path for path, action in gone.items() if action.role is Role.RECORD and action.owner in owners}
    packages = [path for path, action in gone.items() if action.role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):
        if stays(path, gone.keys() - kept):
            kept.add(path)
    return tuple(dataclasses.replace(a, kind=Kind.NEEDED) if a.path in kept else a for a in actions)


def hold(actions: Iterable[Action], numbers_only: Collection[str]) -> tuple[Action, ...]:
    """Structural changes of a robot are all or nothing: with a conflict, they wait.

    What is still written leaves a package that compiles: records of which only numbers change (their
    paths are `numbers_only`), imported files, and files that are put back as they were.
    """
    actions = tuple(actions)
    if not any(action.kind in CONFLICTS for action in actions):
        return actions
    return tuple(
        dataclasses.replace(action, held=True) if action.writes and not _harmless(action, numbers_only) else action
        for action in actions
    )


def _harmless(action: Action, numbers_only: Collection[str]) -> bool:
    if action.role is Role.IMPORT:
        return action.kind is not Kind.DELETE
    if action.kind is Kind.RESTORE:
        return action.role is not Role.ORDER and action.base == action.generated
    return action.kind is Kind.UPDATE and action.role is Role.RECORD and action.path in numbers_only


def after(actions: Iterable[Action]) -> dict[str, FileRecord]:
    """What the manifest says of each file once the actions are done."""
    records = {}
    for action in actions:
        if action.role is not Role.ORDER and (record := _after(action)) is not None:
            records[action.path] = record
    return records


def _after(action: Action) -> FileRecord | None:
    base = action.base
    if action.held:
        state = State.WAITING
    elif action.kind in CONFLICTS:
        state = State.CONFLICT
    elif action.kind is Kind.KEEP:
        state = State.EDITED
    elif action.kind in (Kind.ORPHAN, Kind.NEEDED):
        state = State.ORPHAN
    elif action.generated is None:
        return None
    else:
        state, base = State.GENERATED, action.generated
    return FileRecord(action.owner, action.role, base, state)


_LITERAL = re.compile(
    r"""
    "(?:[^"\\]|\\.)*"                        # a string
    | (?:[-+]\s*)?(?:
        Modelica\.Constants\.inf\b           # stands for a limit that is absent
        | (?<![\w.])\d+(?:\.\d*)?(?:[eE][-+]?\d+)?
      )
    """,
    re.VERBOSE | re.DOTALL,
)


def numbers_only(old: str, new: str) -> bool:
    """Whether two texts differ in the values of number and string literals at most."""
    return _shape(old) == _shape(new)


def _shape(text: str) -> str:
    return _LITERAL.sub(lambda match: '""' if match[0].startswith('"') else "0", text.replace("\r\n", "\n"))
