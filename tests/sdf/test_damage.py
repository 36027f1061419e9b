"""A damaged SDF gives a robot or a finding, in bounded time: no traceback, no hang, nothing outside of its folder."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest
from support.cases import CASES
from support.sdfs import ARM

from urdfsync import registry
from urdfsync.diagnostics import SourceError
from urdfsync.engine.exchange import Request
from urdfsync.engine.source import read_file_source, read_permissively
from urdfsync.sdf.worker import translate
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.source import read_robot

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
NUMBERS = ("0", "-1", "nan", "inf", "1e300", "-1e-300", "99999999999", "", "1 2 3 4 5 6 7 8 9", "&#55;", "../../etc")


def damaged(seed: int) -> bytes:
    """Return an SDF that is cut off, or has another number, word, line or byte."""
    choice, text = random.Random(seed), ARM.replace("  </model>\n", PARTS)
    lines = text.splitlines(keepends=True)
    match seed % 5:
        case 0:
            return text[: choice.randrange(len(text))].encode()
        case 1:
            found = choice.choice([*re.finditer(r"-?\d+\.?\d*", text)])
            return f"{text[: found.start()]}{choice.choice(NUMBERS)}{text[found.end() :]}".encode()
        case 2:
            one, other = (choice.choice([*re.finditer(r'[">]([^"<>\s]+)["<]', text)]) for _ in range(2))
            return f"{text[: one.start(1)]}{other[1]}{text[one.end(1) :]}".encode()
        case 3:
            first, second = choice.randrange(len(lines)), choice.randrange(len(lines))
            lines[first] = choice.choice((lines[second], ""))
            return "".join(lines).encode()
    content = bytearray(text.encode())
    content[choice.randrange(len(content))] = choice.randrange(256)
    return bytes(content)


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
    assert outcome(folder, ARM.replace("  </model>\n", PARTS).encode()) == ""


def test_a_damaged_text_gives_a_robot_or_a_finding(folder: Path) -> None:
    outcomes = {outcome(folder, damaged(seed)) for seed in range(max(300, CASES))}
    assert len(outcomes) > 30
    assert "" in outcomes


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(max(10, CASES // 20)))
def test_a_damaged_source_gives_a_robot_or_a_finding(folder: Path, seed: int) -> None:
    file, domain = folder / "arm.sdf", registry.domain("urdf")
    file.write_bytes(damaged(seed))
    (folder / "other.sdf").write_text(OTHER)
    try:
        read_permissively(domain, read_file_source(domain, file, {}, ()))
    except SourceError as error:
        messages = [finding.message for finding in error.diagnostics]
        assert all(messages)
        assert not any(re.match(r"exit code|signal|expanding it takes", message) for message in messages)
