"""Outputs as the last build saw them: which changes of them an event leads to, and which a rescan finds."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from urdfsync import config
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.files import Tree
from urdfsync.outcome import Result
from urdfsync.watch.build import build_robots
from urdfsync.watch.debounce import Times
from urdfsync.watch.input_files import InputFiles
from urdfsync.watch.robots import WatchedRobot, WatchedRobots

ROBOT = '[robots.{0}]\nsource = "{0}.json"\npackage = "Plant.{1}"\ndomain = "rcnetwork"\n'
MODEL = "modelica/Plant/Ladder/Elements/R2.mo"
AGE = 0.06
"""Seconds after which a file is old enough to be trusted."""


class Bench:
    """Watched robots of a project, as the daemon has them, without events and settling."""

    def __init__(self, project: Path) -> None:
        self.project, self.cache, self.files = project, Cache(), InputFiles()
        self.robots = WatchedRobots(Times(), (), self.files, self.cache)
        self.load()

    def load(self) -> None:
        """Read the configuration."""
        self.config = config.load(self.project / "urdfsync.toml")
        self.robots.use(self.config, self.config.robots)

    @property
    def ladder(self) -> WatchedRobot:
        """The first robot."""
        return next(iter(self.robots))

    def build(self) -> Sequence[Result]:
        """Build all robots until nothing is written, as the daemon does; returns the first results."""
        options = BuildOptions(cache=self.cache)
        first, last = (list(build_robots(self.config, self.config.robots, options)) for _ in range(2))
        for watched, result in zip(self.robots, last, strict=True):
            self.robots.renew_paths(watched)
            watched.settled = self.robots.inputs(watched)
            watched.rest()
            if result.failed:
                self.robots.note_outputs(watched)
        return first

    def has_changed_at(self, *names: str) -> bool:
        """Whether something differs where events say so."""
        return self.robots.has_changed_at(self.ladder, {str(self.project / name) for name in names})

    def changes(self) -> set[str] | None:
        """The outputs that a rescan finds changed; None if all is as built."""
        if self.robots.is_as_built(self.ladder, self.robots.inputs(self.ladder)):
            return None
        return {os.path.relpath(path, self.project) for path in self.ladder.touched_outputs}

    def outputs(self) -> set[str]:
        """The names of all outputs that are there."""
        return {os.path.relpath(path, self.project) for path in self.ladder.paths.outputs if Path(path).exists()}


@pytest.fixture
def bench(rc_domain: None, tmp_path: Path) -> Bench:
    """One robot in a package of the user's, built."""
    project = tmp_path / "project"
    shutil.copytree(Path(__file__).parents[1] / "rcnetwork/examples", project)
    (project / "modelica/Plant").mkdir(parents=True)
    (project / "modelica/Plant/package.mo").write_text("within ;\npackage Plant\nend Plant;\n")
    (project / "modelica/Plant/package.order").write_text("")
    (project / "urdfsync.toml").write_text(ROBOT.format("ladder", "Ladder"))
    bench = Bench(project)
    assert not any(result.failed for result in bench.build())
    return bench


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Grows by every output that is read."""
    paths: list[str] = []
    real = Tree.content

    def content(self: Tree, path: str) -> bytes | None:
        paths.append(path)
        return real(self, path)

    monkeypatch.setattr(Tree, "content", content)
    return paths


def test_what_a_build_has_left_is_no_news(bench: Bench) -> None:
    assert len(bench.outputs()) > 10
    assert bench.robots.has_built_all(bench.ladder)
    assert not bench.has_changed_at(*bench.outputs())
    assert not bench.has_changed_at("modelica", "modelica/Plant/Ladder", ".urdfsync")
    assert bench.changes() is None


def test_files_are_read_once_until_they_change(bench: Bench, read: list[str]) -> None:
    time.sleep(AGE)
    assert bench.changes() is None
    assert len(read) > 10
    read.clear()
    assert bench.changes() is None
    assert not bench.has_changed_at(*bench.outputs())
    assert read == []
    (bench.project / MODEL).touch()
    assert not bench.has_changed_at(MODEL)
    assert read == [str(bench.project / MODEL)]
    bench.files.rehash_all()
    bench.cache.rehash_all()
    assert bench.changes() is None
    assert len(read) > 10


def _edit(path: Path) -> None:
    path.write_bytes(path.read_bytes() + b"\n")


def _folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _remove(path: Path) -> None:
    path.rmdir() if path.is_dir() else path.unlink(missing_ok=True)


def _link(path: Path) -> None:
    path.rename(path.with_name("moved"))
    path.symlink_to("moved")


def _replace(path: Path) -> None:
    path.with_name("new").write_bytes(path.read_bytes()[::-1])
    path.with_name("new").replace(path)


EDITS = {"edit": _edit, "delete": Path.unlink, "folder": _folder, "link": _link, "replace": _replace}
PLACES = (
    MODEL,
    "modelica/Plant/Ladder/package.order",
    "modelica/Plant/Ladder/Resources/step.txt",
    "modelica/Plant/package.mo",
    "modelica/Plant/package.order",
    ".urdfsync/robots/ladder.toml",
    ".urdfsync/robots/ladder.json",
)


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_every_change_of_an_output_is_seen(bench: Bench, edit: Callable[[Path], None]) -> None:
    for age in (0, AGE):
        time.sleep(age)
        assert bench.changes() is None
        for name in PLACES:
            path = bench.project / name
            content = path.read_bytes()
            edit(path)
            assert bench.has_changed_at(name)
            assert bench.has_changed_at("modelica", ".urdfsync"), "events of folders"
            assert bench.changes() == {name}
            _remove(path)
            path.write_bytes(content)
            assert not bench.has_changed_at(name), "what was put back"
            bench.ladder.rest()


def test_a_file_that_the_build_saw_missing_comes_back(bench: Bench) -> None:
    """The class has become a folder, which is as the user wants it."""
    model, folder = bench.project / MODEL, (bench.project / MODEL).with_suffix("")
    folder.mkdir()
    model.rename(folder / "package.mo")
    bench.build()
    assert not bench.has_changed_at(MODEL)
    assert bench.changes() is None
    model.write_text("")
    assert bench.has_changed_at(MODEL)
    assert bench.changes() == {MODEL}


def test_saves_right_after_the_build_has_looked(bench: Bench) -> None:
    """In the same tick of the clock, and of the same size, they leave all that the system says of a file."""
    path = bench.project / MODEL
    for number in range(10):
        with path.open("r+") as file:
            file.write("//a" if number % 2 else "//b")
        bench.build()
        with path.open("r+") as file:
            file.write("//b" if number % 2 else "//a")
        assert bench.has_changed_at(MODEL)
        assert bench.changes() == {MODEL}


def test_a_failed_build_leaves_things_as_they_are_then(bench: Bench) -> None:
    _folder(bench.project / MODEL)
    assert bench.build()[0].failed
    assert not bench.has_changed_at(MODEL)
    assert bench.changes() is None
    (bench.project / MODEL).rmdir()
    assert bench.has_changed_at(MODEL)


def test_a_robot_that_is_watched_no_more_is_forgotten(bench: Bench) -> None:
    settings = bench.project / "urdfsync.toml"
    shutil.copy(bench.project / "ladder.json", bench.project / "second.json")
    settings.write_text(ROBOT.format("ladder", "Ladder") + ROBOT.format("second", "Second"))
    bench.load()
    bench.build()
    assert bench.cache.states("ladder").keys() != bench.cache.states("second").keys()
    settings.write_text(ROBOT.format("second", "Second"))
    bench.load()
    assert not bench.cache.states("ladder")
    assert bench.cache.states("second")
