"""How each robot stands while `urdfsync watch` runs: pure, told of events, for a status line per robot."""

from __future__ import annotations

import enum
from collections import Counter
from collections.abc import Sequence

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Checked, Result
from urdfsync.watching import events

_WRONG = "checked with errors"


class Mood(enum.StrEnum):
    """What a robot is at, in words; those that need the user's attention come first."""

    ERROR = "error"
    CONFLICT = "conflict"
    WAITING = "waiting"
    BUILDING = "building"
    CHECKING = "checking"
    SETTLING = "settling"
    STARTING = "not looked at yet"
    IN_STEP = "in step"

    @property
    def rank(self) -> int:
        """Place in this order, from 0."""
        return list(Mood).index(self)


class Standing(msgspec.Struct, frozen=True):
    """One robot at one moment."""

    robot: str
    mood: Mood
    words: str
    """How it stands, as the rest of a line that names the robot."""


class Board:
    """All robots that are watched."""

    def __init__(self) -> None:
        self.paused = ""
        """Why nothing is built for now; empty if robots are built."""
        self._rest: dict[str, Standing] = {}
        self._busy: dict[str, Standing] = {}
        self._checks: dict[str, Standing] = {}

    @property
    def standings(self) -> Sequence[Standing]:
        """Each robot, in the order of the configuration: what it is at, else what matters more, build or check."""
        return [self._busy.get(robot) or self._at_rest(robot, rest) for robot, rest in self._rest.items()]

    def _at_rest(self, robot: str, rest: Standing) -> Standing:
        return min(rest, self._checks.get(robot, rest), key=lambda standing: standing.mood.rank)

    def take(self, event: events.Event, clock: str) -> None:
        """Take note of an event; `clock` is the time of day as people see it."""
        match event:
            case events.Started(robots=robots):
                self._rest = {name: self._rest.get(name) or _plain(name, Mood.STARTING) for name in robots}
                self._busy = {name: busy for name, busy in self._busy.items() if name in self._rest}
                self._checks = {}
            case events.Settling(robot):
                self._busy[robot] = _plain(robot, Mood.SETTLING)
            case events.Waiting(robot, reason, diagnostics):
                self._busy[robot] = Standing(robot, Mood.WAITING, ": ".join([reason, *_first(diagnostics)]))
            case events.Building(robot):
                self._busy[robot] = _plain(robot, Mood.BUILDING)
            case events.Calm(robot):
                self._busy.pop(robot, None)
            case events.Built(result) | events.Failed(result):
                self._busy.pop(result.robot, None)
                self._rest[result.robot] = _after(result, clock, self._rest.get(result.robot))
            case events.Checking(robot):
                self._checks[robot] = _plain(robot, Mood.CHECKING)
            case events.Checked(robot, checked, diagnostics=diagnostics):
                self._checks.pop(robot, None)
                if checked is Checked.WRONG:
                    self._checks[robot] = Standing(robot, Mood.ERROR, ": ".join([_WRONG, *_first(diagnostics)]))
            case events.Paused(reason):
                self.paused = reason
            case events.Resumed():
                self.paused = ""
            case _:
                pass

    def step(self, what: str, done: int, total: int) -> None:
        """Take note of how far the build under way is."""
        for robot, busy in self._busy.items():
            if busy.mood is Mood.BUILDING and what != robot:
                count = f" {done} of {total}" if total > 1 else ""
                self._busy[robot] = Standing(robot, Mood.BUILDING, f"{Mood.BUILDING}: {what}{count}")

    def shown(self, room: int) -> tuple[Sequence[Standing], str]:
        """The robots for which there is room, and the others in words, empty if there are none.

        If not all find room, those that need attention do. The words take a line of the room, too.
        """
        standings = self.standings
        if len(standings) <= room:
            return standings, ""
        order = sorted(range(len(standings)), key=lambda index: standings[index].mood.rank)
        kept = set(order[: max(room - 1, 0)])
        rest = Counter(standings[index].mood for index in order[len(kept) :])
        words = ", ".join(f"{rest[mood]} {mood}" for mood in Mood if rest[mood])
        if len(rest) == 1:
            return [standings[index] for index in sorted(kept)], f"… and {words.replace(' ', ' more ', 1)}"
        return [standings[index] for index in sorted(kept)], f"… and {rest.total()} more: {words}"


def _plain(robot: str, mood: Mood) -> Standing:
    return Standing(robot, mood, mood)


def _after(result: Result, clock: str, before: Standing | None) -> Standing:
    """How a robot stands after a build."""
    robot = result.robot
    if result.failed:
        return Standing(robot, Mood.ERROR, ": ".join([Mood.ERROR, *_first(result.diagnostics)]))
    if result.conflicts:
        files = [(action.origin or action.path).rpartition("/")[2] for action in result.conflicts]
        where = files[0] if len(files) == 1 else f"{len(files)} files"
        return Standing(robot, Mood.CONFLICT, f"{Mood.CONFLICT} in {where}")
    if result.in_step and before is not None and before.mood is Mood.IN_STEP:
        return before
    return Standing(robot, Mood.IN_STEP, Mood.IN_STEP if result.in_step else f"{Mood.IN_STEP}, built at {clock}")


def _first(diagnostics: Sequence[Diagnostic]) -> list[str]:
    """The place and the message of what is wrong, at most one."""
    errors = [found for found in diagnostics if found.severity is Severity.ERROR] or list(diagnostics)
    for found in errors[:1]:
        place = f"{found.file}:{found.line}: " if found.line else f"{found.file}: " if found.file else ""
        return [" ".join(f"{place}{found.message}".split())]
    return []
