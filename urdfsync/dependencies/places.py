"""Looks at a clone in place of a repository, so that the program finds what it would find in a clone at that place.

The hook judges a commit before it exists: git exports the index to a clone (see `git.clone`), and `facts` looks there.
All other code uses the paths of the user's repository: messages name the user's files, and paths that lead out of the
repository keep their meaning. As with a mounted disk, links, `..` and environment variables that lead into the
repository lead into the clone.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from typing import Self

_VARIABLES = "URDFSYNC_TOP", "URDFSYNC_CLONE"
"""Environment variables that tell processes which this program starts about the clone."""
_MOST_LINKS = 40
"""The greatest number of links in a path, as on Linux. A longer chain has no end."""
_PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_PROGRAM = (
    *(path for path in sys.path if os.path.basename(path) in ("site-packages", "dist-packages")),
    _PACKAGE,
    os.path.join(os.path.dirname(_PACKAGE), "templates"),
)
"""Folders of the program: they may be in the user's repository, and no commit has them."""


class Clone:
    """A clone at `folder` that stands for the repository at `top`; both are absolute and without links.

    Files must not change while it is in use: folders are resolved once.
    """

    def __init__(self, top: str, folder: str) -> None:
        self.top, self.folder = top, folder
        below = os.path.join(top, "")
        self._program = tuple(
            os.path.join(path, "") for path in map(os.path.realpath, _PROGRAM) if path.startswith(below)
        )
        self._folders: dict[str, tuple[str, ...]] = {}
        """The trail of each folder, by absolute path."""
        self._places: dict[str, str] = {}
        """Where to find the files of each folder, by absolute path; empty for folders outside of the clone."""
        self._former: Clone | None = None

    def __enter__(self) -> Self:
        """Look at this clone from now on, also in processes that this program starts."""
        global _current
        self._former, _current = _current, self
        os.environ.update(zip(_VARIABLES, (self.top, self.folder), strict=True))
        return self

    def __exit__(self, *_: object) -> None:
        global _current
        _current = self._former
        for name in _VARIABLES:
            del os.environ[name]

    def trail(self, path: str, *, follow: bool = True, links: int = 0) -> tuple[str, ...]:
        """Return all links that a path leads through, and at last the path without links; all as in the repository.

        With `follow` this also follows a link at the path itself. The files need not exist.
        """
        path = path if os.path.isabs(path) else os.path.join(os.getcwd(), path)
        unknown = [os.path.dirname(path)]  # in a loop: a path may have thousands of folders
        while unknown[-1] not in self._folders and unknown[-1] != os.path.dirname(unknown[-1]):
            unknown.append(os.path.dirname(unknown[-1]))
        for around in reversed(unknown):
            if around not in self._folders:
                self._folders[around] = self._last_step(around, follow=True, links=links)
        return self._last_step(path, follow=follow, links=links)

    def _last_step(self, path: str, *, follow: bool, links: int) -> tuple[str, ...]:
        """Return the result of `trail`, if the folder around the path is resolved."""
        folder, name = os.path.split(path)
        if folder == path:
            return (path,)
        *passed, folder = self._folders[folder]
        if name in ("", "."):
            return (*passed, folder)
        if name == ".." and os.path.isdir(self._at(folder)):
            return (*passed, os.path.dirname(folder))
        place = os.path.join(folder, name)
        if not follow or links > _MOST_LINKS:
            return (*passed, place)
        try:
            target = os.readlink(self._at(place))
        except OSError:  # it is no link
            return (*passed, place)
        return (*passed, place, *self.trail(os.path.join(folder, target), links=links + 1))

    def place(self, path: str, *, follow: bool = True) -> str:
        """Return where to find the file at a path: in the clone, or outside of the repository."""
        if follow:
            return self._at(self.trail(path)[-1])
        folder, _, name = path.rpartition(os.sep)
        if folder not in self._places:
            self._places[folder] = self._find_folder(folder)
        if self._places[folder] and name not in ("", ".", ".."):  # robots have thousands of files
            return f"{self._places[folder]}{os.sep}{name}"
        return self._at(self.trail(path, follow=False)[-1])

    def _find_folder(self, folder: str) -> str:
        """Return where to find the files of a folder; empty if some of them may be elsewhere."""
        if self._program or not os.path.isabs(folder):
            return ""
        place = self.trail(folder)[-1]
        return "" if self.inside(place) is None else self._at(place)

    def inside(self, path: str) -> str | None:
        """Return the path from the top of the repository, as in git, of a path without links; None for one outside."""
        if path != self.top and not path.startswith(os.path.join(self.top, "")):
            return None
        return path[len(self.top) + 1 :].replace(os.sep, "/")

    def _at(self, path: str) -> str:
        """Return where to find the file at a path without links."""
        is_inside = path == self.top or path.startswith(os.path.join(self.top, ""))
        if not is_inside or os.path.join(path, "").startswith(self._program):
            return path
        return self.folder + path[len(self.top) :]


_current: Clone | None = Clone(*map(os.environ.__getitem__, _VARIABLES)) if _VARIABLES[1] in os.environ else None


def is_clone() -> bool:
    """Return whether the program looks at a clone."""
    return _current is not None


def place(path: str | os.PathLike[str], *, follow: bool = True) -> str:
    """Return where to find the file at a path; without a clone, the path itself.

    If `follow` is false, the result may be a link.
    """
    return os.fspath(path) if _current is None else _current.place(os.fspath(path), follow=follow)


def real(path: str | os.PathLike[str]) -> str:
    """Return a path without links, as `os.path.realpath`; in a clone, as in the repository."""
    return os.path.realpath(path) if _current is None else _current.trail(os.fspath(path))[-1]


def named(path: str) -> str:
    """Return the path in the repository of a result of `place`."""
    if _current is None or not os.path.join(path, "").startswith(os.path.join(_current.folder, "")):
        return path
    return _current.top + path[len(_current.folder) :]
