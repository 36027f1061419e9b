"""Values as plain data for JSON documents, as docs/json.md describes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.domain import ChangeClass
from urdfsync.engine.actions import Action
from urdfsync.engine.result import Result
from urdfsync.output import conflicts
from urdfsync.output.phrases import reason, summary

if TYPE_CHECKING:
    from urdfsync.changes import Changes


def action_values(action: Action, changes: Changes | None = None) -> dict[str, Any]:
    """What happens to a file as plain data; `changes` tell why, if it is because of them."""
    return {
        "path": action.path,
        "action": action.kind,
        "held": action.held,
        "owner": action.owner,
        "role": action.role,
        "reason": reason(action, changes),
    }


def result_values(result: Result) -> dict[str, Any]:
    """What was done with a robot as plain data; paths are relative to the configuration's folder."""
    changes = result.changes
    return {
        "name": result.robot,
        "package": result.package,
        "folder": str(result.folder),
        "failed": result.failed,
        "locked": result.locked,
        "was_in_step": result.in_step,
        "in_step": result.is_in_step_now,
        "summary": summary(result),
        "drawing": str(result.drawing) if result.drawing else None,
        "checked": result.checked,
        "class": changes.change_class if changes else ChangeClass.NONE,
        "changes": [
            {
                "change": str(change),
                "kind": change.kind,
                "class": change.change_class,
                "old": change.old,
                "new": change.new,
                "unit": change.unit,
                "noise": change.noise,
            }
            for change in (changes.changes if changes else ())
        ],
        "actions": [action_values(action, changes) for action in result.actions],
        "conflicts": [
            {
                "path": target.action.path,
                "origin": target.action.origin,
                "owner": target.action.owner,
                "merges": target.merges,
                "reason": conflicts.describe(target),
                **dict.fromkeys(("base", "generated", "merge")),
                **conflicts.saved_texts(target),
            }
            for target in conflicts.find_conflicts([result])
        ],
        "diagnostics": list(map(msgspec.structs.asdict, result.diagnostics)),
    }
