"""Git repositories for tests, which ignore the machine's settings of git."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

NEEDS_GIT = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


class Repository:
    """A repository; everything in its folder is committed."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        for name in ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"):
            monkeypatch.delenv(name, raising=False)
        monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
        monkeypatch.setenv("GIT_CONFIG_NOSYSTEM", "1")
        for name in ("AUTHOR_NAME", "AUTHOR_EMAIL", "COMMITTER_NAME", "COMMITTER_EMAIL"):
            monkeypatch.setenv(f"GIT_{name}", "test@example.org")
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self.git("init", "-q", "--template=", "-b", "main")

    def git(self, *arguments: str) -> str:
        """Run git in the repository; return its output."""
        done = subprocess.run(["git", *arguments], cwd=self.folder, check=True, capture_output=True, text=True)
        return done.stdout

    def commit(self, message: str = "next") -> None:
        """Commit all files."""
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)

    def merge(self, branch: str) -> None:
        """Merge a branch; unmerged files keep this side's text. Git must merge recorded states."""
        subprocess.run(["git", "merge", "-q", "--no-edit", branch], cwd=self.folder, capture_output=True)
        for path in self.git("diff", "--name-only", "--diff-filter=U").split():
            assert not path.startswith(".urdfsync/")
            done = subprocess.run(["git", "checkout", "-q", "HEAD", "--", path], cwd=self.folder, capture_output=True)
            if done.returncode:  # this side has deleted the file
                (self.folder / path).unlink(missing_ok=True)


def make_repository_of_files(folder: Path) -> None:
    """Make a folder a repository without a `.git`, as a stranger can commit it; its settings name a program."""
    for name in ("objects", "refs/heads"):
        (folder / name).mkdir(parents=True)
        (folder / name / "keep").touch()
    (folder / "HEAD").write_text("ref: refs/heads/main\n")
    settings = f'bare = false\nworktree = "{folder}"\nfsmonitor = "touch {folder}/fsmonitor; false"\n'
    (folder / "config").write_text(f"[core]\nrepositoryformatversion = 0\n{settings}")
