"""The interface of a domain (URDF, or another data format).

The core reads the source, and asks the domain for a *snapshot* of the model. The core imports the files that the model
refers to. Then the core asks for the *artifacts* that follow from snapshot, imports and options. The core renders,
plans and writes these files.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, Protocol

from urdfsync.domain.model import (
    Artifact,
    Companion,
    CompanionKind,
    Conversion,
    Dependency,
    ElementKey,
    Features,
    Import,
    Lookup,
    Order,
    Reading,
    Snapshot,
    Target,
    Version,
)

if TYPE_CHECKING:  # types of features alone: a domain loads these modules if it has the feature
    from urdfsync.domain.advice import Advice, Starter
    from urdfsync.domain.bench import Benches
    from urdfsync.domain.changes import Describe, Effects, Formats
    from urdfsync.domain.experiment import Checks
    from urdfsync.domain.features import Drawing, Judgements, Mentions, Parts, Recorder
    from urdfsync.domain.regressor import Physics
    from urdfsync.domain.scene import Pictures


class LazyModule:
    """A module with an optional feature of a domain, as an attribute of the domain. The first use loads the module."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, domain: object, owner: type) -> ModuleType:
        """Return the module."""
        return importlib.import_module(self._name)


class Domain(Protocol):
    """A data format and its Modelica package; registered as entry point `urdfsync.domains`.

    A domain that inherits from this class defines `name`, `model`, `options`, `read`, `names` and `artifacts`. It may
    override all other methods and attributes. docs/domains.md has an example.
    """

    name: str
    """Name in the configuration, and of the folder in urdfsync's `templates/`."""
    templates: Path | None = None
    """Folder with the domain's templates; None for the folder `name` in urdfsync's `templates/`."""
    warnings: Collection[str] = ()
    """Codes of the domain's warnings and notes; a configuration may ignore these."""
    model: type[Any]
    """The type of snapshots."""
    options: type[Any]
    """A frozen msgspec.Struct with the domain's options and their defaults; the core refuses unknown keys."""

    permissive_options: Any = None
    """The options for sources that no configuration names; None for the defaults."""
    cured: Collection[str] = ()
    """Codes of errors that an option avoids; for sources that no configuration names, they are warnings."""
    companions: Sequence[CompanionKind] = ()
    """Kinds of files that a source is read with."""

    # Optional features. The modules of `urdfsync.domain` describe them; an object or a module implements each.
    advice: Advice | None = None
    starter: Starter | None = None
    imports: Mentions | None = None
    describe: Describe | None = None
    parts: Parts | None = None
    judgements: Judgements | None = None
    effects: Effects | None = None
    formats: Formats | None = None
    record: Recorder | None = None
    checks: Checks | None = None
    simulation: Benches | None = None
    identification: Physics | None = None
    drawing: Drawing | None = None
    pictures: Pictures | None = None

    def read(self, content: bytes, file: str, options: Any, *companions: Companion) -> Reading:
        """Read a source; `file` is its name in diagnostics. Pure. Errors of the input are in the `Reading`.

        A domain without kinds of `companions` gets none.
        """
        ...

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return the Modelica identifiers by kind of element (such as `links`), then by name in the source."""
        ...

    def artifacts(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> Iterable[Artifact | Order]:
        """Return all files of the package except imported files. Pure."""
        ...

    def unit(self, snapshot: Snapshot, path: Sequence[str]) -> str:
        """Return the unit of the value at a path of plain data such as `parts`, `motor`, `mass`; empty if unknown."""
        return ""

    def arranged(self, old: Snapshot, new: Snapshot) -> Snapshot:
        """Return an old model in the order of the new one, for a domain whose artifacts follow an unrecorded order."""
        return old

    def uses(self, options: Any) -> Sequence[tuple[str, str]]:
        """Return the libraries that a generated package needs, with their versions, for a top-level `uses`."""
        return ()

    def dependencies(
        self, snapshot: Snapshot, lookup: Lookup, options: Any, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return each file that the model refers to, once. Pure: it looks for no file."""
        return ()

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Convert a dependency found at `file` for the package. Raises SourceError if it can't be read.

        `others` has the contents of the files that `Mentions.mentioned` named; an unreadable file has an empty content.
        """
        return Conversion(content, {})

    def features(self, snapshot: Snapshot) -> Mapping[ElementKey, Features]:
        """Return the features of elements; by default, elements have none and match by name alone."""
        named = self.names(snapshot, Target("Package", "Model"))
        return {(kind.removesuffix("s"), name): Features({}, {}) for kind, names in named.items() for name in names}

    def numbered(
        self, new: Version, formers: Sequence[Version], find_renames: Callable[[Version], Mapping[ElementKey, str]]
    ) -> Snapshot:
        """Return a model whose numbered parts have the numbers of former models; the first one counts first.

        `find_renames` returns the renames of elements since a former version.
        """
        return new.snapshot
