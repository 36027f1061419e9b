"""The hook passes by a saved answer as long as it would pass without."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from support import answers
from support.git import NEEDS_GIT, Repository

from urdfsync import hook

pytestmark = [NEEDS_GIT, pytest.mark.skipif(not hasattr(os, "posix_spawnp"), reason="only where a process is spawned")]

MODEL = "modelica/Leg/Links/Tip.mo"


@pytest.fixture
def repository(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A project in step, all of it committed, with a saved answer of the hook; the working folder."""
    shutil.copytree(in_step, tmp_path / "project")
    found = Repository(tmp_path / "project", monkeypatch)
    Path(found.folder / "notes.txt").write_text("notes\n")
    found.commit()
    monkeypatch.chdir(found.folder)
    _save()
    return found


def _save() -> None:
    end = time.monotonic() + answers.LIMIT
    while not hook._is_answered():
        assert hook._nothing_to_do()
        assert time.monotonic() < end, "no answer was saved"


def test_both_modes_pass_without_looking_further(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hook, "_nothing_to_do", None)
    assert hook.run(["check"]) == 0
    assert hook.run(["build"]) == 0


def _expect_no_save() -> None:
    """The full way passes, and saves no answer although it could."""
    Path(".urdfsync/stamp").unlink()
    time.sleep(0.1)  # what was before is old enough
    assert hook._nothing_to_do()
    assert not hook._is_answered()


def _stage(repository: Repository, path: str) -> None:
    Path(path).write_text("another text\n")
    repository.git("add", path)


CHANGES: dict[str, Callable[[Repository], object]] = {
    "a source": lambda _: Path("robots/leg.urdf").write_text("<robot/>"),
    "an output": lambda _: Path(MODEL).unlink(),
    "an output that is tracked no more": lambda repository: repository.git("rm", "-q", "--cached", MODEL),
    "a source that is tracked no more": lambda repository: repository.git("rm", "-q", "--cached", "robots/leg.urdf"),
    "a state that is tracked no more": lambda repository: repository.git(
        "rm", "-q", "--cached", "-r", ".urdfsync/robots"
    ),
    "another output": lambda repository: _stage(repository, MODEL),
    "another configuration": lambda repository: _stage(repository, "robots/urdfsync.toml"),
    "no configuration": lambda repository: repository.git("rm", "-q", "--cached", "urdfsync.toml"),
    "a file that has nothing to do with it": lambda _: Path("notes.txt").write_text("other"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_whatever_is_new_is_judged(repository: Repository, name: str) -> None:
    CHANGES[name](repository)
    assert not hook._is_answered()


def test_a_commit_of_something_else_passes_by_the_answer(repository: Repository) -> None:
    _stage(repository, "notes.txt")
    assert hook._is_answered()


def test_an_ignored_source_is_left_to_the_full_way(repository: Repository) -> None:
    repository.git("rm", "-q", "--cached", "robots/leg.urdf")
    Path(".gitignore").write_text("robots/leg.urdf\n")
    repository.git("add", ".gitignore")
    _expect_no_save()


def test_the_answer_belongs_to_the_folder_and_the_environment(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Entries of ROS_PACKAGE_PATH may be relative."""
    with monkeypatch.context() as patch:
        patch.chdir("robots")
        assert not hook._is_answered()
    with monkeypatch.context() as patch:
        patch.setenv("PYTHONPATH", str(repository.folder))
        assert not hook._is_answered()
    with monkeypatch.context() as patch:
        patch.setenv("MODELICAPATH", str(repository.folder))
        assert not hook._is_answered()
    assert hook._is_answered()


def test_a_source_by_a_link_is_left_to_the_full_way(repository: Repository) -> None:
    """The link may lead elsewhere while nothing that was looked at changes."""
    Path("robots/leg.urdf").rename("real.urdf")
    Path("robots/leg.urdf").symlink_to("../real.urdf")
    repository.git("add", ".")
    _expect_no_save()
