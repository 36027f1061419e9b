"""The stamp of a generated class: which part its file belongs to, and which generated text the file last had.

A stamp is the last argument of the class's annotation, which Modelica obliges other tools to keep:
`__urdfsync(id = "1f0c3a52", base = "9f86d081884c7d65")`. A text without its stamp is *bare*. A stamp is a statement,
not a proof: anybody can write one.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_WORD = "__urdfsync"
_STAMP = re.compile(_WORD + r'\s*\(\s*id\s*=\s*"([^"\\]*)"\s*,\s*base\s*=\s*"([^"\\]*)"\s*\)')
_MARKED = re.compile(
    rf"^<{{7,}}(?=\s)[^\n]*\n([^\n]*{_WORD}[^\n]*\n)(?:\|{{7,}}(?=\s)[^\n]*\n[^\n]*\n)?={{7,}}\r?\n[^\n]*{_WORD}[^\n]*\n>{{7,}}(?=\s)[^\n]*\n",
    re.MULTILINE,
)
"""Git's markers around a stamp alone: both branches exported the part."""
_ANY = re.compile(rf"\n[ \t]*annotation\s*\(\s*{_STAMP.pattern}\s*\)\s*;|,\s*{_STAMP.pattern}")
_LAST = rf"[ \t]*{_WORD}[^\n]*?\)[ \t]*(\)[ \t]*;\r?\n)"
_LINES = r"((?:(?![<|=>]{7})[^\n]*\n)*)"
_FIRST = re.compile(
    rf",\n(<{{7,}}(?=\s)[^\n]*\n){_LAST}{_LINES}(?:(\|{{7,}}(?=\s)[^\n]*\n){_LAST})?{_LINES}(={{7,}}\r?\n){_LAST}"
)
"""Git's markers around stamps that begin both sides, with the lines after our one."""
_TOKENS = re.compile(r'"(?:[^"\\]|\\.)*+"|//[^\n]*+|/\*.*?\*/|[;\[\]]', re.DOTALL)
_END = re.compile(r"(?:\s|//[^\n]*\n|/\*.*?\*/)*end\s+\S+\s*\Z", re.DOTALL)
_ANNOTATION = re.compile(
    r"(?:\s|//[^\n]*\n|/\*.*?\*/|(?:public|protected|initial|equation|algorithm)\b)*annotation\s*\(", re.DOTALL
)


class Stamp(NamedTuple):
    """What a generated file says about itself."""

    id: str
    """The lasting id of the file: of its part, and of its template."""
    base: str
    """The hash of the bare generated text that the file last had, or was merged with."""


def with_stamp(content: bytes, stamp: Stamp | None) -> bytes:
    """Return the content of a file with this stamp in place of its own; None for no stamp."""
    bare, _ = split(content.decode(errors="surrogateescape"))
    return (stamped(bare, stamp) if stamp else bare).encode(errors="surrogateescape")


def split(text: str) -> tuple[str, Stamp | None]:
    """Return the bare text and its stamp; None if the text has none. Of several stamps, the last one counts."""
    if _WORD not in text:
        return text, None
    if "<<<<<<<" in text and "<<<<<<<" in (text := _MARKED.sub(r"\1", text)):
        found = _STAMP.search(text)  # other lines are between markers, too, and each side may have a stamp
        return _ANY.sub("", _FIRST.sub(r"\2\1\3\4\6\7", text)), Stamp(*found.groups()) if found else None
    at = text.rfind(_WORD)
    if (found := _STAMP.match(text, at)) is None:
        return text, None
    before, after = text[:at], text[found.end() :]
    if (left := before.rstrip()).endswith(","):
        bare = left[:-1] + after
    elif (right := after.lstrip()).startswith(","):
        bare = before + right[1:].lstrip()
    else:  # its annotation has no other argument
        clause, head, _ = before.rpartition("annotation")
        closed = right.removeprefix(")")
        is_statement = re.search(r"\bend\b", closed) is not None  # nothing follows the annotation of a short class
        bare = clause.rstrip() + (closed.lstrip().removeprefix(";") if is_statement else closed)
        if not head:
            return text, None
    return bare, Stamp(*found.groups())


def stamped(bare: str, stamp: Stamp) -> str:
    """Return the text of a class with its stamp; without a class, the text itself."""
    mark, ends, depth = f'{_WORD}(id = "{stamp.id}", base = "{stamp.base}")', [-1, -1], 0
    for token in _TOKENS.finditer(bare):
        if token[0] == ";" and depth == 0:
            ends.append(token.start())
        depth += (token[0] == "[") - (token[0] == "]")
    is_long = _END.match(bare, ends[-2] + 1, ends[-1]) is not None if ends[-1] >= 0 else False
    ends = ends if not is_long else ends[:-1]
    begin, end = ends[-2] + 1, ends[-1]
    if end < 0:
        return bare
    line_end = "\r\n" if bare.endswith("\r\n") else "\n"
    if is_long and _ANNOTATION.match(bare, begin, end):
        close = bare.rindex(")", begin, end)
        comma = "" if bare[:close].rstrip().endswith("(") else f",{line_end}    "
        return f"{bare[:close]}{comma}{mark}{bare[close:]}"
    if is_long:
        return f"{bare[: end + 1]}{line_end}  annotation ({mark});{bare[end + 1 :]}"
    if re.search(r"\bannotation\s*\(", bare[begin:end]) and bare[:end].rstrip().endswith(")"):
        close = bare.rindex(")", begin, end)
        return f"{bare[:close]}, {mark}{bare[close:]}"
    return f"{bare[:end]} annotation ({mark}){bare[end:]}"
