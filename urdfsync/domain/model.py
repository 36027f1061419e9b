"""The values that the core and a domain exchange. Depends on no domain, and does no IO."""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

import msgspec

from urdfsync.common.diagnostics import Diagnostic

Snapshot: TypeAlias = Any
"""A model as its domain reads it: a frozen msgspec.Struct, `Domain.model`, with all data of artifacts.

Lists of named elements are sorted by name: a snapshot equals itself after it was recorded and read again.
"""

ElementKey: TypeAlias = tuple[str, str]
"""Kind and name of an element in the domain's words, for example `("link", "base_link")`."""


class Features(msgspec.Struct, frozen=True):
    """Contents and neighbours of an element: they identify the element if its name changes."""

    contents: Mapping[str, Any]
    """Plain data by words such as `mass`; names and absent values are left out."""
    neighbours: Mapping[str, ElementKey]
    """Neighbours by relation, such as `parent`."""
    files: tuple[str, ...] = ()
    """Files of the element. Files are not in `contents`, since exporters name files after elements."""


class Role(enum.StrEnum):
    """Role of a generated file; the decision about the file depends on it."""

    RECORD = "record"
    """A record has only numbers and strings: it may be written while models wait for a conflict to be resolved."""
    MODEL = "model"
    PACKAGE = "package"
    ORDER = "order"
    """A `package.order` file; a domain describes it as an `Order`."""
    IMPORT = "import"
    """An imported file: bytes, not text; a domain describes it as a `Dependency`."""


class Artifact(msgspec.Struct, frozen=True):
    """One text file of the package: `path` (POSIX, below the package folder) is `template` rendered with `data`."""

    path: str
    role: Role
    template: str
    data: Mapping[str, Any]
    """Variables of the template: plain data and structs that JSON can hold."""
    owner: str
    """The element that the file belongs to, in the domain's words: `link base_link`, `joint elbow`, `robot`."""


class Order(msgspec.Struct, frozen=True):
    """One `package.order` file: urdfsync owns the lines in `names`, the user all others."""

    path: str
    names: tuple[str, ...]


class Dependency(msgspec.Struct, frozen=True):
    """A file that a source refers to, to be imported into the package."""

    key: str
    """Identity within the model: its URI in the source, and its conversion."""
    uri: str
    candidates: tuple[Path, ...]
    """Paths where the file may be, best first."""
    target: str
    """POSIX path of the imported file below the package folder; no other dependency has it."""
    noun: str
    """The kind of the file in one lower-case word, for messages and the codes of diagnostics."""
    line: int = 0
    """Line of the source that first refers to it; 0 if unknown."""
    guessed: bool = False
    """Whether the file was found only in a folder with another name than its package."""
    facts: tuple[str, ...] = ()
    """Names of the facts that artifacts need, if different conversions have different facts."""


class Conversion(msgspec.Struct, frozen=True):
    """A dependency's content for the package, and the `facts` (plain data) about it that artifacts need."""

    content: bytes
    facts: Mapping[str, Any]
    more: tuple[Conversion, ...] = ()
    """Further files of the package that the dependency becomes; each is an import of its own (see `further_key`)."""


def further_key(key: str, number: int) -> str:
    """Return the key of a dependency's further file; numbers begin with 1."""
    return f"{key} file {number}"


def belongs_to(name: str, key: str) -> bool:
    """Return whether `name` is the key of a dependency or of one of its further files; `key` is the dependency's."""
    return name == key or name.startswith(f"{key} file ")


class Import(msgspec.Struct, frozen=True, omit_defaults=True):
    """A dependency in the package; if its source is missing now, its file comes from an earlier build."""

    target: str
    source_hash: str
    """SHA-256 (hex) of the dependency's bytes and of the bytes of `others`."""
    target_hash: str
    """SHA-256 (hex) of the imported bytes."""
    facts: Mapping[str, Any]
    others: tuple[str, ...] = ()
    """Other files that the conversion asked for, found or not: paths from the folder of the dependency's file."""


class ChangeKind(enum.StrEnum):
    """Kind of a difference between two versions."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"
    RENAMED = "renamed"


class ChangeClass(enum.StrEnum):
    """Reach of a change, least first."""

    NONE = "none"
    """Nothing differs."""
    UNMODELLED = "unmodelled"
    """No file of the package changes."""
    PARAMETER = "parameter"
    """Only records and imported files change."""
    STRUCTURAL = "structural"
    """Models, packages or their order change."""
    GENERATOR = "generator"
    """The templates, the options or the version of urdfsync differ: any file may change."""

    @property
    def rank(self) -> int:
        """The position of this class in the order above, from 0."""
        return list(ChangeClass).index(self)


class Version(msgspec.Struct, frozen=True):
    """A model with its imports and options."""

    snapshot: Snapshot
    imports: Mapping[str, Import] | None = None
    """The found files of the model; None if nobody looked for files: then each file counts as found."""
    options: Any = None
    """The domain's options; None if they are unknown, or if the other version has the same."""


class CompanionKind(msgspec.Struct, frozen=True):
    """A kind of file that a source is read with."""

    option: str
    """The option with the file's path from the configuration's folder."""
    suffix: str = ""
    """Without a configuration, such a file stands beside the source, with this suffix; empty if it never does."""
    mark: re.Pattern[bytes] = re.compile(b"")
    """What is in such files: a file beside the source without it is of another kind."""
    needed_by: str = ""
    """The option without which the file that `option` names is not read; empty if it is always read."""


class Translator(msgspec.Struct, frozen=True):
    """A program that turns sources in another format into text that a domain reads; see `engine.sources.expansion`."""

    name: str
    """The format in lower case, which is also the code of its faults; `NAME-limits` is that of a passed limit."""
    module: str
    """The module to run: it reads an `engine.sources.exchange.Request`, and writes an `Answer`."""
    hints: Mapping[str, str]
    """The usual hints, by codes of faults."""
    mark: re.Pattern[bytes] = re.compile(b"(?!)")
    """What a source in this format begins with; xacro has other marks."""
    compares: bool = False
    """Whether the program also compares a text with its source, by another way than it translates."""


class Companion(msgspec.Struct, frozen=True):
    """A file that a source is read with, on disk or in a revision."""

    option: str
    """The option of its kind."""
    file: str
    """The file's name in diagnostics."""
    content: bytes


class Reading(msgspec.Struct, frozen=True):
    """The result of reading a source: the snapshot, unless a diagnostic is an error, and the diagnostics."""

    snapshot: Snapshot
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int] = msgspec.field(default_factory=dict)
    """Line of each element, by the domain's own keys; the core passes these lines to `Domain.dependencies`."""
    files: Mapping[str, str] = msgspec.field(default_factory=dict)
    """Companion of each element that is not in the source itself, by the same keys."""
    option_findings: tuple[tuple[str, Diagnostic], ...] = ()
    """Findings about options for this model: each option, with a diagnostic without file and line.

    An error stops the build of the robot. The core adds the option's line in the configuration.
    """

    def place(self, element: str, source: str) -> tuple[str, int]:
        """Return file and line of an element, or of the known element around it; else line 0 of the `source`."""
        while element not in self.lines and " / " in element:
            element = element.rpartition(" / ")[0]
        return self.files.get(element, source), self.lines.get(element, 0)


class Lookup(msgspec.Struct, frozen=True):
    """Folders in which files of a source are looked for."""

    source: Path
    """The source file, absolute."""
    package_paths: tuple[Path, ...] = ()
    """Folders whose children are packages, from the configuration and the environment, best first."""
    packages: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of all ROS packages by name; filled only if a file was not found elsewhere."""
    libraries: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of the Modelica libraries on MODELICAPATH by name; filled only if the source refers to a library."""
    guess: bool = False
    """Whether a folder around the source may stand for a missing package of another name."""


class Target(msgspec.Struct, frozen=True):
    """Place of the generated package in Modelica's namespace."""

    package: str
    """Full name, for example `Plant.Robots.Arm`."""
    name: str
    """Class name of the main model, for example `Arm`."""


def displaced(renames: Mapping[ElementKey, str]) -> set[ElementKey]:
    """Return the removed elements whose names now belong to renamed elements."""
    return {(kind, name) for (kind, _), name in renames.items()} - renames.keys()


def plain(value: Any) -> Any:
    """Return a value as JSON data, with sorted keys, and without keys that are None."""
    return _without_none(msgspec.json.decode(msgspec.json.encode(value, order="sorted")))


def _without_none(data: Any) -> Any:
    if isinstance(data, dict):
        return {key: _without_none(item) for key, item in data.items() if item is not None}
    is_of_structs = isinstance(data, list) and data and isinstance(data[0], dict)
    return [_without_none(item) for item in data] if is_of_structs else data
