"""Logs as users have them: names, units, gaps, resets, faults, and millions of rows."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from support import measured
from support.commands import Execute

from urdfsync.analysis.identification.log import Log
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.common.diagnostics import ConfigError, SourceError
from urdfsync.domain.regressor import Axis

ELBOW = Axis("elbow", "elbow", "rad", 0.0, (-1.5, 1.5), 3.0, 20.0, 50.0, "position", "elbow_phi")
SLIDE = Axis("slide-1", "slide_1", "m", 0.2, (0.0, 0.5), 1.0, 90.0, 1.0, "position", "slide_1_s")


def write(header: str, rows: int = 100, factor: float = 1.0, step: float = 0.01) -> Path:
    """A log of the elbow: times, positions, efforts."""
    times = step * np.arange(rows)
    table = np.column_stack([times, factor * np.sin(times), 10 * np.cos(times)])
    np.savetxt("log.csv", table, "%.9g", ",", header=header, comments="")
    return Path("log.csv")


def read(file: Path, *columns: str, motor_side: bool = False) -> Log:
    return Log(file, [ELBOW, SLIDE], IdentifyOptions(columns=columns, motor_side=motor_side))


@pytest.mark.parametrize(
    "header",
    [
        "time,elbow.position,elbow.effort",
        "t,elbow_phi,elbow_tau",
        "timestamp [s],position/elbow,effort/elbow",
        "time,/joint_states/elbow/position,/joint_states/elbow/effort",
        "time [s],robot.elbow.q [rad],robot.elbow.torque [N.m]",
    ],
)
def test_names_that_are_understood(folder: Path, header: str) -> None:
    log = read(write(header))
    (piece,) = log.pieces()
    assert log.measured == [0]
    assert piece.position[50].tolist() == pytest.approx([np.sin(0.5), 0.2]), "a joint without a column rests"
    assert piece.effort[50, 0] == pytest.approx(10 * np.cos(0.5))
    assert log.told() == ("not in the log, taken to rest at the start: slide-1",)


def test_other_names_by_a_mapping(folder: Path) -> None:
    log = read(write("time,enc0,cur0"), "elbow.position=enc0", "elbow.effort=cur0*2.5")
    (piece,) = log.pieces()
    assert piece.effort[0, 0] == pytest.approx(25)


@pytest.mark.parametrize("factor", ["nan", "inf", "0"])
def test_a_factor_that_leaves_no_effort(folder: Path, factor: str) -> None:
    with pytest.raises(ConfigError, match="the factor has to be finite, and not 0"):
        read(write("time,enc0,cur0"), "elbow.position=enc0", f"elbow.effort=cur0*{factor}")


def test_other_names_without_a_mapping(folder: Path) -> None:
    """The error lists both the joints and the columns."""
    with pytest.raises(SourceError, match="the columns are time, enc0, cur0"):
        read(write("time,enc0,cur0"))
    with pytest.raises(SourceError, match="the joints are elbow, slide-1: name the columns"):
        read(write("time,enc0,cur0"))


def test_joints_whose_names_differ_by_a_separator(folder: Path) -> None:
    """Exact names come first; what may be both is refused, unless the user chooses."""
    axes = [ELBOW._replace(name="j1_1", component="j1_1"), ELBOW._replace(name="j11", component="j11")]
    file = write("time,j1_1.position,j1_1.effort")
    assert Log(file, axes, IdentifyOptions()).measured == [0]
    file = write("time,J1-1 q,j11/tau")
    assert [*Log(file, axes, IdentifyOptions(columns=("j1_1.effort=j11/tau",))).columns] == [
        (0, "position"),
        (0, "effort"),
    ]
    file = write("time,j 11 q,j11.effort")
    with pytest.raises(SourceError, match="`j 11 q` may be the position of j1_1 or the position of j11"):
        Log(file, axes, IdentifyOptions())
    assert Log(file, axes, IdentifyOptions(columns=("j11.position=j 11 q",))).measured == [1]


def test_units(folder: Path) -> None:
    (piece,) = read(write("time [ms],elbow.position [deg],elbow.effort", 100, 57.3, 10.0)).pieces()
    assert piece.times[-1] == pytest.approx(0.99)
    assert np.ptp(piece.position[:, 0]) < 2.1


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (80, "these look like degrees"),
        (60, "its motor would, by a gear of 50; give `--motor-side`"),
    ],
)
def test_wrong_units_are_told_by_the_limits(folder: Path, factor: float, words: str) -> None:
    axis = ELBOW if "motor" in words else ELBOW._replace(reduction=1.0)
    file = write("time,elbow.position,elbow.effort", 600, factor)
    with pytest.raises(SourceError, match=words):
        list(Log(file, [axis], IdentifyOptions()).pieces())


def test_the_motors_side(folder: Path) -> None:
    (piece,) = read(write("time,elbow.position,elbow.effort", 600, 60), motor_side=True).pieces()
    assert np.abs(piece.position[:, 0]).max() == pytest.approx(60 / 50, rel=0.01)
    assert piece.effort[0, 0] == pytest.approx(500)


def test_the_motors_side_without_a_gear(folder: Path) -> None:
    file, direct = write("time,elbow.position,elbow.effort", 600, 80), ELBOW._replace(reduction=1.0)
    with pytest.raises(ConfigError, match="`--motor-side` needs gears"):
        Log(file, [direct, SLIDE], IdentifyOptions(motor_side=True))
    geared = SLIDE._replace(reduction=3.0)
    options = IdentifyOptions(motor_side=True, columns=("slide-1.effort=elbow.effort", "elbow.effort=elbow.effort"))
    with pytest.raises(SourceError, match="these look like degrees"):
        list(Log(file, [direct, geared], options).pieces())


@pytest.mark.parametrize(
    "header", ["time,elbow.position [rad],elbow.effort [N.m]", "time,robot.elbow.revolute.phi,robot.elbowAxis.tau"]
)
def test_a_stated_unit_is_believed(folder: Path, header: str) -> None:
    """The columns of `simulate --csv` have their units, too; positions beyond the limits are a warning."""
    log = read(write(header, 600, 60))
    (piece,) = log.pieces()
    assert np.abs(piece.position[:, 0]).max() == pytest.approx(60, rel=0.01)
    (warning,) = log.doubts()
    assert "joint elbow: position passes its limits, -1.5 … 1.5 rad" in warning.message
    (piece,) = read(write("time,enc [deg],cur", 100, 57.3), "elbow.position=enc [deg]", "elbow.effort=cur*2").pieces()
    assert np.ptp(piece.position[:, 0]) < 1


def test_a_little_beyond_the_limits_is_a_warning(folder: Path) -> None:
    log = read(write("time,elbow.position,elbow.effort", 600, 2))
    (piece,) = log.pieces()
    assert np.abs(piece.position[:, 0]).max() == pytest.approx(2, rel=0.01)
    assert [warning.code for warning in log.doubts()] == ["limit-passed"]


@pytest.mark.parametrize(("step", "unit"), [(2.0, "ms"), (2e3, "us"), (2e6, "ns")])
def test_times_in_another_unit_are_told_by_their_steps(folder: Path, step: float, unit: str) -> None:
    with pytest.raises(SourceError, match=rf"too few for a motion; write `time \[{unit}\]`"):
        list(read(write("time,elbow.position,elbow.effort", 200, 0.1, step)).pieces())


def test_gaps_resets_and_empty_cells_are_told(folder: Path) -> None:
    lines = write("time,elbow.position,elbow.effort", 400).read_text().splitlines()
    lines[61] = lines[61].rpartition(",")[0] + ","  # an empty cell
    lines.insert(80, lines[79])
    del lines[150:180]
    Path("log.csv").write_text("\n".join([*lines, *lines[1:100]]) + "\n")
    log = read(Path("log.csv"))
    assert [len(piece.times) for piece in log.pieces()] == [147, 222, 97]
    assert log.told()[:4] == (
        "2 rows without a number",
        "2 rows with the time of the row before",
        "1 reset of the time",
        "1 gap",
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,elbow.position,elbow.effort\n0,1,x\n", "2: error: a cell is no number: 'x'"),
        ("time,elbow.position,elbow.effort\n0,1,2\n0,1\n", "3: error: the row has 2 cells, the header 3"),
        ("elbow.position,elbow.effort\n0,1\n", "no column is the time"),
        ("time,elbow.position [kg],elbow.effort\n0,1,2\n", "can't be read in kg"),
        ("time,elbow.q,elbow.phi,elbow.effort\n0,1,2,3\n", "two columns give the position of elbow"),
        ("", "no column is the time"),
        ("time,elbow.position\n0,1\n", "no joint has a position and an effort"),
    ],
)
def test_faults_name_their_place(folder: Path, text: str, words: str) -> None:
    Path("log.csv").write_text(text)
    with pytest.raises(SourceError) as error:
        list(read(Path("log.csv")).pieces())
    assert words in str(error.value)


def test_files_that_are_no_log(folder: Path) -> None:
    Path("image.csv").write_bytes(b"\x89PNG\xff\xfe")
    for name, words in (("missing.csv", "there is no such file"), (".", "a folder is there"), ("image.csv", "no text")):
        with pytest.raises(SourceError, match=words):
            read(Path(name))


def test_rows_that_are_not_sorted(folder: Path) -> None:
    head, *rows = write("time,elbow.position,elbow.effort", 3000).read_text().splitlines()
    mixed = np.random.default_rng(0).permutation(rows)
    Path("log.csv").write_text("\n".join([head, *mixed]) + "\n")
    with pytest.raises(SourceError, match=r"times are not sorted: 1[45]\d\d of 3000 rows"):
        list(read(Path("log.csv")).pieces())


def test_semicolons_and_decimal_commas(folder: Path) -> None:
    text = write("time,elbow.position,elbow.effort").read_text()
    Path("log.csv").write_text(text.replace(",", ";").replace(".", ",").replace("elbow,", "elbow."))
    (piece,) = read(Path("log.csv")).pieces()
    assert piece.position[50, 0] == pytest.approx(np.sin(0.5))


def test_parquet_is_the_same(folder: Path) -> None:
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    table = np.loadtxt(write("time,elbow.position,elbow.effort", 300), delimiter=",", skiprows=1)
    names = ["time", "elbow.position", "elbow.effort"]
    parquet.write_table(pyarrow.table(dict(zip(names, table.T, strict=True))), "log.parquet")
    (one,), (other,) = (list(read(Path(name)).pieces()) for name in ("log.csv", "log.parquet"))
    assert one.position.tolist() == other.position.tolist()
    assert one.effort.tolist() == other.effort.tolist()
    stamps = pyarrow.array(np.datetime64("2026-01-01", "us") + (1e6 * table[:, 0]).astype(int))
    parquet.write_table(
        pyarrow.table([stamps, *map(pyarrow.array, table.T[1:])], ["time [ms]", *names[1:]]), "stamps.parquet"
    )
    (stamped,) = read(Path("stamps.parquet")).pieces()
    assert (stamped.times - stamped.times[0]).tolist() == pytest.approx(one.times.tolist(), abs=2e-6)
    content = bytearray(Path("log.parquet").read_bytes())
    content[4:400] = bytes(396)
    Path("spoiled.parquet").write_bytes(content)
    with pytest.raises(SourceError, match="the file can't be read"):
        list(read(Path("spoiled.parquet")).pieces())
    Path("bad.parquet").write_bytes(b"PAR1")
    with pytest.raises(SourceError, match="the file can't be read"):
        read(Path("bad.parquet"))


@pytest.mark.slow
def test_the_memory_does_not_grow_with_the_log(folder: Path) -> None:
    """A million rows take as much as two pieces."""
    peaks = []
    for rows in (100_000, 1_000_000):
        file = write("time,elbow.position,elbow.effort", rows)
        tracemalloc.start()
        count = sum(len(piece.times) for piece in read(file).pieces())
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert count == rows
    assert peaks[1] < 1.3 * peaks[0]


@pytest.mark.slow
def test_noise_of_a_log_is_no_error(gripper: Path, execute: Execute, recording: measured.Recording) -> None:
    """Saturated efforts and extra columns are told, and the rest is used."""
    cut = recording._replace(efforts=np.clip(recording.efforts, -0.12, 0.12))
    cut.write(Path("cut.csv"), header="time,{}")
    printed = execute("identify", "gripper", "cut.csv", "--joint", "drive")
    assert "filtered samples of joints that stand still, or whose effort is constant or at its limit" in printed.out
