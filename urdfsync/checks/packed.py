"""Writes a library of many files as one text, without looks and documentation.

rumoca 0.10.2 looks at every file of every library for each model: one file takes half the time of hundreds.
A comment stands before the text of each file, so that places in messages lead back to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfsync.modelica.tree import LAYOUT

_STRING = r'"(?:\\.|[^"\\])*"'
_REMARK = r"//[^\n]*|/\*.*?\*/"
_FRONT = re.compile(rf"\ufeff?(?:\s+|{_REMARK})*(?:within\b[^;]*;)?", re.DOTALL)
"""What stands before a class in a file."""
_LOOKS = "|".join((*sorted(LAYOUT), "Documentation"))
_TOKEN = re.compile(
    rf"{_STRING}|'(?:\\.|[^'\\])*'|{_REMARK}|\bannotation\b|(?P<looks>\b(?:{_LOOKS})\s*\()|[()]", re.DOTALL
)
_MARK = "// urdfsync: "


def packed(library: Path) -> str:
    """Return the text of a library, which is a folder or a file. Raises OSError."""
    return "".join(_texts(library, library if library.is_dir() else library.parent))


def original_place(text: str, line: int) -> tuple[str, int]:
    """Return file (from the library's folder) and line of a line (from 1) of a packed text."""
    lines = text.split("\n")[:line]
    number = max((number for number, each in enumerate(lines) if each.startswith(_MARK)), default=None)
    if number is None:
        return "", line
    file, _, first = lines[number].removeprefix(_MARK).rpartition(":")
    return file, int(first) + line - number - 2


def _texts(path: Path, top: Path) -> Iterator[str]:
    """Yield the text of a class: up to its name and comment, then its parts in other files, then its rest."""
    file = path / "package.mo" if path.is_dir() else path
    text = _FRONT.sub(lambda front: "\n" * front[0].count("\n"), _plain(file.read_text("utf-8", "surrogateescape")), 1)
    place = file.relative_to(top).as_posix()
    if path.is_dir():
        name = re.compile(rf"\b{re.escape(path.name)}\b(?:\s*\+?\s*{_STRING})*", re.DOTALL)
        head = match.end() if (match := name.search(text)) else 0
        yield f"\n{_MARK}{place}:1\n{text[:head]}"
        for part in sorted(path.iterdir()):
            if (part / "package.mo").is_file() or (part.suffix == ".mo" and part != file):
                yield from _texts(part, top)
        yield f"\n{_MARK}{place}:{1 + text.count(chr(10), 0, head)}\n{text[head:]}"
    else:
        yield f"\n{_MARK}{place}:1\n{text}"


def _plain(text: str) -> str:
    """Empty the annotations about looks and documentation; lines stay where they are."""
    kept, start, depth, cut, begins = list[str](), 0, 0, 0, False
    for token in _TOKEN.finditer(text):
        if token["looks"] and depth and not cut:
            kept.append(text[start : token.end()])
            depth += 1
            cut, start = depth, token.end()
        elif token[0][-1] == "(" and (begins or depth):
            begins, depth = False, depth + 1
        elif token[0] == ")" and depth:
            if cut == depth:
                kept.append("\n" * text.count("\n", start, token.start()))
                cut, start = 0, token.start()
            depth -= 1
        elif token[0] == "annotation":
            begins = True
    return "".join((*kept, text[start:]))
