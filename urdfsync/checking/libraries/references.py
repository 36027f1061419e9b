"""Which files of a Modelica library a text needs: pure functions on names.

A name is looked for the way the language does it, in the classes around and through imports; what is inherited is
found in the file that it is inherited from. Whatever may be a reference counts as one.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Collection, Iterable, Iterator

_NOISE = re.compile(r"""("(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/)|('(?:\\.|[^'\\])*')""", re.DOTALL)
_DOTTED = re.compile(r"[A-Za-z_]\w*(?:\s*\.\s*[A-Za-z_]\w*)*")
_IMPORT = re.compile(
    r"\bimport\s+(?:([A-Za-z_]\w*)\s*=\s*)?\.?\s*([A-Za-z_]\w*(?:\s*\.\s*[A-Za-z_]\w*)*)"
    r"(\s*\.\s*\*|\s*\.\s*\{[^}]*\})?"
)
_FIRST = re.compile(r"([\])']\s*\.\s*)?([A-Za-z_]\w*)(?:\s*\.\s*[A-Za-z_]\w*)+")
"""A name with dots; the first group is what makes it a part of something else, as in `a[1].b.c`."""
_SPACE = re.compile(r"\s+")


def mentioned(texts: Iterable[str], library: str = "Modelica") -> set[str]:
    """Full names below the top-level package `library` that Modelica texts use, imports resolved.

    An import of all that a package has ends in `.*`.
    """
    codes = [_code(text) for text in texts]
    short: dict[str, set[str]] = {}
    found: set[str] = set()
    for alias, full, rest in (one for code in codes for one in _imports(code)):
        short.setdefault(alias, set()).add(full)
        found |= {f"{full}{end}" for end in rest or ("",)}
    for name in {name for code in codes for name in _names(_IMPORT.sub("", code))}:
        first, dot, others = name.partition(".")
        found |= {name, *(f"{full}{dot}{others}" for full in short.get(first, ()))}
    return {name for name in found if name.startswith(f"{library}.")}


def beginnings(texts: Iterable[str]) -> set[str]:
    """The top-level classes that Modelica texts may refer to: what they import, and what names with dots begin with.

    Those names count only if they begin with a capital: components begin otherwise.
    """
    codes = [_code(text) for text in texts]
    imported = {full.partition(".")[0] for code in codes for _, full, _ in _imports(code)}
    names = (found for code in codes for found in _FIRST.finditer(_IMPORT.sub("", code)))
    return imported | {found[2] for found in names if not found[1] and found[2][0].isupper()}


def entry_of(name: str, entries: Collection[str]) -> str:
    """The file that holds the class `name`, by its own class's full name; empty if the library has no such file."""
    parts = name.split(".")
    found = ""
    for count in range(1, len(parts) + 1):
        longer = ".".join(parts[:count])
        if longer not in entries:
            break
        found = longer
    return found


def closure(seeds: Iterable[str], entries: Collection[str], read: Callable[[str], str]) -> set[str]:
    """The files that files need, and those in turn; `entries` are all that there are, `read` gives the text of one."""
    code = functools.cache(lambda entry: _code(read(entry)))
    seen: set[str] = set()
    waiting = list(seeds)
    while waiting:
        entry = waiting.pop()
        if entry and entry not in seen:
            seen.add(entry)
            waiting += [entry.rpartition(".")[0], *_needed(entry, entries, code)]
    return seen


def _needed(entry: str, entries: Collection[str], code: Callable[[str], str]) -> Iterator[str]:
    """The files that a file refers to; imports of the packages around it count in it as well."""
    around = list(_around(entry))
    scopes = list(around)
    short: dict[str, list[str]] = {}
    for alias, full, rest in (one for scope in around for one in _imports(code(scope))):
        short.setdefault(alias, []).append(full)
        scopes += [full for end in rest if end == ".*"]
    for name in set(_names(code(entry))):
        first, dot, others = name.partition(".")
        yield entry_of(name, entries)
        yield from (entry_of(f"{full}{dot}{others}", entries) for full in short.get(first, ()))
        scope = next((scope for scope in scopes if f"{scope}.{first}" in entries), None)
        if scope:
            yield entry_of(f"{scope}.{name}", entries)


def _around(entry: str) -> Iterator[str]:
    """A class and those around it, from the inside."""
    while entry:
        yield entry
        entry = entry.rpartition(".")[0]


def _imports(code: str) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Short name, full name, and what is taken out of it (`.*` or `.name`) of each import."""
    for found in _IMPORT.finditer(code):
        full = _SPACE.sub("", found[2])
        rest = _SPACE.sub("", found[3] or "")
        if rest.startswith(".{"):
            for name in rest[2:-1].split(","):
                alias, _, other = name.partition("=")
                yield alias, f"{full}.{other or alias}", ()
        else:
            yield found[1] or full.rpartition(".")[2], full, (rest,) if rest else ()


def _names(code: str) -> Iterator[str]:
    yield from (_SPACE.sub("", name) for name in _DOTTED.findall(code))


def _code(text: str) -> str:
    """A text without comments, and with empty strings and quoted names."""
    return _NOISE.sub(lambda found: "''" if found[2] else '""', text)
