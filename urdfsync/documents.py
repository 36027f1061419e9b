"""Results as plain data, for programs: the parts of the JSON documents that `docs/json.md` describes."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

from urdfsync import difference, wording
from urdfsync.diagnostics import Diagnostic
from urdfsync.outcome import Result
from urdfsync.plan import Action

if TYPE_CHECKING:
    from urdfsync.changes import Change


def change(found: Change) -> dict[str, Any]:
    """A change of the model as plain data."""
    return {
        "change": str(found),
        "kind": found.kind,
        "class": found.change_class,
        "old": found.old,
        "new": found.new,
        "unit": found.unit,
        "noise": found.noise,
    }


def finding(diagnostic: Diagnostic) -> dict[str, Any]:
    """A diagnostic as plain data."""
    return dataclasses.asdict(diagnostic)


def robot(result: Result) -> dict[str, Any]:
    """A result as plain data; paths are relative to the configuration's folder."""
    return {
        "name": result.robot,
        "package": result.package,
        "folder": str(result.folder),
        "failed": result.failed,
        "locked": result.locked,
        "in_step": result.in_step,
        "summary": wording.summary(result),
        "drawing": str(result.drawing) if result.drawing else None,
        "class": result.changes.change_class if result.changes else difference.ChangeClass.NONE,
        "changes": [change(found) for found in result.changes.changes] if result.changes else [],
        "actions": [_action(action) for action in result.actions],
        "diagnostics": [finding(diagnostic) for diagnostic in result.diagnostics],
    }


def _action(action: Action) -> dict[str, Any]:
    return {
        "path": action.path,
        "action": action.kind,
        "held": action.held,
        "owner": action.owner,
        "role": action.role,
        "reason": action.reason,
    }
