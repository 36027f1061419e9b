"""Finds earlier states of a robot's package in commits: the branches and commits that an edit may come from."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync import git
from urdfsync.dependencies import reads
from urdfsync.diagnostics import SourceError
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.git.revisions import Revision, open_repository
from urdfsync.modelica.stamp import Stamp, split

if TYPE_CHECKING:
    import pygit2

_MOST = 50
"""The greatest number of branches that are searched, and the most commits that were checked out last."""
_HISTORY = 1000
"""The greatest number of commits of HEAD's history that are told from those of other branches."""
_BACK = 10
"""The greatest number of commits, counted back from HEAD, whose parents are searched, too."""


class PastCommit(msgspec.Struct, frozen=True):
    """A commit that an edit may come from. What the clone lacks, or what can't be read, counts as missing."""

    _revision: Revision
    _files: PackageFiles

    def texts(self, keys: Iterable[str]) -> dict[str, tuple[str, Stamp | None]]:
        """Return the bare texts and the stamps of files of the package, by key."""
        paths = {key: self._files.path(key) for key in keys}
        try:
            contents = dict(self._revision.contents([*paths.values()]))
        except SourceError:
            return {}
        found = {key: contents[path] for key, path in paths.items() if path in contents}
        return {key: split(plain(content.decode(errors="replace"))) for key, content in found.items()}


def read_commits(root: Path, files: PackageFiles, *, has_built: bool) -> Iterator[PastCommit]:
    """Yield the commits that an edit may come from: of HEAD, and others if this machine `has_built` here."""
    if (top := git.find_top(root)) is None:
        return
    reads.depend_on_commits(top)

    try:
        repository = open_repository(root)
    except SourceError:  # the repository can't be read: for example, it belongs to another user
        return
    if repository is None or repository.is_empty or repository.head_is_unborn:
        return
    commits = [*(_commit_id(repository, name) for name in ("HEAD", "MERGE_HEAD")), *_recent_parents(repository)]
    if has_built:
        # after a squash, the branch may be deleted: look at the commits that were checked out last
        recent = itertools.islice(repository.lookup_reference("HEAD").log(), _MOST)
        others = ["ORIG_HEAD", "CHERRY_PICK_HEAD", "REBASE_HEAD", *(str(entry.oid_new) for entry in recent)]
        others += [name for name in repository.references if name.startswith(("refs/heads/", "refs/remotes/"))][:_MOST]
        history = _history(repository)  # of which a clone looks for the same commits
        commits += [commit for other in others if (commit := _commit_id(repository, other)) not in history]
    for commit in dict.fromkeys(filter(None, commits)):  # several branches may have one commit
        try:
            yield PastCommit(Revision(root, commit), files)
        except SourceError:  # there is no such commit
            continue


def _recent_parents(repository: pygit2.Repository) -> Iterator[str]:
    """Yield the parents of HEAD and of the commits before it; of a merge, all."""
    import pygit2

    commit = repository.head.peel(pygit2.Commit)
    for _ in range(_BACK):
        yield from map(str, commit.parent_ids)
        before = repository.get(commit.parent_ids[0]) if commit.parent_ids else None
        if not isinstance(before, pygit2.Commit):  # a shallow clone lacks it
            return
        commit = before


def _history(repository: pygit2.Repository) -> set[str]:
    """Return the latest commits of HEAD's history."""
    import pygit2

    found = set[str]()
    with contextlib.suppress(pygit2.GitError, KeyError):  # a shallow clone ends somewhere
        found.update(str(one.id) for one in itertools.islice(repository.walk(repository.head.target), _HISTORY))
    return found


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
