"""What a page tells of changes, edits and conflicts, since the last build or another version."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository
from support.pages import data_of, read

from urdfsync import cli

Report = Callable[..., Path]


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


def test_nothing_changed_has_no_older_version(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    page = read(report())
    assert data_of(page)["before"] is None
    assert "nothing changed since the last build" in page.words
    assert re.search(r"Property ?Before ?Now ?Limit ?robot mass ?52\.345 kg", " ".join(page.words.split()))


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
