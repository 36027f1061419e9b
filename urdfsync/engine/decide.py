"""The decision about one robot's package: reads its files, applies the rules, and resolves conflicts."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import msgspec

from urdfsync.dependencies import is_file
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import CONFLICTS, DELETES, DISPUTED, USERS, Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict, find_conflict, resolve
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.parents import SharedFile, merge_order
from urdfsync.engine.rules import DesiredFile, decide, hold, keep_needed, records_after, remembered_choices
from urdfsync.files import shown
from urdfsync.modelica.literals import numbers_only
from urdfsync.state import repair
from urdfsync.state.record import Choice, FileRecord, RecordState

if TYPE_CHECKING:
    from urdfsync.engine.dangling import DanglingNames

_GONE = DELETES | {Kind.ORPHAN, Kind.NEEDED, Kind.FORGET}
"""Actions on files that are not generated any more."""
_MARKER = r"(?m)^(?:<{7}|>{7}) "
"""A merge marker of git; a line of equal signs alone may be an ornament."""


class Decision(msgspec.Struct, frozen=True):
    """All actions of one robot, and what to record when they are done."""

    actions: Actions
    texts: Mapping[str, str]
    """New texts of every `package.order` and of merged files, by key."""
    files: Mapping[str, FileRecord]
    orders: Mapping[str, tuple[str, ...]]
    conflicts: tuple[Conflict, ...] = ()
    """The texts of the files in conflict."""
    shared: tuple[SharedFile, ...] = ()
    """What to do with files around the package."""
    gone: tuple[str, ...] = ()
    """If something waits: what the package loses until nothing does, by dotted names below it."""
    left: Mapping[str, str] = {}
    """Files that renamed elements left, and that wait to be deleted, with their files now; paths below the package."""


def decide_package(inputs: Inputs, generation: Generation | None, names: DanglingNames | None = None) -> Decision:
    """Decide on every file of a robot; without a generation, what the last build recorded is wanted again.

    No merge may use `names` that the package loses. Raises OutputError for what can't be worked with, such as links or
    merge markers.
    """
    files, moves = inputs.files, dict[str, str]()
    recorded = inputs.recorded or inputs.heading("")
    desired_orders = recorded.orders
    if generation is None:
        desired = {
            key: DesiredFile(record.role, record.owner, record.base)
            for key, record in recorded.files.items()
            if record.base is not None and record.state is not RecordState.ORPHAN
        }
    else:
        desired, desired_orders = generation.desired_files(), generation.desired_orders()
        moves = generation.renamed_files()
        if inputs.recovered:  # with `--repair`: what is on disk decides between the sides
            generated = {key: file.hash for key, file in desired.items()}
            places = {**dict.fromkeys(generated, Role.MODEL), **inputs.recovered.roles}
            mine = {key: files.hash(key, role) for key, role in places.items()}
            recorded = repair.rebuilt(inputs.recovered, mine, generated) or inputs.heading("")
    records, owned = inputs.own(recorded)
    roles = {key: record.role for key, record in records.items()} | {key: one.role for key, one in desired.items()}
    on_disk = {key: files.on_disk(key, role) for key, role in roles.items()}
    actions = decide(records, desired, on_disk, moves)

    conflicts: dict[str, Conflict] = {}
    merged: dict[str, str] = {}
    left = _left_files(inputs, records, moves, desired)
    if generation is not None and any(a.kind in DISPUTED or a.kind is Kind.ORPHAN for a in actions):
        disputed = [a for a in actions if a.kind in DISPUTED and a.role is not Role.IMPORT]
        choices = {**remembered_choices(records, actions), **inputs.options.choices}
        staying = _staying(inputs, actions, choices, left)
        conflicts = {action.path: _conflict(generation, names, action, staying) for action in disputed}
        actions, merged = resolve(actions, conflicts, choices, inputs.robot.merging)
    if generation is not None:
        actions = tuple(_stay_behind(generation, action) for action in actions)
    actions = keep_needed(actions, files.has_classes, _mentioned_records(inputs, actions, left, merged))

    old_orders = {key: files.text(key) for key in sorted(owned.keys() | desired_orders.keys())}
    _refuse_markers(inputs, actions, old_orders)
    removable = _removable_lines(owned, actions)
    if inputs.folder != inputs.old_folder:
        removable = _lines_of_gone_classes(inputs, actions, removable)
    order_actions, texts, shared = _decide_orders(inputs, old_orders, removable, desired_orders)
    renumbered: set[str] = set()
    waits = any(action.kind in CONFLICTS for action in actions)
    if generation is not None and waits:
        for action in actions:
            if action.kind in (Kind.UPDATE, Kind.MERGE) and action.role is Role.RECORD:
                text = merged.get(action.path) or generation.content(action.path).decode()
                if numbers_only(files.text(action.path) or "", text):
                    renumbered.add(action.path)
    held = hold((*actions, *order_actions), renumbered)
    waiting = {action.path for action in held if action.held}
    orders = {key: (owned if key in waiting else desired_orders).get(key, ()) for key in old_orders}
    return Decision(
        Actions(held),
        {**texts, **merged},
        records_after(held[: len(actions)]),
        {key: lines for key, lines in orders.items() if lines},
        tuple(conflicts[a.path] for a in actions if a.kind in CONFLICTS and a.path in conflicts),
        tuple(file for file in shared if files.key(file.path) not in waiting),
        tuple(".".join(path) for path in names.gone) if names and waits else (),
        {inputs.path(key): inputs.path(left[key]) for key in waiting & left.keys() - desired.keys()},
    )


def _stay_behind(generation: Generation, action: Action) -> Action:
    """Return what to do with a file of a former folder: only what can be rendered is deleted."""
    inputs = generation.inputs
    if action.kind not in DELETES or action.path.startswith(f"{inputs.folder}/") or generation.can_render(action):
        return action
    return msgspec.structs.replace(action, kind=Kind.ORPHAN)


def _lines_of_gone_classes(
    inputs: Inputs, actions: Iterable[Action], lines: Mapping[str, tuple[str, ...]]
) -> dict[str, tuple[str, ...]]:
    """Return the removable lines; in and above a former folder only those whose classes are gone, or go now."""
    deleted, inside, found = {one.path for one in actions if one.kind in DELETES}, f"{inputs.folder}/", {}
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


def _staying(
    inputs: Inputs, actions: Sequence[Action], choices: Mapping[str, Choice], left: Collection[str]
) -> list[str]:
    """Return the files that stay the user's, or because he needs them, whatever becomes of the merges.

    A merge may mention them: a record that it mentions is kept.
    """
    leaving = {action.path for action in actions if _is_leaving_record(action, left)}
    without_merges, _ = resolve(actions, {}, choices, merging=False)
    kept = keep_needed(without_merges, inputs.files.has_classes, leaving)
    return [one.path for one in kept if one.kind in (Kind.KEEP, Kind.ORPHAN, Kind.NEEDED) or one.released]


def _conflict(
    generation: Generation, names: DanglingNames | None, action: Action, staying: Collection[str]
) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder now, mine is its `package.mo`.

    `staying` are files that stay the user's, or because he needs them.
    """
    key, files = action.origin or action.path, generation.inputs.files
    mine = files.text(key)
    base = generation.base(key, action.base) if action.base else None
    generated = generation.content(action.path).decode()
    if mine is None:
        package = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
        reason = "you made a folder of the class"
        return Conflict(action.path, action.owner, base, package, generated, None, action.origin, reason)
    conflict = find_conflict(action, base, mine, generated)
    merged = conflict.merge.text if conflict.merge and action.path.endswith(".mo") else None
    use = names.first_use(action.path, merged, staying) if names and merged is not None and merged != mine else None
    if use is None or conflict.merge is None:
        return conflict
    reason = f"the merge mentions `{use.part}`, which the package has no more (line {use.line})"
    return msgspec.structs.replace(conflict, merge=msgspec.structs.replace(conflict.merge, text=None), rejected=reason)


def _left_files(
    inputs: Inputs, records: Mapping[str, FileRecord], moves: Mapping[str, str], desired: Collection[str]
) -> dict[str, str]:
    """Return the files that renamed elements leave, or have left while something waits, with their files now."""
    found = {old: new for new, old in moves.items()}
    recorded = (inputs.model.left or {}) if inputs.model else {}
    # moves of this build; those that wait are no other name of what has come to the old place since
    again = {old: new for new, old in moves.items() if new not in records or records[new].origin != old}
    for old, new in recorded.items():
        key, now = inputs.old_key(old), again.get(inputs.old_key(new), inputs.key(new))
        if now in desired and key in records and records[key].state is RecordState.WAITING:
            found.setdefault(key, now)
    return found


def _is_leaving_record(action: Action, left: Collection[str]) -> bool:
    """Whether a record is no longer generated, and not because a renamed element `left` it."""
    return action.kind is Kind.DELETE and action.role is Role.RECORD and action.path not in left


def _mentioned_records(
    inputs: Inputs, actions: Sequence[Action], left: Collection[str], merged: Mapping[str, str]
) -> frozenset[str]:
    """Return the records that are no longer generated and that a text of the user's mentions, edited files included.

    Those that a renamed element `left` are not needed: the user is told the new name.
    """
    files = inputs.files
    leaving = [action.path for action in actions if _is_leaving_record(action, left)]
    if not leaving:
        return frozenset()
    from urdfsync.engine.dangling import class_of, code_words

    edited = (action for action in actions if action.kind in USERS)
    texts = list(inputs.users_classes(edited, actions, merged).values())
    around = files.users_files({inputs.folder, inputs.old_folder})
    texts += [content.decode(errors="replace") for content in around.values()]
    used = {word for text in texts for word in code_words(text)}
    return frozenset(path for path in leaving if class_of(path) in used)


def _refuse_markers(inputs: Inputs, actions: Iterable[Action], orders: Mapping[str, str | None]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    files, found = inputs.files, []
    edited = [a for a in actions if a.mine not in (None, a.base, a.generated) and a.role is not Role.IMPORT]
    keys = [action.origin or action.path for action in edited]
    for key, text in {**{key: files.text(key) for key in keys}, **orders}.items():
        if text and (match := re.search(_MARKER, text)):
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
    lines = {key: list(names) for key, names in owned.items()}
    staying = set()
    for action in actions:
        folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        if action.kind in (Kind.ORPHAN, Kind.NEEDED) or (action.kind in _GONE and action.released):
            staying.add((f"{folder}/package.order", name))
        elif action.kind in _GONE and f"{folder}/package.order" in lines:
            lines[f"{folder}/package.order"].append(name)
    return {key: tuple(name for name in names if (key, name) not in staying) for key, names in lines.items()}


def _decide_orders(
    inputs: Inputs,
    old_texts: Mapping[str, str | None],
    removable: Mapping[str, tuple[str, ...]],
    desired: Mapping[str, tuple[str, ...]],
) -> tuple[list[Action], dict[str, str], list[SharedFile]]:
    """Return the actions for `package.order` files and for packages around the robot's, and the new texts of orders.

    Also what to do with the files around the package, that of the last build included.
    """
    files, inside = inputs.files, (f"{inputs.folder}/", f"{inputs.old_folder}/")
    actions, texts, shared = [], {}, []
    for key, old in old_texts.items():
        names, owned = desired.get(key, ()), removable.get(key, ())
        new = texts[key] = merge_order(old, names, owned)
        if old is None:
            kind = Kind.FORGET if not new else Kind.RESTORE if key in removable else Kind.CREATE
        else:
            kind = Kind.UNCHANGED if new == old else Kind.UPDATE if new else Kind.DELETE
        actions.append(Action(key, kind, Role.ORDER, "package"))
        if not key.startswith(inside):
            shared.append(SharedFile(files.path(key), None, names, owned))
    for one in inputs.parents.shared:
        key = files.key(one.path)
        if one.content is not None:
            files.on_disk(key, Role.PACKAGE)  # refuses a link in its place
            actions.append(Action(key, Kind.CREATE, Role.PACKAGE, "parent package"))
        elif (old := files.text(key)) != merge_order(old, one.names):
            kind = Kind.CREATE if old is None else Kind.UPDATE
            actions.append(Action(key, kind, Role.ORDER, "parent package"))
    return actions, texts, [*shared, *inputs.parents.shared]
