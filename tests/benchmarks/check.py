"""`urdfsync check` with warm caches, whole processes, beside Python doing nothing.

The robot is the six-axis arm of the library's examples. The memory of the process itself, without the processes in
which it checks, is looked at every 50 ms. Needs a Modelica Standard Library.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence

import psutil
from support.corpus import REPOSITORY

from benchmarks.measuring import Cost, Quantity, UnexpectedError, measure, variables
from benchmarks.study import Figures, Row, Study
from benchmarks.tools import NOTHING, Tools
from urdfsync.check import libraries

ROBOT = "six_axis_arm"
_PAUSE = 0.05
_TIMES = 3


def studies(tools: Tools) -> Iterator[Study | Figures]:
    """What is measured."""
    try:
        libraries.find_standard_library(os.environ)
    except libraries.LibraryError:
        tools.say("there is no Modelica Standard Library: check is left out")
        return
    command = tools.urdfsync("check", ROBOT, "--config", str(REPOSITORY / "urdfsync.toml"))
    checks = {"check": command, "check --physics": [*command, "--physics"]}
    found: dict[str, Callable[[], Cost]] = {NOTHING: tools.nothing}
    found |= {label: _measurement(tools, command) for label, command in checks.items()}
    rows = [Row(label, NOTHING, quantity=quantity) for label in checks for quantity in (Quantity.WALL, Quantity.PEAK)]
    yield Study(f"check of {ROBOT}", found, rows)
    peak = statistics.median(own_peak(checks["check --physics"]) for _ in range(_TIMES)) / 1e6
    what = "the process itself, without those in which it checks"
    yield Figures("memory of check --physics", [(what, f"{peak:.0f} MB")])


def _measurement(tools: Tools, command: Sequence[str]) -> Callable[[], Cost]:
    return lambda: measure(command, tools.folder, ROBOT)


def own_peak(command: Sequence[str]) -> float:
    """The most resident bytes of a process, without those that it starts, as far as they are seen."""
    highest = 0
    with psutil.Popen(command, env=variables(), stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            try:
                highest = max(highest, process.memory_info().rss)
            except psutil.NoSuchProcess:
                break
            time.sleep(_PAUSE)
    if process.wait():
        raise UnexpectedError(f"{' '.join(command)}: exit code {process.returncode}")
    return float(highest)
