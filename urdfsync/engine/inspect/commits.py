"""Finds earlier states of a robot's package in commits: the branches and commits that an edit may come from."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.common.dependencies import reads
from urdfsync.common.diagnostics import SourceError
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.modelica.stamp import Stamp, split
from urdfsync.project import git
from urdfsync.project.git.revisions import Revision, open_repository

if TYPE_CHECKING:
    import pygit2

_MOST = 50
"""The greatest number of branches that are searched, and the most commits that were checked out last."""


class PastCommit(msgspec.Struct, frozen=True):
    """A commit that an edit may come from. What the clone lacks, or what can't be read, counts as missing."""

    _revision: Revision
    _files: PackageFiles

    def texts(self, keys: Iterable[str]) -> dict[str, tuple[str, Stamp | None]]:
        """Return the bare texts and the stamps of files of the package, by key."""
        try:
            found = {key: self._revision.find(str(self._files.path(key))) for key in keys}
        except SourceError:
            return {}
        contents = {key: content for key, content in found.items() if isinstance(content, bytes)}
        return {key: split(plain(content.decode(errors="replace"))) for key, content in contents.items()}

    def beside(self, key: str) -> list[str]:
        """Return the keys of all files of the package in the folder of a file."""
        folder = key.rpartition("/")[0]
        try:
            found = self._revision.find(str(self._files.path(folder)))
        except SourceError:
            return []
        return [f"{folder}/{name}" for name in found if not name.endswith("/")] if isinstance(found, list) else []


def read_commits(root: Path, files: PackageFiles) -> Iterator[PastCommit]:
    """Yield the commits that an edit may have been picked from: of branches, and those that were checked out last."""
    if git.find_top(root) is None:
        return
    reads.cannot_record()  # branches come and go without a change of a file
    try:
        repository = open_repository(root)
    except SourceError:  # the repository can't be read: for example, it belongs to another user
        return
    if repository is None or repository.is_empty or repository.head_is_unborn:
        return
    # after a squash, the branch may be deleted: look at the commits that were checked out last
    recent = itertools.islice(repository.lookup_reference("HEAD").log(), _MOST)
    names = [
        "ORIG_HEAD",
        "CHERRY_PICK_HEAD",
        "REBASE_HEAD",
        "MERGE_HEAD",
        "refs/stash",
        *(str(entry.oid_new) for entry in recent),
    ]
    names += [name for name in repository.references if name.startswith(("refs/heads/", "refs/remotes/"))][:_MOST]
    for commit in dict.fromkeys(filter(None, (_commit_id(repository, name) for name in names))):
        with contextlib.suppress(SourceError):  # there is no such commit
            yield PastCommit(Revision(root, commit), files)


def _commit_id(repository: pygit2.Repository, name: str) -> str:
    """Return the hash of a commit; empty if there is none."""
    import pygit2

    try:
        return str(repository.revparse_single(name).peel(pygit2.Commit).id)
    except (KeyError, ValueError, pygit2.GitError):
        return ""


def plain(text: str) -> str:
    """Return the text with line feeds as line ends."""
    return text.replace("\r\n", "\n")
