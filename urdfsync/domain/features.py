"""Small features that a domain may have; a module or an object implements each."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, Protocol, TypeAlias

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain.model import Artifact, Dependency, ElementKey, Import, Reading, Snapshot, Target, Version

Drawing: TypeAlias = Callable[[Snapshot, Mapping[str, Import], Target, Any, Mapping[str, tuple[str, str]]], str | None]
"""Returns the main model's diagram as SVG text; None for a model without a diagram. Pure. A domain's attribute
`drawing`. The last argument has the texts of the package that differ from the generated ones: by path, the generated
text, empty for a class of the user's own, and the text on disk."""
Recorder: TypeAlias = Callable[[Reading, str, Target, Any], tuple[Artifact, Sequence[Diagnostic]]]
"""Returns a model as one record without a package, and the findings about it; the attribute `record` of a domain. Its
arguments are a reading without errors, the source's name in diagnostics, the record's class and package, and options.
No files are imported for the record. Pure.
"""


class Mentions(Protocol):
    """Names the other files that a conversion needs, and reports on imported files; a domain's attribute `imports`."""

    def mentioned(self, dependency: Dependency, file: str, content: bytes) -> Sequence[str]:
        """Return other files that the conversion needs: paths from the folder of the dependency's own file.

        The core calls this for the dependency's file, then for each file in a result. Pure.
        """
        ...

    def findings(self, imports: Mapping[str, Import], snapshot: Snapshot) -> Iterable[tuple[str, Diagnostic]]:
        """Return diagnostics about imported files, each with the key of its file; an empty key stands for all files.

        The core adds the line of the dependency.
        """
        ...


class Judgements(Protocol):
    """Judges models; the attribute `judgements` of a domain. Findings have an `element`, and no place. Pure."""

    def judge(self, version: Version, changed: Collection[str]) -> Iterable[Diagnostic]:
        """Return warnings about parts of a valid model that can hardly be meant.

        `changed` has elements such as `link hand`. Of two parts that contradict each other, a warning blames the one in
        `changed`.
        """
        ...

    def find_jumps(self, old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Iterable[Diagnostic]:
        """Return warnings about differences that look like mistakes of the export."""
        ...


class Parts(Protocol):
    """The parts of a model that elements share, such as `column mass`; a domain's attribute `parts`. Pure.

    A part is an element with empty `Features`.
    """

    def pairs(self, old: Snapshot, new: Snapshot) -> Mapping[ElementKey, ElementKey]:
        """Return new parts by old parts with another name."""
        ...

    def renamed(self, old: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
        """Return an old model in which the elements have the new names of their parts."""
        ...
