"""Whole processes timed in rounds, and the table of what came out."""

from __future__ import annotations

import statistics
import subprocess
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.table import Table

NOTHING = "python -c pass"
"""Label of the process that all others are compared with."""


def seconds(command: Sequence[str], folder: Path, environment: Mapping[str, str] | None = None) -> float:
    """Wall-clock time of a process, from before its start to its end. Raises CalledProcessError if it fails."""
    started = time.perf_counter()
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, env=environment)
    return time.perf_counter() - started


def table(rounds: Sequence[Mapping[str, float]]) -> Table:
    """Median, spread and ratio of each measurement; `rounds` have the seconds of each by its label."""
    result = Table(title=f"whole-process time, {len(rounds)} rounds")
    result.add_column("what")
    for heading in ("median, ms", "least to most, ms", f"times {NOTHING}"):
        result.add_column(heading, justify="right")
    for label in rounds[0]:
        times = [1000 * measured[label] for measured in rounds]
        ratio = statistics.median(measured[label] / measured[NOTHING] for measured in rounds)
        result.add_row(
            label, f"{statistics.median(times):.0f}", f"{min(times):.0f} to {max(times):.0f}", f"{ratio:.1f}"
        )
    return result
