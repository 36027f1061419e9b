"""The interface of a domain (URDF, or another data format), and the values that it exchanges with the core.

The core reads bytes and asks the domain for a *snapshot* of the model. It imports the files that the model depends on.
It asks for the *artifacts* that follow from snapshot, imports and options. It renders, plans and writes them. This
module depends on no domain and does no IO.
"""

from __future__ import annotations

import enum
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, TypeAlias

import msgspec

from urdfsync.diagnostics import Diagnostic

Snapshot: TypeAlias = Any
"""A model as its domain reads it: a frozen msgspec.Struct, `Domain.model`, with all data of artifacts.

Lists of named elements are sorted by name, so that a recorded snapshot is equal when it is read again.
"""

ElementKey: TypeAlias = tuple[str, str]
"""Kind and name of an element in the domain's words, for example `("link", "base_link")`."""


class Features(msgspec.Struct, frozen=True):
    """Contents and neighbours of an element, by which it is found again under another name."""

    contents: Mapping[str, Any]
    """Plain data by words such as `mass`; without names and without absent values."""
    neighbours: Mapping[str, ElementKey]
    """Neighbours by relation, such as `parent`."""
    files: tuple[str, ...] = ()
    """Files of the element. They are not in `contents`, since exporters name files after elements."""


class Role(enum.StrEnum):
    """Role of a generated file in the decision about it."""

    RECORD = "record"
    """Numbers and strings only: it may be written while models wait for a conflict to be resolved."""
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
    """The element that it belongs to, in the domain's words: `link base_link`, `joint elbow`, `robot`."""


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
    """Paths where it may be, best first."""
    target: str
    """POSIX path of the imported file below the package folder; no other dependency has it."""
    noun: str
    """Its kind in one lower-case word, for messages and the codes of diagnostics."""
    line: int = 0
    """Line of the source that first refers to it; 0 if unknown."""
    guessed: bool = False
    """Whether it was found only in a folder with another name than its package."""
    facts: tuple[str, ...] = ()
    """Names of the facts that artifacts need, if they differ between conversions."""


class Conversion(msgspec.Struct, frozen=True):
    """A dependency's content as the package needs it, and `facts` (plain data) that artifacts need of it."""

    content: bytes
    facts: Mapping[str, Any]
    more: tuple[Conversion, ...] = ()
    """Further files of the package that it becomes; each is an import of its own, see `further_key`."""


def further_key(key: str, number: int) -> str:
    """Return the key of a dependency's further file; numbers begin with 1."""
    return f"{key} file {number}"


class Import(msgspec.Struct, frozen=True, omit_defaults=True):
    """A dependency in the package; its file may come from an earlier build that had the source."""

    target: str
    source_hash: str
    """SHA-256 (hex) of the dependency's bytes, and of those of `others`."""
    target_hash: str
    """SHA-256 (hex) of the imported bytes."""
    facts: Mapping[str, Any]
    others: tuple[str, ...] = ()
    """Other files that it was made from, found or not: paths from the folder of the dependency's file."""


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
    """No file of the package depends on it."""
    PARAMETER = "parameter"
    """Records and imported files depend on it."""
    STRUCTURAL = "structural"
    """Models, packages or their order depend on it."""
    GENERATOR = "generator"
    """The templates, the options or the release of urdfsync differ; they turn the model into files."""

    @property
    def rank(self) -> int:
        """The number of this class in the order above; the first class has 0."""
        return list(ChangeClass).index(self)


class Version(msgspec.Struct, frozen=True):
    """A model as a build sees it."""

    snapshot: Snapshot
    imports: Mapping[str, Import] | None = None
    """The found files of the model; None if they were not looked for: then each file counts as found."""
    options: Any = None
    """The domain's options of its build; None if unknown, or if they equal those of the other version."""


class Reading(msgspec.Struct, frozen=True):
    """A source as it was read: the snapshot, unless a diagnostic is an error, and the diagnostics."""

    snapshot: Snapshot
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int] = msgspec.field(default_factory=dict)
    """Line of each element, by the domain's own keys; they are passed to `Domain.dependencies`."""
    option_findings: tuple[tuple[str, Diagnostic], ...] = ()
    """Findings about options for this model: each option, with a diagnostic without place.

    An error stops the build of the robot. The core adds the line of the configuration.
    """


class Lookup(msgspec.Struct, frozen=True):
    """Folders in which files of a source are looked for."""

    source: Path
    """The source file, absolute."""
    package_paths: tuple[Path, ...] = ()
    """Folders whose children are packages, from the configuration and the environment, best first."""
    packages: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of packages by name, in any place; filled only if a file was not found otherwise."""
    libraries: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of the Modelica libraries on MODELICAPATH by name; filled only if the source refers to one."""
    guess: bool = False
    """Whether a missing package may be a folder of another name around the source."""


class Target(msgspec.Struct, frozen=True):
    """Place of the generated package in Modelica's namespace."""

    package: str
    """Full name, for example `Plant.Robots.Arm`."""
    name: str
    """Class name of the main model, for example `Arm`."""


class Domain(Protocol):
    """A data format and the Modelica package that follows from it; registered as entry point `urdfsync.domains`.

    A domain that inherits from this class defines `name`, `model`, `options`, `read`, `names` and `artifacts`. It
    overrides the defaults that do not suit it. docs/domains.md has an example.
    """

    name: str
    """Name in the configuration; also the folder below `templates/`, unless `templates` names another."""
    templates: Path | None = None
    """Folder with the domain's templates; None for the folder of its name in urdfsync's own."""
    warnings: Collection[str] = ()
    """Codes of the domain's warnings and notes; a configuration may ignore these."""
    model: type[Any]
    """The type of snapshots."""
    options: type[Any]
    """A frozen msgspec.Struct with the domain's options and their defaults; the core refuses unknown keys."""

    permissive_options: Any = None
    """The options for sources outside of a project; None for the defaults."""
    cured: Collection[str] = ()
    """Codes of errors that `Advice.propose` cures by an option; outside of a project they are warnings."""

    # Optional features. Each Protocol stands beside the code that uses it; a module may implement it, too.
    advice: Any = None  # `urdfsync.config.advice.Advice`
    starter: Any = None  # `urdfsync.config.advice.Starter`
    beside: Any = None  # `urdfsync.engine.source.Beside`
    named_file: Any = None  # `urdfsync.engine.source.NamedFile`
    imports: Any = None  # `urdfsync.engine.imports.Mentions`
    describe: Any = None  # `urdfsync.changes.Describe`
    effects: Any = None  # `urdfsync.changes.Effects`
    record: Any = None  # `urdfsync.api.Recorder`
    checks: Any = None  # `urdfsync.checks.experiment.Checks`
    simulation: Any = None  # `urdfsync.simulation.bench.Benches`
    drawing: Any = None  # `urdfsync.engine.stage.Drawing`
    pictures: Any = None  # `urdfsync.pages.scene.Pictures`

    def read(self, content: bytes, file: str, options: Any) -> Reading:
        """Read a source; `file` is its name in diagnostics. Pure, and raises nothing for bad input: see `Reading`."""
        ...

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return the Modelica identifiers by kind of element, in the plural, and by name in the source."""
        ...

    def artifacts(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> Iterable[Artifact | Order]:
        """Return all files of the package but the imported ones. Pure."""
        ...

    def unit(self, snapshot: Snapshot, path: Sequence[str]) -> str:
        """Return the unit of the value at a path of plain data such as `parts`, `motor`, `mass`; empty if unknown."""
        return ""

    def uses(self, options: Any) -> Sequence[tuple[str, str]]:
        """Return the libraries that a generated package needs, with their versions, for a top-level `uses`."""
        return ()

    def dependencies(
        self, snapshot: Snapshot, lookup: Lookup, options: Any, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return the files that the model refers to, each once. Pure: no file is looked for."""
        return ()

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Convert a dependency found at `file` for the package. Raises SourceError if it can't be read.

        `others` has the contents of the files that `Mentions.mentioned` named; empty for unreadable ones.
        """
        return Conversion(content, {})

    def features(self, snapshot: Snapshot) -> Mapping[ElementKey, Features]:
        """Return the elements that may be found again under another name; by default, elements match by name alone."""
        named = self.names(snapshot, Target("Package", "Model"))
        return {(kind.removesuffix("s"), name): Features({}, {}) for kind, names in named.items() for name in names}


def displaced(renames: Mapping[ElementKey, str]) -> set[ElementKey]:
    """Return the removed elements whose names renamed elements have now."""
    return {(kind, name) for (kind, _), name in renames.items()} - renames.keys()


def plain(value: Any) -> Any:
    """Return a value as JSON data, with sorted keys and without None."""
    return _without_none(msgspec.json.decode(msgspec.json.encode(value, order="sorted")))


def _without_none(data: Any) -> Any:
    if isinstance(data, dict):
        return {key: _without_none(item) for key, item in data.items() if item is not None}
    is_of_structs = isinstance(data, list) and data and isinstance(data[0], dict)
    return [_without_none(item) for item in data] if is_of_structs else data
