"""Git stops at the changes of two branches, and one build makes a fresh package with the edits of both.

A case is a folder below `merges/`. `ours.txt` and `theirs.txt` have the steps of a branch, `source.txt` the changes in
the merged source. `expected.txt` has the edits in the fresh package, a file that conflicts, or a text that stays in a
file. `pytest -k NAME` runs one.
"""

from __future__ import annotations

import contextlib
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.branches import export, perform
from support.commands import Execute
from support.files import fresh_models, models, unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import LADDER, MODEL, configure, failure, run

from urdfsync.engine.actions import Choice
from urdfsync.engine.result import Result
from urdfsync.modelica.markers import find_markers, join_sides, read_sides

pytestmark = NEEDS_GIT

CASES = Path(__file__).with_name("merges")
WAYS = {
    "merge": "merge -q theirs",
    "squash": "merge -q --squash theirs",
    "rebase": "rebase -q theirs",
    "cherry-pick": "cherry-pick theirs",
}
STYLES = ["merge", "diff3", "driver"]
MERGE, *OTHER_WAYS = WAYS

Stop = Callable[..., None]


@pytest.fixture
def stop(project: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Stop:
    """A function that merges two branches, and settles only the source."""

    def bring(case: str, way: str = "merge", style: str = "merge") -> None:
        steps = {name: (CASES / case / f"{name}.txt").read_text() for name in ("ours", "theirs", "source")}
        configure('on_conflict = "merge"\n')
        export(list)
        run()
        repository = Repository(project, monkeypatch)
        Path(".gitattributes").write_text(
            "*.mo merge=urdfsync\n" if style == "driver" else "*.mo conflict-marker-size=9\n"
        )
        if style == "driver":
            execute("merge-driver", "--install")
        repository.git("config", "merge.conflictStyle", "diff3" if style == "diff3" else "merge")
        repository.commit()
        for branch in ("theirs", "ours"):
            repository.git("checkout", "-q", "-b", branch, "main")
            perform(steps[branch], run)
            run()
            repository.commit()
        with contextlib.suppress(subprocess.CalledProcessError):
            repository.git(*WAYS[way].split())
        repository.git("checkout", "-q", "main", "--", "ladder.json")
        perform(steps["source"])

    return bring


NAMES = sorted(folder.name for folder in CASES.iterdir())
# the place of git's files does not depend on the style of markers, and a build's merge on neither
ALL: list[Any] = [
    *((MERGE, STYLES[number % 3], name) for number, name in enumerate(NAMES)),
    *(
        pytest.param(OTHER_WAYS[number % 3], STYLES[(number // 3 + number) % 3], name, marks=pytest.mark.slow)
        for number, name in enumerate(NAMES)
    ),
]


def add_all() -> Result:
    """Build again, then tell git that all is merged: only that is missing."""
    again = run(dry=True)
    assert not again.writes
    assert again.in_step is not again.is_unmerged
    subprocess.run(["git", "add", "-A"], check=True)
    return run()


def marked() -> dict[str, str]:
    return {path: text for path, text in models().items() if find_markers(text)}


@pytest.mark.parametrize(("way", "style", "case"), ALL)
def test_merges(stop: Stop, tmp_path: Path, case: str, way: str, style: str) -> None:
    stop(case, way, style)
    before = marked()
    assert not (before and run(dry=True).in_step)
    result = run()
    expected = (CASES / case / "expected.txt").read_text()
    if files := re.findall(r"conflict (.*)\n", expected):
        assert [f"{LADDER}/{file}" for file in files] == [conflict.action.path for conflict in result.conflicts]
        assert all(models()[path] == text for path, text in before.items() if path.removeprefix(f"{LADDER}/") in files)
        return
    assert not result.conflicts
    assert add_all().in_step
    built = models()
    assert not marked()
    for file, text in re.findall(r"stays (\S*) (.*)\n", expected):
        assert text in built.pop(f"{LADDER}/{file}")
    for path, text in fresh_models(tmp_path / "fresh").items():
        Path(path).write_text(text)
    perform(re.sub(r"stays .*\n", "", expected))
    assert built == {path: text for path, text in models().items() if path in built}


def first_conflict(text: str) -> str:
    (conflict, *_) = re.findall(r"(?ms)^<{7,} .*?^>{7,} [^\n]*\n", text)
    return str(conflict)


@pytest.mark.parametrize(
    ("case", "path", "side"),
    [
        *(("edits-in-two-conflicts", MODEL, side) for side in ("ours", "line")),
        *(
            pytest.param("edits-in-two-conflicts", MODEL, side, marks=pytest.mark.slow)
            for side in ("theirs", "both", "neither")
        ),
        pytest.param("renamed-by-both", MODEL, "line", marks=pytest.mark.slow),
        ("renamed-by-both", MODEL, "ours"),
    ],
)
def test_markers_that_somebody_has_half_settled_stay(
    stop: Stop, project: Path, case: str, path: str, side: str
) -> None:
    """The user settles one conflict, or adds a line inside; markers of another conflict remain."""
    stop(case)
    conflict = first_conflict(text := Path(path).read_text())
    ours, theirs = read_sides(conflict)
    settled = {
        "ours": ours,
        "theirs": theirs,
        "both": join_sides(conflict),
        "line": conflict.replace("\n", "\nmine\n", 1),
    }
    text = text.replace(conflict, settled.get(side, ""))
    Path(path).write_text(text if find_markers(text) else f"{text}\n{conflict}")
    with unchanged(project):
        assert "unresolved merge markers" in failure()
        assert "unresolved merge markers" in failure(choices={path: Choice.MERGE})


@pytest.mark.parametrize("case", ["both-add-an-element", "edits-of-both", "renamed-by-both"])
def test_a_text_with_markers_that_is_replaced_is_put_aside(stop: Stop, execute: Execute, case: str) -> None:
    stop(case)
    before = marked()
    assert len(before) >= 1
    run()
    assert not marked()
    execute("resolve", *before, "--undo", code=None)
    assert marked() == before


@pytest.mark.parametrize("choice", ["--merge", "--keep", "--take"])
def test_a_file_that_a_build_writes_can_be_named(stop: Stop, execute: Execute, choice: str) -> None:
    stop("edits-of-both")
    assert execute("resolve", MODEL, choice)
    assert not marked()
    assert ("// other" in Path(MODEL).read_text()) == ("Ours" in Path(MODEL).read_text()) == (choice != "--take")
    assert add_all().in_step


@pytest.mark.parametrize("style", [STYLES[0], *(pytest.param(style, marks=pytest.mark.slow) for style in STYLES[1:])])
@pytest.mark.parametrize("case", ["edits-that-contradict", "edits-that-contradict-alone"])
def test_a_contradiction_is_for_people(stop: Stop, execute: Execute, case: str, style: str) -> None:
    stop(case, style=style)
    before = marked()
    said = execute("build", code=3).words
    assert "since both branches changed" in said
    assert ("its generated text changed too" in said) == (case == "edits-that-contradict")
    assert "since both branches changed" in execute("resolve", MODEL, "--merge", code=3).words
    assert marked() == before
    assert "unresolved merge markers" in execute("resolve", MODEL, "--keep", code=2).words
    assert marked() == before
    conflict = first_conflict(text := before[MODEL])
    Path(MODEL).write_text(text.replace(conflict, read_sides(conflict)[1]))
    while find_markers(text := Path(MODEL).read_text()):
        Path(MODEL).write_text(text.replace(first_conflict(text), join_sides(first_conflict(text))))
    assert execute("build", "--format=json", code=None).code in (0, 3)
    assert not marked()


def test_a_contradiction_can_be_given_up(stop: Stop, execute: Execute, tmp_path: Path) -> None:
    stop("edits-that-contradict")
    assert execute("resolve", MODEL, "--take")
    assert models() == fresh_models(tmp_path / "fresh")
