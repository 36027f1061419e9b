"""CAD renumbers, where a text is no scenario: forged records, and git in each way; see `scenarios/renumbered.txt`."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from support import states
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.urdfs import robot_of

from urdfsync.engine.result import Exit

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\napproach = ["package", "record"]\n'
STATE = Path(".urdfsync/robots/arm.state")
LINK, JOINT = "modelica/Arm/Links/Link_{}.mo", "modelica/Arm/Joints/Joint_{}Parameters.mo"
MINE = "\n  Real mine = 1;\n\nequation"
BUILT = "1 1.1, 2 2.2, 3 3.3"
EXPORTS = {
    "exchanged": "1 1.1, 3 2.2, 2 3.3",
    "inserted": "1 1.1, 2 5.5, 3 2.2, 4 3.3",
    "inserted at the root": "1 5.5, 2 1.1, 3 2.2, 4 3.3",
    "removed": "1 2.2, 2 3.3",
    "shifted": "2 1.1, 3 2.2, 4 3.3",
    "rotated": "2 1.1, 3 2.2, 1 3.3",
}
WAYS = {
    "merge": ["merge -q --no-edit theirs"],
    "rebase": ["rebase -q theirs"],
    "cherry-pick": ["cherry-pick theirs"],
    "squash": ["merge -q --squash theirs", "commit -q -m both"],
    "patch": ["format-patch -q -1 theirs --output theirs.patch", "am -q -3 theirs.patch"],
}


@pytest.fixture
def edited(folder: Path, execute: Execute) -> Path:
    """A folder with a built arm; the user adds a component to the second link, and changes a number of its joint."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(robot_of(BUILT))
    execute("build")
    edit(LINK.format(2), "\nequation", MINE)
    edit(JOINT.format(2), "effort = 10", "effort = 12")
    return folder


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """A repository with a built arm, which is not committed yet."""
    Path("urdfsync.toml").write_text(CONFIGURATION)
    Path("arm.urdf").write_text(robot_of(BUILT))
    repository = Repository(folder, monkeypatch)
    execute("build")
    return repository


def test_a_recorded_model_that_the_files_contradict_moves_nothing(edited: Path, execute: Execute) -> None:
    """A stranger exchanged two links in the record: the edit stays, and the build asks about it."""
    model = msgspec.to_builtins(states.record(STATE).snapshot)
    links = model["links"]
    links |= {"link_2": links["link_3"], "link_3": links["link_2"]}
    states.rewrite(STATE, snapshot=model)
    assert "may be another part now" in execute("build", code=Exit.CONFLICT).words
    assert "Real mine" in Path(LINK.format(2)).read_text()


@pytest.mark.parametrize("lost", ["links", "joints"])
@pytest.mark.parametrize("export", EXPORTS)
def test_a_recorded_model_that_lacks_parts_loses_no_edit(
    edited: Path, execute: Execute, lost: str, export: str
) -> None:
    """A stranger took them out of the record."""
    model = msgspec.to_builtins(states.record(STATE).snapshot)
    for number in "123":
        kept = {name: one for name, one in model[lost].items() if not name.endswith(f"_{number}")}
        assert kept != model[lost]
        states.rewrite(STATE, snapshot={**model, lost: kept})
        Path("arm.urdf").write_text(robot_of(EXPORTS[export]))
        code = execute("build", code=None).code
        assert code in (Exit.IN_STEP, Exit.CONFLICT)
        assert sum("Real mine" in path.read_text() for path in Path("modelica/Arm").rglob("*.mo")) == 1


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("edits_first", "driver"),
    [(False, True), (True, False), *(pytest.param(both, both, marks=pytest.mark.large) for both in (False, True))],
)
def test_one_branch_exchanges_names_and_the_other_edits(
    repository: Repository, execute: Execute, way: str, edits_first: bool, driver: bool
) -> None:
    """From either side of git's merge, an edit follows its part, or the build asks about it."""
    if driver:
        execute("merge-driver", "--install")
    repository.commit()
    model, joint_file = "modelica/Arm/Arm.mo", "modelica/Arm/Joints/Joint_{}.mo"
    for branch in ("theirs", "ours"):
        repository.git("checkout", "-q", "-b", branch, "main")
        if (branch == "ours") is edits_first:
            edit(LINK.format(2), "\nequation", MINE)
            edit(joint_file.format(2), "\nequation", MINE)
            edit(model, "\nequation", "\n  Real mine = link_2.m;\n\nequation")
        else:
            Path("arm.urdf").write_text(robot_of(EXPORTS["exchanged"]))
        execute("build")
        repository.commit(branch)
    for command in WAYS[way]:
        repository.git(*command.split())
    Path("theirs.patch").unlink(missing_ok=True)
    if way in ("squash", "patch"):
        repository.git("branch", "-q", "-D", "theirs")
    words = execute("build", code=None).words
    if "It uses `link_2`, which is another part now" in words:
        edit(model, "link_2.m;", "link_3.m;")
        execute("resolve", model, "--keep", code=None)
    for file in (LINK.format(2), joint_file.format(2)):
        if "Real mine" in Path(file).read_text():
            assert "another part" in words
            execute(
                "resolve",
                file,
                "--moved",
                Path(LINK.format(3) if "Link" in file else "joint_3").stem.lower(),
                code=None,
            )
    texts = {path.as_posix(): path.read_text() for path in Path("modelica").rglob("*.mo")}
    holders = sorted(path for path, text in texts.items() if "Real mine" in text)
    assert holders == sorted([model, LINK.format(3), joint_file.format(3)])
    assert "Real mine = link_3.m;" in texts[model]
    execute("build", "--check")
