"""Looks at what is on disk and plans: the shell around `plan` and `order`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Protocol, TypeVar

import msgspec

from urdfsync import order, profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role
from urdfsync.files import text_digest
from urdfsync.modelica.literals import numbers_only
from urdfsync.plan import (
    CONFLICTS,
    DELETES,
    DISPUTED,
    Action,
    Actions,
    FileRecord,
    Kind,
    Wanted,
    after,
    hold,
    is_let_go,
    plan,
    remembered,
    spare,
)
from urdfsync.planning.disk import Disk, encode
from urdfsync.planning.parents import Parents
from urdfsync.planning.shared import Shared
from urdfsync.standoff import Choice, Standoff
from urdfsync.state.manifest import Manifest

USERS = frozenset({Kind.KEEP, Kind.INCLUDED, Kind.MERGE, Kind.MOVE, Kind.CONFLICT, Kind.ORPHAN})
"""Actions on files in which the user's text stays or goes on."""
_LEAVES = DELETES | {Kind.ORPHAN, Kind.NEEDED, Kind.FORGET}
"""Actions on files that the package has no more."""
_Entry = TypeVar("_Entry")

_MARKER = re.compile(r"^(?:<{7}|>{7}) ", re.MULTILINE)
"""What git leaves in a file; a line of equal signs alone may be an ornament."""


class Decision(msgspec.Struct, frozen=True):
    """All actions of one robot, and what to record of files and orders when they are done."""

    actions: Actions
    texts: Mapping[str, str]
    """New text of every `package.order`, of parent packages that have to be made, and of merged files."""
    files: Mapping[str, FileRecord]
    orders: Mapping[str, tuple[str, ...]]
    standoffs: tuple[Standoff, ...] = ()
    """The texts of the files that conflict."""
    shared: tuple[Shared, ...] = ()
    """What has to be done to files around the package."""

    @property
    def others(self) -> Mapping[str, FileRecord]:
        """What to record of all files that are not unchanged."""
        unchanged = self.actions.unchanged
        return {key: record for key, record in self.files.items() if key not in unchanged} if unchanged else self.files


class Aim(msgspec.Struct, frozen=True):
    """What a robot's package should be, and what the user wants where that is in doubt; paths as in the manifest."""

    wanted: Mapping[str, Wanted]
    """Without the files that stay."""
    orders: Mapping[str, tuple[str, ...]]
    parents: Parents
    folder: str
    """The package's."""
    stay: Mapping[str, FileRecord] = msgspec.field(default_factory=dict)
    """The plain records of files that are wanted just as they are recorded; none of them is part of a move."""
    moves: Mapping[str, str] = msgspec.field(default_factory=dict)
    """New and old path of files whose element has another name."""
    choices: Mapping[str, Choice] = msgspec.field(default_factory=dict)
    merging: bool = False
    """Whether clean merges are welcome without being asked for."""


class Texts(Protocol):
    """The texts that a decision may need; each is rendered at most once, and only if asked for."""

    def generated(self, key: str) -> str:
        """What would be written to a file."""
        ...

    def base(self, key: str, digest: str) -> str | None:
        """What was written last to a file, by its hash; None if that is lost."""
        ...

    def lost_use(self, key: str, text: str) -> tuple[str, int] | None:
        """The first name in a text for a file that the package loses, with its line; None if there is none."""
        ...


def decide(disk: Disk, manifest: Manifest | None, aim: Aim, texts: Texts | None) -> Decision:
    """Plan every file of a robot; without texts, nothing that both sides changed is settled.

    Only what is not as recorded, or not to stay so, is decided on.
    """
    files = manifest.files if manifest else {}
    with profiling.stage("looking"):
        unchanged = disk.unchanged(aim.stay)
    rest = {key: record for key, record in files.items() if key not in unchanged}
    recorded = dict(_reached(disk, rest, manifest.folder)) if manifest else {}
    owned = dict(_reached(disk, manifest.orders, manifest.folder)) if manifest else {}
    again = {key: Wanted.again(record) for key, record in aim.stay.items() if key not in unchanged}
    wanted = {**again, **aim.wanted} if again else aim.wanted
    roles = {key: record.role for key, record in recorded.items()} | {key: w.role for key, w in wanted.items()}
    with profiling.stage("looking"):
        found = {key: disk.found(key, role) for key, role in roles.items()}
    planned = plan(recorded, wanted, found, aim.moves)
    choices = {**remembered(recorded, planned), **aim.choices}
    aim = msgspec.structs.replace(aim, choices=choices)
    open_ = texts is not None and any(action.kind in DISPUTED or action.kind is Kind.ORPHAN for action in planned)
    actions, standoffs, merged = _settle(disk, planned, aim, texts) if texts and open_ else (planned, {}, {})
    actions = spare(
        actions, disk.has_classes, _needed(disk, actions, aim, merged, [manifest.folder] if manifest else [])
    )
    order_files = {key: disk.text(key) for key in sorted(owned.keys() | aim.orders.keys())}
    _refuse_markers(disk, actions, order_files)
    ours = _ours(owned, actions)
    order_actions, order_texts = _plan_orders(order_files, ours, aim.orders)
    extra, extra_texts = _plan_parents(disk, aim.parents)
    everything = (*actions, *order_actions, *extra)
    held = hold(everything, _renewable(disk, everything, texts, merged))
    records = after(held[: len(actions)])
    waits = {action.path for action in held if action.held}
    keys = owned.keys() | aim.orders.keys()
    names = {key: owned.get(key, ()) if key in waits else aim.orders.get(key, ()) for key in keys}
    conflicts = {action.path for action in held if action.kind in CONFLICTS}
    folders = (aim.folder, manifest.folder if manifest else aim.folder)
    around = [key for key in sorted(keys) if not key.startswith(tuple(f"{folder}/" for folder in folders))]
    return Decision(
        actions=Actions(held, unchanged),
        texts=order_texts | extra_texts | merged,
        files=unchanged | records if unchanged else records,
        orders={key: entry for key, entry in names.items() if entry},
        standoffs=tuple(standoff for path, standoff in sorted(standoffs.items()) if path in conflicts),
        shared=tuple(file for file in _shared(disk, aim, ours, around) if disk.key(file.path) not in waits),
    )


def _needed(
    disk: Disk, actions: Sequence[Action], aim: Aim, merged: Mapping[str, str], folders: Iterable[str]
) -> frozenset[str]:
    """The records that are no longer generated and that a text of the user's mentions, edited files included.

    `folders` are those that the package had before.
    Where the element has another name now, its record is not needed: the user is told the new name.
    """
    moved = set(aim.moves.values())
    going = [a.path for a in actions if a.kind is Kind.DELETE and a.role is Role.RECORD and a.path not in moved]
    if not going:
        return frozenset()
    from urdfsync.planning.dangling import words  # not at the top: hardly any build takes a record away

    known = {action.path: action.kind for action in actions}
    edited = [path for path, kind in known.items() if kind in USERS]
    own = disk.classes(aim.folder) - known.keys() - aim.stay.keys()
    texts = [merged.get(key) or disk.any_text(key) for key in (*edited, *sorted(own))]
    texts += [content.decode(errors="replace") for content in disk.users_files({aim.folder, *folders}).values()]
    used = set().union(*map(words, texts))
    return frozenset(path for path in going if path.rpartition("/")[2].removesuffix(".mo") in used)


def _reached(disk: Disk, entries: Mapping[str, _Entry], folder: str) -> Iterator[tuple[str, _Entry]]:
    """The entries of files that urdfsync may touch; for those of the package's folder that is one question."""
    inside, whole = f"{folder}/", disk.reaches(f"{folder}/package.mo")
    for key, entry in entries.items():
        if whole if key.startswith(inside) else disk.reaches(key):
            yield key, entry


def _refuse_markers(disk: Disk, actions: Iterable[Action], orders: Mapping[str, str | None]) -> None:
    """Refuse to work with files in which version control has left its merge markers. Raises OutputError."""
    edited = [action for action in actions if action.mine not in (None, action.base, action.generated)]
    keys = [action.origin or action.path for action in edited if action.role is not Role.IMPORT]
    found = []
    for key, text in {**{key: disk.text(key) for key in keys}, **orders}.items():
        if text and (match := _MARKER.search(text)):
            line = text.count("\n", 0, match.start()) + 1
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(disk.path(key))
            found.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, line, hint=hint))
    if found:
        raise OutputError(*found)


def _ours(owned: Mapping[str, tuple[str, ...]], actions: Iterable[Action]) -> dict[str, tuple[str, ...]]:
    """The lines of `package.order` files that urdfsync may take away: not those of edited classes that stay.

    A class that is deleted takes its line along, whoever wrote that.
    """
    stay: dict[str, set[str]] = {}
    gone: dict[str, list[str]] = {}
    for action in actions:
        if action.kind not in _LEAVES:
            continue
        folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        if action.kind in (Kind.ORPHAN, Kind.NEEDED) or is_let_go(action):
            stay.setdefault(f"{folder}/package.order", set()).add(name)
        else:
            gone.setdefault(f"{folder}/package.order", []).append(name)
    return {
        key: tuple(name for name in (*names, *gone.get(key, ())) if name not in stay.get(key, ()))
        for key, names in owned.items()
    }


def _shared(disk: Disk, aim: Aim, owned: Mapping[str, tuple[str, ...]], around: Iterable[str]) -> Iterator[Shared]:
    """What has to be done to files around the package; `around` are its `package.order` files."""
    for key in around:
        yield Shared(disk.path(key), None, aim.orders.get(key, ()), owned.get(key, ()))
    for path, content in aim.parents.created.items():
        yield Shared(path, content)
    for path, name in aim.parents.entered.items():
        yield Shared(path, None, (name,))


def _settle(
    disk: Disk, planned: tuple[Action, ...], aim: Aim, texts: Texts
) -> tuple[tuple[Action, ...], dict[str, Standoff], dict[str, str]]:
    """The actions after what both sides changed is settled as far as it can be, its texts, and the merged ones."""
    from urdfsync.settle import settle  # not at the top: most builds have nothing to merge

    disputed = [action for action in planned if action.kind in DISPUTED and action.role is not Role.IMPORT]
    standoffs = {action.path: _standoff(disk, action, texts) for action in disputed}
    actions, merged = [], {}
    for action, text in settle(planned, standoffs, aim.choices, aim.merging):
        if text is None:
            actions.append(action)
        else:
            merged[action.path] = text
            actions.append(msgspec.structs.replace(action, result=text_digest(encode(text))))
    return tuple(actions), standoffs, merged


def _standoff(disk: Disk, action: Action, texts: Texts) -> Standoff:
    """The texts of a file that both sides changed; of a class that is a folder now, the user's is its `package.mo`."""
    from urdfsync.settle import reject_merge, stand_off

    place = action.origin or action.path
    mine = disk.text(place)
    base = texts.base(place, action.base) if action.base else None
    generated = texts.generated(action.path)
    if mine is not None:
        standoff = stand_off(action, base, mine, generated)
        merged = standoff.merge.text if standoff.merge and action.path.endswith(".mo") else None
        use = texts.lost_use(action.path, merged) if merged is not None and merged != mine else None
        return reject_merge(standoff, *use) if use else standoff
    package = disk.text(f"{place.removesuffix('.mo')}/package.mo")
    reason = "you made a folder of the class"
    return Standoff(action.path, action.owner, base, package or "", generated, None, rejected=reason)


def _plan_orders(
    files: Mapping[str, str | None], owned: Mapping[str, tuple[str, ...]], wanted: Mapping[str, tuple[str, ...]]
) -> tuple[list[Action], dict[str, str]]:
    """The actions for `package.order` files, from their texts, and their new texts."""
    actions, texts = [], {}
    for key, old in files.items():
        new = order.merge(old, wanted.get(key, ()), owned.get(key, ()))
        if old is None:
            kind = Kind.FORGET if not new else Kind.RESTORE if key in owned else Kind.CREATE
        else:
            kind = Kind.UNCHANGED if new == old else Kind.UPDATE if new else Kind.DELETE
        actions.append(Action(key, kind, Role.ORDER, "package"))
        texts[key] = new
    return actions, texts


def _plan_parents(disk: Disk, parents: Parents) -> tuple[list[Action], dict[str, str]]:
    actions, texts = [], {}
    for path, content in parents.created.items():
        disk.found(disk.key(path), Role.PACKAGE)
        actions.append(Action(disk.key(path), Kind.CREATE, Role.PACKAGE, "parent package"))
        texts[disk.key(path)] = content.decode()
    for path, name in parents.entered.items():
        old = disk.text(disk.key(path))
        new = order.merge(old, [name])
        if new != old:
            kind = Kind.CREATE if old is None else Kind.UPDATE
            actions.append(Action(disk.key(path), kind, Role.ORDER, "parent package"))
            texts[disk.key(path)] = new
    return actions, texts


def _renewable(disk: Disk, actions: tuple[Action, ...], texts: Texts | None, merged: Mapping[str, str]) -> set[str]:
    """The records of which only numbers change; looked for only if something conflicts."""
    if texts is None or not any(action.kind in CONFLICTS for action in actions):
        return set()
    updates = [a.path for a in actions if a.kind in (Kind.UPDATE, Kind.MERGE) and a.role is Role.RECORD]
    return {path for path in updates if numbers_only(disk.text(path) or "", merged.get(path) or texts.generated(path))}
