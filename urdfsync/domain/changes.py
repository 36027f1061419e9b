"""Changes of a model in its domain's words, and the functions by which a domain describes and compares models."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Protocol, TypeAlias

import msgspec

from urdfsync.domain.model import ChangeClass, ChangeKind, ElementKey, Features, Snapshot, Target, Version

NOISE = 1e-6
"""The greatest relative change of a number by an exporter's rounding."""


def is_number(value: object) -> bool:
    """Return whether a value is a number; True and False are not."""
    return isinstance(value, int | float) and not isinstance(value, bool)


class Change(msgspec.Struct, frozen=True):
    """One change in the domain's words; `old` and `new` are plain data, None for a value that a version lacks."""

    path: tuple[str, ...]
    """The element, and the place in it."""
    kind: ChangeKind
    change_class: ChangeClass
    old: Any
    new: Any
    unit: str = ""
    noise: bool = False
    """Whether only the rounding of a number may have changed. Builds apply such a change, too."""

    def __post_init__(self) -> None:
        """Set `noise`, which follows from the values."""
        if is_number(self.old) and is_number(self.new):
            is_noise = abs(self.new - self.old) <= NOISE * max(abs(self.old), abs(self.new))
            msgspec.structs.force_setattr(self, "noise", is_noise)

    @property
    def element(self) -> str:
        """Element of the change, for example `joint elbow`."""
        return self.path[0]

    def __str__(self) -> str:
        """Return the path for people: `joint elbow / origin / xyz[2]`."""
        return " / ".join(self.path)


Describe: TypeAlias = Callable[[Version, Version, Mapping[ElementKey, str], Any], Iterable[Change]]
"""Returns the changes from one version to another. Further arguments: new names by old elements, the new options.

The attribute `describe` of a domain. Without it, additions and removals are structural changes. A value is a structural
change if the text of a model changes (see `by_texts`), else a parameter change.
"""


class Effect(msgspec.Struct, frozen=True):
    """A property of the whole model in both versions; None for a version without it."""

    path: tuple[str, ...]
    old: Any
    new: Any
    unit: str = ""
    hint: str = ""
    """What the user should do; empty if there is nothing to do."""
    limit: float | None = None
    """The greatest allowed value in the new version."""


class Effects(Protocol):
    """Describes the effects of differences on the whole model; the attribute `effects` of a domain."""

    def effects(self, old: Version, new: Version) -> Sequence[Effect]:
        """Return the effects of the differences on the whole model."""
        ...

    def loads(self, old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Sequence[Effect]:
        """Return each element's greatest load in the new version, with its limit; `old` is None for a new element."""
        ...

    def interface(
        self, old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Any
    ) -> Sequence[Effect]:
        """Return changed names of connectors and variables; `old` is None for a new name, `new` for a removed name.

        `options` belong to the new version, and to an old version without `options`.
        """
        ...


class Formats(Protocol):
    """Compares models of one thing in different formats; the attribute `formats` of a domain."""

    def coarse_features(self, snapshot: Snapshot) -> Mapping[ElementKey, Features]:
        """Return features that another format of the same model has, too.

        They count for elements of two versions that do not match by the domain's `features`.
        """
        ...

    def in_common_frames(
        self, old: Snapshot, new: Snapshot, renames: Mapping[ElementKey, str]
    ) -> tuple[Snapshot, Snapshot]:
        """Return the comparable parts of two models from different sources."""
        ...
