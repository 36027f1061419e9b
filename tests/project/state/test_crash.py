"""A build that is killed, that fails or that meets the user's saves, at each of its file operations.

The next build must bring about what an undisturbed one does, with the user's edits as they were. Every
kind of operation is tried in all cases; `URDFSYNC_CRASHES=1` tries each single one. With `-s`, the counts are printed.
"""

from __future__ import annotations

import collections
import errno
import itertools
import os
import re
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from random import Random
from typing import IO
from unittest import mock

import pytest
from support import crashes, replay
from support.crashes import CHANGES, Operation, before_each, contents, kill, operations, run
from support.networks import LADDER, configure, edit

from urdfsync.common.files import TEMPORARY, shown
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.modelica.stamp import with_stamp
from urdfsync.project import config
from urdfsync.project.state import file_operations
from urdfsync.project.state.transaction import find_leftovers

RECORD = f"{LADDER}/Elements/C2Parameters.mo"
REMOVED = f"{LADDER}/Elements/R2.mo"
ADDED = f"{LADDER}/Elements/R3.mo"
MINE = b"\n// mine\n"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system"),
]

Tally = collections.Counter[str]
Wanted = tuple[list[str], Mapping[str, bytes | None]]
"""The files that conflict after a build, and all files."""


@pytest.fixture(scope="module")
def tally() -> Iterator[Tally]:
    """How often each trouble was tried."""
    counts = Tally()
    yield counts
    print(f"\n{dict(counts)}")  # noqa: T201


@pytest.fixture
def changed(project: Path) -> Path:
    """A network that was built and edited, and whose source has changed then in every way."""
    run(project)
    edit(project / LADDER / "Elements/C1.mo", "end C1;", "// mine\nend C1;")
    (project / LADDER / "Bench.mo").write_text("within Ladder;\nmodel Bench\nend Bench;\n")
    edit(project / LADDER / "package.order", "Ladder\n", "Bench\nLadder\n")
    edit(project / "ladder.json", '"R2"', '"R3"')
    edit(project / "ladder.json", "220.5", "330")
    edit(project / "ladder.json", "4.7e-6", "1e-5")
    edit(project / "step.csv", "0.1,5", "0.1,7")
    return project


@pytest.fixture
def renamed(project: Path) -> Path:
    """A network with a conflict that the user has resolved by hand, and an edited element that has another name now."""
    run(project)
    record = project / LADDER / "Elements/R1Parameters.mo"
    edit(record, "100", "101")
    edit(project / "ladder.json", "100", "150")
    assert run(project).conflicts
    edit(record, "101", "150")
    edit(project / LADDER / "Elements/C1.mo", "end C1;", "// mine\nend C1;")
    edit(project / "ladder.json", '"C1"', '"Tank"')
    return project


@pytest.fixture
def moved(project: Path) -> Path:
    """A network whose package has another name and another parent now."""
    run(project)
    configure("create_parents = true\n")
    edit(project / "urdfsync.toml", '"Ladder"', '"Plant.Filters.Ladder"')
    return project


@pytest.fixture
def elsewhere(project: Path) -> Path:
    """A network with an edited file whose text is the same in the other folder that its package has now."""
    run(project)
    edit(project / LADDER / "Elements/C1.mo", "equation", "// mine\nequation")
    configure('output = "lib"\n')
    return project


@pytest.fixture
def edited(tmp_path: Path) -> Path:
    """A robot whose package has random edits, conflicts among them, and whose source has changed."""
    crashes.edited_at_random(tmp_path / "edited", Random(20))
    return tmp_path / "edited"


@pytest.fixture
def exchanged(tmp_path: Path) -> Path:
    """A robot whose source has exchanged the names of two edited links, and changed a number."""
    project = tmp_path / "exchanged"
    project.mkdir()
    (project / "urdfsync.toml").write_text(f'{crashes.CONFIGURATION}on_conflict = "merge"\n')
    crashes.export_chain(project, ["a1", "a2", "a3"])
    run(project)
    for name in ("A1", "A2"):
        edit(project / f"modelica/Bot/Links/{name}.mo", "equation", f"  Real mine{name} = 1;\nequation")
    crashes.export_chain(project, ["a2", "a1", "a3"], 0.5)
    return project


@pytest.fixture(params=["changed", "project", "moved", "elsewhere", "renamed", "edited", "exchanged"])
def scenario(request: pytest.FixtureRequest) -> Path:
    path: Path = request.getfixturevalue(request.param)
    return path


def leftovers(project: Path) -> list[str]:
    return find_leftovers(path for path in (project, *project.rglob("*")) if path.is_dir())


def without_former(files: Mapping[str, bytes | None]) -> Mapping[str, bytes | None]:
    return {path: replay.without_former(content) for path, content in files.items()}


def build_twice(project: Path) -> Wanted:
    """Build, and see that the next build has nothing to write."""
    result = run(project)
    assert not result.failed, result.diagnostics
    found = [each.action.path for each in result.conflicts], contents(project)
    assert ([each.action.path for each in run(project).conflicts], contents(project)) == found
    return found


def expected(project: Path, work: Path, before: Callable[[Path], object] = lambda project: None) -> Wanted:
    """What an undisturbed build makes of the project."""
    clean = crashes.copy(project, work)
    before(clean)
    return build_twice(clean)


def every(project: Path, work: Path, names: Sequence[str]) -> Iterator[tuple[Operation, Path]]:
    """Operations of these names in a build of the project, and for each a copy of the project."""
    for operation in operations(crashes.copy(project, work), names):
        yield operation, crashes.copy(project, work)


# Kills


ALWAYS = ("exchange", "write", "remove", "remove_folder", "sync")
"""Operations of every build that writes."""
IN_SCENARIO = {
    "changed": (*ALWAYS, "place", "replace"),
    "project": ("place", "write", "make_folder", "sync"),
    "moved": crashes.NAMES,
    "elsewhere": (*ALWAYS, "place", "make_folder", "replace"),
    "renamed": (*ALWAYS, "place", "make_folder", "replace"),
    "edited": (*ALWAYS, "place", "make_folder"),
    "exchanged": (*ALWAYS, "place", "make_folder"),
}


def assert_finished(start: Path, work: Path, names: Sequence[str], *, half: bool = False) -> None:
    """A build that is killed before an operation, or with `half` in the middle of it, is finished by the next one."""
    wanted = expected(start, work / "clean")
    for operation, project in every(start, work / "work", names):
        kill(project, operation.number, half=half)
        assert build_twice(project) == wanted, operation


@pytest.mark.parametrize(("scenario", "names"), IN_SCENARIO.items(), indirect=["scenario"])
def test_a_killed_build_is_finished_by_the_next(scenario: Path, tmp_path: Path, names: Sequence[str]) -> None:
    assert_finished(scenario, tmp_path, names)


def test_a_build_killed_in_the_middle_of_a_file_is_finished_by_the_next(changed: Path, tmp_path: Path) -> None:
    assert_finished(changed, tmp_path, ["write"], half=True)


@pytest.mark.parametrize("missing", ["links", "renames"])
def test_killed_builds_on_lesser_file_systems(
    changed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, missing: str
) -> None:
    if missing == "links":
        error = PermissionError(errno.EPERM, os.strerror(errno.EPERM))
        monkeypatch.setattr(os, "link", mock.Mock(side_effect=error))
    monkeypatch.setattr(file_operations, "rename", lambda path, target, flag: False)
    assert_finished(changed, tmp_path, CHANGES)


@pytest.fixture
def crashed(changed: Path, tmp_path: Path) -> Path:
    """The changed network after a build that was killed when half of its files were in place."""
    swaps = operations(crashes.copy(changed, tmp_path / "work"), ["exchange"])
    crashed = crashes.copy(changed, tmp_path / "crashed")  # whose build has the same operations
    kill(crashed, swaps[len(swaps) // 2].number)
    assert leftovers(crashed)
    return crashed


def test_the_build_after_a_killed_one_may_be_killed_too(crashed: Path, tmp_path: Path) -> None:
    wanted = expected(crashed, tmp_path / "clean")
    for operation, project in every(crashed, tmp_path / "work", ["exchange", "replace", "remove", "sync"]):
        kill(project, operation.number)
        assert build_twice(project) == wanted, operation


def test_what_the_user_does_after_a_crash_is_kept(changed: Path, tmp_path: Path) -> None:
    """An edit of a file that was written already is one of the new text: no conflict."""
    clean = crashes.copy(changed, tmp_path / "clean")
    run(clean)
    for path in (RECORD, f"{LADDER}/Ladder.mo"):
        new = (clean / path).read_bytes()
        for operation, project in every(changed, tmp_path / "work", (*CHANGES, "sync")):
            kill(project, operation.number)
            was_new = (project / path).read_bytes() == new
            (project / path).write_bytes((project / path).read_bytes() + MINE)
            mine = (project / path).read_bytes()
            result = run(project)
            assert (project / path).read_bytes() == mine, operation
            assert not result.failed
            assert bool(result.conflicts) is not was_new, operation
            again = run(project)
            assert [file.action for file in again.conflicts] == [file.action for file in result.conflicts]


def test_a_source_that_changes_after_a_crash(changed: Path, tmp_path: Path) -> None:
    def change(project: Path) -> None:
        edit(project / "ladder.json", "1e-5", "2e-5")
        edit(project / "ladder.json", '"R3"', '"R4"')

    wanted = expected(changed, tmp_path / "clean", change)
    for operation, project in every(changed, tmp_path / "work", CHANGES):
        kill(project, operation.number)
        change(project)
        found = build_twice(project)
        # a killed build may have made R3, which the next one renames
        assert (found[0], without_former(found[1])) == (wanted[0], without_former(wanted[1])), operation


# Errors of the system


@pytest.mark.parametrize("lasting", [False, True])
@pytest.mark.parametrize("scenario", ["changed", "edited"], indirect=True)
def test_a_system_that_refuses_leaves_all_as_it_was(
    scenario: Path, tmp_path: Path, tally: Tally, lasting: bool
) -> None:
    before, wanted = contents(scenario), expected(scenario, tmp_path / "clean")
    for operation, project in every(scenario, tmp_path / "work", ALWAYS):
        number = (errno.ENOSPC, errno.EACCES)[(operation.number + lasting) % 2]

        def refuse(found: Operation, first: int = operation.number, number: int = number) -> None:
            if found.number == first or (lasting and found.number > first):
                raise OSError(number, os.strerror(number), str(found.paths[0]) if found.paths else None)

        with before_each(refuse):
            result = run(project)
        if any("notes" in path.parts for path in operation.paths):  # what can't be noted is made again
            assert not result.failed, operation
            assert contents(project) == wanted[1], operation
            continue
        assert result.failed, operation
        assert any(os.strerror(number) in found.message for found in result.diagnostics)
        assert result.unfinished or lasting or contents(project) == before, operation
        tally[f"{errno.errorcode[number]}"] += 1
        assert build_twice(project) == wanted, operation


def test_a_build_that_is_interrupted_is_finished_by_the_next(changed: Path, tmp_path: Path) -> None:
    wanted = expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work", ALWAYS):

        def interrupt(found: Operation, first: int = operation.number) -> None:
            if found.number == first:
                raise KeyboardInterrupt

        with before_each(interrupt), pytest.raises(KeyboardInterrupt):
            run(project)
        assert build_twice(project) == wanted, operation


# Saves in the instant of the change


def in_place(path: Path, content: bytes) -> None:
    path.write_bytes(content)


def by_renaming(path: Path, content: bytes) -> None:
    beside = path.with_name("editor~")
    beside.write_bytes(content)
    beside.replace(path)


WAYS = (in_place, by_renaming)
"""In turns: what matters is which operation comes next."""


class Saves:
    """Saves a file of the user's before one operation of a build."""

    def __init__(self, target: Path, number: int, save: Callable[[Path, bytes], None]) -> None:
        self._target, self._number, self._save = target, number, save
        self.mine = b""
        self.was = b""

    def __call__(self, found: Operation) -> None:
        if found.number == self._number:
            self.was = self._target.read_bytes() if self._target.exists() else b""
            self.mine = self.was + MINE
            self._target.parent.mkdir(exist_ok=True)
            self._save(self._target, self.mine)


@pytest.fixture(params=["exchanges", "no exchanges"])
def system(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if request.param == "no exchanges":
        monkeypatch.setattr(file_operations, "rename", lambda path, target, flag: False)


@pytest.mark.usefixtures("system")
@pytest.mark.parametrize("path", [RECORD, REMOVED, ADDED, f"{LADDER}/Ladder.mo", f"{LADDER}/package.order"])
def test_a_save_between_plan_and_replacement_survives(changed: Path, tmp_path: Path, tally: Tally, path: str) -> None:
    """It is a conflict if it was made of the old text. Without the save, all is as if it had never been."""
    clean = crashes.copy(changed, tmp_path / "clean")
    run(clean)
    wanted, new = contents(clean), (clean / path).read_bytes() if (clean / path).exists() else None
    for operation, project in every(changed, tmp_path / "work", (*CHANGES, "remove", "sync")):
        saves = Saves(project / path, operation.number, WAYS[(operation.number + len(path)) % 2])
        with before_each(saves):
            result = run(project)
        assert saves.mine
        assert not result.failed, operation
        tally["saves"] += 1
        tally["conflicts"] += len(result.conflicts)
        mine = (project / path).read_bytes()
        if path.endswith("package.order"):
            assert MINE in mine, operation  # names are merged
            continue
        assert mine == saves.mine, operation
        assert bool(result.conflicts) is (saves.was != new and new is not None), operation
        (project / path).unlink() if new is None else (project / path).write_bytes(new)
        run(project)
        assert without_former(contents(project)) == without_former(wanted), operation


@pytest.mark.usefixtures("system")
@pytest.mark.parametrize("scenario", ["changed", "edited"], indirect=True)
def test_a_save_in_the_instant_of_a_kill_survives(scenario: Path, tmp_path: Path, tally: Tally) -> None:
    """Each target is saved just before it changes, and the build is killed before each of the next operations."""
    for operation in operations(crashes.copy(scenario, tmp_path / "work"), CHANGES):
        targets = [path for path in operation.paths if path.suffix in (".mo", ".order", ".txt")]
        targets = [path for path in targets if ".urdfsync" not in path.parts]
        for killed_at in range(operation.number + 1, operation.number + 4) if targets else ():
            project = crashes.copy(scenario, tmp_path / "work")
            saves = Saves(targets[0], operation.number, WAYS[killed_at % 2])
            kill(project, killed_at, earlier=_passing_on(saves, tmp_path / "mine"))
            tally["saves and kills"] += 1
            mine = (tmp_path / "mine").read_bytes()
            (tmp_path / "mine").unlink()
            assert not run(project).failed, operation
            if targets[0].suffix == ".order":
                assert any(MINE in path.read_bytes() for path in targets[0].parent.glob("package.order*")), operation
            elif (kept := Path(f"{targets[0]}.saved")).exists():  # caught by the exchange before the kill
                assert kept.read_bytes() == mine, (operation, killed_at)
            elif targets[0].exists():
                # the save may follow the new name; that of the renamed part has its new mass, too
                saved, mine = (
                    re.sub(rb"([Bb]2)x", rb"\1", with_stamp(text, None)) for text in (targets[0].read_bytes(), mine)
                )
                assert saved == mine or (targets[0].stem.startswith("B2x") and MINE in saved), (operation, killed_at)
            else:  # its element has another name, and the save has moved with it
                assert any(MINE in path.read_bytes() for path in project.rglob("*.mo")), (operation, killed_at)
            assert not list(project.rglob(f"*{TEMPORARY}*")), operation
    assert tally["saves and kills"]


def _passing_on(saves: Saves, place: Path) -> Callable[[Operation], None]:
    """Let the parent of a process that is killed know what was saved."""

    def hook(found: Operation) -> None:
        saves(found)
        if saves.mine and not place.exists():
            place.write_bytes(saves.mine)

    return hook


def test_what_is_written_through_an_open_handle_survives(changed: Path, tmp_path: Path) -> None:
    """An editor may have opened the old file before it was exchanged. When the record changes, the old file is gone."""
    for operation, project in every(changed, tmp_path / "work", CHANGES):
        if any(path.suffix == ".state" for path in operation.paths):
            continue
        with (project / RECORD).open("r+b", buffering=0) as handle:
            handle.seek(0, os.SEEK_END)

            def write(found: Operation, number: int = operation.number, handle: IO[bytes] = handle) -> None:
                if found.number == number:
                    handle.write(MINE)

            with before_each(write):
                run(project)
            handle.seek(0)
            mine = handle.read()
        assert mine.endswith(MINE), operation
        files = [path.read_bytes() for path in project.rglob("*") if path.is_file()]
        assert mine in files, operation


def test_a_file_that_is_saved_all_the_time_stops_the_build(changed: Path) -> None:
    """With other line ends each time, which are no edit."""
    target, numbers = changed / RECORD, itertools.count(1)
    old = target.read_bytes()

    def meddle(found: Operation) -> None:
        if found.name == "sync":
            number = next(numbers) % old.count(b"\n")
            target.write_bytes(old.replace(b"\n", b"\r\n", number))

    with before_each(meddle):
        result = run(changed)
    assert [found.code for found in result.diagnostics] == ["restless"]
    assert target.read_bytes().replace(b"\r", b"") == old
    assert not run(changed).conflicts
    assert target.read_bytes() != old


def test_what_an_overtaken_build_wrote_is_its_own_after_a_build_of_another_robot(changed: Path) -> None:
    """A save overtakes the build, and the source can't be read then; meanwhile the other robot is built."""
    shutil.copy(changed / "ladder.json", changed / "other.json")
    configure('[robots.other]\nsource = "other.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    text, mine = (changed / "ladder.json").read_text(), changed / REMOVED

    def meddle(found: Operation) -> None:
        if found.name == "exchange":
            mine.write_bytes(MINE)
            (changed / "ladder.json").write_text("")

    loaded = config.load(changed / "urdfsync.toml")
    with before_each(meddle):
        (result,) = build(loaded, loaded.robots[:1], BuildOptions())
    assert result.failed
    (result,) = build(loaded, loaded.robots[1:], BuildOptions())
    assert not result.failed
    (changed / "ladder.json").write_text(text)
    (result,) = build(loaded, loaded.robots[:1], BuildOptions())
    assert (result.failed, result.conflicts) == (False, []), "what was written then is urdfsync's own"
    assert mine.read_bytes() == MINE


# What is found after a crash


def test_a_dry_run_leaves_what_a_killed_build_left(crashed: Path) -> None:
    before = contents(crashed)
    result = run(crashed, dry=True)
    assert (result.failed, result.in_step) == (False, False)
    assert contents(crashed) == before


def test_a_caught_save_is_kept_and_told(crashed: Path) -> None:
    (left, *_) = [Path(path) for path in leftovers(crashed) if ".mo." in path and "-none" not in path]
    left.write_bytes(MINE)
    target = left.with_name(left.name[1:].partition(".mo.")[0] + ".mo")
    edit(target, "end ", "// later\nend ")
    assert ("kept-save", shown(target)) in [(found.code, found.file) for found in run(crashed).diagnostics]
    assert target.with_name(f"{target.name}.saved").read_bytes() == MINE
    assert not leftovers(crashed)


@pytest.fixture
def output(project: Path, tmp_path: Path) -> Iterator[Path]:
    """Where the package of the network is built to: a folder on another file system."""
    places = [place for place in (Path("/dev/shm"), Path("/var/tmp")) if place.is_dir()]
    others = [place for place in places if place.stat().st_dev != tmp_path.stat().st_dev]
    if not others:
        pytest.skip("there is no second file system")
    output = others[0] / f"urdfsync-{os.getpid()}"
    output.mkdir()
    edit(project / "urdfsync.toml", "[robots.ladder]", f'[robots.ladder]\noutput = "{output}"')
    try:
        yield output
    finally:
        shutil.rmtree(output)


def test_a_package_on_another_file_system(project: Path, output: Path, tmp_path: Path) -> None:
    run(project)
    edit(project / "ladder.json", '"R2"', '"R3"')
    built = crashes.copy(output, tmp_path / "built")
    clean = crashes.copy(project, tmp_path / "clean")
    found = operations(clean, CHANGES)
    wanted = contents(clean), contents(output)
    for operation in found:
        copied = crashes.copy(project, tmp_path / "work")
        crashes.copy(built, output)
        kill(copied, operation.number)
        assert not run(copied).failed, operation
        assert (contents(copied), contents(output)) == wanted, operation
