"""What a build says of a package on disk that an older urdfsync wrote, and that does not fit the library any more."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.names import LIBRARY
from urdfsync.plan import CONFLICTS, Action, Kind
from urdfsync.planning.situation import Situation
from urdfsync.standoff import Choice


def findings(situation: Situation, actions: Iterable[Action]) -> list[Diagnostic]:
    """A warning if such a package waits for conflicts, and one for each file that the user keeps."""
    if situation.written_by is None or situation.written_by >= situation.domain.fits_since:
        return []
    actions = list(actions)
    conflicts = [action for action in actions if action.kind in CONFLICTS]
    found = [_waiting(situation, conflicts)] if conflicts and any(action.held for action in actions) else []
    return found + [
        _kept(situation, action) for action in actions if action.kind is Kind.KEEP and action.choice is Choice.KEEP
    ]


def _waiting(situation: Situation, conflicts: list[Action]) -> Diagnostic:
    paths = [shown(situation.disk.path(action.origin or action.path)) for action in conflicts]
    named = paths[0] if len(paths) == 1 else f"each of {len(paths)} conflicts"
    command = paths[0] if len(paths) == 1 else f"--all --robot {situation.robot.name}"
    message = f"an older urdfsync wrote this package: it does not fit the library {LIBRARY} of this version"
    hint = f"it fits the library again once {named} is resolved: urdfsync resolve {command}"
    folder = shown(situation.disk.path(situation.recorded.folder if situation.recorded else situation.folder))
    return Diagnostic(Severity.WARNING, "outdated-package", message, folder, hint=hint)


def _kept(situation: Situation, action: Action) -> Diagnostic:
    message = f"this file stays as it is, but it was made for an older library {LIBRARY}"
    hint = f"`urdfsync check {situation.robot.name}` tells whether it fits the rest of the package"
    return Diagnostic(Severity.WARNING, "outdated-file", message, shown(situation.disk.path(action.path)), hint=hint)
