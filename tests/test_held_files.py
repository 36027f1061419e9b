"""Builds while another program holds a file or folder of package or state open, from a random moment on.

A short hold stops no build. Else one error names the file, each file is as before or as it will be, and the next build
finishes. `URDFSYNC_HOLDS=50` sets the number of holds, with a new seed. The test prints its counts.
"""

from __future__ import annotations

import collections
import os
import secrets
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest
from support import crashes
from support.crashes import contents, run

from urdfsync.common import system
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import TEMPORARY, shown

HOLDS = int(os.environ.get("URDFSYNC_HOLDS", "10"))
SEED = secrets.randbelow(10**9) if "URDFSYNC_HOLDS" in os.environ else 20
SAME = 5
"""The number of holds of one project with one change."""
SHORT, LONG = 0.2, 60.0
"""Seconds of a hold; the test ends long ones."""
HOLDER = """
import ctypes, sys, threading
kernel, is_over = ctypes.WinDLL("kernel32"), threading.Event()
kernel.CreateFileW.restype = ctypes.c_void_p

def hold(path, sharing, seconds):
    handle = kernel.CreateFileW(path, 0x80000000, sharing, None, 3, 0x02000000, None)  # a folder, too
    print(handle != ctypes.c_void_p(-1).value, flush=True)
    is_over.wait(seconds)
    kernel.CloseHandle(ctypes.c_void_p(handle))
    print(flush=True)

for line in sys.stdin:
    if line.strip():
        is_over.clear()
        threading.Thread(target=hold, args=eval(line)).start()
    else:
        is_over.set()
"""
"""Holds each file that a line names, with the sharing of Windows that the line states, until the next empty line."""

pytestmark = [pytest.mark.slow, pytest.mark.windows]


class Holder:
    """Another program, which holds a file from a random moment on."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def hold(self, path: Path, sharing: int, seconds: float) -> None:
        self._tell(repr((str(path), sharing, seconds)))

    def release(self) -> bool:
        """End the hold; return whether the file was there, and nobody else held it."""
        assert self._process.stdout
        is_held = self._process.stdout.readline().strip() == "True"
        self._tell("")
        self._process.stdout.readline()
        return is_held

    def _tell(self, line: str) -> None:
        assert self._process.stdin
        self._process.stdin.write(f"{line}\n")
        self._process.stdin.flush()


@pytest.fixture
def holder() -> Iterator[Holder]:
    command = [sys.executable, "-c", HOLDER]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield Holder(process)


def failure(project: Path) -> list[Diagnostic]:
    """Build, and return the errors that stopped the build."""
    try:
        result = run(project)
    except UrdfsyncError as error:
        return list(error.diagnostics)
    return [found for found in result.diagnostics if found.severity is Severity.ERROR] if result.failed else []


def whole(project: Path) -> dict[str, bytes | None]:
    """The files of packages and state, except hidden ones that the next build clears."""
    return {name: text for name, text in contents(project).items() if TEMPORARY not in name and text is not None}


def test_a_file_that_is_held_from_any_moment_on_stops_a_build_cleanly(
    tmp_path: Path, holder: Holder, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    random, tally = Random(SEED), collections.Counter[str]()
    monkeypatch.setattr(system, "PATIENCE", 1.0)
    for number in range(HOLDS):
        if number % SAME == 0:
            original = tmp_path / f"original{number}"
            (crashes.moved_at_random if number % (2 * SAME) else crashes.edited_at_random)(original, random)
            twin = crashes.copy(original, tmp_path / "twin")
            started = time.monotonic()
            assert not failure(twin)
            seconds, wanted = time.monotonic() - started, contents(twin)
        project = crashes.copy(original, tmp_path / "work")
        before = whole(project)
        state = random.random() < 0.3
        held = random.choice(sorted((project / (".urdfsync" if state else "modelica")).rglob("*")))
        length = random.choice((SHORT, LONG, LONG))
        begin = threading.Timer(random.uniform(0, seconds), holder.hold, (held, random.choice((0, 1, 3)), length))
        begin.start()
        found = failure(project)
        begin.join()
        if not holder.release():
            tally["too late"] += 1
        context = SEED, number, str(held), found
        if found:
            assert length == LONG, context
            (error,) = found
            assert error.file == shown(held), context
            assert "another program has it open" in error.message, context
            for name, text in whole(project).items():
                assert text in (before.get(name), wanted.get(name)), (name, *context)
            tally["stopped"] += 1
        tally["holds"] += 1
        assert not failure(project), context
        assert contents(project) == wanted, context
    with capsys.disabled():
        print(f"\n{dict(tally)}")  # noqa: T201
