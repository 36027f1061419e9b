"""Git stops at what two branches did, and one build makes of it a fresh package with the edits of both.

A case is a folder below `merges/`. `ours.txt` and `theirs.txt` have what a branch does, `source.txt` how the merged
source differs from the first one, and `expected.txt` the edits that a fresh package has then, a file that conflicts, or
a text that stays in a file. `pytest -k NAME` runs one.
"""

from __future__ import annotations

import contextlib
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from support.branches import export, perform
from support.commands import Execute
from support.files import fresh_models, models, unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import LADDER, MODEL, configure, run

from urdfsync.markers import find_markers
from urdfsync.state.record import Choice

pytestmark = NEEDS_GIT

CASES = Path(__file__).with_name("merges")
WAYS = {"merge": "merge -q theirs", "rebase": "rebase -q theirs", "cherry-pick": "cherry-pick theirs"}
STYLES = ["merge", "diff3", "driver"]

Stop = Callable[..., None]


@pytest.fixture
def stop(project: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Stop:
    """A function that brings two branches together, and settles the source alone."""

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


def marked() -> dict[str, str]:
    return {path: text for path, text in models().items() if find_markers(text)}


@pytest.mark.parametrize("case", sorted(folder.name for folder in CASES.iterdir()))
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("way", [way if way == "merge" else pytest.param(way, marks=pytest.mark.slow) for way in WAYS])
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
    assert run().in_step
    built = models()
    assert not marked()
    for file, text in re.findall(r"stays (\S*) (.*)\n", expected):
        assert text in built.pop(f"{LADDER}/{file}")
    for path, text in fresh_models(tmp_path / "fresh").items():
        Path(path).write_text(text)
    perform(re.sub(r"stays .*\n", "", expected))
    assert built == {path: text for path, text in models().items() if path in built}
