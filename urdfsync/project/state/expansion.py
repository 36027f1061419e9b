"""Reads and writes an expanded source, `.urdfsync/robots/<robot>.expanded`, which is committed.

The file holds the text from xacro or a command, and the hashes of all inputs. So a build expands only a changed source,
and a clone needs no xacro. If git has united two versions, the hash of the whole is wrong, and builds ignore the file.
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from urdfsync.common.files import digest

_HEADER = "# This robot's source, expanded, and what it is made of. Written by urdfsync: commit it, don't edit it.\n"
_END = "\n}\n"
"""The end of the JSON object before the text."""


class Expansion(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """An expanded text with its inputs.

    Files are named by a path from the configuration's folder, by `package://NAME/…`, or else by an absolute path.
    """

    format: int = 1
    source: str = ""
    """The source's path in the configuration."""
    arguments: Mapping[str, str] = {}
    command: tuple[str, ...] = ()
    """The command that wrote the source; empty for xacro."""
    files: Mapping[str, str | None] = {}
    """Hashes of the files that were read, by name; None for a missing file."""
    patterns: Mapping[str, str] = {}
    """Hashes of the file names that match each pattern, such as `parts/*.xacro`."""
    packages: Mapping[str, str | None] = {}
    """Folders of the packages that the source names, as in `files`; None for a missing package."""
    variables: Mapping[str, str | None] = {}
    """Hashes of the values of environment variables; None for an unset variable."""
    unused: tuple[str, ...] = ()
    """Arguments in the configuration that the source does not declare."""
    warnings: tuple[str, ...] = ()
    """Messages of xacro."""
    places: str = ""
    """The original places of elements: `12=0:7` means that line 12 of the text is from line 7 of the first of `files`,
    sorted by name.
    """
    sum: str = ""
    """Hash of all other fields."""
    text: str = ""


def dumps(expansion: Expansion) -> bytes:
    """Return the expansion as text: the same value gives the same text everywhere."""
    bare = msgspec.structs.replace(expansion, sum="", text="")
    everything = msgspec.json.encode(bare, order="sorted") + expansion.text.encode()
    head = msgspec.json.encode(msgspec.structs.replace(bare, sum=digest(everything)), order="sorted")
    return f"{_HEADER}{msgspec.json.format(head, indent=1).decode()}\n{expansion.text}".encode()


def loads(content: bytes) -> Expansion | None:
    """Read an expansion; None for any other text, such as two united versions."""
    text = content.decode(errors="replace").replace("\r\n", "\n").removeprefix(_HEADER)
    head, _, rest = text.partition(_END)
    try:
        read = msgspec.structs.replace(msgspec.json.decode(f"{head}{_END}", type=Expansion), text=rest)
    except (msgspec.DecodeError, RecursionError):
        return None
    return read if read.format == 1 and dumps(read) == (_HEADER + text).encode() else None
