"""Compares `soundness` with a compiler's parser on random merges and damaged texts; run by hand, see `main`.

    python tests/merging/soundness_report.py [CASES [SEED]]

Half of the texts are line merges of the library's texts with random edits, a quarter are such edits alone, and in a
quarter single tokens were lost, added or swapped. Prints where the two verdicts differ, and how often: a miss is what
only the compiler refuses, a false alarm what only `soundness` does. Not all that is there twice is the parser's
business; so that is counted by itself.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import rumoca

from urdfsync.merge import merge, split_lines
from urdfsync.merging.tokens import tokens
from urdfsync.modelica.parser import parse

LIBRARY = Path(__file__).parents[2] / "modelica" / "UrdfSync"


def edited(rng: random.Random, lines: Sequence[str], pool: Sequence[str]) -> list[str]:
    """Lines with a few random edits: taken from elsewhere, removed, doubled, moved, changed."""
    result = list(lines)
    for _ in range(rng.randint(1, 5)):
        place, size = rng.randrange(len(result) + 1), rng.randint(1, 4)
        some = result[place : place + size]
        match rng.randrange(5):
            case 0:
                result[place:place] = rng.sample(pool, size)
            case 1:
                del result[place : place + size]
            case 2:
                result[place:place] = some
            case 3:
                del result[place : place + size]
                target = rng.randint(0, len(result))
                result[target:target] = some
            case _:
                result[place : place + size] = [line.replace("0", "1") for line in some]
    return result


def damaged(rng: random.Random, text: str) -> str:
    """A text with one or two tokens lost, added, replaced or swapped."""
    parts = tokens(text)
    for _ in range(rng.randint(1, 2)):
        place, other = rng.randrange(len(parts)), rng.randrange(len(parts))
        match rng.randrange(4):
            case 0:
                del parts[place]
            case 1:
                parts.insert(place, parts[other])
            case 2:
                parts[place] = parts[other]
            case _:
                parts[place], parts[other] = parts[other], parts[place]
    return "".join(parts)


def cases(rng: random.Random, files: Sequence[Sequence[str]]) -> Iterator[str]:
    """Endlessly many texts."""
    while True:
        base, other = rng.sample(files, 2)
        mine, generated = ("".join(edited(rng, base, [*base, *other])) for _ in range(2))
        text = rng.choice([merge("".join(base), mine, generated).text] * 2 + [mine, damaged(rng, "".join(base))])
        if text is not None:
            yield text


def refused(text: str) -> str:
    """What the compiler's parser says of a text; empty if it takes it."""
    try:
        found = rumoca.validate_source(text)
    except rumoca.RumocaError as error:
        return str(error)
    return str(found) if found else ""


def main(count: int = 2000, seed: int = 1) -> None:
    """Compare `count` verdicts and print how they differ."""
    rng = random.Random(seed)
    files = [split_lines(path.read_text("utf-8")) for path in sorted(LIBRARY.rglob("*.mo"))]
    verdicts: Counter[str] = Counter()
    for _, text in zip(range(count), cases(rng, files), strict=False):
        theirs, ours = refused(text), parse(text).faults
        syntax = [fault for fault in ours if not fault.reason.endswith(" twice")]
        verdict = "both refuse" if theirs else "only something twice" if ours else "both accept"
        if (theirs and not ours) or (syntax and not theirs):
            verdict = "missed" if theirs else "false alarm"
            sys.stdout.write(f"{verdict}: {theirs or syntax[0]}\n")
        verdicts[verdict] += 1
    sys.stdout.write(f"{dict(verdicts)}\n")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
