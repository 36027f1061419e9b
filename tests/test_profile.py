"""`--profile`: where the time of a command went, and that nobody pays for it who does not ask."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import answers
from support.commands import Execute
from support.networks import ROBOT

from urdfsync import cli
from urdfsync.profiling import OTHER, STAGES

Capture = pytest.CaptureFixture[str]


def test_the_profile_of_programs_adds_up(project: Path, execute: Execute) -> None:
    found = execute("build", "--profile", "--json", code=None).json["profile"]
    names = [stage["stage"] for stage in found["stages"]]
    assert {"looking at files", *"imports reading artifacts rendering deciding recording writing".split()} <= set(names)
    assert names == [name for name in (*STAGES, OTHER) if name in names], "in the order of the flow"
    assert found["ms"] == pytest.approx(sum(stage["ms"] for stage in found["stages"]), abs=0.01)
    assert found["counts"]["rendered"] == 11


def test_what_was_measured_is_not_said_again_but_that_a_saved_answer_would_have_been(
    project: Path, capsys: Capture
) -> None:
    cli.main(["build"])
    answers.save("build")
    cli.main(["build", "--profile"])
    assert answers.saved("build", "--profile") is None
    assert "without --profile, the saved answer is printed" in capsys.readouterr().err


def test_robots_that_other_processes_plan_count(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").write_text("".join(ROBOT.format(f"n{number}", f"N{number}") for number in range(6)))
    document = execute("build", "--profile", "--json", "--jobs", "2").json
    elsewhere = {stage["stage"] for stage in document["profile"]["stages"] if stage["elsewhere_ms"] > 0}
    assert {"reading", "rendering"} <= elsewhere
    written = sum(action["action"] == "create" for robot in document["robots"] for action in robot["actions"])
    assert document["profile"]["counts"]["rendered"] <= written
    assert document["profile"]["counts"]["rendered"] > written / 2


def test_a_build_says_where_the_time_went(project: Path, execute: Execute) -> None:
    said = execute("build", "--profile")
    assert said.out.startswith("ladder: 14 files written\n")
    for words in ("looking at files", "rendering", "writing", "total", "11 rendered"):
        assert words in said.err
    assert "saved answer is printed" not in said.err.partition("total")[2], "there was none that could have answered"
