"""Reads and writes the bases of one robot: the last generated text of each file, and the hashes of all former ones.

The files are `.urdfsync/bases/<robot>/0` to `f`, which are committed. The name of a text's file is the first digit of
the text's hash. All sixteen files always exist, so that git sees no renames. A line has the hash, and the text as a
JSON string; a former text's line has `null`. So each clone knows every text that urdfsync wrote. Git unites the lines
of two branches (`merge=union`). A damaged line is skipped: its hash and its text differ.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping

import msgspec

from urdfsync.common.files import text_hash

DIGITS = "0123456789abcdef"

_DECODER = msgspec.json.Decoder(str | None)
_HASH = re.compile(rb"[0-9a-f]{16}")


def dumps(texts: Mapping[str, str | None]) -> bytes:
    """Return one file with these texts, by their hashes (see `text_hash`); None for a former text."""
    encode = msgspec.json.encode
    return b"".join(b"%s %s\n" % (sha256.encode(), encode(text)) for sha256, text in sorted(texts.items()))


@functools.lru_cache(maxsize=2 * len(DIGITS))  # cached: the daemon reads all files in each build
def loads(content: bytes) -> Mapping[str, str | None]:
    """Return the texts of one file by their hashes, None for former texts; damaged lines are skipped."""
    texts = dict[str, str | None]()
    for line in content.split(b"\n"):
        sha256, _, encoded = line.partition(b" ")
        try:
            text = _DECODER.decode(encoded)
        except ValueError:  # the line is not JSON or not UTF-8
            continue
        if text is None and _HASH.fullmatch(sha256):
            texts.setdefault(sha256.decode(), None)  # git may have united it with the line of a branch with the text
        elif text is not None and text_hash(text.encode()).encode() == sha256:
            texts[sha256.decode()] = text
    return texts


@functools.lru_cache(maxsize=2 * len(DIGITS))
def find_damage(content: bytes) -> int:
    """Return the number of the first damaged line of a file; 0 if there is none."""
    texts, lines = loads(content), enumerate(content.split(b"\n"), 1)
    return next((n for n, line in lines if line and line.partition(b" ")[0].decode(errors="replace") not in texts), 0)
