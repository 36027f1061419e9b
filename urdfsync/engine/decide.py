"""The decision about one robot's package: looks at its files, applies the rules, and resolves conflicts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine import united
from urdfsync.engine.actions import DISPUTED, ORPHANS, Action, Actions, Reason
from urdfsync.engine.conflicts import MERGES, PREFERENCES, Conflict, find_conflict, resolve
from urdfsync.engine.fit import Misfit, Package, find_misfits
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.needed import keep_needed
from urdfsync.engine.package_files import PackageFiles
from urdfsync.engine.package_names import renamed_names
from urdfsync.engine.parents import SharedFile, merge_order
from urdfsync.engine.rules import File, decide, put_off, valid_choices
from urdfsync.engine.undo import apply_undo, former_names
from urdfsync.files import shown
from urdfsync.markers import find_markers, join_sides
from urdfsync.modelica.files import class_parts
from urdfsync.modelica.layout import with_within
from urdfsync.modelica.literals import numbers_only
from urdfsync.modelica.names import is_identifier
from urdfsync.state.record import Choice, UsersChoice, role_of


class Decision(msgspec.Struct, frozen=True):
    """All actions of one robot, and what there is to say about them."""

    actions: Actions
    texts: Mapping[str, str]
    """New texts of every `package.order` and of merged files, by key."""
    disputed: Mapping[str, Conflict] = {}
    """The texts of files that both sides changed, and of edited ones that move, by key."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of files around the package."""
    misfits: tuple[Misfit, ...] = ()
    """Names in the user's files that mean nothing, and texts that are no Modelica."""

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """The texts of the files in conflict."""
        keys = [action.path for action in self.actions if action.is_conflict]
        return tuple(self.disputed[key] for key in keys if key in self.disputed)

    @property
    def is_complete(self) -> bool:
        """Whether nothing conflicts and nothing waits."""
        return not any(action.is_waiting or action.is_conflict for action in self.actions)


def decide_package(generation: Generation) -> Decision:
    """Decide on every file of a robot.

    Raises OutputError for what can't be worked with, such as links or merge markers.
    """
    inputs, files, last = generation.inputs, generation.inputs.files, generation.inputs.last
    actions = tuple(_adjust(generation, action) for action in decide(_find_files(generation), generation.moves))
    chosen = valid_choices(inputs.options.choices, actions)
    actions, undone = apply_undo(inputs, actions, chosen)

    disputed = [action for action in actions if action.reason in DISPUTED and action.role is not Role.IMPORT]
    names = _renamed(generation) if disputed else {}
    conflicts = {one.path: _conflict(generation, one, names) for one in disputed}
    pending = last.record.open.choices if last.record.open else {}
    # what is in a former folder has its key there
    pending = {path if path in last.files else inputs.folder.key(path): choice for path, choice in pending.items()}
    choices = {**valid_choices(pending, actions, is_pending=True), **chosen}
    conflicts, choices = _without_misfits(generation, actions, conflicts, choices)
    actions, merged = resolve(actions, conflicts, choices, merging=inputs.robot.on_conflict == "merge")
    merged |= undone
    actions = tuple(united.settle(action) for action in keep_needed(generation, actions, merged))
    merged |= united.settled_texts(files, actions, merged)

    order_actions, orders, shared = _decide_orders(generation, actions)
    _refuse_markers(files, actions, (key for key, text in orders.items() if find_markers(text)))
    has_conflicts = any(action.is_conflict for action in actions)
    numbers = _renumbered(generation, actions, merged, conflicts) if has_conflicts else ()
    origins = set(generation.moves.values())
    all_actions = Actions(put_off((*actions, *order_actions), numbers, origins, inputs.has_moved))
    waiting = {action.path for action in all_actions if action.is_waiting}
    shared = [file for file in shared if files.key(file.path) not in waiting]
    misfits = find_misfits(generation, all_actions, {**orders, **merged})
    return Decision(all_actions, {**orders, **merged}, conflicts, tuple(shared), tuple(misfits))


def _find_files(generation: Generation) -> dict[str, File]:
    """Return every file that is recorded or generated, as it is on disk, by key."""
    inputs, last = generation.inputs, generation.inputs.last
    files = dict[str, File]()

    def add(key: str, role: Role, owner: str, generated: str | None) -> None:
        on_disk = inputs.files.on_disk(key, role)
        record = last.file(key, role, on_disk, generated)
        is_edited = isinstance(on_disk, str) and on_disk not in (generated, *record.hashes)
        if is_edited and role is not Role.IMPORT and (meaning := united.find_meaning(inputs, key)):
            inputs.files.meanings[key] = meaning
            on_disk = inputs.files.on_disk(key, role)
            record = last.file(key, role, on_disk, generated)
        files[key] = File(role, owner, record, on_disk, generated)

    for path, artifact in generation.package.artifacts.items():
        add(inputs.folder.key(path), artifact.role, artifact.owner, generation.package.hash(path))
    for name, entry in generation.imported.imports.items():
        add(inputs.folder.key(entry.target), Role.IMPORT, name, entry.target_hash)
    before = last.package.artifacts if last.package else {}
    for key in last.files.keys() - files.keys():
        path = last.folder.path(key)
        old = before.get(path)
        add(key, old.role if old else role_of(path), old.owner if old else "", None)
    return files


def _adjust(generation: Generation, action: Action) -> Action:
    """Return the action that contents and options lead to, beyond what hashes say."""
    inputs = generation.inputs
    meaning = inputs.files.meanings.get(action.path)
    if meaning and meaning.contradictions and action.reason is Reason.KEEP:
        return msgspec.structs.replace(action, reason=Reason.CONFLICT)
    if meaning and not meaning.contradictions:
        action = msgspec.structs.replace(action, is_left_by_git=True)
    # the record may be a stranger's, who has put the hash of a file of the user's into it
    if action.reason is Reason.DELETE and action.role is not Role.IMPORT and inputs.last.base(action.base) is None:
        return msgspec.structs.replace(action, reason=Reason.ORPHAN)
    if action.reason is Reason.UNOWNED and inputs.options.adopts:
        return msgspec.structs.replace(action, reason=Reason.KEEP, base=action.generated)
    return action


def _renamed(generation: Generation) -> Mapping[str, str]:
    """Return new names by the old ones, of all that has got another one since the last complete build."""
    changes = generation.changes
    # no name is gone if only numbers changed
    is_structural = changes is None or changes.change_class.rank >= ChangeClass.STRUCTURAL.rank
    if not generation.inputs.last.files or not is_structural:
        return {}
    return renamed_names(generation)


def _conflict(generation: Generation, action: Action, names: Mapping[str, str]) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder now, mine is its `package.mo`."""
    key, files, last = action.origin or action.path, generation.inputs.files, generation.inputs.last
    path = generation.inputs.folder.path(action.path)
    mine, generated = files.text(key), generation.package.content(path).decode()
    record = last.files.get(key)
    hashes = record.hashes if record and action.base in record.hashes else (action.base,)
    bases = [base for sha256 in hashes if (base := last.base(sha256)) is not None]
    if mine is None:
        package = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
        texts = bases[0] if bases else None, package, generated, None
        reason = "you made a folder of the class"
        return Conflict(action.path, *texts, origin=action.origin, rejected=reason)
    if (meaning := files.meanings.get(key)) and meaning.contradictions:
        texts = bases[0] if bases else None, mine, generated, None
        return Conflict(action.path, *texts, origin=action.origin, rejected=united.describe(meaning))
    conflict = find_conflict(action, bases, mine, generated, {**former_names(generation, action), **names})
    if action.origin and action.path.endswith(".mo"):
        package = ".".join((generation.inputs.robot.target.package, *class_parts(path)))
        conflict = msgspec.structs.replace(conflict, kept=with_within(conflict.kept, package))
    return conflict


def _without_misfits(
    generation: Generation,
    actions: Sequence[Action],
    conflicts: dict[str, Conflict],
    choices: dict[str, UsersChoice],
) -> tuple[dict[str, Conflict], dict[str, UsersChoice]]:
    """Return the conflicts without the merges that would bring in what means nothing, and choices without such texts.

    Of contradictions each side is tried in turn: no preference is proposed in vain.
    """
    sound, valid = dict(conflicts), dict(choices)
    for key, reason in _bad_merges(generation, actions, conflicts, choices).items():
        conflict, choice = conflicts[key], choices.get(key)
        if choice and choice.choice in PREFERENCES:
            sound[key] = msgspec.structs.replace(conflict, refused=frozenset({choice.choice}), rejected=reason)
        else:
            merge = conflict.merge.rejected if conflict.merge else None
            sound[key] = msgspec.structs.replace(conflict, merge=merge, rejected=reason)
        if choice and choice.text is not None:
            del valid[key]
    settled = {key for key, choice in choices.items() if choice.choice not in MERGES}
    for side in PREFERENCES:
        open_ = [key for key, one in sound.items() if key not in settled and one.merged(None) is None]
        tried = {key: UsersChoice(side, "") for key in open_ if sound[key].merged(side) is not None}
        bad = _bad_merges(generation, actions, sound, choices | tried) if tried else {}
        for key in bad.keys() & tried.keys():
            sound[key] = msgspec.structs.replace(sound[key], refused=sound[key].refused | {side})
    return sound, valid


def _bad_merges(
    generation: Generation,
    actions: Sequence[Action],
    conflicts: Mapping[str, Conflict],
    choices: Mapping[str, UsersChoice],
) -> dict[str, str]:
    """Return why merges would not be right, by key. All that are possible are taken for that."""
    planned, merged = resolve(actions, conflicts, choices, merging=True)
    if not merged:
        return {}
    package = Package(generation, keep_needed(generation, planned, merged), merged, is_open=True)
    new = package.misfits(merged.keys())
    if not new:
        return {}
    now = Package(generation, [msgspec.structs.replace(one, is_waiting=True) for one in actions], {})
    old = {(one.key, one.fault) for one in now.misfits({one.origin or one.path for one in conflicts.values()})}
    reasons = dict[str, str]()
    for key, conflict in conflicts.items():
        misfits = [one for one in new if one.key == key and (conflict.origin or key, one.fault) not in old]
        choice = choices.get(key)
        text = conflict.merged(choice.choice, choice.text) if choice else conflict.merged(None)
        if misfits and text == merged.get(key) != conflict.mine:
            reasons[key] = f"in the merge, {misfits[0].finding.message} (line {misfits[0].finding.line})"
    return reasons


def _renumbered(
    generation: Generation, actions: Iterable[Action], merged: Mapping[str, str], conflicts: Mapping[str, Conflict]
) -> frozenset[str]:
    """Return the records of which only numbers change, those in conflict included."""
    files, keys = generation.inputs.files, set()
    changes = generation.changes.by_element() if generation.changes else {}
    for action in actions:
        if action.role is not Role.RECORD or action.origin is not None:
            continue
        if action.reason in (Reason.UPDATE, Reason.MERGE):
            generated = generation.package.content(generation.inputs.folder.path(action.path))
            text = merged.get(action.path) or generated.decode()
            if numbers_only(files.text(action.path) or "", text):
                keys.add(action.path)
        elif action.reason is Reason.CONFLICT and (base := conflicts[action.path].base) is not None:
            # the record of a whole robot has no changes of its own: a number in its tables may be its structure
            own = changes.get(action.owner, ())
            is_parameter = own and all(change.change_class.rank <= ChangeClass.PARAMETER.rank for change in own)
            if is_parameter and numbers_only(base, conflicts[action.path].generated):
                keys.add(action.path)
    return frozenset(keys)


def _refuse_markers(files: PackageFiles, actions: Iterable[Action], orders: Iterable[str]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    errors = []
    edited = [a for a in actions if a.mine not in (None, a.base, a.generated) and a.role is not Role.IMPORT]
    # what the branches contradict each other about is told as a conflict, until the user takes what is generated
    told = {a.origin or a.path for a in edited if a.is_conflict or a.choice is Choice.TAKE} & files.meanings.keys()
    for key in dict.fromkeys((*(action.origin or action.path for action in edited), *orders)):
        found = find_markers(files.text(key) or "")
        if found and key not in told:
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(files.path(key))
            errors.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, found[0][1], hint=hint))
    if errors:
        raise OutputError(*errors)


def _recorded_orders(inputs: Inputs) -> dict[str, tuple[str, ...]]:
    """Return the lines of each `package.order` that follow from the last complete build, by key.

    Without its model they are those of the recorded files: their order is lost then.
    """
    last, orders = inputs.last, dict[str, tuple[str, ...]]()
    if last.record.snapshot is None and not last.record.is_united:
        return orders
    if last.package:
        orders = {last.folder.key(path): names for path, names in last.package.orders.items()}
    else:
        for key in last.files:
            folder, _, name = key.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
            if f"{folder}/".startswith(last.folder.key("")) and key.endswith(".mo"):
                order = f"{folder}/package.order"
                orders[order] = (*orders.get(order, ()), name)
    if "." in last.target.package:
        above, _, name = last.folder.rpartition("/")
        orders[f"{above}/package.order" if above else "package.order"] = (name,)
    return {key: names for key, names in orders.items() if inputs.files.is_inside(key)}


def _removable_lines(owned: Mapping[str, tuple[str, ...]], actions: Iterable[Action]) -> dict[str, list[str]]:
    """Return the lines of `package.order` files that urdfsync may remove: not those of classes that stay.

    The line of a class that is deleted goes with it, whoever wrote it.
    """
    lines = {key: list(names) for key, names in owned.items()}
    for action in actions:
        folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        names = lines.get(f"{folder}/package.order")
        if names is None or action.generated is not None:
            continue
        if action.reason in ORPHANS or action.handed_to_user:
            names[:] = [line for line in names if line != name]
        elif action.reason is not Reason.UNDO:
            names.append(name)
    return lines


def _dangling_lines(files: PackageFiles, order: str, text: str) -> list[str]:
    """Return the names in a `package.order` that no class has, and that its `package.mo` does not mention."""
    folder = order.removesuffix("package.order")
    mentioned = re.findall(r"\w+", files.text(f"{folder}package.mo") or "")
    names = {line.strip() for line in text.splitlines()}.difference(mentioned)
    return [name for name in names if is_identifier(name) and not files.has_class(folder, name)]


def _classes_beside(order: str, keys: Iterable[str]) -> list[str]:
    """Return the classes beside a `package.order` that some of these files are for."""
    folder = order.removesuffix("package.order")
    paths = (key.removeprefix(folder).removesuffix("/package.mo") for key in keys if key.startswith(folder))
    return sorted(filter(is_identifier, (path.removesuffix(".mo") for path in paths)))


def _decide_orders(
    generation: Generation, actions: Iterable[Action]
) -> tuple[list[Action], dict[str, str], list[SharedFile]]:
    """Return the actions for `package.order` files and for packages around the robot's, and the new texts of orders.

    Also what to do with the files around the package, that of the last build included.
    """
    inputs, files, robot = generation.inputs, generation.inputs.files, generation.inputs.robot
    recorded = _recorded_orders(inputs)
    desired = {inputs.folder.key(path): names for path, names in generation.package.orders.items()}
    if robot.folder.parent != robot.output and inputs.parents.listed:
        desired[files.key(robot.folder.parent / "package.order")] = (robot.folder.name,)
    removable = _removable_lines(recorded, actions)
    inside = (inputs.folder.key(""), inputs.last.folder.key(""))
    given_back = [action.path for action in actions if action.reason is Reason.UNDO and action.generated is None]
    decided, texts, shared = list[Action](), dict[str, str](), list[SharedFile]()
    for key in sorted(recorded.keys() | desired.keys()):
        old, names, owned = files.text(key), desired.get(key, ()), removable.get(key, [])
        text = old
        if old is not None and inputs.last.record.is_united:
            # the file may be that of one branch, with a class that the other one has renamed
            owned = [*owned, *_dangling_lines(files, key, old)]
        if old is not None and find_markers(old) and united.can_join(files.path(key), old):
            text = join_sides(old)
        if inputs.options.adopts and old is None:  # a new file would hide classes of the user's from tools
            users = _classes_beside(key, files.classes(key.removesuffix("package.order")))
            names = (*names, *(name for name in users if name not in names))
        names = (*names, *_classes_beside(key, given_back))
        new = texts[key] = merge_order(text, names, owned)
        if old is None:
            reason = Reason.FORGET if not new else Reason.RESTORE if key in recorded else Reason.CREATE
        else:
            reason = Reason.UNCHANGED if new == old else Reason.UPDATE if new else Reason.DELETE
        decided.append(Action(key, reason, Role.ORDER, "package"))
        if not key.startswith(inside):
            shared.append(SharedFile(files.path(key), None, names, tuple(owned)))
    for file in inputs.parents.shared:
        key = files.key(file.path)
        if file.content is not None:
            files.on_disk(key, Role.PACKAGE)  # refuses a link in its place
            decided.append(Action(key, Reason.CREATE, Role.PACKAGE, "parent package"))
        elif (old := files.text(key)) != merge_order(old, file.names):
            reason = Reason.CREATE if old is None else Reason.UPDATE
            decided.append(Action(key, reason, Role.ORDER, "parent package"))
    return decided, texts, [*shared, *inputs.parents.shared]
