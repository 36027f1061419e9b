"""Divides robots among machines that do not talk to each other."""

from __future__ import annotations

from collections.abc import Sequence

from urdfsync.config import Config, RobotConfig
from urdfsync.state.store import Store


def select(config: Config, robots: Sequence[RobotConfig], number: int, total: int) -> tuple[RobotConfig, ...]:
    """Return the robots of share `number` (from 1) of `total`; each robot is in exactly one share.

    The largest robot goes first, always to the smallest share. A robot's size is the number of lines of its recorded
    state, which is the same in all clones of a commit. Times differ between machines: each would divide the robots in
    its own way, and nobody would check some robot.
    """
    # lines, not bytes: git may write CRLF on some machines
    sizes = {robot.name: 1 + _lines(config, robot) for robot in robots}
    loads, chosen = [0] * total, set[str]()
    for name in sorted(sizes, key=lambda name: (-sizes[name], name)):
        least = loads.index(min(loads))
        loads[least] += sizes[name]
        if least == number - 1:
            chosen.add(name)
    return tuple(robot for robot in robots if robot.name in chosen)


def _lines(config: Config, robot: RobotConfig) -> int:
    """Return the number of lines of a robot's recorded state; 0 for a robot that was never built."""
    try:
        return Store(config.root).path(robot.name).read_bytes().count(b"\n")
    except FileNotFoundError:
        return 0
