"""The index of git: what is tracked, staged and hidden, from any folder and with any settings of the caller's."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository, make_repository_of_files

from urdfsync.project import git
from urdfsync.project.git import GitError, Index
from urdfsync.project.git import Repository as Around

pytestmark = NEEDS_GIT

ODD = "in/ä b" if sys.platform == "win32" else "in/ä b\n"


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """One with files in several states; the working folder is one inside of it."""
    found = Repository(folder / "top", monkeypatch)
    monkeypatch.chdir(found.folder)
    for path in ("same", "staged", "edited", "gone", "hidden", "skipped", ODD, "in/deep/file"):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text("old")
    Path(".gitignore").write_text("*.log\n")
    found.commit()
    for path in ("staged", "edited", "hidden", "skipped", "new", "in/new", "x.log"):
        Path(path).write_text("other")
    found.git("add", "staged")
    found.git("update-index", "--assume-unchanged", "hidden")
    found.git("update-index", "--skip-worktree", "skipped")
    Path("gone").unlink()
    monkeypatch.chdir("in")
    monkeypatch.setenv("GIT_LITERAL_PATHSPECS", "1")  # `:/` is no path
    return found


def test_files_are_named_from_the_top_by_how_they_stand(repository: Repository) -> None:
    index, before = Index(), Path(repository.folder, ".git/index").read_bytes()
    assert Around().top == str(repository.folder)
    inside = {ODD, "in/deep/file"}
    assert index.tracked == {".gitignore", "same", "staged", "edited", "gone", "hidden", "skipped", *inside}
    assert (index.unstaged, index.hidden) == ({"edited", "gone"}, {"hidden", "skipped"})
    assert index.untracked == {"new", "in/new"}
    assert Path(repository.folder, ".git/index").read_bytes() == before


def test_without_a_working_tree_and_without_git(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    subprocess.run(["git", "init", "-q", "--bare", "bare"], check=True)
    with monkeypatch.context() as patch:
        patch.setenv("GIT_DIR", "bare")
        with pytest.raises(GitError, match="git failed: this operation must be run in a work tree"):
            Around()
    with pytest.raises(GitError, match="git failed: not a git repository"):
        Around()
    Path(".git").mkdir()
    monkeypatch.setenv("PATH", str(folder))
    with pytest.raises(GitError, match="git can't be started: "):
        Around()


@pytest.mark.parametrize("version", ["this one", "one that ignores safe.bareRepository"])
def test_a_repository_of_committed_files_is_passed_over(
    repository: Repository, monkeypatch: pytest.MonkeyPatch, version: str
) -> None:
    make_repository_of_files(Path.cwd())
    if version != "this one":
        monkeypatch.setattr(git, "_SETTINGS", ())
    assert Around().top == str(repository.folder)
    assert "in/HEAD" in Index().untracked
    assert not Path("fsmonitor").exists()
