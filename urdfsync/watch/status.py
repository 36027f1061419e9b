"""The status of each robot while `urdfsync watch` runs: pure, told of events."""

from __future__ import annotations

import enum
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Checked, Result
from urdfsync.output.console import StyledLine, line
from urdfsync.watch import events
from urdfsync.watch.event_log import NAME_WIDTH

_SPACED = 4
"""Rows of the status from which an empty one stands above it."""


class Activity(enum.StrEnum):
    """What a robot is at, in words; those that need the user's attention come first."""

    ERROR = "error"
    CONFLICT = "conflict"
    WAITING = "waiting"
    BUILDING = "building"
    CHECKING = "checking"
    SETTLING = "settling"
    STARTING = "not looked at yet"
    IN_STEP = "in step"


_RANKS = {activity: rank for rank, activity in enumerate(Activity)}
_SIGNS = {
    Activity.ERROR: ("✗", "bold red"),
    Activity.CONFLICT: ("!", "yellow"),
    Activity.WAITING: ("…", "yellow"),
    Activity.STARTING: ("…", "dim"),
    Activity.IN_STEP: ("✓", "green"),
}
"""Mark and style; of others those of `_BUSY`."""
_BUSY = "…", "cyan"


class RobotStatus(NamedTuple):
    """One robot at one moment."""

    activity: Activity
    text: str
    """The rest of a line that names the robot."""


class StatusTable:
    """The status of all robots, by their names."""

    def __init__(self) -> None:
        self.pause_reason = ""
        """Why nothing is built for now; empty if robots are built."""
        self._results: dict[str, RobotStatus] = {}
        """After the last build."""
        self._builds: dict[str, RobotStatus] = {}
        """Between the first event and the end of a build."""
        self._checks: dict[str, RobotStatus] = {}

    @property
    def rows(self) -> Mapping[str, RobotStatus]:
        """The status of each robot in the order of the configuration; of build and check that which matters more."""
        rows = {}
        for robot, result in self._results.items():
            at_rest = min(result, self._checks.get(robot, result), key=lambda status: _RANKS[status.activity])
            rows[robot] = self._builds.get(robot) or at_rest
        return rows

    def take(self, event: events.Event, clock: str) -> None:
        """Take note of an event; `clock` is the time of day as people see it."""
        match event:
            case events.Started(robots=robots):
                starting = RobotStatus(Activity.STARTING, Activity.STARTING)
                self._results = {name: self._results.get(name, starting) for name in robots}
                self._builds = {name: status for name, status in self._builds.items() if name in robots}
                self._checks = {}
            case events.Settling(robot, file):
                self._builds[robot] = RobotStatus(Activity.SETTLING, f"settling: {file}" if file else "settling")
            case events.Building(robot):
                self._builds[robot] = RobotStatus(Activity.BUILDING, Activity.BUILDING)
            case events.Waiting(robot, reason, diagnostics):
                self._builds[robot] = RobotStatus(Activity.WAITING, _with_error(reason, diagnostics))
            case events.Unchanged(robot):
                self._builds.pop(robot, None)
            case events.Built(result) | events.Failed(result):
                self._builds.pop(result.robot, None)
                self._results[result.robot] = _after_build(result, clock, self._results.get(result.robot))
            case events.Checking(robot):
                self._checks[robot] = RobotStatus(Activity.CHECKING, Activity.CHECKING)
            case events.CheckDone(robot, checked, diagnostics=diagnostics):
                self._checks.pop(robot, None)
                if checked is Checked.WRONG:
                    self._checks[robot] = RobotStatus(Activity.ERROR, _with_error("checked with errors", diagnostics))
            case events.Paused(reason):
                self.pause_reason = reason
            case events.Resumed():
                self.pause_reason = ""
            case _:
                pass

    def lines(self, room: int, *, marks: bool) -> Iterator[StyledLine]:
        """Yield a line for each robot for which there is room, and one for all others.

        If there are too many robots, those that need attention are shown.
        """
        rows = self.rows
        if rows and room >= _SPACED:
            yield line(("", ""))
            room -= 1
        if self.pause_reason:
            yield line((f"paused: {self.pause_reason}", "yellow"))
            room -= 1
        by_rank = sorted(rows, key=lambda robot: _RANKS[rows[robot].activity])
        number = len(rows) if len(rows) <= room else max(room - 1, 0)  # the last line takes room, too
        width = min(max(map(len, by_rank[:number]), default=0), NAME_WIDTH)
        for robot in (robot for robot in rows if robot in by_rank[:number]):
            activity, said = rows[robot]
            mark, style = _SIGNS.get(activity, _BUSY)
            name = f"{robot:<{width}}" if len(robot) <= width else f"{robot[: width - 1]}…"
            words = f"  {said}", "" if activity is Activity.IN_STEP else style
            yield line((f"{mark} " if marks else "", style), (name, "bold"), words)
        if counts := Counter(rows[robot].activity for robot in by_rank[number:]):
            rest = ", ".join(f"{counts[activity]} {activity}" for activity in Activity if counts[activity])
            yield line((f"… and {counts.total()} more: {rest}", "dim"))


def _after_build(result: Result, clock: str, before: RobotStatus | None) -> RobotStatus:
    if result.failed:
        return RobotStatus(Activity.ERROR, _with_error(Activity.ERROR, result.diagnostics))
    if result.conflicts:
        files = [(action.origin or action.path).rpartition("/")[2] for action in result.conflicts]
        where = files[0] if len(files) == 1 else f"{len(files)} files"
        return RobotStatus(Activity.CONFLICT, f"{Activity.CONFLICT} in {where}: waiting for `urdfsync resolve`")
    if result.is_broken:
        return RobotStatus(Activity.ERROR, _with_error("broken", result.diagnostics))
    if not result.writes and before is not None and before.activity is Activity.IN_STEP:
        return before  # with the time of the build that wrote something
    return RobotStatus(Activity.IN_STEP, f"in step, built at {clock}" if result.writes else "in step")


def _with_error(words: str, diagnostics: Sequence[Diagnostic]) -> str:
    """Return words with place and message of the first error, or else of the first finding, if there is any."""
    found = next((one for one in diagnostics if one.severity is Severity.ERROR), next(iter(diagnostics), None))
    if found is None:
        return words
    place = f"{found.file}:{found.line}: " if found.line else f"{found.file}: " if found.file else ""
    return " ".join(f"{words}: {place}{found.message}".split())
