"""Texts that the last build wrote over, to be given back to the user.

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
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_files import text_hash
from urdfsync.engine.package_names import names_of, renamed_identifiers
from urdfsync.modelica.lexer import words_in
from urdfsync.state.record import Choice, UsersChoice, role_of, sides_hash
from urdfsync.state.store import Replaced

_MANY = 100
"""If a build writes over more files that nobody edited, these are not put aside: it was no export, but a template."""


def apply_undo(
    inputs: Inputs, actions: Iterable[Action], choices: Mapping[str, UsersChoice]
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Undo merges where the user chose that, or open them again for another merge.

    Returns the actions, and the texts of what is undone by path.
    """
    applied = list[Action]()
    for action in actions:
        choice = choices[action.path].choice if action.path in choices else None
        if choice is Choice.UNDO:
            action = _undo(inputs, action)
        elif choice in BOTH_SIDES and action.reason is Reason.KEEP:
            action = _reopen(inputs, action)
        applied.append(action)
    applied += _find_deleted(inputs, {action.path for action in applied})
    paths = {action.path: inputs.folder.path(action.path) for action in applied if action.reason is Reason.UNDO}
    return tuple(applied), {key: inputs.last.replaced[path].before for key, path in paths.items()}


def _undo(inputs: Inputs, action: Action) -> Action:
    """Give back what the user had, if the file is still what was written over it."""
    aside = inputs.last.replaced.get(inputs.folder.path(action.path))
    if aside is None or not action.mine or action.role is Role.IMPORT:
        return action
    after = action.generated if aside.after is None else text_hash(aside.after)
    if not aside.is_users or action.mine != after or action.base != action.generated:
        return action
    return msgspec.structs.replace(action, reason=Reason.UNDO, choice=Choice.UNDO, result=text_hash(aside.before))


def _reopen(inputs: Inputs, action: Action) -> Action:
    """Let a file that is kept conflict as it did before, if it still is what was written or given back.

    Undoing takes the generated text for its base, so that builds keep it. The base of the merge is put aside.
    """
    aside = inputs.last.replaced.get(inputs.folder.path(action.path))
    if aside is None or not (aside.is_users and aside.base) or inputs.files.text(action.path) != aside.after:
        return action
    return msgspec.structs.replace(action, reason=Reason.CONFLICT, base=text_hash(aside.base))


def former_names(generation: Generation, action: Action) -> Mapping[str, str]:
    """Return new names by the old ones for a merge that is made again: those of the build that made it first."""
    aside = generation.inputs.last.replaced.get(generation.inputs.folder.path(action.path))
    if aside is None or not (aside.renamed and aside.base) or action.base != text_hash(aside.base):
        return {}
    return names_of(generation, aside.renamed, frozenset(words_in(aside.base)))


def _find_deleted(inputs: Inputs, actions: Collection[str]) -> Iterator[Action]:
    """Yield the actions that give back files of the user's which a build has deleted: they are his own then.

    `actions` are the keys of those that there are.
    """
    no_file = sides_hash(None, None)
    for key, chosen in inputs.options.choices.items():
        aside = inputs.last.replaced.get(inputs.folder.path(key)) if chosen.choice is Choice.UNDO else None
        role = role_of(inputs.folder.path(key))
        if aside and chosen.sides == no_file and key not in actions and inputs.files.on_disk(key, role) is None:
            yield Action(key, Reason.UNDO, role, choice=Choice.UNDO, result=text_hash(aside.before))


def put_aside(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], disputed: Mapping[str, Conflict]
) -> dict[str, Replaced]:
    """Return what is put aside after a build, by path below the package.

    `texts` has merged files, `disputed` those that both sides changed or that move, by key.
    """
    inputs = generation.inputs
    actions = [action for action in actions if action.role not in (Role.IMPORT, Role.ORDER)]
    new = dict(_written_over(generation, actions, texts, disputed))
    untouched = [path for path, text in new.items() if not text.is_users]
    for path in untouched if len(untouched) > _MANY else ():
        del new[path]
    is_writing = any(action.writes for action in actions)
    settled = {
        inputs.folder.path(action.path)
        for action in actions
        if action.choice is Choice.KEEP or action.reason is Reason.UNDO
    }
    old = {}
    for path, text in inputs.last.replaced.items():
        after = inputs.files.text(inputs.folder.key(path))
        is_saved_since = after is not None and text.after not in (None, after)
        if path not in settled and (not is_writing or (text.is_users and not is_saved_since)):
            old[path] = text
    return old | new


def _written_over(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], disputed: Mapping[str, Conflict]
) -> Iterator[tuple[str, Replaced]]:
    inputs = generation.inputs
    renamed = renamed_identifiers(generation) if generation.renames else {}
    for action in actions:
        path, after = inputs.folder.path(action.path), texts.get(action.path)
        is_taken = action.reason is Reason.DELETE and action.choice is Choice.TAKE
        is_replaced = action.reason in (Reason.UPDATE, Reason.MERGE, Reason.UNDO) and action.origin is None
        if not action.writes:
            continue
        if action.mine and (is_taken or is_replaced):
            before = inputs.files.text(action.path) or ""
            base = before if action.mine == action.base else inputs.last.base(action.base)
            old = inputs.last.replaced.get(path)
            base = old.base if old and action.reason is Reason.UNDO else base
            is_again = old is not None and old.base == base  # the same merge, undone or made again
            yield path, Replaced(before, base, after, old.renamed if old and is_again else renamed)
        elif action.reason is Reason.MOVE and (move := disputed.get(action.path)) and move.kept != after:
            yield path, Replaced(move.kept, move.base, after, renamed)
