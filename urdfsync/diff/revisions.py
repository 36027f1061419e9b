"""Versions of a source, from files and from git revisions, with the files that they refer to.

Git's object database is read only; nothing in the repository changes.
"""

from __future__ import annotations

import itertools
import os
import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import git
from urdfsync.config import shown
from urdfsync.dependencies import read_unrecorded
from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import Dependency
from urdfsync.files import digest

_REFUSED = ("dubious ownership", "safe.directory")
"""Words of git's message about a repository of another user."""
_HINT = "name an existing file, or a branch, tag or commit such as HEAD~1"
_LFS_POINTER = re.compile(rb"version https://git-lfs.*^oid sha256:([0-9a-f]{64})$", re.DOTALL | re.MULTILINE)
"""Content that git holds in the place of a file that is in Git LFS."""


class Revision:
    """One revision of the repository that holds a folder."""

    def __init__(self, folder: Path, name: str) -> None:
        """Raises SourceError if git, the repository or the revision is missing."""
        self.name = name
        if name.startswith("-") or not name.strip() or not name.isprintable():
            raise _error("bad-revision", f"{name!r} is neither a file nor a git revision", hint=_HINT)
        self._top = Path(os.path.realpath(_toplevel(folder, name)))
        found = _git(self._top, "rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
        self._commit = found.stdout.decode().strip()
        if found.returncode or not self._commit.isalnum():  # for `A..B` git names the excluded commits as `^HASH`
            message = f"{name!r} is neither a file nor a revision of the git repository {self._top}"
            raise _error("unknown-revision", message, hint=_HINT)

    def label(self, file: Path) -> str:
        """Return the name of a file of this revision in messages."""
        return f"{self.name}:{shown(file)}"

    def read(self, file: Path) -> bytes:
        """Return the content of a file in this revision. Raises SourceError if it has none of this path."""
        content = self.contents([file]).get(file)
        if content is None:
            message = f"{shown(file)} does not exist in revision {self.name!r}"
            hint = "if it had another path then, save it with `git show REVISION:PATH > FILE`, and use --against FILE"
            raise _error("not-in-revision", message, self.label(file), hint)
        return content

    def holds(self, file: Path) -> bool:
        """Whether a file is where this repository keeps its files, in whatever revision; a submodule keeps its own."""
        place = Path(os.path.realpath(file))
        if self._top not in place.parents:
            return False
        inside = itertools.takewhile(lambda folder: folder != self._top, place.parents)
        return not any((folder / ".git").exists() for folder in inside)

    def contents(self, files: Sequence[Path]) -> Mapping[Path, bytes]:
        """Return the content of each of the files that this revision has."""
        names = {}
        for file in filter(self.holds, files):
            name = f"{self._commit}:{Path(os.path.realpath(file)).relative_to(self._top).as_posix()}"
            if "\n" not in name:
                names[file] = name
        if not names:
            return {}
        done = _git(self._top, "cat-file", "--batch", content="".join(f"{name}\n" for name in names.values()).encode())
        if done.returncode:
            raise _failed(done)
        found: dict[Path, bytes] = {}
        rest = memoryview(done.stdout)
        for file, name in names.items():
            # either `OBJECT missing`, or `HASH TYPE SIZE`, the content and a line feed
            missing = f"{name} missing\n".encode()
            if rest[: len(missing)] == missing:
                rest = rest[len(missing) :]
                continue
            head = bytes(rest[:256]).partition(b"\n")[0]
            _, kind, size = head.split(b" ")
            begin, end = len(head) + 1, len(head) + 1 + int(size)
            if kind == b"blob":
                found[file] = bytes(rest[begin:end])
            rest = rest[end + 1 :]
        return found


class VersionedSource(msgspec.Struct, frozen=True):
    """The content of a source in one version."""

    content: bytes
    name: str
    """Its name in diagnostics."""
    places: tuple[Path, ...]
    """The files from which references count, best first; absolute."""
    revision: Revision | None = None
    scratch: Path | None = None
    """With a revision: a folder for files that are on disk no more, or otherwise."""

    def locate(self, dependencies: Sequence[Dependency]) -> Sequence[Dependency]:
        """Replace the candidates that the revision has by its own; files that no revision can have stay."""
        if self.revision is None or self.scratch is None:
            return dependencies
        held = {path for one in dependencies for path in one.candidates if self.revision.holds(path)}
        places = {}
        for number, (path, content) in enumerate(self.revision.contents(sorted(held)).items()):
            places[path] = path if _is_on_disk(path, content) else self.scratch / str(number) / path.name
            if places[path] != path:
                places[path].parent.mkdir()
                places[path].write_bytes(content)
        found = []
        for one in dependencies:
            paths = tuple(places.get(path, path) for path in one.candidates if path in places or path not in held)
            found.append(msgspec.structs.replace(one, candidates=paths))
        return found


def from_file(path: Path, *others: Path) -> VersionedSource:
    """Read the version in a file; references are looked for beside it, then beside `others`. Raises SourceError."""
    try:
        content = read_unrecorded(path)
    except OSError as error:
        message, hint = f"the source can't be read: {error.strerror}", "name a file that is there and may be read"
        raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(path), hint=hint)) from None
    return VersionedSource(content, shown(path), (path, *others))


def from_revision(name: str, path: Path, scratch: Path) -> VersionedSource:
    """Read the version of a file in the git revision of this name; other files of it go to `scratch`.

    Raises SourceError if the revision does not have it.
    """
    revision = Revision(path.parent, name)
    return VersionedSource(revision.read(path), revision.label(path), (path,), revision, scratch)


def _is_on_disk(path: Path, content: bytes) -> bool:
    """Whether the file has this content, or the one that a pointer of Git LFS stands for."""
    try:
        now, pointer = read_unrecorded(path), _LFS_POINTER.match(content)
    except OSError:
        return False
    return now == content or (pointer is not None and digest(now) == pointer[1].decode())


def _toplevel(folder: Path, name: str) -> str:
    done = _git(folder, "rev-parse", "--show-toplevel")
    if done.returncode == 0:
        return os.fsdecode(done.stdout).rstrip("\n")
    if any(word in os.fsdecode(done.stderr) for word in _REFUSED):
        raise _failed(done)
    message = f"there is no file {name!r}, and no git repository around {folder} that has it as a revision"
    raise _error("no-repository", message, hint=_HINT)


def _git(folder: Path, *arguments: str, content: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    try:
        return git.run(folder, "--no-replace-objects", *arguments, content=content)
    except FileNotFoundError:
        message, hint = "git is not installed, or not on PATH", "install it, or give --against a file"
        raise _error("no-git", message, hint=hint) from None
    except OSError as problem:
        raise _error("no-git", f"git can't be run: {problem.strerror}", hint="give --against a file") from None


def _failed(done: subprocess.CompletedProcess[bytes]) -> SourceError:
    return _error("git", f"git failed: {git.reason(done)}", hint="put that right, or give --against a file")


def _error(code: str, message: str, file: str = "", hint: str = "") -> SourceError:
    return SourceError(Diagnostic(Severity.ERROR, code, message, file, hint=hint))
