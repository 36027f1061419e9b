"""Merges of classes: a catalogue of cases, random edits of real generated files, and files that editors saved again.

A case is a folder below `catalogue/` with `base.mo`, `mine.mo`, `generated.mo`, `about.txt` (a sentence), and
`expected.mo` or `contradictions.txt`. One with `other.mo` for `generated.mo` is a merge between two people, as git's
driver makes it: `expected.mo` has its markers. `pytest -k NAME` runs one; `python tests/merge/test_elements.py NAME …`
prints what git's own merge makes of it.
"""

from __future__ import annotations

import collections
import functools
import itertools
import re
import subprocess
import sys
from pathlib import Path
from random import Random

import pymoca.parser
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from support.golden import distinct_models
from support.printer import STYLES, Style, resaved
from support.statements import KINDS, Editor, statements

from urdfsync.merge import Merge, merge
from urdfsync.merge.texts import merge_branches
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import parse

EXAMPLES = Path(__file__).parents[2] / "modelica" / "UrdfSync" / "Examples"
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


@functools.cache
def simple_files() -> list[str]:
    """Files of one class without others in it; long ones say nothing that short ones do not."""
    examples = [path.read_text("utf-8") for path in sorted(EXAMPLES.rglob("*.mo"))]
    generated = [text for models in distinct_models().values() for text in models.values()]
    texts = [text for text in (*generated, *examples) if len(text) < 8_000]
    return [text for text in texts if statements(text) and not parse(text).classes[0].classes]


edits = st.lists(st.sampled_from(KINDS), max_size=4)
seeds = st.randoms(use_true_random=False)


@functools.lru_cache(maxsize=500)
def said(text: str) -> dict[str, tuple[str, ...]]:
    """What a file says, by statement; none of them is there twice."""
    counted = collections.Counter(one.key for one in statements(text))
    assert {key for key, count in counted.items() if count > 1} == set()
    return {one.key: one.said for one in statements(text)}


def tags(text: str) -> list[str]:
    return sorted(re.findall(r"\b(?:mine|new)\d+\b", text))


def edited(text: str, editor: Editor, kinds: list[str]) -> str:
    return functools.reduce(editor.edit, kinds, text)


@pytest.mark.slow
@often(15)
@given(random=seeds, mine=edits, generated=edits, style=st.sampled_from([None, *STYLES.values()]))
def test_what_touches_different_things_fits_together(
    random: Random, mine: list[str], generated: list[str], style: Style | None
) -> None:
    base = random.choice(simple_files())
    theirs = edited(base, Editor("new", random, 1), generated)
    ours = edited(resaved(base, style) if style else base, Editor("mine", random, 0), mine)
    found = merge(base, ours, theirs, is_modelica=True)
    assert found.text is not None, (found.contradictions, found.flaw)
    before, left, right, after = map(said, (base, ours, theirs, found.text))
    expected = {key: right[key] if left[key] == before.get(key) else left[key] for key in left.keys() & right.keys()}
    expected |= {key: side[key] for side in (left, right) for key in side.keys() - before.keys()}
    assert after == expected
    assert [tag for tag in tags(found.text) if tag.startswith("mine")] == tags(ours), "comments among them"
    assert parse(found.text).faults == []
    swapped = merge(base, theirs, ours, is_modelica=True).text
    assert swapped is not None
    assert said(swapped) == after
    assert merge(base, found.text, theirs, is_modelica=True).text == found.text
    assert merge(theirs, found.text, theirs, is_modelica=True).text == found.text


@often(12)
@given(random=seeds, mine=edits, generated=edits)
def test_any_edits(random: Random, mine: list[str], generated: list[str]) -> None:
    base = random.choice(simple_files())
    ours, theirs = edited(base, Editor("mine", random), mine), edited(base, Editor("new", random), generated)
    assert merge(base, ours, ours, is_modelica=True).text == ours
    assert merge(base, ours, base, is_modelica=True).text == ours
    assert merge(base, base, theirs, is_modelica=True).text == theirs
    found, swapped = (merge(base, *sides, is_modelica=True) for sides in ((ours, theirs), (theirs, ours)))
    assert (found.text is None) == (swapped.text is None) == bool(found.contradictions)
    if found.text is None or swapped.text is None:
        return
    before, left, right, after = map(said, (base, ours, theirs, found.text))
    one_side = (left.keys() | right.keys()) - before.keys()
    assert after.keys() == said(swapped.text).keys() == (left.keys() & right.keys()) | one_side
    assert merge(base, found.text, theirs, is_modelica=True).text == found.text


def commented(text: str, random: Random, name: str = "mine") -> str:
    """The text with comments of somebody's between any two words."""
    tokens, _ = lex(text)
    for number, token in enumerate(
        sorted(random.sample(tokens[5:], min(len(tokens) - 5, 12)), key=lambda one: -one.start)
    ):
        note = random.choice(["/* {} */", " /* {} */ ", "// {}\n", "\n  // {}\n  ", " // {}\r\n"])
        text = f"{text[: token.start]}{note.format(name + str(number))}{text[token.start :]}"
    return text


@often(12)
@given(random=seeds, kinds=edits)
def test_comments_stay_wherever_they_are(random: Random, kinds: list[str]) -> None:
    base = random.choice(simple_files())
    ours, theirs = commented(base, random), edited(base, Editor("new", random), kinds)
    found = merge(base, ours, theirs, is_modelica=True)
    assert found.text is not None, (found.contradictions, found.flaw)
    assert [tag for tag in tags(found.text) if tag.startswith("mine")] == tags(ours)
    assert said(found.text) == said(theirs)
    assert parse(found.text).faults == []
    assert merge(base, found.text, theirs, is_modelica=True).text == found.text


@pytest.mark.slow
@often(12)
@given(random=seeds, mine=edits, other=edits)
def test_of_two_people_no_comment_is_lost(random: Random, mine: list[str], other: list[str]) -> None:
    base = random.choice(simple_files())
    ours = commented(edited(base, Editor("my", random), mine), random)
    theirs = commented(edited(base, Editor("your", random), other), random, "other")
    found, swapped = merge_branches(base, ours, theirs, MARKERS), merge_branches(base, theirs, ours, MARKERS)
    assert {*re.findall(r"(?:mine|other)\d+", ours + theirs)} <= {*re.findall(r"(?:mine|other)\d+", found.proposal)}
    assert bool(found.contradictions) == bool(swapped.contradictions) == ("<<<<<<< mine" in swapped.proposal)
    assert merge_branches(base, ours, base).text == ours
    assert merge_branches(base, base, ours).text == ours.replace("\r\n", "\n")


def read_by_pymoca(text: str) -> tuple[set[str], int]:
    """Components and number of equations of a class as another parser reads them."""
    tree = pymoca.parser.parse(re.sub(r"within[^;]*;", "", text, count=1))
    assert tree is not None
    *_, found = tree.classes.values()
    return set(found.symbols), len(found.equations)


@pytest.mark.slow
@often(4)
@given(random=seeds)
def test_another_parser_finds_all_elements(random: Random) -> None:
    base = random.choice([text for text in simple_files() if "equation\n" in text and len(text) < 4_000])
    ours = edited(base, Editor("mine", random, 0), ["component", "connect", "equation", "component"])
    theirs = edited(base, Editor("new", random, 1), ["component", "connect", "component"])
    found = merge(base, ours, theirs, is_modelica=True).text
    assert found is not None
    before, left, right, after = map(read_by_pymoca, (base, ours, theirs, found))
    assert after == (left[0] | right[0], left[1] + right[1] - before[1])


@pytest.mark.slow
def test_a_file_that_an_editor_saved_again_takes_every_export() -> None:
    """Generated files, and what they are with other options; what has none gets other numbers and elements."""
    random, variants, every = Random(0), 0, distinct_models()
    files = [(variant, path) for variant, models in every.items() for path in models]
    for (variant, path), style in zip(files[::3], itertools.cycle(STYLES.values()), strict=False):
        base = every[variant][path]
        exports = [models[path] for name, models in every.items() if name != variant and path in models]
        variants += len(exports)
        exports.append(
            edited(base, Editor("new", random), ["component", "number", "number", "type", "move", "connect"])
        )
        mine = resaved(base, style)
        assert said(mine) == said(base)
        for generated in exports:
            found = merge(base, mine, generated, is_modelica=True)
            assert found.text is not None, (variant, path, found.contradictions, found.flaw)
            assert said(found.text) == said(generated), (variant, path)
    assert variants > 10


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
