"""Files around a robot's package, in which other robots may have a part: looked at again when they are written.

So robots that share a parent package can be planned at the same time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import msgspec

from urdfsync import order
from urdfsync.files import digest
from urdfsync.state.transaction import Change


class Shared(msgspec.Struct, frozen=True):
    """One such file: a `package.mo` that is made if it is not there, or a `package.order`."""

    path: Path
    content: bytes | None = None
    """Of a `package.mo`."""
    names: tuple[str, ...] = ()
    """Lines of a `package.order` that have to be there."""
    owned: tuple[str, ...] = ()
    """Lines of a `package.order` that are urdfsync's to take away."""


def changes(files: Iterable[Shared], read: Callable[[Path], bytes | None]) -> Iterator[Change]:
    """What is left to be done of them, from what is on disk now."""
    for file in files:
        found = read(file.path)
        if file.content is not None:
            if found is None:
                yield Change(file.path, file.content, None)
            continue
        old = None if found is None else found.decode(errors="surrogateescape")
        new = order.merge(old, file.names, file.owned)
        if new != (old or ""):
            content = new.encode(errors="surrogateescape") if new else None
            yield Change(file.path, content, None if found is None else digest(found))
