"""The hook passes by a saved answer as long as it would pass without."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from support import answers
from support.git import NEEDS_GIT, Repository

from urdfsync import cli, hook

pytestmark = NEEDS_GIT

MODEL = "modelica/Leg/Links/Tip.mo"


@pytest.fixture
def repository(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A project in step, all of it committed, with a saved answer of the hook; the working folder."""
    shutil.copytree(in_step, tmp_path / "project")
    found = Repository(tmp_path / "project", monkeypatch)
    Path(found.folder / "notes.txt").write_text("notes\n")
    Path(found.folder / "new\nline ä.txt").write_text("name\n")
    found.commit()
    monkeypatch.chdir(found.folder)
    _save()
    return found


def _save() -> None:
    answers.until(hook.is_answered, lambda: cli.main(["hook", "check"]))


@pytest.mark.parametrize("mode", ["check", "build"])
def test_both_modes_pass_without_looking_further(
    repository: Repository, monkeypatch: pytest.MonkeyPatch, mode: str
) -> None:
    monkeypatch.setattr(cli, "main", None)
    monkeypatch.setattr(sys, "argv", ["urdfsync-hook", mode])
    assert hook.main() == 0


def _stage(repository: Repository, path: str) -> None:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text("another text\n")
    repository.git("add", path)


def _untrack(*paths: str) -> Callable[[Repository], object]:
    return lambda repository: repository.git("rm", "-q", "-r", "--cached", *paths)


CHANGES: dict[str, Callable[[Repository], object]] = {
    "a source": lambda _: Path("robots/leg.urdf").write_text("<robot/>"),
    "an output": lambda _: Path(MODEL).unlink(),
    "an output that is tracked no more": _untrack(MODEL),
    "a source that is tracked no more": _untrack("robots/leg.urdf"),
    "a state that is tracked no more": _untrack(".urdfsync/robots"),
    "another output": lambda repository: _stage(repository, MODEL),
    "another configuration": lambda repository: _stage(repository, "robots/urdfsync.toml"),
    "no configuration": _untrack("urdfsync.toml"),
    "a file that has nothing to do with it": lambda _: Path("notes.txt").write_text("other"),
    "a file that git was told not to look at": lambda repository: repository.git(
        "update-index", "--skip-worktree", "notes.txt"
    ),
    "a state without its configuration": lambda repository: _stage(repository, "old/.urdfsync/robots/arm.toml"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_whatever_is_new_is_judged(repository: Repository, name: str) -> None:
    CHANGES[name](repository)
    assert not hook.is_answered()


def test_a_commit_of_something_else_passes_by_the_answer(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    _stage(repository, "notes.txt")
    monkeypatch.setenv("GIT_LITERAL_PATHSPECS", "1")
    assert hook.is_answered()


def test_the_index_of_a_partial_commit_is_the_one_that_counts(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_INDEX_FILE", ".git/other")
    repository.git("read-tree", "HEAD")
    assert hook.is_answered()
    repository.git("rm", "-q", "--cached", MODEL)
    assert not hook.is_answered()


def test_without_git_the_command_says_so(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    assert not hook.is_answered()


def _ignore_the_source(repository: Repository) -> None:
    repository.git("rm", "-q", "--cached", "robots/leg.urdf")
    Path(".gitignore").write_text("robots/leg.urdf\n")


def _link_the_source(_: Repository) -> None:
    """It may lead elsewhere while nothing that was looked at changes."""
    Path("robots/leg.urdf").rename("real.urdf")
    Path("robots/leg.urdf").symlink_to("../real.urdf")


@pytest.mark.parametrize("change", [_ignore_the_source, _link_the_source])
def test_some_sources_are_left_to_the_full_way(repository: Repository, change: Callable[[Repository], None]) -> None:
    """It passes, and saves no answer although it could."""
    change(repository)
    repository.git("add", ".")
    Path(".urdfsync/stamp").unlink()
    time.sleep(0.1)  # what was before is old enough
    assert cli.main(["hook", "check"]) == 0
    assert not hook.is_answered()


def test_the_answer_belongs_to_the_folder_and_the_environment(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Entries of ROS_PACKAGE_PATH may be relative."""
    with monkeypatch.context() as patch:
        patch.chdir("robots")
        assert not hook.is_answered()
    for name in ("PYTHONPATH", "MODELICAPATH", "ROS_PACKAGE_PATH"):
        with monkeypatch.context() as patch:
            patch.setenv(name, str(repository.folder))
            assert not hook.is_answered()
    assert hook.is_answered()


def test_a_source_with_other_line_endings_is_found_built(repository: Repository) -> None:
    """An answer is saved only if nothing had to be generated."""
    source = Path("robots/leg.urdf")
    source.write_bytes(source.read_bytes().replace(b"\n", b"\r\n"))
    repository.commit()
    assert not hook.is_answered()
    _save()
