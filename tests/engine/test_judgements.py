"""What an export broke is told first, as new; what was so before only waits for --verbose."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.urdfs import joint, limit, link, robot

from urdfsync.commands import cli

CONFIG = '[robots.pair]\nsource = "pair.urdf"\npackage = "Pair"\n'


def pair(left: float, right: float, effort: float = 20.0, names: tuple[str, str] = ("left_hip", "right_hip")) -> str:
    """A robot with a left and a right hip of some masses, whose driven elbow has another effort."""
    elements = [link("base", 5.0), link("arm", 1.0), joint("elbow", "revolute", "base", "arm", xyz="0 0 0.4",
                                                           inside=[limit(effort=effort)])]  # fmt: skip
    for name, mass, y in zip(names, (left, right), (0.1, -0.1), strict=True):
        inertia = '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>'
        elements += [f'<link name="{name}"><inertial><mass value="{mass}"/>{inertia}</inertial></link>']
        elements += [joint(f"{name}_j", "revolute", "base", name, xyz=f"0 {y} 0", rpy="0 0 0", inside=[limit()])]
    return robot(*elements)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("urdfsync.toml").write_text(CONFIG)
    return tmp_path / "pair.urdf"


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """The findings of a command: place, severity, and the words up to the first colon or number."""
    capsys.readouterr()
    cli.main([*arguments])
    return [line.partition(": ")[2] for line in capsys.readouterr().err.splitlines() if ": warning: " in line]


OLD = "warning: joint elbow / limit has effort = 0: no drive moves it"
NEW = "warning: since this export: link 'right_hip' is no mirror image of 'left_hip': its mass is 9 kg, that of the"


def heads(lines: list[str], *expected: str) -> bool:
    return len(lines) == len(expected) and all(map(str.startswith, lines, expected))


def test_the_first_build_has_nothing_new(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 2, effort=0))
    assert heads(told(capsys, "build"), OLD)


def test_a_new_judgement_is_told_first_and_an_old_one_waits(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 2, effort=0))
    cli.main(["build"])
    project.write_text(pair(2, 9, effort=0))
    assert heads(told(capsys, "diff"), NEW), "what the last build told is counted"
    assert heads(told(capsys, "build", "--verbose", "--dry-run"), NEW, OLD)
    assert heads(told(capsys, "build"), NEW)
    assert told(capsys, "build") == []
    assert heads(told(capsys, "build", "--verbose"), OLD, NEW.replace("since this export: ", ""))


def test_the_side_that_the_export_changed_is_told(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 2))
    cli.main(["build"])
    project.write_text(pair(9, 2))
    assert heads(told(capsys, "build"), "warning: since this export: link 'left_hip' is no mirror image of 'right_hip'")


def test_an_old_difference_hides_no_new_one(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 9))
    cli.main(["build"])
    moved = '<link name="right_hip"><inertial><origin xyz="0 0 0.1"/>'
    project.write_text(pair(2, 9).replace('<link name="right_hip"><inertial>', moved))
    assert heads(
        told(capsys, "build"), "warning: since this export: link 'right_hip' is no mirror image of 'left_hip': the"
    )


def test_a_renamed_part_keeps_its_old_judgement(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 9))
    cli.main(["build"])
    project.write_text(pair(2, 9, names=("left_thigh", "right_thigh")))
    assert not any("since" in line for line in told(capsys, "build", "--verbose"))


def test_two_files_are_compared_like_two_exports(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 9, effort=0))
    Path("old.urdf").write_text(pair(2, 2, effort=0))
    assert heads(told(capsys, "diff", "pair.urdf", "--against", "old.urdf"), NEW)


def test_documents_name_the_element(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 2, effort=0))
    cli.main(["build"])
    project.write_text(pair(2, 9, effort=0))
    capsys.readouterr()
    cli.main(["build", "--check", "--format", "json"])
    findings = json.loads(capsys.readouterr().out)["results"][0]["diagnostics"]
    assert [(one["code"], one["element"], one["is_new"]) for one in findings] == [
        ("not-mirrored", "link right_hip / inertial", True),
        ("zero-effort", "joint elbow / limit", False),
    ]
    cli.main(["build", "--check", "--format", "sarif"])
    (run,) = json.loads(capsys.readouterr().out)["runs"]
    assert [result["ruleId"] for result in run["results"]] == ["not-mirrored", "zero-effort", "out-of-step"]


@pytest.mark.slow
@pytest.mark.usefixtures("modelica_library")
def test_a_strict_check_passes_no_judgement(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project.write_text(pair(2, 9))
    cli.main(["build", "--quiet"])
    assert cli.main(["check"]) == 0
    assert cli.main(["check", "--strict"]) == 1, "the result of the first check is remembered, the judgement is not"
    streams = capsys.readouterr()
    assert "\npair: differs: " in streams.out
    assert "is no mirror image of 'left_hip'" in streams.err
    Path("urdfsync.toml").write_text(f'{CONFIG}ignore = ["not-mirrored"]\n')
    assert cli.main(["check", "--strict"]) == 0
