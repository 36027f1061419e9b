"""Python's search for reference cycles, held back where many objects are made at a time.

It looks at all objects again and again as they become more: a fifth of the processor time of a build. What a build
makes has hardly any cycles, and goes as soon as nothing refers to it. The search comes afterwards.
"""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Iterator


@contextlib.contextmanager
def held_back() -> Iterator[None]:
    """No search until the end, unless it has been held back already: then until the end of that."""
    searching = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if searching:
            gc.enable()


def search() -> None:
    """Search among the objects that were made since the last search: for a process that goes on and on."""
    gc.collect(0)
