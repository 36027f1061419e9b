"""Merges of classes as folders below `catalogue/`: three texts, and the merged one or what contradicts.

A new case is a folder with `base.mo`, `mine.mo`, `generated.mo`, `about.txt` (a sentence), and `expected.mo` or
`contradictions.txt`. `pytest -k NAME` runs one; `python tests/merge/test_catalogue.py NAME …` prints git's own merge.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from urdfsync.merge import Merge, merge

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


@pytest.mark.parametrize("name", sorted(folder.name for folder in CATALOGUE.iterdir()))
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


def main() -> None:
    """Print what git's own merge makes of the cases that are named, or of all."""
    for name in sys.argv[1:] or sorted(folder.name for folder in CATALOGUE.iterdir()):
        folder = CATALOGUE / name
        command = ["git", "merge-file", "-p", "--diff3", "mine.mo", "base.mo", "generated.mo"]
        result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        sys.stdout.write(f"=== {name}: {(folder / 'about.txt').read_text('utf-8')}{result.stdout}")


if __name__ == "__main__":
    main()
