"""The identity of the program: results of another program, or of another version of a package, do not count."""

from __future__ import annotations

import os
import sys

from urdfsync.common.dependencies.facts import checksum, read_unrecorded
from urdfsync.common.version import __version__

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from collections.abc import Iterator

_PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(__file__)))
_SUFFIXES = (".py", ".jinja", ".mo")
_identities: dict[tuple[str, ...], str] = {}
"""The identities by places of further code: a process keeps its loaded code."""


def identity(*others: str) -> str:
    """Return a text that differs after a change of urdfsync, of Python, of a package, or of the code at other places.

    It follows from names, sizes and times of code and templates. Files beside them, such as byte code, do not matter.
    """
    if others not in _identities:
        # on Windows, a listing has these values already: 430 calls of `stat` would take 100 ms
        facts = ((path, entry.stat() if entry else os.stat(path)) for path, entry in _files(*_own(), *others))
        files = (f"{path} {status.st_size} {status.st_mtime_ns}" for path, status in facts)
        _identities[others] = repr(checksum((_versions(), *files)))
    return _identities[others]


def contents_hash(*others: str) -> str:
    """Return a hash that is the same for the same program on each machine: of contents in place of sizes and times."""
    from hashlib import sha256

    files = _files(*_own(), *others)
    hashes = (f"{os.path.basename(path)} {sha256(read_unrecorded(path)).hexdigest()}" for path, _ in files)
    return sha256(repr((_versions(), sorted(hashes))).encode(errors="surrogateescape")).hexdigest()


def _versions() -> str:
    """Return the versions of urdfsync and of Python, with the names and versions of all installed packages."""
    packages = set[str]()  # the folders of their metadata
    for folder in sys.path:
        try:
            packages.update(name for name in os.listdir(folder or ".") if name.endswith((".dist-info", ".egg-info")))
        except OSError:
            continue  # an entry of Python's path may be missing, or an archive
    return repr((__version__, sys.version, sys.byteorder, sorted(packages)))


def _own() -> tuple[str, str]:
    """Return the folders of the code and of the templates: of a wheel, or of a clone."""
    inside = os.path.join(_PACKAGE, "_data", "templates")
    return _PACKAGE, inside if os.path.isdir(inside) else os.path.join(os.path.dirname(_PACKAGE), "templates")


def _files(*places: str) -> Iterator[tuple[str, os.DirEntry[str] | None]]:
    """Yield the paths of code and templates, with the entries of those below folders."""
    waiting: list[tuple[str, os.DirEntry[str] | None]] = [(place, None) for place in places]
    while waiting:
        place, found = waiting.pop()
        if place.endswith(_SUFFIXES):
            yield place, found
            continue
        try:
            with os.scandir(place) as scanned:
                entries = list(scanned)
        except OSError:
            continue  # templates may be elsewhere
        for entry in entries:
            # `_data` of a wheel also has the library and pages, which no build reads
            if entry.name.startswith(".") or entry.name in ("__pycache__", "_data"):
                continue
            if entry.name.endswith(_SUFFIXES) or entry.is_dir():
                waiting.append((entry.path, entry))


def user() -> str:
    """Return the identity of the user: another user may not be able to read the same files."""
    if sys.platform == "win32":
        return ""
    return repr((os.geteuid(), os.getegid(), *sorted(os.getgroups())))
