"""What is said beside the actions of a build: states that are left over, options of another program.

`tests/scenarios/connectors.txt` has connectors that come and go.
"""

from __future__ import annotations

from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.networks import LADDER, MANIFEST, ROBOT, edit, run, run_all, said, source
from support.networks import inner_kinds as kinds
from support.states import record, rewrite

from urdfsync.commands import cli
from urdfsync.engine.actions import Reason

LINKS = tuple(urdfs.link(name, 1.0) for name in ("base", "arm", "hand"))
SWING = urdfs.joint("swing", "continuous", "base", "arm")
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


@pytest.fixture
def arm(folder: Path) -> Path:
    (folder / "urdfsync.toml").write_text(CONFIG)
    (folder / "arm.urdf").write_text(urdfs.robot(*LINKS[:2], SWING))
    assert cli.main(["build", "-q"]) == 0
    return folder


@pytest.mark.parametrize("option", [{"frames": "none"}, {"frames": 3}, {"roof": "red"}])
def test_recorded_options_that_this_program_does_not_have_are_no_obstacle(
    arm: Path, execute: Execute, option: dict[str, object]
) -> None:
    recorded = arm / ".urdfsync/robots/arm.state"
    assert record(recorded).options["frames"] == "leaves"
    rewrite(recorded, options=option)
    (arm / "urdfsync.toml").write_text(f"{CONFIG}driven = []\n")
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
