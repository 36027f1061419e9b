"""Checks beside the daemon's work: which are made, given up and told; with a check that waits for the test."""

from __future__ import annotations

import queue
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from support.daemon import LIMIT

from urdfsync import config
from urdfsync.check.afterbuild import BuildCheck
from urdfsync.check.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.outcome import Checked
from urdfsync.watching import events
from urdfsync.watching.checks import Checks, Errand

RIGHT = CheckResult("ladder", "Ladder", compiled=(CompiledModel("Ladder", 12, 3),), seconds=2.5)
BROKEN = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", "modelica/Ladder/Elements/R2.mo", 3)
WRONG = CheckResult("ladder", "Ladder", diagnostics=(BROKEN,), seconds=1.0)
SYNTAX = CheckResult("ladder", "Ladder", unchecked=("nothing was compiled, since there is no library",))
NOTE = Diagnostic(Severity.WARNING, "not-checked", SYNTAX.unchecked[0])

OTHER = '[robots.other]\nsource = "ladder.json"\npackage = "Other"\ndomain = "rcnetwork"\non_build = "check"\n'


class Bench:
    """Checks that end when the test says so, and what they told."""

    def __init__(self) -> None:
        self.told: list[events.Event] = []
        self.begun: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._ends: dict[str, queue.SimpleQueue[CheckResult | Exception]] = {"ladder": queue.SimpleQueue()}
        self._ends["other"] = queue.SimpleQueue()
        self._over: queue.SimpleQueue[tuple[Errand, BuildCheck | None]] = queue.SimpleQueue()
        self.checks = Checks(BuildOptions(), self.told.append, lambda *end: self._over.put(end), self._examine)
        self.config = config.load(Path("urdfsync.toml"))

    def _examine(
        self, config: Config, robots: Sequence[RobotConfig], options: CheckOptions, tell: Progress
    ) -> Iterator[CheckResult]:
        (robot,) = robots
        self.begun.put(robot.name)
        while True:
            tell("compiling", 0, 1)
            try:
                verdict = self._ends[robot.name].get(timeout=0.01)
            except queue.Empty:
                continue
            if isinstance(verdict, Exception):
                raise verdict
            yield verdict
            return

    def ask(self, number: int = 0) -> None:
        """As the daemon does after a build of the robot of this number."""
        self.checks.ask(self.config, self.config.robots[number])

    def end(self, verdict: CheckResult | Exception, robot: str = "ladder") -> None:
        """Let the check of a robot end, as soon as it runs."""
        self._ends[robot].put(verdict)
        self.receive()

    def receive(self) -> None:
        """Take note of the next end of a check, as the daemon does."""
        self.checks.ended(*self._over.get(timeout=LIMIT))

    def news(self) -> list[events.Event]:
        """What was told since the last time."""
        told = list(self.told)
        self.told.clear()
        return told


@pytest.fixture
def bench(project: Path) -> Iterator[Bench]:
    """Two robots that are built, and whose packages are to be checked."""
    with (project / "urdfsync.toml").open("a") as file:
        file.write(f'on_build = "check"\n{OTHER}')
    found = Bench()
    assert not any(result.failed for result in build(found.config, found.config.robots, BuildOptions()))
    with found.checks:
        yield found


def edit(project: Path, text: str = "// mine\n") -> None:
    with (project / "modelica" / "Ladder" / "Elements" / "R2.mo").open("a") as file:
        file.write(text)


BEGUN = events.Checking("ladder")
FINE = events.Checked("ladder", Checked.RIGHT, 2.5)
BAD = events.Checked("ladder", Checked.WRONG, 1.0, (BROKEN,))


def test_a_check_begins_and_ends(bench: Bench) -> None:
    bench.ask()
    assert bench.news() == [BEGUN]
    bench.end(RIGHT)
    assert bench.news() == [FINE]


def test_what_is_known_is_not_checked_again(bench: Bench, project: Path) -> None:
    bench.ask()
    bench.end(RIGHT)
    bench.news()
    bench.ask()
    assert bench.news() == []
    edit(project)
    bench.ask()
    bench.end(WRONG)
    assert bench.news() == [BEGUN, BAD]
    bench.ask()
    assert bench.news() == [], "nor is what is wrong, as long as nothing changes"


def test_what_an_earlier_command_found_right_is_not_worth_a_word(bench: Bench) -> None:
    bench.ask()
    bench.end(RIGHT)
    later = Bench()
    later.ask()
    assert later.news() == []


def test_what_was_wrong_and_is_again_as_it_was_when_right_is_told(bench: Bench, project: Path) -> None:
    bench.ask()
    bench.end(RIGHT)
    model = project / "modelica" / "Ladder" / "Elements" / "R2.mo"
    before = model.read_text()
    edit(project)
    bench.ask()
    assert bench.news()[-1] == BEGUN
    model.write_text(before)
    bench.ask()
    assert bench.news() == [FINE], "the check of what is there no more is given up"
    bench.receive()
    assert bench.news() == []


def test_one_at_a_time_in_the_order_of_builds(bench: Bench) -> None:
    bench.ask(0)
    bench.ask(1)
    assert bench.news() == [BEGUN]
    bench.end(RIGHT)
    assert bench.news() == [FINE, events.Checking("other")]
    bench.end(WRONG, "other")
    assert bench.news() == [events.Checked("other", Checked.WRONG, 1.0, (BROKEN,))]


def test_the_same_package_does_not_disturb_its_check(bench: Bench) -> None:
    bench.ask()
    bench.ask()
    bench.end(RIGHT)
    assert bench.news() == [BEGUN, FINE]


def test_a_newer_package_takes_the_place_of_the_one_that_is_checked(bench: Bench, project: Path) -> None:
    bench.ask()
    assert bench.begun.get(timeout=LIMIT) == "ladder"
    edit(project)
    bench.ask()
    bench.receive()
    bench.end(WRONG)
    assert bench.news() == [BEGUN, BEGUN, BAD]


def test_and_that_of_one_that_waits(bench: Bench, project: Path) -> None:
    bench.ask(1)
    bench.ask(0)
    edit(project)
    bench.ask(0)
    bench.end(RIGHT, "other")
    bench.end(WRONG)
    assert bench.news()[2:] == [BEGUN, BAD]


def test_what_is_known_when_a_check_ends_too_late_stays_so(bench: Bench, project: Path) -> None:
    bench.ask()
    bench._ends["ladder"].put(RIGHT)
    over = bench._over.get(timeout=LIMIT)
    edit(project)
    bench.ask()
    bench.checks.ended(*over)
    assert bench.news() == [BEGUN, BEGUN], "that was a check of another package"


def test_what_can_not_be_checked_is_said_once(bench: Bench, project: Path) -> None:
    bench.ask(0)
    bench.ask(1)
    bench.end(SYNTAX)
    bench.end(SYNTAX, "other")
    incomplete = events.Checked("ladder", Checked.INCOMPLETE, 0.0, (NOTE,))
    assert bench.news()[1::2] == [incomplete, events.Checked("other", Checked.INCOMPLETE)]


def test_a_bug_is_one_error_and_the_next_check_is_made(bench: Bench) -> None:
    bench.ask(0)
    bench.ask(1)
    bench.end(ZeroDivisionError("by nothing"))
    told = bench.news()[1]
    assert isinstance(told, events.Checked)
    assert told.diagnostics[0].code == "internal"
    bench.end(RIGHT, "other")
    assert isinstance(bench.news()[-1], events.Checked)


def test_a_new_configuration_begins_anew(bench: Bench, project: Path) -> None:
    bench.ask()
    bench.end(WRONG)
    bench.news()
    bench.checks.reset()
    bench.ask()
    bench.end(WRONG)
    assert bench.news() == [BEGUN, BAD]


def test_at_the_end_nothing_is_left_running(bench: Bench) -> None:
    before = threading.active_count()
    bench.ask(0)
    bench.ask(1)
    bench.checks.__exit__(None, None, None)
    assert threading.active_count() == before
    bench.receive()
    assert bench.news() == [BEGUN]


def test_robots_without_checks_are_left_alone(bench: Bench, project: Path) -> None:
    text = (project / "urdfsync.toml").read_text()
    (project / "urdfsync.toml").write_text(text.replace('"check"', '"nothing"'))
    bench.config = config.load(Path("urdfsync.toml"))
    bench.ask()
    assert bench.news() == []
