"""What a page tells of changes, edits and conflicts, since the last build or another version."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import pytest
from support.git import NEEDS_GIT, Repository
from support.pages import data_of, read

from urdfsync.commands import cli

Report = Callable[..., Path]


@pytest.mark.slow
def test_changes_edits_and_conflicts_are_told(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    numbers, wrist = Path("modelica/Arm/Links/ForearmParameters.mo"), Path("modelica/Arm/Links/Wrist.mo")
    numbers.write_text(numbers.read_text().replace("4.2", "4.35"))
    wrist.write_text(wrist.read_text().replace("equation\n", "  parameter Real mine = 3;\nequation\n", 1))
    arm.write_text(arm.read_text().replace('<mass value="4.2"/>', '<mass value="5.1"/>'))
    page = read(report())
    words = " ".join(page.words.split())
    assert re.search(r"inertial / mass ?4\.2 → 5\.1 kg ?\+21\.4 %", words)
    assert re.search(r"joint elbow gravity torque ?25\.\d+ N·m ?27\.\d+ N·m ?130 N·m", words)
    assert re.search(r"robot reach ?1\.49\d+ m", words)
    assert "you edited it, and its generated text changed too" in words
    assert "+ parameter Real mine = 3;" in words
    assert "- mass = 4.2," in words
    values = data_of(page)
    assert values["statuses"] == {"link forearm": "changed"}
    assert values["changes"] == {"link forearm": ["inertial / mass 4.2 → 5.1 kg (+21.4 %)"]}
    assert values["before"] is not None


@pytest.mark.slow
def test_nothing_changed_has_no_older_version(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    page = read(report())
    assert data_of(page)["before"] is None
    assert "nothing changed since the last build" in page.words
    assert re.search(r"Property ?Before ?Now ?Limit ?robot mass ?52\.345 kg", " ".join(page.words.split()))


@pytest.mark.slow
@NEEDS_GIT
def test_a_revision_is_the_older_version(arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(arm.parent, monkeypatch)
    repository.commit("first")
    arm.write_text(
        arm.read_text()
        .replace('<link name="grasp_point"', '<link name="grip"')
        .replace('link="grasp_point"', 'link="grip"')
        .replace('reference="grasp_point"', 'reference="grip"')
    )
    values = data_of(read(report("", "--against", "HEAD")))
    assert values["renamed"] == {"link grasp_point": "link grip"}
    assert values["statuses"] == {"link grip": "renamed"}
    assert values["against"] == "HEAD"


@pytest.mark.slow
@NEEDS_GIT
def test_a_page_against_a_revision_has_the_conflicts(
    arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    cli.main(["build", "--quiet"])
    Repository(arm.parent, monkeypatch).commit("first")
    numbers = Path("modelica/Arm/Links/ForearmParameters.mo")
    numbers.write_text(numbers.read_text().replace("4.2", "4.35"))
    arm.write_text(arm.read_text().replace('<mass value="4.2"/>', '<mass value="5.1"/>'))
    words = " ".join(read(report("", "--against", "HEAD")).words.split())
    assert "you edited it, and its generated text changed too: link forearm" in words
    assert "urdfsync resolve modelica/Arm/Links/ForearmParameters.mo --merge" in words
    assert "update" not in words.partition("What changed")[2].partition("In numbers")[0]


@pytest.mark.slow
def test_the_diagram_and_the_details_show_what_is_on_disk(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    numbers, robot = Path("modelica/Arm/Links/ForearmParameters.mo"), Path("modelica/Arm/Arm.mo")
    numbers.write_text(numbers.read_text().replace("mass = 4.2", "mass = 4.35"))
    sensor = "Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor imu"
    place = "annotation (Placement(transformation(extent={{220, -80}, {240, -60}})))"
    robot.write_text(
        robot.read_text()
        .replace("\nequation\n", f"\n  {sensor}\n    {place};\n\nequation\n  connect(imu.frame_a, wrist.frame_a);\n", 1)
        .replace("Joints.Elbow elbow(\n", "Joints.Elbow elbow(\n    phi_start = 0.1,\n", 1)
    )
    page = read(report())
    values = data_of(page)
    for diagram in (values["diagram"], drawn()):
        assert isinstance(diagram, str)
        assert ">4.35 kg<" in diagram
        assert ">imu<" in diagram
        assert ">differs from the source<" in diagram
        assert ">4.2 kg<" not in diagram
    assert values["edited"] == {
        "link forearm": [["inertial mass", "inertial.mass 4.2 → 4.35", "4.35"]],
        "joint elbow": [["phi_start", "phi_start added", "phi_start = 0.1"]],
    }
    words = " ".join(page.words.split())
    assert "drawn without your edits in Arm.mo" in words
    scene = cast(Any, values["now"])
    assert [body["mass"] for body in scene["bodies"] if body["element"] == "link forearm"] == [4.35]
    assert "These numbers are those of the source, without your edits." in words


@pytest.mark.slow
def test_nothing_edited_has_no_mark(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    page = read(report())
    values = data_of(page)
    assert values["edited"] == {}
    assert values["diagram"] == drawn()
    assert "source<" not in drawn()
    assert "without your edits" not in page.words


@pytest.mark.slow
def test_a_part_with_a_finding_is_marked(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    assert data_of(read(report()))["findings"] == {}
    arm.write_text(arm.read_text().replace('effort="280"', 'effort="0"'))
    findings: Any = data_of(read(report()))["findings"]
    words = "since this export: joint shoulder / limit has effort = 0: no drive moves it; another joint has 180"
    assert {name: [text[: len(words)] for text in texts] for name, texts in findings.items()} == {
        "joint shoulder": [words]
    }


@pytest.mark.slow
def test_in_a_conflict_the_diagram_shows_the_text_that_stays(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    numbers = Path("modelica/Arm/Links/ForearmParameters.mo")
    numbers.write_text(numbers.read_text().replace("mass = 4.2", "mass = 4.35"))
    arm.write_text(arm.read_text().replace('<mass value="4.2"/>', '<mass value="5.1"/>'))
    assert ">4.35 kg<" in str(data_of(read(report()))["diagram"])


def drawn() -> str:
    assert cli.main(["build", "--svg", "--quiet"]) == 0
    return Path(".urdfsync/svg/arm.svg").read_text("utf-8")
