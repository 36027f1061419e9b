"""`urdfsync watch` as a process: signals, locks, limits of the system."""

from __future__ import annotations

import os
import shutil
import signal
import sys
import time
from pathlib import Path

import psutil
import pytest
from support.daemon import LIMIT, REPOSITORY, Start, holds, ladder, stopped

from urdfsync.commands import cli

QUEUE = Path("/proc/sys/fs/inotify/max_queued_events")
SETPRIV = "setpriv"
ROBOT = '[robots.{0}]\nsource = "{1}"\npackage = "{0}"\ndomain = "rcnetwork"\n'

Capture = pytest.CaptureFixture[str]

pytestmark = pytest.mark.posix("signals end a daemon; there, only a console sends some")


@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", 0), ("SIGHUP", 0)])
def test_signals_end_it(start: Start, name: str, code: int) -> None:
    watch = start(before=[sys.executable, "-c", HEEDS, name])
    assert watch.stop(signal.Signals[name]) == code
    assert watch.events[-1]["signal"] == name
    assert watch.errors == ""
    assert cli.main(["build", "--check", "--quiet"]) == 0


HEEDS = (
    "import os, signal, sys; signal.signal(getattr(signal, sys.argv[1]), signal.SIG_DFL); "
    "os.execv(sys.argv[2], sys.argv[2:])"
)
"""A program that runs another one, which heeds a signal that the tests may have been told to ignore, as by `nohup`."""


ENDLESS = "<%- for a in range(99999) %><% for b in range(99999) %><% endfor %><% endfor -%>\n"
"""Begin of a template that takes longer than anybody waits."""


@pytest.mark.slow
@pytest.mark.parametrize("robots", [1, 6], ids=["in the daemon", "in workers"])
def test_a_job_that_never_ends_does_not_hold_a_signal_up(start: Start, robots: int) -> None:
    """It is given up after 10 s."""
    watch = start("--jobs", "2")
    template = Path("templates/element/model.mo.jinja")
    template.parent.mkdir(parents=True)
    template.write_text(ENDLESS + (REPOSITORY / "tests/rcnetwork" / template).read_text())
    shutil.rmtree("modelica")
    config = "\n".join(f'{ROBOT.format(f"r{n}", "ladder.json")}templates = "templates"\n' for n in range(robots))
    Path("urdfsync.toml").write_text(config)
    watch.wait("building", lambda event: event["robot"] == "r0")
    time.sleep(2)  # until it renders
    helpers = psutil.Process(watch.process.pid).children(recursive=True)
    assert watch.stop() == 0
    assert not Path("modelica/R0").exists()
    assert psutil.wait_procs(helpers, LIMIT)[1] == []


@pytest.mark.slow
def test_one_daemon_at_a_time_and_one_that_was_killed_leaves_no_lock(start: Start, capsys: Capture) -> None:
    watch = start()
    assert cli.main(["watch"]) == 4
    out, err = capsys.readouterr()
    assert f"process {watch.process.pid} watches this configuration already" in err
    assert out == ""
    watch.process.kill()
    watch.process.wait(LIMIT)
    assert start().stop() == 0


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
    assert watch.wait("failed")["result"]["diagnostics"][0]["code"] == "output-not-writable"
    since = watch.mark
    await_rescans()
    assert watch.mark == since
    assert not holds(330)
    resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE, before)
    assert watch.wait("built", since=since)["recovered"]
    assert holds(330)


@pytest.mark.slow
@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0 and not shutil.which(SETPRIV), reason="root may read everything")
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
        assert watch.wait("failed", since=since)["result"]["diagnostics"][0]["code"] == "no-source"
        await_rescans()
    finally:
        folder.chmod(0o755)
    watch.wait("built", lambda event: event["recovered"], since)
    assert [event["event"] for event in watch.events[since:]].count("failed") == 1
