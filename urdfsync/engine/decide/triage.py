"""Sorts a robot's files by hashes: in step, edited, to write or to delete, in conflict, or asked about."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from urdfsync.domain import Role
from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import DISPUTED, Action, Actions, Reason
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.differences import Differences
from urdfsync.engine.decide.doubts import EDITED, find_doubts
from urdfsync.engine.decide.package_names import renamed_names
from urdfsync.engine.decide.parts import is_of_part
from urdfsync.engine.decide.places import find_places
from urdfsync.engine.decide.rules import decide
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.stamp import Stamp


def triage(inputs: Inputs, generation: Generation, differences: Differences) -> Decision:
    """Decide on every file by hashes; ask about edits that may belong to other parts."""
    package, moves = generation.package, differences.moves
    decided = decide(find_places(inputs, generation, differences.ids, moves), moves)
    doubts = find_doubts(inputs, generation, differences, decided)
    actions = tuple(_adjust(inputs, package, action, doubts, differences) for action in decided)
    actions = tuple(_find_seconds(inputs, package, differences, actions))
    names: Mapping[str, str] = {}
    is_disputed = any(one.reason in DISPUTED and one.role is not Role.IMPORT for one in actions)
    if differences.other_elements or inputs.last.aside or is_disputed:
        names = renamed_names(inputs, generation, differences)
    if differences.other_elements:
        actions = tuple(_with_other_names(inputs, package, actions, names))
    return Decision(differences, Actions(actions), doubts=doubts, names=names)


def _adjust(
    inputs: Inputs, package: Package, action: Action, doubts: Mapping[str, Doubt], differences: Differences
) -> Action:
    """Correct an action by contents and options: the rules see only hashes."""
    left = inputs.files.left_by_git
    if left.get(action.path) and action.reason in (Reason.KEEP, Reason.UNCHANGED, Reason.UPDATE):
        return msgspec.structs.replace(action, reason=Reason.MARKERS)
    if left.get(action.path, True) is None:
        action = msgspec.structs.replace(action, is_left_by_git=True)
    file_id = differences.ids.get(inputs.folder.path(action.path))
    if file_id and action.mine and action.reason in (Reason.UNCHANGED, Reason.KEEP):
        stamp = inputs.files.stamp(action.path)
        if action.reason is Reason.UNCHANGED:
            is_stamped = stamp == Stamp(file_id, str(action.generated))
            stampless = msgspec.structs.replace(action, reason=Reason.UPDATE, lacks_stamp=stamp is None)
            return action if is_stamped else stampless
        # of a stamp that was pasted from another file, only the path counts
        is_pasted = stamp is not None and not is_of_part(stamp, file_id)
        action = msgspec.structs.replace(action, lacks_stamp=stamp is None or is_pasted)
    if action.path in doubts:
        return msgspec.structs.replace(action, reason=Reason.ASKED)
    if action.reason is Reason.DELETE and action.mine is not None and action.role is not Role.IMPORT:
        # a record alone proves nothing: its author, or git's union of two records, may name any file of the user's
        if not (action.mine in package.paths_by_hash or inputs.last.has_written(action.mine)):
            return msgspec.structs.replace(action, reason=Reason.ORPHAN)
        stamp = inputs.files.stamp(action.path)
        return msgspec.structs.replace(action, copy_of=differences.paths.get(stamp.id, "") if stamp else "")
    return action


def _find_seconds(
    inputs: Inputs, package: Package, differences: Differences, actions: Sequence[Action]
) -> Iterator[Action]:
    """Yield the actions. An edit of a part of which another file is edited, too, is in conflict."""
    edited = {action.path for action in actions if action.reason in EDITED}
    for action in actions:
        stamp = inputs.files.stamp(action.path) if action.reason is Reason.ORPHAN else None
        path = differences.paths.get(stamp.id, "") if stamp else ""
        if inputs.folder.key(path) in edited:
            changes = {"reason": Reason.SECOND, "owner": package.owners[path], "copy_of": path}
            action = msgspec.structs.replace(action, **changes)
        yield action


def _with_other_names(
    inputs: Inputs, package: Package, actions: Iterable[Action], names: Mapping[str, str]
) -> Iterator[Action]:
    """Yield the actions. An edit that uses an outdated name is merged, even if the generated text did not change."""
    for action in actions:
        is_chosen = inputs.files.is_chosen(action.path)
        is_edit = action.reason is Reason.KEEP and action.role is not Role.IMPORT and not is_chosen
        # a text that was written for this export has its names: a build was killed, or the state is older
        is_present = inputs.last.record.files.get(action.path) != action.generated
        if is_edit and action.base == action.generated and not is_present:
            from urdfsync.modelica.lexer import words_in  # imports the parser

            text = inputs.files.text(action.path) or ""
            generated = package.content(inputs.folder.path(action.path)).decode()
            words, is_settled = words_in(generated), action.mine in inputs.last.record.confirmed
            mine = Counter(words_in(text))
            mine.subtract(words)
            if not is_settled and any(count > 0 and word in names for word, count in mine.items()):
                action = msgspec.structs.replace(action, reason=Reason.CONFLICT)
        yield action
