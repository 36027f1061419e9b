"""The cases of `--vary`: grids, samples, files; what is refused."""

from __future__ import annotations

import contextlib
import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often

from urdfsync.analysis.simulation.cases import Cases, Sampling, read_cases, read_spread
from urdfsync.common.diagnostics import UrdfsyncError

NUMBERS = st.floats(-1e6, 1e6)


def refused(*texts: str, count: int | None = None) -> str:
    with pytest.raises(UrdfsyncError) as caught:
        read_cases(texts, Sampling(count))
    return str(caught.value)


@often(50)
@given(st.lists(st.lists(NUMBERS, min_size=1, max_size=4), min_size=1, max_size=3))
def test_values_form_a_grid(columns: Sequence[Sequence[float]]) -> None:
    texts = [f"p{number}=[{','.join(map(repr, column))}]" for number, column in enumerate(columns)]
    found = read_cases(texts, Sampling())
    assert found.names == tuple(f"p{number}" for number in range(len(columns)))
    assert list(found.rows) == list(itertools.product(*columns))


@often(50)
@given(NUMBERS, NUMBERS, st.integers(2, 50))
def test_a_counted_range_has_both_bounds(first: float, second: float, count: int) -> None:
    lower, upper = sorted((first, second))
    values = [value for (value,) in read_cases([f"p={lower!r}..{upper!r}/{count}"], Sampling()).rows]
    assert (values[0], values[-1], len(values), values == sorted(values)) == (lower, upper, count, True)


@often(50)
@given(NUMBERS, NUMBERS, st.integers(1, 30), st.integers(0, 9), st.sampled_from(("latin", "random")))
def test_samples_are_inside_and_the_same_for_a_seed(
    first: float, second: float, count: int, seed: int, kind: str
) -> None:
    lower, upper = sorted((first, second))
    sampling = Sampling(count, seed, kind)  # type: ignore[arg-type]
    texts = [f"p={lower!r}..{upper!r}", f"q=uniform({lower!r}, {upper!r})", f"r=normal({lower!r},{upper - lower!r})"]
    found = read_cases(texts, sampling)
    assert len(found.rows) == count
    assert all(lower <= row[0] <= upper and lower <= row[1] <= upper and math.isfinite(row[2]) for row in found.rows)
    assert found == read_cases(texts, sampling)


@often(50)
@given(st.lists(NUMBERS, min_size=1, max_size=4))
def test_settings_have_all_digits(numbers: list[float]) -> None:
    found = Cases(tuple(f"p{place}" for place in range(len(numbers))), [tuple(numbers)])
    assert [float(text.partition("=")[2]) for text in found.settings(0)] == numbers


def test_a_latin_hypercube_has_a_sample_in_each_share() -> None:
    values = sorted(value for (value,) in read_cases(["p=0..20"], Sampling(20)).rows)
    assert [int(value) for value in values] == list(range(20))


def test_a_normal_distribution_has_its_mean_and_deviation() -> None:
    values = [value for (value,) in read_cases(["p=normal(5, 2)"], Sampling(1000)).rows]
    assert (np.mean(values), np.std(values)) == pytest.approx((5, 2), abs=0.02)


def test_each_point_of_a_grid_gets_the_same_samples() -> None:
    found = read_cases(["p=0..1", "q=[1,2]"], Sampling(3, seed=4))
    assert [row[1] for row in found.rows] == [1, 1, 1, 2, 2, 2]
    assert [row[0] for row in found.rows[:3]] == [row[0] for row in found.rows[3:]]


def test_a_file_has_a_row_for_each_case(tmp_path: Path) -> None:
    file = tmp_path / "cases,seed=4.csv"
    file.write_text("a.mass;b.phi_start\n1;0,5\n\n2;0,7\n")
    assert read_cases([str(file)], Sampling()) == Cases(("a.mass", "b.phi_start"), [(1.0, 0.5), (2.0, 0.7)])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("p=0.8..", "in `p=0.8..` a number is missing; write NAME=0.8..1.2"),
        ("p=..1", "a number is missing"),
        ("p=[]", "a number is missing"),
        ("p=[1,two]", "`two` in `p=[1,two]` is no number"),
        ("p=[1_0]", "`1_0` in `p=[1_0]` is no number"),
        ("p=0..inf", "`inf` in `p=0..inf` is no number"),
        ("p=2..1", "the lower bound is above the upper one"),
        ("p=uniform(2,1)", "the lower bound is above the upper one"),
        ("p=normal(1,-2)", "the negative standard deviation -2"),
        ("p=-1e308..1e308/3", "the distance of the bounds in `p=-1e308..1e308/3` is no finite number"),
        ("p=uniform(-1e308,1e308)", "give bounds nearer to each other"),
        ("p=normal(0,1e308)", "a sample of `p` is no finite number; give a smaller standard deviation"),
        ("p=normal(1)", "`normal(1)` is no distribution"),
        ("p=poisson(1,2)", "`poisson(1,2)` is no distribution"),
        ("p=0..1/1", "`1` in `p=0..1/1` is no number of values"),
        ("p=0..1/2000000", "is no number of values"),
        ("p=5", "`p=5` gives no values to vary"),
        ("axis[1]=0..1", "give the whole vector"),
        ("9p=0..1", "`9p` can't be a parameter"),
        ("nowhere.csv", "there is no file `nowhere.csv`"),
    ],
)
def test_a_faulty_description_is_refused(text: str, words: str) -> None:
    assert words in refused(text)


def test_contradictions_are_refused(tmp_path: Path) -> None:
    assert "`p` gets two values" in refused("p=0..1", "p=[1,2]")
    assert "no distribution is sampled" in refused("p=[1,2]", count=5)
    Path(tmp_path, "cases.csv").write_text("p\n1\n")
    assert "cases.csv` has the cases; leave `--cases` out" in refused(str(tmp_path / "cases.csv"), count=5)
    assert "these are 4000000 cases" in refused("p=0..1/2000", "q=0..1/2000")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1,2\n3,4\n", "cases.csv:1: error: in the header, `1` can't be a parameter"),
        ("a,a\n3,4\n", "cases.csv:1: error: in the header, `a` gets two values"),
        ("a,b\n3,4\n3\n", "cases.csv:3: error: the row has 1 cells, the header 2"),
        ("a,b\n3,4\n3,x\n", "cases.csv:3: error: `x` in `cases.csv` is no number"),
        ("a,b\n", "the file has no cases"),
        ("", "the file has no cases"),
    ],
)
def test_a_faulty_file_is_refused_with_its_line(
    text: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("cases.csv").write_text(text)
    assert words in refused("cases.csv")
    assert "must be the only `--vary`" in refused("cases.csv", "p=0..1")


@often(200)
@given(st.text(max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    with contextlib.suppress(UrdfsyncError):
        spread = read_spread(f"p={text}")
        assert all(map(math.isfinite, spread.numbers))
