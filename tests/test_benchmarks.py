"""The benchmarks: costs of processes, pairs measured in turn, and correct robots."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from benchmarks.measuring import UnexpectedError, measure
from benchmarks.robots import Source, chain, mesh, write_meshes, write_workspace, write_xacro_workspace

from urdfsync.commands import cli


@pytest.mark.parametrize("script", ["print('no')", "print('yes'); raise SystemExit(3)"])
def test_a_process_that_does_something_else_is_no_measurement(tmp_path: Path, script: str) -> None:
    with pytest.raises(UnexpectedError, match=r"exit code"):
        measure([sys.executable, "-c", script], tmp_path, "yes")


def test_a_workspace_is_built_without_findings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    place = write_workspace(tmp_path / "place", 1, 3, mesh)
    write_meshes(place, 3)
    monkeypatch.chdir(place)
    assert cli.main(["build"]) == 0
    told = capsys.readouterr()
    assert "files written" in told.out
    assert "warning" not in told.out + told.err
    assert len(list((place / "modelica/Robot0/Links").glob("*Parameters.mo"))) == 3


def test_a_robot_of_xacro_includes_its_links(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(write_xacro_workspace(tmp_path / "place", 3))
    assert cli.main(["build"]) == 0
    assert "files written" in capsys.readouterr().out
    (expanded,) = Path(".urdfsync/robots").glob("*.expanded")
    assert '"link2.xacro"' in expanded.read_text()


def test_each_edit_changes_the_first_mass_alone(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    file = tmp_path / "robot/arm.urdf"
    file.write_text(chain("arm", 2))
    source = Source(file)
    masses = [source.edit() for _ in range(3)]
    assert len(set(masses)) == 3
    assert file.read_text().replace(f'mass value="{masses[-1]}"', 'mass value="1"') == chain("arm", 2)
    assert list(file.parent.iterdir()) == [file]
