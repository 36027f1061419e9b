"""`urdfsync watch` as a process: real files change, and builds are counted from its events. Takes two minutes."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import psutil
import pytest
from support.daemon import LIMIT, REPOSITORY, Watch, stopped
from support.git import NEEDS_GIT, Repository

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="signals and links of POSIX")]

RECORD = "modelica/Ladder/Elements/R2Parameters.mo"
QUEUE = Path("/proc/sys/fs/inotify/max_queued_events")
CONFIG = '[robots.ladder]\nsource = "{}"\npackage = "Ladder"\ndomain = "rcnetwork"\n'

Start = Callable[..., Watch]


@pytest.fixture
def start(project: Path, rc_site: Path, tmp_path: Path) -> Iterator[Start]:
    """A function that starts a daemon in the project, and waits until all is built; it is killed after the test."""
    running = []

    def begin(*arguments: str, robots: int = 1, before: Sequence[str] = ()) -> Watch:
        path, store = [rc_site, REPOSITORY / "tests" / "rcnetwork"], str(tmp_path / "pre-commit")
        running.append(Watch(project, *arguments, path=path, before=before, PRE_COMMIT_HOME=store).__enter__())
        running[-1].rest(robots=robots)
        return running[-1]

    yield begin
    for watch in running:
        watch.__exit__(None, None, None)


def text(ohm: float, folder: Path) -> str:
    """The source with another resistance."""
    return (folder / "step.csv").with_name("original.json").read_text().replace("220.5", f"{ohm:g}")


@pytest.fixture(autouse=True)
def _original(project: Path) -> None:
    shutil.copy(project / "ladder.json", project / "original.json")


def holds(project: Path, ohm: float) -> bool:
    return f"{ohm:g}" in (project / RECORD).read_text()


def probe(watch: Watch, project: Path, source: Path | None = None, ohm: float = 999.0) -> None:
    """Change the source once more, and wait until that is built: so whatever was to come before has come."""
    since = watch.mark
    (source or project / "ladder.json").write_text(text(ohm, project))
    watch.wait("built", lambda event: bool(event["files"]), since)
    watch.rest(since)
    assert holds(project, ohm)


def until(condition: Callable[[], bool], watch: Watch) -> None:
    """Wait for something that no event tells."""
    deadline = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < deadline, watch.said
        time.sleep(0.05)


def test_it_builds_at_its_start_and_whenever_the_source_changed(project: Path, start: Start) -> None:
    watch = start()
    assert [event["event"] for event in watch.events] == ["started", "building", "built"]
    assert (project / RECORD).is_file()
    probe(watch, project)
    assert [event["event"] for event in watch.events[3:]] == ["settling", "building", "built"]
    assert len(watch.builds()) == 2
    assert watch.errors == ""


def test_what_the_daemon_writes_itself_is_no_event(project: Path, start: Start) -> None:
    watch = start()
    for ohm in (300, 400, 500):
        probe(watch, project, ohm=ohm)
    assert len(watch.builds()) == 4
    assert [event["event"] for event in watch.events].count("settling") <= 3


def test_a_source_that_was_only_touched_is_not_built(project: Path, start: Start) -> None:
    watch = start()
    since = watch.mark
    for _ in range(3):  # the first may fall into what the daemon does after its first build
        (project / "ladder.json").touch()
        time.sleep(1)
    watch.wait("calm", since=since)
    probe(watch, project)
    assert len(watch.builds(since)) == 1


def test_an_editor_that_renames(project: Path, start: Start) -> None:
    watch = start()
    since, source = watch.mark, project / "ladder.json"
    (project / ".ladder.json.swp").write_text("half")
    source.rename(project / "ladder.json~")
    (project / "ladder.new").write_text(text(330, project))
    (project / "ladder.new").rename(source)
    (project / "ladder.json~").unlink()
    watch.wait("built", since=since)
    assert holds(project, 330)
    probe(watch, project)
    assert len(watch.builds(since)) == 2


def test_a_slow_writer_is_one_build(project: Path, start: Start) -> None:
    watch = start()
    since, content = watch.mark, text(330, project).encode()
    size = -(-len(content) // 20)
    with (project / "ladder.json").open("r+b", buffering=0) as file:
        file.truncate(0)
        for begin in range(0, len(content), size):
            file.write(content[begin : begin + size])
            time.sleep(0.1)
    watch.wait("built", since=since)
    assert holds(project, 330)
    probe(watch, project)
    assert len(watch.builds(since)) == 2


def test_an_empty_file_is_not_built(project: Path, start: Start) -> None:
    watch = start()
    since = watch.mark
    (project / "ladder.json").write_text("")
    waiting = watch.wait("waiting", since=since)
    assert waiting["reason"] == "waiting for the exporter"
    assert waiting["diagnostics"][0]["code"] == "json"
    (project / "ladder.json").write_text(text(330, project))
    watch.wait("built", since=since)
    assert holds(project, 330)
    assert [event["event"] for event in watch.events[since:]].count("building") == 1


def test_a_source_that_is_never_valid_is_said_once_and_recovers(project: Path, start: Start) -> None:
    watch = start("--patience", "0.5", "--rescan", "0.2")
    (project / "ladder.json").write_text("{")
    watch.wait("failed")
    since = watch.mark
    assert watch.process.poll() is None
    (project / "unrelated").write_text("")
    time.sleep(1)  # several rescans: each tries again, and says nothing
    assert watch.mark == since
    (project / "ladder.json").write_text(text(330, project))
    assert watch.wait("built", since=since)["recovered"]
    assert holds(project, 330)


def test_many_elements_that_vanish_are_looked_at_longer(project: Path, start: Start) -> None:
    watch = start()
    whole = json.loads(text(330, project))
    (project / "ladder.json").write_text(json.dumps({**whole, "elements": whole["elements"][:1]}))
    assert "3 of 4 elements are gone" in watch.wait("waiting")["reason"]
    (project / "ladder.json").write_text(json.dumps(whole))
    probe(watch, project)
    assert (project / "modelica/Ladder/Elements/C2.mo").is_file()
    since = watch.mark
    (project / "ladder.json").write_text(json.dumps({**whole, "elements": whole["elements"][:1]}))
    assert watch.wait("built", since=since)["files"]
    assert not (project / "modelica/Ladder/Elements/C2.mo").exists()


def test_a_folder_is_moved_over_the_watched_one(project: Path, start: Start) -> None:
    for name, ohm in (("export", 220.5), ("next", 330.0)):
        (project / "cad" / name).mkdir(parents=True)
        (project / "cad" / name / "ladder.json").write_text(text(ohm, project))
        shutil.copy(project / "step.csv", project / "cad" / name)
    (project / "urdfsync.toml").write_text(CONFIG.format("cad/export/ladder.json"))
    watch = start()
    since = watch.mark
    (project / "cad/export").rename(project / "cad/old")
    (project / "cad/next").rename(project / "cad/export")
    watch.wait("built", since=since)
    assert holds(project, 330)
    probe(watch, project, project / "cad/export/ladder.json")
    assert len(watch.builds(since)) == 2


def test_a_folder_is_deleted_and_made_again(project: Path, start: Start) -> None:
    folder = project / "a/b"
    folder.mkdir(parents=True)
    shutil.copy(project / "step.csv", folder)
    (folder / "ladder.json").write_text(text(220.5, project))
    (project / "urdfsync.toml").write_text(CONFIG.format("a/b/ladder.json"))
    watch = start()
    since = watch.mark
    shutil.rmtree(project / "a")
    watch.wait("waiting", since=since)
    folder.mkdir(parents=True)
    (folder / "ladder.json").write_text(text(330, project))
    watch.wait("built", since=since)
    assert holds(project, 330)


@pytest.mark.parametrize("link", ["file", "folder"])
def test_a_link_gets_another_target(project: Path, start: Start, link: str, tmp_path: Path) -> None:
    for name, ohm in (("v1", 220.5), ("v2", 330.0)):
        (tmp_path / "exports" / name).mkdir(parents=True)
        (tmp_path / "exports" / name / "ladder.json").write_text(text(ohm, project))
        shutil.copy(project / "step.csv", tmp_path / "exports" / name)
    tail = "ladder.json" if link == "file" else ""
    place = project / ("linked.json" if link == "file" else "linked")
    place.symlink_to(tmp_path / "exports/v1" / tail)
    (project / "urdfsync.toml").write_text(CONFIG.format("linked.json" if link == "file" else "linked/ladder.json"))
    watch = start()
    since = watch.mark
    (project / "new-link").symlink_to(tmp_path / "exports/v2" / tail)
    (project / "new-link").rename(place)
    watch.wait("built", since=since)
    assert holds(project, 330)
    probe(watch, project, tmp_path / "exports/v2/ladder.json")
    assert len(watch.builds(since)) == 2


def test_a_source_is_deleted_and_comes_back(project: Path, start: Start) -> None:
    watch = start()
    since = watch.mark
    (project / "ladder.json").unlink()
    assert watch.wait("waiting", since=since)["diagnostics"][0]["code"] == "no-source"
    (project / "ladder.json").write_text(text(330, project))
    watch.wait("built", since=since)
    assert holds(project, 330)


def test_unrelated_files_are_nothing(project: Path, start: Start) -> None:
    watch = start()
    since = watch.mark
    (project / "unrelated").mkdir()
    for number in range(5000):
        (project / ("unrelated" if number % 2 else ".") / f"{number}.txt").write_text("nothing")
    probe(watch, project)
    assert [event["event"] for event in watch.events[since:]] == ["settling", "building", "built"]


@pytest.mark.skipif(not QUEUE.is_file(), reason="no inotify")
def test_an_overflow_of_events_is_made_good(project: Path, start: Start) -> None:
    """While the daemon is stopped, more happens than the system remembers: also where it looks for changes."""
    watch = start("--rescan", "100000")
    since = watch.mark
    with stopped(watch.process):
        one, two = project / "one", project / "two"
        one.write_text("")
        for _ in range(int(QUEUE.read_text()) // 2 + 1000):  # a rename is two events
            one.rename(two)
            one, two = two, one
        (project / "ladder.json").write_text(text(330, project))  # its own events are lost
    watch.wait("built", since=since)
    assert holds(project, 330)
    probe(watch, project)
    assert len(watch.builds(since)) == 2
    assert watch.errors == ""


def test_the_configuration_changes(project: Path, start: Start) -> None:
    watch = start()
    since, file = watch.mark, project / "urdfsync.toml"
    good = file.read_text()
    file.write_text("[robots.ladder\n")
    assert watch.wait("noted", since=since)["diagnostics"][0]["code"] == "toml-syntax"
    file.unlink()
    watch.wait("noted", lambda event: event["diagnostics"][0]["code"] == "no-config", since)
    probe(watch, project)  # the last good one is still in force
    second = good.replace("robots.ladder", "robots.second").replace('"Ladder"', '"Second"')
    file.write_text(f'{good}prefix = "net"\n{second}')
    started = watch.wait("started", lambda event: event["again"], since)
    assert started["robots"] == ["ladder", "second"]
    watch.wait("built", lambda event: event["robot"] == "second", since)
    assert (project / "modelica/Second/package.mo").is_file()
    assert "net" in (project / "modelica/Ladder/Ladder.mo").read_text()


def test_an_imported_file_changes_vanishes_and_comes_back(project: Path, start: Start) -> None:
    watch = start()
    since, signal_file = watch.mark, project / "step.csv"
    imported = project / "modelica/Ladder/Resources/step.txt"
    signal_file.write_text("0,0\n1,7\n")
    watch.wait("built", since=since)
    assert "7.0" in imported.read_text()
    since = watch.mark
    signal_file.unlink()
    watch.wait("built", since=since)
    assert imported.is_file(), "the copy serves"
    since = watch.mark
    signal_file.write_text("0,0\n1,8\n")
    watch.wait("built", since=since)
    assert "8.0" in imported.read_text()


def test_a_users_template_changes(project: Path, start: Start) -> None:
    (project / "templates").mkdir()
    with (project / "urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    watch = start()
    since = watch.mark
    own = (REPOSITORY / "tests/rcnetwork/templates/element/model.mo.jinja").read_text()
    (project / "templates/element").mkdir()
    (project / "templates/element/model.mo.jinja").write_text(own + "// ours\n")
    watch.wait("built", lambda event: bool(event["files"]), since)
    assert "// ours" in (project / "modelica/Ladder/Elements/R2.mo").read_text()


@NEEDS_GIT
def test_two_sources_of_one_checkout_are_one_build_each(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    second = CONFIG.format("second.json").replace("robots.ladder", "robots.second").replace('"Ladder"', '"Second"')
    (project / "urdfsync.toml").write_text(CONFIG.format("ladder.json") + second)
    shutil.copy(project / "ladder.json", project / "second.json")
    repository = Repository(project, monkeypatch)
    (project / ".gitignore").write_text("modelica\n.urdfsync\n")
    repository.commit()
    repository.git("checkout", "-q", "-b", "other")
    for name in ("ladder.json", "second.json"):
        (project / name).write_text(text(330, project))
    repository.commit()
    repository.git("checkout", "-q", "main")
    watch = start(robots=2)
    since = watch.mark
    repository.git("checkout", "-q", "other")
    watch.wait("built", lambda event: event["robot"] == "ladder", since)
    watch.wait("built", lambda event: event["robot"] == "second", since)
    probe(watch, project)
    assert len(watch.builds(since, "ladder")) == 2, "that of the checkout and the last one"
    assert len(watch.builds(since, "second")) == 1


def test_a_clock_that_goes_backwards(project: Path, start: Start) -> None:
    """All that can be seen of it are times of change: older than those before, or in the future."""
    watch = start()
    for ohm, moment in ((330, 86400.0), (331, 4102444800.0), (332, 86400.0)):
        since = watch.mark
        (project / "ladder.new").write_text(text(ohm, project))
        os.utime(project / "ladder.new", (moment, moment))
        (project / "ladder.new").rename(project / "ladder.json")
        watch.wait("built", since=since)
        assert holds(project, ohm)
    assert len(watch.builds()) == 4


def test_a_change_that_leaves_all_stat_values_is_seen(project: Path, start: Start) -> None:
    watch = start()
    source = project / "ladder.json"
    source.write_text(text(330, project))
    watch.wait("built", since=3)
    since, facts = watch.mark, source.stat()
    with source.open("r+") as file:
        file.write(text(331, project))
    os.utime(source, ns=(facts.st_atime_ns, facts.st_mtime_ns))
    assert (source.stat().st_size, source.stat().st_mtime_ns) == (facts.st_size, facts.st_mtime_ns)
    watch.wait("built", since=since)
    assert holds(project, 331)


def test_without_events_it_looks_by_itself(project: Path, start: Start) -> None:
    watch = start("--poll", "--rescan", "1")
    probe(watch, project, ohm=330)
    since = watch.mark
    (project / RECORD).unlink()
    watch.wait("built", since=since)
    assert holds(project, 330)
    assert not [event for event in watch.events if event["event"] == "noted"]


# Hand edits and other builds


def test_what_a_user_edits_is_left_alone(project: Path, start: Start) -> None:
    watch = start()
    model, record = project / "modelica/Ladder/Elements/R2.mo", project / RECORD
    since = watch.mark
    model.write_text(model.read_text() + "// mine\n")
    watch.wait("built", since=since)
    probe(watch, project)
    assert model.read_text().endswith("// mine\n")
    since = watch.mark
    record.write_text(record.read_text().replace("999", "1000"))
    watch.rest(since)
    (project / "ladder.json").write_text(text(330, project))
    built = watch.wait("built", lambda event: bool(event["conflicts"]), since)
    assert built["conflicts"][0]["path"] == RECORD
    assert "1000" in record.read_text()


def run(project: Path, rc_site: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    paths = [REPOSITORY, rc_site, REPOSITORY / "tests" / "rcnetwork"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths))}
    command = [sys.executable, "-m", "urdfsync", *arguments]
    return subprocess.run(command, cwd=project, env=environment, capture_output=True, text=True, check=False)


def test_builds_by_hand_beside_it(project: Path, start: Start, rc_site: Path) -> None:
    watch = start()
    for ohm in (330, 331, 332):
        (project / "ladder.json").write_text(text(ohm, project))
        assert run(project, rc_site, "build").returncode == 0
        assert holds(project, ohm)
    probe(watch, project)
    assert run(project, rc_site, "build", "--check").returncode == 0
    assert not [event for event in watch.events if event["event"] == "failed"]


@NEEDS_GIT
def test_writes_that_are_rolled_back_are_made_again(
    project: Path, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    watch = start()
    Repository(project, monkeypatch).commit()
    probe(watch, project)
    since = watch.mark
    subprocess.run(["git", "checkout", "--", "modelica", ".urdfsync"], cwd=project, check=True, capture_output=True)
    watch.wait("built", lambda event: bool(event["files"]), since)
    assert holds(project, 999)


def test_it_pauses_while_pre_commit_has_stashed_changes(project: Path, start: Start, tmp_path: Path) -> None:
    watch = start()
    time.sleep(0.5)  # the build that makes sure of the first one may have begun before the pause
    store = tmp_path / "pre-commit"
    store.mkdir()
    (store / f"patch{int(time.time())}-{2**22 + 1}").write_text("of a process that has ended")
    since = watch.mark
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=project, stdin=subprocess.PIPE) as process:
        (store / f"patch{int(time.time())}-{process.pid}").write_text("unstaged")
        (project / "ladder.json").write_text(text(330, project))
        assert str(process.pid) in watch.wait("paused", since=since)["reason"]
        time.sleep(1)
        assert not watch.builds(since)
        assert process.stdin
        process.stdin.close()
    watch.wait("resumed", since=since)
    watch.wait("built", since=since)
    assert holds(project, 330)


# The process


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 0), (signal.SIGHUP, 0)])
def test_signals_end_it(project: Path, start: Start, number: signal.Signals, code: int) -> None:
    watch = start()
    assert watch.stop(number) == code
    assert watch.events[-1]["event"] == "stopping"
    assert watch.events[-1]["signal"] == number.name
    assert watch.errors == ""
    assert len(start().builds()) == 0, "no lock is left, and nothing to do"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_during_a_build_leaves_all_or_nothing(project: Path, start: Start, number: signal.Signals) -> None:
    watch = start("--settle", "0", "--sample", "0")
    for ohm in range(300, 306):
        since = watch.mark
        (project / "ladder.json").write_text(text(ohm, project))
        watch.wait("building", since=since)
        assert watch.stop(number) == (130 if number is signal.SIGINT else 0)
        assert not list((project / ".urdfsync").glob("journal/*"))
        watch = start("--settle", "0", "--sample", "0")
        assert holds(project, ohm)
        assert not any(event.get("conflicts") for event in watch.events)


ENDLESS = "<%- for a in range(99999) %><% for b in range(99999) %><% endfor %><% endfor -%>\n"
"""Begin of a template that takes longer than anybody waits."""


@pytest.mark.parametrize("robots", [1, 6], ids=["in the daemon", "in workers"])
def test_a_job_that_never_ends_does_not_hold_a_signal_up(project: Path, start: Start, robots: int) -> None:
    robot = CONFIG.format("ladder.json") + 'templates = "templates"\n'
    others = [robot.replace("ladder]", f"ladder{n}]").replace('"Ladder"', f'"Ladder{n}"') for n in range(1, robots)]
    (project / "urdfsync.toml").write_text("\n".join([robot, *others]))
    template = project / "templates/element/model.mo.jinja"
    template.parent.mkdir(parents=True)
    own = (REPOSITORY / "tests/rcnetwork" / template.relative_to(project)).read_text()
    template.write_text(own)
    watch = start("--jobs", "2", robots=robots)
    before, since = (project / RECORD).read_text(), watch.mark
    (project / "new").write_text(ENDLESS + own)
    (project / "new").rename(template)
    until(lambda: sum(event["event"] == "building" for event in watch.events[since:]) == robots, watch)
    time.sleep(2)  # until it renders
    helpers = psutil.Process(watch.process.pid).children(recursive=True)
    begin = time.monotonic()
    assert watch.stop() == 0
    assert time.monotonic() - begin < (20 if robots == 1 else 8)
    assert watch.events[-1]["event"] == "stopping"
    assert watch.errors == ""
    assert psutil.wait_procs(helpers, LIMIT)[1] == []
    assert (project / RECORD).read_text() == before
    template.write_text(own)
    start(robots=robots)


def test_a_second_daemon_says_who_was_first(project: Path, start: Start, rc_site: Path) -> None:
    watch = start()
    done = run(project, rc_site, "watch")
    assert done.returncode == 4
    assert f"process {watch.process.pid} watches this configuration already" in done.stderr
    assert done.stdout == ""
    assert watch.stop() == 0
    start()


def test_a_daemon_that_was_killed_leaves_no_lock(project: Path, start: Start) -> None:
    watch = start()
    watch.process.kill()
    watch.process.wait(LIMIT)
    probe(start(), project)


def test_a_configuration_that_can_not_be_used_at_the_start(project: Path, rc_site: Path) -> None:
    (project / "urdfsync.toml").write_text("[")
    done = run(project, rc_site, "watch")
    assert done.returncode == 2
    assert "toml-syntax" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits other processes")
def test_a_full_disk_is_said_once_and_recovers(project: Path, start: Start) -> None:
    import resource

    watch = start("--rescan", "0.3")
    before = resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE, (1, before[1]))
    (project / "ladder.json").write_text(text(330, project))
    assert watch.wait("failed")["diagnostics"][0]["code"] == "output-not-writable"
    since = watch.mark
    time.sleep(1.5)  # several rescans: each tries again, and says nothing
    assert watch.mark == since
    assert not holds(project, 330)
    resource.prlimit(watch.process.pid, resource.RLIMIT_FSIZE, before)
    assert watch.wait("built", since=since)["recovered"]
    assert holds(project, 330)


SETPRIV = "setpriv"


@pytest.mark.skipif(os.geteuid() == 0 and not shutil.which(SETPRIV), reason="root may read everything")
def test_a_folder_without_permission_is_said_once_and_recovers(project: Path, start: Start) -> None:
    folder = project / "cad"
    folder.mkdir()
    shutil.copy(project / "step.csv", folder)
    (folder / "ladder.json").write_text(text(220.5, project))
    (project / "urdfsync.toml").write_text(CONFIG.format("cad/ladder.json"))
    powers = "-dac_override,-dac_read_search"
    modes_count = [SETPRIV, f"--bounding-set={powers}", f"--inh-caps={powers}"] if os.geteuid() == 0 else []
    watch = start("--rescan", "0.3", "--patience", "0.5", before=modes_count)
    probe(watch, project, folder / "ladder.json", ohm=330)
    since = watch.mark
    folder.chmod(0)
    try:
        assert watch.wait("failed", since=since)["diagnostics"][0]["code"] == "no-source"
        time.sleep(1.5)  # several rescans
    finally:
        folder.chmod(0o755)
    watch.wait("built", lambda event: event["recovered"], since)
    assert [event["event"] for event in watch.events[since:]].count("failed") == 1
    probe(watch, project, folder / "ladder.json")


def test_what_is_in_the_way_is_said_once_and_recovers(project: Path, start: Start) -> None:
    watch = start("--rescan", "0.3")
    record = project / RECORD
    record.unlink()
    record.mkdir()
    assert watch.wait("failed")["diagnostics"][0]["code"] == "output-in-the-way"
    record.rmdir()
    assert watch.wait("built", lambda event: bool(event["files"]), 4)["recovered"]
    assert record.is_file()


def test_the_state_folder_is_deleted(project: Path, start: Start) -> None:
    watch = start("--rescan", "0.3")
    probe(watch, project, ohm=330)
    time.sleep(1)  # the daemon may still be at it, and so make files in what is about to be deleted
    shutil.rmtree(project / ".urdfsync")
    lock, manifest = project / ".urdfsync/watch.lock", project / ".urdfsync/robots/ladder.toml"
    until(lambda: lock.is_file() and manifest.is_file(), watch)
    assert lock.read_text().strip() == str(watch.process.pid)
    probe(watch, project)


def test_a_command_after_builds_that_changed_something(project: Path, start: Start) -> None:
    script = project / "note.sh"
    script.write_text(
        'printf "%s %s %s\\n" "$URDFSYNC_ROBOT" "$URDFSYNC_PACKAGE" "$(basename "$URDFSYNC_FILES")" >> log\n'
    )
    watch = start("--exec", "sh note.sh; echo noise; exit 3")
    assert watch.wait("ran")["code"] == 3
    since = watch.mark
    probe(watch, project)
    watch.wait("ran", since=since)
    assert "ended with exit code 3" in watch.wait("noted", since=since)["diagnostics"][0]["message"]
    lines = (project / "log").read_text().splitlines()
    assert lines[-1] == "ladder Ladder R2Parameters.mo"
    assert watch.errors == "noise\nnoise\n"


def test_a_command_that_takes_long_holds_nothing_up(project: Path, start: Start) -> None:
    watch = start("--exec", "while [ ! -e go ]; do sleep 0.05; done; echo run >> runs")
    for ohm in (330, 331, 332):
        probe(watch, project, ohm=ohm)
    assert not (project / "runs").exists()
    (project / "go").touch()
    until(lambda: [event["event"] for event in watch.events].count("ran") == 2, watch)
    assert (project / "runs").read_text() == "run\nrun\n", "what came meanwhile is one more run"
