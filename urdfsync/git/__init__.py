"""Runs git in the repository around the working folder. Nothing here writes or refreshes the index."""

from __future__ import annotations

import os
from collections.abc import Collection
from functools import cached_property

_SETTINGS = ("-c", "safe.bareRepository=explicit", "-c", "core.fsmonitor=false", "-c", "diff.relative=false")
"""Override the repository's settings: a setting such as fsmonitor names a program that git would run."""
_PATHSPECS = {f"GIT_{kind}_PATHSPECS" for kind in ("LITERAL", "GLOB", "NOGLOB", "ICASE")}


class GitError(Exception):
    """git is not installed, or fails; the message says why."""


class Index:
    """The index of the repository around the working folder.

    Paths are from the top of the repository, with forward slashes. A submodule is one path, without its files.
    """

    def __init__(self) -> None:
        """Raises GitError if there is no working tree of a repository."""
        self.top = run("rev-parse", "--show-toplevel").removesuffix("\n")
        entries = _list("ls-files", "-v", "--cached", "--modified", "--full-name", "--", ":/")
        self.tracked = {entry[2:] for entry in entries}
        unusual = [(entry[0], entry[2:]) for entry in entries if not entry.startswith("H ")]
        self.unmerged = {path for tag, path in unusual if tag == "M"}
        self.unstaged = {path for tag, path in unusual if tag == "C"}
        """Tracked files that differ in working tree and index, including deleted files."""
        self.hidden = {path for tag, path in unusual if tag not in "MC"}
        """Tracked files with a flag (such as `assume-unchanged`) that hides changes."""

    def has_staged(self, paths: Collection[str]) -> bool:
        """Return whether all paths are tracked, and staged as on disk.

        A path that ends with `/` stands for all files below.
        """
        folders, differing = tuple(set(paths) - self.tracked), self.unstaged | self.hidden
        if not all(path.endswith("/") for path in folders):
            return False  # an untracked file
        return differing.isdisjoint(paths) and not any(path.startswith(folders) for path in differing)

    def find_committed(self) -> set[str]:
        """Return the files that the commit changes, including deleted files."""
        try:
            return set(_list("diff-index", "--cached", "--name-only", "--no-renames", "HEAD", "--"))
        except GitError:  # there is no commit yet
            return set(self.tracked)

    @cached_property
    def untracked(self) -> set[str]:
        """The files that git neither tracks nor ignores."""
        return set(_list("ls-files", "--others", "--exclude-standard", "--full-name", "--", ":/"))

    @cached_property
    def submodules(self) -> set[str]:
        """The tracked submodules."""
        entries = _list("ls-files", "--stage", "--full-name", "--", ":/")
        return {entry.partition("\t")[2] for entry in entries if entry.startswith("160000 ")}


def find_top(folder: str | os.PathLike[str]) -> str | None:
    """Return the folder, or the nearest folder above, that has a `.git`; None if there is none.

    A bare repository, without a `.git`, is skipped: a stranger may have committed its files. Git never commits or
    checks out a `.git`.
    """
    ceilings = os.environ.get("GIT_CEILING_DIRECTORIES", "").split(os.pathsep)
    limits = {os.path.realpath(ceiling) for ceiling in ceilings if ceiling}
    top = os.path.realpath(folder)
    while not os.path.exists(os.path.join(top, ".git")):
        parent = os.path.dirname(top)
        if parent == top or parent in limits:
            return None
        top = parent
    return top


def _list(command: str, *arguments: str) -> list[str]:
    """Run a git command that lists paths. Raises GitError."""
    return run(command, "-z", *arguments).split("\0")[:-1]


def run(*arguments: str) -> str:
    """Run git at the top of the repository around the working folder; return its output.

    Raises GitError. Git's environment variables stay: GIT_DIR and GIT_INDEX_FILE name the commit's repository and
    index.
    """
    # git before 2.38 ignores safe.bareRepository; later versions fail instead of skipping such a folder
    top = None
    if "GIT_DIR" not in os.environ and (top := find_top(os.curdir)) is None:
        raise GitError("git failed: not a git repository")
    variables = {name: value for name, value in os.environ.items() if name not in _PATHSPECS}  # these change `:/`
    variables |= {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}  # English messages; git must not refresh the index
    import subprocess  # takes 5 ms, which most builds save: they run nothing

    command = ["git", *_SETTINGS, *arguments]
    try:
        done = subprocess.run(command, cwd=top, capture_output=True, env=variables, check=False)  # noqa: S603
    except OSError as error:
        raise GitError(f"git can't be started: {error.strerror}") from None
    if done.returncode:
        lines = os.fsdecode(done.stderr).strip().splitlines() or [f"exit code {done.returncode}"]
        reason = next((line for line in lines if line.startswith("fatal: ")), lines[-1])
        raise GitError(f"git failed: {reason.removeprefix('fatal: ')}")
    return os.fsdecode(done.stdout)
