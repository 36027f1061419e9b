"""`status`, `build --check`, the hook and `build` give the same verdict on a package, and the verdict is right."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.replay import contents
from support.states import rewrite
from support.urdfs import ELBOW_ARM

from urdfsync import cli
from urdfsync.engine.package import generate

pytestmark = NEEDS_GIT

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'
PACKAGE = "modelica/Arm"
RECORD = f"{PACKAGE}/Links/ForeParameters.mo"
STATE = ".urdfsync/robots/arm.state"


class Verdict(NamedTuple):
    """The answers of each command: its exit code, and whether `in_step` of its JSON is true."""

    status: int
    check: int
    hook: int
    build: int
    in_step: bool
    """The common value in the documents of `status` and `build --check`."""
    wrote: bool
    """Whether the build has changed anything that git tracks."""


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Repository:
    """A robot, built and committed; the working folder is its top."""
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    Path("arm.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text(CONFIGURATION)
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    capsys.readouterr()
    return repository


@pytest.fixture
def verdict(repository: Repository, capsys: pytest.CaptureFixture[str]) -> Callable[[], Verdict]:
    """A function that commits all files, asks each command, and then builds."""

    def ask() -> Verdict:
        repository.commit()
        codes, said = list[int](), []
        for command in (["status", "--format=json"], ["build", "--check", "--format=json"]):
            capsys.readouterr()
            codes.append(cli.main(command))
            robots = json.loads(capsys.readouterr().out)["results"]
            said.append(all(robot["in_step"] for robot in robots))
        assert said[0] == said[1]
        hook = cli.main(["hook", "check"])
        assert repository.git("status", "--porcelain") == "", "nothing of this writes"
        build = cli.main(["build"])
        wrote = repository.git("status", "--porcelain") != ""
        return Verdict(codes[0], codes[1], hook, build, said[0], wrote)

    return ask


GREEN = Verdict(0, 0, 0, 0, in_step=True, wrote=False)
"""In step: nothing to write."""
RENEWED = Verdict(0, 0, 0, 0, in_step=True, wrote=True)
"""In step: a build renews only the recorded state."""
LATE = Verdict(1, 1, 1, 0, in_step=False, wrote=True)
"""Out of step: a build brings it in step."""


def source(old: str, new: str) -> None:
    edit("arm.urdf", old, new)


def extend() -> None:
    source("</robot>", "<drake:nothing_of_ours a='1'/></robot>")


def set_option_without_effect() -> None:
    edit("urdfsync.toml", CONFIGURATION, f"{CONFIGURATION}meshes = 'skip'\n")


def export_then_old_state() -> None:
    """A mass changes and is built; then an old recorded state is restored, as after a careless checkout."""
    old = Path(STATE).read_bytes()
    source("2.5", "2.75")
    assert cli.main(["build", "--quiet"]) == 0
    Path(STATE).write_bytes(old)


def type_what_the_export_brings() -> None:
    source("2.5", "2.75")
    edit(RECORD, "2.5", "2.75")


def comment() -> None:
    source("</robot>", "<!-- made by hand --></robot>")


PLAIN: dict[str, tuple[Callable[[], object], Verdict]] = {
    "an extension that is not modelled": (extend, GREEN),
    "an option without effect": (set_option_without_effect, GREEN),
    "new files with an old state": (export_then_old_state, RENEWED),
    "the user typed what the export brings": (type_what_the_export_brings, LATE),
    "a comment in the source": (comment, GREEN),
    "a deleted file": (lambda: Path(RECORD).unlink(), LATE),
    "a lost state": (lambda: Path(STATE).unlink(), RENEWED),
    "how git unites states": (lambda: Path(".urdfsync/.gitattributes").unlink(), RENEWED),
}


@pytest.mark.parametrize("case", PLAIN)
def test_plain_cases(verdict: Callable[[], Verdict], case: str) -> None:
    change, expected = PLAIN[case]
    change()
    assert verdict() == expected
    assert verdict() == GREEN


def test_what_writes_nothing_is_told_by_diff_until_the_next_write(
    repository: Repository, capsys: pytest.CaptureFixture[str]
) -> None:
    extend()
    for _ in range(2):
        assert cli.main(["build"]) == 0
        assert "unmodelled" not in capsys.readouterr().out
        assert cli.main(["diff"]) == 0
        assert "unmodelled" in capsys.readouterr().out
    source("2.5", "2.75")
    assert cli.main(["build"]) == 0
    capsys.readouterr()
    assert cli.main(["diff"]) == 0
    assert "unmodelled" not in capsys.readouterr().out


@pytest.mark.parametrize("change", [extend, set_option_without_effect])
def test_what_no_file_shows_renders_nothing(
    verdict: Callable[[], Verdict], monkeypatch: pytest.MonkeyPatch, change: Callable[[], object]
) -> None:
    change()
    monkeypatch.delattr(generate, "_render")
    assert verdict() == GREEN


def test_options_that_are_known_no_more_may_have_had_an_effect(verdict: Callable[[], Verdict]) -> None:
    before = contents(Path(PACKAGE))
    edit("urdfsync.toml", CONFIGURATION, f'{CONFIGURATION}base = "floating"\n')
    assert verdict() == LATE
    edit("urdfsync.toml", 'base = "floating"\n', "")
    rewrite(Path(STATE), options={"bases": "floating"})
    assert verdict() == LATE
    assert contents(Path(PACKAGE)) == before


def test_a_comment_in_a_template_writes_nothing(verdict: Callable[[], Verdict]) -> None:
    edit("urdfsync.toml", CONFIGURATION, f'{CONFIGURATION}templates = "own"\n')
    own = Path("own/link/record.mo.jinja")
    own.parent.mkdir(parents=True)
    installed = Path(__file__).parents[1] / "templates/urdf/link/record.mo.jinja"
    shutil.copy(installed, own)
    assert verdict() == GREEN
    own.write_text("<# a comment #>" + own.read_text())
    assert verdict() == GREEN
