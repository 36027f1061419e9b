"""Motions from CSV files: what is read, what is refused, and the spline that joins the rows."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.analysis.simulation.models import Input
from urdfsync.analysis.simulation.motion import MOST_ROWS, InputMotion, find_overshoots, read_motion, second_derivatives
from urdfsync.common.diagnostics import SourceError
from urdfsync.common.files import shown

INPUTS = [Input("elbow_phi", "rad"), Input("slide_s", "m"), Input("speeds[2]", "rad/s"), Input("wrist_tau", "N.m")]
HEADER = "time,elbow_phi,slide_s,speeds[2],wrist_tau"


def read(tmp_path: Path, text: str | bytes, inputs: Sequence[Input] = INPUTS) -> dict[str, tuple[float, ...]]:
    file = tmp_path / "motion.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    motion = read_motion(file, inputs)
    return {"time": motion.times, **{one.name: values for one, values in motion.values}}


def test_columns_are_found_by_name_and_units_are_converted(tmp_path: Path) -> None:
    text = (
        "time [ms], wrist_tau,speeds[2] [deg/s],slide_s [mm],elbow_phi [deg]\r\n0,1,180,5,90\r\n\r\n500,2,0,6,-90\r\n"
    )
    assert read(tmp_path, "\ufeff" + text) == {
        "time": (0.0, 0.5),
        "elbow_phi": (pytest.approx(math.pi / 2), pytest.approx(-math.pi / 2)),
        "slide_s": (pytest.approx(0.005), pytest.approx(0.006)),
        "speeds[2]": (pytest.approx(math.pi), 0.0),
        "wrist_tau": (1.0, 2.0),
    }


def test_a_european_table_of_inputs_has_semicolons_and_decimal_commas(tmp_path: Path) -> None:
    text = f"{HEADER.replace(',', ';')}\n0;0;0;0;0\n0,5;-1,25;1E-3;0,1;2\n"
    assert [values[1] for values in read(tmp_path, text).values()] == [0.5, -1.25, 0.001, 0.1, 2]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 0, "the file has no motion"),
        (f"{HEADER}\n0,0,0,0,0\n", 0, "the file has no motion"),
        ("elbow_phi,time\n0,0\n1,0\n", 1, "the first column is `elbow_phi`, not `time`"),
        ("time elbow_phi\n0 0\n1 0\n", 1, "name `time` first, then the inputs"),
        ("time;elbow_phi\n0;0\n1;0\n", 1, "columns are missing: slide_s, speeds[2], wrist_tau"),
        (f"{HEADER.replace(',', ';')}\n0;0;0;0;0\n0,5;1.5;0;0;0\n", 3, "`0,5` has a comma, but `1.5` in line 3"),
        ("time,elbow_phi\n0,0\n1,0\n", 1, "columns are missing: slide_s, speeds[2], wrist_tau"),
        (f"{HEADER},elbo_phi\n0,0,0,0,0,0\n1,0,0,0,0,0\n", 1, "no input `elbo_phi`; did you mean `elbow_phi`?"),
        (f"{HEADER},elbow_phi\n0,0,0,0,0,0\n1,0,0,0,0,0\n", 1, "`elbow_phi` is there twice"),
        (f"{HEADER.replace('elbow_phi', 'elbow_phi [mm]')}\n0,0,0,0,0\n1,0,0,0,0\n", 1, "give it in rad or deg"),
        (f"{HEADER}\n0,0,0,0,0\n1,0,0,0\n", 3, "the row has 4 cells, the header 5"),
        (f"{HEADER}\n0,0,0,0,0\n1,0,x,0,0\n", 3, "'x' is no number"),
        (f"{HEADER}\n0,0,0,0,0\n1,0,nan,0,0\n", 3, "'nan' is no number"),
        (f"{HEADER}\n0,0,0,0,0\n1,0,1_0,0,0\n", 3, "'1_0' is no number"),
        (f"{HEADER}\n0,0,0,0,0\n1,1e308,0,0,0\n", 3, "`elbow_phi` changes by 1e+308 within 1 s, which is too fast"),
        (f"{HEADER}\n0,0,0,0,0\n1e200,0,0,0,0\n", 3, "`time` changes by 1e+200 within 1e+200 s, which is too fast"),
        (f"{HEADER}\n0,0,0,0,0\n1e-300,0,1,0,0\n", 3, "give smaller numbers, or rows that are farther apart"),
        (f"{HEADER}\n0,0,0,0,0\n2,0,0,0,0\n1,0,0,0,0\n", 4, "the time does not increase: 2 s, then 1 s"),
        (f"{HEADER}\n0,0,0,0,0\n0,0,0,0,0\n", 3, "the time does not increase"),
        (f"{HEADER}\n1,0,0,0,0\n2,0,0,0,0\n", 2, "the time begins at 1 s"),
        (f"{HEADER}\n0,0,0,0,0\n1,\xe4,0,0,0\n".encode("latin-1"), 3, "not in UTF-8"),
        (f'{HEADER}\n0,0,0,0,0\n1,"0\n', 3, "the file is no CSV"),
        (f"{HEADER}\n" + "0,0,0,0,0\n" * (MOST_ROWS + 1), 0, "more than 10000 rows"),
    ],
)
def test_what_is_no_motion_is_refused_with_its_line(tmp_path: Path, text: str | bytes, line: int, words: str) -> None:
    with pytest.raises(SourceError) as caught:
        read(tmp_path, text)
    (found,) = caught.value.diagnostics
    assert words in str(found)
    assert found.line == line
    assert found.file == shown(tmp_path / "motion.csv")


@pytest.mark.skipif(sys.platform == "win32", reason="no such files there")
@pytest.mark.parametrize("kind", ["pipe", "device", "folder", "large"])
def test_only_a_regular_file_of_limited_size_is_a_motion(kind: str, tmp_path: Path) -> None:
    """A pipe would wait for ever, and `/dev/zero` has no end."""
    file = tmp_path / "motion.csv"
    match kind:
        case "pipe":
            os.mkfifo(file)
        case "device":
            file.symlink_to("/dev/zero")
        case "folder":
            file.mkdir()
        case "large":
            with file.open("wb") as stream:
                stream.truncate(2**40)
    with pytest.raises(SourceError, match=r"motion\.csv: error: the file can't be read: .*; name a CSV file"):
        read_motion(file, INPUTS)


def test_a_model_without_inputs_follows_no_motion(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="the model has no inputs that a motion could drive; leave `--input` out"):
        read(tmp_path, "time\n0\n1\n", ())


numbers = st.floats(-10, 10)


@given(st.lists(st.floats(0.1, 2), min_size=3, max_size=30), st.lists(numbers, min_size=4, max_size=4))
def test_the_spline_through_a_cubic_is_that_cubic(steps: list[float], factors: list[float]) -> None:
    times = np.cumsum([0.0, *steps])
    a, b, c, d = factors
    values = a + b * times + c * times**2 + d * times**3
    size = 1 + max(map(abs, values))
    found = second_derivatives(times.tolist(), values.tolist())
    assert np.allclose(found, 2 * c + 6 * d * times, atol=1e-7 * size)


def test_few_points_make_a_line_and_a_parabola() -> None:
    assert second_derivatives([0.0, 2.0], [1.0, 5.0]) == [0.0, 0.0]
    assert second_derivatives([0.0, 1.0, 3.0], [0.0, 1.0, 9.0]) == pytest.approx([2.0, 2.0, 2.0])


def test_a_spline_that_leaves_its_rows_is_told_with_its_number() -> None:
    """Rows at uneven times: the joint shall turn to 90° and stay, and the spline goes far beyond."""
    turn = (0.0, 0.0, math.pi / 2, math.pi / 2)
    uneven = InputMotion((0.0, 2.0, 2.2, 4.0), ((INPUTS[0], turn), (INPUTS[3], turn)))
    (found,) = find_overshoots(uneven, Path("m.csv"))
    assert found.message == "`elbow_phi` reaches -5.963 rad (-341.7°) at 0.8498 s, and the rows around have 0 and 0"
    times = tuple(number / 8 for number in range(17))
    sine = tuple(math.sin(2 * math.pi * time) for time in times)
    assert not list(find_overshoots(InputMotion(times, ((INPUTS[0], sine),)), Path("m.csv")))
    assert not list(find_overshoots(InputMotion((0.0, 1.0), ((INPUTS[0], turn[1:3]),)), Path("m.csv")))
