"""yourdfpy as second reader: agreement is silent, disagreement an error, its failures notes; where it reads at all."""

from __future__ import annotations

import json
import logging
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
import yourdfpy

from urdfsync import cli
from urdfsync.diagnostics import Severity
from urdfsync.urdf.parse.second_reader import compare_readers
from urdfsync.urdf.parse.source import RobotReading, read_robot
from urdfsync.urdf.robot import Joint, Link, Robot

TREE = '<link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
URDF = f'<robot name="r">{TREE}</robot>'
ODD = URDF.replace(' name="r"', "")
"""A robot that yourdfpy can't read."""
ROBOT = Robot("r", (Link("a"), Link("b")), (Joint("j", "fixed", "a", "b"),))


def read(urdf: str) -> RobotReading:
    return read_robot(urdf.encode(), "a.urdf", cross_check=True)


@pytest.mark.parametrize(("changes", "message"), [
    ({"links": (Link("a"), Link("c"))}, "other links: without c; with b"),
    ({"joints": (Joint("j", "fixed", "b", "a"),)}, "without j (fixed, b → a); with j (fixed, a → b)"),
    ({"joints": (Joint("j", "planar", "a", "b"),)}, "without j (planar, a → b); with j (fixed, a → b)"),
    ({"joints": ()}, "other joints: with j (fixed, a → b)"),
    ({"links": tuple(map(Link, "abcdefgh"))}, "other links: without c, d, e, f, g, …"),
])  # fmt: skip
def test_disagreement_is_an_error(changes: dict[str, Any], message: str) -> None:
    (finding,) = compare_readers(URDF.encode(), msgspec.structs.replace(ROBOT, **changes))
    assert finding.code == "second-reader-differs"
    assert finding.message.endswith(message)


@pytest.mark.parametrize(
    ("urdf", "reason"),
    [
        (ODD, "KeyError"),
        (URDF.replace("<robot", '<robot xmlns="http://www.ros.org"'), "finds no link"),
        (URDF.replace('"a"/>', '"a"><visual/></link>', 1), "TypeError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry/></visual></link>', 1), "IndexError"),
        (URDF.replace('"a"/>', '"a"><visual><geometry><capsule radius="1" length="1"/></geometry></visual></link>', 1),
         "Unknown tag: capsule"),
        (URDF.replace("<link", '<material name="m"><color rgba="x"/></material><link', 1), "ValueError"),
        (f'<?xml version="1.0" encoding="utf-16"?>{URDF}', "TypeError"),
    ],
)  # fmt: skip
def test_what_only_the_strict_reader_accepts_is_a_note(urdf: str, reason: str) -> None:
    reading = read(urdf)
    assert reading.robot is not None
    (note,) = [d for d in reading.diagnostics if d.code == "second-reader-failed"]
    assert note.severity is Severity.NOTE
    assert reason in note.message
    assert note.line > 0


def test_yourdfpy_is_silent_and_its_log_is_left_as_it_was(capfd: pytest.CaptureFixture[str]) -> None:
    read(f'<?xml version="0.0"?>{URDF}')
    read(ODD)
    assert not logging.getLogger("yourdfpy.urdf").disabled
    assert capfd.readouterr() == ("", "")


def test_a_text_that_differs_in_numbers_alone_is_not_read_again(monkeypatch: pytest.MonkeyPatch) -> None:
    texts: list[str] = []
    load = yourdfpy.URDF.load

    def noting(file: Any, **options: Any) -> Any:
        texts.append(file.getvalue().decode())
        return load(file, **options)

    monkeypatch.setattr(yourdfpy.URDF, "load", noting)
    mass = '<link name="arm"><inertial><mass value="{}"/></inertial></link><joint name="k" type="fixed">'
    heavy, light = (
        URDF.replace("</robot>", f'{mass.format(kg)}<parent link="b"/><child link="arm"/></joint></robot>')
        for kg in ("1.5e1", "2")
    )
    numbered = [URDF.replace('"b"', f'"b{number}"') for number in (1, 2)]
    again = light.replace("fixed", "floating", 1)
    for text in (heavy, light, *numbered, again, heavy):
        assert "second-reader-differs" not in {found.code for found in read(text).diagnostics}
    assert texts == [heavy, *numbered, again]


# Where it reads


def test_a_plain_build_does_not_load_it() -> None:
    program = (
        "import sys; from urdfsync.urdf.domain import DOMAIN; from urdfsync.urdf.options import Options;"
        f"read = lambda given, **how: DOMAIN.read({URDF.encode()!r}, 'a.urdf', Options(cross_check=given), **how);"
        "assert read(None).snapshot and read(False, thorough=True).snapshot;"
        "assert not {'yourdfpy', 'numpy'} & sys.modules.keys();"
        "read(CHOICE, thorough=THOROUGH); assert 'yourdfpy' in sys.modules"
    )
    for choice, thorough in (("None", "True"), ("True", "False")):
        text = program.replace("CHOICE", choice).replace("THOROUGH", thorough)
        assert subprocess.run([sys.executable, "-c", text], check=False).returncode == 0


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.urdf").write_text(ODD)
    (tmp_path / "urdfsync.toml").write_text('[robots.a]\nsource = "a.urdf"\npackage = "A"\n')
    return tmp_path


def codes(robots: list[dict[str, Any]]) -> list[str]:
    return [found["code"] for robot in robots for found in robot["diagnostics"]]


@pytest.mark.parametrize(
    ("line", "reads"), [("", False), ("cross_check = false\n", False), ("cross_check = true\n", True)]
)
def test_builds_read_with_it_only_on_request(
    project: Path, line: str, reads: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    with (project / "urdfsync.toml").open("a") as file:
        file.write(line)
    assert cli.main(["build", "--json"]) == 0
    assert ("second-reader-failed" in codes(json.loads(capsys.readouterr().out)["robots"])) == reads


@pytest.mark.slow
@pytest.mark.parametrize("line", ["", "cross_check = false\n"])
def test_check_reads_with_it(project: Path, line: str, capfd: pytest.CaptureFixture[str]) -> None:
    with (project / "urdfsync.toml").open("a") as file:
        file.write(line)
    cli.main(["build", "--quiet"])
    (project / "modelica" / "A" / "A.mo").write_text("model A")  # with this, nothing is compiled
    capfd.readouterr()
    cli.main(["check", "--json"])
    assert ("second-reader-failed" in codes(json.loads(capfd.readouterr().out)["robots"])) == (not line)
