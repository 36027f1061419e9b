"""Outputs as builds saw them: what of that is news when an event tells of it, and what a rescan finds by itself."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec
import pytest

from urdfsync import config
from urdfsync.config import RobotConfig
from urdfsync.engine import build as engine_build
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import Plan, plan_robot
from urdfsync.files import Tree
from urdfsync.watching import events
from urdfsync.watching.builds import Builds
from urdfsync.watching.robots import Robots, Watched
from urdfsync.watching.settling import Times

ROBOT = '[robots.{0}]\nsource = "{0}.json"\npackage = "Plant.{1}"\ndomain = "rcnetwork"\n'
MODEL = "modelica/Plant/Ladder/Elements/R2.mo"
AGE = 0.06
"""Seconds after which a file is old enough to be trusted."""


class Bench:
    """Robots and builds of a project, as the daemon has them, without events and settling."""

    def __init__(self, project: Path) -> None:
        self.project, self.memory = project, Cache()
        self.robots = Robots(Times(0, 0), (), self.memory)
        self.told: list[events.Event] = []
        self.touched: list[Watched] = []
        self.load()
        self.builds = Builds(
            self.robots,
            BuildOptions(cache=self.memory),
            self.told.append,
            self.touched.append,
            arm=lambda: None,
            ran=lambda robot, files: None,
            done=lambda robot: None,
            pauses=lambda: False,
        )

    def load(self) -> None:
        """Read the configuration."""
        self.config = config.load(self.project / "urdfsync.toml")
        self.robots.load(self.config, self.config.robots)

    @property
    def ladder(self) -> Watched:
        """The first robot."""
        return next(iter(self.robots))

    def build(self) -> Sequence[events.Event]:
        """Build all robots; returns what is told of that."""
        for watched in self.robots:
            watched.settled = self.robots.sample(watched)
        since = len(self.told)
        self.builds.build(self.config, list(self.robots))
        return self.told[since:]

    def has_news(self, *names: str) -> bool:
        """Whether events of these paths tell anything."""
        return self.robots.has_news(self.ladder, {str(self.project / name) for name in names})

    def finds_changes(self) -> set[str] | None:
        """What a rescan finds by itself: the outputs that are not as they were; None if all is."""
        if self.robots.confirm(self.ladder, self.robots.sample(self.ladder)):
            return None
        return {os.path.relpath(path, self.project) for path in self.ladder.noticed}

    def outputs(self) -> set[str]:
        """The names of all outputs that are there."""
        return {os.path.relpath(path, self.project) for path in self.ladder.scope.outputs if Path(path).exists()}


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
    assert [type(event) for event in bench.build()] == [events.Built]
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
    assert bench.robots.is_known(bench.ladder)
    assert not bench.has_news(*bench.outputs())
    assert not bench.has_news("modelica", "modelica/Plant/Ladder", ".urdfsync")
    assert bench.finds_changes() is None
    assert bench.build() == []
    assert bench.touched == []


def test_what_robots_are_built_from_is_sampled_and_of_outputs_only_what_is_noticed(bench: Bench) -> None:
    inputs = {str(bench.project / name) for name in ("ladder.json", "step.csv")}
    assert bench.robots.sample(bench.ladder).keys() == inputs
    assert bench.ladder.noticed == frozenset()
    bench.ladder.notice({str(bench.project / name) for name in (MODEL, "ladder.json")})
    assert bench.ladder.noticed == {str(bench.project / MODEL)}
    bench.ladder.notice({str(bench.project / "modelica")})
    assert bench.ladder.noticed == bench.ladder.scope.outputs
    bench.ladder.rest()
    assert bench.ladder.noticed == frozenset()


def test_an_output_that_is_being_written_has_not_settled(bench: Bench) -> None:
    path = bench.project / MODEL
    bench.ladder.notice({str(path)})
    looks = [bench.robots.outputs(bench.ladder, bench.ladder.noticed)]
    for text in ("// half", "// half and half"):
        path.write_text(text)
        looks.append(bench.robots.outputs(bench.ladder, bench.ladder.noticed))
    assert looks[0] != looks[1] != looks[2]
    assert looks[2] == bench.robots.outputs(bench.ladder, bench.ladder.noticed)


def test_files_are_read_once_until_they_change(bench: Bench, read: list[str]) -> None:
    time.sleep(AGE)
    assert bench.finds_changes() is None
    assert len(read) > 10
    read.clear()
    assert bench.finds_changes() is None
    assert not bench.has_news(*bench.outputs())
    assert read == []
    (bench.project / MODEL).touch()
    assert not bench.has_news(MODEL)
    assert read == [str(bench.project / MODEL)]
    bench.robots.rehash_all()
    assert bench.finds_changes() is None
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
        assert bench.finds_changes() is None
        for name in PLACES:
            path = bench.project / name
            content = path.read_bytes()
            edit(path)
            assert bench.has_news(name)
            assert bench.has_news("modelica", ".urdfsync"), "events of folders"
            assert bench.finds_changes() == {name}
            _remove(path)
            path.write_bytes(content)
            assert not bench.has_news(name), "what was put back"
            bench.ladder.rest()


def test_a_file_that_the_build_saw_missing_comes_back(bench: Bench) -> None:
    """The class has become a folder, which is as the user wants it."""
    model, folder = bench.project / MODEL, (bench.project / MODEL).with_suffix("")
    folder.mkdir()
    model.rename(folder / "package.mo")
    bench.build()
    assert not bench.has_news(MODEL)
    assert bench.finds_changes() is None
    model.write_text("")
    assert bench.has_news(MODEL)
    assert bench.finds_changes() == {MODEL}


def test_a_package_that_goes_as_a_whole_and_comes_back(bench: Bench) -> None:
    package = bench.project / "modelica/Plant/Ladder"
    files = {name for name in bench.outputs() if "Ladder/" in name}
    package.rename(bench.project / "aside")
    assert bench.has_news("modelica/Plant/Ladder")
    assert bench.finds_changes() == files
    (bench.project / "aside").rename(package)
    assert not bench.has_news("modelica/Plant/Ladder")


def test_saves_right_after_the_build_has_looked(bench: Bench) -> None:
    """In the same tick of the clock, and of the same size, they leave all that the system says of a file."""
    path = bench.project / MODEL
    for number in range(10):
        with path.open("r+") as file:
            file.write("//a" if number % 2 else "//b")
        bench.build()
        with path.open("r+") as file:
            file.write("//b" if number % 2 else "//a")
        assert bench.has_news(MODEL)
        assert bench.finds_changes() == {MODEL}


def test_a_build_that_only_records_something_is_made_sure_of_as_well(bench: Bench) -> None:
    manifest, source = bench.project / ".urdfsync/robots/ladder.toml", bench.project / "ladder.json"
    before = manifest.read_bytes()
    source.write_text(source.read_text() + "\n")
    bench.build()
    assert manifest.read_bytes() != before
    assert not bench.has_news(".urdfsync/robots/ladder.toml")
    assert bench.finds_changes() is None


def test_a_failed_build_leaves_things_as_they_are_then(bench: Bench) -> None:
    _folder(bench.project / MODEL)
    assert [type(event) for event in bench.build()] == [events.Failed]
    assert not bench.has_news(MODEL)
    assert bench.finds_changes() is None
    (bench.project / MODEL).rmdir()
    assert bench.has_news(MODEL)


def test_a_robot_that_is_watched_no_more_is_forgotten(bench: Bench) -> None:
    settings = bench.project / "urdfsync.toml"
    shutil.copy(bench.project / "ladder.json", bench.project / "second.json")
    settings.write_text(ROBOT.format("ladder", "Ladder") + ROBOT.format("second", "Second"))
    bench.load()
    bench.build()
    assert bench.memory.states("ladder").keys() != bench.memory.states("second").keys()
    settings.write_text(ROBOT.format("second", "Second"))
    bench.load()
    assert not bench.memory.states("ladder")
    assert bench.memory.states("second")


def test_a_plan_of_another_process_is_made_sure_of_in_this_one(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it saw is not known here, and a build that writes nothing says nothing of itself."""
    plans = []

    def plan(loaded: config.Config, robot: RobotConfig, request: BuildOptions) -> Plan:
        plans.append(request.jobs)
        if request.jobs == 1:
            return plan_robot(loaded, robot, request)
        bench.memory.invalidate("ladder")
        return plan_robot(loaded, robot, msgspec.structs.replace(request, cache=None))

    monkeypatch.setattr(engine_build, "plan_robot", plan)
    bench.build()
    assert plans == [None, 1]
    assert bench.finds_changes() is None
