"""A month of work: edits in every model of a package, and then the next export of the robot. All of it compiles."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from support.commands import Execute
from support.hand_edits import EDITS, MARK
from support.modelica import compile_task
from support.modelica import execute as compile_all
from support.urdfs import dynamics, joint, link, links, robot

PACKAGE = Path("modelica/Arm")
MODELS = {
    "Links/Upper_arm.mo": "visual",
    "Joints/Shoulder.mo": "friction",
    "Arm.mo": "Joints.Wrist wrist",
    "ArmRun.mo": "wrist_phi",
    "ArmTest.mo": "wrist",
}
"""What the export adds to each model: a visual, friction, a link with its joint, a drive."""
KINDS = "add a component", "add an equation", "move a part", "save again in another style"
VISUAL = '<visual><geometry><box size="0.4 0.05 0.05"/></geometry></visual>'


def turn(name: str, parent: str, child: str, *inside: str) -> str:
    return joint(name, "revolute", parent, child, axis="0 1 0", inside=inside)


def export(*elements: str) -> None:
    Path("arm.urdf").write_text(robot(link("base"), *elements, name="arm"))


@pytest.mark.slow
def test_what_met_compiles(folder: Path, execute: Execute, modelica_library: Path) -> None:
    export(
        *links(upper_arm=11.5, forearm=11.5),
        *(turn("shoulder", "base", "upper_arm"), turn("elbow", "upper_arm", "forearm")),
    )
    execute("init", "arm.urdf", "--merge")
    execute("build")
    for name in MODELS:
        for kind in KINDS:
            path = PACKAGE / name
            path.write_text(EDITS[kind](path.read_text(), Random(3)) or "")
    before = {name: (PACKAGE / name).read_text() for name in MODELS}
    export(
        link("upper_arm", 11.5).replace("</link>", f"{VISUAL}</link>"),
        *links(forearm=11.5, hand=11.5),
        turn("shoulder", "base", "upper_arm", dynamics(0.5, 0.1)),
        *(turn("elbow", "upper_arm", "forearm"), turn("wrist", "forearm", "hand")),
    )
    assert f"{len(MODELS)} merged with your edits" in execute("build").lines[0]
    for name, words in MODELS.items():
        text = (PACKAGE / name).read_text()
        assert words in text, name
        assert [line for line in before[name].splitlines() if MARK in line and line not in text.splitlines()] == []
    tasks = [compile_task(f"Arm.{name}") for name in ("ArmRun", "ArmTest")]
    outcomes = compile_all(modelica_library, [PACKAGE.absolute()], tasks)
    assert [outcome.error for outcome in outcomes] == ["", ""]
