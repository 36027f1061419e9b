"""Folders that the system does not watch."""

from __future__ import annotations

import errno
import threading
from typing import Any

import pytest
import watchdog.observers
from support.daemon import Daemons, save

from urdfsync.watch import events


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
    daemon.after(lambda: save(330), events.Built)
    full.clear()
    daemon.after(lambda: save(331), events.Built)
    assert daemon.kinds().count("Noted") == 1
