"""Whole processes timed in rounds, and the table of what came out."""

from __future__ import annotations

import dataclasses
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


@dataclasses.dataclass(frozen=True)
class Row:
    """A measurement beside another one."""

    what: str
    against: str
    at_most: float | None
    """What the ratio shall not exceed; None if it is only told."""


def comparison(title: str, rounds: Sequence[Mapping[str, float]], rows: Sequence[Row]) -> Table:
    """Medians, spread and ratio of pairs of measurements; `rounds` have the seconds of each by its label."""
    result = Table(title=f"{title}: whole-process time in ms, {len(rounds)} rounds")
    for heading in ("what", "against"):
        result.add_column(heading)
    for heading in ("median", "least to most", "median of the other", "ratio", "at most"):
        result.add_column(heading, justify="right")
    for row in rows:
        mine, other = ([1000 * measured[label] for measured in rounds] for label in (row.what, row.against))
        ratio = statistics.median(one / two for one, two in zip(mine, other, strict=True))
        style = "" if row.at_most is None else "green" if ratio <= row.at_most else "red"
        spread = f"{min(mine):.0f} to {max(mine):.0f}"
        bar = "" if row.at_most is None else f"{row.at_most:g}"
        median, others = (f"{statistics.median(times):.1f}" for times in (mine, other))
        result.add_row(row.what, row.against, median, spread, others, f"[{style or 'default'}]{ratio:.2f}[/]", bar)
    return result
