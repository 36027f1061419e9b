"""Builds and diffs say which connectors of the robot model come, go or have another name, and how a frame is kept."""

from __future__ import annotations

from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute

from urdfsync import cli

LINKS = tuple(urdfs.link(name, 1.0) for name in ("base", "arm", "hand"))
SWING = urdfs.joint("swing", "continuous", "base", "arm")
GRIP = urdfs.joint("grip", "fixed", "arm", "hand")
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


@pytest.fixture
def project(folder: Path) -> Path:
    (folder / "urdfsync.toml").write_text(CONFIG)
    (folder / "arm.urdf").write_text(urdfs.robot(*LINKS[:2], SWING))
    assert cli.main(["build", "-q"]) == 0
    return folder


def test_a_leaf_that_gets_a_child_loses_its_frame_and_both_commands_say_so(project: Path, execute: Execute) -> None:
    (project / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    hint = 'set `frames = ["arm"]` to bring it back'
    printed = execute("diff", "arm.urdf", code=1)
    assert f"link arm frame arm_linkFrame is gone ({hint}) link hand frame now handFrame" in printed.words
    assert printed.err == "", "what the effects say is not said twice"
    notes = [
        "arm.urdf: note: there is more to connect to: `handFrame` [connector-changed]",
        f"arm.urdf:4: note: link arm: its frame `arm_linkFrame` is gone; {hint} [connector-changed]",
    ]
    assert execute("status", code=1).errors == notes
    assert execute("build").errors == notes
    assert "arm_linkFrame" not in (project / "modelica/Arm/Arm.mo").read_text()
    assert "connector-changed" not in execute("build").words


def test_a_model_of_the_users_that_uses_a_frame_that_goes_is_told_how_it_comes_back(
    project: Path, execute: Execute
) -> None:
    (project / "Cell.mo").write_text(
        "model Cell\n  Arm.Arm robot; Modelica.Mechanics.MultiBody.Interfaces.Frame_a x;\n"
        "equation\n  connect(robot.arm_linkFrame, x);\nend Cell;\n"
    )
    (project / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    expected = 'Cell.mo:4: warning: Arm has no `arm_linkFrame`; set `frames = ["arm"]` to bring it back [unresolved]'
    for command, code in (("diff", 1), ("status", 1), ("build", 0)):
        assert expected in execute(command, code=code).errors
    with (project / "urdfsync.toml").open("a") as file:
        file.write('frames = ["arm"]\n')
    assert "[unresolved]" not in execute("build").words


def test_what_goes_with_its_element_is_named_and_of_much_that_is_new_only_the_number(
    project: Path, execute: Execute
) -> None:
    (project / "arm.urdf").write_text(urdfs.robot(LINKS[0]))
    found = execute("build").words
    assert all(f"its {name} is gone" in found for name in ("frame `arm_linkFrame`", "axis `swingAxis`"))
    joints = [urdfs.joint(f"j{number}", "continuous", "base", f"l{number}") for number in range(2)]
    (project / "arm.urdf").write_text(urdfs.robot(LINKS[0], *(urdfs.link(f"l{n}", 1.0) for n in range(2)), *joints))
    words = "more to connect to: `l0Frame`, `l1Frame`, `j0Axis`, `j0Support`, `j0_phi`, `j0_tau`, 4 more [conn"
    assert words in execute("build").words


def configure(project: Path, lines: str) -> None:
    """Build with other options; the robot stays as it is."""
    (project / "urdfsync.toml").write_text(CONFIG + lines)


def test_a_joint_that_is_driven_no_more_is_named_with_what_run_loses(project: Path, execute: Execute) -> None:
    configure(project, "driven = []\n")
    found = execute("build").words
    for variable in ("position in Run `swing_phi`", "effort in Run `swing_tau`"):
        assert f'joint swing: its {variable} is gone; set `driven = ["swing"]` to bring it back' in found
    assert "swingAxis" not in found, "the robot keeps its connectors"


def test_a_model_that_is_asked_for_no_more_is_named_with_the_key_that_keeps_it(project: Path, execute: Execute) -> None:
    configure(project, 'approach = ["record"]\n')
    found = execute("build", "--explain").words
    assert "the option `approach` changed" in found
    assert 'robot: its model `Arm` is gone; set `approach = ["package", "record"]` to bring it back' in found


def test_options_are_named_only_if_nothing_else_changed(project: Path, execute: Execute) -> None:
    configure(project, 'frames = "all"\ncollisions = false\n')
    assert "the options `collisions` and `frames` changed" in execute("build", "--dry-run").words
    (project / "mine").mkdir()
    configure(project, 'frames = "all"\ntemplates = "mine"\n')
    (project / "mine/robot.mo.jinja").write_text("")
    assert "a template, an option or urdfsync itself changed" in execute("build", "--dry-run").words


@pytest.mark.parametrize("option", ['["frames","none"]', '["frames",3]', '["roof","red"]'])
def test_recorded_options_that_this_program_does_not_have_are_no_obstacle(
    project: Path, execute: Execute, option: str
) -> None:
    recorded = project / ".urdfsync/robots/arm.state"
    text = recorded.read_text()
    assert 'option ["frames","leaves"]\n' in text
    recorded.write_text(text.replace('["frames","leaves"]', option))
    configure(project, "driven = []\n")
    assert "connector-changed" not in execute("build").words
    assert 'option ["frames","leaves"]\n' in recorded.read_text()
