"""Looks at the disk that a decision rests on, taken down while somebody wants to know them.

Whatever decides whether there is anything to do looks at files and folders with these functions, and with `Tree`,
which is made of them. So nobody has to keep a second list of what a decision depends on.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import TypeAlias

Facts: TypeAlias = tuple[int, int, int, int, int, int]
"""Of a file or folder: mode, inode, device, size in bytes, and the times of change of content and status in ns."""
NO_FACTS: Facts = (0, 0, 0, 0, 0, 0)
"""What the system says of nothing that there is."""

_FOLDER = getattr(os, "O_PATH", os.O_RDONLY) | getattr(os, "O_DIRECTORY", 0)
"""How a folder is opened to look at files in it; where it can't be, they are looked at by their paths."""
_ABSENT = (errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.EBADF)
"""What the system says of a path at which nothing is; the same as for pathlib."""


class Looks:
    """What was seen, by absolute path; in each pair the first mapping is of links themselves, the second of targets."""

    def __init__(self) -> None:
        self.contents: tuple[dict[str, Facts], dict[str, Facts]] = {}, {}
        """Files that were read, and folders of which all entries were seen."""
        self.kinds: tuple[dict[str, int], dict[str, int]] = {}, {}
        """Where it only mattered what is there: the file type, or 0 for nothing."""
        self.complete = True
        """Whether that is all, and nothing was in doubt."""

    def content(self, path: str | os.PathLike[str], status: os.stat_result, follow: bool) -> None:
        """Take down that a file is read, or the entries of a folder; `status` is from before that."""
        facts = facts_of(status)
        if self.contents[follow].setdefault(os.fspath(path), facts) != facts:
            self.complete = False  # it changes while we look

    def kind(self, path: str | os.PathLike[str], kind: int, follow: bool) -> None:
        """Take down what is at a path."""
        if self.kinds[follow].setdefault(os.fspath(path), kind) != kind:
            self.complete = False


_looks: ContextVar[Looks | None] = ContextVar("looks", default=None)


@contextlib.contextmanager
def taken_down() -> Iterator[Looks]:
    """Take down all looks of this thread until the end."""
    looks = Looks()
    token = _looks.set(looks)
    try:
        yield looks
    finally:
        _looks.reset(token)


def beyond() -> None:
    """Say that something other than these looks decides: what was taken down is not all."""
    if (looks := _looks.get()) is not None:
        looks.complete = False


def facts_of(status: os.stat_result) -> Facts:
    """What tells a changed file from an unchanged one."""
    return status.st_mode, status.st_ino, status.st_dev, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def kind(path: str | os.PathLike[str], *, follow: bool = True) -> int:
    """The file type (see `stat.S_IFMT`) of what is at a path; 0 for nothing. Raises OSError if that can't be told."""
    try:
        found = stat.S_IFMT(os.stat(path, follow_symlinks=follow).st_mode)  # noqa: PTH116 - path may be a string
    except OSError as error:
        if error.errno not in _ABSENT:
            beyond()
            raise
        found = 0
    if (looks := _looks.get()) is not None:
        looks.kind(path, found, follow)
    return found


def is_file(path: str | os.PathLike[str]) -> bool:
    """Whether a regular file is at a path. Raises OSError if that can't be told."""
    return kind(path) == stat.S_IFREG


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Whether a folder is at a path. Raises OSError if that can't be told."""
    return kind(path) == stat.S_IFDIR


def content(path: str | os.PathLike[str]) -> bytes:
    """A file's content. Raises OSError if it can't be read."""
    if (looks := _looks.get()) is not None:
        _see(looks, path)
    with open(path, "rb", buffering=0) as file:  # noqa: PTH123 - many, and on the way of every build
        return file.read()


def status(path: str | os.PathLike[str]) -> os.stat_result | None:
    """What is at a path itself, links not followed, before its content is read; None for nothing. Raises OSError."""
    looks = _looks.get()
    try:
        found = os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        if looks is not None:
            looks.kind(path, 0, follow=False)
        return None
    except OSError:
        beyond()
        raise
    if looks is not None:
        looks.content(path, found, follow=False)
    return found


@contextlib.contextmanager
def within(folder: str) -> Iterator[Callable[[str], os.stat_result | None]]:
    """The `status` of files in a folder by their names: of thousands, that is a quarter quicker than by their paths."""
    looks, stat_ = _looks.get(), os.stat
    with contextlib.ExitStack() as stack:
        descriptor = -1

        def found(name: str) -> os.stat_result | None:
            nonlocal descriptor
            try:
                if descriptor < 0:
                    descriptor = os.open(folder, _FOLDER)
                    stack.callback(os.close, descriptor)
                seen = stat_(name, dir_fd=descriptor, follow_symlinks=False)
            except (OSError, NotImplementedError):
                return status(f"{folder}{os.sep}{name}")
            if looks is not None:
                looks.content(f"{folder}{os.sep}{name}", seen, follow=False)
            return seen

        yield found


def names(folder: str | os.PathLike[str]) -> list[str]:
    """The names in a folder, in no order. Raises OSError if it can't be read."""
    if (looks := _looks.get()) is not None:
        _see(looks, folder)
    return os.listdir(folder)  # noqa: PTH208 - a fifth of the time, on the way of every build


def rests_on(path: str | os.PathLike[str]) -> None:
    """Take down that a file is about to be read by other means, or the names in a folder."""
    if (looks := _looks.get()) is not None:
        with contextlib.suppress(OSError):  # whoever looks will see that, too
            _see(looks, path)


def files_below(folder: str | os.PathLike[str]) -> Iterator[str]:
    """All regular files below a folder, and links to such files."""
    waiting = [os.fspath(folder)]
    while waiting:
        current = waiting.pop()
        inside: list[str] = []
        with contextlib.suppress(OSError):  # it is not there, or can't be read
            inside = names(current)
        for path in [f"{current}{os.sep}{name}" for name in inside]:
            found = kind(path)
            if found == stat.S_IFREG:
                yield path
            elif found == stat.S_IFDIR and os.path.islink(path):  # noqa: PTH114 - it is a string
                rests_on(path)
            elif found == stat.S_IFDIR:
                waiting.append(path)


def _see(looks: Looks, path: str | os.PathLike[str]) -> None:
    try:
        looks.content(path, os.stat(path), follow=True)  # noqa: PTH116
    except (FileNotFoundError, NotADirectoryError):
        looks.kind(path, 0, follow=True)
        raise
    except OSError:
        looks.complete = False
        raise
