"""The daemon on real files, in a thread of the test: which changes it builds, and which it leaves alone.

That nothing else was built shows when one more change has been built: its events are the only ones since.
"""

from __future__ import annotations

import contextlib
import dataclasses
import errno
import json
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
import watchdog.observers
from support.daemon import MODEL, RECORD, REPOSITORY, Daemons, holds, ladder, until
from support.git import NEEDS_GIT, Repository
from support.networks import configure

from urdfsync import cli, precommit, registry
from urdfsync.engine.actions import Kind
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.watch import build, events, observer
from urdfsync.watch.daemon import Daemon
from urdfsync.watch.robot import Times

CONFIG = '[robots.{0}]\nsource = "{1}"\npackage = "{2}"\ndomain = "rcnetwork"\n'
BUILD = ["Settling", "Building", "Built"]
NEVER = 100000.0
PATIENT = Times(settle=0.02, sample=0.01, give_up_after=100.0, recheck_shrunk=100.0)
"""For robots that are not given up, and not believed when they shrink."""

Start = Callable[..., Daemons]
Wanted = Callable[[Any], bool]


@pytest.fixture
def start(project: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Start]:
    """A function that starts a daemon, and waits until all is built."""
    monkeypatch.setenv("PRE_COMMIT_HOME", str(project.parent / "pre-commit"))
    running = []

    def begin(**options: Any) -> Daemons:
        running.append(Daemons(**{"rescan": NEVER, **options}))
        return running[-1]

    yield begin
    for daemon in running:
        daemon.stop()


def put(path: Path | str, ohm: float) -> Path:
    """Write a source, with its signal beside it."""
    place = Path(path)
    place.parent.mkdir(parents=True, exist_ok=True)
    if not (place.parent / "step.csv").is_file():
        shutil.copy(REPOSITORY / "tests/rcnetwork/examples/step.csv", place.parent)
    place.write_text(ladder(ohm))
    return place


@contextlib.contextmanager
def building(daemon: Daemons, ohm: float | None = None, wanted: Wanted = lambda event: True) -> Iterator[int]:
    """What happens within is built, such as the source with this resistance; gives the number of the next event."""
    since = daemon.mark
    yield since
    daemon.wait(events.Built, since, wanted)
    assert ohm is None or holds(ohm)


def has_files(event: events.Built) -> bool:
    return bool(event.files)


def probe(daemon: Daemons, source: Path | str = "ladder.json", ohm: float = 999.0) -> None:
    """Change the source once more, and wait until that is built: so whatever was to come before has come."""
    with building(daemon, ohm, has_files):
        put(source, ohm)
    daemon.rest()


def await_rescans(monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    """Wait until so many rescans have come to an end, with all that follows from them."""
    real, begun = Daemon._rescan, list[int]()

    def rescan(self: Daemon) -> None:
        begun.append(1)
        real(self)

    with monkeypatch.context() as patch:
        patch.setattr(Daemon, "_rescan", rescan)
        until(lambda: len(begun) > number)


def test_it_builds_at_its_start_and_whenever_the_source_changed(start: Start) -> None:
    """What the daemon writes itself is no event, and neither is a file that has nothing to do with it."""
    daemon = start()
    assert daemon.kinds() == ["Started", "Building", "Built"]
    since = daemon.mark
    Path("ladder.json").touch()
    Path("unrelated").mkdir()
    for number in range(500):
        Path("unrelated" if number % 2 else ".", f"{number}.txt").write_text("nothing")
    for ohm in (300, 400, 500):
        probe(daemon, ohm=ohm)
    assert daemon.kinds(since) == 3 * BUILD


def test_an_editor_that_renames(start: Start) -> None:
    daemon = start()
    source = Path("ladder.json")
    with building(daemon, 330) as since:
        Path(".ladder.json.swp").write_text("half")
        source.rename("ladder.json~")
        put("ladder.new", 330).rename(source)
        Path("ladder.json~").unlink()
    probe(daemon)
    assert daemon.kinds(since) == 2 * BUILD


def test_a_slow_writer_is_one_build(start: Start) -> None:
    daemon = start(times=Times(settle=0.5, sample=0.1))
    content = ladder(330).encode()
    with building(daemon, 330) as since, Path("ladder.json").open("r+b", buffering=0) as file:
        file.truncate(0)
        for begin in range(0, len(content), 40):
            file.write(content[begin : begin + 40])
            time.sleep(0.05)
    assert daemon.kinds(since) == BUILD


@pytest.mark.parametrize("content", ["", "{", None], ids=["empty", "half", "deleted"])
def test_a_source_that_is_not_valid_yet_is_waited_for(start: Start, content: str | None) -> None:
    daemon = start(times=PATIENT)
    since, source = daemon.mark, Path("ladder.json")
    source.unlink() if content is None else source.write_text(content)
    waiting = daemon.wait(events.Waiting, since)
    assert waiting.reason == "waiting for the exporter"
    assert waiting.diagnostics[0].code == ("no-source" if content is None else "json")
    with building(daemon, 330):
        put(source, 330)
    assert daemon.kinds(since).count("Building") == 1


def test_a_source_that_is_never_valid_is_told_once_and_recovers(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each rescan tries again, and says nothing."""
    daemon = start(rescan=0.02)
    Path("ladder.json").write_text("{")
    daemon.wait(events.Failed)
    since = daemon.mark
    await_rescans(monkeypatch, 3)
    assert daemon.mark == since
    put("ladder.json", 330)
    assert daemon.wait(events.Built, since).recovered
    assert holds(330)


def test_many_elements_that_vanish_are_looked_at_longer(start: Start) -> None:
    daemon = start(times=PATIENT)
    whole = json.loads(ladder(330))
    short = json.dumps({**whole, "elements": whole["elements"][:1]})
    Path("ladder.json").write_text(short)
    assert "3 of 4 elements are gone" in daemon.wait(events.Waiting).reason
    probe(daemon)
    assert MODEL.is_file()
    daemon.stop()
    daemon = start()
    Path("ladder.json").write_text(short)
    daemon.wait(events.Built, 3, lambda event: bool(event.files))
    assert "Waiting" in daemon.kinds()
    assert not MODEL.exists()


def test_a_folder_is_moved_over_the_watched_one_then_deleted_and_made_again(start: Start) -> None:
    put("cad/export/ladder.json", 220.5)
    put("cad/next/ladder.json", 330)
    Path("urdfsync.toml").write_text(CONFIG.format("ladder", "cad/export/ladder.json", "Ladder"))
    daemon = start(times=PATIENT)
    with building(daemon, 330) as since:
        Path("cad/export").rename("cad/old")
        Path("cad/next").rename("cad/export")
    probe(daemon, "cad/export/ladder.json")
    assert daemon.kinds(since).count("Built") == 2
    daemon.after(lambda: shutil.rmtree("cad"), events.Waiting)
    with building(daemon, 330, has_files):
        put("cad/export/ladder.json", 330)


@pytest.mark.parametrize("tail", ["ladder.json", ""], ids=["file", "folder"])
def test_a_link_gets_another_target(start: Start, tail: str, tmp_path: Path) -> None:
    for name, ohm in (("v1", 220.5), ("v2", 330.0)):
        put(tmp_path / "exports" / name / "ladder.json", ohm)
    place = Path("linked.json" if tail else "linked")
    place.symlink_to(tmp_path / "exports/v1" / tail)
    source = "linked.json" if tail else "linked/ladder.json"
    Path("urdfsync.toml").write_text(CONFIG.format("ladder", source, "Ladder"))
    daemon = start()
    with building(daemon, 330) as since:
        Path("new-link").symlink_to(tmp_path / "exports/v2" / tail)
        Path("new-link").rename(place)
    probe(daemon, tmp_path / "exports/v2/ladder.json")
    assert daemon.kinds(since).count("Built") == 2


def test_the_configuration_changes(start: Start) -> None:
    daemon = start()
    since, file = daemon.mark, Path("urdfsync.toml")
    good = file.read_text()
    file.write_text("[robots.ladder\n")
    assert daemon.wait(events.Noted, since).diagnostics[0].code == "toml-syntax"
    file.unlink()
    daemon.wait(events.Noted, since, lambda event: event.diagnostics[0].code == "no-config")
    probe(daemon)  # the last good one is still in force
    file.write_text(f'{good}prefix = "net"\n{CONFIG.format("second", "ladder.json", "Second")}')
    assert daemon.wait(events.Started, since).robots == ("ladder", "second")
    daemon.wait(events.Built, since, lambda event: event.result.robot == "second")
    assert Path("modelica/Second/package.mo").is_file()
    assert "net" in Path("modelica/Ladder/Ladder.mo").read_text()


def test_another_source_in_the_configuration_ends_the_wait_for_a_valid_one(start: Start) -> None:
    daemon, file = start(times=PATIENT), Path("urdfsync.toml")
    Path("ladder.json").write_text("{")
    daemon.wait(events.Waiting)
    with building(daemon, 330, has_files):
        put("other.json", 330)
        file.write_text(file.read_text().replace("ladder.json", "other.json"))


def test_an_imported_file_changes_vanishes_and_comes_back(start: Start) -> None:
    daemon = start()
    signal_file, imported = Path("step.csv"), Path("modelica/Ladder/Resources/step.txt")
    with building(daemon):
        signal_file.write_text("0,0\n1,7\n")
    assert "7.0" in imported.read_text()
    with building(daemon):
        signal_file.unlink()
    assert imported.is_file(), "the copy serves"
    with building(daemon):
        signal_file.write_text("0,0\n1,8\n")
    assert "8.0" in imported.read_text()


def test_a_template_of_the_users_changes(start: Start) -> None:
    Path("templates").mkdir()
    configure('templates = "templates"\n')
    daemon = start()
    own = (REPOSITORY / "tests/rcnetwork/templates/element/model.mo.jinja").read_text()
    with building(daemon, wanted=has_files):
        Path("templates/element").mkdir()
        Path("templates/element/model.mo.jinja").write_text(own + "// ours\n")
    assert "// ours" in MODEL.read_text()


@NEEDS_GIT
def test_git_works_underneath(start: Start, project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two sources of one checkout are one build each, and outputs that are taken back are written again."""
    second = CONFIG.format("second", "second.json", "Second")
    Path("urdfsync.toml").write_text(CONFIG.format("ladder", "ladder.json", "Ladder") + second)
    shutil.copy("ladder.json", "second.json")
    repository = Repository(project, monkeypatch)
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    repository.git("checkout", "-q", "-b", "other")
    put("ladder.json", 330)
    put("second.json", 330)
    repository.commit()
    repository.git("checkout", "-q", "main")
    daemon = start(robots=2, times=Times(settle=0.3, sample=0.05))
    since = daemon.mark
    repository.git("checkout", "-q", "other")
    daemon.until(lambda: daemon.kinds(since).count("Built") == 2)
    assert sorted(daemon.kinds(since)) == sorted(2 * BUILD)
    assert holds(330)
    daemon.rest()
    with building(daemon, 330, lambda event: event.result.robot == "ladder" and bool(event.files)):
        repository.git("checkout", "--", "modelica", ".urdfsync")


def test_times_do_not_matter(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither those of files, old or in the future, nor a clock that jumps, nor a file that keeps its own."""
    daemon, source, real = start(), Path("ladder.json"), time.time_ns
    for ohm, moment, hours in ((330, 86400.0, -1000), (331, 4102444800.0, 1000), (332, 86400.0, -5)):
        monkeypatch.setattr(time, "time_ns", lambda hours=hours: real() + 3600 * hours * 10**9)
        with building(daemon, ohm):
            os.utime(put("ladder.new", ohm), (moment, moment))
            Path("ladder.new").rename(source)
    facts = source.stat()
    with building(daemon, 333):
        with source.open("r+") as file:
            file.write(ladder(333))
        os.utime(source, ns=(facts.st_atime_ns, facts.st_mtime_ns))
        assert (source.stat().st_size, source.stat().st_mtime_ns) == (facts.st_size, facts.st_mtime_ns)


# Outputs


def test_what_a_user_edits_is_left_alone(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    daemon = start(rescan=0.02)
    kept = daemon.after(lambda: MODEL.write_text(MODEL.read_text() + "// mine\n"), events.Built).result.actions
    assert [action.path for action in kept if action.kind is Kind.KEEP] == [str(MODEL)]
    probe(daemon)
    assert MODEL.read_text().endswith("// mine\n")
    with building(daemon) as since:
        RECORD.write_text(RECORD.read_text().replace("999", "1000"))
    put("ladder.json", 330)
    built = daemon.wait(events.Built, since, lambda event: bool(event.result.conflicts))
    assert built.result.conflicts[0].path == str(RECORD)
    assert "1000" in RECORD.read_text()
    daemon.rest()
    whole = json.loads(ladder(330))
    less = json.dumps({**whole, "elements": [element for element in whole["elements"] if element["name"] != "R2"]})
    orphans = daemon.after(lambda: Path("ladder.json").write_text(less), events.Built).result.actions
    assert [action.path for action in orphans if action.kind is Kind.ORPHAN] == [str(MODEL), str(RECORD)]
    daemon.rest()
    since = daemon.mark
    await_rescans(monkeypatch, 3)
    assert daemon.mark == since, "each is told once"


@dataclasses.dataclass
class Passes:
    """How many builds have ended, and what happens then."""

    number: int = 0
    then: Callable[[int], None] = lambda _: None


def _to_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _to_link(path: Path) -> None:
    path.rename(path.with_name("moved"))
    path.symlink_to("moved")


OUTPUTS = (MODEL, "modelica/Ladder/package.order", ".urdfsync/robots/ladder.toml", ".urdfsync/robots/ladder.json")


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("rescan", [NEVER, 0.02], ids=["by its event", "by a rescan"])
def test_an_output_that_is_deleted_is_written_again(
    start: Start, monkeypatch: pytest.MonkeyPatch, output: Path | str, rescan: float
) -> None:
    if rescan != NEVER:
        monkeypatch.setattr(observer.Observer, "dispatch", lambda *_: None)
    daemon = start(rescan=rescan)
    before = Path(output).read_bytes()
    with building(daemon) as since:
        Path(output).unlink()
    assert Path(output).read_bytes() == before
    assert daemon.kinds(since) == BUILD


@pytest.mark.parametrize("change", [_to_folder, _to_link])
def test_what_is_in_the_way_is_told_once_and_recovers(start: Start, change: Callable[[Path], None]) -> None:
    daemon = start(rescan=0.05)
    change(RECORD)
    found = daemon.wait(events.Failed).result.diagnostics
    assert [one.code for one in found] == ["output-in-the-way"]
    assert daemon.after(RECORD.rmdir if change is _to_folder else RECORD.unlink, events.Built).recovered
    assert RECORD.is_file()
    assert daemon.kinds().count("Failed") == 1


def test_saves_right_after_the_build_has_looked(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the same tick of the clock, and of the same size, they leave all that the system says of a file."""
    daemon, original = start(), MODEL.read_bytes()
    for number in range(5):
        for text in (b"//a" if number % 2 else b"//b", original[:3]):
            with building(daemon), MODEL.open("r+b") as file:
                file.write(text)


@pytest.fixture
def passes(monkeypatch: pytest.MonkeyPatch) -> Passes:
    """Grows by each build that ends."""
    real, passes = build.build_robots, Passes()

    def results(config: Any, robots: Any, options: BuildOptions) -> Iterator[Result]:
        yield from real(config, robots, options)
        passes.number += 1
        passes.then(passes.number)

    monkeypatch.setattr(build, "build_robots", results)
    return passes


@pytest.mark.parametrize("number", [1, 2])
def test_an_edit_during_a_build_is_seen(
    start: Start, monkeypatch: pytest.MonkeyPatch, passes: Passes, number: int
) -> None:
    """Its event is not needed."""

    def edit(ended: int) -> None:
        if ended == number:
            MODEL.write_text(MODEL.read_text() + "// mine\n")

    monkeypatch.setattr(observer.Observer, "dispatch", lambda *_: None)
    passes.then = edit
    result = start().wait(events.Built, 3).result
    assert [action.path for action in result.actions if action.kind is Kind.KEEP] == [str(MODEL)]


def test_a_change_is_built_once_and_confirmed_once(start: Start, passes: Passes) -> None:
    daemon = start(rescan=0.02)
    for ohm in (330, 331):
        probe(daemon, ohm=ohm)
    assert passes.number == 3 * 2


def test_the_state_folder_is_deleted(start: Start) -> None:
    daemon = start(rescan=0.02)
    lock, manifest = Path(".urdfsync/watch.lock"), Path(".urdfsync/robots/ladder.toml")
    for _ in range(2):
        shutil.rmtree(".urdfsync", ignore_errors=True)  # the daemon may be at it
    until(lambda: lock.is_file() and manifest.is_file())
    assert lock.read_text().strip() == str(os.getpid())
    probe(daemon)


# Other builds, and pre-commit


def test_builds_by_hand_beside_it(start: Start) -> None:
    daemon = start()
    for ohm in (330, 331, 332):
        put("ladder.json", ohm)
        assert cli.main(["build", "--quiet"]) == 0
        assert holds(ohm)
    probe(daemon)
    assert cli.main(["build", "--check", "--quiet"]) == 0
    assert "Failed" not in daemon.kinds()


def test_it_pauses_while_pre_commit_has_stashed_changes(start: Start, project: Path) -> None:
    daemon, store = start(), project.parent / "pre-commit"
    store.mkdir()
    (store / f"patch{int(time.time())}-{2**22 + 1}").write_text("of a process that has ended")
    probe(daemon)
    since = daemon.mark
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=project, stdin=subprocess.PIPE) as process:
        (store / f"patch{int(time.time())}-{process.pid}").write_text("unstaged")
        put("ladder.json", 330)
        assert str(process.pid) in daemon.wait(events.Paused, since).reason
        assert holds(999)
        assert process.stdin
        process.stdin.close()
    daemon.wait(events.Built, since)
    assert holds(330)
    assert daemon.kinds(since) == ["Settling", "Paused", "Resumed", "Building", "Built"]


def test_nothing_is_built_again_during_a_pause(start: Start, monkeypatch: pytest.MonkeyPatch, passes: Passes) -> None:
    """Changes are stashed away while a robot is built: the next build would take what is left for the user's."""
    stashed = threading.Event()
    monkeypatch.setattr(precommit, "find_stash", lambda _: (Path("patch"), 1) if stashed.is_set() else None)
    real = Daemon._renew_paths

    def stash(self: Daemon, *arguments: Any) -> None:
        real(self, *arguments)
        if not stashed.is_set():
            stashed.set()
            RECORD.write_text("")

    monkeypatch.setattr(Daemon, "_renew_paths", stash)
    daemon = start(rests=False)
    daemon.wait(events.Paused)
    assert passes.number == 1
    monkeypatch.setattr(Daemon, "_renew_paths", real)
    RECORD.unlink()
    stashed.clear()
    daemon.wait(events.Resumed)
    daemon.wait(events.Built, 3, lambda event: bool(event.files))
    daemon.rest()
    probe(daemon)


# Faults


@pytest.mark.parametrize("place", ["read", "artifacts"])
def test_a_bug_of_a_domain_is_one_error_and_the_daemon_goes_on(
    start: Start, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    daemon, domain = start(), registry.domain("rcnetwork")
    real = getattr(type(domain), place)

    def broken(self: Any, *arguments: Any, **options: Any) -> Any:
        if b"330" in Path("ladder.json").read_bytes():
            raise ZeroDivisionError("by nothing")
        return real(self, *arguments, **options)

    monkeypatch.setattr(type(domain), place, broken)
    (found,) = daemon.after(lambda: put("ladder.json", 330), events.Failed).result.diagnostics
    assert found.code == "internal"
    assert "ZeroDivisionError in test_watch_daemon.py" in found.message
    assert "by nothing" in found.message
    assert daemon.after(lambda: put("ladder.json", 331), events.Built).recovered


@pytest.mark.parametrize(
    ("number", "hint"), [(errno.ENOSPC, "fs.inotify.max_user_watches"), (errno.EMFILE, "fs.inotify.max_user_instances")]
)
def test_folders_that_can_not_be_watched_are_told_once_and_looked_at(
    start: Start, monkeypatch: pytest.MonkeyPatch, number: int, hint: str
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
    daemon = start(rescan=0.1)
    (found,) = daemon.wait(events.Noted).diagnostics
    assert hint in found.hint
    probe(daemon)
    full.clear()
    daemon.wait(events.Recovered)
    probe(daemon, ohm=330)
    assert daemon.kinds().count("Noted") == 1


def test_without_events_it_looks_by_itself(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.watch.daemon._POLL", 0.02)
    daemon = start(poll=True)
    probe(daemon, ohm=330)
    assert "Noted" not in daemon.kinds()


# --exec


def test_a_command_after_builds_that_changed_something(start: Start, capfd: pytest.CaptureFixture[str]) -> None:
    note = 'printf "%s %s %s\\n" "$URDFSYNC_ROBOT" "$URDFSYNC_PACKAGE" "$(basename "$URDFSYNC_FILES")" >> log'
    daemon = start(command=f"{note}; echo noise; exit 3")
    assert daemon.wait(events.Ran).code == 3
    since = daemon.mark
    daemon.after(lambda: probe(daemon), events.Ran)
    assert "ended with exit code 3" in daemon.wait(events.Noted, since).diagnostics[0].message
    assert Path("log").read_text().splitlines()[-1] == "ladder Ladder R2Parameters.mo"
    assert capfd.readouterr() == ("", "noise\nnoise\n")


def test_a_command_that_can_not_be_started_is_told(start: Start, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", mock.Mock(side_effect=OSError(errno.ENOMEM, "no memory")))
    daemon = start(command="true")
    assert (
        daemon.wait(events.Noted).diagnostics[0].message.endswith("the command of --exec can't be started: no memory")
    )
    assert daemon.kinds()[-3:] == ["Running", "Ran", "Noted"]


def test_a_command_that_takes_long_holds_nothing_up(start: Start) -> None:
    os.mkfifo("go")
    daemon = start(command="read line < go; echo run >> runs")
    for ohm in (330, 331, 332):
        probe(daemon, ohm=ohm)
    assert not Path("runs").exists()
    for count in (1, 2):
        Path("go").write_text("go\n")
        daemon.until(lambda: daemon.kinds().count("Ran") >= count)  # noqa: B023
    assert Path("runs").read_text() == "run\nrun\n", "what came meanwhile is one more run"
