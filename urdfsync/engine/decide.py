"""The decision about one robot's package: reads its files, applies the rules, and resolves conflicts."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role
from urdfsync.engine import package_order
from urdfsync.engine.actions import CONFLICTS, DELETES, DISPUTED, USERS, Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict, find_conflict, reject_merge, resolve
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_files import PackageFiles, encode
from urdfsync.engine.rules import DesiredFile, decide, hold, keep_needed, records_after, remembered_choices
from urdfsync.files import digest, text_digest
from urdfsync.modelica.literals import numbers_only
from urdfsync.state.manifest import Manifest
from urdfsync.state.record import FileRecord
from urdfsync.state.transaction import Change

_GONE = DELETES | {Kind.ORPHAN, Kind.NEEDED, Kind.FORGET}
"""Actions on files that are not generated any more."""
_MARKER = re.compile(r"^(?:<{7}|>{7}) ", re.MULTILINE)
"""A merge marker of git; a line of equal signs alone may be an ornament."""


class DesiredPackage(msgspec.Struct, frozen=True):
    """What a robot's package should have, by key."""

    files: Mapping[str, DesiredFile]
    orders: Mapping[str, tuple[str, ...]]
    """urdfsync's lines of each `package.order`, the parent's included."""
    moves: Mapping[str, str] = msgspec.field(default_factory=dict)
    """New and old key of files whose element was renamed, or whose package moved."""


class SharedFile(msgspec.Struct, frozen=True):
    """A file around the package, in which other robots may have a part: a `package.mo` or a `package.order`.

    It is read again when it is written, so that robots with one parent package can be planned at the same time.
    """

    path: Path
    content: bytes | None = None
    """Content of a `package.mo` that is written if there is none."""
    names: tuple[str, ...] = ()
    """Lines that a `package.order` has to have."""
    owned: tuple[str, ...] = ()
    """Lines of a `package.order` that urdfsync may remove."""

    def change(self, files: PackageFiles) -> Change | None:
        """Return what is left to do, from what is on disk now; None if nothing is."""
        found = files.read_path(self.path)
        if self.content is not None:
            return Change(self.path, self.content, None) if found is None else None
        old = None if found is None else found.decode(errors="surrogateescape")
        new = package_order.merge(old, self.names, self.owned)
        if new == (old or ""):
            return None
        return Change(self.path, encode(new) if new else None, None if found is None else digest(found))


class Decision(msgspec.Struct, frozen=True):
    """All actions of one robot, and what to record when they are done."""

    actions: Actions
    texts: Mapping[str, str]
    """New texts by key: of every `package.order`, of parent packages to create, and of merged files."""
    files: Mapping[str, FileRecord]
    orders: Mapping[str, tuple[str, ...]]
    conflicts: tuple[Conflict, ...] = ()
    """The texts of the files in conflict."""
    shared: tuple[SharedFile, ...] = ()
    """What to do with files around the package."""

    @property
    def has_work(self) -> bool:
        """Whether a file is to be written, or is in conflict."""
        return any(action.writes or action.kind in CONFLICTS for action in self.actions)


@profiling.stage("deciding")
def decide_package(
    inputs: Inputs, manifest: Manifest | None, desired: DesiredPackage, generation: Generation | None
) -> Decision:
    """Decide on every file of a robot; without a generation, files that both sides changed stay in conflict.

    Raises OutputError for what can't be worked with, such as links or merge markers.
    """
    files = inputs.files
    recorded = inputs.own_files(manifest) if manifest else {}
    owned = inputs.own_orders(manifest) if manifest else {}
    roles = {key: record.role for key, record in recorded.items()} | {key: d.role for key, d in desired.files.items()}
    with profiling.stage("looking"):
        on_disk = {key: files.on_disk(key, role) for key, role in roles.items()}
    actions = decide(recorded, desired.files, on_disk, desired.moves)

    conflicts: dict[str, Conflict] = {}
    merged: dict[str, str] = {}
    if generation is not None and any(a.kind in DISPUTED or a.kind is Kind.ORPHAN for a in actions):
        choices = {**remembered_choices(recorded, actions), **inputs.options.choices}
        disputed = [a for a in actions if a.kind in DISPUTED and a.role is not Role.IMPORT]
        conflicts = {action.path: _conflict(files, action, generation) for action in disputed}
        actions, merged = resolve(actions, conflicts, choices, inputs.robot.merging)
        actions = tuple(
            msgspec.structs.replace(a, result=text_digest(encode(merged[a.path]))) if a.path in merged else a
            for a in actions
        )
    actions = keep_needed(actions, files.has_classes, _mentioned_records(inputs, actions, desired, merged))

    order_keys = sorted(owned.keys() | desired.orders.keys())
    order_files = {key: files.text(key) for key in order_keys}
    _refuse_markers(files, actions, order_files)
    removable = _removable_lines(owned, actions)
    order_actions, order_texts = _decide_orders(order_files, removable, desired.orders)
    parent_actions, parent_texts = _decide_parents(inputs)
    held = hold(
        (*actions, *order_actions, *parent_actions),
        _numbers_only(files, (*actions, *order_actions), merged, generation),
    )
    waiting = {action.path for action in held if action.held}
    orders = {key: (owned if key in waiting else desired.orders).get(key, ()) for key in order_keys}
    in_conflict = {action.path for action in held if action.kind in CONFLICTS}
    shared = _shared_files(inputs, desired, removable)
    return Decision(
        Actions(held),
        {**order_texts, **parent_texts, **merged},
        records_after(held[: len(actions)]),
        {key: names for key, names in orders.items() if names},
        tuple(conflict for path, conflict in sorted(conflicts.items()) if path in in_conflict),
        tuple(file for file in shared if files.key(file.path) not in waiting),
    )


def _conflict(files: PackageFiles, action: Action, generation: Generation) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder now, mine is its `package.mo`."""
    key = action.origin or action.path
    mine = files.text(key)
    base = generation.base(key, action.base) if action.base else None
    generated = generation.content(action.path).decode()
    if mine is None:
        package = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
        reason = "you made a folder of the class"
        return Conflict(action.path, action.owner, base, package, generated, None, action.origin, reason)
    conflict = find_conflict(action, base, mine, generated)
    merged = conflict.merge.text if conflict.merge and action.path.endswith(".mo") else None
    use = generation.lost_use(action.path, merged) if merged is not None and merged != mine else None
    return reject_merge(conflict, *use) if use else conflict


def _mentioned_records(
    inputs: Inputs, actions: Sequence[Action], desired: DesiredPackage, merged: Mapping[str, str]
) -> frozenset[str]:
    """Return the records that are no longer generated and that a text of the user's mentions, edited files included.

    The record of a renamed element is not needed: the user is told the new name.
    """
    files, moved = inputs.files, set(desired.moves.values())
    leaving = [a.path for a in actions if a.kind is Kind.DELETE and a.role is Role.RECORD and a.path not in moved]
    if not leaving:
        return frozenset()
    from urdfsync.engine.dangling import code_words  # hardly any build takes a record away

    known = {action.path: action.kind for action in actions}
    edited = [path for path, kind in known.items() if kind in USERS]
    own = files.classes(inputs.folder) - known.keys()
    texts = [merged.get(key) or files.any_text(key) for key in (*edited, *sorted(own))]
    around = files.users_files({inputs.folder, inputs.old_folder})
    texts += [content.decode(errors="replace") for content in around.values()]
    used = {word for text in texts for word in code_words(text)}
    return frozenset(path for path in leaving if path.rpartition("/")[2].removesuffix(".mo") in used)


def _refuse_markers(files: PackageFiles, actions: Iterable[Action], orders: Mapping[str, str | None]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    edited = [action for action in actions if action.mine not in (None, action.base, action.generated)]
    keys = [action.origin or action.path for action in edited if action.role is not Role.IMPORT]
    found = []
    for key, text in {**{key: files.text(key) for key in keys}, **orders}.items():
        if text and (match := _MARKER.search(text)):
            line = text.count("\n", 0, match.start()) + 1
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(files.path(key))
            found.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, line, hint=hint))
    if found:
        raise OutputError(*found)


def _removable_lines(owned: Mapping[str, tuple[str, ...]], actions: Iterable[Action]) -> dict[str, tuple[str, ...]]:
    """Return the lines of `package.order` files that urdfsync may remove: not those of edited classes that stay.

    The line of a class that is deleted goes with it, whoever wrote it.
    """
    staying: dict[str, set[str]] = {}
    gone: dict[str, list[str]] = {}
    for action in actions:
        if action.kind in _GONE:
            folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
            if action.kind in (Kind.ORPHAN, Kind.NEEDED) or action.released:
                staying.setdefault(f"{folder}/package.order", set()).add(name)
            else:
                gone.setdefault(f"{folder}/package.order", []).append(name)
    return {
        key: tuple(name for name in (*names, *gone.get(key, ())) if name not in staying.get(key, ()))
        for key, names in owned.items()
    }


def _decide_orders(
    files: Mapping[str, str | None], owned: Mapping[str, tuple[str, ...]], desired: Mapping[str, tuple[str, ...]]
) -> tuple[list[Action], dict[str, str]]:
    """Return the actions for `package.order` files, from their texts, and their new texts."""
    actions, texts = [], {}
    for key, old in files.items():
        new = package_order.merge(old, desired.get(key, ()), owned.get(key, ()))
        if old is None:
            kind = Kind.FORGET if not new else Kind.RESTORE if key in owned else Kind.CREATE
        else:
            kind = Kind.UNCHANGED if new == old else Kind.UPDATE if new else Kind.DELETE
        actions.append(Action(key, kind, Role.ORDER, "package"))
        texts[key] = new
    return actions, texts


def _decide_parents(inputs: Inputs) -> tuple[list[Action], dict[str, str]]:
    """Return the actions for the packages around the robot's, and their new texts."""
    files, actions, texts = inputs.files, [], {}
    for path, content in inputs.parents.created.items():
        files.on_disk(files.key(path), Role.PACKAGE)  # refuses a link in its place
        actions.append(Action(files.key(path), Kind.CREATE, Role.PACKAGE, "parent package"))
        texts[files.key(path)] = content.decode()
    for path, name in inputs.parents.entered.items():
        old = files.text(files.key(path))
        new = package_order.merge(old, [name])
        if new != old:
            kind = Kind.CREATE if old is None else Kind.UPDATE
            actions.append(Action(files.key(path), kind, Role.ORDER, "parent package"))
            texts[files.key(path)] = new
    return actions, texts


def _shared_files(
    inputs: Inputs, desired: DesiredPackage, removable: Mapping[str, tuple[str, ...]]
) -> Iterator[SharedFile]:
    """Return what to do with files around the package, that of the last build included."""
    inside = (f"{inputs.folder}/", f"{inputs.old_folder}/")
    for key in sorted(removable.keys() | desired.orders.keys()):
        if not key.startswith(inside):
            yield SharedFile(inputs.files.path(key), None, desired.orders.get(key, ()), removable.get(key, ()))
    for path, content in inputs.parents.created.items():
        yield SharedFile(path, content)
    for path, name in inputs.parents.entered.items():
        yield SharedFile(path, None, (name,))


def _numbers_only(
    files: PackageFiles, actions: Collection[Action], merged: Mapping[str, str], generation: Generation | None
) -> set[str]:
    """Return the records of which only numbers change; looked for only if something is in conflict."""
    if generation is None or not any(action.kind in CONFLICTS for action in actions):
        return set()
    updates = [a.path for a in actions if a.kind in (Kind.UPDATE, Kind.MERGE) and a.role is Role.RECORD]
    return {
        path
        for path in updates
        if numbers_only(files.text(path) or "", merged.get(path) or generation.content(path).decode())
    }
