"""Two branches in step, which git has merged without a conflict: the verdict of every command, without a build.

The table has the work of two people, git's merge, and the verdict: 0 for in step. Then a build renews only the recorded
state. If the merged source gives other texts, the package is out of step.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest
from support.commands import Execute
from support.files import fresh_models, models
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.urdfs import joint, limit, link

pytestmark = [NEEDS_GIT, pytest.mark.slow]

WAYS = {
    "merge": ["merge -q --no-edit theirs"],
    "rebase": ["rebase -q theirs"],
    "cherry-pick": ["cherry-pick theirs"],
    "squash": ["merge -q --squash theirs", "commit -q -m both"],
    "patch": ["format-patch -q -1 theirs --output theirs.patch", "am -q -3 theirs.patch"],
}
PACKAGE = Path("modelica/Arm")


def export(*, mass: float = 1, effort: float = 10, elbow: str = "elbow", more: str = "") -> None:
    """Write an arm, with blank lines between its elements, so that git merges neighbours."""
    elements = [
        *(link("base"), link("upper", mass), link("fore", 2), link("hand", 3)),
        joint("shoulder", "revolute", "base", "upper", axis="0 0 1"),
        joint(elbow, "revolute", "upper", "fore", axis="0 1 0", inside=[limit(effort=effort)]),
        joint("wrist", "revolute", "fore", "hand", axis="0 1 0"),
        *([link(more, 1), joint(f"to_{more}", "fixed", "base", more)] if more else []),
    ]
    Path("arm.urdf").write_text("\n\n".join(['<robot name="arm">', *elements, "</robot>", ""]))


def comment(path: str) -> Callable[[], None]:
    """Add a comment to a file of the package by hand."""
    return lambda: edit(PACKAGE / path, f"end {Path(path).stem};", f"  // mine\nend {Path(path).stem};")


def nothing() -> None:
    """Edit nothing."""


class Case(NamedTuple):
    """The work of the branches, and the verdict of every command on the merge."""

    edits: Callable[[], None]
    """Edits by hand before the branches separate."""
    ours: dict[str, object]
    theirs: dict[str, object]
    verdict: int = 0
    approach: str = "package"


NUMBERS: tuple[dict[str, object], dict[str, object]] = {"mass": 1.5}, {"effort": 20}
CASES = {
    "two numbers": Case(nothing, *NUMBERS),
    "two numbers, edited elsewhere": Case(comment("Arm.mo"), *NUMBERS),
    "two numbers, a record edited": Case(comment("Links/UpperParameters.mo"), *NUMBERS),
    "the same number alike": Case(comment("Links/UpperParameters.mo"), {"mass": 1.5}, {"mass": 1.5, "effort": 20}),
    "two numbers of one record": Case(nothing, *NUMBERS, approach="record"),
    "two numbers of one record, edited": Case(comment("ArmParameters.mo"), *NUMBERS, approach="record"),
    "another name on one side": Case(nothing, {"elbow": "pivot"}, {"mass": 1.5}),
    "another name on one side, edited": Case(comment("Joints/Shoulder.mo"), {"elbow": "pivot"}, {"mass": 1.5}),
    "one name on both sides": Case(nothing, {"elbow": "pivot"}, {"elbow": "pivot", "mass": 1.5}),
    "a link more on one side": Case(nothing, {"more": "tool"}, {"mass": 1.5}),
}


ALL = list(itertools.product(WAYS, [False, True], CASES))
FEW = {(*pair, case) for pair, case in zip(itertools.product(WAYS, [False, True]), CASES, strict=True)}
FEW |= {(way, False, case) for way in WAYS for case in ("two numbers", "two numbers, a record edited")}


@pytest.mark.parametrize(
    ("way", "driver", "case"),
    [row if row in FEW else pytest.param(*row, marks=pytest.mark.large) for row in ALL],
)
def test_what_git_has_united_is_in_step_without_a_build(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute, way: str, driver: bool, case: str
) -> None:
    edits, ours, theirs, verdict, approach = CASES[case]
    if approach == "record" and not driver:
        pytest.skip("without the driver, git marks the stamp of a file that both branches exported")
    Path("urdfsync.toml").write_text(
        f'[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\napproach = ["{approach}"]\non_conflict = "merge"\n'
    )
    repository = Repository(folder, monkeypatch)
    export()
    execute("build")
    edits()
    if driver:
        execute("merge-driver", "--install")
    repository.commit()
    for branch, changes in {"theirs": theirs, "ours": ours}.items():
        repository.git("checkout", "-q", "-b", branch, "main")
        export(**changes)  # type: ignore[arg-type] # as in the table
        execute("build")
        repository.commit(branch)
    for command in WAYS[way]:
        repository.git(*command.split())
    Path("theirs.patch").unlink(missing_ok=True)
    export(**(ours | theirs))  # type: ignore[arg-type]
    assert repository.git("status", "--porcelain") == "", "git has united the sources by itself"

    assert execute("status", code=verdict).code == verdict
    (robot,) = execute("build", "--check", "--format=json", code=verdict).json["results"]
    assert robot["in_step"] is (verdict == 0)
    execute("hook", "check", code=verdict)
    assert repository.git("status", "--porcelain") == "", "no verdict writes what git has"
    printed = execute("build", "--format=json")
    (built,) = json.loads(printed.out)["results"]
    assert built["writes"] is (verdict != 0)
    changed = repository.git("status", "--porcelain").split("\n")
    assert verdict or all(".urdfsync/" in line for line in changed if line), changed
    execute("build", "--check")
    generated = fresh_models(tmp_path / "fresh")
    mine = {path: text.replace("  // mine\n", "") for path, text in models().items()}
    assert mine == generated
