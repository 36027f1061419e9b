"""Checks of packages while the daemon goes on: in a thread of their own, one after the other.

What was asked for later takes the place of what was asked for earlier: a check of files that are not those of the
package any more is given up. Everything but the check itself happens in the daemon's thread.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from types import TracebackType
from typing import Self

import msgspec

from urdfsync.check.afterbuild import BuildCheck, BuildChecker, CheckRobots, is_general
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Checked
from urdfsync.watching import builder, events

_PATIENCE = 10.0
"""Seconds that a check gets to end when the daemon does; a compiler that is left then ends with the process."""


class Errand(msgspec.Struct, eq=False):
    """One check that was asked for."""

    robot: RobotConfig
    inspector: BuildChecker
    fingerprint: str | None
    given_up: bool = False


class Checks:
    """Checks of the robots that are watched; stopped at the end of its context."""

    def __init__(
        self,
        request: BuildOptions,
        tell: Callable[[events.Event], None],
        ended: Callable[[Errand, BuildCheck | None], None],
        examine: CheckRobots,
    ) -> None:
        """`ended` is called from another thread, and has to see to it that this one calls the method of that name."""
        self._request, self._tell, self._ended, self._examine = request, tell, ended, examine
        self._waiting: dict[str, Errand] = {}
        self._running: Errand | None = None
        self._thread: threading.Thread | None = None
        self._known: dict[str, tuple[str | None, events.Checked]] = {}
        self._said: set[Diagnostic] = set()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.reset()
        if self._thread is not None:
            self._thread.join(_PATIENCE)

    def ask(self, config: Config, robot: RobotConfig) -> None:
        """Check the package of a robot as it is now, unless that is under way, or known already."""
        if not robot.checking:
            return
        inspector = BuildChecker(config, self._request, self._examine)
        fingerprint = inspector.cache.key(robot)
        pending = self._pending(robot.name)
        if pending is not None and fingerprint is not None and pending.fingerprint == fingerprint:
            return
        if pending is not None:
            self._give_up(pending)
        told, last = self._known.get(robot.name, (None, None))
        if last is not None and fingerprint is not None and told == fingerprint:
            if pending is not None:
                self._tell(last)
        elif found := inspector.known(robot, fingerprint):
            was_right = pending is None and (last is None or last.checked is Checked.RIGHT)
            self._conclude(robot, fingerprint, found, silent=was_right and found.checked is Checked.RIGHT)
        else:
            self._waiting[robot.name] = Errand(robot, inspector, fingerprint)
            self._go_on()

    def ended(self, errand: Errand, found: BuildCheck | None) -> None:
        """Take note of the end of a check that was told of, and make the next one."""
        self._running = None
        if found is not None and not errand.given_up:
            self._conclude(errand.robot, errand.fingerprint, found)
        self._go_on()

    def reset(self) -> None:
        """Give up all checks, and forget what was found."""
        for errand in (*self._waiting.values(), *([self._running] if self._running else [])):
            self._give_up(errand)
        self._known.clear()

    def _pending(self, name: str) -> Errand | None:
        """The check of a robot that waits or runs."""
        running = self._running
        runs = running is not None and running.robot.name == name and not running.given_up
        return self._waiting.get(name) or (running if runs else None)

    def _give_up(self, errand: Errand) -> None:
        errand.given_up = True
        self._waiting.pop(errand.robot.name, None)

    def _go_on(self) -> None:
        """Begin with the next check, unless one runs."""
        if self._running is not None or not self._waiting:
            return
        name, errand = next(iter(self._waiting.items()))
        self._running = self._waiting.pop(name)
        self._tell(events.Checking(name))
        self._thread = threading.Thread(target=self._run, args=(errand,), name=f"check of {name}", daemon=True)
        self._thread.start()

    def _run(self, errand: Errand) -> None:
        """Make a check; in its thread."""

        def tell(what: str, done: int, total: int) -> None:  # noqa: ARG001 - a place at which it can be given up
            if errand.given_up:
                raise builder.StoppedError

        found = None
        try:
            found = next(errand.inspector.check([errand.robot], tell))
        except builder.StoppedError:
            pass
        except Exception as error:  # noqa: BLE001 - a bug that one robot meets must not end the checks of all
            found = BuildCheck(Checked.WRONG, (builder.unexpected(error, "it can't be checked"),))
        finally:
            self._ended(errand, found)

    def _conclude(
        self, robot: RobotConfig, fingerprint: str | None, found: BuildCheck, *, silent: bool = False
    ) -> None:
        """Remember what was found, and tell it; what is about the machine is told once."""
        new = tuple(one for one in found.diagnostics if one not in self._said)
        self._said.update(one for one in new if is_general(one))
        event = events.Checked(robot.name, found.checked, round(found.seconds, 3), new)
        self._known[robot.name] = fingerprint, event
        if not silent:
            self._tell(event)
