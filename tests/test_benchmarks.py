"""The benchmarks: costs of processes, pairs taken in turn, and robots that are as they should be."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from benchmarks.measuring import Cost, Measurement, Pair, Reading, UnexpectedError, compare, measure
from benchmarks.published import Published
from benchmarks.robots import Source, chain, mesh, write_meshes, write_workspace

from urdfsync import cli

RATIO = Reading(lambda mine, other: mine.wall / other.wall, 2.0)


def counted(walls: list[float], calls: list[str], name: str) -> Measurement:
    """A measurement that gives these times in turn, and notes its name."""
    costs = iter(walls)

    def take() -> Cost:
        calls.append(name)
        return Cost(next(costs))

    return take


@pytest.mark.parametrize("is_slow", [False, True])
def test_a_pair_is_measured_in_turn(is_slow: bool) -> None:
    """Each round takes both once; a round to warm up is not counted, and left out of slow pairs."""
    calls: list[str] = []
    warm = [] if is_slow else [100.0]
    mine, other = counted([*warm, 1, 6, 40], calls, "mine"), counted([*warm, 1, 2, 20], calls, "other")
    result = compare(Pair("a", mine, "b", other, [RATIO], is_slow), 3)
    assert result.values == [[1, 3, 2]]  # the ratio of each round, not of the medians
    assert (result.mine.wall, result.other.wall) == (6, 2)
    rounds = [calls[number : number + 2] for number in range(0, len(calls), 2)]
    assert all(sorted(names) == ["mine", "other"] for names in rounds)


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


def test_each_edit_changes_the_first_mass_alone(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    file = tmp_path / "robot/arm.urdf"
    file.write_text(chain("arm", 2))
    source = Source(file)
    masses = [source.edit() for _ in range(3)]
    assert len(set(masses)) == 3
    assert file.read_text().replace(f'mass value="{masses[-1]}"', 'mass value="1"') == chain("arm", 2)
    assert list(file.parent.iterdir()) == [file]


def test_a_published_tool_that_cannot_run_says_why(tmp_path: Path) -> None:
    assert "there is no" in str(Published(sys.executable, tmp_path / "urdf_to_package.py").missing())
    (tmp_path / "urdf_to_package.py").touch()
    assert "no package urdf_parser_py" in str(Published("false", tmp_path / "urdf_to_package.py").missing())
