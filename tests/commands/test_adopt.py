"""`urdfsync adopt`: a package that was there before becomes the user's side, and nothing of it is written."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import models, unchanged
from support.networks import C1, RECORD, edit, resistor
from support.urdfs import joint, link, robot

PARAMS = "modelica/Arm/Joints/ElbowParams.mo"
"""As URDFModelica names the records."""
RECORD_TEXT = """within Arm.Joints;
record ElbowParams
  Real limit = 4.2;
  Real x = 1;
  annotation(Placement(x = 7));
end ElbowParams;
"""


@pytest.fixture
def lost(project: Path, execute: Execute) -> Path:
    """A network whose package was built and edited, and has neither state nor stamps: another program wrote it."""
    execute("build", "-q")
    edit(C1, "\nequation\n", "\n  Real mine = 1;\nequation\n")
    edit(RECORD, "100", "99")
    shutil.rmtree(project / ".urdfsync")
    for path, text in models().items():
        Path(path).write_text(text)
    return project


def test_without_the_state_the_stamps_say_what_is_edited(project: Path, execute: Execute) -> None:
    execute("build", "-q")
    edit(C1, "\nequation\n", "\n  Real mine = 1;\nequation\n")
    shutil.rmtree(project / ".urdfsync")
    assert execute("build").lines[0].startswith("ladder: in step, 14 files, 1 kept because you edited it")
    resistor(150)
    assert "1 kept because you edited it" in execute("build").words


def test_after_the_state_was_lost(lost: Path, execute: Execute) -> None:
    assert "  urdfsync adopt ladder  takes the files for your edits, and lists them" in execute("build", code=3).lines
    shutil.rmtree(lost / ".urdfsync")
    before = models()
    assert execute("adopt", "ladder").lines == [
        "ladder: 6 files written, 2 kept because you edited them",
        f"  {C1}  element C1",
        "    component `mine`: added",
        f"  {RECORD}  element R1",
        "    component `R`: R 100 → 99",
    ]
    assert models() == before, "only stamps are new"
    assert execute("build").lines == ["ladder: in step, 14 files, 2 kept because you edited them"]


def test_later_exports_merge(lost: Path, execute: Execute) -> None:
    execute("adopt", "ladder", "-q")
    resistor(150)
    printed = execute("build", code=3)
    assert "you set" in printed.words
    assert "Real mine = 1;" in Path(C1).read_text()


def test_a_dry_run_says_the_same_and_writes_nothing(lost: Path, execute: Execute) -> None:
    with unchanged(lost):
        said = execute("adopt", "ladder", "--dry-run").lines
    assert said[0] == "ladder: 9 files to write, 2 kept because you edited them"
    assert said[1:] == execute("adopt", "ladder").lines[1:]


def test_a_robot_that_was_built_is_refused(project: Path, execute: Execute) -> None:
    execute("build", "-q")
    edit(C1, "\nequation\n", "\n  Real mine = 1;\nequation\n")
    resistor(150)
    with unchanged(project):
        printed = execute("adopt", "ladder", code=2)
    assert "robot `ladder` was built already; `urdfsync resolve` settles its conflicts [already-built]" in printed.err


def test_after_a_first_build_that_ended_in_conflicts(lost: Path, execute: Execute) -> None:
    execute("build", "-q", code=3)
    assert "2 kept because you edited them" in execute("adopt", "ladder").lines[0]


@pytest.fixture
def foreign(folder: Path, execute: Execute) -> Path:
    """A robot whose package URDFModelica might have written: other texts, other names of records, no package.order."""
    turning = joint("elbow", "revolute", "base", "tip", axis="0 0 1")
    (folder / "arm.urdf").write_text(robot(link("base"), turning, link("tip", 1)))
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    texts = {
        "modelica/Arm/package.mo": "package Arm\n  extends Modelica.Icons.Package;\nend Arm;\n",
        "modelica/Arm/Arm.mo": "within Arm;\nmodel Arm\n  Joints.Elbow elbow;\nend Arm;\n",
        "modelica/Arm/Joints/package.mo": "within Arm;\npackage Joints\nend Joints;\n",
        "modelica/Arm/Joints/Elbow.mo": "within Arm.Joints;\nmodel Elbow\n  ElbowParams p;\nend Elbow;\n",
        PARAMS: RECORD_TEXT,
        "modelica/Arm/Joints/Brake.mo": "within Arm.Joints;\nmodel Brake\nend Brake;\n",
    }
    for name, text in texts.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


@pytest.mark.slow
def test_a_package_of_another_tool(foreign: Path, execute: Execute) -> None:
    """It is adopted as it is, and broken: generated models use connectors that its joints lack."""
    before = models()
    (found,) = execute("adopt", "arm", "--format=json", code=3).json["results"]
    assert models().items() >= before.items()
    reasons = {action["path"]: action["reason"] for action in found["actions"]}
    unknown = (PARAMS, "modelica/Arm/Joints/Brake.mo")
    assert {path for path, reason in reasons.items() if reason == "keep"} == {
        path for path in before if path.endswith(".mo") and path not in unknown
    }
    assert reasons["modelica/Arm/Joints/ElbowParameters.mo"] == "create"
    assert {reasons[path] for path in unknown} == {"unknown"}
    order = (foreign / "modelica/Arm/Joints/package.order").read_text().split()
    assert order == ["Elbow", "ElbowParameters", "Brake", "ElbowParams"]
    shutil.rmtree(foreign / ".urdfsync")
    lines = execute("adopt", "arm", code=3).lines
    assert lines[-1] == f"  unknown    {PARAMS}  yours: no export changes it"
    assert "4 kept because you edited them" in execute("status", code=3).out
    assert "order-lacks" not in execute("check", code=None).words
