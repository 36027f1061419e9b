"""Decides on the `package.order` files of a robot's package and of the packages around it."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence

from urdfsync.common.dependencies.reads import is_file
from urdfsync.domain import Role
from urdfsync.engine.actions import ORPHANS, Action, Choice, Reason, find_deletions
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.parents import SharedFile, merge_order
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.markers import join_sides
from urdfsync.modelica.names import is_identifier


def decide_orders(inputs: Inputs, package: Package, decision: Decision) -> Decision:
    """Decide on the `package.order` files, and on the packages around the robot's."""
    files, robot, actions = inputs.files, inputs.robot, decision.actions
    is_same = not (decision.differences.is_structural or inputs.has_moved)
    recorded = _recorded_orders(inputs, package if is_same else inputs.last.package)
    desired = {inputs.folder.key(path): names for path, names in package.orders.items()}
    if robot.folder.parent != robot.output and inputs.parents.listed:
        desired[files.key(robot.folder.parent / "package.order")] = (robot.folder.name,)
    inside = (inputs.folder.key(""), inputs.last.folder.key(""))
    decided, texts, shared = [*actions], dict(decision.texts), list[SharedFile]()
    for key in sorted(recorded.keys() | desired.keys()):
        old, written, generated = files.text(key), recorded.get(key, ()), desired.get(key, ())
        text = None if old is None else join_sides(old)  # lines of both sides of a merge may stand together
        names = _wanted_lines(inputs, key, generated, written, actions)
        owned = () if text is None else _owned_lines(inputs, key, text, generated, written, actions)
        texts[key] = merge_order(text, names, owned)
        reason = _order_reason(old, texts[key], is_recorded=key in recorded)
        decided.append(Action(key, reason, Role.ORDER, "package"))
        if not key.startswith(inside):
            shared.append(SharedFile(files.path(key), None, names, owned, joins=text != old))
    for file in inputs.parents.shared:
        key = files.key(file.path)
        if file.content is not None:
            files.on_disk(key, Role.PACKAGE)  # raises OutputError for a link
            decided.append(Action(key, Reason.CREATE, Role.PACKAGE, "parent package"))
        elif (old := files.text(key)) != merge_order(old, file.names):
            reason = Reason.CREATE if old is None else Reason.UPDATE
            decided.append(Action(key, reason, Role.ORDER, "parent package"))
    return decision.with_actions(decided, texts=texts, shared=(*shared, *inputs.parents.shared))


def _recorded_orders(inputs: Inputs, package: Package | None) -> dict[str, Collection[str]]:
    """Return the lines of each `package.order` that the last build wrote, by key, in their order.

    `package` is the package of the last build. Without it, the lines follow from the recorded files, in another order.
    """
    last, orders = inputs.last, dict[str, dict[str, None]]()
    if last.record.files and package:
        orders = {last.folder.key(path): dict.fromkeys(names) for path, names in package.orders.items()}
    for key in last.files:
        folder, _, name = key.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        if f"{folder}/".startswith(last.folder.key("")) and key.endswith(".mo"):
            orders.setdefault(f"{folder}/package.order", {})[name] = None
    if "." in last.target.package and last.record.files:
        above, _, name = last.folder.rpartition("/")
        orders[f"{above}/package.order" if above else "package.order"] = {name: None}
    return {key: names for key, names in orders.items() if inputs.files.is_inside(key)}


def _removable_lines(
    inputs: Inputs, order: str, text: str, recorded: Collection[str], actions: Iterable[Action]
) -> list[str]:
    """Return the lines of a `package.order` to remove: deleted classes, and recorded lines without a class.

    A recorded line may name a user's class, so this looks for the class on disk and in `package.mo`. If git has united
    two states, this looks for each line's class: the other branch may have renamed it.
    """
    folder = order.removesuffix("package.order")
    deletions = find_deletions(actions)
    paths = (path.removesuffix("/package.mo").removesuffix(".mo") for path in sorted(deletions))
    deleted = [path.removeprefix(folder) for path in paths if path.rpartition("/")[0] == folder.rstrip("/")]
    listed = {line.strip() for line in text.splitlines()}
    is_united = inputs.last.is_united and order.startswith(inputs.folder.key(""))
    candidates = listed if is_united else listed.intersection(recorded)
    names = filter(is_identifier, candidates.difference(deleted))
    # a killed build may have moved or deleted some files of the package before the others
    files = inputs.files
    missing = [
        name
        for name in names
        if not files.has_class(folder, name)
        or not (is_file(files.path(f"{folder}{name}.mo")) or files.classes(folder + name) - deletions)
    ]
    is_asked = missing and f"{folder}package.mo" not in deletions
    mentioned = set(re.findall(r"\w+", inputs.files.text(f"{folder}package.mo") or "")) if is_asked else set()
    return [*deleted, *(name for name in missing if name not in mentioned)]


def _classes_beside(order: str, keys: Iterable[str]) -> list[str]:
    """Return the names of the classes that these files store in the folder of a `package.order`."""
    folder = order.removesuffix("package.order")
    paths = (key.removeprefix(folder).removesuffix("/package.mo") for key in keys if key.startswith(folder))
    return sorted(filter(is_identifier, (path.removesuffix(".mo") for path in paths)))


def _order_reason(old: str | None, new: str, *, is_recorded: bool) -> Reason:
    """Decide on one `package.order` by its text on disk, None without a file, and its new text, empty for no file."""
    if old is None:
        return Reason.FORGET if not new else Reason.RESTORE if is_recorded else Reason.CREATE
    return Reason.UNCHANGED if new == old else Reason.UPDATE if new else Reason.DELETE


def _wanted_lines(
    inputs: Inputs, key: str, generated: Sequence[str], written: Collection[str], actions: Iterable[Action]
) -> tuple[str, ...]:
    """Return the lines of a `package.order`: those of the generated package, and of classes that no line names."""
    names = dict.fromkeys(generated)
    if inputs.options.adopts and inputs.files.text(key) is None:  # tools hide the user's classes without a line
        names |= dict.fromkeys(_classes_beside(key, inputs.files.classes(key.removesuffix("package.order"))))
    if written:  # `--undo` brought an orphan back, or a class of the user's own
        orphans = {action.path for action in actions if action.reason in ORPHANS}
        undone = {path for path, one in inputs.settled.actions.items() if one.choice is Choice.UNDO}
        undone -= find_deletions(actions)
        names |= dict.fromkeys(_classes_beside(key, {*orphans, *filter(inputs.files.read, undone)}))
    return tuple(names)


def _owned_lines(
    inputs: Inputs,
    key: str,
    text: str,
    generated: Sequence[str],
    written: Collection[str],
    actions: Iterable[Action],
) -> tuple[str, ...]:
    """Return the lines of a `package.order` on disk that a build may move or remove."""
    wanted = set(generated)
    # looking at the disk for all names would take 15 ms with 100 links
    unwanted = [name for name in written if name not in wanted]
    return *(name for name in written if name in wanted), *_removable_lines(inputs, key, text, unwanted, actions)
