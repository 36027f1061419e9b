"""`urdfsync check` as people type it: what reaches the checker, exit codes, the cache."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest

from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, EditEffect
from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain.experiment import Deviation, Quantity
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

Capture = pytest.CaptureFixture[str]

RIGHT = CheckResult("ladder", "Ladder")
CHANGED = Deviation(Quantity.EFFORT, "R2", 1.0, 10.0, 10.0, "A")
EDITED = msgspec.structs.replace(RIGHT, effects=(EditEffect(("Elements/R2.mo",), (CHANGED,)),))
INCOMPLETE = msgspec.structs.replace(RIGHT, gaps=("nothing was compiled: there is no library",))
WRONG = msgspec.structs.replace(RIGHT, deviations=(CHANGED,))
FAILED = msgspec.structs.replace(
    RIGHT, diagnostics=(Diagnostic(Severity.ERROR, "no-compiler", "there is no compiler"),)
)


class Checker:
    """Stands in for the checker: one result for each robot, and it remembers the options."""

    def __init__(self) -> None:
        self.result = RIGHT
        self.options = CheckOptions()
        self.robots: list[str] = []

    def check(
        self, config: Config, robots: Sequence[RobotConfig], options: CheckOptions, progress: Progress
    ) -> Iterator[CheckResult]:
        self.options = options
        for robot in robots:
            self.robots.append(robot.name)
            progress(f"{robot.name}: compiling", 0, len(robots))
            yield msgspec.structs.replace(self.result, robot=robot.name, strict=options.strict)


@pytest.fixture
def checker(project: Path, monkeypatch: pytest.MonkeyPatch) -> Checker:
    found = Checker()
    monkeypatch.setattr("urdfsync.commands.check.check_robots", found.check)
    return found


def test_without_options_everything_is_as_documented(checker: Checker, capsys: Capture) -> None:
    assert cli.main(["check"]) == 0
    assert checker.robots == ["ladder"]
    assert checker.options == CheckOptions(package_paths=checker.options.package_paths)
    printed = capsys.readouterr()
    assert printed.out == "ladder: right: syntax and layout; 0.0 s\n"
    assert printed.err == "ladder: compiling\n", "a pipe shows no progress, so the long step is told"


def test_all_options_reach_the_checker(checker: Checker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    limits = ["--jobs", "3", "--timeout", "12.5", "--memory", "4", "--wait", "7"]
    assert cli.main(["check", "ladder", "--physics", "--strict", "--tool", "omc", *limits]) == 0
    chosen = CheckOptions(physics=True, strict=True, tools=(Tool("omc"),), jobs=3, package_paths=(tmp_path,))
    assert checker.options == msgspec.structs.replace(chosen, timeout=12.5, memory=4.0, wait=7.0)


def test_a_compiler_has_its_title_as_well(checker: Checker) -> None:
    assert cli.main(["check", "--tool", "both"]) == 0
    assert checker.options.tools == (Tool("rumoca"), Tool("omc"))
    assert cli.main(["check", "--tool", "openmodelica"]) == 0
    assert checker.options == msgspec.structs.replace(checker.options, tools=(Tool("omc"),))


def test_robots_are_chosen_by_name(checker: Checker, project: Path, capsys: Capture) -> None:
    with (project / "urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "ladder.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    assert cli.main(["check", "other"]) == 0
    assert checker.robots == ["other"]
    assert cli.main(["check"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "2 robots: 2 right"
    assert cli.main(["check", "nobody"]) == 2
    assert "nobody" in capsys.readouterr().err


@pytest.mark.parametrize(("result", "arguments", "code"), [
    (RIGHT, [], 0),
    (EDITED, [], 0),
    (EDITED, ["--strict"], 1),
    (WRONG, [], 1),
    (msgspec.structs.replace(RIGHT, in_step=False), [], 1),
    (msgspec.structs.replace(RIGHT, in_step=False, built=False), [], 1),
    (INCOMPLETE, [], 0),
    (INCOMPLETE, ["--strict"], 1),
    (FAILED, [], 2),
])  # fmt: skip
def test_exit_codes(checker: Checker, result: CheckResult, arguments: list[str], code: int) -> None:
    checker.result = result
    assert cli.main(["check", *arguments]) == code
    assert cli.main(["check", "--quiet", "--format=json", *arguments]) == code


def test_an_interruption_leaves_what_was_found(
    checker: Checker, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    def interrupted(*_: Any) -> Iterator[CheckResult]:
        yield RIGHT
        raise KeyboardInterrupt

    monkeypatch.setattr("urdfsync.commands.check.check_robots", interrupted)
    assert cli.main(["check"]) == 130
    streams = capsys.readouterr()
    assert streams.out.startswith("ladder: right")
    assert "[interrupted]" in streams.err


BAD = "--jobs 0; --timeout 0; --timeout soon; --memory inf; --memory nan; --tool dymola"


@pytest.mark.parametrize("arguments", [words.split() for words in BAD.split(";")], ids=" ".join)
def test_bad_usage(checker: Checker, capsys: Capture, arguments: list[str]) -> None:
    assert cli.main(["check", *arguments]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert "[usage]" in streams.err
    assert checker.robots == []
