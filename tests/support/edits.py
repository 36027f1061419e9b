"""Random edits of a generated package by hand. Whatever is put in carries a tag that is used once.

A tag is a word such as `mine000017`, or a number such as `7171.000017`, which stands in the place of another.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from random import Random

_TAG = re.compile(r"mine\d{6}|7171\.\d{6}")
_NUMBER = re.compile(r"(?<![\w.\"])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.\"])")
_ORDER = "package.order"


@dataclasses.dataclass(frozen=True)
class Line:
    """Where a tag is; the whole line is the user's if `own`, else only the tag in it."""

    path: str
    text: str
    own: bool


def tagged(files: Mapping[str, bytes]) -> dict[str, Line]:
    """The lines of all tags in these files."""
    found = {}
    for path, content in files.items():
        if not path.endswith((".mo", _ORDER)):
            continue
        for line in content.decode().splitlines():
            for tag in _TAG.findall(line):
                found[tag] = Line(path, line, own=not tag[0].isdigit() and "// shared" not in line)
    return found


def without_own(order: bytes) -> bytes:
    """A `package.order` without the user's names."""
    return b"".join(line for line in order.splitlines(keepends=True) if not _TAG.search(line.decode()))


class Hand:
    """Somebody who edits a package; `made` counts what was done, by kind."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self._count = 0
        self.made: dict[str, int] = {}

    def edit(self, package: Path) -> None:
        """Do something to a file of the package."""
        files = sorted(path for path in package.rglob("*.mo") if path.is_file())
        if not files:
            return
        names = [name for name, weight in WEIGHTS.items() for _ in range(weight)]
        name = self._random.choice(names)
        records = [path for path in files if path.stem.endswith("Parameters")]
        path = self._random.choice(records if records and self._random.random() < 0.4 else files)
        if getattr(self, f"_{name}")(path):
            self.made[name] = self.made.get(name, 0) + 1

    def _tag(self) -> str:
        self._count += 1
        return f"mine{self._count:06d}"

    # Lines

    def _comment(self, path: Path) -> bool:
        return self._insert(path, lambda lines: range(1, len(lines)), f"  // {self._tag()}")

    def _declaration(self, path: Path) -> bool:
        def places(lines: Sequence[str]) -> Sequence[int]:
            return [
                i for i, line in enumerate(lines) if re.match(r"equation|  annotation|  parameter |  Modelica", line)
            ]

        tag = self._tag()
        blank = "\n" if self._random.random() < 0.5 else ""
        return self._insert(path, places, f'  Real {tag} = {self._random.randint(0, 9)} "Mine";{blank}')

    def _equation(self, path: Path) -> bool:
        def places(lines: Sequence[str]) -> Sequence[int]:
            return [i + 1 for i, line in enumerate(lines) if line == "equation"]

        tag = self._tag()
        return self._insert(path, places, f"  {tag} = der({tag}) + time;")

    def _remark(self, path: Path) -> bool:
        """A comment at the end of a line that may change."""
        return self._change_line(
            path, lambda line: f"{line}  // shared {self._tag()}" if line.endswith((",", ";")) else line
        )

    def _number(self, path: Path) -> bool:
        def change(line: str) -> str:
            found = list(_NUMBER.finditer(line))
            if not found or _TAG.search(line):
                return line
            self._count += 1
            match = self._random.choice(found)
            return f"{line[: match.start()]}7171.{self._count:06d}{line[match.end() :]}"

        return self._change_line(path, change)

    def _delete_line(self, path: Path) -> bool:
        lines = _lines(path)
        places = [i for i, line in enumerate(lines[1:-1], 1) if line.strip()]
        if not places:
            return False
        del lines[self._random.choice(places)]
        return _write(path, lines)

    def _move_block(self, path: Path) -> bool:
        """A paragraph goes somewhere else in the file."""
        blocks = _read(path).split("\n\n")
        if len(blocks) < 4:
            return False
        block = blocks.pop(self._random.randrange(1, len(blocks) - 1))
        blocks.insert(self._random.randrange(1, len(blocks)), block)
        return _write(path, "\n\n".join(blocks).split("\n"))

    # Files

    def _order_line(self, path: Path) -> bool:
        order = path.with_name(_ORDER)
        if not order.exists():
            return False
        return self._insert(order, lambda lines: range(len(lines)), self._tag())

    def _own_file(self, path: Path) -> bool:
        tag = self._tag()
        path.with_name(f"{tag}.mo").write_text(f"within Bot;\nmodel {tag}\n  Real x = 1;\nend {tag};\n")
        return True

    def _delete_file(self, path: Path) -> bool:
        path.unlink()
        return True

    def _rename_file(self, path: Path) -> bool:
        path.rename(path.with_name(f"{self._tag()}.mo"))
        return True

    def _windows(self, path: Path) -> bool:
        path.write_bytes(_read(path).replace("\n", "\r\n").encode())
        return True

    def _folder(self, path: Path) -> bool:
        """The class gets a folder of its own."""
        if path.name == "package.mo":
            return False
        folder = path.with_suffix("")
        folder.mkdir(exist_ok=True)
        path.rename(folder / "package.mo")
        return True

    def _swap_newlines(self, path: Path) -> bool:
        """No line end at the end of the file."""
        path.write_bytes(path.read_bytes().rstrip())
        return True

    # Means

    def _insert(self, path: Path, places: Callable[[Sequence[str]], Sequence[int]], text: str) -> bool:
        lines = _lines(path)
        chosen = places(lines)
        if not chosen:
            return False
        lines.insert(self._random.choice(chosen), text)
        return _write(path, lines)

    def _change_line(self, path: Path, change: Callable[[str], str]) -> bool:
        lines = _lines(path)
        place = self._random.randrange(len(lines))
        changed = change(lines[place])
        if changed == lines[place]:
            return False
        lines[place] = changed
        return _write(path, lines)


WEIGHTS = {
    "comment": 6,
    "declaration": 4,
    "equation": 3,
    "remark": 4,
    "number": 12,
    "delete_line": 3,
    "move_block": 1,
    "order_line": 1,
    "own_file": 1,
    "delete_file": 1,
    "rename_file": 1,
    "windows": 2,
    "folder": 1,
    "swap_newlines": 1,
}
"""How often each kind of edit is tried."""


def _read(path: Path) -> str:
    return path.read_bytes().decode().replace("\r\n", "\n")


def _lines(path: Path) -> list[str]:
    return _read(path).split("\n")


def _write(path: Path, lines: Sequence[str]) -> bool:
    """Write lines with the line ends that the file has."""
    ending = "\r\n" if b"\r\n" in path.read_bytes() else "\n"
    path.write_bytes("\n".join(lines).replace("\n", ending).encode())
    return True
