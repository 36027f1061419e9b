"""Logs of strangers: numbers that nobody has measured, and small files that unpack to any size."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from analysis.identification import test_bag as bags
from support.commands import Execute

from urdfsync.analysis.identification import process
from urdfsync.analysis.identification.log import Log
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.common.diagnostics import SourceError
from urdfsync.domain.regressor import Axis

ELBOW = Axis("elbow", "elbow", "rad", 0.0, (-1.5, 1.5), 3.0, 20.0, 50.0, "position", "elbow_phi")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere not all limits hold")


def read(file: Path) -> None:
    list(Log(file, [ELBOW], IdentifyOptions()).pieces())


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("column", "number"), [("effort", "1e200"), ("position", "1e308"), ("position [deg]", "-1e308"), ("effort", "1e10")]
)
def test_a_number_that_nobody_has_measured_is_one_error(
    gripper: Path, execute: Execute, column: str, number: str
) -> None:
    head, *rows = Path("log.csv").read_text().splitlines()
    cells = rows[99].split(",")
    cells[head.split(",").index(f"drive.{column.partition(' ')[0]}")] = number
    rows[99] = ",".join(cells)
    head = head.replace(f"drive.{column.partition(' ')[0]}", f"drive.{column}")
    Path("log.csv").write_text("\n".join([head, *rows]) + "\n")
    printed = execute("identify", "gripper", "log.csv", code=2)
    assert f"`drive.{column}` is {float(number):g} at 0.198 s, which nobody has measured" in printed.words
    assert len(printed.errors) == 1


def mcap_bomb(folder: Path) -> Path:
    """A recording whose one chunk is 2 GB of zeros behind its messages."""
    from backports import zstd

    content = bags.write("bag", {"/joint_states": bags.states()})
    (file,) = content.glob("*.mcap")
    compressor = zstd.ZstdCompressor()
    packed = b"".join(compressor.compress(bytes(10_000_000)) for _ in range(200)) + compressor.flush()
    header = b"\x89MCAP0\r\n" + b"\x01" + (12).to_bytes(8, "little") + b"\x04\0\0\0ros2" + bytes(4)
    fields = bytes(16) + (2_000_000_000).to_bytes(8, "little") + bytes(4) + (4).to_bytes(4, "little") + b"zstd"
    chunk = fields + len(packed).to_bytes(8, "little") + packed
    end = b"\x0f" + (4).to_bytes(8, "little") + bytes(4) + b"\x02" + (20).to_bytes(8, "little") + bytes(20)
    file.write_bytes(header + b"\x06" + len(chunk).to_bytes(8, "little") + chunk + end + b"\x89MCAP0\r\n")
    return file


def bag_bomb(folder: Path) -> Path:
    """A recording whose file is packed as a whole: it unpacks to 2 GB."""
    from backports import zstd

    bag = bags.write("bag", {"/joint_states": bags.states()}, "SQLITE3")
    (file,) = bag.glob("*.db3")
    compressor = zstd.ZstdCompressor()
    packed = b"".join(compressor.compress(bytes(10_000_000)) for _ in range(200)) + compressor.flush()
    file.unlink()
    Path(f"{file}.zstd").write_bytes(packed)
    metadata = (bag / "metadata.yaml").read_text().replace(file.name, f"{file.name}.zstd")
    metadata = metadata.replace("compression_format: ''", "compression_format: zstd")
    metadata = metadata.replace('compression_format: ""', "compression_format: zstd")
    metadata = metadata.replace("compression_mode: ''", "compression_mode: FILE")
    (bag / "metadata.yaml").write_text(metadata.replace('compression_mode: ""', "compression_mode: FILE"))
    return bag


def parquet_bomb(folder: Path) -> Path:
    """A table of 20 million equal rows."""
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    zeros = pyarrow.array(np.zeros(1_000_000))
    table = pyarrow.table({"time": zeros, "elbow.position": zeros, "elbow.effort": zeros})
    with parquet.ParquetWriter("log.parquet", table.schema) as writer:
        for _ in range(20):
            writer.write_table(table)
    return Path("log.parquet")


def endless_line(folder: Path) -> Path:
    """A sparse file: its first line never ends."""
    with Path("log.csv").open("wb") as file:
        file.write(b"time,elbow.position,elbow.effort\n")
        file.truncate(20_000_000_000)
    return Path("log.csv")


@LINUX
@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "words"),
    [
        (mcap_bomb, "reading the log takes more than 1000 MB of memory"),
        (bag_bomb, "the recording can't be read: .*File too large"),
        (parquet_bomb, "the log unpacks to more than"),
        (endless_line, "reading the log takes more than 1000 MB of memory"),
    ],
)
def test_a_small_file_that_unpacks_to_any_size(
    folder: Path, monkeypatch: pytest.MonkeyPatch, make: Any, words: str
) -> None:
    """The file is refused in one line, and leaves nothing on the disk."""
    file = make(folder)
    (folder / "tmp").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder / "tmp"))
    with pytest.raises(SourceError, match=f"^[^\\n]*{words}[^\\n]*$"):
        read(file)
    assert [*(folder / "tmp").iterdir()] == []


@LINUX
def test_time_is_limited(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A log whose rows take too long ends in one line."""
    shutil.copy(bags.write("bag", {"/joint_states": bags.states(3000)}).glob("*.mcap").__next__(), "log.mcap")
    monkeypatch.setattr(process, "CPU_SECONDS", 0.01)
    with pytest.raises(
        SourceError, match=r"log\.mcap: error: reading the file takes more than 0\.\d+ s; record the log anew"
    ):
        read(Path("log.mcap"))
