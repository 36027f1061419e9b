"""The command of `--exec` after builds: when it runs, and what is said of its end."""

from __future__ import annotations

import errno
import subprocess
from unittest import mock

import pytest
from support.daemon import NEVER, Daemons

from urdfsync.watch import events


def test_a_command_that_can_not_be_started_is_told(running: list[Daemons], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", mock.Mock(side_effect=OSError(errno.ENOMEM, "no memory")))
    daemon = Daemons(command="true", rescan=NEVER)
    running.append(daemon)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert found.message.endswith("the command of --exec can't be started: no memory")
    assert daemon.kinds()[-3:] == ["Running", "Ran", "Noted"]
