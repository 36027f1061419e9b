"""Commands as users run them, and their output."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from typing import Any, NamedTuple

from support.documents import is_described


class Printed(NamedTuple):
    """The two output streams of a command, and its exit code."""

    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[str]:
        """The lines of the output."""
        return _with_slashes(self.out).splitlines()

    @property
    def errors(self) -> list[str]:
        """The lines of the error stream."""
        return _with_slashes(self.err).splitlines()

    @property
    def words(self) -> str:
        """Both streams without the line breaks that a terminal's width adds."""
        return " ".join(_with_slashes(self.out + self.err).split())

    @property
    def json(self) -> Any:
        """The JSON document, which must be the whole output and obey its schema."""
        assert self.err == ""
        document = json.loads(self.out)
        if command := document.get("command"):
            assert is_described(document, command)
        return document


def _with_slashes(text: str) -> str:
    """A text, or JSON, with paths as tests write them, on Windows, too."""
    return text if os.sep == "/" else re.sub(r"\\+(?=[\w.])", "/", text)


class Terminal:
    """Somebody who answers."""

    def __init__(self, words: str) -> None:
        self._words = words

    def isatty(self) -> bool:
        return True

    def readline(self) -> str:
        return self._words


Execute = Callable[..., Printed]
"""The fixture `execute`."""

Editor = Callable[[str], object]
"""The fixture `editor`."""
SETTLE = """
lines = file.read_text().splitlines(keepends=True)
begin, end = (next(n for n, line in enumerate(lines) if line.startswith(mark)) for mark in ("<<<<<<<", ">>>>>>>"))
lines[begin : end + 1] = ['  Real mine "1 %";\\n']
file.write_text("".join(lines))
"""
"""The script of an editor that takes both sides of a conflict."""
