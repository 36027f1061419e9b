"""The list of tracked files that is had without loading anything, beside the one of `Index`."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository

from urdfsync.staging import listing
from urdfsync.staging.staged import Index

pytestmark = [NEEDS_GIT, pytest.mark.skipif(not hasattr(os, "posix_spawnp"), reason="only where a process is spawned")]

NAMES = ("a.txt", "folder/b.txt", "folder/ä ö.txt", "new\nline.txt")


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    found = Repository(tmp_path / "repository", monkeypatch)
    for name in NAMES:
        (found.folder / name).parent.mkdir(exist_ok=True)
        (found.folder / name).write_text(name)
    found.commit()
    monkeypatch.chdir(found.folder)
    return found


def test_it_names_what_is_tracked(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    Path("untracked.txt").touch()
    for folder in (".", "folder"):
        monkeypatch.chdir(repository.folder / folder)
        index = Index(Path.cwd())
        assert listing.unchanged() == (str(index.top), set(NAMES))
        assert all(index.tracks(name) for name in NAMES)


def test_any_difference_is_left_to_others(repository: Repository) -> None:
    Path("a.txt").write_text("other")
    assert listing.unchanged() is None
    repository.git("add", "a.txt")
    assert listing.unchanged() is not None, "staged as it is"
    Path("folder/b.txt").unlink()
    assert listing.unchanged() is None
    repository.git("checkout", "folder/b.txt")
    repository.git("update-index", "--skip-worktree", "a.txt")
    assert listing.unchanged() is None, "git does not look at it"


def test_the_index_of_the_commit_counts(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_INDEX_FILE", "other")
    monkeypatch.setenv("GIT_LITERAL_PATHSPECS", "1")
    repository.git("read-tree", "HEAD:folder")
    assert listing.unchanged() is None, "there are no such files"


def test_without_a_repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert listing.unchanged() is None


def test_without_git(repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(OSError, match="git"):
        listing.unchanged()
