"""What happens to a daemon at a certain moment, and what goes wrong in it: in a thread of the test."""

from __future__ import annotations

import errno
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
import watchdog.observers
from support.daemon import MODEL, RECORD, Daemons, holds, ladder

from urdfsync import registry
from urdfsync.watch import events
from urdfsync.watch.observer import Observer

NEVER = 100000.0
KEEP = [("keep", str(MODEL))]


@pytest.fixture
def running(project: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Daemons]]:
    """Daemons that are stopped after the test."""
    monkeypatch.setenv("PRE_COMMIT_HOME", str(project.parent / "pre-commit"))
    found: list[Daemons] = []
    yield found
    for daemon in found:
        daemon.stop()


@pytest.fixture
def without_events(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a network mount, or a mount of a container."""
    monkeypatch.setattr(Observer, "dispatch", lambda *_: None)


def put(ohm: float) -> None:
    """Change the source."""
    Path("ladder.json").write_text(ladder(ohm))


@pytest.mark.usefixtures("without_events")
def test_an_edit_during_a_build_is_seen_without_its_event(running: list[Daemons]) -> None:
    """The daemon waits for whoever is told of a build, before it looks at what the build left."""

    def edit(event: events.Event) -> None:
        if isinstance(event, events.Built) and not MODEL.read_text().endswith("// mine\n"):
            MODEL.write_text(MODEL.read_text() + "// mine\n")

    daemon = Daemons(edit, rescan=NEVER)
    running.append(daemon)
    result = daemon.wait(events.Built, 3).result
    assert [(one.reason, one.path) for one in result.actions.decided] == KEEP


@pytest.mark.usefixtures("without_events")
def test_without_events_rescans_find_what_changed(running: list[Daemons]) -> None:
    daemon = Daemons(rescan=0.1)
    running.append(daemon)
    daemon.after(lambda: put(330), events.Built)
    assert holds(330)


def test_what_is_stashed_away_during_a_build_is_not_built(project: Path, running: list[Daemons]) -> None:
    """The next build would take what is left for the user's."""
    store = project.parent / "pre-commit"
    store.mkdir()
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=project, stdin=subprocess.PIPE) as process:

        def stash(event: events.Event) -> None:
            if isinstance(event, events.Built) and process.poll() is None:
                (store / f"patch{int(time.time())}-{process.pid}").write_text("unstaged")
                RECORD.write_text("")

        daemon = Daemons(stash, rescan=NEVER)
        running.append(daemon)
        daemon.wait(events.Paused)
        assert daemon.kinds().count("Built") == 1
        RECORD.unlink()
        assert process.stdin
        process.stdin.close()
    daemon.wait(events.Built, 3, lambda event: bool(event.files))
    assert holds(220.5)


@pytest.mark.parametrize("place", ["read", "artifacts"])
def test_a_bug_of_a_domain_is_one_error_and_the_daemon_goes_on(
    running: list[Daemons], monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    daemon, domain = Daemons(rescan=NEVER), registry.domain("rcnetwork")
    running.append(daemon)
    real = getattr(type(domain), place)

    def broken(self: Any, *arguments: Any, **options: Any) -> Any:
        if b"330" in Path("ladder.json").read_bytes():
            raise ZeroDivisionError("by nothing")
        return real(self, *arguments, **options)

    monkeypatch.setattr(type(domain), place, broken)
    (found,) = daemon.after(lambda: put(330), events.Failed).result.diagnostics
    assert found.code == "internal"
    assert "ZeroDivisionError in test_faults.py" in found.message
    assert "by nothing" in found.message
    assert daemon.after(lambda: put(331), events.Built).recovered


@pytest.mark.parametrize(
    ("number", "hint"), [(errno.ENOSPC, "fs.inotify.max_user_watches"), (errno.EMFILE, "fs.inotify.max_user_instances")]
)
def test_folders_that_can_not_be_watched_are_told_once_and_looked_at(
    running: list[Daemons], monkeypatch: pytest.MonkeyPatch, number: int, hint: str
) -> None:
    full, real = threading.Event(), watchdog.observers.Observer
    full.set()

    class Limited(real):  # type: ignore[misc, valid-type]
        def __init__(self) -> None:
            if full.is_set() and number == errno.EMFILE:
                raise OSError(number, "inotify instance limit reached")
            super().__init__()

        def schedule(self, *arguments: Any, **options: Any) -> Any:
            if full.is_set():
                raise OSError(number, "inotify watch limit reached")
            return super().schedule(*arguments, **options)

    monkeypatch.setattr(watchdog.observers, "Observer", Limited)
    daemon = Daemons(rescan=0.1)
    running.append(daemon)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert hint in found.hint
    daemon.after(lambda: put(330), events.Built)
    full.clear()
    daemon.after(lambda: put(331), events.Built)
    assert daemon.kinds().count("Noted") == 1


def test_a_command_that_can_not_be_started_is_told(running: list[Daemons], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", mock.Mock(side_effect=OSError(errno.ENOMEM, "no memory")))
    daemon = Daemons(command="true", rescan=NEVER)
    running.append(daemon)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert found.message.endswith("the command of --exec can't be started: no memory")
    assert daemon.kinds()[-3:] == ["Running", "Ran", "Noted"]
