"""Verdicts where a text is no scenario: what no file shows renders nothing, and options of another program.

`tests/scenarios/verdicts.txt` has what users do, and the verdict of each command.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.replay import contents
from support.states import rewrite
from support.urdfs import ELBOW_ARM

from urdfsync.engine.package import generate

pytestmark = NEEDS_GIT

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


@pytest.fixture
def arm(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """A robot, built and committed; the working folder is its top."""
    repository = Repository(folder, monkeypatch)
    Path("arm.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text(CONFIGURATION)
    execute("build", "--quiet")
    repository.commit()
    return repository


def assert_verdict(repository: Repository, execute: Execute, *, in_step: bool) -> None:
    """All commands have this verdict, and a build writes only if the package is out of step."""
    repository.commit()
    for command in ("status", "build --check", "hook check"):
        execute(*command.split(), code=int(not in_step))
    execute("build")
    assert (repository.git("status", "--porcelain") == "") is in_step


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("arm.urdf", "</robot>", "<drake:nothing_of_ours a='1'/></robot>"),
        ("urdfsync.toml", CONFIGURATION, f"{CONFIGURATION}meshes = 'skip'\n"),
    ],
)
def test_what_no_file_shows_renders_nothing(
    arm: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str
) -> None:
    edit(file, old, new)
    monkeypatch.delattr(generate, "_render")
    assert_verdict(arm, execute, in_step=True)


def test_options_that_are_known_no_more_may_have_had_an_effect(arm: Repository, execute: Execute) -> None:
    before = contents(Path("modelica/Arm"))
    edit("urdfsync.toml", CONFIGURATION, f'{CONFIGURATION}base = "floating"\n')
    assert_verdict(arm, execute, in_step=False)
    edit("urdfsync.toml", 'base = "floating"\n', "")
    rewrite(Path(".urdfsync/robots/arm.state"), options={"bases": "floating"})
    assert_verdict(arm, execute, in_step=False)
    assert contents(Path("modelica/Arm")) == before
