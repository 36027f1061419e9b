"""The poses of SRDF files beside a URDF: those of this robot, and a line for each file with a fault."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.formats.urdf.named_poses import named_poses
from urdfsync.formats.urdf.robot import Joint, Link, Mimic, Robot

ROBOT = Robot(
    "arm",
    (Link("base"), Link("a"), Link("b")),
    (Joint("turn", "revolute", "base", "a"), Joint("jaw", "prismatic", "a", "b", mimic=Mimic("turn"))),
)


def state(name: str, group: str = "arm", **values: str) -> str:
    joints = "".join(f'<joint name="{joint}" value="{value}"/>' for joint, value in values.items())
    return f'<group_state name="{name}" group="{group}">{joints}</group_state>'


def srdf(*states: str, name: str = "arm") -> str:
    return f'<robot name="{name}">{"".join(states)}</robot>'


@pytest.mark.parametrize(
    ("file", "text", "poses", "fault"),
    [
        ("arm.srdf", srdf(state("up", turn="1.5", jaw="0.1")), {"up": {"joint turn": 1.5}}, ""),
        (
            "other.srdf",
            srdf(state("up", turn="1"), state("up", "hand", turn="2")),
            {"up": {"joint turn": 1.0}, "up (hand)": {"joint turn": 2.0}},
            "",
        ),
        ("other.srdf", srdf(state("up", turn="1"), name="crane"), {}, ""),
        ("arm.srdf", srdf(state("odd", turn="1 2 3"), state("far", turn="nan")), {}, ""),
        (
            "arm.srdf",
            srdf(state("up", turn="1", boom="2", winch="3"), name="crane"),
            {"up": {"joint turn": 1.0}},
            "arm.srdf: its poses name 2 joints that this robot lacks, such as boom",
        ),
        ("arm.srdf", "<robot>\n<group_state", {}, "arm.srdf:2: its poses can't be read: this is not well-formed XML"),
    ],
)
def test_poses_and_faults(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, file: str, text: str, poses: object, fault: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(file).write_text(text)
    found, faults = named_poses(tmp_path / "arm.urdf.xacro", ROBOT)
    assert found == poses
    assert [line[: len(fault)] for line in faults] == ([fault] if fault else [])
