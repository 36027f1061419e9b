"""Damaged sources in XML, and what reading one must give."""

from __future__ import annotations

import random
import re
from pathlib import Path

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import registry
from urdfsync.engine.sources.source import read_file_source, read_permissively

_NUMBERS = ("0", "-1", "nan", "inf", "1e300", "-1e-300", "99999999999", "", "1 2 3 4 5 6 7 8 9", "&#55;", "../../etc")


def damaged(text: str, seed: int, word: str) -> bytes:
    """Return a text that is cut off, or has another number, word, line or byte; the group of `word` is a word."""
    choice, lines = random.Random(seed), text.splitlines(keepends=True)
    match seed % 5:
        case 0:
            return text[: choice.randrange(len(text))].encode()
        case 1:
            found = choice.choice([*re.finditer(r"-?\d+\.?\d*", text)])
            return f"{text[: found.start()]}{choice.choice(_NUMBERS)}{text[found.end() :]}".encode()
        case 2:
            one, other = (choice.choice([*re.finditer(word, text)]) for _ in range(2))
            return f"{text[: one.start(1)]}{other[1]}{text[one.end(1) :]}".encode()
        case 3:
            first, second = choice.randrange(len(lines)), choice.randrange(len(lines))
            lines[first] = choice.choice((lines[second], ""))
            return "".join(lines).encode()
    content = bytearray(text.encode())
    content[choice.randrange(len(content))] = choice.randrange(256)
    return bytes(content)


def assert_robot_or_finding(file: Path) -> None:
    """Read a source in its own process: it is a robot, or has findings that are no accident of the process."""
    domain = registry.domain("urdf")
    try:
        read_permissively(domain, read_file_source(domain, file, {}, ()))
    except SourceError as error:
        messages = [finding.message for finding in error.diagnostics]
        assert all(messages)
        assert not any(re.match(r"exit code|signal|expanding it takes", message) for message in messages)
