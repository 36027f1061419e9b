"""What the last build wrote over, to be given back to the user.

It is put aside in the state folder and stays there until the next build that writes. What the user had before a merge
stays as long as the merged file is not saved. What was merged stays as long as the file that was given back is not
saved: that may be undone too, or merged again.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.conflicts import BOTH_SIDES, Conflict
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import text_hash
from urdfsync.state.record import Choice, role_of, sides_hash
from urdfsync.state.replaced import Replaced

_MANY = 100
"""If a build writes over more files that nobody edited, these are not put aside: it was no export, but a template."""


def apply_undo(
    generation: Generation, actions: Iterable[Action], choices: Mapping[str, Choice]
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Undo merges where the user chose that, or open them again for another merge.

    Returns the actions, and the texts of what is undone by path.
    """
    inputs, actions, found = generation.inputs, tuple(actions), tuple[Action, ...]()
    for action in actions:
        choice = choices.get(action.path)
        if choice is Choice.UNDO:
            action = _undone(generation, action)
        elif choice in BOTH_SIDES and action.reason is Reason.KEEP:
            action = _reopened(generation, action)
        found += (action,)
    found += tuple(_find_deleted(generation, {action.path for action in actions}))
    return found, {
        one.path: inputs.replaced[inputs.path(one.path)].before for one in found if one.reason is Reason.UNDO
    }


def _undone(generation: Generation, action: Action) -> Action:
    """Give back what the user had, if the file is still what was written over it."""
    one = generation.inputs.replaced.get(generation.inputs.path(action.path))
    if one is None or not action.mine or action.role is Role.IMPORT:
        return action
    after = action.generated if one.after is None else text_hash(one.after)
    if not one.is_users or action.mine != after or action.base != action.generated:
        return action
    result = text_hash(one.before)
    return msgspec.structs.replace(action, reason=Reason.UNDO, choice=Choice.UNDO, result=result)


def _reopened(generation: Generation, action: Action) -> Action:
    """Let a file that is kept conflict as it did before, if it still is what was written or given back.

    Undoing takes the generated text for its base, so that builds keep it. The base of the merge is put aside.
    """
    inputs = generation.inputs
    one = inputs.replaced.get(inputs.path(action.path))
    if one is None or not (one.is_users and one.base) or inputs.files.text(action.path) != one.after:
        return action
    return msgspec.structs.replace(action, reason=Reason.CONFLICT, base=text_hash(one.base))


def _find_deleted(generation: Generation, known: Collection[str]) -> Iterator[Action]:
    """Yield the actions that give back files of the user's which a build has deleted: they are his own then."""
    inputs, no_file = generation.inputs, sides_hash(None, None)
    for (key, sides), choice in inputs.options.choices.items():
        path = inputs.path(key)
        if choice is not Choice.UNDO or sides != no_file or key in known or path not in inputs.replaced:
            continue
        role = role_of(path)
        if inputs.files.on_disk(key, role) is None:
            result = text_hash(inputs.replaced[path].before)
            yield Action(key, Reason.UNDO, role, choice=choice, result=result)


def put_aside(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], moved: Mapping[str, Conflict]
) -> dict[str, Replaced]:
    """Return what is put aside after a build, by path; `texts` has merged files, `moved` those that move, by key."""
    inputs, files = generation.inputs, generation.inputs.files
    actions = [action for action in actions if action.role not in (Role.IMPORT, Role.ORDER)]
    new = dict(_written_over(generation, actions, texts, moved))
    untouched = [path for path, one in new.items() if not one.is_users]
    for path in untouched if len(untouched) > _MANY else ():
        del new[path]
    found = {}
    is_writing = any(action.writes for action in actions)
    settled = {inputs.path(action.path) for action in actions if action.choice is Choice.KEEP}
    settled |= {inputs.path(action.path) for action in actions if action.reason is Reason.UNDO}
    for path, one in inputs.replaced.items():
        after = files.text(inputs.key(path))
        stands = after is None or one.after in (None, after)
        if path not in settled and (not is_writing or (one.is_users and stands)):
            found[path] = one
    return found | new


def _written_over(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], moved: Mapping[str, Conflict]
) -> Iterator[tuple[str, Replaced]]:
    inputs, files = generation.inputs, generation.inputs.files
    for action in actions:
        is_taken = action.reason is Reason.DELETE and action.choice is Choice.TAKE
        is_replaced = action.reason in (Reason.UPDATE, Reason.MERGE, Reason.UNDO) and action.origin is None
        if action.writes and action.mine and (is_taken or is_replaced):
            before = files.text(action.path) or ""
            base = before if action.mine == action.base else None
            if action.reason is Reason.UNDO:
                base = inputs.replaced[inputs.path(action.path)].base
            elif base is None and action.base:
                base = inputs.base(action.base)
            yield inputs.path(action.path), Replaced(before, base, texts.get(action.path))
        elif action.writes and action.path in moved:
            one, after = moved[action.path], texts.get(action.path)
            if one.kept != after:
                yield inputs.path(action.path), Replaced(one.kept, one.base, after)
