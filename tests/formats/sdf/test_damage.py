"""A damaged SDF gives a robot or a finding, in bounded time: no traceback, no hang, nothing outside of its folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.cases import CASES
from support.damage import assert_robot_or_finding, damaged
from support.sdfs import ARM

from urdfsync.engine.sources.exchange import Request
from urdfsync.formats.sdf.worker import translate
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import read_robot

PARTS = """\
<frame name="tool" attached_to="fore"><pose relative_to="elbow" degrees="true">0 0 1 0 90 0</pose></frame>
<model name="hand" placement_frame="tip"><pose relative_to="tool"/><link name="palm"/>
<link name="tip"><inertial auto="true"/><collision name="c"><geometry><sphere/></geometry></collision></link>
<joint name="grip" type="universal"><parent>palm</parent><child>tip</child><axis/>
<axis2><xyz expressed_in="palm">1 0 0</xyz></axis2></joint></model>
<joint name="held" type="ball"><parent>fore</parent><child>hand::palm</child></joint>
<joint name="closing" type="fixed"><parent>upper</parent><child>hand::tip</child></joint>
<include merge="true"><uri>other.sdf</uri></include>
</model>
"""
TEXT = ARM.replace("  </model>\n", PARTS)
WORD = r'[">]([^"<>\s]+)["<]'
OTHER = '<sdf version="1.8"><model name="other"><link name="x"/><frame name="y" attached_to="x"/></model></sdf>'


def outcome(folder: Path, content: bytes) -> str:
    """Translate a text in this process, and read the result; return the first fault."""
    file = str(folder / "arm.sdf")
    contents = {file: content, str(folder / "other.sdf"): OTHER.encode()}
    answer = translate(Request(file, {}, (), 600.0, 2**40, str(folder), contents))
    assert all(path in contents or answer.files[path] is None for path in answer.files)
    if answer.problem:
        return answer.problem.message
    found = read_robot(answer.text.encode(), file, Options(allow=("part-left-out",)))
    assert (found.robot is None) == any(each.severity == "error" for each in found.diagnostics)
    return "" if found.robot else found.diagnostics[0].message


def test_the_whole_text_is_a_robot(folder: Path) -> None:
    assert outcome(folder, TEXT.encode()) == ""


def test_a_damaged_text_gives_a_robot_or_a_finding(folder: Path) -> None:
    outcomes = {outcome(folder, damaged(TEXT, seed, WORD)) for seed in range(max(300, CASES))}
    assert len(outcomes) > 30
    assert "" in outcomes


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(max(10, CASES // 20)))
def test_a_damaged_source_gives_a_robot_or_a_finding(folder: Path, seed: int) -> None:
    file = folder / "arm.sdf"
    file.write_bytes(damaged(TEXT, seed, WORD))
    (folder / "other.sdf").write_text(OTHER)
    assert_robot_or_finding(file)
