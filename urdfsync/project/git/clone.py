"""Exports git's index to a clone for the hook: a fresh clone of the next commit would have the same files.

The clone is in `urdfsync/` in the folder of the repository, or of its working tree; nobody else uses it. It is a
repository of its own that borrows the objects of the user's repository. So git itself does what it does in each clone:
links, modes, filters, line ends. The settings and attributes of the user's own clone do not count there. Git rewrites
only the files that differ from the last export. Of links, those that lead out of the repository get a target that means
the same in the clone. The user's index and objects are never written.
"""

from __future__ import annotations

import contextlib
import enum
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies import localfile
from urdfsync.common.dependencies.places import Clone
from urdfsync.common.diagnostics import SourceError
from urdfsync.common.files import digest, relative
from urdfsync.project.git import GitError, Repository, hook, list_paths, run
from urdfsync.project.state.lock import Lock

_FOLDER, _LINK, _SUBMODULE = "040000", "120000", "160000"
_MOST_OBJECTS = 20
"""A clone with more objects in one of 256 folders is made anew: each export adds some, and git never deletes them."""


class PathChange(enum.Enum):
    """What a commit changes at a path."""

    CONTENT = enum.auto()
    FILE = enum.auto()
    """A file or a link is new, or deleted."""
    FOLDER = enum.auto()
    """A folder or a submodule is new, or deleted: also if a file takes its place."""


class Commit(msgspec.Struct, frozen=True):
    """The next commit of a repository, as a clone."""

    repository: Repository
    clone: Clone
    configurations: Sequence[str]
    lost: Sequence[str]
    """The configurations on disk that the commit lacks, although it has their states."""
    files: frozenset[str]
    """All files, links and submodules of the commit. All paths are from the top."""
    changed: Mapping[str, PathChange] | None
    """The files, links and submodules that the commit changes. A folder counts if its first file is new, or its last
    file is deleted. None without a former commit."""


@contextlib.contextmanager
def export(repository: Repository, wait: float) -> Iterator[Commit]:
    """Export the index, and keep other hooks from the clone during a `with` block.

    Raises GitError, LockedError after `wait` seconds, and SourceError while files are unmerged.
    """
    folder = Path(repository.folder, "urdfsync")
    with Lock(folder / "lock", wait) as lock:
        lock.acquire()
        yield _export(repository, folder)


def _export(repository: Repository, folder: Path) -> Commit:
    record, clone, index = folder / "exported", str(folder / "clone"), folder / "index"
    former = (localfile.read(record) or b"").decode(errors="replace")
    record.unlink(missing_ok=True)  # if this process is killed, the next hook begins anew
    if not former or len(_names(f"{clone}/.git/objects/17")) > _MOST_OBJECTS:
        former = ""
        _remove(clone)
    _prepare(clone, repository.objects)
    content = hook.read_index(repository)
    index.write_bytes(content) if content else index.unlink(missing_ok=True)
    tree = _write_tree(clone, index)
    entries = _list(clone, tree)
    modules, names = _find_submodules(clone, tree, entries), [path for path, _, _ in entries]
    attributes = [entry for entry in entries if entry[0].rpartition("/")[2] == ".gitattributes"]
    settings = run("config", "--list", clone=clone)
    conversions = digest(f"{attributes}{settings}{[*modules]}".encode(errors="surrogateescape"))
    if former and former != conversions:  # git would rewrite only files with another content
        for name in _names(clone):
            _remove(f"{clone}/{name if name != '.git' else '.git/index'}")
    run("read-tree", "-u", "--reset", tree, clone=clone)
    view = Clone(repository.top, clone)
    _relink(view, [path for path, mode, _ in entries if mode == _LINK])
    is_complete = _export_submodules(clone, modules, repository.folder, repository.top)
    localfile.replace(str(record), conversions.encode())
    configurations, lost = hook.find_configurations(names)
    if is_complete:
        hook.remember(repository, content, configurations, lost)
    lost = [path for path in lost if Path(repository.top, path).is_file()]
    head = _find_head()
    changed = dict(_changes(clone, head, tree)) if head else None
    return Commit(repository, view, configurations, lost, frozenset(names), changed)


def _write_tree(clone: str, index: Path) -> str:
    """Write the tree of an index, a copy of the user's, to the objects of the clone. Raises GitError, SourceError."""
    try:
        return run("write-tree", GIT_OBJECT_DIRECTORY=f"{clone}/.git/objects", GIT_INDEX_FILE=str(index)).strip()
    except GitError:
        for entry in list_paths("ls-files", "--unmerged", "--", ":/"):
            message, hint = "the file is not merged yet, so there is nothing to commit", "resolve it and `git add` it"
            raise SourceError.of("unmerged", message, entry.partition("\t")[2], hint=hint) from None
        raise


def _prepare(clone: str, objects: str) -> None:
    """Make the repository of a clone, unless it exists, and let it borrow objects from a folder."""
    if not Path(clone, ".git").is_dir():
        Path(clone).mkdir(parents=True, exist_ok=True)
        kind = run("rev-parse", "--show-object-format").strip()
        run("init", "-q", "--template=", f"--object-format={kind}", clone=clone)
    Path(clone, ".git/index.lock").unlink(missing_ok=True)  # git was killed
    borrowed = Path(clone, ".git/objects/info/alternates")
    borrowed.parent.mkdir(exist_ok=True)
    # relative, so that the user can move the repository; as bytes, since git takes no other line ends
    borrowed.write_bytes(os.fsencode(relative(objects, f"{clone}/.git/objects").replace(os.sep, "/") + "\n"))


def _find_head() -> str | None:
    """Return the commit that HEAD names; None if there is none yet."""
    try:
        return run("rev-parse", "-q", "--verify", "HEAD").strip()
    except GitError:
        return None


def _list(clone: str, tree: str) -> list[tuple[str, str, str]]:
    """Return path, mode and hash of all files, links and submodules in a tree."""
    lines = (line.partition("\t") for line in list_paths("ls-tree", "-r", "--full-tree", tree, clone=clone))
    return [(path, facts.split()[0], facts.split()[2]) for facts, _, path in lines]


def _changes(clone: str, commit: str, tree: str) -> Iterator[tuple[str, PathChange]]:
    """Yield the paths that differ in two trees, as in `Commit.changed`."""
    lines = list_paths("diff-tree", "-r", "-t", "--raw", "--no-renames", f"{commit}^{{tree}}", tree, clone=clone)
    for facts, path in zip(lines[::2], lines[1::2], strict=True):
        modes = {facts[1:7], facts[8:14]}
        if modes != {_FOLDER}:
            is_folder = not modes.isdisjoint({_FOLDER, _SUBMODULE})
            yield path, PathChange.CONTENT if len(modes) == 1 else PathChange.FOLDER if is_folder else PathChange.FILE


def _find_submodules(clone: str, tree: str, entries: Iterable[tuple[str, str, str]]) -> dict[str, tuple[str, str]]:
    """Return commit and name of each submodule that a clone would have, by path.

    A repository without an entry in `.gitmodules` is an empty folder in clones.
    """
    commits = {path: sha for path, mode, sha in entries if mode == _SUBMODULE}
    if not commits:
        return {}
    try:
        lines = list_paths("config", "--list", "--blob", f"{tree}:.gitmodules", clone=clone)
    except GitError:  # there is no such file, or it is damaged
        return {}
    settings = dict(line.split("\n", 1) for line in lines if "\n" in line)
    names = {path: key[10:-5] for key, path in settings.items() if key.startswith("submodule.") and key[-5:] == ".path"}
    return {
        path: (sha, names[path])
        for path, sha in commits.items()
        if path in names and settings.get(f"submodule.{names[path]}.update") != "none"
    }


def _relink(view: Clone, links: Iterable[str]) -> None:
    """Let links that lead out of the repository, or back into it by an absolute path, mean the same in the clone."""
    for path in links:
        link = Path(view.folder, path)
        if not link.is_symlink():
            continue  # a system without links has a file
        text = link.readlink()
        target = Path(os.path.normpath(Path(view.top, path).parent / text))
        if text.is_absolute() or not target.is_relative_to(view.top):
            link.unlink()
            link.symlink_to(view.place(str(target)))


def _export_submodules(clone: str, modules: Mapping[str, tuple[str, str]], folder: str, top: str = "") -> bool:
    """Export the submodules of a clone from the repository at `folder`, which has a working tree at `top` if any.

    Returns whether all were at hand, with those inside of them.
    """
    common = Path(folder, "commondir")  # of a working tree of `git worktree`: that of the whole repository
    homes = [folder, *([str(Path(folder, common.read_text().strip()))] if common.is_file() else [])]
    are_exported = []  # all of them, even if one is missing
    for path, (commit, name) in modules.items():
        places = [*([f"{top}/{path}/.git"] if top else []), *(f"{home}/modules/{name}" for home in homes)]
        are_exported.append(_export_submodule(f"{clone}/{path}", commit, places))
    return all(are_exported)


def _export_submodule(clone: str, commit: str, folders: Iterable[str]) -> bool:
    """Export a commit of a submodule from the first of these repositories that has it; return whether all is at hand.

    Otherwise the folder is empty, as in a clone without its submodules.
    """
    head = Path(clone, ".git/HEAD")
    if head.is_file() and head.read_text().strip() == commit:
        return True
    _remove(clone)
    Path(clone).mkdir()
    for place in filter(os.path.exists, folders):
        with contextlib.suppress(GitError):
            words = "rev-parse", "--absolute-git-dir", "--git-path", "objects", f"{commit}^{{commit}}"
            folder, objects, _ = run(*words, clone=clone, GIT_DIR=place).splitlines()
            break
    else:
        return False
    _prepare(clone, os.path.realpath(objects))
    run("read-tree", "-u", "--reset", commit, clone=clone)
    is_complete = _export_submodules(clone, _find_submodules(clone, commit, _list(clone, commit)), folder)
    if is_complete:
        head.write_text(f"{commit}\n")  # at last: otherwise the next hook exports it again
    return is_complete


def _remove(path: str) -> None:
    """Remove a file, or a folder with all that is in it, if it exists."""
    place = Path(path)
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)


def _names(folder: str) -> list[str]:
    """Return the names in a folder; none if it is missing."""
    return [path.name for path in Path(folder).iterdir()] if Path(folder).is_dir() else []
