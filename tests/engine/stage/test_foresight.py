"""After a build that wrote files, what is remembered is what the next plan says: most robots are not planned again."""

from __future__ import annotations

import contextlib
import io
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any
from unittest import mock

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import edits, mutations, networks, robots
from support.cases import often
from support.meshes import stl
from support.networks import C1, LADDER, R1, RECORD, configure, edit, resistor, run

from urdfsync import cli, config
from urdfsync.config import RobotConfig
from urdfsync.dependencies import facts
from urdfsync.dependencies.facts import Entry, Facts
from urdfsync.engine import remembered
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.result import Result
from urdfsync.state.transaction import Applied, Transactions

Change = Callable[[], object]
R2_RECORD, C1_RECORD = (f"{LADDER}/Elements/{name}Parameters.mo" for name in ("R2", "C1"))


def plan_counted() -> tuple[Result, int]:
    """The result of a dry run, and how often it made a plan."""
    with mock.patch("urdfsync.engine.build.plan_robot", wraps=plan_robot) as plan:
        return run(dry=True), plan.call_count


@contextlib.contextmanager
def nothing_remembered() -> Iterator[None]:
    with mock.patch.object(remembered, "recall", return_value=None), mock.patch.object(remembered, "remember"):
        yield


def mine(path: str, text: str = "// mine\n") -> None:
    with Path(path).open("a") as file:
        file.write(text)


def do(*steps: Change) -> Change:
    return lambda: [step() for step in steps]


MERGING: Change = lambda: configure('on_conflict = "merge"\n')  # noqa: E731
FORESEEN: dict[str, Change] = {
    "nothing": lambda: None,
    "another number": lambda: resistor(120),
    "a new element": lambda: networks.add_resistor("R9"),
    "an element less": lambda: networks.drop("C2"),
    "a renamed element": lambda: networks.rename("C2", "C8"),
    "a deleted file": lambda: Path(R1).unlink(),
    "an edit that stays": do(lambda: mine(R1), lambda: resistor(120)),
    "an edit that is merged": do(MERGING, lambda: mine(RECORD), lambda: resistor(120)),
    "an edit that moves": do(MERGING, lambda: mine(C1), lambda: networks.rename("C1", "C8")),
    "an edit of an element that is gone": do(lambda: mine(C1_RECORD), lambda: networks.drop("C1")),
    "an edit that has the change already": do(lambda: resistor(120), lambda: edit(RECORD, "100", "120")),
    "a class of the user's": lambda: Path(LADDER, "Own.mo").write_text("within Ladder;\nmodel Own\nend Own;\n"),
    "a line of the user's": lambda: mine(f"{LADDER}/package.order", "Own\n"),
}


@pytest.mark.parametrize("name", FORESEEN)
def test_a_build_that_writes_foresees_the_next_plan(project: Path, name: str) -> None:
    run()
    FORESEEN[name]()
    run()
    remembered_result, count = plan_counted()
    assert count == 0
    with nothing_remembered():
        planned = run(dry=True)
    assert msgspec.structs.replace(remembered_result, reads=planned.reads) == planned
    assert set(planned.reads.entries) <= set(remembered_result.reads.entries)


def recalled(site: Path) -> Iterator[tuple[RobotConfig, Result | None]]:
    """The robots of a project, and the results that are remembered."""
    loaded = config.load(site / "urdfsync.toml")
    keys, seen = remembered.RecordKeys(loaded, BuildOptions()), dict[Entry, Facts]()
    for robot in loaded.robots:
        found = remembered.recall(loaded, robot, keys.key(robot), seen)
        yield robot, Result.of(loaded, robot, found[0], dry=True, reads=found[1]) if found else None


@pytest.mark.parametrize("count", [3, pytest.param(8, marks=pytest.mark.slow)])
def test_each_of_many_robots_is_remembered_whatever_the_others_write(project: Path, count: int) -> None:
    """The packages are new folders beside each other; workers plan many robots before the first one is written."""
    for number in range(count):
        mine("urdfsync.toml", networks.ROBOT.format(f"more{number}", f"More{number}"))
    assert len(networks.run_all()) == count + 1
    assert all(result for _, result in recalled(project))


UNFORESEEN: dict[str, Change] = {
    "a conflict": do(lambda: mine(RECORD), lambda: resistor(120)),
    "a declared rename": do(lambda: networks.rename("C2", "C8"), lambda: configure('renamed = { C2 = "C8" }\n')),
    "another folder": lambda: networks.set_keys(package='"Steps"'),
}


@pytest.mark.parametrize("name", UNFORESEEN)
def test_where_the_next_plan_is_not_certain_it_is_made(project: Path, name: str) -> None:
    run()
    UNFORESEEN[name]()
    run()
    assert plan_counted()[1] == 1


WRITTEN: dict[str, Change] = {
    "another text": lambda: Path(RECORD).write_text("record R1Parameters end R1Parameters;"),
    "a file beside it": lambda: Path(LADDER, "Elements/Own.mo").write_text("model Own end Own;"),
    "a file in a new folder": lambda: Path(LADDER, "New").mkdir(),
    "a model of the user's": lambda: Path("Mine.mo").write_text("model Mine Ladder.Ladder a; end Mine;"),
}


@pytest.mark.parametrize("name", WRITTEN)
def test_what_somebody_saves_while_a_build_writes_is_seen_by_the_next_one(
    project: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    run()
    resistor(120)
    finish = Transactions.apply

    def apply(*arguments: Any) -> Applied:
        applied = finish(*arguments)
        WRITTEN[name]()
        return applied

    monkeypatch.setattr(Transactions, "apply", apply)
    run()
    assert plan_counted()[1] == 1


# Random histories


COMMANDS = (["build", "--check"], ["build", "--check", "--format", "json"], ["status"], ["diff", "--format", "json"])
CONFIG = """\
[robots.bot]
source = "bot.urdf"
package = "Bot"
{bot}
[robots.hand]
source = "hand/hand.urdf"
package = "Hand"
{hand}
"""
OPTIONS = ("", "", 'on_conflict = "merge"\n', 'approach = ["package", "record"]\n', 'base = "floating"\n')
MODEL = 'model {name} "Mine"\n  Bot.Bot bot(mine = {number});\n  Hand.Links.Links links;\nend {name};\n'
WEIGHTS = {"export": 5, "edit": 4, "build": 8, "model": 1, "mesh": 1, "copy": 1, "configure": 1}


class Site:
    """A project of two robots, which change at random."""

    def __init__(self, folder: Path, random: Random) -> None:
        self.folder, self.random, self.hand = folder, random, edits.Hand(random)
        self.versions = {name: mutations.version(random) for name in ("bot.urdf", "hand/hand.urdf")}
        (folder / "hand").mkdir()
        for name in self.versions:
            self.write(name)
        self.configure()

    def write(self, name: str) -> None:
        (self.folder / name).write_text(robots.urdf(self.versions[name].snapshot))

    def configure(self) -> None:
        choose = self.random.choice
        (self.folder / "urdfsync.toml").write_text(CONFIG.format(bot=choose(OPTIONS), hand=choose(OPTIONS)))

    def export(self) -> None:
        name = self.random.choice(list(self.versions))
        self.versions[name] = mutations.mutated(self.versions[name], self.random, self.random.randint(1, 3))
        self.write(name)

    def edit(self) -> None:
        if (package := self.package()).exists():
            self.hand.edit(package)

    def package(self) -> Path:
        return self.folder / "modelica" / self.random.choice(("Bot", "Hand"))

    def model(self) -> None:
        file = self.folder / "models" / f"Mine{self.random.randrange(3)}.mo"
        file.parent.mkdir(exist_ok=True)
        file.write_text(MODEL.format(name=file.stem, number=self.random.randrange(9)))

    def mesh(self) -> None:
        file = self.folder / "meshes" / self.random.choice(("a.stl", "b.stl"))
        file.parent.mkdir(exist_ok=True)
        file.write_text(stl() + "\n" * self.random.randrange(3))

    def copy(self) -> None:
        """A file gets the text of another one, is deleted, or is only touched."""
        files = sorted(path for path in (self.folder / "modelica").rglob("*") if path.is_file())
        files += sorted(path for path in (self.folder / ".urdfsync/robots").rglob("*") if path.is_file())
        if files:
            one, other = self.random.choice(files), self.random.choice(files)
            match self.random.randrange(3):
                case 0:
                    one.write_bytes(other.read_bytes())
                case 1:
                    one.unlink()
                case 2:
                    one.touch()

    def build(self) -> None:
        output(["build", "-q"])


def output(command: list[str]) -> tuple[int, str]:
    """The exit code of a command, and what goes to the standard output."""
    with contextlib.redirect_stdout(io.StringIO()) as output, contextlib.redirect_stderr(io.StringIO()):
        return cli.main(command), output.getvalue()


def check(site: Path) -> None:
    """Check that what is remembered is what a plan says, and depends on all that the plan reads."""
    loaded = config.load(site / "urdfsync.toml")
    for robot, known in recalled(site):
        if known is not None:
            with nothing_remembered():
                (planned,) = build(loaded, [robot], BuildOptions(dry=True))
            assert msgspec.structs.replace(known, reads=planned.reads) == planned
            assert set(planned.reads.entries) <= set(known.reads.entries)


@pytest.mark.slow
@often(6)
@given(st.integers(0, 2**32))
def test_what_is_remembered_is_what_the_next_plan_says(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    random = Random(seed)
    folder = tmp_path_factory.mktemp("site")
    with monkeypatch.context() as patch:
        patch.chdir(folder)
        patch.setattr(facts, "YOUNG", random.choice((0, 2_000_000_000)))
        site = Site(folder, random)
        for _ in range(10):
            (step,) = random.choices(list(WEIGHTS), list(WEIGHTS.values()))
            getattr(site, step)()
            if step == "build":
                check(folder)
                if random.random() < 0.2:
                    command = random.choice(COMMANDS)
                    said = output(command)
                    with nothing_remembered():
                        assert said == output(command)
    shutil.rmtree(folder)
