"""The index of a git repository, beside what the working tree holds. It is only read, not even refreshed."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from urdfsync import git
from urdfsync.dependencies import mark_incomplete
from urdfsync.diagnostics import Diagnostic, Severity, SourceError

_SUBMODULE = "160000"


class Index:
    """The index of the repository around a folder. Files are named by their path from its top, POSIX."""

    def __init__(self, folder: Path) -> None:
        """Raises SourceError if there is no repository around `folder`, or while files are unmerged."""
        self.folder = folder
        self.top = Path(_git(folder, *git.TOP).rstrip("\n"))
        self._modes: dict[str, str] = {}
        self._sparse: set[str] = set()
        changed: dict[str, str] = {}
        for line in _git(folder, *git.LIST_INDEX).split("\0")[:-1]:
            head, _, path = line.partition("\t")
            tag, mode, name, stage = head.split(" ")
            if stage != "0":
                message = "the file is not merged yet, so there is nothing to commit"
                hint = "resolve the conflict and `git add` it"
                raise SourceError(Diagnostic(Severity.ERROR, "unmerged", message, path, hint=hint))
            self._modes[path] = mode
            if tag != "H":  # modified, deleted, or git was told not to look at it
                changed[path] = name
            if tag in "Ss":  # skip-worktree: `checkout-index` leaves it out unless told otherwise
                self._sparse.add(path)
        if changed:
            # after `git add --intent-to-add` the index has an empty file that no commit will have
            listing = _git(folder, "-c", "diff.relative=false", "diff-files", "--diff-filter=A", "--name-only", "-z")
            for path in changed.keys() & set(listing.split("\0")[:-1]):
                del self._modes[path]
        self.changed = frozenset((changed.keys() & self._modes.keys()) - self._unchanged(changed))
        """The tracked files of which the working tree has another content, or none."""
        self._submodules = tuple(f"{path}/" for path, mode in self._modes.items() if mode == _SUBMODULE)
        self._real_folders: dict[Path, str] = {}

    def path(self, file: Path) -> str | None:
        """Return the path of a file from the top; None if it is outside of the repository, or in a submodule.

        Links among the folders are followed, as git does not track what is behind them.
        """
        parent = file.parent
        if parent not in self._real_folders:
            self._real_folders[parent] = os.path.realpath(parent) + os.sep
            if self._real_folders[parent] != str(parent) + os.sep:
                mark_incomplete()  # the target of a link is not recorded as a dependency
        top = str(self.top).rstrip(os.sep) + os.sep
        if not self._real_folders[parent].startswith(top):
            return None
        path = (self._real_folders[parent][len(top) :] + file.name).replace(os.sep, "/")
        if path.startswith(self._submodules):
            mark_incomplete()  # the submodule may be removed
            return None
        return path

    def paths(self, files: Iterable[Path]) -> list[str]:
        """Return the paths from the top of those of the files that have one, each once."""
        return list(dict.fromkeys(path for file in files if (path := self.path(file)) is not None))

    def tracks(self, path: str) -> bool:
        """Return whether a file is in the index."""
        return path in self._modes

    def is_submodule(self, path: str) -> bool:
        """Return whether a tracked path is a repository of its own."""
        return self._modes.get(path) == _SUBMODULE

    def below(self, folder: str) -> list[str]:
        """Return the tracked files below a folder; "" is the top."""
        return [path for path in self._modes if path.startswith(f"{folder}/")] if folder else list(self._modes)

    def unstaged(self, paths: Iterable[str]) -> tuple[str, ...]:
        """Return those of the paths that are not staged as they are on disk, deleted files included."""
        return tuple(
            path for path in paths if path in self.changed or (not self.tracks(path) and (self.top / path).is_file())
        )

    def pending(self, folder: str) -> set[str]:
        """Return all files below a folder that `git add -f` would stage."""
        found = {path for path in self.changed if path.startswith(f"{folder}/")}
        for place, _, names in os.walk(self.top / folder):
            paths = ((Path(place) / name).relative_to(self.top).as_posix() for name in names)
            found |= {path for path in paths if not self.tracks(path)}
        return found

    def ignored(self, paths: Iterable[str]) -> set[str]:
        """Return those of the untracked files that git is told to ignore."""
        asked = "".join(f"{os.path.relpath(self.top / path, self.folder)}\0" for path in paths)
        if not asked:
            return set()
        listing = _git(self.folder, "check-ignore", "-z", "--stdin", content=asked, codes=(0, 1))
        found = (os.path.normpath(self.folder / name) for name in listing.split("\0")[:-1])
        return {Path(name).relative_to(self.top).as_posix() for name in found}

    def patched(self, patch: Path) -> set[str]:
        """Return the files that a patch changes."""
        listing = _git(self.top, "apply", "--numstat", "-z", str(patch))
        return {line.split("\t", 2)[2] for line in listing.split("\0")[:-1]}

    def checkout(self, paths: Sequence[str], target: Path) -> None:
        """Write staged files below another folder, with line endings converted and Git LFS resolved.

        With a prefix, git neither needs a lock nor records what it wrote. Raises SourceError if a filter fails.
        """
        if not paths:
            return
        sparse = ["--ignore-skip-worktree-bits"] if self._sparse.intersection(paths) else []
        names = "".join(f"{os.path.relpath(self.top / path, self.folder)}\0" for path in paths)
        _git(self.folder, "checkout-index", "-z", "--stdin", f"--prefix={target}{os.sep}", *sparse, content=names)

    def _unchanged(self, names: Mapping[str, str]) -> set[str]:
        """Return the files that have the same content on disk once filters are applied; `names` are of their objects.

        Where sizes differ, `ls-files` does not apply filters: line endings may be the only difference.
        """
        places = {path: self.top / path for path in names if not set(path) & {"\n", '"'}}
        files = [path for path, place in places.items() if place.is_file() and not place.is_symlink()]
        if not files:
            return set()
        found = _git(self.top, "hash-object", "--stdin-paths", content="".join(f"{path}\n" for path in files))
        return {path for path, name in zip(files, found.splitlines(), strict=True) if name == names[path]}


def _git(folder: Path, *arguments: str, content: str = "", codes: Sequence[int] = (0,)) -> str:
    """Run git; return its output. Raises SourceError unless its exit code is one of `codes`."""
    try:
        done = git.run(folder, *arguments, content=os.fsencode(content))
    except FileNotFoundError:
        message, hint = "git is not installed, or not on PATH", "install it, or use `urdfsync build --check`"
        raise SourceError(Diagnostic(Severity.ERROR, "no-git", message, hint=hint)) from None
    if done.returncode in codes:
        return os.fsdecode(done.stdout)
    hint = "the hooks judge what is staged; without a repository, use `urdfsync build --check`"
    raise SourceError(Diagnostic(Severity.ERROR, "git", f"git failed: {git.reason(done)}", hint=hint))
