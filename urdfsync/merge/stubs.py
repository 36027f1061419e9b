"""Short stand-ins in the texts of a merge for what the user did not touch: reading it takes nearly all of the time.

Where mine has a component or connection as base has it, the merge has the generated text of it: all that has to be
known of it is its name. A stand-in has the same name and as many lines. Where what it replaces is none of that, such as
a line in a documentation, nothing is lost: each comes back for exactly what it stands for.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from urdfsync.modelica.lexer import is_name

_WORD = "urdfsyncStub"
_END = ";\n"
_CONNECTION = re.compile(r"\s*connect\(([\w.\[\]]+), ([\w.\[\]]+)\)(?=\s|\Z)")
_COMPONENT = re.compile(
    r"\s*(?:(?:replaceable|inner|outer|final|parameter|constant)\s+)*\.?(\w+)(?:\.\w+)*\s+(\w+)(?=[\s(]|\Z)"
)
_TAIL = re.compile(r"\n  annotation \((.*)\);\nend \w+;\s*\Z", re.DOTALL)
_STUB = re.compile(
    rf"{_WORD}(\d+)\s+\w+|connect\([^()]*\)\s+annotation \({_WORD}(\d+)\)|{_WORD}(\d+)\s*(?=\);\nend \w+;\s*\Z)"
)


class Stubs:
    """Base, mine and generated text with stand-ins, and what these stand for."""

    def __init__(self, base: str, mine: str, generated: str) -> None:
        self._originals: list[str] = []
        self._numbers: dict[str, int] = {}
        self.texts = [base, mine, generated]
        if any(_WORD in text or "\r" in text for text in self.texts):
            return
        statements = [text.split(_END) for text in self.texts]
        old, own, new = (_by_key(one) for one in statements)
        same = {key for key, text in old.items() if text and own.get(key) == text and new.get(key, text)}
        tails = [_TAIL.search(text, max(text.rfind("\n  annotation ("), 0)) for text in self.texts]
        drawn = [tail[1] if tail else "" for tail in tails]
        # where the user has arranged something, the generated text alone does not decide what stands where
        if drawn[0] != drawn[1] or _annotations(statements[0], statements[1]) - _annotations(
            statements[1], statements[0]
        ):
            return
        for number, (text, tail) in enumerate(zip(self.texts, tails, strict=True)):
            if tail and all(tails):
                text = f"{text[: tail.start(1)]}{self._stub('', tail[1])}{text[tail.end(1) :]}"
            parts = (self._stub(key, one) if (key := _key(one)) in same else one for one in text.split(_END))
            self.texts[number] = _END.join(parts)

    def expand(self, text: str) -> str:
        """Return a text with the originals of its stand-ins."""
        return _STUB.sub(lambda found: self._originals[int(found[found.lastindex or 0])], text)

    def _stub(self, key: str, text: str) -> str:
        """The stand-in for a statement, or for the annotation of a class, which has no key."""
        kind, *names = key.split() or [""]
        blanks = text[: len(text) - len(text.lstrip())] if kind else ""
        inner = text[len(blanks) :]
        number = self._numbers.setdefault(inner, len(self._originals))
        self._originals += [inner] if number == len(self._originals) else []
        word = f"{_WORD}{number}"
        lines = "\n" * inner.count("\n")
        if kind == "connect":
            return f"{blanks}{inner[: inner.index(')') + 1]}{lines or ' '} annotation ({word})"
        return f"{blanks}{word}{lines or ' '}{' '.join(names)}"


def _key(statement: str) -> str:
    """What names a plain component or connection; empty for anything else."""
    if "//" in statement or "/*" in statement or ";" in statement:
        return ""
    if found := _CONNECTION.match(statement):
        return f"connect {' '.join(sorted(found.groups()))}"
    found = _COMPONENT.match(statement)
    return f"component {found[2]}" if found and is_name(found[1]) and is_name(found[2]) else ""


def _by_key(statements: Sequence[str]) -> Mapping[str, str]:
    """The statements by their keys; one that is there twice is there with an empty text."""
    found: dict[str, str] = {}
    for statement in statements:
        if key := _key(statement):
            found[key] = "" if key in found else statement
    return found


def _annotations(statements: Sequence[str], others: Sequence[str]) -> Counter[str]:
    """The annotations of statements that the others do not have."""
    known = set(others)
    found = (one.partition("annotation (")[2] for one in statements if one not in known)
    return Counter(annotation for annotation in found if annotation)
