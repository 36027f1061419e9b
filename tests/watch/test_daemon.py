"""The daemon on real files, in a process of its own: which changes it builds, and which it leaves alone.

That nothing else was built shows when one more change has been built: its events are the only ones since.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from support.daemon import MODEL, RECORD, REPOSITORY, Event, Start, Watch, holds, ladder, until
from support.git import NEEDS_GIT, Repository
from support.networks import configure

from urdfsync.commands import cli
from urdfsync.project.state.lock import build_lock

CONFIG = '[robots.{0}]\nsource = "{1}"\npackage = "{2}"\ndomain = "rcnetwork"\n'
BUILD = ["settling", "building", "built"]
PATIENT = ("--patience", "100")

Wanted = Callable[[Event], bool]


def put(path: Path | str, ohm: float) -> Path:
    """Write a source, with its signal beside it."""
    place = Path(path)
    place.parent.mkdir(parents=True, exist_ok=True)
    if not (place.parent / "step.csv").is_file():
        shutil.copy(REPOSITORY / "tests/rcnetwork/examples/step.csv", place.parent)
    place.write_text(ladder(ohm))
    return place


@contextlib.contextmanager
def building(watch: Watch, ohm: float | None = None, wanted: Wanted = lambda event: True) -> Iterator[int]:
    """What happens within is built, such as the source with this resistance; gives the number of the next event."""
    since = watch.mark
    yield since
    watch.wait("built", wanted, since)
    assert ohm is None or holds(ohm)


def has_files(event: Event) -> bool:
    return bool(event["files"])


def probe(watch: Watch, source: Path | str = "ladder.json", ohm: float = 999.0) -> None:
    """Change the source once more, and wait until that is built: so whatever was to come before has come."""
    with building(watch, ohm, has_files):
        put(source, ohm)


def await_rescans() -> None:
    """Wait until several rescans of 0.1 s must have been."""
    time.sleep(0.5)


def test_it_builds_at_its_start_and_whenever_the_source_changed(start: Start) -> None:
    """What the daemon writes itself is no event, and neither is a file that has nothing to do with it."""
    watch = start()
    assert watch.kinds() == ["started", "building", "built"]
    since = watch.mark
    Path("unrelated").mkdir()
    for number in range(500):
        Path("unrelated" if number % 2 else ".", f"{number}.txt").write_text("nothing")
    await_rescans()  # and the look at what the daemon has written, which would take the source along without a word
    for ohm in (300, 400, 500):
        probe(watch, ohm=ohm)
    assert watch.kinds(since) == 3 * BUILD


def test_a_slow_writer_is_one_build(start: Start) -> None:
    watch = start("--settle", "500")
    content = ladder(330).encode()
    with building(watch, 330) as since, Path("ladder.json").open("r+b", buffering=0) as file:
        file.truncate(0)
        for begin in range(0, len(content), 40):
            file.write(content[begin : begin + 40])
            time.sleep(0.05)
    assert watch.kinds(since) == BUILD


def test_what_changed_and_who_builds_meanwhile_is_said(start: Start) -> None:
    watch = start("--rescan", "0.1")
    await_rescans()  # and the look at what the daemon has written
    with build_lock(Path.cwd() / ".urdfsync", 0) as lock:
        lock.acquire()
        since = watch.mark
        put(Path("ladder.json"), 330)
        assert watch.wait("settling", since=since)["file"] == "ladder.json"
        assert watch.wait("waiting", since=since)["reason"] == f"waiting for process {os.getpid()}, which is building"
    watch.wait("built", since=since)
    assert watch.kinds(since) == ["settling", "building", "waiting", "built"]


@pytest.mark.parametrize("content", ["", "{", None], ids=["empty", "half", "deleted"])
def test_a_source_that_is_not_valid_yet_is_waited_for(start: Start, content: str | None) -> None:
    watch = start(*PATIENT)
    since, source = watch.mark, Path("ladder.json")
    source.unlink() if content is None else source.write_text(content)
    waiting = watch.wait("waiting", since=since)
    assert waiting["reason"] == "waiting for the exporter of ladder.json"
    assert waiting["diagnostics"][0]["code"] == ("no-source" if content is None else "json")
    with building(watch, 330):
        put(source, 330)
    assert watch.kinds(since) == ["settling", "building", "waiting", "building", "built"]


def test_a_source_that_is_never_valid_is_told_once_and_recovers(start: Start) -> None:
    watch = start("--rescan", "0.1", "--patience", "0.1")
    Path("ladder.json").write_text("{")
    watch.wait("failed")
    since = watch.mark
    await_rescans()
    assert watch.mark == since, "each rescan tries again, and says nothing"
    put("ladder.json", 330)
    assert watch.wait("built", since=since)["recovered"]
    assert holds(330)


def test_a_folder_is_moved_over_the_watched_one_then_deleted_and_made_again(start: Start) -> None:
    put("cad/export/ladder.json", 220.5)
    put("cad/next/ladder.json", 330)
    Path("urdfsync.toml").write_text(CONFIG.format("ladder", "cad/export/ladder.json", "Ladder"))
    watch = start(*PATIENT)
    with building(watch, 330) as since:
        Path("cad/export").rename("cad/old")
        Path("cad/next").rename("cad/export")
    probe(watch, "cad/export/ladder.json")
    assert watch.kinds(since).count("built") == 2
    since = watch.mark
    shutil.rmtree("cad")
    watch.wait("waiting", since=since)
    with building(watch, 330, has_files):
        put("cad/export/ladder.json", 330)


@pytest.mark.parametrize("tail", ["ladder.json", ""], ids=["file", "folder"])
def test_a_link_gets_another_target(start: Start, tail: str, tmp_path: Path) -> None:
    for name, ohm in (("v1", 220.5), ("v2", 330.0)):
        put(tmp_path / "exports" / name / "ladder.json", ohm)
    place = Path("linked.json" if tail else "linked")
    place.symlink_to(tmp_path / "exports/v1" / tail)
    source = "linked.json" if tail else "linked/ladder.json"
    Path("urdfsync.toml").write_text(CONFIG.format("ladder", source, "Ladder"))
    watch = start()
    with building(watch, 330) as since:
        Path("new-link").symlink_to(tmp_path / "exports/v2" / tail)
        Path("new-link").rename(place)
    probe(watch, tmp_path / "exports/v2/ladder.json")
    assert watch.kinds(since).count("built") == 2


def test_the_configuration_changes(start: Start) -> None:
    watch = start()
    since, file = watch.mark, Path("urdfsync.toml")
    good = file.read_text()
    file.write_text("[robots.ladder\n")
    assert watch.wait("noted", since=since)["diagnostics"][0]["code"] == "toml-syntax"
    file.unlink()
    watch.wait("noted", lambda event: event["diagnostics"][0]["code"] == "no-config", since)
    probe(watch)  # the last good one is still in force
    file.write_text(f'{good}prefix = "net"\n{CONFIG.format("second", "ladder.json", "Second")}')
    assert watch.wait("started", since=since)["robots"] == ["ladder", "second"]
    watch.wait("built", lambda event: event["result"]["robot"] == "second", since)
    assert Path("modelica/Second/package.mo").is_file()
    assert "net" in Path("modelica/Ladder/Ladder.mo").read_text()


def test_an_imported_file_changes_vanishes_and_comes_back(start: Start) -> None:
    watch = start()
    signal_file, imported = Path("step.csv"), Path("modelica/Ladder/Resources/step.txt")
    with building(watch):
        signal_file.write_text("0,0\n1,7\n")
    assert "7.0" in imported.read_text()
    with building(watch, wanted=lambda event: event["result"]["diagnostics"][0]["code"] == "table-not-found-kept"):
        signal_file.unlink()
    assert imported.is_file(), "the copy serves"
    with building(watch, wanted=has_files):
        signal_file.write_text("0,0\n1,8\n")
    assert "8.0" in imported.read_text()


def test_a_template_of_the_users_changes(start: Start) -> None:
    Path("templates").mkdir()
    configure('templates = "templates"\n')
    watch = start()
    own = (REPOSITORY / "tests/rcnetwork/templates/element/model.mo.jinja").read_text()
    with building(watch, wanted=has_files):
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
    watch = start("--settle", "300", robots=2)
    since = watch.mark
    repository.git("checkout", "-q", "other")
    watch.until(lambda: watch.kinds(since).count("built") == 2)
    assert sorted(watch.kinds(since)) == sorted(2 * BUILD)
    assert holds(330)
    with building(watch, 330, lambda event: event["result"]["robot"] == "ladder" and has_files(event)):
        repository.git("checkout", "--", "modelica", ".urdfsync")


# Outputs


def test_what_a_user_edits_is_left_alone_and_each_is_told_once(start: Start) -> None:
    watch = start("--rescan", "0.1")

    def acted(what: str, since: int) -> list[str]:
        event = watch.wait(
            "built", lambda event: any(one["reason"] == what for one in event["result"]["actions"]), since
        )
        return [action["path"] for action in event["result"]["actions"] if action["reason"] == what]

    since = watch.mark
    MODEL.write_text(MODEL.read_text() + "// mine\n")
    assert acted("keep", since) == [str(MODEL)]
    probe(watch)
    assert MODEL.read_text().endswith("// mine\n")
    since = watch.mark
    RECORD.write_text(RECORD.read_text().replace("999", "1000"))
    watch.wait("built", since=since)
    put("ladder.json", 330)
    assert acted("conflict", since) == [str(RECORD)]
    assert "1000" in RECORD.read_text()
    since, whole = watch.mark, json.loads(ladder(330))
    less = [element for element in whole["elements"] if element["name"] != "R2"]
    Path("ladder.json").write_text(json.dumps({**whole, "elements": less}))
    assert acted("orphan", since) == [str(MODEL), str(RECORD)]
    since = watch.mark
    await_rescans()
    assert watch.mark == since


OUTPUTS = (MODEL, "modelica/Ladder/package.order", ".urdfsync/robots/ladder.state")


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("options", [(), ("--rescan", "0.1")], ids=["by its event", "by a rescan"])
def test_an_output_that_is_deleted_is_written_again(start: Start, output: Path | str, options: tuple[str, ...]) -> None:
    start(*options)
    path, before = Path(output), Path(output).read_bytes()
    path.unlink()
    until(lambda: path.is_file() and path.read_bytes() == before)


def _to_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _to_link(path: Path) -> None:
    path.rename(path.with_name("moved"))
    path.symlink_to("moved")


@pytest.mark.parametrize("change", [_to_folder, _to_link])
def test_what_is_in_the_way_is_told_once_and_recovers(start: Start, change: Callable[[Path], None]) -> None:
    watch = start("--rescan", "0.1")
    change(RECORD)
    assert [one["code"] for one in watch.wait("failed")["result"]["diagnostics"]] == ["output-in-the-way"]
    since = watch.mark
    (RECORD.rmdir if change is _to_folder else RECORD.unlink)()
    assert watch.wait("built", since=since)["recovered"]
    assert RECORD.is_file()
    assert watch.kinds().count("failed") == 1


def test_saves_right_after_the_build_has_looked(start: Start) -> None:
    """In the same tick of the clock, and of the same size, they leave all that the system says of a file."""
    watch, original = start(), MODEL.read_bytes()
    for number in range(5):
        for text in (b"//a" if number % 2 else b"//b", original[:3]):
            with building(watch), MODEL.open("r+b") as file:
                file.write(text)


def test_the_state_folder_is_deleted(start: Start) -> None:
    watch = start("--rescan", "0.1")
    lock, manifest = Path(".urdfsync/watch.lock"), Path(".urdfsync/robots/ladder.state")
    for _ in range(2):
        shutil.rmtree(".urdfsync", ignore_errors=True)  # the daemon may be at it
    until(lambda: lock.is_file() and lock.read_text().strip() == str(watch.process.pid) and manifest.is_file())
    probe(watch)


# --exec


def test_a_command_after_builds_that_changed_something(start: Start) -> None:
    note = 'printf "%s %s %s\\n" "$URDFSYNC_ROBOT" "$URDFSYNC_PACKAGE" "$(basename "$URDFSYNC_FILES")" >> log'
    watch = start("--exec", f"{note}; echo noise; exit 3")
    assert watch.wait("ran")["code"] == 3
    since = watch.mark
    probe(watch)
    watch.wait("ran", since=since)
    assert "ended with exit code 3" in watch.wait("noted", since=since)["diagnostics"][0]["message"]
    assert Path("log").read_text().splitlines()[-1] == "ladder Ladder R2Parameters.mo"
    assert watch.errors == "noise\nnoise\n"


def test_a_command_waits_while_the_package_is_broken(start: Start) -> None:
    watch = start("--exec", 'echo "$(basename -a $URDFSYNC_FILES | tr "\\n" " ")" >> log')
    watch.wait("ran")
    since, text = watch.mark, MODEL.read_text()
    MODEL.write_text(text.replace("\nequation", "\n  Elements.Gone gone;\nequation"))
    event = watch.wait("built", since=since)
    assert (event["result"]["is_broken"], event["result"]["in_step"]) == (True, False)
    probe(watch)
    watch.rest(since)
    assert watch.kinds().count("ran") == 1
    since = watch.mark
    MODEL.write_text(text)
    watch.wait("ran", since=since)
    assert Path("log").read_text().splitlines()[-1].split() == ["R2Parameters.mo"]


def test_a_command_that_takes_long_holds_nothing_up(start: Start) -> None:
    watch = start("--exec", "[ ! -e go ] || { read line < go; echo run >> runs; }")
    watch.wait("ran")
    os.mkfifo("go")
    for ohm in (330, 331, 332):
        probe(watch, ohm=ohm)
    assert not Path("runs").exists()
    for count in (2, 3):
        Path("go").write_text("go\n")
        watch.until(lambda: watch.kinds().count("ran") >= count)  # noqa: B023
    assert Path("runs").read_text() == "run\nrun\n", "what came meanwhile is one more run"
