"""Merges of classes: a catalogue of cases.

A case is a folder below `catalogue/` with `base.mo`, `mine.mo`, `generated.mo`, `about.txt` (a sentence), and
`expected.mo` or `contradictions.txt`. One with `other.mo` for `generated.mo` is a merge between two people, as git's
driver makes it: `expected.mo` has its markers. `pytest -k NAME` runs one; `python tests/merge/test_elements.py NAME …`
prints what git's own merge makes of it.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from urdfsync.merge import Merge, merge
from urdfsync.merge.texts import merge_branches

CATALOGUE = Path(__file__).with_name("catalogue")
ONE_WAY = {
    "an-annotation-that-goes-leaves-what-the-user-added",
    "rounding-by-the-export-is-no-change",
    "the-digits-that-the-export-rounds-are-an-edit-if-the-user-typed-them",
    "a-component-that-the-user-renamed",
    "a-modifier-with-the-name-of-a-component-that-the-user-renamed-stays",
}
"""Cases that contradict only if mine and generated change places, or do not then."""


def merged(name: str, *texts: str) -> Merge:
    base, mine, generated = ((CATALOGUE / name / f"{text}.mo").read_text("utf-8") for text in texts)
    return merge(base, mine, generated, is_modelica=True)


TWO_PEOPLE = sorted(file.parent.name for file in CATALOGUE.glob("*/other.mo"))
MARKERS = ("<<<<<<< mine", "mine"), ("=======", "generated"), (">>>>>>> other", "")


@pytest.mark.parametrize("name", TWO_PEOPLE)
def test_two_people(name: str) -> None:
    texts = (CATALOGUE / name / f"{text}.mo" for text in ("base", "mine", "other", "expected"))
    base, mine, other, expected = (text.read_text("utf-8") for text in texts)
    found, swapped = merge_branches(base, mine, other, MARKERS), merge_branches(base, other, mine, MARKERS)
    assert found.proposal == expected
    assert len(found.contradictions) == expected.count("=======\n") == len(swapped.contradictions)


@pytest.mark.parametrize("name", sorted(folder.name for folder in CATALOGUE.iterdir() if folder.name not in TWO_PEOPLE))
def test_catalogue(name: str) -> None:
    found, swapped = merged(name, "base", "mine", "generated"), merged(name, "base", "generated", "mine")
    contradictions = CATALOGUE / name / "contradictions.txt"
    assert found.flaw == ""
    if contradictions.exists():
        assert found.text is None
        assert list(found.contradictions) == contradictions.read_text("utf-8").splitlines()
    else:
        assert found.text == (CATALOGUE / name / "expected.mo").read_text("utf-8"), found.proposal
        assert found.contradictions == ()
    assert ((swapped.text is None) != (found.text is None)) == (name in ONE_WAY)


def test_many_comments_in_a_row_end() -> None:
    """One pattern for all of them tried each end of each comment with all others: minutes for 30 comments."""
    base = "model A\n  Real x = 1;\n" + 200 * "  /* note */\n" + "  Real y = 1;\nend A;\n"
    found = merge(base, base.replace("x = 1", "x = 2"), base.replace("y = 1", "y = 3"), is_modelica=True)
    assert found.text == base.replace("x = 1", "x = 2").replace("y = 1", "y = 3")


def main() -> None:
    """Print what git's own merge makes of the cases that are named, or of all."""
    for name in sys.argv[1:] or sorted(folder.name for folder in CATALOGUE.iterdir()):
        folder = CATALOGUE / name
        command = ["git", "merge-file", "-p", "--diff3", "mine.mo", "base.mo", "generated.mo"]
        result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        sys.stdout.write(f"=== {name}: {(folder / 'about.txt').read_text('utf-8')}{result.stdout}")


if __name__ == "__main__":
    main()
