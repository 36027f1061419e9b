"""Looks at a clone in place of a repository, so that the program finds what it would find in a clone at that place.

The hook judges a commit before it exists: git checks the index out to a clone (see `git.clone`), and `facts` looks
there. All other code uses the paths of the user's repository. So messages name the user's files, the recorded state
names files beside the repository as always, and a search for packages comes from the repository into what is around it.
The system follows the links of the clone; `git.clone` has changed those that lead out of the repository.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from typing import Self

_VARIABLES = "URDFSYNC_TOP", "URDFSYNC_CLONE"
"""Environment variables that tell processes which this program starts about the clone."""
_PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
_PROGRAM = (
    *(path for path in sys.path if os.path.basename(path) in ("site-packages", "dist-packages")),
    _PACKAGE,
    os.path.join(os.path.dirname(_PACKAGE), "templates"),
)
"""Folders of the program: they may be in the user's repository, and no commit has them."""


class Clone:
    """A clone at `folder` that stands for the repository at `top`; both are absolute and without links."""

    label = ""
    """What messages put before the names of its files."""

    def __init__(self, top: str, folder: str) -> None:
        self.top, self.folder = top, folder
        self._below = os.path.join(top, "")
        program = (os.path.join(os.path.realpath(path), "") for path in _PROGRAM)
        self._program = tuple(path for path in program if path.startswith(self._below))
        self._outside: dict[str, str] = {}
        """Each folder that is named outside of the repository, without links."""

    def __enter__(self) -> Self:
        """Look at this clone from now on, also in processes that this program starts."""
        global _current
        _current = self
        os.environ.update(zip(_VARIABLES, (self.top, self.folder), strict=True))
        return self

    def __exit__(self, *_: object) -> None:
        global _current
        _current = None
        for name in _VARIABLES:
            del os.environ[name]

    def place(self, path: str) -> str:
        """Return where to find the file at a path: in the clone, or outside of the repository."""
        if path.startswith(self._below) and ".." not in path and not self._program:  # robots have thousands of files
            return self.folder + path[len(self.top) :]
        return path if (rest := self._rest(path)) is None else self.folder + rest

    def inside(self, path: str) -> str | None:
        """Return the path from the top of the repository, as in git; None for a path that leads elsewhere."""
        rest = self._rest(path)
        return None if rest is None else os.path.normpath(rest)[1:].replace(os.sep, "/")

    def _rest(self, path: str) -> str | None:
        """Return the end of a path into the repository, behind the top; None for a path that leads elsewhere."""
        if not os.path.isabs(path):
            path = os.path.join(os.getcwd(), path)
        normal = os.path.normpath(path) if ".." in path else path
        if not self._is_below(normal):
            folder, name = os.path.split(normal)
            if folder not in self._outside:
                self._outside[folder] = os.path.realpath(folder)
            path = normal = os.path.join(self._outside[folder], name)
        if not self._is_below(normal) or (self._program and os.path.join(normal, "").startswith(self._program)):
            return None
        return (path if self._is_below(path) else normal)[len(self.top) :]

    def _is_below(self, path: str) -> bool:
        return path.startswith(self._below) or path == self.top


_current: Clone | None = Clone(*map(os.environ.__getitem__, _VARIABLES)) if _VARIABLES[1] in os.environ else None


def is_clone() -> bool:
    """Return whether the program looks at a clone."""
    return _current is not None


def label(path: str) -> str:
    """Return what messages put before the name of a file: that of a revision, or nothing."""
    return _current.label if _current is not None and _current.label and _current.inside(path) is not None else ""


def place(path: str | os.PathLike[str]) -> str:
    """Return where to find the file at a path; without a clone, the path itself."""
    return os.fspath(path) if _current is None else _current.place(os.fspath(path))


def real(path: str | os.PathLike[str]) -> str:
    """Return a path without links, as `os.path.realpath`; in a clone, as in the repository."""
    return named(os.path.realpath(place(path)))


def named(path: str) -> str:
    """Return the path in the repository of a result of `place`."""
    if _current is None or not os.path.join(path, "").startswith(os.path.join(_current.folder, "")):
        return path
    return _current.top + path[len(_current.folder) :]
