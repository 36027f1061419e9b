"""Comparing: the same answer from a plan and from two files, and nothing on a terminal that does not belong there."""

from __future__ import annotations

import itertools
import json
import shutil
from pathlib import Path

import pytest

from urdfsync.commands import cli

SPIRIT = "robomechanics+quad-sdk__quad_simulator_spirit_description_urdf_spirit.urdf"
BUILDS = {"create", "update", "delete"}


@pytest.fixture
def robot(folder: Path) -> Path:
    """The source of a configured robot, in the working folder; the file does not exist yet."""
    (folder / "urdfsync.toml").write_text('[robots.r]\nsource = "r.urdf"\npackage = "R"\n')
    return folder / "r.urdf"


def document(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    """What a comparison says of its robot."""
    capsys.readouterr()
    cli.main(["diff", "r.urdf", "--format=json", *arguments])
    (robot,) = json.loads(capsys.readouterr().out)["results"]
    files = sorted((a["path"], a["reason"]) for a in robot["result"]["actions"] if a["reason"] in BUILDS)
    changes = robot["result"]["changes"]
    return {"changes": changes, "effects": robot["effects"], "in_step": robot["in_step"], "files": files}


@pytest.mark.slow
def test_a_plan_and_two_files_give_the_same_answer(
    corpus: Path, robot: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    versions = sorted((corpus / "histories" / SPIRIT).glob("*.urdf"))
    for old, new in itertools.pairwise(versions):
        shutil.copy(old, robot)
        cli.main(["build", "--quiet"])
        shutil.copy(new, robot)
        planned = document(capsys)
        if planned["changes"] is None:
            planned["effects"] = []
        assert planned == document(capsys, "--against", str(old))


def test_names_can_not_move_the_cursor(
    robot: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("NO_COLOR", "1")
    old = robot.with_name("old.urdf")
    old.write_text('<robot name="r"><link name="a"/></robot>')
    name = "tip &#x9b;2J &#x202e;[bold]"
    joint = f'<joint name="j" type="fixed"><parent link="a"/><child link="{name}"/></joint>'
    robot.write_text(f'<robot name="r"><link name="a"/><link name="{name}"/>{joint}</robot>')
    assert cli.main(["diff", "r.urdf", "--against", "old.urdf"]) == 1
    said = capsys.readouterr().out
    assert r"link tip \x9b2J \u202e[bold]: added" in said
    assert all(line.isprintable() for line in said.splitlines())
