"""Finds the regular expressions of the program, and tries each on texts that may take it long.

As a program, it tries all of them, or those of its arguments. A signal ends it if one takes more than a second of CPU
time for 200 kB: the last line of its output has the pattern.
"""

from __future__ import annotations

import ast
import builtins
import importlib
import itertools
import re
import signal
import sys
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from re import _compiler, _parser  # type: ignore[attr-defined]
from re import _constants as ops  # type: ignore[attr-defined]
from typing import Any, NamedTuple, TypeAlias

PACKAGE = Path(__file__).parents[2] / "urdfsync"
FLAGS_AT = {"compile": 1, "sub": 4, "subn": 4, "split": 3}
"""The position of the argument `flags` of functions of `re`; 2 for all others."""
METHODS = {"match", "fullmatch", "search", "sub", "subn", "finditer", "findall", "split"}
REPEATS = (ops.MAX_REPEAT, ops.MIN_REPEAT, ops.POSSESSIVE_REPEAT)
ONE_CHARACTER = (ops.LITERAL, ops.NOT_LITERAL, ops.ANY, ops.IN)
CHARACTERS = "a 0\n\t;\"'/*<>=-_.,()[]{}|:#@A\\é$%^&+?!~`\0"
SHORT, LARGE = 1_000, 200_000
LOCAL = {
    ("analysis/checks/compilers/omc.py", "task.pattern"): "['.*']",  # of the user's own command line
    ("analysis/checks/compilers/rumoca.py", "task.pattern"): "['.*']",
    ("engine/sources/file_kinds.py", "pattern"): "[pattern for _, pattern, _ in _OTHERS]",
    ("engine/package/imports.py", "beginning"): "[*_HINTS]",
    ("modelica/files.py", "b'\\\\b' + re.escape(name) + b'\\\\b'"): "[rb'\\bname\\b']",
    ("formats/urdf/meshes/reading.py", "statements"): "[rb'^ *((?:[vf]|usemtl) .*)', rb'^ *([vf] .*)']",
}
"""Local names, by module and argument of `re`, with an expression for the patterns that they stand for."""

Token: TypeAlias = tuple[Any, Any]
"""An operation of a parsed pattern and its arguments, as `re._parser` makes them."""
Attack: TypeAlias = tuple[str, str, str]
"""A text: a beginning, a part that is repeated, and an end."""


class Pattern(NamedTuple):
    """A regular expression of the program, and the methods that it is used with."""

    place: str
    compiled: re.Pattern[Any]
    methods: frozenset[str]


class _Stub(str):
    """Stands for a local name in an expression: a text or path that may be called, and has all attributes."""

    __slots__ = ()

    def __getattr__(self, name: str) -> _Stub:
        return self

    def __call__(self, *arguments: object, **keywords: object) -> _Stub:
        return self

    def __truediv__(self, name: str) -> _Stub:
        return self


class _Names(dict[str, object]):
    """The names of a module. Other names are local."""

    def __missing__(self, name: str) -> _Stub:
        return _Stub("name")


def find_patterns() -> list[Pattern]:
    """Return each pattern that the program gives to a function of `re`."""
    trees = {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.rglob("*.py"))}
    used = {path: _methods_by_name(tree) for path, tree in trees.items()}
    return [pattern for path, tree in trees.items() for pattern in _find_in(path, tree, used)]


def _methods_by_name(tree: ast.Module) -> Mapping[str, set[str]]:
    """Return by each name the methods of patterns that a module calls on a value with this name in it."""
    methods = defaultdict[str, set[str]](set)
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in METHODS:
            for part in ast.walk(node.func.value):
                if isinstance(part, ast.Name | ast.Attribute):
                    methods[part.id if isinstance(part, ast.Name) else part.attr].add(node.func.attr)
    return methods


def _find_in(path: Path, tree: ast.Module, used: Mapping[Path, Mapping[str, set[str]]]) -> Iterator[Pattern]:
    name = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    module = importlib.import_module(name.removesuffix(".__init__"))
    names, local = _Names(vars(builtins) | vars(module)), path.relative_to(PACKAGE).as_posix()
    targets = {
        part: node.targets[0] if isinstance(node, ast.Assign) else node.target
        for node in tree.body
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value
        for part in ast.walk(node.value)
    }
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr != "escape"):
            continue
        if not (isinstance(node.func.value, ast.Name) and node.func.value.id == "re"):
            continue
        place, function, argument = f"{local}:{node.lineno}", node.func.attr, ast.unparse(node.args[0])
        at = FLAGS_AT.get(function, 2)
        given = [*node.args[at : at + 1], *(word.value for word in node.keywords if word.arg == "flags")]
        flags = sum(eval(ast.unparse(flag), names) for flag in given)
        methods = {function}
        if function == "compile":  # another module may use a public name
            name = getattr(targets.get(node), "id", "")
            users = [path] if name.startswith("_") else used
            methods = {method for user in users for method in used[user].get(name, ())} or {
                "match",
                "fullmatch",
                "search",
                "sub",
            }
        known = LOCAL.get((local, argument))
        for pattern in eval(known or f"[{argument}]", names):
            assert not isinstance(pattern, _Stub), f"{place}: `{argument}` is local: name its patterns in LOCAL"
            yield Pattern(place, re.compile(pattern, flags), frozenset(methods))


def attacks(pattern: re.Pattern[Any]) -> Iterator[Attack]:
    """Yield texts that may take a pattern long: what its parts match, again and again, behind what precedes them."""
    text = pattern.pattern.decode("latin-1") if isinstance(pattern.pattern, bytes) else pattern.pattern
    tokens = _parser.parse(text, pattern.flags & ~re.UNICODE)
    groups = dict[int, str]()
    repeats = list(_repeats(tokens, "", groups))
    signs = (sign for sign in _characters_of(tokens) if not sign.isalnum())
    alphabet = list(dict.fromkeys(["a", " ", "\n", *signs]))[:14]
    pumps = [
        *alphabet,
        *_samples(tokens, groups)[:4],
        *itertools.chain.from_iterable((before, *bodies) for before, bodies in repeats),
        *(before + body for before, bodies in repeats for body in bodies[:2]),
        *(before[-1:] + sign for before, _ in repeats for sign in alphabet),
        *(first + second for first in alphabet[3:8] for second in alphabet[3:8]),
    ]
    behind = ((before, pump) for before, bodies in repeats for pump in (*bodies, *alphabet))
    for before, pump in dict.fromkeys([*(("", pump) for pump in pumps), *behind]):
        if pump:
            yield before, pump, ""
            yield before, pump, "\0"


def _children(token: Token) -> Sequence[Sequence[Token]]:
    """Return the sequences inside of a token."""
    operation, arguments = token
    if operation in (*REPEATS, ops.SUBPATTERN, ops.ASSERT, ops.ASSERT_NOT):
        return [arguments[-1]]
    if operation is ops.BRANCH:
        return [*arguments[1]]
    return [arguments] if operation is ops.ATOMIC_GROUP else []


def _repeats(tokens: Iterable[Token], before: str, groups: dict[int, str]) -> Iterator[tuple[str, list[str]]]:
    """Yield for each long repeat the text that precedes it, and texts that its body matches."""
    for token in tokens:
        operation, arguments = token
        if operation in REPEATS and arguments[1] > 30:
            yield before, _samples(arguments[2], groups)[:6]
        for child in _children(token):
            yield from _repeats(child, before, groups)
        before += _samples([token], groups)[0]


def _samples(tokens: Iterable[Token], groups: dict[int, str]) -> list[str]:
    """Return a few short texts that a sequence matches; note what its groups match."""
    texts = [""]
    for token in tokens:
        operation, arguments = token
        options = [text for child in _children(token) for text in _samples(child, groups)[:4]]
        if operation in ONE_CHARACTER:
            options = _characters(token)
        elif operation in REPEATS:
            options = [text * arguments[0] for text in options] if arguments[0] else ["", *options[:1]]
        elif operation is ops.SUBPATTERN:
            groups[arguments[0]] = options[0]
        elif operation is ops.GROUPREF:
            options = [groups.get(arguments, "")]
        elif operation in (ops.ASSERT, ops.ASSERT_NOT):
            options = []
        first, *others = options or [""]
        texts = [*(text + first for text in texts), *(texts[0] + other for other in others)]
        texts = list(dict.fromkeys(texts))[:12]
    return texts


def _characters_of(tokens: Iterable[Token]) -> Iterator[str]:
    for token in tokens:
        if token[0] in ONE_CHARACTER:
            yield from _characters(token)
        for child in _children(token):
            yield from _characters_of(child)


def _characters(token: Token) -> list[str]:
    """Return a few characters that a token matches; the members of a class come first."""
    operation, arguments = token
    if operation is ops.LITERAL:
        return [chr(arguments)]
    members = arguments if operation is ops.IN else []
    own = [chr(code[0] if kind is ops.RANGE else code) for kind, code in members if kind in (ops.LITERAL, ops.RANGE)]
    fits = _compiler.compile(_parser.SubPattern(_parser.State(), [token])).match
    return [sign for sign in dict.fromkeys(own) if fits(sign)] + [sign for sign in CHARACTERS if fits(sign)][:2]


def _text(attack: Attack, size: int) -> str:
    before, pump, end = attack
    return before + pump * ((size - len(before) - len(end)) // len(pump)) + end


def _seconds(pattern: re.Pattern[Any], method: str, text: str) -> float:
    """Return the time of one call. A signal ends the process after a second of CPU time."""
    is_bytes = isinstance(pattern.pattern, bytes)
    given: Any = text.encode("latin-1", "replace") if is_bytes else text
    arguments = [b"" if is_bytes else ""] if method in ("sub", "subn") else []
    signal.setitimer(signal.ITIMER_VIRTUAL, 1.0)
    start = time.perf_counter()  # with a timer, Linux counts CPU time in steps of 4 ms
    result = getattr(pattern, method)(*arguments, given)
    if method == "finditer":
        all(result)
    seconds = time.perf_counter() - start
    signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    return seconds


def main(*patterns: str) -> None:
    """Try these patterns; without any, those of the program."""
    given = [Pattern("argument", re.compile(pattern), frozenset({"search"})) for pattern in patterns]
    for place, pattern, methods in given or find_patterns():
        for attack, method in itertools.product(dict.fromkeys(attacks(pattern)), sorted(methods)):
            print(f"{place} {method} {attack!r}", flush=True)  # noqa: T201
            short = min(_seconds(pattern, method, _text(attack, SHORT)) for _ in range(2))
            # linear ones take four times as long; quadratic ones of a second for the large text take 0.4 ms here
            if _seconds(pattern, method, _text(attack, 4 * SHORT)) > max(0.0004, 5 * short):
                _seconds(pattern, method, _text(attack, LARGE))
    print("done")  # noqa: T201


if __name__ == "__main__":
    main(*sys.argv[1:])
