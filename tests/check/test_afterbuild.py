"""The check after a build: when it is made, what is remembered of it, and what becomes of the build's result."""

from __future__ import annotations

import errno
import importlib.util
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest

from urdfsync import cli, config
from urdfsync.check import afterbuild
from urdfsync.check import run as check_run
from urdfsync.check.compilers.compiler import CompilerError
from urdfsync.check.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Exit, Result, exit_code

RIGHT = CheckResult("ladder", "Ladder", compiled=(CompiledModel("Ladder", 12, 3),), seconds=2.5)
BROKEN = Diagnostic(Severity.ERROR, "compile", "there is no class `Foo`", "modelica/Ladder/Elements/R2.mo", 3)
WRONG = CheckResult("ladder", "Ladder", diagnostics=(BROKEN,))
SYNTAX = CheckResult("ladder", "Ladder", unchecked=("nothing was compiled, since there is no library",))
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
        patch.setattr(check_run, "check_robots", examiner)
        return list(afterbuild.with_checks(loaded, request, build(loaded, loaded.robots, request)))


def notes(project: Path) -> list[Path]:
    return sorted((project.parent / "cache" / "results").glob("*.json"))


def test_a_package_is_checked_after_each_build_until_it_is_right(project: Path) -> None:
    examiner = Examiner(WRONG, WRONG, RIGHT, WRONG)
    for diagnostics, checked, code in (((BROKEN,), Checked.WRONG, Exit.ERROR), ((), Checked.RIGHT, Exit.IN_STEP)):
        for _ in range(2):
            (result,) = run(examiner)
            assert (result.diagnostics, result.checked, exit_code([result])) == (diagnostics, checked, code)
            assert not result.failed
    assert len(examiner.asked) == 3
    assert [result.checked for result in run(examiner, full=True)] == [Checked.WRONG]
    assert notes(project) == [], "what is wrong is not taken for what was right before"


def write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


@pytest.mark.parametrize(("changed", "added"), [
    (MODEL, "// mine\n"),
    ("modelica/Ladder/package.order", "Mine\n"),
    ("libraries/Complex 4.1.0/Mine.mo", "// a new file\n"),
    ("path/Tanks.mo", "// used by a library that is used\n"),
    ("path/Pumps", None),
])  # fmt: skip
def test_it_is_checked_again_when_something_matters_that_a_build_does_not_see(
    project: Path, changed: str, added: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    add(project, '[check]\nlibrary = "libraries"\n')
    for name in ("Modelica", "ModelicaServices", "Complex"):
        write(project / "libraries" / f"{name} 4.1.0" / "package.mo", f"package {name} end {name};\n")
    write(project / "path" / "Pumps" / "package.mo", "package Pumps\n  import Tanks;\nend Pumps;\n")
    write(project / "path" / "Tanks.mo", "package Tanks\nend Tanks;\n")
    write(project / "path" / "Unused.mo", "package Unused\nend Unused;\n")
    monkeypatch.setenv("MODELICAPATH", str(project / "path"))
    run(Examiner(RIGHT))
    write(project / MODEL, (project / MODEL).read_text().replace("end R2;", "  Pumps.Small p;\nend R2;"))
    examiner = Examiner(RIGHT)
    run(examiner)
    if added is None:
        shutil.rmtree(project / changed)
    else:
        with (project / changed).open("a") as file:
            file.write(added)
    run(examiner)
    run(examiner)
    assert examiner.asked == ["ladder"] * 2


@pytest.mark.parametrize("name", ["rumoca", "urdfsync"])
def test_it_is_checked_again_with_another_tool_and_by_a_full_build(
    project: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    examiner = Examiner(RIGHT)
    run(examiner)
    if name == "urdfsync":
        monkeypatch.setattr(afterbuild, "__version__", "99")
    else:
        monkeypatch.setattr("urdfsync.check.compilers.installed_version", lambda *_: "99")
    run(examiner)
    run(examiner, full=True)
    assert examiner.asked == ["ladder"] * 3


def test_what_is_remembered_may_be_lost_and_is_no_part_of_the_project(project: Path) -> None:
    examiner = Examiner(RIGHT)
    for count, content in enumerate([b"", b"\xff", b"[]", b'{"key": "0"}'], start=1):
        run(examiner)
        (note,) = notes(project)
        assert examiner.asked == ["ladder"] * count
        note.write_bytes(content)
    assert not (project / ".urdfsync" / "checked").exists()


def test_a_check_is_not_remembered_if_somebody_saves_meanwhile(project: Path) -> None:
    class Saving(Examiner):
        def __call__(self, *arguments: Any) -> Iterator[CheckResult]:
            write(project / MODEL, (project / MODEL).read_text() + "// mine\n")
            return super().__call__(*arguments)

    examiner = Saving(RIGHT)
    run(examiner)
    run(examiner)
    assert len(examiner.asked) == 2


@pytest.mark.parametrize("error", [OutputError(BROKEN), PermissionError(errno.EACCES, "Permission denied", "x.mo")])
def test_a_check_that_fails_is_an_error_of_its_robot(project: Path, error: Exception) -> None:
    (result,) = run(Examiner(error))
    assert result.checked is Checked.WRONG
    (found,) = result.diagnostics
    assert str(found) in (str(BROKEN), "x.mo: error: Permission denied [system]")


def test_what_could_not_be_checked_is_said_once_for_all_robots_and_at_each_build(project: Path) -> None:
    add(project, OTHER)
    examiner = Examiner(SYNTAX)
    for _ in range(2):
        ladder, other = run(examiner)
        assert ladder.checked is other.checked is Checked.INCOMPLETE
        assert [str(found) for found in (*ladder.diagnostics, *other.diagnostics)] == [
            "warning: nothing was compiled, since there is no library [not-checked]"
        ]
        assert exit_code([ladder, other]) is Exit.IN_STEP
    assert examiner.asked == ["ladder", "other"]


NO_COMPILER = Diagnostic(Severity.ERROR, "no-compiler", "there is no compiler", hint="install it")


@pytest.mark.parametrize(("way", "checked"), [
    (CompilerError(NO_COMPILER), Checked.UNCHECKED),
    (CheckResult("ladder", "Ladder", diagnostics=(NO_COMPILER,)), Checked.INCOMPLETE),
])  # fmt: skip
def test_a_machine_without_a_compiler_is_a_warning_and_no_fault(project: Path, way: Any, checked: Checked) -> None:
    (result,) = run(Examiner(way))
    assert result.checked is checked
    assert result.diagnostics == (msgspec.structs.replace(NO_COMPILER, severity=Severity.WARNING),)
    assert run(Examiner(way))[0].diagnostics == result.diagnostics, "it is said at each build"


def test_what_keeps_one_package_from_being_checked_keeps_all(project: Path) -> None:
    add(project, OTHER)
    examiner = Examiner(RIGHT, OutputError(BROKEN))
    ladder, other = run(examiner)
    assert (ladder.checked, other.checked) == (Checked.RIGHT, Checked.WRONG)
    assert other.diagnostics == (BROKEN,)
    without = run(Examiner(CompilerError(NO_COMPILER)), full=True)
    assert [result.checked for result in without] == [Checked.UNCHECKED] * 2


def test_without_the_extra_the_real_check_says_what_to_install(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "rumoca" else find(name))
    assert cli.main(["build"]) == 0
    streams = capsys.readouterr()
    assert streams.out.splitlines()[0].endswith("files written; not checked")
    assert "warning: there is no compiler: " in streams.err
    assert "pip install rumoca" in streams.err


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
    monkeypatch.setattr(check_run, "check_robots", Examiner(WRONG))
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
    monkeypatch.setattr(check_run, "check_robots", Examiner(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        told.extend(afterbuild.with_checks(loaded, request, results))
    assert names(told) == ["ladder"]
    assert told[0].checked is None


def test_people_see_what_a_check_said(
    project: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(check_run, "check_robots", Examiner(WRONG, RIGHT))
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
