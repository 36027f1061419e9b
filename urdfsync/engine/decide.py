"""The decision about one robot's package: reads its files, applies the rules, and resolves conflicts."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence

import msgspec

from urdfsync.dependencies import is_file
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine.actions import DISPUTED, Action, Actions, Kind, Reason
from urdfsync.engine.conflicts import Conflict, find_conflict, resolve
from urdfsync.engine.fit import Misfit, Package, find_misfits
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.parents import SharedFile, merge_order
from urdfsync.engine.rules import decide, hold, keep_needed, remembered_choices, valid_choices
from urdfsync.engine.undo import apply_undo
from urdfsync.files import shown
from urdfsync.modelica.files import class_parts
from urdfsync.modelica.layout import with_within
from urdfsync.modelica.literals import numbers_only
from urdfsync.modelica.names import is_identifier
from urdfsync.state.record import Choice

_GONE = frozenset({Reason.DELETE, Reason.MOVED_AWAY, Reason.ORPHAN, Reason.NEEDED, Reason.FORGET})
"""Actions on files that are not generated any more."""
_MARKER = r"(?m)^(?:<{7,}|>{7,}) "
"""A merge marker of git; a line of equal signs alone may be an ornament."""


class Decision(msgspec.Struct, frozen=True):
    """All actions of one robot, and what there is to say about them."""

    actions: Actions
    texts: Mapping[str, str]
    """New texts of every `package.order` and of merged files, by key."""
    conflicts: tuple[Conflict, ...] = ()
    """The texts of the files in conflict."""
    moved: Mapping[str, Conflict] = {}
    """The texts of edited files that move with their elements, by key."""
    shared: tuple[SharedFile, ...] = ()
    """What to do with files around the package."""
    misfits: tuple[Misfit, ...] = ()
    """What means nothing in the user's files."""

    @property
    def is_complete(self) -> bool:
        """Whether nothing conflicts and nothing waits."""
        return not any(action.held or action.kind is Kind.CONFLICT for action in self.actions)


def decide_package(generation: Generation) -> Decision:
    """Decide on every file of a robot.

    Raises OutputError for what can't be worked with, such as links or merge markers.
    """
    inputs, files = generation.inputs, generation.inputs.files
    recorded, desired, known = inputs.recorded_files, generation.desired_files(), generation.recorded_roles()
    roles = {key: role for key, (role, _) in known.items()} | {key: one.role for key, one in desired.items()}
    users = {key for key, one in recorded.items() if one.is_users} - desired.keys()
    on_disk = {key: files.on_disk(key, role) for key, role in roles.items() if key not in users}
    actions = _leave_strangers(generation, decide(recorded, desired, on_disk, generation.moves, known))
    if inputs.options.adopts:
        actions = tuple(_as_edit(action) if action.reason is Reason.UNOWNED else action for action in actions)
    chosen = valid_choices(inputs.options.choices, actions)
    actions, undone = apply_undo(generation, actions, chosen)

    disputed = [action for action in actions if action.reason in DISPUTED and action.role is not Role.IMPORT]
    names = renamed(generation) if disputed else {}
    conflicts = {one.path: _conflict(generation, one, names) for one in disputed}
    pending = inputs.record.open.choices if inputs.record and inputs.record.open else {}
    keys = {path: path if path in recorded else inputs.key(path) for path, _ in pending}
    remembered = remembered_choices({(keys[path], sides): one for (path, sides), one in pending.items()}, actions)
    choices = {**remembered, **chosen}
    conflicts = _without_misfits(generation, actions, conflicts, choices)
    actions, merged = resolve(actions, conflicts, choices, inputs.robot.merging)
    merged |= undone
    actions = _keep_needed(generation, actions, merged)

    order_actions, orders, shared = _decide_orders(generation, actions)
    _refuse_markers(inputs, actions, orders.keys())
    has_conflicts = any(action.kind is Kind.CONFLICT for action in actions)
    numbers = _renumbered(generation, actions, merged, conflicts) if has_conflicts else ()
    held = Actions(hold((*actions, *order_actions), numbers, set(generation.moves.values()), inputs.has_moved))
    waiting = {action.path for action in held if action.held}
    return Decision(
        held,
        {**orders, **merged},
        tuple(
            conflicts[action.path] for action in actions if action.kind is Kind.CONFLICT and action.path in conflicts
        ),
        {
            action.path: conflicts[action.path]
            for action in actions
            if action.reason is Reason.MOVE and action.path in conflicts
        },
        tuple(file for file in shared if files.key(file.path) not in waiting),
        tuple(find_misfits(generation, held, merged)),
    )


def _as_edit(action: Action) -> Action:
    """Keep a file that urdfsync did not write as an edit of the generated one."""
    return msgspec.structs.replace(action, reason=Reason.KEEP, base=action.generated)


def renamed(generation: Generation) -> Mapping[str, str]:
    """Return new names by the old ones, of all that has got another one since the last complete build."""
    if not _takes_names_away(generation):
        return {}
    from urdfsync.engine.package_names import renamed_names

    return renamed_names(generation)


def _conflict(generation: Generation, action: Action, names: Mapping[str, str]) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder now, mine is its `package.mo`."""
    key, files = action.origin or action.path, generation.inputs.files
    mine, generated = files.text(key), generation.content(action.path).decode()
    record = generation.inputs.recorded_files.get(key)
    hashes = record.hashes if record and action.base in record.hashes else (action.base,)
    bases = [base for one in hashes if one and (base := generation.inputs.base(one)) is not None]
    if mine is not None:
        found = find_conflict(action, bases, mine, generated, names)
        package = ".".join((generation.inputs.robot.target.package, *class_parts(generation.inputs.path(action.path))))
        kept = with_within(found.kept, package) if action.origin and action.path.endswith(".mo") else found.kept
        return msgspec.structs.replace(found, kept=kept, edited=_edited_text(generation.inputs, action))
    package = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
    reason, base = "you made a folder of the class", bases[0] if bases else None
    texts = base, package, generated, None
    return Conflict(action.path, action.owner, *texts, origin=action.origin, rejected=reason)


def _edited_text(inputs: Inputs, action: Action) -> str | None:
    """Return what the user has made of both sides of a file, as they are: now, or while the file waited."""
    if (action.path, action.sides) in inputs.options.choices:
        return inputs.options.edited.get((action.path, action.sides))
    waiting = inputs.record.open.edited if inputs.record and inputs.record.open else {}
    return waiting.get(inputs.path(action.path))


def _leave_strangers(generation: Generation, actions: Iterable[Action]) -> tuple[Action, ...]:
    """Delete in a folder that the package had before only what can be generated here, and leave all else.

    The record may be a stranger's, who has put the hashes of the user's own files into it.
    """
    inputs, now = generation.inputs, generation.imported.imports.values()
    if not inputs.has_moved:
        return tuple(actions)
    imported = {one.target_hash for one in now}

    def is_ours(action: Action) -> bool:
        path = inputs.old_path(action.path)
        if action.role is Role.IMPORT:
            return action.mine in imported
        return generation.is_rendered(path, (action.base or "",))

    return tuple(
        msgspec.structs.replace(action, reason=Reason.ORPHAN)
        if action.kind is Kind.DELETE and action.path.startswith(f"{inputs.old_folder}/") and not is_ours(action)
        else action
        for action in actions
    )


def _takes_names_away(generation: Generation) -> bool:
    """Whether a name may be gone since the last complete build: not if only numbers changed."""
    changes = generation.changes
    return bool(generation.inputs.recorded_files) and (
        changes is None or changes.change_class.rank >= ChangeClass.STRUCTURAL.rank
    )


def _without_misfits(
    generation: Generation,
    actions: Sequence[Action],
    conflicts: dict[str, Conflict],
    choices: Mapping[str, Choice],
) -> dict[str, Conflict]:
    """Return the conflicts without the merges that would bring in what means nothing.

    All merges that are possible are taken for that.
    """
    planned, merged = resolve(actions, conflicts, choices, merging=True)
    if not merged:
        return conflicts
    package = Package(generation, _keep_needed(generation, planned, merged), merged, is_open=True)
    new = package.misfits(merged.keys())
    if not new:
        return conflicts
    now = Package(generation, [msgspec.structs.replace(one, held=True) for one in actions], {})
    old = {(one.key, one.fault) for one in now.misfits({one.origin or one.path for one in conflicts.values()})}
    sound = dict(conflicts)
    for key, conflict in conflicts.items():
        misfits = [one for one in new if one.key == key and (conflict.origin or key, one.fault) not in old]
        if misfits and conflict.merged(choices.get(key)) == merged.get(key) != conflict.mine:
            finding = misfits[0].finding
            merge = conflict.merge.rejected if conflict.merge else None
            reason = f"in the merge, {finding.message} (line {finding.line})"
            sound[key] = msgspec.structs.replace(conflict, merge=merge, edited=None, rejected=reason)
    return sound


def _keep_needed(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> tuple[Action, ...]:
    """Keep what texts of the user's need."""
    used: Collection[str] = ()
    if any(action.reason is Reason.DELETE and action.role is Role.RECORD for action in actions):
        from urdfsync.engine.needed import mentioned_files

        used = mentioned_files(generation, actions, merged)
    return keep_needed(actions, generation.inputs.files.has_classes, used)


def _renumbered(
    generation: Generation, actions: Iterable[Action], merged: Mapping[str, str], conflicts: Mapping[str, Conflict]
) -> frozenset[str]:
    """Return the records of which only numbers change, those in conflict included."""
    files, found = generation.inputs.files, set()
    changes = generation.changes.by_element() if generation.changes else {}
    for action in actions:
        if action.role is not Role.RECORD or action.origin is not None:
            continue
        if action.reason in (Reason.UPDATE, Reason.MERGE):
            text = merged.get(action.path) or generation.content(action.path).decode()
            if numbers_only(files.text(action.path) or "", text):
                found.add(action.path)
        elif action.reason is Reason.CONFLICT and (base := conflicts[action.path].base) is not None:
            # the record of a whole robot has no changes of its own: a number in its tables may be its structure
            own = changes.get(action.owner, ())
            is_parameter = own and all(one.change_class.rank <= ChangeClass.PARAMETER.rank for one in own)
            if is_parameter and numbers_only(base, conflicts[action.path].generated):
                found.add(action.path)
    return frozenset(found)


def _refuse_markers(inputs: Inputs, actions: Iterable[Action], orders: Iterable[str]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    files, found = inputs.files, []
    edited = [a for a in actions if a.mine not in (None, a.base, a.generated) and a.role is not Role.IMPORT]
    for key in dict.fromkeys((*(action.origin or action.path for action in edited), *orders)):
        text = files.text(key)
        if text and (match := re.search(_MARKER, text)):
            line = text.count("\n", 0, match.start()) + 1
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(files.path(key))
            found.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, line, hint=hint))
    if found:
        raise OutputError(*found)


def _removable_lines(owned: Mapping[str, tuple[str, ...]], actions: Iterable[Action]) -> dict[str, tuple[str, ...]]:
    """Return the lines of `package.order` files that urdfsync may remove: not those of classes that stay.

    The line of a class that is deleted goes with it, whoever wrote it.
    """
    lines = {key: list(names) for key, names in owned.items()}
    staying = set()
    for action in actions:
        folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        if action.reason in (Reason.ORPHAN, Reason.NEEDED) or (action.reason in _GONE and action.handed_to_user):
            staying.add((f"{folder}/package.order", name))
        elif action.reason in _GONE and f"{folder}/package.order" in lines:
            lines[f"{folder}/package.order"].append(name)
    return {key: tuple(name for name in names if (key, name) not in staying) for key, names in lines.items()}


def _lines_of_gone_classes(
    inputs: Inputs, actions: Iterable[Action], lines: Mapping[str, tuple[str, ...]]
) -> dict[str, tuple[str, ...]]:
    """Return the removable lines; in and above a former folder only those whose classes are gone, or go now."""
    deleted, inside, found = {one.path for one in actions if one.kind is Kind.DELETE}, f"{inputs.folder}/", {}
    for key, names in lines.items():
        folder = key.removesuffix("package.order")
        files = {name: (f"{folder}{name}.mo", f"{folder}{name}/package.mo") for name in names}
        standing = {
            name
            for name, keys in files.items()
            if any(one not in deleted and is_file(inputs.files.path(one)) for one in keys)
        }
        found[key] = names if key.startswith(inside) else tuple(name for name in names if name not in standing)
    return found


def _users_classes(inputs: Inputs, order: str, names: Collection[str]) -> list[str]:
    """Return the classes beside a new `package.order` that are not generated: it would hide them from tools."""
    folder = order.removesuffix("package.order")
    paths = (key.removeprefix(folder).removesuffix("/package.mo") for key in inputs.files.classes(folder))
    found = {path.removesuffix(".mo") for path in paths if "/" not in path} - {"package"}
    return sorted(name for name in found.difference(names) if is_identifier(name))


def _returning_classes(actions: Iterable[Action], order: str) -> list[str]:
    """Return the classes beside a `package.order` that a build deleted, and that are given back now."""
    files = (one.path for one in actions if one.reason is Reason.UNDO and one.generated is None)
    folder = order.removesuffix("package.order")
    names = (path.removeprefix(folder).removesuffix(".mo") for path in files if path.startswith(folder))
    return [name for name in names if is_identifier(name)]


def _decide_orders(
    generation: Generation, actions: Iterable[Action]
) -> tuple[list[Action], dict[str, str], list[SharedFile]]:
    """Return the actions for `package.order` files and for packages around the robot's, and the new texts of orders.

    Also what to do with the files around the package, that of the last build included.
    """
    inputs, files = generation.inputs, generation.inputs.files
    recorded, desired = generation.recorded_orders(), generation.desired_orders()
    removable = _removable_lines(recorded, actions)
    if inputs.has_moved:
        removable = _lines_of_gone_classes(inputs, actions, removable)
    inside = (f"{inputs.folder}/", f"{inputs.old_folder}/")
    found, texts, shared = list[Action](), dict[str, str](), list[SharedFile]()
    for key in sorted(recorded.keys() | desired.keys()):
        old, names, owned = files.text(key), desired.get(key, ()), removable.get(key, ())
        if inputs.options.adopts and old is None:
            names = (*names, *_users_classes(inputs, key, names))
        names = (*names, *_returning_classes(actions, key))
        new = texts[key] = merge_order(old, names, owned)
        if old is None:
            kind = Reason.FORGET if not new else Reason.RESTORE if key in recorded else Reason.CREATE
        else:
            kind = Reason.UNCHANGED if new == old else Reason.UPDATE if new else Reason.DELETE
        found.append(Action(key, kind, Role.ORDER, "package"))
        if not key.startswith(inside):
            shared.append(SharedFile(files.path(key), None, names, owned))
    for one in inputs.parents.shared:
        key = files.key(one.path)
        if one.content is not None:
            files.on_disk(key, Role.PACKAGE)  # refuses a link in its place
            found.append(Action(key, Reason.CREATE, Role.PACKAGE, "parent package"))
        elif (old := files.text(key)) != merge_order(old, one.names):
            kind = Reason.CREATE if old is None else Reason.UPDATE
            found.append(Action(key, kind, Role.ORDER, "parent package"))
    return found, texts, [*shared, *inputs.parents.shared]
