"""Commands as their users run them, and what they print."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, NamedTuple


class Printed(NamedTuple):
    """What a command printed on its two streams, and its exit code."""

    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[str]:
        """The lines of the output."""
        return self.out.splitlines()

    @property
    def errors(self) -> list[str]:
        """The lines of the error stream."""
        return self.err.splitlines()

    @property
    def words(self) -> str:
        """Both streams without line breaks, wherever a terminal's width has put them."""
        return " ".join((self.out + self.err).split())

    @property
    def json(self) -> Any:
        """The document for programs, which has the output for itself."""
        assert self.err == ""
        return json.loads(self.out)


Execute = Callable[..., Printed]
"""The fixture `execute`."""
