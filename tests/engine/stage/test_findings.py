"""What is said beside the actions of a build: connectors that come and go, packages and states that are left over."""

from __future__ import annotations

from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.networks import LADDER, MANIFEST, ROBOT, edit, run, run_all, said, source
from support.networks import inner_kinds as kinds
from support.states import record, rewrite

from urdfsync import cli
from urdfsync.engine.actions import Reason

LINKS = tuple(urdfs.link(name, 1.0) for name in ("base", "arm", "hand"))
SWING = urdfs.joint("swing", "continuous", "base", "arm")
GRIP = urdfs.joint("grip", "fixed", "arm", "hand")
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


@pytest.fixture
def arm(folder: Path) -> Path:
    (folder / "urdfsync.toml").write_text(CONFIG)
    (folder / "arm.urdf").write_text(urdfs.robot(*LINKS[:2], SWING))
    assert cli.main(["build", "-q"]) == 0
    return folder


def test_a_leaf_that_gets_a_child_loses_its_frame_and_both_commands_say_so(arm: Path, execute: Execute) -> None:
    (arm / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    hint = 'set `frames = ["arm"]` to bring it back'
    printed = execute("diff", "arm.urdf", code=1)
    assert f"link arm frame arm_link_be5539Frame is gone ({hint}) link hand frame now handFrame" in printed.words
    assert printed.err == "", "what the effects say is not said twice"
    notes = [
        "arm.urdf: note: new connectors and variables: `handFrame` [connector-changed]",
        f"arm.urdf:4: note: link arm: its frame `arm_link_be5539Frame` is gone; {hint} [connector-changed]",
    ]
    assert execute("status", code=1).errors == notes
    assert execute("build").errors == notes
    assert "arm_link_be5539Frame" not in (arm / "modelica/Arm/Arm.mo").read_text()
    assert "connector-changed" not in execute("build").words


def test_a_model_of_the_users_that_uses_a_frame_that_goes_is_told_how_it_comes_back(
    arm: Path, execute: Execute
) -> None:
    (arm / "Cell.mo").write_text(
        "model Cell\n  Arm.Arm robot; Modelica.Mechanics.MultiBody.Interfaces.Frame_a x;\n"
        "equation\n  connect(robot.arm_link_be5539Frame, x);\nend Cell;\n"
    )
    (arm / "arm.urdf").write_text(urdfs.robot(*LINKS, SWING, GRIP))
    expected = (
        'Cell.mo:4: warning: Arm has no `arm_link_be5539Frame`; set `frames = ["arm"]` to bring it back [unresolved]'
    )
    for command, code in (("diff", 1), ("status", 1), ("build", 0)):
        assert expected in execute(command, code=code).errors
    with (arm / "urdfsync.toml").open("a") as file:
        file.write('frames = ["arm"]\n')
    assert "[unresolved]" not in execute("build").words


def test_what_goes_with_its_element_is_named_and_of_much_that_is_new_only_the_number(
    arm: Path, execute: Execute
) -> None:
    (arm / "arm.urdf").write_text(urdfs.robot(LINKS[0]))
    found = execute("build").words
    assert all(f"its {name} is gone" in found for name in ("frame `arm_link_be5539Frame`", "axis `swingAxis`"))
    joints = [urdfs.joint(f"j{number}", "continuous", "base", f"l{number}") for number in range(2)]
    (arm / "arm.urdf").write_text(urdfs.robot(LINKS[0], *(urdfs.link(f"l{n}", 1.0) for n in range(2)), *joints))
    words = (
        "new connectors and variables: `l0Frame`, `l1Frame`, `j0Axis`, `j0Support`, `j0_phi`, `j0_tau`, 4 more [conn"
    )
    assert words in execute("build").words


def configure(arm: Path, lines: str) -> None:
    """Build with other options; the robot stays as it is."""
    (arm / "urdfsync.toml").write_text(CONFIG + lines)


def test_a_joint_that_is_driven_no_more_is_named_with_what_run_loses(arm: Path, execute: Execute) -> None:
    configure(arm, "driven = []\n")
    found = execute("build").words
    for variable in ("position in Run `swing_phi`", "effort in Run `swing_tau`"):
        assert f'joint swing: its {variable} is gone; set `driven = ["swing"]` to bring it back' in found
    assert "swingAxis" not in found, "the robot keeps its connectors"


def test_a_model_that_is_asked_for_no_more_is_named_with_the_key_that_keeps_it(arm: Path, execute: Execute) -> None:
    configure(arm, 'approach = ["record"]\n')
    found = execute("build", "--verbose").words
    assert "the option `approach` changed" in found
    assert 'robot: its model `Arm` is gone; set `approach = ["package", "record"]` to bring it back' in found


def test_options_are_named_only_if_nothing_else_changed(arm: Path, execute: Execute) -> None:
    configure(arm, 'frames = "all"\ncollisions = false\n')
    assert "the options `collisions` and `frames` changed" in execute("build", "--dry-run").words
    (arm / "mine").mkdir()
    configure(arm, 'frames = "all"\ntemplates = "mine"\n')
    (arm / "mine/robot.mo.jinja").write_text("")
    assert "a template, an option or urdfsync itself changed" in execute("build", "--dry-run").words


def test_a_renamed_package_is_told_as_such(arm: Path, execute: Execute) -> None:
    edit(arm / "urdfsync.toml", 'package = "Arm"', 'package = "Crane"')
    assert "the package's name changed: Arm → Crane" in execute("build", "--dry-run").words
    edit(arm / "urdfsync.toml", 'package = "Crane"', 'package = "Arm"\nclass = "Crane"')
    told = "the package's name changed: Arm with the class Arm → Arm with the class Crane"
    assert told in execute("build", "--dry-run").words


@pytest.mark.parametrize("option", [{"frames": "none"}, {"frames": 3}, {"roof": "red"}])
def test_recorded_options_that_this_program_does_not_have_are_no_obstacle(
    arm: Path, execute: Execute, option: dict[str, object]
) -> None:
    recorded = arm / ".urdfsync/robots/arm.state"
    assert record(recorded).options["frames"] == "leaves"
    rewrite(recorded, options=option)
    configure(arm, "driven = []\n")
    assert "connector-changed" not in execute("build").words
    assert record(recorded).options["frames"] == "leaves"


def test_a_robot_with_another_name_takes_its_state_along(project: Path) -> None:
    run()
    edit(f"{LADDER}/Elements/R1.mo", "end R1;", "// mine\nend R1;")
    source("4.7e-6", "1e-5")
    edit("urdfsync.toml", "[robots.ladder]", "[robots.filter]")
    assert [found.code for found in run(dry=True).diagnostics] == ["renamed-robot"]
    result = run()
    assert kinds(result) == {"Elements/R1.mo": Reason.KEEP, "Elements/C2Parameters.mo": Reason.UPDATE}
    assert said(result) == [
        "urdfsync.toml:1: note: robot `filter` was called `ladder`; "
        "its recorded state continues under the new name [renamed-robot]"
    ]
    states = {path.name for path in (project / ".urdfsync/robots").iterdir()}
    assert states == {"filter.state"}
    assert run().diagnostics == ()


def test_state_of_robots_that_are_gone_is_mentioned_once_and_kept(project: Path) -> None:
    run()
    Path("urdfsync.toml").write_text(ROBOT.format("filter", "Filter") + ROBOT.format("third", "Third"))
    for dry in (True, False, False):
        first, second = run_all(dry=dry)
        assert said(first) == [
            "urdfsync.toml: note: the recorded state of `ladder` exists, but the configuration has no such robot; "
            "add the robot again, or delete .urdfsync/robots/ladder.* and its package [stray-state]"
        ]
        assert second.diagnostics == ()
        assert (project / LADDER / "package.mo").exists()
        assert Path(MANIFEST).exists()
        Path(MANIFEST).write_text("it need not be readable")


def test_a_linked_configuration_that_names_another_part_now_is_told(folder: Path, execute: Execute) -> None:
    """A name in `driven` belongs to another joint after an export, and nobody has changed the configuration."""

    def export(*names: str) -> None:
        ends = ("base", "arm", "0 0 0.1"), ("arm", "hand", "0.3 0 0")
        parts = zip(names, ends, strict=True)
        joints = (urdfs.joint(name, "continuous", *links, xyz=place) for name, (*links, place) in parts)
        (folder / "arm.urdf").write_text(urdfs.robot(*LINKS, *joints))

    (folder / "real.toml").write_text(f'{CONFIG}driven = ["shoulder"]\n')
    (folder / "urdfsync.toml").symlink_to("real.toml")
    export("shoulder", "elbow")
    execute("build")
    export("elbow", "shoulder")
    expected = "urdfsync.toml:4: warning: `shoulder` names another part now"
    for _ in range(2):
        assert any(line.startswith(expected) for line in execute("build", "--verbose").errors)
