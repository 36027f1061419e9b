"""What libraries in C++ print is kept from the terminal, and from what programs read."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
from collections.abc import Iterator

_STREAMS = (1, 2)


class Words:
    """What was said meanwhile; complete once the `with` statement ends."""

    text = ""


@contextlib.contextmanager
def overheard() -> Iterator[Words]:
    """Catch all that this process writes to stdout and stderr, past Python's own streams as well."""
    words = Words()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    kept = [os.dup(number) for number in _STREAMS]
    with tempfile.TemporaryFile() as said:
        try:
            for number in _STREAMS:
                os.dup2(said.fileno(), number)
            yield words
        finally:
            for number, copy in zip(_STREAMS, kept, strict=True):
                os.dup2(copy, number)
                os.close(copy)
            said.seek(0)
            words.text = said.read().decode(errors="replace")
