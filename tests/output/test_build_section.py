"""What commands write for merge requests: Markdown and SARIF, of the same results as their lines and their JSON."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import edit
from support.schemas import validate

from urdfsync.analysis.checks.results import CheckResult
from urdfsync.domain.experiment import Deviation, Quantity
from urdfsync.engine.result import Exit

URDF = """<robot name="arm">
  <link name="base"/>
  <link name="tip"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="tip"/><limit lower="-1" upper="1" effort="54" velocity="2"/>
  </joint>
</robot>
"""
RECORD = "modelica/Arm/Joints/ElbowParameters.mo"


@pytest.fixture
def arm(folder: Path, execute: Execute) -> Path:
    """A built arm whose source has changed since: a mass, a limit, and one more link."""
    (folder / "arm.urdf").write_text(URDF)
    execute("init", "arm.urdf", "-q")
    execute("build", "-q")
    edit("arm.urdf", '"54"', '"60"')
    edit("arm.urdf", '<mass value="2"/>', '<mass value="3"/>')
    grip = '<link name="grip|"/><joint name="hold" type="fixed"><parent link="tip"/><child link="grip|"/></joint>'
    edit("arm.urdf", "</robot>", f"{grip}</robot>")
    return folder


def markdown(execute: Execute, *arguments: str, code: int = Exit.OUT_OF_STEP) -> str:
    printed = execute(*arguments, "--format", "markdown", code=code)
    assert printed.err == ""
    return printed.out


def row(*cells: str) -> str:
    return f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def results(execute: Execute, *arguments: str, code: int = Exit.OUT_OF_STEP) -> dict[str, Any]:
    """The results of a valid SARIF log, by their codes."""
    document = execute(*arguments, "--format", "sarif", code=code).json
    validate(document, "sarif")
    return {result["ruleId"]: result for result in document["runs"][0]["results"]}


def place(result: Any) -> tuple[str, int]:
    location = result["locations"][0]["physicalLocation"]
    return location["artifactLocation"]["uri"], location["region"]["startLine"]


def test_a_check_says_what_a_build_would_do_structure_first(arm: Path, execute: Execute) -> None:
    with unchanged(arm):
        text = markdown(execute, "build", "--check")
    head, advice, rest = text.split("\n", 2)
    assert head.startswith("<h3>! arm: 9 files to write")
    assert advice == "<p>Run <code>urdfsync build</code>, and commit what it writes.</p>"
    structure, tables = rest.split("</ul>")
    assert "<li>link grip|: added</li>" in structure
    assert row("link tip", "inertial / mass", "2 → 3 kg", "+50 %") in tables
    assert row(RECORD, "update", "joint elbow") in tables


def test_a_difference_of_versions_has_its_effects_and_no_verdict(arm: Path, execute: Execute) -> None:
    Path("old.urdf").write_text(URDF)
    text = markdown(execute, "diff", "--against", "old.urdf")
    assert text.startswith("<h3>arm: ")
    assert "since old.urdf" in text
    assert row("robot mass", "2 → 3 kg", "+50 %") in text
    assert results(execute, "diff", "--against", "old.urdf") == {}


def test_edits_have_their_elements(arm: Path, execute: Execute) -> None:
    edit(RECORD, "54", "55")
    text = markdown(execute, "diff", "--edits", code=Exit.IN_STEP)
    assert row(RECORD, "extends <code>UrdfSync.Records.RevoluteJoint</code>", "limits.effort 54 → 55") in text


def test_a_conflict_stands_at_the_first_edited_line(arm: Path, execute: Execute) -> None:
    edit(RECORD, "54", "55")
    (line,) = [number for number, text in enumerate(Path(RECORD).read_text().splitlines(), start=1) if "55" in text]
    found = results(execute, "build", "--check", code=Exit.CONFLICT)
    assert place(found["conflict"]) == (RECORD, line)
    assert place(found["out-of-step"]) == ("modelica/Arm/package.mo", 1)
    assert "the export changes 54 to 60" in found["conflict"]["message"]["text"]
    assert f"{RECORD}:{line}" in markdown(execute, "build", "--check", code=Exit.CONFLICT)


def test_what_is_wrong_with_a_source_stands_at_its_line(arm: Path, execute: Execute) -> None:
    edit("arm.urdf", 'type="fixed"', 'type="bent"')
    assert place(results(execute, "build", "--check", code=Exit.ERROR)["unknown-joint-type"]) == ("arm.urdf", 8)
    assert "<h3>✗ arm: 1 error" in markdown(execute, "build", "--check", code=Exit.ERROR)


def test_a_built_package_is_fine_in_one_line(arm: Path, execute: Execute) -> None:
    execute("build", "-q")
    text = markdown(execute, "build", "--check", code=Exit.IN_STEP)
    assert re.fullmatch(r"<ul>\n<li>✓ arm: in step, \d+ files</li>\n</ul>\n", text)
    assert results(execute, "build", "--check", code=Exit.IN_STEP) == {}


def test_a_check_says_how_far_the_package_agrees(arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    torque = Deviation(Quantity.EFFORT, "joint elbow", 1.0, 10.0, 10.0, "N·m")
    result = CheckResult("arm", "Arm", reference="Pinocchio 3.4", folder="modelica/Arm")
    wrong = msgspec.structs.replace(result, deviations=(torque,))

    def check(*_: object) -> Iterator[CheckResult]:
        yield wrong

    monkeypatch.setattr("urdfsync.commands.check.check_robots", check)
    text = markdown(execute, "check")
    assert "<li>joint elbow: torque differs from Pinocchio 3.4 by 1 N·m" in text
    assert row("rigid bodies", "differ (joint elbow), to 1.0e-01", "joint elbow, effort") in text
    found = results(execute, "check")
    assert place(found["differs"]) == ("modelica/Arm/package.mo", 1)
    assert "torque differs from Pinocchio" in found["differs"]["message"]["text"]


def test_a_check_of_a_package_out_of_step_says_so(arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    gap = "nothing was compiled: there is no compiler"
    result = CheckResult("arm", "Arm", in_step=False, gaps=(gap,), folder="modelica/Arm")
    monkeypatch.setattr("urdfsync.commands.check.check_robots", lambda *_: iter([result]))
    advice = "the package is out of step; run <code>urdfsync build</code>"
    _head, rest = markdown(execute, "check").split("\n", 1)
    assert rest == f"<ul>\n<li>{gap}</li>\n<li>{advice}</li>\n</ul>\n"
    found = results(execute, "check")["out-of-step"]
    assert found["message"]["text"] == "Arm: the package is out of step; run `urdfsync build`"
