"""Comparing sequences: the replacements are right, shortest where that is asked for, and otherwise those of git."""

from __future__ import annotations

import functools
import random
import re
import shutil
import subprocess
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge.sequence import Replacement, compare

items = st.lists(st.integers(0, 3), max_size=14)


def shortest(old: Sequence[int], new: Sequence[int]) -> int:
    """Insertions and deletions that are needed at least, counted the slow way."""

    @functools.cache
    def need(i: int, j: int) -> int:
        if i == len(old) or j == len(new):
            return len(old) - i + len(new) - j
        return need(i + 1, j + 1) if old[i] == new[j] else 1 + min(need(i + 1, j), need(i, j + 1))

    return need(0, 0)


@given(old=items, new=items, minimal=st.booleans())
def test_replacements_make_the_new_items_of_the_old_ones(old: list[int], new: list[int], minimal: bool) -> None:
    changes = compare(old, new, minimal=minimal)
    result = list(old)
    for start, stop, new_start, new_stop in reversed(changes):
        assert stop > start or new_stop > new_start
        result[start:stop] = new[new_start:new_stop]
    assert result == new
    for first, second in pairwise(changes):
        assert 0 < second.start - first.stop == second.new_start - first.new_stop, "common items are between them"
    if minimal:
        assert sum(c.stop - c.start + c.new_stop - c.new_start for c in changes) == shortest(old, new)


def git_diff(folder: Path, old: Sequence[int], new: Sequence[int]) -> list[Replacement]:
    """What git finds, without the heuristic for indentation, which merging does not use either."""
    for name, numbers in (("old", old), ("new", new)):
        (folder / name).write_text("".join(f"{number}\n" for number in numbers), encoding="ascii", newline="\n")
    command = ["git", "diff", "--no-index", "--no-color", "--no-indent-heuristic", "--diff-algorithm=myers", "-U0"]
    process = subprocess.run([*command, "old", "new"], cwd=folder, capture_output=True, text=True, check=False)
    assert process.returncode in (0, 1), process.stderr
    heads = re.findall(r"^@@ -(\d+)(?:,(\d+))? \+(\d+)(?:,(\d+))? @@", process.stdout, re.M)
    return [Replacement(*part(*head[:2]), *part(*head[2:])) for head in heads]


def part(line: str, count: str) -> tuple[int, int]:
    """Lines from 0, half open, from a hunk's head, which names the line before an empty part."""
    lines = int(count or 1)
    start = int(line) - (lines > 0)
    return start, start + lines


def case(rng: random.Random, length: int, alphabet: int, strange: float) -> tuple[list[int], list[int]]:
    """Two sequences, edited or unrelated; a share of `strange` items in each that the other one lacks."""
    old = [rng.randrange(alphabet) for _ in range(length)]
    new = list(old) if rng.random() < 0.5 else [rng.randrange(alphabet) for _ in range(length)]
    for _ in range(rng.randint(0, 6)):
        place = rng.randint(0, len(new))
        new[place : place + rng.randint(0, 3)] = [rng.randrange(alphabet) for _ in range(rng.randint(0, 3))]
    for mark, numbers in ((1, old), (2, new)):
        for place in range(len(numbers)):
            if rng.random() < strange:
                numbers[place] = 10**6 * mark + place
    return old, new


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed: there is nothing to compare with")
@pytest.mark.parametrize(
    ("count", "length", "alphabet", "strange"),
    [
        *((12, 60, *case) for case in [(2, 0), (5, 0.5)]),
        *(
            pytest.param(12, 60, alphabet, strange, marks=pytest.mark.slow)
            for alphabet in (1, 2, 5, 30)
            for strange in (0, 0.1, 0.5, 0.8)
        ),
        *[(2, 700, 30, 0), (2, 2000, 20, 0.6)],
        *(
            pytest.param(*case, marks=pytest.mark.slow)
            for case in [(2, 700, 2, 0), (2, 1500, 300, 0), (2, 2000, 2000, 0.1)]
        ),
    ],
)
def test_replacements_are_those_of_git(count: int, length: int, alphabet: int, strange: float, tmp_path: Path) -> None:
    rng = random.Random(alphabet)
    for _ in range(count):
        old, new = case(rng, rng.randint(0, length), alphabet, strange)
        assert compare(old, new) == git_diff(tmp_path, old, new)
