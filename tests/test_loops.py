"""A loop from the configuration or a file beside the URDF, which is renamed, moved, removed, and edited."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.urdfs import joint, link, robot

URDF = robot(
    *(link("base"), link("crank", 1.0), link("rod", 1.0), link("rocker", 1.0)),
    joint("drive", "continuous", "base", "crank", xyz="0 0 0", rpy="0 0 0", axis="0 0 1"),
    joint("elbow", "continuous", "crank", "rod", xyz="0.3 0.1 0", rpy="0 0 0", axis="0 0 1"),
    joint("pivot", "continuous", "base", "rocker", xyz="0.5 0 0", rpy="0 0 0", axis="0 0 1"),
)
CONFIGURATION = """[robots.bars]
source = "bars.urdf"
package = "Bars"
output = "modelica"
"""
LOOP = """
[[robots.bars.loops]]
name = "closing"
kind = "revolute"
frames = [{link = "rod", xyz = [0.4, 0.2, 0]}, {link = "rocker", xyz = [0.2, 0.3, 0]}]
"""
RECORD, MODEL = "modelica/Bars/Joints/ClosingParameters.mo", "modelica/Bars/Joints/Closing.mo"


@pytest.fixture
def project(folder: Path, execute: Execute) -> Path:
    (folder / "bars.urdf").write_text(URDF)
    (folder / "urdfsync.toml").write_text(CONFIGURATION + LOOP)
    execute("build")
    return folder


def configure(project: Path, old: str, new: str) -> None:
    text = (project / "urdfsync.toml").read_text()
    assert old in text
    (project / "urdfsync.toml").write_text(text.replace(old, new))


def test_an_edit_and_another_place_of_the_pivot_meet(project: Path, execute: Execute) -> None:
    model = (project / MODEL).read_text()
    (project / MODEL).write_text(model.replace("equation", "  Real mine = constraint.f[1];\n\nequation"))
    configure(project, "0.2, 0.3, 0]", "0.2, 0.301, 0]")
    assert "loop closing" in execute("diff", code=1).out
    execute("build")
    assert "0.301" in (project / RECORD).read_text()
    assert "mine" in (project / MODEL).read_text()


def test_a_loop_that_is_renamed_takes_its_edits_along(project: Path, execute: Execute) -> None:
    record = (project / RECORD).read_text()
    (project / RECORD).write_text(record.replace('name = "closing"', 'name = "closing" "Bolt M6"'))
    configure(project, 'name = "closing"', 'name = "hinge"')
    execute("build")
    assert not (project / RECORD).exists()
    assert "Bolt M6" in (project / "modelica/Bars/Joints/HingeParameters.mo").read_text()


def test_a_loop_that_is_removed_takes_its_files_along(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").write_text(CONFIGURATION)
    execute("build")
    assert not (project / MODEL).exists()
    assert "closing" not in (project / "modelica/Bars/Bars.mo").read_text()


@pytest.mark.parametrize(("old", "new", "words"), [
    ('link = "rocker"', 'link = "rockr"', "urdfsync.toml:6: error: robot `bars`: loop 'closing' has a frame on link"),
    ('link = "rocker"', 'link = "rod"', "has both frames on link 'rod'"),
    ("0.2, 0.3, 0]", "2, 3, 0]", "loop 'closing' cannot be closed"),
    ('"revolute"', '"prismatic"', "urdfsync.toml:6: error"),
    ('output = "modelica"', 'output = "modelica"\napproach = ["record"]', "[loops-not-in-record]"),
])  # fmt: skip
def test_a_fault_stops_the_build_with_its_line(project: Path, execute: Execute, old: str, new: str, words: str) -> None:
    configure(project, old, new)
    assert words in execute("build", code=2).err


@pytest.mark.slow
def test_joints_that_start_elsewhere_and_the_chosen_drive_are_told_once(project: Path, execute: Execute) -> None:
    configure(project, 'output = "modelica"', 'output = "modelica"\nstart = { drive = 0.1, elbow = 2.0 }')
    said = execute("build").err
    assert "urdfsync.toml:5: note: robot `bars`: to close the loops, joints move: 'elbow' by " in said
    assert "Run and Test drive 'drive' (the first free one); if that is wrong" not in said, "it was told before"
    assert "Angle drive = 0.1\n" in (project / "modelica/Bars/BarsStart.mo").read_text()


def test_a_link_that_the_next_export_lacks_is_told(project: Path, execute: Execute) -> None:
    (project / "bars.urdf").write_text(URDF.replace("rocker", "lever"))
    assert "'rocker', which does not exist" in execute("build", code=2).err


WITH_ENDS = URDF.replace(
    "</robot>",
    "\n".join(
        [
            *(link("a"), link("b")),
            joint("fa", "fixed", "rod", "a", xyz="0.4 0.2 0", rpy="0 0 0"),
            joint("fb", "fixed", "rocker", "b", xyz="0.2 0.3 0", rpy="0 0 0"),
            "</robot>",
        ]
    ),
)
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
PAIR = "closed_loop: [[a, b]]\ntype: ['3d']\n"
NAMING = f'{CONFIGURATION}closed_loops = "bars.yaml"\n'


@pytest.mark.parametrize(("urdf", "yaml"), [
    (f"{WITH_ENDS}<!-- the former end: </robot> -->\n".encode(), PAIR.encode()),
    (WITH_ENDS.encode("utf-16"), PAIR.encode()),
    (WITH_ENDS.encode(), PAIR.encode("utf-16")),
], ids=["comment", "urdf", "yaml"])  # fmt: skip
def test_comments_and_encodings_take_no_loop_away(project: Path, execute: Execute, urdf: bytes, yaml: bytes) -> None:
    (project / "urdfsync.toml").write_text(NAMING)
    (project / "bars.urdf").write_bytes(urdf)
    (project / "bars.yaml").write_bytes(yaml)
    execute("build")
    assert (project / "modelica/Bars/Joints/A_b.mo").exists()
    (project / "bars.yaml").write_text(PAIR.replace("b]", "x]"))
    assert "bars.yaml:1: error: loop 'a_x' has a frame on link 'x'" in execute("build", code=2).err


def test_the_loops_of_a_yaml_never_vanish_in_silence(project: Path, execute: Execute) -> None:
    (project / "bars.urdf").write_text(WITH_ENDS)
    (project / "bars.yaml").write_text(PAIR)
    (project / "urdfsync.toml").unlink()
    assert 'closed_loops = "bars.yaml"' in execute("init", "bars.urdf").words
    (project / "urdfsync.toml").write_text(CONFIGURATION)
    unnamed = "error: robot `bars`: bars.yaml stands beside the source, and no option names it; set `closed_loops`"
    assert unnamed in execute("build", code=2).err
    for other in ("gains: [1, 2]", "pid:\n  closed_loop: true  # odometry", "{control: {closed_loop_control: true}}"):
        (project / "bars.yaml").write_text(f"{other}\n")  # of another program
        execute("build")
    (project / "bars.yaml").rename(project / "loops.yaml")
    (project / "loops.yaml").write_text(PAIR)
    (project / "urdfsync.toml").write_text(NAMING)
    assert "`closed_loops` names bars.yaml, which can't be read" in execute("build", code=2).err
    configure(project, "bars.yaml", "loops.yaml")
    (project / "bars.urdf").rename(project / "renamed.urdf")
    configure(project, "bars.urdf", "renamed.urdf")
    execute("build")
    assert (project / "modelica/Bars/Joints/A_b.mo").exists()


def test_a_named_yaml_without_a_list_takes_no_loop_away_in_silence(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").write_text(NAMING)
    (project / "bars.urdf").write_text(WITH_ENDS)
    for text in ("", "a: 1\n"):  # an editor may be saving it
        (project / "bars.yaml").write_text(text)
        assert "bars.yaml:1: error: this is no list of loops: it states no loop" in execute("build", code=2).err
    (project / "bars.yaml").write_text("closed_loop: []\n")
    execute("build")


def test_no_yaml_is_looked_for_beside_xacro(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").write_text(CONFIGURATION.replace("bars.urdf", "bars.urdf.xacro"))
    (project / "bars.urdf.xacro").write_text(WITH_ENDS.replace("<robot", f"<robot {XACRO}", 1))
    (project / "bars.urdf.yaml").write_text(PAIR)
    (project / "bars.yaml").write_text(PAIR)
    execute("build")


def test_another_file_is_compared_with_the_yaml_beside_it(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").write_text(CONFIGURATION)
    (project / "bars.urdf").write_text(WITH_ENDS)
    (project / "other.urdf").write_text(WITH_ENDS)
    (project / "other.yaml").write_text(PAIR)
    assert "loop a_b" in execute("diff", "--against", "other.urdf", code=1).out


def test_the_yaml_beside_a_urdf_is_watched_and_compared(project: Path, execute: Execute) -> None:
    yaml = project / "bars.yaml"
    (project / "urdfsync.toml").write_text(NAMING)
    (project / "bars.urdf").write_text(WITH_ENDS)
    yaml.write_text(PAIR)
    execute("build")
    assert (project / "modelica/Bars/Joints/A_b.mo").exists()
    execute("build", "--check")
    yaml.write_text("closed_loop: [[a, b]]\ntype: ['6d']\n")
    assert "kind" in execute("diff", code=1).out
    yaml.write_text("closed_loop: [[a, x]]\ntype: ['6d']\n")
    assert "bars.yaml:1: error: loop 'a_x' has a frame on link 'x'" in execute("build", code=2).err
