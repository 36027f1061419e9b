"""The bases of one robot, text ↔ value: every text that urdfsync generated last, by its hash, edited since or not.

`.urdfsync/bases/<robot>/0` to `f`, which are committed; a text is in the file of its hash's first digit. All sixteen
are always there, so that git sees no renames. A line has the hash, and the text as a JSON string. Git unites the lines
of two branches (`merge=union`), and whatever it makes of them does no harm: a line whose text has another hash is none.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping

import msgspec

from urdfsync.files import digest

DIGITS = "0123456789abcdef"
"""The names of the files."""

_DECODER = msgspec.json.Decoder(str)


def dumps(texts: Mapping[str, str]) -> bytes:
    """Return one file with these texts, which are by their hashes (see `text_digest`)."""
    encode = msgspec.json.encode
    return b"".join(b"%s %s\n" % (sha256.encode(), encode(text)) for sha256, text in sorted(texts.items()))


@functools.lru_cache(maxsize=2 * len(DIGITS))  # the daemon looks at all of them in each build
def loads(content: bytes) -> Mapping[str, str]:
    """Return the texts of one file by their hashes; damaged lines are passed over."""
    texts = {}
    for line in content.split(b"\n"):
        sha256, _, encoded = line.partition(b" ")
        try:
            text = _DECODER.decode(encoded)
        except ValueError:  # no JSON, or no UTF-8
            continue
        if digest(text.encode()).encode() == sha256:
            texts[sha256.decode()] = text
    return texts


@functools.lru_cache(maxsize=2 * len(DIGITS))
def find_damage(content: bytes) -> int:
    """Return the number of the first line of a file that has no text of its hash; 0 if there is none."""
    texts, lines = loads(content), enumerate(content.split(b"\n"), 1)
    return next((n for n, line in lines if line and line.partition(b" ")[0].decode(errors="replace") not in texts), 0)
