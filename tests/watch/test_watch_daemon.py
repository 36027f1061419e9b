"""The daemon within the test's process, where what can't be forced from outside can be: bugs and limits."""

from __future__ import annotations

import errno
import logging
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import watchdog.observers
from support.daemon import LIMIT, Daemons

from urdfsync import cli, registry
from urdfsync.engine.actions import Kind
from urdfsync.outcome import Result
from urdfsync.watch import build, events, observer
from urdfsync.watch.precommit import PrecommitStash
from urdfsync.watch.robots import WatchedRobot, WatchedRobots


@pytest.fixture
def start(project: Path) -> Iterator[Callable[..., Daemons]]:
    running = []

    def begin(**options: Any) -> Daemons:
        running.append(Daemons(**options))
        return running[-1]

    yield begin
    for daemon in running:
        daemon.stop()


Start = Callable[..., Daemons]


def edit(project: Path, old: str, new: str) -> None:
    source = project / "ladder.json"
    source.write_text(source.read_text().replace(old, new))


def until(condition: Callable[[], bool]) -> None:
    """Wait for something that no event tells."""
    deadline = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.parametrize("place", ["read", "artifacts"])
def test_a_bug_of_a_domain_is_one_error_and_the_daemon_goes_on(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    domain = registry.domain("rcnetwork")
    daemon = start()
    daemon.wait(events.Built)
    real = getattr(type(domain), place)

    def broken(self: Any, *arguments: Any, **options: Any) -> Any:
        if b"330" in (project / "ladder.json").read_bytes():
            raise ZeroDivisionError("by nothing")
        return real(self, *arguments, **options)

    monkeypatch.setattr(type(domain), place, broken)
    since = len(daemon.events)
    edit(project, "220.5", "330")
    (found,) = daemon.wait(events.Failed, since).result.diagnostics
    assert found.code == "internal"
    assert "ZeroDivisionError in test_watch_daemon.py" in found.message
    assert "by nothing" in found.message
    since = len(daemon.events)
    edit(project, "330", "331")
    assert daemon.wait(events.Built, since).recovered


def test_a_source_with_crlf_that_is_built_is_not_parsed_again(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The manifest has the hash of the text, whatever its line endings are."""
    source = project / "ladder.json"
    source.write_bytes(source.read_bytes().replace(b"\n", b"\r\n"))
    assert cli.main(["build", "--quiet"]) == 0
    domain, reads = registry.domain("rcnetwork"), list[int]()
    real = type(domain).read

    def read(self: Any, *arguments: Any, **options: Any) -> Any:
        reads.append(len(daemon.events))
        return real(self, *arguments, **options)

    monkeypatch.setattr(type(domain), "read", read)
    daemon = start()
    daemon.wait(events.Built)
    built = [type(event) for event in daemon.events].index(events.Built)
    until(lambda: bool(reads))  # when it warms up
    assert min(reads) > built


def test_a_build_is_not_made_sure_of_during_a_pause(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Changes are stashed away while a robot is built: the next build would take what is left for the user's."""
    real, stashed = build.build_robots, threading.Event()
    begun: list[bool] = []

    def results(*arguments: Any) -> Iterator[Result]:
        begun.append(stashed.is_set())
        if len(begun) == 1:
            stashed.set()
        yield from real(*arguments)

    monkeypatch.setattr(build, "build_robots", results)
    monkeypatch.setattr(PrecommitStash, "holder", lambda *_: 1 if stashed.is_set() else None)
    daemon = start()
    daemon.wait(events.Paused)
    stashed.clear()
    daemon.wait(events.Resumed)
    since = len(daemon.events)
    edit(project, "220.5", "330")
    assert daemon.wait(events.Built, since).files
    assert len(begun) > 1
    assert not any(begun)


def test_folders_that_can_not_be_watched_are_said_once_and_looked_at(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    full = threading.Event()
    full.set()
    real = observer.Observer._watch

    def limited(self: Any, *arguments: Any) -> None:
        if full.is_set():
            raise OSError(errno.ENOSPC, "inotify watch limit reached")
        real(self, *arguments)

    monkeypatch.setattr(observer.Observer, "_watch", limited)
    daemon = start(rescan=0.1)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert "fs.inotify.max_user_watches" in found.hint
    daemon.wait(events.Built)
    since = len(daemon.events)
    edit(project, "220.5", "330")
    assert daemon.wait(events.Built, since).files
    full.clear()
    daemon.wait(events.Recovered)
    assert sum(isinstance(event, events.Noted) for event in daemon.events) == 1


def test_a_system_without_events(project: Path, start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> None:
        raise OSError(errno.EMFILE, "inotify instance limit reached")

    monkeypatch.setattr(watchdog.observers, "Observer", refuse)
    daemon = start(rescan=0.1)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert "fs.inotify.max_user_instances" in found.hint
    daemon.wait(events.Built)
    since = len(daemon.events)
    edit(project, "220.5", "330")
    assert daemon.wait(events.Built, since).files


def test_an_edit_right_after_the_last_build_has_looked_is_seen_by_its_event(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody looks at outputs any more then, until an event or a rescan says so."""
    model, edited = project / "modelica/Ladder/Elements/R2.mo", threading.Event()
    real = WatchedRobots.has_built_all

    def has_built_all(self: WatchedRobots, watched: WatchedRobot) -> bool:
        known = real(self, watched)
        if known and not edited.is_set():
            edited.set()
            model.write_text(model.read_text() + "// mine\n")
        return known

    monkeypatch.setattr(WatchedRobots, "has_built_all", has_built_all)
    daemon = start(rescan=100000)
    result = daemon.wait(events.Built, since=3).result
    assert [action.path for action in result.actions if action.kind is Kind.KEEP] == ["modelica/Ladder/Elements/R2.mo"]


def test_an_edit_without_event_is_found_when_a_change_turns_out_to_be_none(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = project / "modelica/Ladder/Elements/R2.mo"
    real = observer._Handler.dispatch

    def dispatch(self: Any, event: Any) -> None:
        if "modelica" not in str(event.src_path):
            real(self, event)

    monkeypatch.setattr(observer._Handler, "dispatch", dispatch)
    daemon = start(rescan=100000)
    daemon.wait(events.Built)
    time.sleep(0.1)  # it makes sure that nobody else wrote
    since = len(daemon.events)
    model.write_text(model.read_text() + "// mine\n")
    (project / "ladder.json").touch()
    assert not daemon.wait(events.Built, since).files


def test_a_change_is_built_once_and_made_sure_of_once(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    real, ended = build.build_robots, []

    def results(*arguments: Any) -> Iterator[Result]:
        yield from real(*arguments)
        ended.append(time.monotonic())

    monkeypatch.setattr(build, "build_robots", results)
    daemon = start(rescan=0.1)
    until(lambda: len(ended) == 2)
    since = len(daemon.events)
    edit(project, "220.5", "330")
    until(lambda: len(ended) == 4)
    time.sleep(0.3)  # events of its own writing, and some rescans
    assert len(ended) == 4
    assert [type(event) for event in daemon.events[since:]] == [events.Settling, events.Building, events.Built]


@pytest.mark.slow  # 2 s
def test_lost_events_are_made_good(project: Path, start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing gets in but that something was lost."""
    monkeypatch.setattr(observer._Handler, "dispatch", lambda self, event: None)
    daemon = start(rescan=100000)
    daemon.wait(events.Built)
    time.sleep(1)  # it makes sure that nobody else wrote, and would see the edit then
    since = len(daemon.events)
    edit(project, "220.5", "330")
    time.sleep(0.2)
    assert len(daemon.events) == since
    logging.getLogger("watchdog.observers.inotify_c").warning("Inotify queue overflowed")
    assert daemon.wait(events.Built, since).files


@pytest.mark.slow  # 1 s
def test_a_clock_that_jumps_does_not_matter(project: Path, start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    daemon = start(rescan=0.1)
    daemon.wait(events.Built)
    real = time.time, time.time_ns
    for hours, value in ((-1000, "330"), (1000, "331"), (-5, "332")):
        monkeypatch.setattr(time, "time", lambda hours=hours: real[0]() + 3600 * hours)
        monkeypatch.setattr(time, "time_ns", lambda hours=hours: real[1]() + 3600 * hours * 10**9)
        since = len(daemon.events)
        text = (project / "ladder.json").read_text()
        (project / "ladder.json").write_text(text.replace(text.split('"ohm": ')[2].split("}")[0], value))
        assert daemon.wait(events.Built, since).files
        assert value in (project / "modelica/Ladder/Elements/R2Parameters.mo").read_text()
