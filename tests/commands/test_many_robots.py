"""Commands about many robots count those with nothing to tell."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from support.commands import Execute
from support.urdfs import joint, link, robot

from urdfsync.common import noop

COUNTED = ["12 robots: in step"]
REPEATED = ["2 robots: still 2 findings; --verbose shows them"]


def write(name: str, mass: float = 1.0, axis: str = "0 0 1") -> None:
    text = robot(link("base", 1.0), link("tip", mass), joint("elbow", "revolute", "base", "tip", axis=axis))
    Path(f"{name}.urdf").write_text(text)


@pytest.fixture(autouse=True)
def built(folder: Path, execute: Execute) -> Path:
    """A project of twelve robots; two of them have a finding."""
    names = [f"r{number}" for number in range(12)]
    for name in names:
        write(name, axis="0 0 2" if name in ("r3", "r4") else "0 0 1")
    execute("init", *(f"{name}.urdf" for name in names))
    assert execute("build").out.count("files written") == 12, "a robot that was built has its line"
    return folder


def test_robots_in_step_and_known_findings_are_counted(execute: Execute) -> None:
    for command in ("build", "status"):
        done = execute(command)
        assert (done.lines, done.errors) == (COUNTED, REPEATED)
    assert execute("diff").lines == ["12 robots: nothing changed since the last build"]
    assert execute("diff", "--edits").lines == ["12 robots: nothing is edited"]
    assert execute("build", "--quiet").out == ""


def test_an_event_is_told_in_full_beside_them(execute: Execute) -> None:
    write("r7", mass=2.0)
    lines = execute("status", code=1).lines
    assert lines[0] == "r7: out of step: 1 file to write"
    assert lines[-1] == "11 robots: in step"
    lines = execute("build").lines
    assert lines[0].startswith("r7: 1 file written")
    assert lines[-1] == "11 robots: in step"


def test_few_named_robots_and_verbose_output_have_a_line_each(execute: Execute) -> None:
    assert execute("build", "r1", "r3").lines == ["r1: in step, 15 files", "r3: in step, 15 files"]
    assert len(execute("build", "--verbose").lines) == 12
    assert len(execute("build", "--format=json").json["results"]) == 12


@pytest.mark.slow
def test_a_build_answered_from_records_says_the_same(execute: Execute, capsys: pytest.CaptureFixture[str]) -> None:
    time.sleep(2.1)  # files of the last two seconds are read
    execute("build")
    assert noop.answer(["build"]) == ""
    printed = capsys.readouterr()
    assert (printed.out.splitlines(), printed.err.splitlines()) == (COUNTED, REPEATED)
