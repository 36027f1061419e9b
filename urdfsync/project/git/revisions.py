"""Reads git revisions: single files, or a whole revision in the place of the working tree.

libgit2 reads the object database: this runs no program, fetches nothing, and changes nothing in the repository.
"""

from __future__ import annotations

import contextlib
import itertools
import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from urdfsync.common.dependencies.facts import MAX_FILE
from urdfsync.common.dependencies.places import Clone, named, place
from urdfsync.common.diagnostics import SourceError
from urdfsync.common.files import digest, shown

if TYPE_CHECKING:
    import pygit2

_HINT = "name an existing file, or a branch, tag or commit such as HEAD~1"
_LFS_POINTER = re.compile(rb"version https://git-lfs.*^oid sha256:([0-9a-f]{64})$", re.DOTALL | re.MULTILINE)
"""Content of a Git LFS pointer in git."""
_MOST_LINKS = 40
"""The greatest number of links in a path, as on Linux. A longer chain has no end."""


def open_repository(folder: Path) -> pygit2.Repository | None:
    """Return the repository around a folder; None if there is none. Raises SourceError for an unreadable repository."""
    import pygit2  # takes 55 ms: a comparison with the last build does not need it

    from urdfsync.project import git  # likewise

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
        self.top = named(os.path.realpath(repository.workdir))
        self._inside = Clone(self.top, self.top).inside
        try:
            self._tree = repository.revparse_single(name).peel(pygit2.Commit).tree
        except (pygit2.GitError, KeyError, ValueError):
            message = f"{name!r} is neither a file nor a revision of the git repository {self.top}"
            raise SourceError.of("unknown-revision", message, hint=_HINT) from None

    def read(self, file: Path) -> bytes:
        """Return the content of a file in this revision. Raises SourceError if there is none."""
        content = self.find(str(file))
        if not isinstance(content, bytes):
            message = f"{shown(file)} does not exist in revision {self.name!r}"
            hint = "if it had another path then, save it with `git show REVISION:PATH > FILE`, and use --against ./FILE"
            raise SourceError.of("not-in-revision", message, f"{self.name}:{shown(file)}", hint=hint)
        return content

    def find(self, path: str, links: int = _MOST_LINKS) -> bytes | list[str] | None:
        """Return the content of a file, or the names of files and folders in a folder, which end with a slash.

        Return None for neither. Links on the way are those of the revision; if it has nothing there, those of the
        working tree. Raises SourceError if the clone lacks a content.
        """
        import pygit2

        if (inside := self._inside(path)) is None or not links:
            return None
        link = pygit2.enums.FileMode.LINK
        entry: pygit2.Object | None = self._tree
        names = PurePosixPath(inside).parts
        try:
            for depth, name in enumerate(names):
                entry = entry / name if isinstance(entry, pygit2.Tree) and name in entry else None
                if isinstance(entry, pygit2.Blob) and entry.filemode == link:
                    target = Path(self.top, *names[:depth], os.fsdecode(entry.data), *names[depth + 1 :])
                    return self.find(os.path.normpath(target), links - 1)
            if isinstance(entry, pygit2.Tree):
                entries = (each for each in entry if each.filemode != link)
                return [f"{each.name}{'' if isinstance(each, pygit2.Blob) else '/'}" for each in entries]
            if isinstance(entry, pygit2.Blob):
                return memoryview(entry)[: MAX_FILE + 1].tobytes()  # readers refuse more
        except (pygit2.GitError, KeyError) as problem:
            message, hint = f"git does not have its content: {problem}", "fetch it, or use --against ./FILE"
            raise SourceError.of("git", message, f"{self.name}:{shown(path)}", hint=hint) from None
        end = os.path.realpath(path)
        return self.find(end, links - 1) if entry is None and end != path else None

    def holds(self, path: str | Path) -> bool:
        """Return whether a revision of this repository can have a file at this path; False inside of a submodule."""
        end, top = Path(os.path.realpath(path)), Path(self.top)
        inside = itertools.takewhile(lambda folder: folder != top, (end, *end.parents))
        return top in end.parents and not any((folder / ".git").exists() for folder in inside)

    @contextlib.contextmanager
    def view(self) -> Iterator[None]:
        """Let the program find the files of this revision in the place of the working tree's, in a `with` block.

        Messages name them as git does, `HEAD:arm.urdf`. Submodules and other repositories inside are those on disk. A
        folder may list further names of files that are only on disk: the view does not have these files.
        """
        with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder, _View(self, folder):
            yield

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


class _View(Clone):
    """A clone of a revision that gets a file or folder when it is asked for: the others may be many, and large.

    It gets no links. A folder is that on disk if it has all names: writing 20,000 names takes seconds. Processes that
    this program starts can't ask for files.
    """

    def __init__(self, revision: Revision, folder: str) -> None:
        super().__init__(revision.top, os.path.realpath(folder))
        self.label = f"{revision.name}:"
        self._revision = revision
        self._places: dict[str, str] = {}
        """Places of all paths that were asked for."""

    def place(self, path: str) -> str:
        """Return where to find the file or folder at a path, once it is written; on disk if the repository lacks it."""
        if path not in self._places:
            content, copy = self._revision.find(path), super().place(path)
            is_elsewhere = _is_on_disk(path, content) if content is not None else not self._revision.holds(path)
            if content is not None and not is_elsewhere:
                _write(Path(copy), content)
            self._places[path] = path if is_elsewhere else copy
        return self._places[path]


def _write(place: Path, content: bytes | list[str]) -> None:
    """Write a file; or a folder, with empty files and folders of these names."""
    folder = place if isinstance(content, list) else place.parent
    folder.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        place.write_bytes(content)
        return
    for path, name in ((place / name, name) for name in content):
        if path.parent == place and path.name not in ("..", ".git"):  # a stranger may have made the folder
            path.mkdir(exist_ok=True) if name.endswith("/") else path.touch()


def _is_on_disk(path: str, content: bytes | list[str]) -> bool:
    """Return whether a folder on disk has all names, or the content is a Git LFS pointer to the file on disk."""
    if isinstance(content, list):  # others do no harm: the files of this folder are asked for, too
        with contextlib.suppress(OSError), os.scandir(path) as entries:
            return {f"{entry.name}{'/' * entry.is_dir()}" for entry in entries}.issuperset(content)
        return False
    pointer = _LFS_POINTER.match(content)
    return pointer is not None and Path(path).is_file() and digest(Path(path).read_bytes()) == pointer[1].decode()
