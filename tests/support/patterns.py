# mypy: ignore-errors
# ruff: noqa
"""Finds all regular expressions of the program, and tries each on texts on which it may take long."""

from __future__ import annotations

import ast
import importlib
import itertools
import re
import signal
import sys
import time
from collections import defaultdict
from pathlib import Path
from re import _constants as c, _parser

METHODS = ("match", "fullmatch", "search", "sub", "subn", "finditer", "findall", "split")
PACKAGE = Path(__file__).parents[2] / "urdfsync"


class Word(str):
    def __getattr__(self, _):
        return self

    def __call__(self, *a, **k):
        return self

    def __getitem__(self, k):
        return self

    def __truediv__(self, _):
        return self


class Names(dict):
    def __missing__(self, key):
        return Word("name")


def sources():
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        yield path, ".".join(parts[:-1] if parts[-1] == "__init__" else parts), ast.parse(path.read_text())


def find() -> tuple[dict[object, object], list[str]]:
    trees = list(sources())
    used = defaultdict(lambda: defaultdict(set))
    for _, name, tree in trees:
        used_here = used[name]
        for n in ast.walk(tree):
            if isinstance(n, ast.Call) and isinstance(n.func, ast.Attribute) and n.func.attr in METHODS:
                m = n.func.attr

                for x in ast.walk(n.func.value):
                    if isinstance(x, ast.Name):
                        used_here[x.id].add(m)
                    if isinstance(x, ast.Attribute):
                        used_here[x.attr].add(m)
    out, unreached = [], []
    for path, name, tree in trees:
        parents = {ch: p for p in ast.walk(tree) for ch in ast.iter_child_nodes(p)}
        for n in ast.walk(tree):
            if not (
                isinstance(n, ast.Call)
                and isinstance(n.func, ast.Attribute)
                and isinstance(n.func.value, ast.Name)
                and n.func.value.id == "re"
                and n.func.attr not in ("escape",)
            ):
                continue
            mod = importlib.import_module(name)
            ns = Names(vars(mod))
            b = ns.get("__builtins__")
            ns.update(b if isinstance(b, dict) else vars(b))
            ns.update({k: v for k, v in vars(mod).items()})
            place = f"{path}:{n.lineno}"
            try:
                arg = n.args[0]
                pat = eval(compile(ast.Expression(arg), place, "eval"), ns)
            except Exception as e:
                unreached.append(place)
                continue
            flags = 0
            exprs = [k.value for k in n.keywords if k.arg == "flags"]
            pos = {
                "compile": 1,
                "match": 2,
                "search": 2,
                "fullmatch": 2,
                "findall": 2,
                "finditer": 2,
                "split": 3,
                "sub": 4,
            }[n.func.attr]
            exprs += n.args[pos : pos + 1]
            for e in exprs:
                flags |= eval(compile(ast.Expression(e), place, "eval"), ns)
            methods = {n.func.attr}
            if n.func.attr == "compile":
                p = n
                while p in parents and not isinstance(p, (ast.Assign, ast.AnnAssign, ast.FunctionDef)):
                    p = parents[p]
                methods = set()
                if isinstance(p, ast.Assign) and isinstance(p.targets[0], ast.Name):
                    methods = allused(used, name, p.targets[0].id)
                elif isinstance(p, ast.AnnAssign):
                    methods = allused(used, name, p.target.id)
                methods = methods or {"match", "fullmatch", "search", "sub"}
            if isinstance(pat, Word):
                unreached.append(place)
                continue
            if isinstance(pat, re.Pattern):
                pats = [(pat.pattern, pat.flags)]
            else:
                pats = [(pat, flags)]
            for pt, fl in pats:
                out.append((place, pt, fl, frozenset(methods)))
    return out, unreached


def allused(used, module, name):
    public = not name.startswith("_")
    return {m for mod, names in used.items() if mod == module or public for m in names.get(name, ())}


CANDIDATES = "a0 \n\t;\"'/*<>=-_.,()[]{}|:#@A\\é$%^&+?!~`\0"
CATS = {
    c.CATEGORY_DIGIT: "0",
    c.CATEGORY_NOT_DIGIT: "a",
    c.CATEGORY_SPACE: " ",
    c.CATEGORY_NOT_SPACE: "a",
    c.CATEGORY_WORD: "a",
    c.CATEGORY_NOT_WORD: " ",
}


def accepted(items):
    """One char per member of a class."""
    neg = items and items[0][0] is c.NEGATE
    if neg:
        bad = re.compile(_charclass(items[1:]))
        return [next(x for x in CANDIDATES if not bad.match(x))]
    out = []
    for op, av in items:
        if op is c.LITERAL:
            out.append(chr(av))
        elif op is c.RANGE:
            out.append(chr(av[0]))
        elif op is c.CATEGORY:
            out.append(CATS[av])
    return list(dict.fromkeys(out))


def _charclass(items):
    s = ""
    esc = {
        c.CATEGORY_DIGIT: r"\d",
        c.CATEGORY_NOT_DIGIT: r"\D",
        c.CATEGORY_SPACE: r"\s",
        c.CATEGORY_NOT_SPACE: r"\S",
        c.CATEGORY_WORD: r"\w",
        c.CATEGORY_NOT_WORD: r"\W",
    }
    for op, av in items:
        if op is c.LITERAL:
            s += re.escape(chr(av))
        elif op is c.RANGE:
            s += re.escape(chr(av[0])) + "-" + re.escape(chr(av[1]))
        elif op is c.CATEGORY:
            s += esc[av]
    return "[" + s + "]"


REPEATS = (c.MAX_REPEAT, c.MIN_REPEAT, c.POSSESSIVE_REPEAT)


def samples(seq, groups, most=4):
    """A few short texts that a sequence matches."""
    texts = [""]
    for op, av in seq:
        if op is c.LITERAL:
            opts = [chr(av)]
        elif op is c.NOT_LITERAL:
            opts = ["a" if av != 97 else "b"]
        elif op is c.ANY:
            opts = ["a"]
        elif op is c.IN:
            opts = accepted(av)
        elif op in REPEATS:
            inner = samples(av[2], groups, 3)
            lo = max(av[0], 0)
            opts = [i * lo for i in inner] if lo else ["", *inner[:1]]
        elif op is c.SUBPATTERN:
            opts = samples(av[-1], groups, most)
            groups[av[0]] = opts[0]
        elif op is c.BRANCH:
            opts = [t for b in av[1] for t in samples(b, groups, 2)]
        elif op is c.ATOMIC_GROUP:
            opts = samples(av, groups, most)
        elif op is c.GROUPREF:
            opts = [groups.get(av, "")]
        else:
            opts = [""]
        opts = list(dict.fromkeys(opts))[:12]
        texts = [a + b for b in opts for a in texts[:1]] + [a + opts[0] for a in texts[1:]]
        texts = list(dict.fromkeys(texts))[:12]
    return texts


def repeats(seq, before, groups):
    """Yield for each repeat the text before it, and its body's samples."""
    for op, av in seq:
        if op in REPEATS:
            if av[1] > 30:
                yield before, samples(av[2], groups, 6)
            yield from repeats(av[2], before, groups)
        elif op is c.SUBPATTERN:
            yield from repeats(av[-1], before, groups)
        elif op is c.ATOMIC_GROUP:
            yield from repeats(av, before, groups)
        elif op is c.BRANCH:
            for b in av[1]:
                yield from repeats(b, before, groups)
        elif op in (c.ASSERT, c.ASSERT_NOT):
            yield from repeats(av[1], before, groups)
        before += samples([(op, av)], groups)[0]


def literals(seq):
    for op, av in seq:
        if op in (c.LITERAL, c.NOT_LITERAL):
            yield chr(av)
        elif op is c.IN:
            yield from accepted(av)
        elif op in REPEATS:
            yield from literals(av[2])
        elif op is c.SUBPATTERN:
            yield from literals(av[-1])
        elif op is c.ATOMIC_GROUP:
            yield from literals(av)
        elif op is c.BRANCH:
            for b in av[1]:
                yield from literals(b)
        elif op in (c.ASSERT, c.ASSERT_NOT):
            yield from literals(av[1])


def attacks(pattern, flags):
    text = pattern.decode("latin-1") if isinstance(pattern, bytes) else pattern
    fl = flags & ~re.UNICODE
    tree = _parser.parse(text, fl)
    groups = {}
    rep = list(repeats(tree, "", groups))
    alphabet = list(dict.fromkeys(["a", " ", "\n", *(x for x in literals(tree) if not x.isalnum())]))[:14]
    whole = samples(tree, groups)
    pumps = dict.fromkeys(
        [
            *alphabet,
            *(p for _, ps in rep for p in ps),
            *(b for b, _ in rep),
            *(b + p for b, ps in rep for p in ps[:2]),
            *whole[:4],
            *(b[-1:] + x for b, _ in rep for x in alphabet),
            *(x + y for x in alphabet[3:8] for y in alphabet[3:8]),
        ]
    )
    for before, pump in dict.fromkeys(
        [*(("", p) for p in pumps), *((b, p) for b, ps in rep for p in [*ps, *alphabet])]
    ):
        if pump:
            for end in ("", "\0"):
                yield before, pump, end


def make(a, size):
    before, pump, end = a
    return before + pump * ((size - len(before) - len(end)) // len(pump)) + end


def run(compiled, method, text):
    if method == "match at":
        at = 0
        while at < len(text):
            m = compiled.match(text, at)
            at = m.end() if m and m.end() > at else at + 1
    elif method in ("sub", "subn"):
        compiled.sub(b"" if isinstance(text, bytes) else "", text)
    elif method == "finditer":
        for _ in compiled.finditer(text):
            pass
    else:
        getattr(compiled, method)(text)


def main() -> None:
    """Try each pattern; one that takes more than a second of CPU time for 200 kB ends this process."""
    for place, pattern, flags, methods in find()[0][int(sys.argv[1]) :]:
        compiled = re.compile(pattern, flags)
        for attack in dict.fromkeys(attacks(pattern, flags)):
            texts = [make(attack, size) for size in (1_000, 4_000, 200_000)]
            if isinstance(pattern, bytes):
                texts = [text.encode("latin-1", "replace") for text in texts]
            for method in sorted(methods):
                print(f"{place} {method} {attack!r}", flush=True)
                times = []
                for text in texts[:2]:
                    signal.setitimer(signal.ITIMER_VIRTUAL, 1.0)
                    start = time.process_time()
                    run(compiled, method, text)
                    times.append(time.process_time() - start)
                if times[1] > 0.0004 and times[1] > 5 * times[0]:  # only these may be slow: linear ones take fourfold
                    signal.setitimer(signal.ITIMER_VIRTUAL, 1.0)
                    run(compiled, method, texts[2])
    signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    print("done", flush=True)


if __name__ == "__main__":
    main()
