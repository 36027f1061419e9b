"""The identity of the program: results of another program, or of another version of a package, do not count.

It follows from the contents of urdfsync's own code and templates, and from the versions of Python and its packages.
Files beside them, such as byte code, do not matter.
"""

from __future__ import annotations

import os
import sys

from urdfsync.dependencies import localfile
from urdfsync.dependencies.facts import is_young, stat_of
from urdfsync.version import __version__

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

FOLDER = "deps"
"""The folder of what this machine remembers of dependencies, below the state folder."""
_PACKAGE = os.path.dirname(os.path.dirname(__file__))
_SUFFIXES = (".py", ".jinja", ".mo")
_MEMO = "program"
_identity: list[str] = []
"""The identity, once it is known: a process keeps its loaded code."""


def identity(state_folder: str) -> str:
    """Return a hash of the program.

    A state folder has a memo: reading all files takes 15 ms, looking at their stat values 2. Without a memo, the files
    are read.
    """
    if not _identity:
        _identity.append(_recall(os.path.join(state_folder, FOLDER, _MEMO) if state_folder else ""))
    return _identity[0]


def _recall(memo: str) -> str:
    import time

    files = list(code_files(_folders()))
    facts = [stat_of(os.stat(file)) for file in files]
    versions = repr((__version__, sys.version, sys.byteorder, installed()))
    # the hash of integers is the same in each process; importing hashlib would take 3 of the 25 ms of a no-op build
    named = int.from_bytes(repr((versions, files)).encode(errors="surrogateescape"))
    signature = str(hash((named, *facts)))
    known = (localfile.read(memo) or b"" if memo else b"").decode(errors="replace").split()
    if len(known) == 2 and known[0] == signature:
        return known[1]
    found = contents_hash(files, versions)
    if memo and not any(is_young(each, time.time_ns()) for each in facts):
        localfile.replace(memo, f"{signature} {found}".encode())
    return found


def contents_hash(files: Iterable[str], versions: str = "") -> str:
    """Return the SHA-256 (hex) over the names and contents of files. Raises OSError."""
    from hashlib import sha256

    hashed = sha256(versions.encode(errors="surrogateescape"))
    for file in files:
        with open(file, "rb", buffering=0) as opened:
            hashed.update(f"\0{os.path.basename(file)}\0".encode(errors="surrogateescape"))
            hashed.update(sha256(opened.read()).digest())
    return hashed.hexdigest()


def _folders() -> list[str]:
    """Return the folders of the code and of the templates: of a wheel, or of a clone."""
    inside = os.path.join(_PACKAGE, "_data", "templates")
    return [_PACKAGE, inside if os.path.isdir(inside) else os.path.join(os.path.dirname(_PACKAGE), "templates")]


def code_files(folders: Iterable[str]) -> Iterator[str]:
    """Yield the files of code and templates below folders, in an order that does not depend on the system."""
    waiting = list(folders)
    while waiting:
        try:
            with os.scandir(waiting.pop()) as scanned:
                entries = sorted(scanned, key=lambda entry: entry.name)
        except OSError:
            continue  # templates may be elsewhere
        for entry in entries:
            # `_data` of a wheel also has the library and pages, which no build reads
            if entry.name.startswith(".") or entry.name in ("__pycache__", "_data"):
                continue
            if entry.name.endswith(_SUFFIXES):
                yield entry.path
            elif entry.is_dir():
                waiting.append(entry.path)


def installed() -> list[str]:
    """Return the names and versions of all installed packages, by the folders of their metadata."""
    folders = set[str]()
    for place in sys.path:
        try:
            folders.update(name for name in os.listdir(place or ".") if name.endswith((".dist-info", ".egg-info")))
        except OSError:
            continue  # an entry of Python's path may be missing, or an archive
    return sorted(folders)


def user() -> str:
    """Return the identity of the user: another user may not be able to read the same files."""
    return repr((os.geteuid(), os.getegid(), *sorted(os.getgroups()))) if hasattr(os, "geteuid") else ""
