"""Texts of the user's that the last build wrote over, to be given back.

They are put aside in the state folder. What the user had before a merge stays there as long as the merged file is not
saved. What was merged stays as long as the file that was given back is not saved: that may be undone too, or merged
again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

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
from urdfsync.state.store import PutAside, Replaced


def apply_undo(
    inputs: Inputs, actions: Iterable[Action], choices: Mapping[str, UsersChoice]
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Undo merges where the user chose that, or open them again for another merge.

    Returns the actions, and the texts of what is undone by path.
    """
    applied, texts = dict[str, Action](), dict[str, str]()
    for action in actions:
        choice = choices[action.path].choice if action.path in choices else None
        aside = inputs.last.put_aside.texts.get(inputs.folder.path(action.path))
        is_merged_again = choice in BOTH_SIDES and action.reason is Reason.KEEP
        if aside and choice is Choice.UNDO and _is_as_written(action, aside):
            action = msgspec.structs.replace(action, reason=Reason.UNDO, choice=Choice.UNDO)
            texts[action.path] = aside.before
        elif aside and aside.base and is_merged_again and inputs.files.text(action.path) == aside.after:
            # undoing takes the generated text for its base, so that builds keep it; that of the merge is put aside
            action = msgspec.structs.replace(action, reason=Reason.CONFLICT, base=text_hash(aside.base))
        applied[action.path] = action
    no_file = sides_hash(None, None)
    for key, chosen in inputs.options.choices.items():  # of files that a build has deleted
        aside = inputs.last.put_aside.texts.get(inputs.folder.path(key))
        role = role_of(inputs.folder.path(key))
        is_deleted = chosen.choice is Choice.UNDO and chosen.sides == no_file and key not in applied
        if aside and is_deleted and inputs.files.on_disk(key, role) is None:
            applied[key] = Action(key, Reason.UNDO, role, choice=Choice.UNDO)
            texts[key] = aside.before
    return tuple(applied.values()), texts


def _is_as_written(action: Action, aside: Replaced) -> bool:
    """Return whether a file still is what was written over the user's text."""
    after = action.generated if aside.after is None else text_hash(aside.after)
    is_same = action.mine is not None and action.mine == after and action.base == action.generated
    return is_same and action.role is not Role.IMPORT


def former_names(generation: Generation, action: Action) -> Mapping[str, str]:
    """Return new names by the old ones for a merge that is made again: those of the build that made it first."""
    inputs = generation.inputs
    aside = inputs.last.put_aside.texts.get(inputs.folder.path(action.path))
    if aside is None or not (aside.renamed and aside.base) or action.base != text_hash(aside.base):
        return {}
    return names_of(generation, aside.renamed, frozenset(words_in(aside.base)))


def put_aside(
    generation: Generation, actions: Iterable[Action], texts: Mapping[str, str], disputed: Mapping[str, Conflict]
) -> PutAside:
    """Return what is put aside after a build.

    `texts` has merged files, `disputed` those that both sides changed or that move, by key.
    """
    inputs, last = generation.inputs, generation.inputs.last.put_aside
    actions = [action for action in actions if action.role not in (Role.IMPORT, Role.ORDER)]
    is_writing = any(action.writes for action in actions)
    renamed = renamed_identifiers(generation) if generation.renames else {}
    new = dict(_written_over(generation, actions, texts, disputed, renamed))
    settled = {
        inputs.folder.path(action.path)
        for action in actions
        if action.choice is Choice.KEEP or action.reason is Reason.UNDO
    }
    old = {}
    for path, text in last.texts.items():
        after = inputs.files.text(inputs.folder.key(path))
        is_saved_since = after is not None and text.after not in (None, after)
        if path not in settled and not (is_writing and is_saved_since):
            old[path] = text
    return PutAside(old | new, renamed if is_writing else last.renamed)


def _written_over(
    generation: Generation,
    actions: Iterable[Action],
    texts: Mapping[str, str],
    disputed: Mapping[str, Conflict],
    renamed: Mapping[str, str],
) -> Iterator[tuple[str, Replaced]]:
    """Yield the texts of the user's that a build writes over, by path below the package."""
    inputs = generation.inputs
    for action in actions:
        path, after = inputs.folder.path(action.path), texts.get(action.path)
        is_taken = action.reason is Reason.DELETE and action.choice is Choice.TAKE
        is_replaced = action.reason in (Reason.UPDATE, Reason.MERGE, Reason.UNDO) and action.origin is None
        if not action.writes:
            continue
        if action.mine and (is_taken or is_replaced or action.is_left_by_git):
            before, old = inputs.files.text_on_disk(action.path) or "", inputs.last.put_aside.texts.get(path)
            base = None if action.is_left_by_git else inputs.last.base(action.base)
            base = before if base is not None and action.mine == action.base else base
            base = old.base if old and action.reason is Reason.UNDO else base
            is_again = old is not None and old.base == base  # the same merge, undone or made again
            if base != before:
                yield path, Replaced(before, base, after, old.renamed if old and is_again else renamed)
        elif action.reason is Reason.MOVE and (move := disputed.get(action.path)) and move.kept != after:
            yield path, Replaced(move.kept, move.base, after, renamed)
