"""The check after a build: when it is made, what is remembered of it, and what becomes of the build's result."""

from __future__ import annotations

import errno
import importlib.util
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.checks import Compiling, thread_workers

from urdfsync.analysis.checks import run as check_run
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Exit, Result, exit_code
from urdfsync.project import config
from urdfsync.project.config import Config, RobotConfig

RIGHT = CheckResult("ladder", "Ladder", compiled=(CompiledModel("Ladder", 12),), seconds=2.5)
BROKEN = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", "modelica/Ladder/Elements/R2.mo", 3)
WRONG = CheckResult("ladder", "Ladder", diagnostics=(BROKEN,))
OTHER = '[robots.other]\nsource = "ladder.json"\npackage = "Other"\ndomain = "rcnetwork"\non_build = "check"\n'
MODEL = "modelica/Ladder/Elements/R2.mo"


class Examiner:
    """Gives one verdict after the other, the last one again and again, and knows what it was asked for."""

    def __init__(self, *verdicts: CheckResult | BaseException) -> None:
        self.asked: list[str] = []
        self._verdicts = list(verdicts)

    def __call__(
        self, config: Config, robots: Sequence[RobotConfig], options: CheckOptions, tell: Progress
    ) -> Iterator[CheckResult]:
        for count, robot in enumerate(robots):
            self.asked.append(robot.name)
            tell(f"{robot.name}: compiling", count, len(robots))
            verdict = self._verdicts.pop(0) if len(self._verdicts) > 1 else self._verdicts[0]
            if isinstance(verdict, BaseException):
                raise verdict
            yield verdict


@pytest.fixture
def project(project: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project with a check after each build, and a cache of its own."""
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: project.parent / "cache")
    add(project, 'on_build = "check"\n')
    return project


def add(project: Path, text: str) -> None:
    with (project / "urdfsync.toml").open("a") as file:
        file.write(text)


def run(examiner: Examiner, **wishes: Any) -> list[Result]:
    """Build and check all robots."""
    loaded, request = config.load(Path("urdfsync.toml")), BuildOptions(wait=1, **wishes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(check_run, "_check_in_workers", examiner)
        return list(check_run.check_builds(loaded, request, build(loaded, loaded.robots, request)))


@pytest.fixture
def compiling(project: Path, monkeypatch: pytest.MonkeyPatch) -> Compiling:
    """Checks in this process, with a stand-in for the compiler."""
    found = Compiling()
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", found)
    monkeypatch.setattr("urdfsync.common.processes.workers.workers", thread_workers)
    return found


def build_all(**wishes: Any) -> list[Result]:
    """Build all robots, and check them as it is really done."""
    loaded, request = config.load(Path("urdfsync.toml")), BuildOptions(wait=1, **wishes)
    return list(check_run.check_builds(loaded, request, build(loaded, loaded.robots, request)))


def write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


@pytest.mark.parametrize("error", [OutputError(BROKEN), PermissionError(errno.EACCES, "Permission denied", "x.mo")])
def test_a_check_that_fails_is_an_error_of_its_robot(project: Path, error: Exception) -> None:
    (result,) = run(Examiner(error))
    assert result.checked is Checked.WRONG
    (found,) = result.diagnostics
    assert str(found) in (str(BROKEN), "x.mo: error: Permission denied [system]")


@pytest.mark.slow
def test_a_package_is_checked_after_each_build_until_it_is_right(
    project: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch, compiling: Compiling
) -> None:
    """What the machine lacks would be said again."""
    compiling.problem = "unknown"
    codes = {Checked.WRONG: Exit.ERROR, Checked.RIGHT: Exit.IN_STEP}
    for checked, is_known in [(Checked.WRONG, False)] * 2 + [(Checked.RIGHT, False), (Checked.RIGHT, True)]:
        if checked is Checked.RIGHT:
            compiling.problem = ""
        models = len(compiling.models)
        (result,) = build_all()
        assert (result.checked, exit_code([result])) == (checked, codes[checked])
        assert (len(compiling.models) == models) == is_known
    compiling.problem = "unknown"
    (result,) = build_all(full=True)
    assert result.checked is Checked.WRONG
    assert [one.checked for one in build_all()] == [Checked.WRONG], "what is wrong was right before"


@pytest.mark.slow
def test_what_could_not_be_checked_is_said_once_for_all_robots_and_at_each_build(
    project: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch, compiling: Compiling
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "rumoca" else find(name))
    add(project, OTHER)
    for _ in range(2):
        ladder, other = build_all()
        assert ladder.checked is other.checked is Checked.INCOMPLETE
        (said,) = (*ladder.diagnostics, *other.diagnostics)
        assert str(said).startswith("warning: nothing was compiled: there is no compiler: rumoca is not installed; pip")
        assert exit_code([ladder, other]) is Exit.IN_STEP


@pytest.mark.parametrize(("facts", "checked"), [
    ({"gaps": ("no library",)}, Checked.INCOMPLETE),
    ({"gaps": ("your models were not compiled",), "compiled": RIGHT.compiled}, Checked.INCOMPLETE),
    ({"compiled": RIGHT.compiled, "unchecked": ("poses",)}, Checked.RIGHT),
])  # fmt: skip
def test_a_gap_keeps_a_package_from_being_right(facts: dict[str, Any], checked: Checked) -> None:
    found, diagnostics = check_run.verdict(CheckResult("ladder", "Ladder", **facts))
    assert (found, [one.message for one in diagnostics]) == (checked, [*facts.get("gaps", ())])


def test_what_keeps_one_package_from_being_checked_keeps_all(project: Path) -> None:
    add(project, OTHER + OTHER.replace("other", "third").replace("Other", "Third"))
    ladder, *others = run(Examiner(RIGHT, OutputError(BROKEN)))
    assert [ladder.checked, *(one.checked for one in others)] == [Checked.RIGHT, Checked.WRONG, Checked.WRONG]
    assert others[0].diagnostics == (BROKEN,)


def test_failed_and_dry_builds_are_not_checked(project: Path) -> None:
    examiner = Examiner(RIGHT)
    assert [result.checked for result in run(examiner, dry=True)] == [None]
    (project / "ladder.json").write_text("{")
    assert [result.checked for result in run(examiner)] == [None]
    assert examiner.asked == []


def test_a_package_with_a_conflict_is_checked_as_it_is_on_disk_and_again_once_it_is_resolved(
    project: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    run(Examiner(RIGHT))
    for file, value in (("modelica/Ladder/Elements/R2Parameters.mo", "221"), ("ladder.json", "330")):  # mine, theirs
        write(project / file, (project / file).read_text().replace("220.5", value))
    (result,) = run(Examiner(RIGHT))
    assert result.conflicts
    assert result.checked is Checked.RIGHT
    assert exit_code([result]) is Exit.CONFLICT
    assert exit_code([msgspec.structs.replace(result, checked=Checked.WRONG)]) is Exit.ERROR
    monkeypatch.setattr(check_run, "_check_in_workers", Examiner(WRONG))
    capsys.readouterr()
    assert cli.main(["resolve", "--all", "--take", "--dry-run"]) == 0
    assert "checked" not in capsys.readouterr().out
    assert cli.main(["resolve", "--all", "--take"]) == 2
    assert "checked: 1 error" in capsys.readouterr().out


def names(results: Sequence[Result]) -> list[str]:
    return [result.robot for result in results]


def test_results_keep_their_order_and_the_lock_is_free_while_packages_are_checked(project: Path) -> None:
    text = '[robots.{0}]\nsource = "ladder.json"\npackage = "{1}"\ndomain = "rcnetwork"\n{2}'
    add(project, text.format("plain", "Plain", "") + text.format("last", "Last", 'on_build = "check"\n'))

    class Building(Examiner):
        def __call__(
            self, config: Config, robots: Sequence[RobotConfig], options: CheckOptions, tell: Progress
        ) -> Iterator[CheckResult]:
            again = BuildOptions(wait=0)
            write(project / "ladder.json", (project / "ladder.json").read_text().replace("220.5", "330"))
            assert not any(result.locked for result in build(config, config.robots, again))
            return super().__call__(config, robots, options, tell)

    examiner = Building(RIGHT)
    assert names(run(examiner)) == ["ladder", "plain", "last"]
    assert examiner.asked == ["ladder", "last"]


def test_who_interrupts_a_check_is_told_what_was_built(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded, request = config.load(Path("urdfsync.toml")), BuildOptions(wait=1)
    told: list[Result] = []
    results = build(loaded, loaded.robots, request)
    monkeypatch.setattr(check_run, "_check_in_workers", Examiner(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        told.extend(check_run.check_builds(loaded, request, results))
    assert names(told) == ["ladder"]
    assert told[0].checked is None


def test_people_see_what_a_check_said(
    project: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(check_run, "_check_in_workers", Examiner(WRONG, RIGHT))
    assert cli.main(["build"]) == 2
    streams = capsys.readouterr()
    assert streams.err.splitlines() == [f"{MODEL}:3: error: there is no class `Foo` [compile]"]
    assert streams.out.splitlines()[0].endswith("files written; checked: 1 error")
    for _ in range(2):
        assert cli.main(["build"]) == 0
        streams = capsys.readouterr()
        assert streams.out.splitlines()[0].endswith("in step, 14 files; checked: compiles")
    assert cli.main(["build", "--check"]) == 0
    assert "checked" not in capsys.readouterr().out
