"""Random edits of a generated package by hand. Each added text has a unique tag.

A tag is a word such as `mine000017`, or a number such as `7171.000017` that replaces another number.
"""

from __future__ import annotations

import collections
import dataclasses
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from random import Random

_TAG = re.compile(r"mine\d{6}|7171\.\d{6}")
_NUMBER = re.compile(r"(?<![\w.\"])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.\"])")
_LAYOUT = re.compile(r"\b(?:Placement|Line)\(")
_ORDER = "package.order"

Edit = Callable[[Path, Random, str], object]
"""Edits a file, or adds one beside it; the text is a unique number."""
LineEdit = Callable[[list[str], Random, str], object]


@dataclasses.dataclass(frozen=True)
class Line:
    """The line of a tag; if `own`, the whole line is the user's, else only the tag."""

    path: str
    text: str
    own: bool


def tagged(files: Mapping[str, bytes]) -> dict[str, Line]:
    """The lines of all tags in these files; numbers in the layout of a part go with the part."""
    found = {}
    for path, content in files.items():
        if path.endswith((".mo", _ORDER)):
            for line in content.decode().splitlines():
                for tag in _TAG.findall(line):
                    if tag[0].isdigit() and _LAYOUT.search(line):
                        continue
                    found[tag] = Line(path, line, own=not tag[0].isdigit() and "// shared" not in line)
    return found


class Hand:
    """A person who edits a package; `made` counts the tried edits by kind."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self.made = collections.Counter[str]()

    def edit(self, package: Path) -> None:
        """Edit a random file of the package."""
        if not (files := sorted(path for path in package.rglob("*.mo") if path.is_file())):
            return
        records = [path for path in files if path.stem.endswith("Parameters")]
        path = self._random.choice(records if records and self._random.random() < 0.4 else files)
        (name,) = self._random.choices(list(EDITS), [weight for weight, _ in EDITS.values()])
        EDITS[name][1](path, self._random, f"{sum(self.made.values()):06d}")
        self.made[name] += 1


# Lines


def _in_lines(change: LineEdit) -> Edit:
    """An edit of a file's lines, which keeps its line ends."""

    def edit(path: Path, random: Random, number: str) -> None:
        text = path.read_bytes().decode()
        lines = text.replace("\r\n", "\n").split("\n")
        change(lines, random, number)
        path.write_bytes("\n".join(lines).replace("\n", "\r\n" if "\r\n" in text else "\n").encode())

    return edit


def _insert(*texts: str, before: str = "", after: str = "") -> Edit:
    """Add a line of the user's beside a line that matches."""

    def change(lines: list[str], random: Random, number: str) -> None:
        neighbours = range(1, len(lines))
        if places := [n for n in neighbours if re.match(before, lines[n]) and re.match(after, lines[n - 1])]:
            lines.insert(random.choice(places), random.choice(texts).format(tag=f"mine{number}"))

    return _in_lines(change)


def _remark(lines: list[str], random: Random, number: str) -> None:
    """A comment at the end of a line that may change."""
    place = random.randrange(len(lines))
    if lines[place].endswith((",", ";")):
        lines[place] += f"  // shared mine{number}"


def _number(lines: list[str], random: Random, number: str) -> None:
    place = random.randrange(len(lines))
    line = lines[place]
    if (found := list(_NUMBER.finditer(line))) and not _TAG.search(line):
        match = random.choice(found)
        lines[place] = f"{line[: match.start()]}7171.{number}{line[match.end() :]}"


def _delete_line(lines: list[str], random: Random, number: str) -> None:
    if places := [place for place, line in enumerate(lines[1:-1], 1) if line.strip()]:
        del lines[random.choice(places)]


def _move_block(lines: list[str], random: Random, number: str) -> None:
    """Move a paragraph to another place in the file."""
    blocks = "\n".join(lines).split("\n\n")
    if len(blocks) > 3:
        block = blocks.pop(random.randrange(1, len(blocks) - 1))
        blocks.insert(random.randrange(1, len(blocks)), block)
        lines[:] = "\n\n".join(blocks).split("\n")


# Files


def _order_line(path: Path, random: Random, number: str) -> None:
    if (order := path.with_name(_ORDER)).exists():
        _in_lines(lambda lines, *_: lines.insert(random.randrange(len(lines)), f"mine{number}"))(order, random, number)


def _own_file(path: Path, random: Random, number: str) -> None:
    name = f"mine{number}"
    path.with_name(f"{name}.mo").write_text(f"within Bot;\nmodel {name}\n  Real x = 1;\nend {name};\n")


def _windows(path: Path, random: Random, number: str) -> None:
    path.write_bytes(path.read_bytes().replace(b"\r\n", b"\n").replace(b"\n", b"\r\n"))


def _folder(path: Path, random: Random, number: str) -> None:
    """The class gets a folder of its own."""
    if path.name != "package.mo":
        path.with_suffix("").mkdir(exist_ok=True)
        path.rename(path.with_suffix("") / "package.mo")


EDITS: Mapping[str, tuple[int, Edit]] = {
    "comment": (6, _insert("  // {tag}")),
    "declaration": (
        4,
        _insert('  Real {tag} = 7 "Mine";', '  Real {tag} = 3 "Mine";\n', before="equation|  [apM]"),
    ),
    "equation": (3, _insert("  {tag} = der({tag}) + time;", after="equation$")),
    "remark": (4, _in_lines(_remark)),
    "number": (12, _in_lines(_number)),
    "delete line": (3, _in_lines(_delete_line)),
    "move block": (1, _in_lines(_move_block)),
    "order line": (1, _order_line),
    "own file": (1, _own_file),
    "delete file": (1, lambda path, *_: path.unlink()),
    "rename file": (1, lambda path, _, number: path.rename(path.with_name(f"mine{number}.mo"))),
    "windows": (2, _windows),
    "folder": (1, _folder),
    "no line end": (1, lambda path, *_: path.write_bytes(path.read_bytes().rstrip())),
}
"""By kind: the frequency and the edit."""
