"""Decides on one robot's package: sorts its files, merges edits, lets the user's texts follow renames."""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterable, Mapping
from typing import TYPE_CHECKING

import msgspec

from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.files import shown
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain.comparison import Changes
from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.differences import Differences, compare_with_last
from urdfsync.engine.decide.followers import follow
from urdfsync.engine.decide.merges import merge_edits
from urdfsync.engine.decide.misfits import look_for_misfits
from urdfsync.engine.decide.orders import decide_orders
from urdfsync.engine.decide.package_after import PackageAfter
from urdfsync.engine.decide.package_names import describe_renames
from urdfsync.engine.decide.rules import put_off
from urdfsync.engine.decide.triage import find_unknown, triage
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.engine.inspect.parents import SharedFile
from urdfsync.modelica.literals import numbers_only
from urdfsync.modelica.markers import find_markers

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit


class Decision(msgspec.Struct, frozen=True, dict=True):
    """All actions of one robot, and the findings about them."""

    differences: Differences
    """The differences from the last complete build; the actions follow from these."""
    actions: Actions
    texts: Mapping[str, str]
    """New texts of every `package.order` and of merged files, by key."""
    doubts: Mapping[str, Doubt] = {}
    """Why edited files may belong to other parts, by key."""
    disputed: Mapping[str, Conflict] = {}
    """Texts of files that both sides changed, and of edited files that move, by key."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of the `package.mo` and `package.order` files around the package."""
    misfits: tuple[Misfit, ...] = ()
    """Unknown names and syntax errors in the user's files."""
    names: Mapping[str, str] = {}
    """New names by old names, from before the choices (see `Triage.names`)."""

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """The texts of the files in conflict."""
        keys = [action.path for action in self.actions if action.is_conflict]
        return tuple(self.disputed[key] for key in keys if key in self.disputed)

    @functools.cached_property  # there are thousands of actions
    def is_complete(self) -> bool:
        """Whether nothing conflicts and nothing waits."""
        return not any(action.is_waiting or action.is_conflict for action in self.actions)


def decide_package(inputs: Inputs, generation: Generation) -> Decision:
    """Decide on every file of a robot. Raises OutputError for links and for merge markers."""
    files, package, differences = inputs.files, generation.package, compare_with_last(inputs, generation)
    triaged = triage(inputs, generation, differences)
    merged = merge_edits(inputs, generation, triaged, differences)
    users_classes = _find_users_classes(inputs, merged.actions)
    followed = follow(inputs, package, merged, users_classes, differences.former)
    actions = followed.actions
    orders = decide_orders(inputs, package, differences, actions)
    _refuse_markers(files, actions, (key for key, text in orders.texts.items() if find_markers(text)))
    value_only_keys: Collection[str] = ()
    # if names were exchanged, each build would move edits again
    if any(action.is_conflict for action in actions) and not differences.has_exchanges:
        after = PackageAfter(inputs, package, actions, followed.texts)
        value_only_keys = _find_value_only(after, differences.changes, followed.conflicts)
    both = (*actions, *orders.actions)
    all_actions = Actions(put_off(both, value_only_keys, has_moved=inputs.has_moved))
    waiting = {action.path for action in all_actions if action.is_waiting}
    texts = {**orders.texts, **followed.texts}
    new_conflicts = followed.conflicts.keys() - merged.conflicts.keys()
    misfits = look_for_misfits(PackageAfter(inputs, package, all_actions, texts))
    return Decision(
        differences,
        all_actions,
        texts,
        triaged.doubts,
        describe_renames(inputs, generation, differences.former, followed.conflicts),
        shared=tuple(file for file in orders.shared if files.key(file.path) not in waiting),
        misfits=tuple(one for one in misfits if one.key not in new_conflicts or one.use is None),
        names=inputs.settled.names or triaged.names,
    )


def _find_users_classes(inputs: Inputs, actions: Iterable[Action]) -> list[Action]:
    """Return an action for each of the user's own classes in the package, which changes nothing."""
    known, files = {key for action in actions for key in (action.path, action.origin) if key}, inputs.files
    return [
        Action(key, Reason.UNKNOWN, Role.MODEL, mine=files.hash(key, Role.MODEL) if files.can_read(key) else None)
        for key in find_unknown(inputs, known)
    ]


def _find_value_only(after: PackageAfter, changes: Changes | None, conflicts: Mapping[str, Conflict]) -> frozenset[str]:
    """Return the records in which only numbers change, including records in conflict."""
    inputs, keys, by_element = after.inputs, set(), changes.by_element() if changes else {}
    for action in after.actions:
        if action.role is not Role.RECORD or action.origin is not None:
            continue
        if action.reason in (Reason.UPDATE, Reason.MERGE):
            text = after[inputs.folder.path(action.path)].decode(errors="surrogateescape")
            if numbers_only(inputs.files.text(action.path) or "", text):
                keys.add(action.path)
        elif action.reason is Reason.CONFLICT and (base := conflicts[action.path].base) is not None:
            # the record of a whole robot owns no change: a number in its tables may be structural
            of_element = by_element.get(action.owner, ())
            ranks = [change.change_class.rank for change in of_element]
            is_parameter = ranks and max(ranks) <= ChangeClass.PARAMETER.rank
            if is_parameter and numbers_only(base, conflicts[action.path].generated):
                keys.add(action.path)
    return frozenset(keys)


def _refuse_markers(files: PackageFiles, actions: Iterable[Action], orders: Iterable[str]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    errors = []
    others = Reason.UPDATE, Reason.UNKNOWN  # a class of the user's own may have markers: `fit` tells its syntax error
    texts = (action for action in actions if action.role is not Role.IMPORT and action.reason not in others)
    edited = [action for action in texts if action.mine not in (None, action.base, action.generated)]
    # contradictions of branches are conflicts, not errors; with `--undo`, the user chose a text with markers
    told = {action.origin or action.path for action in edited if action.is_conflict} & files.left_by_git.keys()
    told |= files.overlay.keys()
    for key in dict.fromkeys((*(action.origin or action.path for action in edited), *orders)):
        found = find_markers(files.text(key) or "")
        if found and key not in told:
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(files.path(key))
            errors.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, found[0][1], hint=hint))
    if errors:
        raise OutputError(*errors)
