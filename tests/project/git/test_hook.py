"""A hook passes by records as long as it would pass without."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from support import remembered
from support.git import NEEDS_GIT, Repository

from urdfsync import __main__
from urdfsync.commands import cli
from urdfsync.project.git import hook

pytestmark = NEEDS_GIT

MODEL = "modelica/Leg/Links/Tip.mo"


@pytest.fixture
def repository(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A project in step, all of it committed, with records of the hook; the working folder."""
    shutil.copytree(in_step, tmp_path / "project")
    (tmp_path / "project/.urdfsync/robots/gone.state").unlink()
    found = Repository(tmp_path / "project", monkeypatch)
    Path(found.folder / "notes.txt").write_text("notes\n")
    name = "new line ä.txt" if sys.platform == "win32" else "new\nline ä.txt"
    Path(found.folder / name).write_text("name\n")
    found.commit()
    monkeypatch.chdir(found.folder)
    remembered.until(is_answered, lambda: cli.main(["hook", "check"]))
    return found


def is_answered(mode: str = "check") -> bool:
    return hook.is_answered(["hook", mode])


def test_both_modes_pass_by_one_answer(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    for mode in ("check", "build"):
        assert is_answered(mode)
        monkeypatch.setattr(sys, "argv", ["urdfsync", "hook", mode])
        assert __main__.main() == 0


def _stage(path: str) -> Callable[[Repository], None]:
    def stage(repository: Repository) -> None:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text("another text\n")
        repository.git("add", path)

    return stage


def _git(*arguments: str) -> Callable[[Repository], object]:
    return lambda repository: repository.git(*arguments)


CHANGES: dict[str, Callable[[Repository], object]] = {
    "another source": _stage("robots/leg.urdf"),
    "an output that is tracked no more": _git("rm", "-q", "--cached", MODEL),
    "a source that is tracked no more": _git("rm", "-q", "--cached", "robots/leg.urdf"),
    "a mesh that is tracked no more": _git("rm", "-q", "--cached", "robots/leg_meshes/base.stl"),
    "a state that is tracked no more": _git("rm", "-q", "-r", "--cached", ".urdfsync/robots"),
    "another output": _stage(MODEL),
    "another configuration": _stage("robots/urdfsync.toml"),
    "another clone": lambda repository: write_into_clone(repository, "robots/leg.urdf"),
    "a mesh less in the clone": lambda repository: (clone(repository) / "robots/leg_meshes/base.stl").unlink(),
    "an export that was killed": lambda repository: (clone(repository).parent / "deps/export").unlink(),
    "half an export": lambda repository: (clone(repository).parent / "deps/export").write_text("1\0\0"),
}


def clone(repository: Repository) -> Path:
    """The hook's clone."""
    return repository.folder / ".git/urdfsync/clone"


def write_into_clone(repository: Repository, path: str) -> None:
    """Write another text to a file of the clone, as nobody does."""
    (clone(repository) / path).write_text("<robot/>")


@pytest.mark.parametrize("name", CHANGES)
def test_whatever_is_new_in_the_index_is_checked(repository: Repository, name: str) -> None:
    CHANGES[name](repository)
    assert not is_answered()


@pytest.mark.parametrize(
    "change",
    [
        lambda: Path("notes.txt").write_text("other"),
        lambda: Path("robots/leg.urdf").write_text("<robot/>"),
        lambda: Path(MODEL).unlink(),
        lambda: Path("robots/COLCON_IGNORE").touch(),
        lambda: shutil.rmtree("modelica"),
    ],
)
def test_what_is_not_staged_does_not_count(
    repository: Repository, monkeypatch: pytest.MonkeyPatch, change: Callable[[], object]
) -> None:
    change()
    monkeypatch.setenv("GIT_LITERAL_PATHSPECS", "1")
    assert is_answered()


def test_after_another_file_was_staged_the_answer_still_holds(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Git rewrites only this file in the clone, and no robot is planned."""
    _stage("notes.txt")(repository)
    assert not is_answered()
    with monkeypatch.context() as patch:
        patch.setattr("urdfsync.commands.hook.build", lambda *_: pytest.fail("a robot is planned"))
        assert cli.main(["hook", "check"]) == 0
    assert is_answered()


def test_the_index_of_a_partial_commit_is_the_one_that_counts(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_INDEX_FILE", ".git/other")
    repository.git("read-tree", "HEAD")
    assert cli.main(["hook", "check"]) == 0
    assert is_answered()
    repository.git("rm", "-q", "--cached", MODEL)
    assert not is_answered()
    assert cli.main(["hook", "check"]) == 1
    monkeypatch.delenv("GIT_INDEX_FILE")
    assert cli.main(["hook", "check"]) == 0


def test_links_mean_the_same_in_the_clone(repository: Repository) -> None:
    """Git checks them out; those that lead out, or back by an absolute path, get another target."""
    outside = repository.folder.parent / "outside"
    outside.mkdir()
    (outside / "back").symlink_to(repository.folder / "robots")
    robots = str(clone(repository) / "robots")
    links = [("inner", "robots", "robots"), ("absolute", str(repository.folder / "robots"), robots)]
    links += [
        ("out", "../outside", str(outside)),
        ("robots/round", "../../outside/back/leg.urdf", f"{robots}/leg.urdf"),
    ]
    for name, target, _ in links:
        Path(name).symlink_to(target)
    repository.git("add", ".")
    for _ in range(2):  # the second time, git finds other links than it has checked out
        assert cli.main(["hook", "check"]) == 0
        assert [(name, target, os.readlink(clone(repository) / name)) for name, target, _ in links] == links  # noqa: PTH115
        Path("notes.txt").write_text("other notes\n")
        repository.git("add", "notes.txt")


def test_the_answer_belongs_to_the_folder_and_the_environment(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Entries of ROS_PACKAGE_PATH may be relative."""
    with monkeypatch.context() as patch:
        patch.chdir("robots")
        assert not is_answered()
    for name in ("PYTHONPATH", "MODELICAPATH", "ROS_PACKAGE_PATH"):
        with monkeypatch.context() as patch:
            patch.setenv(name, str(repository.folder))
            assert not is_answered()
    assert is_answered()
