"""What the benchmarks reckon with: costs of processes, readings of pairs, tables, robots that are built."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from benchmarks import published, tables
from benchmarks.builds import clear
from benchmarks.measuring import Cost, Quantity, UnexpectedError, measure
from benchmarks.robots import MASS, Source, chain, mesh, write_meshes, write_workspace
from benchmarks.study import Figures, Finding, Row, Study, find, growth, measured, scaled
from hypothesis import given
from hypothesis import strategies as st

from urdfsync import cli

BURN = "import time\nwhile time.process_time() < 0.1: pass"
ROW = Row("ours", "theirs", 2.0)


def rounds_of(*pairs: tuple[float, float]) -> list[dict[str, Cost]]:
    return [{"ours": Cost(mine), "theirs": Cost(other)} for mine, other in pairs]


def found(row: Row, *pairs: tuple[float, float]) -> Finding:
    finding = find(row, rounds_of(*pairs))
    assert finding is not None
    return finding


def test_a_ratio_is_the_median_of_those_of_the_rounds() -> None:
    finding = found(ROW, (1, 1), (6, 2), (40, 20))  # the ratio of the medians is 3
    assert (finding.reading.least, finding.reading.median, finding.reading.most) == (1, 2, 3)
    assert (finding.mine.median, finding.other.median, finding.pairs) == (6000, 2000, 3)


@pytest.mark.parametrize(("mine", "met"), [(1.9, True), (2, True), (2.1, False)])
def test_a_bar_is_met_up_to_itself(mine: float, met: bool) -> None:
    assert found(ROW, (mine, 1)).met is met


def test_what_is_only_told_has_no_bar() -> None:
    assert found(Row("ours", "theirs"), (1, 2)).met is None


def test_only_rounds_with_both_count() -> None:
    finding = find(ROW, [*rounds_of((1, 2)), {"ours": Cost(9)}])
    assert finding is not None
    assert (finding.pairs, finding.mine.most) == (1, 1000)
    assert find(ROW, [{"ours": Cost(9)}]) is None


@given(st.floats(0.1, 3), st.floats(0.01, 100), st.floats(2, 100))
def test_an_exponent_is_that_of_a_power(exponent: float, unit: float, factor: float) -> None:
    row = Row("ours", "theirs", reading=growth(factor))
    assert found(row, (unit * factor**exponent, unit)).reading.median == pytest.approx(exponent)


def test_milliseconds_are_scaled_by_what_the_other_takes() -> None:
    assert found(Row("ours", "theirs", reading=scaled(12)), (0.020, 0.030)).reading.median == pytest.approx(8)


def test_a_quantity_is_told_in_its_unit() -> None:
    cost = Cost(1.5, 0.25, 7e6, 3e6)
    assert [cost.of(quantity) for quantity in Quantity] == [1500, 250, 7, 3]


def test_every_round_measures_everything_once_after_one_that_does_not_count() -> None:
    calls: list[str] = []

    def measurement(label: str) -> Callable[[], Cost]:
        def measure_it() -> Cost:
            calls.append(label)
            return Cost(len(calls))

        return measure_it

    rows = [Row("b", "a"), Row("c", "a"), Row("d", "a"), Row("f", "e"), Row("b", "absent")]
    study = Study("study", {label: measurement(label) for label in "abcdef"}, rows, slow="f")
    rounds = measured(study, 4, 2, lambda text: None)
    assert [set(one) for one in rounds] == [set("abcdef")] * 2 + [set("abcd")] * 2
    assert set(calls[:5]) == set("abcde")
    assert [cost.wall for cost in rounds[0].values()] == [6, 7, 8, 9, 10, 11]
    orders = {tuple(label for label in one if label in "abcd") for one in rounds}
    assert len(orders) > 1


def test_tables_tell_what_is_not_met() -> None:
    row = Row("many", "few", 1.1, Quantity.CPU, growth(10))
    costs = [{"many": Cost(0, 20), "few": Cost(0, 1)}]
    finding = find(row, costs)
    assert finding is not None
    grid = tables.pairs("growth", [finding])
    lines = tables.markdown(grid).splitlines()
    assert lines[-1] == (
        "| many, CPU time | few | 1.1 | **1.3 exponent** | 1.3 to 1.3 "
        "| 20,000 ms (20,000 to 20,000) | 1,000 ms (1,000 to 1,000) | 1 |"
    )
    assert {line.count("|") for line in lines[2:]} == {9}
    assert tables.table(grid).row_count == 1


def test_the_last_table_has_what_has_a_bar() -> None:
    told, wanted = found(Row("ours", "theirs"), (1, 1)), found(ROW, (1, 1))
    grid = tables.bars([("one", told), ("two", wanted)])
    assert tables.markdown(grid).splitlines()[-1] == "| two: ours | theirs | 2 | 1 | 1 |"


def test_numbers_without_a_comparison_have_a_table_too() -> None:
    grid = tables.figures(Figures("daemon", [("memory", "7 MB")]))
    assert tables.markdown(grid).splitlines()[-1] == "| memory | 7 MB |"


def test_a_process_costs_what_it_started_costs_too(tmp_path: Path) -> None:
    alone = measure([sys.executable, "-S", "-c", "print('done')"], tmp_path, "done")
    large = measure([sys.executable, "-S", "-c", f"x = bytes(range(256)) * 400_000\n{BURN}"], tmp_path)
    assert 0 < alone.peak < 100e6 < large.peak
    assert large.cpu >= 0.1
    assert large.wall >= 0.1
    orphan = measure(["sh", "-c", f'"{sys.executable}" -S -c "{BURN}" & exit 0'], tmp_path)
    assert orphan.crew > 0 or sys.platform != "linux"
    assert orphan.cpu >= 0.1 or sys.platform != "linux"


@pytest.mark.parametrize("program", ["import sys; sys.exit(3)", "print('rebuilt')"])
def test_what_does_not_do_what_it_should_is_no_measurement(tmp_path: Path, program: str) -> None:
    with pytest.raises(UnexpectedError, match=r"exit code 3|does not say"):
        measure([sys.executable, "-S", "-c", program], tmp_path, "in step")


def test_workspaces_are_built_without_a_finding(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    place = write_workspace(tmp_path / "two", 2, 3)
    monkeypatch.chdir(place)
    assert cli.main(["build", "--verbose"]) == 0
    said = capsys.readouterr()
    assert "warning" not in said.out + said.err
    mass = Source(place / "robot0.urdf").edit()
    assert cli.main(["build"]) == 0
    assert f"mass = {mass}," in (place / "modelica/Robot0/Links/Link0Parameters.mo").read_text()
    clear(place)
    assert {path.name for path in place.iterdir()} == {"urdfsync.toml", "robot0.urdf", "robot1.urdf"}


def test_a_mass_is_another_one_after_each_edit(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    file = tmp_path / "robot" / "arm.urdf"
    file.write_text(chain("arm", 2))
    source = Source(file)
    masses = [source.edit() for _ in range(3)]
    assert len(set(masses)) == 3
    text = file.read_text()
    assert text.replace(f'{MASS}{masses[-1]}"', f'{MASS}1"') == chain("arm", 2)
    assert [path.name for path in file.parent.iterdir()] == ["arm.urdf"]


def test_meshes_are_those_that_the_links_name(tmp_path: Path) -> None:
    write_meshes(tmp_path, 2)
    files = sorted(tmp_path.iterdir())
    assert [mesh(number) for number in range(2)] == [f'<mesh filename="{file.name}"/>' for file in files]
    assert [file.stat().st_size for file in files] == [50_084, 50_084]
    assert files[0].read_bytes() != files[1].read_bytes()


def test_a_tool_that_is_not_there_is_left_out_in_so_many_words(tmp_path: Path) -> None:
    said: list[str] = []
    assert published.find(None, sys.executable, said.append) is None
    assert published.find(tmp_path, sys.executable, said.append) is None
    (tmp_path / "urdf_to_package.py").touch()
    assert published.find(tmp_path, "false", said.append) is None
    assert [text.partition(": ")[0] for text in said] == ["the published tool is left out"] * 3
    assert len(set(said)) == 3
