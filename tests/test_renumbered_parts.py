"""CAD renumbers, where a text is no scenario: forged records, git, real robots; see `scenarios/renumbered.txt`."""

from __future__ import annotations

import itertools
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import get_args

import msgspec
import pytest
from support import corpus, states
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.renumbering import Renumbering, renumberings
from support.urdfs import robot_of
from test_unions import WAYS

from urdfsync.api import load
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result
from urdfsync.urdf.options import LeftOut

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


def hand(path: Path, kind: str) -> str:
    """Edit a file by hand; return the text by which tests find the edit, or nothing if the file has no place."""
    text = path.read_text()
    if kind == "number":
        begin = text.index("extends")
        found = re.search(r'(?<![\w."])\d+(?:\.\d+)?(?:e-?\d+)?(?=[,)}\s])', text[begin:])
        if not found:
            return ""
        path.write_text(f"{text[: begin + found.start()]}7171.25{text[begin + found.end() :]}")
        return "7171.25"
    if "\nequation\n" not in text:
        return ""
    new = "\n  Real byHand = 3;\n\nequation\n" if kind == "component" else '\nequation\n  assert(true, "byHand");\n'
    path.write_text(text.replace("\nequation\n", new, 1))
    return "byHand"


def plan() -> Result:
    (result,) = build(configuration := load("urdfsync.toml"), configuration.robots, BuildOptions())
    return result


def meetings(source: bytes, random: Random) -> Iterator[tuple[Renumbering, str, str]]:
    """Each kind of export meets each kind of edit of one element: the fate of the edit."""
    Path("r.urdf").write_bytes(source)
    built = plan()
    assert not built.failed, built.diagnostics
    shutil.copytree("modelica", "../built", dirs_exist_ok=True)
    shutil.copytree(".urdfsync", "../state", dirs_exist_ok=True)
    owners = sorted({action.owner for action in built.actions if action.owner.startswith(("link ", "joint "))})
    for exported, kind in itertools.product(renumberings(source, random), ("number", "component", "equation")):
        for name, saved in (("modelica", "../built"), (".urdfsync", "../state")):
            shutil.rmtree(name)
            shutil.copytree(saved, name)
        owner = random.choice(owners)
        files = [action.path for action in built.actions if action.owner == owner and action.path.endswith(".mo")]
        path = next((path for path in files if path.endswith("Parameters.mo") is (kind == "number")), None)
        if path is None or not (mark := hand(Path(path), kind)):
            continue
        Path("r.urdf").write_bytes(exported.source)
        result = plan()
        if any(found.code == "loop-open" for found in result.diagnostics):
            continue  # a part in another place holds the loop open
        assert not result.failed, result.diagnostics
        part, _, name = owner.partition(" ")
        expected = exported.names.get((part, name), name)
        holders = [
            action for action in result.actions if Path(action.path).is_file() and mark in Path(action.path).read_text()
        ]
        if any(action.reason is Reason.ASKED for action in result.actions):
            yield exported, kind, "asked"
        elif any(action.is_conflict for action in result.actions):
            yield exported, kind, "conflict"
        elif [action.owner for action in holders] == [f"{part} {expected}"]:
            yield exported, kind, "followed"
        elif [action.reason for action in holders] == [Reason.ORPHAN]:
            yield exported, kind, "left"
        else:
            yield exported, kind, f"WRONG: {owner} is {expected}, the edit is in {[action.path for action in holders]}"


FILES = [file for file in corpus.robots() if file != corpus.ABSENT and not file.endswith("spot_arm.urdf")]
"""The parent of a joint in this model is a missing link."""
IN_CI = [file for file in FILES if file.endswith("puma560_robot.urdf")]


@pytest.mark.slow
@pytest.mark.parametrize(
    "file",
    [file if file in IN_CI else pytest.param(file, marks=pytest.mark.large) for file in FILES] or [corpus.ABSENT],
)
def test_edits_meet_exports_that_renumber(corpus: Path, folder: Path, file: str) -> None:
    """No edit moves to another part, and the build asks about few edits."""
    source = (corpus / file).read_bytes()
    if source.count(b"<link ") < 5:
        pytest.skip("fewer than five links")
    names = ", ".join(f'"{name}"' for name in get_args(LeftOut))
    Path("urdfsync.toml").write_text(f'[robots.r]\nsource = "r.urdf"\npackage = "R"\nallow = [{names}]\n')
    found = Counter[str]()
    for exported, kind, what in meetings(source, Random(file)):
        assert not what.startswith("WRONG"), f"{exported.kind}, {kind}: {what}"
        found[what] += 1
    print(dict(found))  # noqa: T201
    assert found["asked"] <= 3 + found.total() // 10
