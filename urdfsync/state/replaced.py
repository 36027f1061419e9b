"""What stood in files that the last build wrote over: as values, and as files in the state folder."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec


class Replaced(msgspec.Struct, frozen=True):
    """One file that a build wrote over."""

    before: str
    """What stood there."""
    base: str | None
    """The generated text that this took into account: the same if nobody had edited it, None if it is not known."""
    after: str | None
    """What was written; None for the generated text."""

    @property
    def is_users(self) -> bool:
        """Whether something of the user's was written over."""
        return self.base != self.before


def read(contents: Mapping[str, bytes]) -> dict[str, Replaced]:
    """Return what is put aside, by the paths of the files below the package, from the files in the state folder."""
    texts = {path: content.decode(errors="surrogateescape") for path, content in contents.items()}
    found = {}
    for path, before in texts.items():
        base, after = _beside(path)
        if base in texts or not path.endswith((".base.mo", ".after.mo")):
            found[path] = Replaced(before, texts.get(base, before) or None, texts.get(after))
    return found


def _beside(path: str) -> tuple[str, str]:
    """Where base and result of a file are put aside."""
    stem = path.removesuffix(".mo")
    return f"{stem}.base.mo", f"{stem}.after.mo"


def contents(replaced: Mapping[str, Replaced]) -> dict[str, bytes]:
    """Return the files for the state folder; a base that is not known is an empty one."""
    found = {}
    for path, one in replaced.items():
        base, after = _beside(path)
        found[path] = _encode(one.before)
        if one.is_users:
            found[base] = _encode(one.base or "")
        if one.after is not None:
            found[after] = _encode(one.after)
    return found


def _encode(text: str) -> bytes:
    return text.encode(errors="surrogateescape")
