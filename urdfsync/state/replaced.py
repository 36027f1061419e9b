"""Texts that the last build wrote over, text ↔ value: `.urdfsync/replaced/<robot>.json`."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec


class Replaced(msgspec.Struct, frozen=True, omit_defaults=True):
    """One file that a build wrote over."""

    before: str
    """Text that stood there."""
    base: str | None = None
    """The generated text that this took into account: the same if nobody had edited it, None if it is not known."""
    after: str | None = None
    """Text that was written; None for the generated one."""

    @property
    def is_users(self) -> bool:
        """Whether something of the user's was written over."""
        return self.base != self.before


def loads(content: bytes) -> dict[str, Replaced]:
    """Return what is put aside, by the paths of the files below the package; nothing if it can't be read."""
    try:
        return msgspec.json.decode(content, type=dict[str, Replaced])
    except (ValueError, RecursionError):  # it is safe to lose, and may be a stranger's
        return {}


def dumps(replaced: Mapping[str, Replaced]) -> bytes | None:
    """Return the content of the file; None if nothing is put aside."""
    return msgspec.json.encode(replaced, order="sorted") if replaced else None
