"""Hand-edited records that no longer say what other records of the robot repeat: reads them, and says where."""

from __future__ import annotations

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role, Spot
from urdfsync.outcome import Result
from urdfsync.plan import Action, Kind
from urdfsync.planning.disk import Disk

_EDITED = frozenset({Kind.KEEP, Kind.CONFLICT, Kind.UNOWNED, Kind.INCLUDED, Kind.MERGE, Kind.MOVE})
_GONE = frozenset({Kind.DELETE, Kind.ORPHAN, Kind.NEEDED, Kind.LEAVE, Kind.FORGET})
_HINT = "make them equal, unless they are meant to differ"


def differing(config: Config, robot: RobotConfig, result: Result) -> list[Diagnostic]:
    """A warning for each value that an edited record and another one give differently; `result` is the robot's plan.

    Nothing is read unless a record was edited. Raises OutputError for a record that can't be read.
    """
    records = [action for action in result.actions if action.role is Role.RECORD and action.kind not in _GONE]
    edited = {_place(action) for action in records if action.kind in _EDITED}
    if not edited:
        return []
    disk = Disk(config, robot)
    folder = disk.key(robot.folder) + "/"
    texts = {place.removeprefix(folder): disk.text(place) for place in map(_place, records)}
    known = {path: text for path, text in texts.items() if text is not None}
    found = registry.domain(robot.domain).echoes(known, robot.target)
    return [
        _warning(*(spots if folder + spots[0].path in edited else spots[::-1]), robot)
        for spots in ((echo.one, echo.other) for echo in found)
        if edited & {folder + spot.path for spot in spots}
    ]


def _place(action: Action) -> str:
    """Where the file is now."""
    return action.origin or action.path


def _warning(here: Spot, there: Spot, robot: RobotConfig) -> Diagnostic:
    said = f"{here.name} is not given" if here.value is None else f"{here.name} = {here.value}"
    other = "does not give it" if there.value is None else f"has {there.value}"
    message = f"{said}, but {there.path}:{there.line} {other}"
    return Diagnostic(
        Severity.WARNING, "records-differ", message, shown(robot.folder / here.path), here.line, hint=_HINT
    )
