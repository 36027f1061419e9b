"""What a build says of a package on disk that an older urdfsync wrote, and that does not fit the library any more."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import CONFLICTS, Action, Kind
from urdfsync.engine.inputs import Inputs
from urdfsync.modelica.names import LIBRARY
from urdfsync.state.record import Choice


def findings(inputs: Inputs, actions: Iterable[Action]) -> list[Diagnostic]:
    """A warning if such a package waits for conflicts, and one for each file that the user keeps."""
    if inputs.complete_revision is None or inputs.complete_revision >= inputs.domain.fits_since:
        return []
    actions = list(actions)
    conflicts = [action for action in actions if action.kind in CONFLICTS]
    found = [_waiting(inputs, conflicts)] if conflicts and any(action.held for action in actions) else []
    return found + [
        _kept(inputs, action) for action in actions if action.kind is Kind.KEEP and action.choice is Choice.KEEP
    ]


def _waiting(inputs: Inputs, conflicts: list[Action]) -> Diagnostic:
    paths = [shown(inputs.files.path(action.origin or action.path)) for action in conflicts]
    named = paths[0] if len(paths) == 1 else f"each of {len(paths)} conflicts"
    command = paths[0] if len(paths) == 1 else f"--all --robot {inputs.robot.name}"
    message = f"an older urdfsync wrote this package: it does not fit the library {LIBRARY} of this version"
    hint = f"it fits the library again once {named} is resolved: urdfsync resolve {command}"
    folder = shown(inputs.files.path(inputs.recorded.folder if inputs.recorded else inputs.folder))
    return Diagnostic(Severity.WARNING, "outdated-package", message, folder, hint=hint)


def _kept(inputs: Inputs, action: Action) -> Diagnostic:
    message = f"this file stays as it is, but it was made for an older library {LIBRARY}"
    hint = f"`urdfsync check {inputs.robot.name}` tells whether it fits the rest of the package"
    return Diagnostic(Severity.WARNING, "outdated-file", message, shown(inputs.files.path(action.path)), hint=hint)
