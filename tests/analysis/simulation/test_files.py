"""Files of a simulation: series with all digits of their numbers."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from support.commands import Execute
from support.simulation import Compiler


@pytest.mark.slow
def test_series_are_written_with_all_digits(compiler: Compiler, execute: Execute) -> None:
    compiler.values = {**compiler.values, "table[1,2]": (0.1, 1 / 3, 2e-300)}
    Path("a.csv").write_text("of an earlier run")
    assert execute("simulate", "--csv", "a.csv").lines[-1] == "  csv: a.csv"
    with Path("a.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert {name: tuple(float(row[name]) for row in rows) for name in rows[0]} == compiler.values
    execute("simulate", "--csv", "b.csv")
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()


@pytest.mark.slow
def test_no_file_is_written_if_one_cannot_be_made(
    compiler: Compiler, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> bytes:
        raise MemoryError

    monkeypatch.setattr("urdfsync.analysis.simulation.plot.draw", fails)
    execute("simulate", "--csv", "a.csv", "--plot", "a.png", code=2)
    assert not Path("a.csv").exists()
