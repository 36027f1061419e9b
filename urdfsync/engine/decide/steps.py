"""Decides on one robot's package: sorts its files, merges edits, lets the user's texts follow renames.

Each step takes the decision so far, and returns the next one.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import msgspec

from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.files import shown
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.differences import compare_with_last
from urdfsync.engine.decide.followers import follow
from urdfsync.engine.decide.merges import merge_edits
from urdfsync.engine.decide.misfits import look_for_misfits
from urdfsync.engine.decide.orders import decide_orders
from urdfsync.engine.decide.package_after import PackageAfter
from urdfsync.engine.decide.package_names import describe_renames
from urdfsync.engine.decide.rules import put_off
from urdfsync.engine.decide.triage import triage
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.modelica.literals import numbers_only
from urdfsync.modelica.markers import find_markers
from urdfsync.project import git


def decide_package(inputs: Inputs, generation: Generation) -> Decision:
    """Decide on every file of a robot. Raises OutputError for links and for merge markers."""
    decision = triage(inputs, generation, compare_with_last(inputs, generation))
    decision = merge_edits(inputs, generation, decision)
    decision = follow(inputs, generation, decision)
    decision = decide_orders(inputs, generation.package, decision)
    _refuse_markers(inputs, decision)
    decision = _put_off(inputs, generation, decision)
    return _look_at_result(inputs, generation, decision)


def _put_off(inputs: Inputs, generation: Generation, decision: Decision) -> Decision:
    """Let files wait for conflicts."""
    value_only_keys: Collection[str] = ()
    # if names were exchanged, each build would move edits again
    if any(action.is_conflict for action in decision.actions) and not decision.differences.has_exchanges:
        after = PackageAfter(inputs, generation.package, decision.actions, decision.texts)
        value_only_keys = _find_value_only(after, decision.differences.changes, decision.disputed)
    actions = put_off(decision.actions, value_only_keys, has_moved=inputs.has_moved)
    waiting = {action.path for action in actions if action.is_waiting}
    shared = tuple(file for file in decision.shared if inputs.files.key(file.path) not in waiting)
    return decision.with_actions(actions, shared=shared)


def _look_at_result(inputs: Inputs, generation: Generation, decision: Decision) -> Decision:
    """Find the names that will not resolve after the build, and name the renamed elements of conflicts."""
    misfits = look_for_misfits(PackageAfter(inputs, generation.package, decision.actions, decision.texts))
    proposed = {action.path for action in decision.actions if action.reason is Reason.RENAMED}  # it tells the names
    return msgspec.structs.replace(
        decision,
        misfits=tuple(one for one in misfits if one.key not in proposed or one.use is None),
        disputed=describe_renames(inputs, generation, decision.differences.former, decision.disputed),
        names=inputs.settled.names or decision.names,
    )


def _find_value_only(after: PackageAfter, changes: Changes | None, conflicts: Mapping[str, Conflict]) -> frozenset[str]:
    """Return the records in which only numbers change, including records in conflict."""
    inputs, keys, by_element = after.inputs, set(), changes.by_element() if changes else {}
    for action in after.actions:
        if action.role is not Role.RECORD or action.origin is not None or action.is_left_by_git:
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


def _refuse_markers(inputs: Inputs, decision: Decision) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    files, errors = inputs.files, []
    orders = (action.path for action in decision.actions if action.role is Role.ORDER)
    marked = [key for key in orders if find_markers(decision.texts.get(key, ""))]
    others = Reason.UPDATE, Reason.UNKNOWN  # a class of the user's own may have markers: `fit` tells its syntax error
    texts = (action for action in decision.actions if action.role is not Role.IMPORT and action.reason not in others)
    edited = [action for action in texts if action.mine not in (None, action.base, action.generated)]
    # contradictions of branches are conflicts, not errors; with `--undo`, the user chose a text with markers
    told = {action.origin or action.path for action in edited if action.is_conflict} & files.left_by_git.keys()
    told |= files.overlay.keys()
    for key in dict.fromkeys((*(action.origin or action.path for action in edited), *marked)):
        found = find_markers(files.text(key) or "")
        if found and key not in told:
            file = shown(files.path(key))
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            if key not in inputs.unmerged and git.find_top(files.path(key).parent):
                # it was added to the index with its markers; `git checkout -m` would discard what the user wrote since
                back = f"`git update-index --unresolve {file}`"
                hint = f"settle them in the file, or bring git's conflict back with {back}; then build"
            errors.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, found[0][1], hint=hint))
    if errors:
        raise OutputError(*errors)
