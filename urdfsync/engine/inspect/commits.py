"""Finds earlier states of a robot's package in commits: the branches and commits that an edit may come from."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync import git
from urdfsync.dependencies import reads
from urdfsync.diagnostics import SourceError, StateError
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.state import bases, statefile
from urdfsync.state.record import Record
from urdfsync.state.store import Store

if TYPE_CHECKING:
    from urdfsync.git.revisions import Revision

_MOST = 50
"""The greatest number of branches that are searched, and the most commits that were checked out last."""
_BACK = 10
"""The greatest number of commits that are searched, counted back from HEAD."""


class CommittedBuild(msgspec.Struct, frozen=True, dict=True):
    """A robot's package and record in a commit. What the clone lacks, or what can't be read, counts as missing."""

    _revision: Revision
    _files: PackageFiles
    _store: Store
    _name: str
    """The robot's name in the last build."""

    def texts(self, keys: Iterable[str]) -> dict[str, str]:
        """Return the texts of files of the package, by key."""
        paths = {key: self._files.path(key) for key in keys}
        contents = self._contents(*paths.values())
        return {key: contents[path].decode(errors="replace") for key, path in paths.items() if path in contents}

    @cached_property
    def record(self) -> Record | None:
        """The robot's record."""
        place = self._store.path(self._name)
        content = self._contents(place).get(place)
        try:
            label = self._revision.label(place)
            return None if content is None else statefile.loads(content.decode(errors="replace"), label)[0]
        except StateError:
            return None

    def base(self, sha256: str) -> str | None:
        """Return the generated text with this hash."""
        file = self._store.base_file(self._name, sha256[0])
        return bases.loads(self._contents(file).get(file, b"")).get(sha256)

    def _contents(self, *paths: Path) -> dict[Path, bytes]:
        try:
            return dict(self._revision.contents(list(paths)))
        except SourceError:
            return {}


def find_commits(inputs: Inputs) -> Iterator[CommittedBuild]:
    """Yield the commits that an edit may come from: merged ones, and recent ones if this machine has built here."""
    if (top := git.find_top(inputs.config.root)) is None:
        return
    reads.depend_on_commits(top)
    import pygit2  # takes 55 ms, which most builds save

    from urdfsync.git.revisions import Revision, open_repository

    root = inputs.config.root
    try:
        repository = open_repository(root)
    except SourceError:  # the repository can't be read: for example, it belongs to another user
        return
    if repository is None or repository.is_empty or repository.head_is_unborn:
        return
    names = ["MERGE_HEAD", *(str(parent) for parent in repository.head.peel(pygit2.Commit).parent_ids)]
    if inputs.last.notes.model:
        names += [f"HEAD~{number}" for number in range(2, _BACK)]
        # after a squash, the branch may be deleted: look at the commits that were checked out last
        recent = itertools.islice(repository.lookup_reference("HEAD").log(), _MOST)
        names += ["ORIG_HEAD", "CHERRY_PICK_HEAD", "REBASE_HEAD", *(str(entry.oid_new) for entry in recent)]
        names += [name for name in repository.references if name.startswith(("refs/heads/", "refs/remotes/"))][:_MOST]
    for name in dict.fromkeys(names):
        try:
            yield CommittedBuild(Revision(root, name), inputs.files, inputs.store, inputs.last.name)
        except SourceError:  # there is no such commit
            continue
