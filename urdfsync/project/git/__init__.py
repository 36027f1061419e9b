"""Runs git in the repository around the working folder. Nothing here writes or refreshes the index."""

from __future__ import annotations

import os

from urdfsync.common.dependencies.places import place, real

_SETTINGS = ("-c", "safe.bareRepository=explicit", "-c", "core.fsmonitor=false", "-c", "diff.relative=false")
"""Override the repository's settings: a setting such as fsmonitor names a program that git would run."""
_CLONE = ("-c", "core.hooksPath=/dev/null", "-c", "submodule.recurse=false", "-c", "advice.detachedHead=false")
"""Settings for the hook's clone, in which no hook runs."""
_PATHSPECS = {f"GIT_{kind}_PATHSPECS" for kind in ("LITERAL", "GLOB", "NOGLOB", "ICASE")}
_REPOSITORY = {
    *("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_COMMON_DIR", "GIT_PREFIX", "GIT_CONFIG_PARAMETERS"),
    *("GIT_OBJECT_DIRECTORY", "GIT_ALTERNATE_OBJECT_DIRECTORIES", "GIT_SHALLOW_FILE", "GIT_NAMESPACE", "GIT_CONFIG"),
}
"""Variables that git sets for the repository whose hook it runs; another repository must not get them."""


class GitError(Exception):
    """git is not installed, or fails; the message says why."""


class Repository:
    """The repository around the working folder, with the index of the commit that a hook judges."""

    def __init__(self) -> None:
        """Raises GitError if there is no working tree of a repository."""
        words = "--show-toplevel", "--absolute-git-dir", "--git-path", "index", "--git-path", "objects"
        lines = run("rev-parse", *words).removesuffix("\n").split("\n")
        self.top, self.folder, *paths = map(os.path.normpath, lines)  # git writes `C:/folder`
        here = os.getcwd() if "GIT_DIR" in os.environ else find_top(os.curdir) or ""
        self.index, self.objects = (os.path.realpath(os.path.join(here, path)) for path in paths)


class Index:
    """The index of the repository around the working folder, compared with the working tree.

    Paths are from the top of the repository, with forward slashes. A submodule is one path, without its files.
    """

    def __init__(self) -> None:
        """Raises GitError if there is no working tree of a repository."""
        entries = list_paths("ls-files", "-v", "--cached", "--modified", "--full-name", "--", ":/")
        self.tracked = {entry[2:] for entry in entries}
        unusual = [(entry[0], entry[2:]) for entry in entries if not entry.startswith("H ")]
        self.unstaged = {path for tag, path in unusual if tag == "C"}
        """Tracked files that differ in working tree and index, including deleted files."""
        self.hidden = {path for tag, path in unusual if tag not in "MC"}
        """Tracked files with a flag (such as `assume-unchanged`) that hides changes."""
        others = list_paths("ls-files", "--others", "--exclude-standard", "--full-name", "--", ":/")
        self.untracked = {path.removesuffix("/") for path in others}
        """The files that git neither tracks nor ignores, and the folders of other repositories."""


def find_top(folder: str | os.PathLike[str]) -> str | None:
    """Return the folder, or the nearest folder above, that has a `.git`; None if there is none.

    A bare repository, without a `.git`, is skipped: a stranger may have committed its files. Git never commits or
    checks out a `.git`. This runs no git, and records no read.
    """
    ceilings = os.environ.get("GIT_CEILING_DIRECTORIES", "").split(os.pathsep)
    limits = {os.path.realpath(ceiling) for ceiling in ceilings if ceiling}
    top = real(folder)
    while not os.path.exists(place(os.path.join(top, ".git"))):
        parent = os.path.dirname(top)
        if parent == top or parent in limits:
            return None
        top = parent
    return top


def list_paths(command: str, *arguments: str, clone: str | None = None) -> list[str]:
    """Run a git command that lists paths. Raises GitError."""
    return run(command, "-z", *arguments, clone=clone).split("\0")[:-1]


def run(*arguments: str, clone: str | None = None, **given: str) -> str:
    """Run git at the top of the repository around the working folder, or in the hook's `clone`; return its output.

    Raises GitError. Git's environment variables stay, but not in the clone: GIT_DIR and GIT_INDEX_FILE name the
    commit's repository and index. `given` are further variables.
    """
    # git before 2.38 ignores safe.bareRepository; later versions fail instead of skipping such a folder
    top = clone
    if clone is None and "GIT_DIR" not in os.environ and (top := find_top(os.curdir)) is None:
        raise GitError("git failed: not a git repository")
    left_out = _PATHSPECS if clone is None else _PATHSPECS | _REPOSITORY  # pathspecs change `:/`
    variables = {name: value for name, value in os.environ.items() if name not in left_out}
    variables |= {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}  # English messages; the index stays as it is
    # without these, git would take the user's repository if the clone is damaged
    variables |= given if clone is None else {"GIT_DIR": f"{clone}/.git", "GIT_WORK_TREE": clone} | given
    import subprocess  # takes 5 ms, which most builds save: they run nothing

    from urdfsync.common import system

    command = ["git", *_SETTINGS, *(() if clone is None else _CLONE), *arguments]
    try:
        done = subprocess.run(system.command(command), cwd=top, capture_output=True, env=variables, check=False)  # noqa: S603
    except OSError as error:
        raise GitError(f"git can't be started: {error.strerror}") from None
    if done.returncode:
        lines = os.fsdecode(done.stderr).strip().splitlines() or [f"exit code {done.returncode}"]
        reason = next((line for line in lines if line.startswith("fatal: ")), lines[-1])
        raise GitError(f"git failed: {reason.removeprefix('fatal: ')}")
    return os.fsdecode(done.stdout)
