"""The daemon with `on_build = "check"`: when it asks for checks, and that it goes on beside them."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import psutil
import pytest
from support.daemon import LIMIT, MODEL, RECORD, REPOSITORY, Daemons, Watch, until
from support.networks import configure, edit

from urdfsync.analysis.checks import run
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.fingerprint import fingerprint
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.engine.options import Progress
from urdfsync.engine.result import Checked
from urdfsync.project.config import Config, RobotConfig
from urdfsync.watch import events

RIGHT = CheckResult("ladder", "Ladder", compiled=(CompiledModel("Ladder", 12),), seconds=2.5)
BROKEN = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", "modelica/Ladder/Elements/R2.mo", 3)
WRONG = CheckResult("ladder", "Ladder", diagnostics=(BROKEN,))


class Compiler:
    """A stand-in that compiles until it is set free, then finds wrong what mentions `Foo`, and remembers all else."""

    def __init__(self) -> None:
        self.free = threading.Event()
        self.free.set()
        self.saw: list[str] = []

    def __call__(
        self, config: Config, robots: Sequence[RobotConfig], options: CheckOptions, tell: Progress
    ) -> Iterator[CheckResult]:
        if not robots:  # all checks are remembered
            return
        self.saw.append(RECORD.read_text())
        wrong, key = "Foo" in MODEL.read_text(), fingerprint(config, robots[0], options)
        while True:
            tell("compiling", 0, 1)
            if self.free.wait(0.01):
                if key and not wrong:
                    UserCache.default().save(key, RIGHT)
                yield WRONG if wrong else RIGHT
                return


Start = Callable[[Compiler], Daemons]


@pytest.fixture
def start(project: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Start]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(project.parent / "cache"))  # else what earlier tests found right is known
    running = []

    def begin(compiler: Compiler) -> Daemons:
        monkeypatch.setattr(run, "_check_in_workers", compiler)
        running.append(Daemons())
        return running[-1]

    configure('on_build = "check"\n')
    yield begin
    for daemon in running:
        daemon.stop()


def renew() -> None:
    """Change the source."""
    edit("ladder.json", "220.5", "330")


def held(start: Start) -> tuple[Compiler, Daemons]:
    """A compiler that is never done until it is set free, and a daemon for which it works."""
    compiler = Compiler()
    compiler.free.clear()
    daemon = start(compiler)
    daemon.wait(events.Checking)
    return compiler, daemon


def test_each_build_is_checked_once(project: Path, start: Start) -> None:
    compiler = Compiler()
    daemon = start(compiler)
    daemon.wait(events.CheckDone)
    since = daemon.mark
    found = daemon.after(renew, events.CheckDone)
    assert (found.checked, found.seconds) == (Checked.RIGHT, 2.5)
    assert daemon.kinds(since) == ["Settling", "Building", "Built", "Checking", "CheckDone"]
    assert ["330" in text for text in compiler.saw] == [False, True]


def test_an_edit_that_does_not_compile_is_told_and_so_is_its_end(project: Path, start: Start) -> None:
    daemon = start(Compiler())
    daemon.wait(events.CheckDone)
    text = MODEL.read_text()
    found = daemon.after(lambda: edit(MODEL, "end R2;", "  Foo foo;\nend R2;"), events.CheckDone)
    assert (found.checked, found.diagnostics) == (Checked.WRONG, (BROKEN,))
    assert daemon.after(lambda: MODEL.write_text(text), events.CheckDone).checked is Checked.RIGHT


def test_builds_go_on_while_a_package_is_checked_and_the_last_one_counts(project: Path, start: Start) -> None:
    compiler, daemon = held(start)
    since = daemon.mark
    assert daemon.after(renew, events.Built).files
    daemon.wait(events.Checking, since)
    daemon.after(compiler.free.set, events.CheckDone)
    assert daemon.kinds().count("CheckDone") == 1
    assert "330" in compiler.saw[-1]


def test_a_source_that_can_not_be_built_leaves_the_check_of_the_last_build_alone(project: Path, start: Start) -> None:
    compiler, daemon = held(start)
    daemon.after(lambda: Path("ladder.json").write_text("{"), events.Failed)
    daemon.after(compiler.free.set, events.CheckDone)
    assert len(compiler.saw) == 1


def test_a_package_that_was_right_is_not_checked_again_at_the_start(project: Path, start: Start) -> None:
    first, second = Compiler(), Compiler()
    daemon = start(first)
    daemon.wait(events.CheckDone)
    daemon.stop()
    daemon = start(second)
    assert daemon.wait(events.CheckDone).checked is Checked.RIGHT
    assert second.saw == []
    daemon.after(renew, events.CheckDone)
    assert ["330" in text for text in second.saw] == [True]


OTHER = '[robots.other]\nsource = "ladder.json"\npackage = "Other"\ndomain = "rcnetwork"\non_build = "check"\n'


@pytest.fixture
def other(project: Path, start: Start) -> None:
    """Another robot to check."""
    configure(OTHER)


@pytest.mark.usefixtures("other")
def test_one_package_is_checked_at_a_time_in_the_order_of_builds(project: Path, start: Start) -> None:
    compiler, daemon = held(start)
    until(lambda: daemon.kinds().count("Built") == 2 and bool(compiler.saw))
    time.sleep(0.2)
    assert len(compiler.saw) == 1
    edit(MODEL, "end R2;", "  Foo foo;\nend R2;")  # takes the place of the first
    until(lambda: daemon.kinds().count("Built") == 3)
    compiler.free.set()
    until(lambda: daemon.kinds().count("CheckDone") == 2)
    found = [event for event in daemon.events if isinstance(event, events.CheckDone)]
    assert [event.robot for event in found] == ["other", "ladder"]


@pytest.mark.usefixtures("other")
def test_what_this_machine_lacks_is_told_once(start: Start) -> None:
    lacking = "nothing was compiled, since there is no library"

    class Nothing(Compiler):
        def __call__(self, *_: object) -> Iterator[CheckResult]:
            yield CheckResult("ladder", "Ladder", unchecked=(lacking,))

    daemon = start(Nothing())
    until(lambda: daemon.kinds().count("CheckDone") == 2)
    found = [event for event in daemon.events if isinstance(event, events.CheckDone)]
    assert [event.checked for event in found] == 2 * [Checked.INCOMPLETE]
    assert [one.message for event in found for one in event.diagnostics] == [lacking]


@pytest.mark.usefixtures("other")
def test_a_bug_in_a_check_is_one_error_and_the_next_check_is_made(start: Start) -> None:
    class Broken(Compiler):
        def __call__(self, *_: object) -> Iterator[CheckResult]:
            self.saw.append("")
            if len(self.saw) == 1:
                raise ZeroDivisionError("by nothing")
            yield RIGHT

    daemon = start(Broken())
    until(lambda: daemon.kinds().count("CheckDone") == 2)
    first, second = (event for event in daemon.events if isinstance(event, events.CheckDone))
    assert [one.code for one in first.diagnostics] == ["internal"]
    assert second.checked is Checked.RIGHT


@pytest.fixture
def stuck(project: Path, rc_site: Path, tmp_path: Path, modelica_library: Path) -> Iterator[Watch]:
    """A daemon in a process of its own, with a compiler that is never done; names are resolved before it begins."""
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / "rumoca.py").write_text("import time\n\nwhile True:\n    time.sleep(60)\n")
    home = {name: str(tmp_path / "home") for name in ("HOME", "XDG_CACHE_HOME")}
    configure(f'on_build = "check"\n[check]\nlibrary = "{modelica_library.as_posix()}"\n')
    path = [tmp_path / "site", rc_site, REPOSITORY / "tests" / "rcnetwork"]
    with Watch(project, path=path, **home) as watch:
        yield watch


def compilers(watch: Watch) -> list[psutil.Process]:
    """All processes that work for the daemon, once a compiler is among them."""
    deadline = time.monotonic() + LIMIT
    while time.monotonic() < deadline and not any(event["event"] == "checked" for event in watch.events):
        with contextlib.suppress(psutil.NoSuchProcess):
            found = psutil.Process(watch.process.pid).children(recursive=True)
            if any("urdfsync.analysis.checks.process" in process.cmdline() for process in found):
                return found
        time.sleep(0.05)
    raise AssertionError(watch.said)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize(
    ("signals", "code"),
    [
        pytest.param([signal.SIGTERM], 0, marks=pytest.mark.large),
        pytest.param([signal.SIGKILL], -9, marks=pytest.mark.large),
        pytest.param([signal.SIGINT], 130, marks=pytest.mark.large),
        ([signal.SIGINT, signal.SIGINT], 130),
    ],
)
def test_builds_go_on_beside_a_compiler_that_is_never_done_and_it_does_not_outlive_the_daemon(
    stuck: Watch, project: Path, signals: list[int], code: int
) -> None:
    stuck.wait("checking")
    first, since = compilers(stuck), stuck.mark
    renew()
    stuck.wait("built", lambda event: bool(event["files"]), since)
    stuck.wait("checking", since=since)
    helpers = compilers(stuck)
    passing = [one for one in first if one not in helpers]  # Python keeps one for locks as long as the daemon runs
    assert psutil.wait_procs(passing, LIMIT)[1] == []
    assert len(passing) > 1, "what is checked now is the newer package"
    for number in signals:
        stuck.process.send_signal(number)
    assert stuck.process.wait(LIMIT) == code, stuck.said
    assert psutil.wait_procs(helpers, LIMIT)[1] == []
    assert stuck.errors == ""
