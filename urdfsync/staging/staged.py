"""What git has staged, beside what is in the working tree.

Everything is asked of git itself, so GIT_INDEX_FILE and GIT_DIR count, which git sets while it commits. The index
is only read, not even refreshed.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath

from urdfsync.dependencies import mark_incomplete
from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.staging.listing import LISTING, TOP, environment

_EMPTY = (
    "e69de29bb2d1d6434b8b29ae775ad8c2e48c5391",
    "473a0f4c3be8a93681a267e3b1e9a7dcda1185436fe141f7749120a303721813",
)
"""Names of the empty file, in both kinds of repositories."""
_SUBMODULE = "160000"


class Index:
    """The index of the repository around a folder; files are named by their path from its top, POSIX."""

    def __init__(self, folder: Path) -> None:
        """`folder` must be in the working tree. Raises SourceError if there is none, or while files are unmerged."""
        self._folder = folder
        with _start(folder, *LISTING) as listing:
            self.top = Path(_finish(_start(folder, *TOP)).rstrip("\n"))
            lines = _finish(listing).split("\0")[:-1]
        self._modes: dict[str, str] = {}
        self._sparse: set[str] = set()
        changed: dict[str, str] = {}
        for line in lines:
            head, _, path = line.partition("\t")
            tag, mode, name, stage = head.split(" ")
            if stage != "0":
                raise _unmerged(path)
            self._modes[path] = mode
            if tag == "H":
                continue
            changed[path] = name  # modified or deleted, or git was told not to look at it
            if tag in "Ss":
                self._sparse.add(path)
        for path in self._intended() & changed.keys() if not set(_EMPTY).isdisjoint(changed.values()) else ():
            del self._modes[path]
        self.changed: frozenset[str] = frozenset((changed.keys() & self._modes.keys()) - self._same(changed))
        """The tracked files of which the working tree has another content, or none."""
        self._submodules = [f"{path}/" for path, mode in self._modes.items() if mode == _SUBMODULE]
        self._folders: dict[Path, str] = {}

    def named(self, name: str) -> list[str]:
        """The tracked files that have this name, in whatever folder."""
        return sorted(path for path in self._modes if path.endswith(name) and PurePosixPath(path).name == name)

    def path(self, file: Path) -> str | None:
        """How the repository calls a file; None for one that is outside of it, or in a submodule.

        Links among the folders are followed, as git does not track what is behind them.
        """
        parent = file.parent
        if parent not in self._folders:
            self._folders[parent] = os.path.realpath(parent) + os.sep
            if self._folders[parent] != str(parent) + os.sep:
                mark_incomplete()  # nobody takes down where links lead to
        top = str(self.top).rstrip(os.sep) + os.sep
        place = self._folders[parent]
        if not place.startswith(top):
            return None
        path = (place[len(top) :] + file.name).replace(os.sep, "/")
        if any(path.startswith(module) for module in self._submodules):
            mark_incomplete()  # it may be none some day
            return None
        return path

    def tracks(self, path: str) -> bool:
        """Whether a file is in the index."""
        return path in self._modes

    def below(self, folder: str) -> list[str]:
        """The tracked files below a folder."""
        return [path for path in self._modes if path.startswith(f"{folder}/")] if folder else list(self._modes)

    def pending(self, folder: str) -> set[str]:
        """The files below a folder that are not staged as they are, or not at all."""
        found = {path for path in self.changed if path.startswith(f"{folder}/")}
        for place, _, names in os.walk(self.top / folder):
            paths = ((Path(place) / name).relative_to(self.top).as_posix() for name in names)
            found |= {path for path in paths if not self.tracks(path)}
        return found

    def is_submodule(self, path: str) -> bool:
        """Whether a tracked path is a repository of its own."""
        return self._modes.get(path) == _SUBMODULE

    def checkout(self, paths: Sequence[str], target: Path) -> None:
        """Write staged files below another folder, as a checkout would: with line endings converted, LFS resolved.

        With a prefix, git neither needs a lock nor records what it wrote. Raises SourceError if a filter fails.
        """
        if not paths:
            return
        sparse = ["--ignore-skip-worktree-bits"] if self._sparse.intersection(paths) else []
        names = (os.path.relpath(self.top / path, self._folder) for path in paths)
        command = ["checkout-index", "-z", "--stdin", f"--prefix={target}{os.sep}", *sparse]
        _finish(_start(self._folder, *command, stdin=True), "".join(f"{name}\0" for name in names))

    def ignored(self, paths: Iterable[str]) -> set[str]:
        """Those of the untracked files that git is told to ignore."""
        asked = "".join(f"{os.path.relpath(self.top / path, self._folder)}\0" for path in paths)
        if not asked:
            return set()
        said = _finish(_start(self._folder, "check-ignore", "-z", "--stdin", stdin=True), asked, fine=(0, 1))
        found = (os.path.normpath(self._folder / name) for name in said.split("\0")[:-1])
        return {Path(name).relative_to(self.top).as_posix() for name in found}

    def patched(self, patch: Path) -> set[str]:
        """The files that a patch changes."""
        said = _finish(_start(self.top, "apply", "--numstat", "-z", str(patch)))
        return {line.split("\t", 2)[2] for line in said.split("\0")[:-1]}

    def _same(self, names: Mapping[str, str]) -> set[str]:
        """The files that are on disk what they are in the index, once filters are applied; by their objects' names.

        Where sizes differ, `ls-files` does not find out by itself: line endings may be all there is.
        """
        places = {path: self.top / path for path in names if not set(path) & {"\n", '"'}}
        files = [path for path, place in places.items() if place.is_file() and not place.is_symlink()]
        if not files:
            return set()
        asked = "".join(f"{path}\n" for path in files)
        found = _finish(_start(self.top, "hash-object", "--stdin-paths", stdin=True), asked).splitlines()
        return {path for path, name in zip(files, found, strict=True) if name == names[path]}

    def _intended(self) -> set[str]:
        """The files of which git has only been told that they will be added: no commit has them."""
        command = ["-c", "diff.relative=false", "diff-files", "--diff-filter=A", "--name-only", "-z"]
        return set(_finish(_start(self._folder, *command)).split("\0")[:-1])


def _start(folder: Path, *arguments: str, stdin: bool = False) -> subprocess.Popen[bytes]:
    source = subprocess.PIPE if stdin else subprocess.DEVNULL
    try:
        return subprocess.Popen(  # noqa: S603
            ["git", *arguments],  # noqa: S607
            cwd=folder,
            env=environment(),
            stdin=source,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
    except FileNotFoundError:
        message, hint = "git is not installed, or not on PATH", "install it, or use `urdfsync build --check`"
        raise SourceError(Diagnostic(Severity.ERROR, "no-git", message, hint=hint)) from None


def _finish(process: subprocess.Popen[bytes], content: str | None = None, fine: Sequence[int] = (0,)) -> str:
    with process:
        out, err = process.communicate(None if content is None else os.fsencode(content))
    if process.returncode in fine:
        return os.fsdecode(out)
    said = err.decode(errors="replace").strip().rpartition("\n")[2].removeprefix("fatal: ")
    hint = "the hooks judge what is staged; without a repository, use `urdfsync build --check`"
    raise SourceError(Diagnostic(Severity.ERROR, "git", f"git failed: {said}", hint=hint))


def _unmerged(path: str) -> SourceError:
    message, hint = "the file is not merged yet, so there is nothing to commit", "resolve the conflict and `git add` it"
    return SourceError(Diagnostic(Severity.ERROR, "unmerged", message, path, hint=hint))
