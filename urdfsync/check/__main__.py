"""The process that checks one robot: takes the order from stdin, and writes a line with each step to stdout."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from urdfsync import processes
from urdfsync.check.results import CheckResult, CheckStep, from_text, to_text
from urdfsync.check.robot import check_robot
from urdfsync.check.run import RobotOrder
from urdfsync.config import load
from urdfsync.diagnostics import UrdfsyncError


def main() -> None:
    """Check the robot that is ordered."""
    answers = processes.reserve_stdout()
    order = from_text(sys.stdin.buffer.readline(), RobotOrder)
    processes.end_with_parent()

    def answer(step: CheckStep) -> None:
        answers.write(to_text(step).encode() + b"\n")
        answers.flush()

    os.chdir(order.folder)
    try:
        config = load(Path(order.config))
        (robot,) = config.select([order.robot])
    except UrdfsyncError as error:  # the configuration has changed since
        result = CheckResult(order.robot, "", diagnostics=error.diagnostics)
    else:
        result = check_robot(config, robot, order.options, answer, Path(order.workspace))
    answer(CheckStep("", 1.0, result, is_last=True))


main()
