"""What the last build wrote over: given back to the user, and compared with what has been saved since.

It is put aside in the state folder and stays there until the next build that writes. What the user had before a merge
stays as long as the merged file is not saved.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.conflicts import BOTH_SIDES, Conflict
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import text_hash
from urdfsync.files import shown
from urdfsync.state.record import Choice, role_of, sides_hash
from urdfsync.state.replaced import Replaced

_MANY = 100
"""If a build writes over more files that nobody edited, these are not put aside: it was no export, but a template."""


def reconsider(
    generation: Generation, actions: Iterable[Action], choices: Mapping[str, Choice]
) -> tuple[tuple[Action, ...], dict[str, str], tuple[Diagnostic, ...]]:
    """Undo merges, and look again at files that nothing seems to be new for.

    One that was saved without what the last build had written conflicts again if the user wants it merged or edited;
    else there is a warning. Returns the actions, the texts of what is undone by path, and the warnings.
    """
    inputs, actions = generation.inputs, tuple(actions)
    found = tuple(_reconsidered(generation, action, choices.get(action.path)) for action in actions)
    found += tuple(_find_deleted(generation, {action.path for action in actions}))
    texts = {one.path: inputs.replaced[inputs.path(one.path)].before for one in found if one.kind is Kind.UNDO}
    return found, texts, tuple(_warning(shown(inputs.files.path(one.path))) for one in found if one.takes_back)


def _reconsidered(generation: Generation, action: Action, choice: Choice | None) -> Action:
    if not action.mine or action.role is Role.IMPORT or not (action.kind is Kind.KEEP or choice is Choice.UNDO):
        return action
    one = generation.inputs.replaced.get(generation.inputs.path(action.path))
    if one is None:
        return action
    if choice is Choice.UNDO:
        return _undone(action, one)
    if one.base and _takes_back(generation, action, one):
        if choice in BOTH_SIDES:
            return msgspec.structs.replace(action, kind=Kind.CONFLICT, base=text_hash(one.base))
        if choice in (Choice.KEEP, None):
            return msgspec.structs.replace(action, choice=choice, takes_back=choice is None)
    return action


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
            yield Action(key, Kind.UNDO, role, choice=choice, result=result)


def _undone(action: Action, one: Replaced) -> Action:
    """Give back what the user had, if the file is still what was written over it."""
    after = action.generated if one.after is None else text_hash(one.after)
    if not one.is_users or action.mine != after or action.base != action.generated:
        return action
    base, result = None if one.base is None else text_hash(one.base), text_hash(one.before)
    return msgspec.structs.replace(
        action, kind=Kind.UNDO, base=base, choice=Choice.UNDO, result=result, keeps_base=True
    )


def _takes_back(generation: Generation, action: Action, one: Replaced) -> bool:
    """Whether a file is rather what stood there before the last build than what this build wrote, with an edit."""
    from urdfsync.merge.edits import find_edits  # only an edited file needs it

    mine = generation.inputs.files.text(action.path) or ""
    after = generation.content(action.path).decode() if one.after is None else one.after
    since_before, since_after = find_edits(one.before, mine), find_edits(after, mine)
    if since_before is None or since_after is None:
        return text_hash(mine) == text_hash(one.before)
    return len(since_before) < len(since_after)


def _warning(file: str) -> Diagnostic:
    message = "it was saved without what the last build wrote, as by an editor that had opened it before"
    hint = f"`urdfsync resolve {file} --merge` brings that in again, --keep leaves your file as it is"
    return Diagnostic(Severity.WARNING, "taken-back", message, file, hint=hint)


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
    settled = {inputs.path(action.path) for action in actions if action.choice in (Choice.KEEP, Choice.UNDO)}
    taken_back = {inputs.path(action.path) for action in actions if action.takes_back}
    for path, one in inputs.replaced.items():
        after = files.text(inputs.key(path))
        stands = after is None or one.after in (None, after)
        if path not in settled and (not is_writing or path in taken_back or (one.is_users and stands)):
            found[path] = one
    return found | new


def _written_over(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], moved: Mapping[str, Conflict]
) -> Iterator[tuple[str, Replaced]]:
    inputs, files = generation.inputs, generation.inputs.files
    for action in actions:
        is_taken = action.kind is Kind.DELETE and action.choice is Choice.TAKE
        is_replaced = action.kind in (Kind.UPDATE, Kind.MERGE) and action.origin is None
        if action.writes and action.mine and (is_taken or is_replaced):
            before = files.text(action.path) or ""
            base = before if action.mine == action.base else None
            if base is None and action.base:
                base = inputs.base(action.base)
            yield inputs.path(action.path), Replaced(before, base, texts.get(action.path))
        elif action.writes and action.path in moved:
            one, after = moved[action.path], texts.get(action.path)
            if one.kept != after:
                yield inputs.path(action.path), Replaced(one.kept, one.base, after)
