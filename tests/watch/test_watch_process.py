"""`urdfsync watch` as a process: signals, locks, limits of the system. Most tests run it in their own process."""

from __future__ import annotations

import multiprocessing
import os
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from support.daemon import LIMIT, REPOSITORY, Daemons, Watch, holds, ladder, stopped

from urdfsync import cli, registry
from urdfsync.commands import watch as command
from urdfsync.state.transaction import Transactions
from urdfsync.watch import events
from urdfsync.watch.report import JsonReport

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")

QUEUE = Path("/proc/sys/fs/inotify/max_queued_events")
SETPRIV = "setpriv"
ROBOT = '[robots.{0}]\nsource = "{1}"\npackage = "{0}"\ndomain = "rcnetwork"\n'

Capture = pytest.CaptureFixture[str]
Start = Callable[..., Watch]


def watch_until(
    monkeypatch: pytest.MonkeyPatch, kind: type[events.Event], then: Callable[[], None], *arguments: str
) -> int:
    """Run the command in this thread, and do something at the first event of a kind; returns the exit code."""
    show, done = JsonReport.show, list[int]()

    def listen(self: JsonReport, event: events.Event) -> None:
        show(self, event)
        if isinstance(event, kind) and not done:
            done.append(1)
            then()

    with monkeypatch.context() as patch:
        patch.setattr(JsonReport, "show", listen)
        return cli.main(["watch", "--json", "--settle", "0", "--sample", "0", *arguments])


def send(number: int) -> Callable[[], None]:
    return lambda: os.kill(os.getpid(), number)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 0), (signal.SIGHUP, 0)])
def test_signals_end_it(
    project: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, number: signal.Signals, code: int
) -> None:
    before = signal.getsignal(number)
    signal.signal(number, lambda *_: None)  # `nohup` may have the tests ignore it
    try:
        assert watch_until(monkeypatch, events.Built, send(number)) == code
    finally:
        signal.signal(number, before)
    out, err = capsys.readouterr()
    assert out.splitlines()[-1].endswith(f'"signal": "{number.name}"}}')
    assert err == ""
    assert holds(220.5)
    assert cli.main(["build", "--check", "--quiet"]) == 0


def test_a_signal_during_a_build_leaves_all_or_nothing(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A build that has begun to write is finished, another one is given up."""
    cli.main(["build", "--quiet"])
    Path("ladder.json").write_text(ladder(330))
    assert watch_until(monkeypatch, events.Building, send(signal.SIGTERM)) == 0
    assert holds(220.5)
    real = Transactions.apply

    def apply(self: Any, *arguments: Any) -> Any:
        os.kill(os.getpid(), signal.SIGTERM)
        return real(self, *arguments)

    monkeypatch.setattr(Transactions, "apply", apply)
    assert watch_until(monkeypatch, events.Stopping, lambda: None) == 0
    assert holds(330)
    assert not Path(".urdfsync/planned.json").exists()
    assert cli.main(["build", "--check", "--quiet"]) == 0


def test_a_read_that_never_ends_does_not_hold_a_signal_up(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The system waits for a file or a process: the first signal waits for it in vain, the timer ends it."""
    monkeypatch.setattr(command, "_GRACE", 0.2)
    reader, writer = os.pipe()
    domain = registry.domain("rcnetwork")
    monkeypatch.setattr(type(domain), "read", lambda *_, **__: os.read(reader, 1))
    timer = threading.Timer(0.5, send(signal.SIGTERM))
    timer.start()
    begin = time.process_time()
    assert cli.main(["watch", "--json", "--settle", "0", "--sample", "0"]) == 0
    assert time.process_time() - begin < 10
    timer.join()
    os.close(reader)
    os.close(writer)


ENDLESS = "<%- for a in range(99999) %><% for b in range(99999) %><% endfor %><% endfor -%>\n"
"""Begin of a template that takes longer than anybody waits."""


@pytest.mark.parametrize("robots", [1, pytest.param(6, marks=pytest.mark.slow)], ids=["in the daemon", "in workers"])
def test_a_job_that_never_ends_does_not_hold_a_signal_up(
    project: Path, monkeypatch: pytest.MonkeyPatch, robots: int
) -> None:
    monkeypatch.setattr(command, "_GRACE", 0.5)
    config = "\n".join(f'{ROBOT.format(f"r{n}", "ladder.json")}templates = "templates"\n' for n in range(robots))
    Path("urdfsync.toml").write_text(config)
    template = Path("templates/element/model.mo.jinja")
    template.parent.mkdir(parents=True)
    template.write_text(ENDLESS + (REPOSITORY / "tests/rcnetwork" / template).read_text())
    timer = threading.Timer(2.0, send(signal.SIGTERM))  # until it renders
    assert watch_until(monkeypatch, events.Building, timer.start, "--jobs", "2") == 0
    assert not Path("modelica").exists()
    for child in multiprocessing.active_children():
        child.join(LIMIT)
    assert multiprocessing.active_children() == []


# Processes of their own


@pytest.fixture
def start(project: Path, rc_site: Path, tmp_path: Path) -> Iterator[Start]:
    """A function that starts a daemon in the project, and waits until all is built; it is killed after the test."""
    running = []

    def begin(*arguments: str, before: Sequence[str] = ()) -> Watch:
        path, store = [rc_site, REPOSITORY / "tests" / "rcnetwork"], str(tmp_path / "pre-commit")
        quick = ("--settle", "20", "--sample", "10", *arguments)
        running.append(Watch(project, *quick, path=path, before=before, PRE_COMMIT_HOME=store).__enter__())
        running[-1].rest()
        return running[-1]

    yield begin
    for watch in running:
        watch.__exit__()


@pytest.mark.slow
def test_one_daemon_at_a_time_and_one_that_was_killed_leaves_no_lock(start: Start, capsys: Capture) -> None:
    watch = start()
    assert cli.main(["watch"]) == 4
    out, err = capsys.readouterr()
    assert f"process {watch.process.pid} watches this configuration already" in err
    assert out == ""
    watch.process.kill()
    watch.process.wait(LIMIT)
    Daemons().stop()


@pytest.mark.slow
@pytest.mark.skipif(not QUEUE.is_file(), reason="no inotify")
def test_an_overflow_of_events_is_made_good(project: Path, start: Start) -> None:
    """While the daemon is stopped, more happens than the system remembers: also where it looks for changes."""
    watch = start("--rescan", "1")
    since = watch.mark
    with stopped(watch.process):
        one, two = project / "one", project / "two"
        one.write_text("")
        for _ in range(int(QUEUE.read_text()) // 2 + 1000):  # a rename is two events
            one.rename(two)
            one, two = two, one
        Path("ladder.json").write_text(ladder(330))  # its own events are lost
    watch.wait("built", since=since)
    assert holds(330)
    assert watch.stop() == 0
    assert watch.errors == ""


def await_rescans() -> None:
    """Wait until several rescans of 0.1 s must have been: each tries again, and says nothing."""
    time.sleep(1)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits other processes")
def test_a_full_disk_is_told_once_and_recovers(start: Start) -> None:
    import resource

    watch = start("--rescan", "0.1")
    before = resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE, (1, before[1]))
    Path("ladder.json").write_text(ladder(330))
    assert watch.wait("failed")["diagnostics"][0]["code"] == "output-not-writable"
    since = watch.mark
    await_rescans()
    assert watch.mark == since
    assert not holds(330)
    resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE, before)
    assert watch.wait("built", since=since)["recovered"]
    assert holds(330)


@pytest.mark.slow
@pytest.mark.skipif(os.geteuid() == 0 and not shutil.which(SETPRIV), reason="root may read everything")
def test_a_folder_without_permission_is_told_once_and_recovers(start: Start) -> None:
    folder = Path("cad")
    folder.mkdir()
    shutil.copy("step.csv", folder)
    (folder / "ladder.json").write_text(ladder(220.5))
    Path("urdfsync.toml").write_text(ROBOT.format("Ladder", "cad/ladder.json"))
    powers = "-dac_override,-dac_read_search"
    before = [SETPRIV, f"--bounding-set={powers}", f"--inh-caps={powers}"] if os.geteuid() == 0 else []
    watch = start("--rescan", "0.1", "--patience", "0.2", before=before)
    since = watch.mark
    folder.chmod(0)
    try:
        assert watch.wait("failed", since=since)["diagnostics"][0]["code"] == "no-source"
        await_rescans()
    finally:
        folder.chmod(0o755)
    watch.wait("built", lambda event: event["recovered"], since)
    assert [event["event"] for event in watch.events[since:]].count("failed") == 1
