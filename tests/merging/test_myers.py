"""Edit scripts: right, shortest where that is promised, and settled where git settles them."""

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

from urdfsync.merging.myers import Change, diff

items = st.lists(st.integers(0, 3), max_size=14)


def apply(changes: Sequence[Change], old: Sequence[object], new: Sequence[object]) -> list[object]:
    """The old items, with those that the changes name taken from the new ones."""
    result: list[object] = []
    position = 0
    for change in changes:
        result += [*old[position : change.start], *new[change.new_start : change.new_stop]]
        position = change.stop
    return [*result, *old[position:]]


def size(changes: Sequence[Change]) -> int:
    return sum(change.stop - change.start + change.new_stop - change.new_start for change in changes)


def shortest(old: Sequence[int], new: Sequence[int]) -> int:
    """Insertions and deletions that are needed at least, counted the slow way."""

    @functools.cache
    def need(i: int, j: int) -> int:
        if i == len(old) or j == len(new):
            return len(old) - i + len(new) - j
        return need(i + 1, j + 1) if old[i] == new[j] else 1 + min(need(i + 1, j), need(i, j + 1))

    return need(0, 0)


@given(old=items, new=items)
def test_a_script_is_the_shortest(old: list[int], new: list[int]) -> None:
    changes = diff(old, new, thin=False)
    assert apply(changes, old, new) == new
    assert size(changes) == shortest(old, new)


@given(old=items, new=items, thin=st.booleans(), work=st.integers(0, 60))
def test_a_script_is_right_at_any_cost(old: list[int], new: list[int], thin: bool, work: int) -> None:
    changes = diff(old, new, thin=thin, work=work)
    assert apply(changes, old, new) == new
    for first, second in pairwise(changes):
        assert first.stop < second.start, "something common is between two changes"
        assert second.start - first.stop == second.new_start - first.new_stop
    assert all(change.stop > change.start or change.new_stop > change.new_start for change in changes)


def test_the_example_of_the_paper() -> None:
    assert size(diff("ABCABBA", "CBABAC")) == 5


@pytest.mark.parametrize(
    ("old", "new", "changes"),
    [
        pytest.param("same", "same", [], id="no change"),
        pytest.param("", "ab", [Change(0, 0, 0, 2)], id="from nothing"),
        pytest.param("ab", "", [Change(0, 2, 0, 0)], id="to nothing"),
        pytest.param("abc", "abbc", [Change(2, 2, 2, 3)], id="one more of a run: the last one is new"),
        pytest.param("a{x}b", "a{x}{x}b", [Change(4, 4, 4, 7)], id="one more block: the last one is new"),
        pytest.param("a{x}{x}b", "a{x}b", [Change(4, 7, 4, 4)], id="one block less: the last one is gone"),
        pytest.param("axaxz", "axyxz", [Change(2, 3, 2, 3)], id="a replacement stays together"),
    ],
)
def test_where_changes_settle(old: str, new: str, changes: list[Change]) -> None:
    assert diff(old, new) == changes


def git_diff(folder: Path, old: Sequence[int], new: Sequence[int]) -> list[Change]:
    """What git finds, without the heuristic for indentation, which merging does not use either."""
    for name, numbers in (("old", old), ("new", new)):
        (folder / name).write_text("".join(f"{number}\n" for number in numbers), encoding="ascii", newline="\n")
    command = ["git", "diff", "--no-index", "--no-color", "--no-indent-heuristic", "--diff-algorithm=myers", "-U0"]
    process = subprocess.run([*command, "old", "new"], cwd=folder, capture_output=True, text=True, check=False)
    assert process.returncode in (0, 1), process.stderr
    heads = re.findall(r"^@@ -(\d+)(?:,(\d+))? \+(\d+)(?:,(\d+))? @@", process.stdout, re.M)
    return [Change(*_part(*head[:2]), *_part(*head[2:])) for head in heads]


def _part(line: str, count: str) -> tuple[int, int]:
    """Lines from 0, half open, from what a hunk's head says; for an empty part it names the line before."""
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


git = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed: there is nothing to compare with")


@git
@pytest.mark.parametrize("strange", [0, 0.1, 0.5, 0.8])
@pytest.mark.parametrize("alphabet", [1, 2, 5, 30])
def test_changes_are_those_of_git(alphabet: int, strange: float, tmp_path: Path) -> None:
    rng = random.Random(alphabet)
    for _ in range(12):
        old, new = case(rng, rng.randint(0, 60), alphabet, strange)
        assert diff(old, new) == git_diff(tmp_path, old, new)


@git
@pytest.mark.parametrize(
    ("length", "alphabet", "strange"), [(700, 2, 0), (700, 30, 0), (1500, 300, 0), (2000, 20, 0.6), (2000, 2000, 0.1)]
)
def test_changes_of_long_sequences_are_those_of_git(length: int, alphabet: int, strange: float, tmp_path: Path) -> None:
    rng = random.Random(length)
    old, new = ([rng.randrange(alphabet) for _ in range(length)] for _ in range(2))
    old = [-place if rng.random() < strange else number for place, number in enumerate(old)]
    assert diff(old, new) == git_diff(tmp_path, old, new)


def test_long_and_different_sequences_cost_no_more_than_allowed() -> None:
    rng = random.Random(1)
    old, new = ([rng.randrange(50) for _ in range(900)] for _ in range(2))
    thorough, hasty = diff(old, new), diff(old, new, work=2_000)
    assert apply(thorough, old, new) == apply(hasty, old, new) == new
    assert size(thorough) < size(hasty)
