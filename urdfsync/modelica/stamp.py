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
_LINES = r"((?:(?![<|=>]{7})[^\n]*\n)*+)"
_FIRST = re.compile(
    rf",\n(<{{7,}}(?=\s)[^\n]*\n){_LAST}{_LINES}(?:(\|{{7,}}(?=\s)[^\n]*\n){_LAST})?{_LINES}(={{7,}}\r?\n){_LAST}"
)
"""Git's markers around stamps that begin both sides, with the lines after our one."""
_ALONE = re.compile(r"(\s*\))\s*;[ \t]*(\r?\n)?")
_OPENING = re.compile(r"\bannotation\s*\($")
_TOKENS = re.compile(r'"(?:[^"\\]|\\.)*+(?:"|\\?\Z)|//[^\n]*+|/\*(?:[^*]|\*(?!/))*+(?:\*/|\Z)|[;\[\]]', re.DOTALL)
_BLANKS = r"(?:\s|//[^\n]*\n|/\*(?:[^*]|\*(?!/))*+\*/)*+"
_END = re.compile(rf"\bend\b{_BLANKS}[^\s;/]++{_BLANKS}$")
_PREFIXES = r"(?:(?:encapsulated|partial|operator|expandable|pure|impure)\s++)*+"
_STRINGS = rf"(?:\"(?:[^\"\\]|\\.)*+\"{_BLANKS}\+?{_BLANKS})*+"
_HEAD = (
    rf"(?:{_PREFIXES}(?:package|model|record|block|class|connector|function|type)\s++[^\s;\"]++{_BLANKS}{_STRINGS})?+"
)
_BROKEN_END = re.compile(r"\)\s*;\s*end\s+[^\s;]+\s*;\s*$")
_ANNOTATION = re.compile(
    rf"{_BLANKS}{_HEAD}(?:(?:public|protected|initial|equation|algorithm)\b{_BLANKS})*+annotation\s*\(", re.DOTALL
)


class Stamp(NamedTuple):
    """What a generated file says about itself."""

    id: str
    """The lasting id of the file: of its part, and of its template."""
    base: str
    """The hash of the bare generated text that the file last had, or was merged with."""


def with_stamp(content: bytes, stamp: Stamp | None) -> bytes:
    """Return the content of a file with this stamp in place of its own; None for no stamp."""
    if stamp is None and _WORD.encode() not in content:
        return content
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
    code, comments = _code_before(before)
    if code.endswith(","):
        bare = code[:-1] + comments + after
    elif not comments and (right := after.lstrip()).startswith(","):
        bare = before + right[1:].lstrip()
    elif "//" in comments.rpartition("\n")[2]:
        return text, None  # the user has turned it into a comment
    elif comments or not ((alone := _ALONE.match(after)) and (opening := _OPENING.search(code))):
        bare = before + after
    else:
        head, rest = code[: opening.start()], after[alone.end(1) :]
        if re.search(r"\bend\b", after) is None:  # nothing follows the annotation of a short class
            bare = (head if _code_before(head)[1] else head.rstrip()) + rest
        else:
            line = head.rstrip(" \t")
            is_line = line.endswith("\n") and alone[2]
            bare = line + after[alone.end() :] if is_line else head + rest[1:].lstrip(" ")
    return bare, Stamp(*found.groups())


def _code_before(text: str) -> tuple[str, str]:
    """Split a text behind its last code; the second part is empty without comments."""
    code = text.rstrip()
    if "//" not in code[code.rfind("\n") + 1 :] and not code.endswith("*/"):
        return code, ""
    end = len(text)
    for token in reversed([one for one in _TOKENS.finditer(text) if one[0].startswith(("//", "/*"))]):
        if text[token.end() : end].strip():
            break
        end = token.start()
    code = text[:end].rstrip()
    return code, text[len(code) :] if end < len(text) else ""


def stamped(bare: str, stamp: Stamp) -> str:
    """Return the text of a class with its stamp; the text itself if it has no class, or is too broken for a stamp."""
    mark = f'{_WORD}(id = "{stamp.id}", base = "{stamp.base}")'
    text = _stamped(bare, mark)
    if split(text) != (bare, stamp) and (end := _BROKEN_END.search(bare)):  # a broken string goes on to the end
        text = f"{bare[: end.start()]}, {mark}{end[0]}"
    return text if split(text) == (bare, stamp) else bare


def _stamped(bare: str, mark: str) -> str:
    ends, depth = [-1, -1], 0
    for token in _TOKENS.finditer(bare):
        if token[0] == ";" and depth == 0:
            ends.append(token.start())
        depth += (token[0] == "[") - (token[0] == "]")
    if (end := ends[-1]) < 0:
        return bare
    line_end = "\r\n" if bare.endswith("\r\n") else "\n"
    if last := _END.search(bare, ends[-2] + 1, end):
        if _ANNOTATION.match(bare, ends[-3] + 1, ends[-2]):
            return _with_argument(bare, ends[-2], mark, f",{line_end}    ")
        place = last.start()
        clause = f"  annotation ({mark});{line_end}" if bare[:place].endswith("\n") else f"annotation ({mark}); "
        return bare[:place] + clause + bare[place:]
    if re.search(r"\bannotation\s*\(", bare[ends[-2] + 1 : end]) and bare[:end].rstrip().endswith(")"):
        return _with_argument(bare, end, mark, ", ")
    blank = "" if _code_before(bare[:end])[1] else " "
    return f"{bare[:end]}{blank}annotation ({mark}){bare[end:]}"


def _with_argument(text: str, end: int, argument: str, separator: str) -> str:
    """Return a text with one more argument of the annotation that ends before this place."""
    close = len(_code_before(text[:end])[0]) - 1
    code, comments = _code_before(text[:close])
    if comments:  # the comma in front of them
        return f"{code}{'' if code.endswith('(') else ','}{comments}{argument}{text[close:]}"
    return f"{text[:close]}{'' if code.endswith('(') else separator}{argument}{text[close:]}"
