"""A damaged MJCF gives a robot or a finding, in bounded time: no traceback, no hang."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest
from support.cases import CASES
from support.mjcfs import ARM

from urdfsync import registry
from urdfsync.diagnostics import SourceError
from urdfsync.engine.source import read_file_source, read_permissively

PARTS = """\
<actuator><position joint="shoulder" kp="3" forcerange="-4 4"/><motor joint="elbow" gear="5"/></actuator>
<equality><joint joint1="elbow" joint2="shoulder" polycoef="0.1 2 0 0 0"/></equality>
<sensor><jointpos joint="elbow"/></sensor>
<keyframe><key name="home" qpos="0.1 0.3"/></keyframe>
</mujoco>
"""
NUMBERS = ("0", "-1", "nan", "inf", "1e300", "-1e-300", "99999999999", "", "1 2 3 4 5 6 7 8 9")


def damaged(seed: int) -> bytes:
    """Return an MJCF that is cut off, or has another number, attribute, line or byte."""
    choice, text = random.Random(seed), ARM.replace("</mujoco>", PARTS)
    lines = text.splitlines(keepends=True)
    match seed % 5:
        case 0:
            return text[: choice.randrange(len(text))].encode()
        case 1:
            found = choice.choice([*re.finditer(r"-?\d+\.?\d*", text)])
            return f"{text[: found.start()]}{choice.choice(NUMBERS)}{text[found.end() :]}".encode()
        case 2:
            one, other = (choice.choice([*re.finditer(r'"([^"]*)"', text)]) for _ in range(2))
            return f"{text[: one.start(1)]}{other[1]}{text[one.end(1) :]}".encode()
        case 3:
            first, second = choice.randrange(len(lines)), choice.randrange(len(lines))
            lines[first] = choice.choice((lines[second], ""))
            return "".join(lines).encode()
    content = bytearray(text.encode())
    content[choice.randrange(len(content))] = choice.randrange(256)
    return bytes(content)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(max(20, CASES)))
def test_a_damaged_source_gives_a_robot_or_a_finding(folder: Path, seed: int) -> None:
    file, domain = folder / "arm.xml", registry.domain("urdf")
    file.write_bytes(damaged(seed))
    try:
        read_permissively(domain, read_file_source(domain, file, {}, ()))
    except SourceError as error:
        messages = [finding.message for finding in error.diagnostics]
        assert all(messages)
        assert not any(re.match(r"exit code|signal|expanding it takes", message) for message in messages)
