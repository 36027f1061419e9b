"""Computes one hash of the program that generates packages: this machine's notes are valid only for this hash."""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Iterator

import urdfsync
from urdfsync import registry
from urdfsync.answers.facts import stat_of
from urdfsync.files import digest


@functools.cache
def program_hash(domain: str, templates: str) -> str:
    """Return a hash of the stat values of urdfsync's and a domain's files, and of the installed packages.

    `templates` is the hash of the templates. A process keeps its loaded code, so the hash is computed once.
    """
    module = sys.modules.get(registry.top_level(domain), urdfsync)
    files = sorted({urdfsync.__file__, module.__file__ or urdfsync.__file__})
    facts = [fact for file in files for fact in _code(file)]
    return digest(repr((urdfsync.__version__, sys.version, installed(), facts, templates)).encode())


def _code(file: str) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Yield the files of a module's package, or the module itself, with their stat values."""
    if os.path.basename(file) != "__init__.py":  # noqa: PTH119
        yield file, stat_of(os.stat(file))  # noqa: PTH116
        return
    folders = [os.path.dirname(file)]  # noqa: PTH120
    while folders:
        with os.scandir(folders.pop()) as entries:
            for entry in sorted(entries, key=lambda entry: entry.name):
                # `_data` of an installation has the templates, which have a hash of their own, and other files
                if entry.name.startswith(".") or entry.name in ("__pycache__", "_data"):
                    continue
                if entry.is_dir():
                    folders.append(entry.path)
                else:
                    yield entry.path, stat_of(entry.stat())


def installed() -> list[str]:
    """Return the names and versions of all installed packages, by the folders of their metadata."""
    folders = set[str]()
    for place in sys.path:
        names = os.listdir(place) if os.path.isdir(place) else []  # noqa: PTH112, PTH208
        folders.update(name for name in names if name.endswith((".dist-info", ".egg-info")))
    return sorted(folders)
