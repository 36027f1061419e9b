"""Which libraries a package needs beside the Modelica Standard Library, and which these need in turn.

They are looked for by name in folders. What a library is made of is told by its own files.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.checking import workspace
from urdfsync.checking.libraries import library, references
from urdfsync.config import RobotConfig
from urdfsync.modelica.files import has_word
from urdfsync.modelica.names import LIBRARY

_KNOWN = frozenset((*library.PARTS, LIBRARY))
"""Libraries that are found in other ways."""


class Mentioned(msgspec.Struct, frozen=True):
    """What the files of a library mention."""

    libraries: frozenset[str]
    """Top-level names."""
    standard: frozenset[str]
    """Full names in the Modelica Standard Library."""


class Dependencies:
    """The libraries in the folders of a search path; each is read once."""

    def __init__(self, places: Sequence[Path]) -> None:
        self._places = places
        self._read = functools.cache(_mentioned)

    def of(self, top: str, texts: Iterable[str], wanted: Iterable[str] = ()) -> dict[str, Path]:
        """The libraries that the top-level package `top` with these texts needs, and those that are `wanted`, by name.

        What is not at hand is left out. Raises OutputError for a library that can't be read.
        """
        found: dict[str, Path] = {}
        missed = {top, *_KNOWN}
        waiting = sorted({*wanted, *references.beginnings(texts)})
        while waiting:
            name = waiting.pop()
            if name in missed or name in found:
                continue
            path = library.find(name, self._places)
            if path is None:
                missed.add(name)
            else:
                found[name] = path
                waiting += sorted(self._read(path).libraries)
        return dict(sorted(found.items()))

    def standard(self, libraries: Iterable[Path]) -> set[str]:
        """Full names in the Modelica Standard Library that libraries mention."""
        return {name for path in libraries for name in self._read(path).standard}


def search_path(robot: RobotConfig) -> list[Path]:
    """The folders in which the libraries of a robot's package are looked for: the one of its package comes first."""
    return [robot.output, *library.folders(os.environ, library.home())]


def fingerprint(robot: RobotConfig, texts: Iterable[bytes]) -> str:
    """What changes whenever a library changes that a robot's package with these texts may need, or comes or goes.

    A name counts wherever it stands, also in a comment: that is quick, and too much does no harm. Raises OutputError.
    """
    places = search_path(robot)
    names = library.names(places) - {robot.target.package.partition(".")[0], *_KNOWN}
    lines = []
    waiting = list(texts) if names else []
    while waiting:
        text = waiting.pop()
        for name in [name for name in names if has_word(text, os.fsencode(name))]:
            names.discard(name)
            path = library.find(name, places)
            if path is not None:
                lines.append(f"{name}\0{path}\0{library.state(path)}\n")
                waiting += _texts(path).values() if names else ()
    return "".join(sorted(lines))


def _mentioned(path: Path) -> Mentioned:
    texts = [content.decode(errors="replace") for content in _texts(path).values()]
    return Mentioned(frozenset(references.beginnings(texts)), frozenset(references.mentioned(texts)))


def _texts(path: Path) -> Mapping[str, bytes]:
    """The files of a library, which is a folder or a file."""
    return {path.name: workspace.content(path)} if path.suffix == ".mo" else workspace.package_texts(path)
