"""Whether a merge still makes sense as Modelica: the same answer on every machine, with or without a compiler."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from urdfsync.merging.tokens import NEWLINE
from urdfsync.modelica.lexer import Fault
from urdfsync.modelica.parser import parse

_MARKER = re.compile(r"(<{7}|\|{7}|={7}|>{7})(\s|$)")


def flaw(text: str, sides: Sequence[str]) -> str:
    """Why a merged text can't be right, as the end of a sentence that begins with "the merge"; empty if it can.

    What is wrong with one of the sides already, as often as in the merge, is no flaw: a side's odd text is its
    author's business. Names are not resolved, and types not checked: only a compiler can do that.
    """
    found = _faults(text)
    known: Counter[str] = Counter()
    for side in sides if found else ():
        known |= Counter(fault.reason for fault in _faults(side))
    seen: Counter[str] = Counter()
    for reason, line in found:
        seen[reason] += 1
        if seen[reason] > known[reason]:
            return f"{reason} (line {line})"
    return ""


def markers(text: str) -> list[Fault]:
    """Lines that look like conflict markers; they may also stand in a documentation."""
    return [
        Fault(f"has the conflict marker `{marker[1]}`", number)
        for number, line in enumerate(text.split(NEWLINE), start=1)
        if (marker := _MARKER.match(line))
    ]


def _faults(text: str) -> list[Fault]:
    return [*markers(text), *parse(text).faults]
