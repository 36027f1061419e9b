"""What to do with each file: one decision from what urdfsync wrote last, what is there, and what it would write now.

*Base* is the text that the file on disk last took into account, *mine* what is on disk, *generated*
what would be written. All three are compared by their hashes, never by times.
"""

from __future__ import annotations

import enum
import functools
import hashlib
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import Self, overload

import msgspec

from urdfsync.domain import Role
from urdfsync.moves import Moves
from urdfsync.standoff import Choice


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
    INCLUDED = "included"
    MERGE = "merge"
    MOVE = "move"
    LEAVE = "leave"
    FORGET = "forget"


WRITES = frozenset({Kind.CREATE, Kind.RESTORE, Kind.UPDATE, Kind.DELETE, Kind.MERGE, Kind.MOVE, Kind.LEAVE})
"""Actions that change a file."""
DELETES = frozenset({Kind.DELETE, Kind.LEAVE})
"""Actions that take a file away."""
CONFLICTS = frozenset({Kind.CONFLICT, Kind.UNOWNED})
"""Actions that leave a file alone although something else should be in it."""
DISPUTED = CONFLICTS | {Kind.MOVE}
"""Actions on which the texts decide, or the user."""

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
    Kind.INCLUDED: "you edited it, and it already has what is new",
    Kind.MERGE: "your edits and what is new, merged",
    Kind.MOVE: "its element has another name; your edits move with it",
    Kind.LEAVE: "its element has another name; your edits go to its new file",
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
    origin: str | None = None
    """Path of the element's file, if that has another name now and the file waits to go there."""
    stands: str | None = None
    """Hash of the text of another element that urdfsync wrote here, and that stands here while `origin` waits."""
    choice: Choice | None = None
    """What the user chose for the file, while that waits for another conflict to be resolved."""
    chosen_for: str | None = None
    """Hash over the hashes of both sides: the choice holds as long as neither changes."""

    @property
    def own(self) -> str | None:
        """Hash of what urdfsync wrote at the path itself."""
        return self.stands if self.origin else self.base

    @property
    def plain(self) -> bool:
        """Whether the file is just as generated, and nothing waits: there are thousands of such."""
        waits = self.origin or self.stands or self.choice
        return self.state is State.GENERATED and self.base is not None and not waits


class Found(msgspec.Struct, frozen=True):
    """What is on disk: a file's hash, or None and whether the class is now a folder (`X/package.mo` for `X.mo`)."""

    hash: str | None = None
    as_folder: bool = False


_NO_FILE = Found()


class Wanted(msgspec.Struct, frozen=True):
    """A file that is generated, with its hash."""

    role: Role
    owner: str
    hash: str
    at_hand: bool = True
    """Whether its content can be had; else nothing but the hash is known of it."""

    @classmethod
    def again(cls, record: FileRecord) -> Self:
        """The file of a plain record as it is recorded."""
        return cls(record.role, record.owner, record.base or "")


class Action(msgspec.Struct, frozen=True):
    """What happens to one file (`path` as in the manifest), and the hashes that the decision rests on."""

    path: str
    kind: Kind
    role: Role
    owner: str = ""
    base: str | None = None
    generated: str | None = None
    origin: str | None = None
    """Where the user's file is, if its element has another name now; None if it is at `path`."""
    choice: Choice | None = None
    """What the user chose for it."""
    mine: str | None = None
    """Hash of the file on disk; None if there is none."""
    stands: str | None = None
    """Hash of what urdfsync wrote at `path` for another element, if that is there."""
    result: str | None = None
    """Hash of the text that merges the user's edits with what is new; None if nothing is merged."""
    held: bool = False
    """Put off until the robot's conflicts are resolved."""
    at_hand: bool = True
    """Whether what is generated can be had."""

    @property
    def reason(self) -> str:
        """Why, as the end of a sentence that begins with the path."""
        return _REASONS[self.kind] + ("; waits until the conflict is settled" if self.held else "")

    @property
    def replaceable(self) -> bool:
        """Whether what is generated can take the place of what is there, which must be a file."""
        return self.mine is not None and self.at_hand

    @property
    def writes(self) -> bool:
        """Whether a file changes now."""
        return self.kind in WRITES and not self.held


class Actions(Sequence[Action]):
    """The actions for all files of a robot, in the order of their paths.

    Mostly, nearly all files are as they are recorded and shall stay so. Nothing has to be decided on them, and their
    actions are made when somebody wants to see them.
    """

    def __init__(self, decided: Iterable[Action] = (), unchanged: Mapping[str, FileRecord] | None = None) -> None:
        """`unchanged` are the plain records of files on which nothing was decided."""
        self.decided = tuple(sorted(decided, key=lambda action: action.path))
        """All others."""
        self.unchanged = unchanged or {}

    def __len__(self) -> int:
        return len(self.decided) + len(self.unchanged)

    @overload
    def __getitem__(self, index: int) -> Action: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Action]: ...
    def __getitem__(self, index: int | slice) -> Action | Sequence[Action]:
        return self._all[index]

    def __iter__(self) -> Iterator[Action]:
        return iter(self._all)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Actions) and self._all == other._all

    def __hash__(self) -> int:
        return hash(self._all)

    @functools.cached_property
    def _all(self) -> tuple[Action, ...]:
        unchanged = (
            Action(path, Kind.UNCHANGED, record.role, record.owner, record.base, record.base, mine=record.base)
            for path, record in self.unchanged.items()
        )
        return tuple(sorted((*self.decided, *unchanged), key=lambda action: action.path))


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
    recorded: Mapping[str, FileRecord],
    wanted: Mapping[str, Wanted],
    found: Mapping[str, Found],
    moves: Mapping[str, str] | None = None,
) -> tuple[Action, ...]:
    """The actions for all files of a robot, by path; `found` leaves out what is not on disk.

    `moves` are new and old path of files whose element has another name. A file that the user edited goes
    to the new path (MOVE, and LEAVE at the old one); whether it can, its text has yet to show. A file that the
    user has moved there already is compared with what was written at the old path.
    """
    going = Moves(recorded, found, moves or {})
    actions = []
    for path in sorted(dict.fromkeys((*recorded, *wanted))):  # mostly in order already, as a set is not
        action = _action(path, recorded.get(path), wanted.get(path), found, going)
        if action is not None:
            actions.append(action)
    return tuple(actions)


def _action(
    path: str, record: FileRecord | None, target: Wanted | None, found: Mapping[str, Found], moves: Moves
) -> Action | None:
    """The action for one file; None if it only waited to be written, and is not wanted any more."""
    known = target or record
    role, owner = (known.role, known.owner) if known else (Role.MODEL, "")
    base, mine = record.own if record else None, found.get(path, _NO_FILE)
    generated = target.hash if target else None

    def coming(kind: Kind, origin: str, mine: str | None) -> Action:
        """A file that comes from another place; what stands here is remembered in case that it has to wait."""
        base, stands = moves.base(path, origin), moves.stands(path)
        return Action(path, kind, role, owner, base, generated, origin, mine=mine, stands=stands)

    if target and path in moves.edited:
        return coming(Kind.MOVE, moves.edited[path], found[moves.edited[path]].hash)
    if target and mine.hash != generated and (origin := moves.followed(path)) is not None:
        return coming(Kind.CREATE if mine == Found() else Kind.UPDATE, origin, mine.hash)
    if path in moves.left and target is None:
        return Action(path, Kind.LEAVE, role, owner, base)
    if path in moves.left:
        base, mine = None, Found()
    elif target and (written := moves.moved_by_hand(path)) is not None:
        base = written
    kind = decide(base, mine, generated)
    if kind is Kind.FORGET and base is None:
        return None
    at_hand = target is None or target.at_hand
    return Action(path, kind, role, owner, base, generated, mine=mine.hash, at_hand=at_hand)


def spare(
    actions: Iterable[Action], stays: Callable[[str, Collection[str]], bool], used: Collection[str] = ()
) -> tuple[Action, ...]:
    """Keep what the user's files need: the record of an edited model, the `package.mo` of a folder with classes.

    The record of a model that the user makes his own becomes his own, too. `used` are records that a text of the user's
    mentions.

    `stays(path, gone)` says whether the folder of the `package.mo` at `path` has other classes than those
    of the files in `gone`.
    """
    actions = tuple(actions)
    owners = {action.owner for action in actions if action.kind is Kind.ORPHAN and action.role is Role.MODEL}
    let_go = {action.owner for action in actions if is_let_go(action) and action.role is Role.MODEL} - owners
    gone = {action.path: action for action in actions if action.kind in DELETES}
    kept = {
        path
        for path, action in gone.items()
        if action.kind is Kind.DELETE and action.role is Role.RECORD and (action.owner in owners or path in used)
    }
    free = {path for path, action in gone.items() if action.role is Role.RECORD and action.owner in let_go}
    packages = [path for path, action in gone.items() if action.role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):
        if stays(path, gone.keys() - kept - free):
            kept.add(path)
    needed = (msgspec.structs.replace(a, kind=Kind.NEEDED) if a.path in kept else a for a in actions)
    return tuple(
        msgspec.structs.replace(a, kind=Kind.FORGET, choice=Choice.KEEP) if a.path in free else a for a in needed
    )


def is_let_go(action: Action) -> bool:
    """Whether the user keeps a file that is no longer generated, so that it is none of urdfsync's any more."""
    return action.kind is Kind.FORGET and action.choice is Choice.KEEP


def hold(actions: Iterable[Action], numbers_only: Collection[str]) -> tuple[Action, ...]:
    """Structural changes of a robot are all or nothing: with a conflict, they wait.

    What is still written leaves a package that compiles: records of which only numbers change (their
    paths are `numbers_only`), imported files, and files that are put back as they were.
    """
    actions = tuple(actions)
    if not any(action.kind in CONFLICTS for action in actions):
        return actions
    origins = {action.origin for action in actions}

    def waits(action: Action) -> bool:
        """What comes from another place waits, and what is there stays as it is until then."""
        bound = action.origin is not None or action.path in origins
        return action.writes and (bound or not _harmless(action, numbers_only))

    return tuple(msgspec.structs.replace(action, held=True) if waits(action) else action for action in actions)


def _harmless(action: Action, numbers_only: Collection[str]) -> bool:
    if action.role is Role.IMPORT:
        return action.kind is not Kind.DELETE
    if action.kind is Kind.RESTORE:
        return action.role is not Role.ORDER and action.base == action.generated
    return action.kind in (Kind.UPDATE, Kind.MERGE) and action.role is Role.RECORD and action.path in numbers_only


def after(actions: Iterable[Action]) -> dict[str, FileRecord]:
    """What the manifest says of each file once the actions are done."""
    records = {}
    for action in actions:
        if action.role is not Role.ORDER and (record := _after(action)) is not None:
            records[action.path] = record
    return records


def _after(action: Action) -> FileRecord | None:
    if action.kind is Kind.UNCHANGED:
        return FileRecord(action.owner, action.role, action.generated)
    base = action.base
    if action.held:
        state = State.WAITING
    elif action.kind in CONFLICTS:
        state = State.CONFLICT
    elif action.kind is Kind.KEEP:
        state = State.EDITED
    elif action.kind is Kind.INCLUDED or (action.result or action.generated) != action.generated:
        state, base = State.EDITED, action.generated
    elif action.kind in (Kind.ORPHAN, Kind.NEEDED):
        state = State.ORPHAN
    elif action.generated is None:
        return None
    else:
        state, base = State.GENERATED, action.generated
    waits = state in (State.WAITING, State.CONFLICT)
    chosen_for = both(action.mine, action.generated) if waits and action.choice else None
    choice = action.choice if waits else None
    origin, stands = (action.origin, action.stands) if waits else (None, None)
    return FileRecord(action.owner, action.role, base, state, origin, stands, choice, chosen_for)


def both(mine: str | None, generated: str | None) -> str:
    """One hash for the texts of both sides, from theirs."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


def remembered(recorded: Mapping[str, FileRecord], actions: Iterable[Action]) -> dict[str, Choice]:
    """The recorded choices that still hold."""
    return {
        action.path: record.choice
        for action in actions
        if (record := recorded.get(action.path) or recorded.get(action.origin or "")) is not None
        and record.choice is not None
        and record.chosen_for == both(action.mine, action.generated)
    }
