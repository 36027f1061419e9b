"""Whole-process time and memory of `urdfsync check` with warm caches, beside that of Python doing nothing.

    python tests/benchmarks/bench_check.py [--runs N]

The robot is the six-axis arm of the library's examples. Memory is what the started process itself takes at most,
without the processes in which it checks. Needs a Modelica Standard Library.
"""

from __future__ import annotations

import argparse
import platform
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[1])]

import psutil  # noqa: E402
from rich.console import Console  # noqa: E402
from support.corpus import REPOSITORY  # noqa: E402
from support.timing import NOTHING, seconds, table  # noqa: E402

ROBOT = "six_axis_arm"
COMMAND = [sys.executable, "-m", "urdfsync", "check", ROBOT, "--quiet", "--config", str(REPOSITORY / "urdfsync.toml")]
CHECKS = {"check": COMMAND, "check --physics": [*COMMAND, "--physics"]}
_PAUSE = 0.05


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5, help="how often to measure everything (default: 5)")
    options = parser.parse_args()
    console = Console()
    console.print(f"{ROBOT}; Python {platform.python_version()}, {psutil.cpu_count()} cores, {platform.platform()}")
    commands = {NOTHING: [sys.executable, "-c", "pass"], **CHECKS}
    with tempfile.TemporaryDirectory() as folder:
        rounds = [
            {label: seconds(command, Path(folder)) for label, command in commands.items()}
            for _ in range(options.runs + 1)
        ]
        console.print(table(rounds[1:]))  # the first fills caches
        peaks = [peak(CHECKS["check --physics"]) / 1e6 for _ in range(3)]
    console.print(f"memory of the process itself: {statistics.median(peaks):.0f} MB")


def peak(command: list[str]) -> float:
    """The most resident bytes of a process, without those that it starts, as far as they are seen."""
    highest = 0
    with psutil.Popen(command) as process:
        while process.poll() is None:
            try:
                highest = max(highest, process.memory_info().rss)
            except psutil.NoSuchProcess:
                break
            time.sleep(_PAUSE)
    return float(highest)


if __name__ == "__main__":
    main()
