"""The actions of the next plan, if nobody changes a file after a build: then the robot need not be planned again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import text_hash
from urdfsync.state.record import Record, role_of


class _UncertainError(Exception):
    """The next action on a file is not certain."""


def foresee_actions(inputs: Inputs, decision: Decision, record: Record) -> Actions | None:
    """Return the actions of the next plan; None if they are not certain. `record` is the record after the build."""
    last, news = inputs.last, decision.differences.changes
    unusual = (
        inputs.has_moved,
        inputs.former_name,
        inputs.damage,
        inputs.source.stale,
        inputs.parents.shared,
        inputs.files.overlay,
        inputs.robot.renamed,
        last.record.is_united,
        # the next plan reports the changes again
        record is last.record and news and (news.changes or news.generator),
        # the next plan has other hints
        decision.misfits and record.former != decision.differences.former,
    )
    if not decision.is_complete or any(unusual):
        return None
    try:
        return Actions(_next_actions(inputs, decision))
    except _UncertainError:
        return None


def _next_actions(inputs: Inputs, decision: Decision) -> Iterator[Action]:
    """Yield the next action on each file. Raises _UncertainError."""
    for action in decision.actions:
        after = _next_action(action, decision.texts)
        if after is None:
            continue
        if after.reason is Reason.ORPHAN:  # the record has neither role nor owner
            after = msgspec.structs.replace(after, role=role_of(inputs.folder.path(after.path)), owner="")
        is_confirmed = action.mine in inputs.last.record.confirmed and action.reason is not Reason.KEEP
        if is_confirmed and after.mine and after.reason in (Reason.KEEP, Reason.ORPHAN):
            raise _UncertainError
        yield after


def _next_action(action: Action, texts: Mapping[str, str]) -> Action | None:
    """Return the next action on a file, None for a file that is gone; `texts` has merged texts by key."""
    mine = action.generated
    match action.reason:
        case Reason.DELETE | Reason.MOVED_AWAY:
            return None
        case Reason.FORGET if action.role is not Role.ORDER:
            return None
        case Reason.KEEP | Reason.UNKNOWN | Reason.ORPHAN:
            return action
        case Reason.MERGE | Reason.MOVE if action.generated and action.path in texts:
            mine = text_hash(texts[action.path])
        case Reason.UNCHANGED | Reason.UPDATE | Reason.CREATE | Reason.RESTORE:
            pass
        case _:
            raise _UncertainError
    reason = Reason.UNCHANGED if mine == action.generated else Reason.KEEP
    return msgspec.structs.replace(action, reason=reason, base=action.generated, mine=mine, origin=None)
