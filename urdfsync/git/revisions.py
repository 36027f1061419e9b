"""Reads sources in git revisions, and the files that these sources refer to.

libgit2 reads the object database: this runs no program, fetches nothing, and changes nothing in the repository.
"""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.dependencies.facts import read_unrecorded
from urdfsync.dependencies.places import named, place, real
from urdfsync.diagnostics import SourceError
from urdfsync.domain import Dependency
from urdfsync.files import digest, shown

if TYPE_CHECKING:
    import pygit2

_HINT = "name an existing file, or a branch, tag or commit such as HEAD~1"
_LFS_POINTER = re.compile(rb"version https://git-lfs.*^oid sha256:([0-9a-f]{64})$", re.DOTALL | re.MULTILINE)
"""Content of a Git LFS pointer in git."""


def open_repository(folder: Path) -> pygit2.Repository | None:
    """Return the repository around a folder; None if there is none. Raises SourceError for an unreadable repository."""
    import pygit2  # takes 55 ms: a comparison with the last build does not need it

    from urdfsync import git  # likewise

    if (top := git.find_top(folder)) is None:
        return None
    try:
        # libgit2's discover_repository may find a bare repository that a stranger has committed as files
        flags = pygit2.enums.RepositoryOpenFlag.NO_SEARCH | pygit2.enums.RepositoryOpenFlag.NO_DOTGIT
        repository = pygit2.Repository(place(Path(top, ".git")), flags)
    except pygit2.GitError as problem:  # for example, it belongs to another user
        message, hint = f"the repository can't be read: {problem}", "repair it, or use --against ./FILE"
        raise SourceError.of("git", message, shown(Path(top)), hint=hint) from None
    return repository if repository.workdir else None


class Revision:
    """One revision of the repository around a folder."""

    def __init__(self, folder: Path, name: str) -> None:
        """Raises SourceError if the repository or the revision is missing."""
        import pygit2

        self.name = name
        if name.startswith("-") or not name.strip() or not name.isprintable():
            raise SourceError.of("bad-revision", f"{name!r} is neither a file nor a git revision", hint=_HINT)
        if (repository := open_repository(folder)) is None:
            message = f"there is no file {name!r}, and no git repository around {folder} that has it as a revision"
            raise SourceError.of("no-repository", message, hint=_HINT)
        self.repository = repository
        self.top = Path(named(os.path.realpath(repository.workdir)))
        try:
            self._tree = repository.revparse_single(name).peel(pygit2.Commit).tree
        except (pygit2.GitError, KeyError, ValueError):
            message = f"{name!r} is neither a file nor a revision of the git repository {self.top}"
            raise SourceError.of("unknown-revision", message, hint=_HINT) from None

    def label(self, file: Path) -> str:
        """Return the name of a file of this revision in messages."""
        return f"{self.name}:{shown(file)}"

    def read(self, file: Path) -> bytes:
        """Return the content of a file in this revision. Raises SourceError if there is none."""
        content = self.contents([file]).get(file)
        if content is None:
            message = f"{shown(file)} does not exist in revision {self.name!r}"
            hint = "if it had another path then, save it with `git show REVISION:PATH > FILE`, and use --against ./FILE"
            raise SourceError.of("not-in-revision", message, self.label(file), hint=hint)
        return content

    def holds(self, file: Path) -> bool:
        """Return whether a revision of this repository can have a file at this path; False inside of a submodule."""
        path = Path(real(file))
        if self.top not in path.parents:
            return False
        inside = itertools.takewhile(lambda folder: folder != self.top, path.parents)
        return not any(Path(place(folder / ".git")).exists() for folder in inside)

    def contents(self, files: Sequence[Path]) -> Mapping[Path, bytes]:
        """Return the contents of those files that this revision has.

        Raises SourceError if the clone lacks a content.
        """
        import pygit2

        contents = {}
        for file in filter(self.holds, files):
            path = Path(real(file)).relative_to(self.top).as_posix()
            try:
                entry = self._tree[path]
            except KeyError:
                continue
            try:
                if isinstance(entry, pygit2.Blob):
                    contents[file] = entry.data
            except (pygit2.GitError, KeyError) as problem:
                message, hint = f"git does not have its content: {problem}", "fetch it, or use --against ./FILE"
                raise SourceError.of("git", message, self.label(file), hint=hint) from None
        return contents

    def export(self, folder: Path) -> None:
        """Write all files of this revision to a folder, as a checkout does, without submodules.

        Raises SourceError if the clone lacks a content.
        """
        import pygit2

        kinds = pygit2.enums.CheckoutStrategy
        try:
            strategy = kinds.FORCE | kinds.DONT_UPDATE_INDEX
            self.repository.checkout_tree(self._tree, directory=str(folder), strategy=strategy)  # type: ignore[no-untyped-call]
        except (pygit2.GitError, KeyError, OSError) as problem:
            message, hint = f"revision {self.name!r} can't be checked out: {problem}", "fetch it, or name another one"
            raise SourceError.of("git", message, hint=hint) from None

    def locate(self, dependencies: Sequence[Dependency], scratch: Path) -> Sequence[Dependency]:
        """Replace candidates by this revision's files; candidates outside of the repository stay.

        This writes files that are missing or different on disk to `scratch`.
        """
        held = {path for dependency in dependencies for path in dependency.candidates if self.holds(path)}
        places = {}
        for number, (path, content) in enumerate(self.contents(sorted(held)).items()):
            places[path] = path if _is_on_disk(path, content) else scratch / str(number) / path.name
            if places[path] != path:
                places[path].parent.mkdir()
                places[path].write_bytes(content)
        located = []
        for dependency in dependencies:
            paths = tuple(
                places.get(path, path) for path in dependency.candidates if path in places or path not in held
            )
            located.append(msgspec.structs.replace(dependency, candidates=paths))
        return located


def _is_on_disk(path: Path, content: bytes) -> bool:
    """Return whether the file on disk has this content; for a Git LFS pointer, the content that the pointer names."""
    try:
        now, pointer = read_unrecorded(path), _LFS_POINTER.match(content)
    except OSError:
        return False
    return now == content or (pointer is not None and digest(now) == pointer[1].decode())
