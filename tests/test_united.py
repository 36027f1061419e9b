"""Recorded states of robots that git has merged: no command stops, and one build brings all in step."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from support.commands import Execute
from support.files import fresh_models, models
from support.git import NEEDS_GIT, Repository, built_arm
from support.states import records
from support.urdfs import joint, limit, link, robot

pytestmark = NEEDS_GIT

STATE = Path(".urdfsync/robots/arm.state")
PACKAGE = Path("modelica/Arm")


def export(
    *, elbow: str = "elbow", fore: str = "fore", effort: float = 10, mass: float = 1, wrist: str = "wrist"
) -> None:
    """An arm of four links; some names and numbers are given."""
    links = [link(name, 1.0 + number) for number, name in enumerate(["base", "upper", fore])]
    joints = [
        joint("shoulder", "revolute", "base", "upper", axis="0 0 1"),
        joint(elbow, "revolute", "upper", fore, axis="0 1 0", inside=[limit(effort=effort)]),
        joint(wrist, "revolute", fore, "hand", axis="0 1 0"),
    ]
    Path("arm.urdf").write_text(robot(*links, link("hand", mass), *joints))


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """The arm, built and committed."""
    return built_arm(tmp_path / "project", export, execute, monkeypatch)


def unite(repository: Repository, execute: Execute, ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> None:
    """Merge two branches that each exported and built."""
    for branch, changes in {"theirs": theirs, "ours": ours}.items():
        repository.git("checkout", "-q", "-b", branch, "main")
        export(**changes)
        execute("build")
        repository.commit()
    repository.merge("theirs")


PIVOT, BEND = {"elbow": "pivot"}, {"elbow": "bend"}
CASES: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any], Mapping[str, Any]]] = {
    "both rename one joint": (PIVOT, BEND, PIVOT),
    "both rename one link": ({"fore": "lower"}, {"fore": "front"}, {"fore": "lower"}),
    "one renames it, the other changes its effort": (PIVOT, {"effort": 20}, {"elbow": "pivot", "effort": 20}),
    "one changes its effort, the other renames it": ({"effort": 20}, PIVOT, {"elbow": "pivot", "effort": 20}),
    "both rename it, one changes its effort": (
        PIVOT,
        {"elbow": "pivot", "effort": 20},
        {"elbow": "pivot", "effort": 20},
    ),
    "both change one number": ({"effort": 30}, {"effort": 20}, {"effort": 20}),
    "renames of two joints": (PIVOT, {"wrist": "grip"}, {"elbow": "pivot", "wrist": "grip"}),
}
READING = ["status", "build --check", "build --dry-run", "diff", "diff --edits"]
WRITING = ["build", "build --full", "resolve --all --take"]


@pytest.mark.parametrize("case", CASES)
def test_a_united_state_stops_no_command(
    repository: Repository, execute: Execute, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, case: str
) -> None:
    ours, theirs, merged = CASES[case]
    unite(repository, execute, ours, theirs)
    export(**merged)
    for command in READING:
        assert execute(*command.split(), code=None).code in (0, 1, 3), command
    assert "robot `arm` was built already" in execute("adopt", "arm", code=2).words
    for number, command in enumerate(WRITING):
        left_out = shutil.ignore_patterns(".git")
        with monkeypatch.context() as patch:
            patch.chdir(shutil.copytree(repository.folder, tmp_path / f"copy{number}", ignore=left_out))
            assert execute(*command.split(), code=None).code != 2, command
            execute("build")
            assert len(records(STATE)) == 1
            execute("build", "--check")


@pytest.mark.parametrize("case", ["one renames it, the other changes its effort", "both change one number"])
def test_the_build_after_a_merge_is_a_fresh_one(
    repository: Repository, execute: Execute, tmp_path: Path, case: str
) -> None:
    ours, theirs, merged = CASES[case]
    unite(repository, execute, ours, theirs)
    export(**merged)
    execute("build")
    assert models() == fresh_models(tmp_path / "fresh")
    listed = {name for path in PACKAGE.rglob("package.order") for name in path.read_text().split()}
    assert listed == {path.stem for path in PACKAGE.rglob("*.mo")} - {"package"} | {"Joints", "Links"}


def test_a_line_for_a_class_that_is_a_link_stays(repository: Repository, execute: Execute, tmp_path: Path) -> None:
    """Other lines belong to a renamed class: they go, and a copy of the file is kept."""
    (tmp_path / "Linked.mo").write_text("within Arm.Joints;\nmodel Linked\nend Linked;\n")
    (PACKAGE / "Joints/Linked.mo").symlink_to(tmp_path / "Linked.mo")
    unite(repository, execute, PIVOT, {"wrist": "grip"})
    order = PACKAGE / "Joints/package.order"
    order.write_text(f"{order.read_text()}Linked\nNowhere\n")
    export(elbow="pivot", wrist="grip")
    execute("build", code=None)
    assert "Linked" in order.read_text().split()
    assert "Nowhere" not in order.read_text().split()
    copies = Path(".urdfsync/aside").rglob("package.*.order")
    assert [copy.read_text().split()[-1] for copy in copies] == ["Nowhere"]


def test_a_whole_model_serves_for_renames_and_reports(repository: Repository, execute: Execute) -> None:
    elbow = PACKAGE / "Joints/Elbow.mo"
    elbow.write_text(elbow.read_text().replace("end Elbow;", "  // mine\nend Elbow;"))
    repository.commit()
    unite(repository, execute, {"mass": 2}, {"effort": 20})
    assert len(records(STATE)) == 2
    export(elbow="pivot", mass=2, effort=20)
    said = execute("build").words
    assert "elbow" in said
    assert "pivot" in said
    assert "// mine" in (PACKAGE / "Joints/Pivot.mo").read_text()
    assert not elbow.exists()


def test_a_united_state_stays_one_while_something_is_open(repository: Repository, execute: Execute) -> None:
    record = PACKAGE / "Joints/ElbowParameters.mo"
    edited = record.read_text().replace("end ElbowParameters;", "  // mine\nend ElbowParameters;")
    unite(repository, execute, PIVOT, {"effort": 20})
    export(effort=30)
    record.write_text(edited)
    execute("build", code=3)
    assert len(records(STATE)) == 2
    execute("build", code=3)
    execute("resolve", record.as_posix(), "--keep")
    assert not execute("build", "--check", code=None).code
    assert "// mine" in record.read_text()
    assert len(records(STATE)) == 1
