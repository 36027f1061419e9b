"""What differs between two versions of a model, and what that means: neutral values, without any logic of a domain."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import msgspec

if TYPE_CHECKING:
    from urdfsync.domain import Import, Snapshot

ElementKey: TypeAlias = tuple[str, str]
"""Kind and name of an element in the domain's words, for example `("link", "base_link")`."""


class Kind(enum.StrEnum):
    """What happened to a value or an element."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"
    RENAMED = "renamed"


class ChangeClass(enum.StrEnum):
    """How far a change reaches, least first."""

    NONE = "none"
    """Nothing differs."""
    UNMODELLED = "unmodelled"
    """Nothing in the package says it."""
    PARAMETER = "parameter"
    """Records and imported files say it."""
    STRUCTURAL = "structural"
    """Models, packages or their order say it."""
    GENERATOR = "generator"
    """What turns the model into files is another: template, option or revision."""

    @property
    def rank(self) -> int:
        """Place in this order, from 0."""
        return list(ChangeClass).index(self)


class Version(msgspec.Struct, frozen=True):
    """A model as a build sees it."""

    snapshot: Snapshot
    imports: Mapping[str, Import] | None = None
    """The files that the model refers to, if found; None if nobody looked, and then each counts as found."""
    generator: str = ""
    """Fingerprint of what turns it into files."""
    options: Any = None
    """The domain's options that it was built with; None if they are not known, or those of the other version."""


class Difference(msgspec.Struct, frozen=True):
    """One place at which two versions differ; `old` is None for what was added, `new` for what was removed."""

    path: tuple[str | int, ...]
    """Keys and indices (from 0) from the snapshot to the value; `("imports", key)` for an imported file."""
    kind: Kind
    old: Any
    new: Any


class Meaning(msgspec.Struct, frozen=True):
    """A difference in the domain's words."""

    path: tuple[str, ...]
    """For example `("joint elbow", "origin", "xyz[2]")`; begins with the element."""
    change_class: ChangeClass
    unit: str = ""
    """Unit of both values, or `old → new` if they differ; empty for what has none."""


class Effect(msgspec.Struct, frozen=True):
    """A property of the whole model in both versions; None where it does not exist."""

    path: tuple[str, ...]
    old: Any
    new: Any
    unit: str = ""
    hint: str = ""
    """What to do about it, if there is anything."""
