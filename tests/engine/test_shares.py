"""Shares of robots: each robot is in exactly one, on all machines, whatever they remember of times."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import config
from urdfsync.config import Config
from urdfsync.engine import shares
from urdfsync.state.store import Store

NAMES = [f"r{number}" for number in range(11)]


@pytest.fixture
def robots(tmp_path: Path) -> Config:
    tables = (f'[robots.{n}]\nsource = "{n}.urdf"\npackage = "{n.title()}"\n' for n in NAMES)
    return config.parse("\n".join(tables), tmp_path / "urdfsync.toml", "urdfsync.toml")


def record(robots: Config, end: str = "\n") -> None:
    """Record the robot `r0` with 1,000 lines, each other robot with 100."""
    for name in NAMES:
        file = Store(robots.root).path(name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(f"line{end}".encode() * (1000 if name == "r0" else 100))


def divide(robots: Config, total: int) -> list[list[str]]:
    return [[robot.name for robot in shares.select(robots, robots.robots, k + 1, total)] for k in range(total)]


@pytest.mark.parametrize("total", [1, 2, 5, 11, 13])
def test_each_robot_is_in_one_share(robots: Config, total: int) -> None:
    for prepare in (lambda _: None, record):
        prepare(robots)
        assert sorted(name for share in divide(robots, total) for name in share) == sorted(NAMES)


def test_shares_are_balanced_by_the_recorded_state(robots: Config) -> None:
    record(robots)
    assert divide(robots, 2) == [["r0"], NAMES[1:]]


def test_line_ends_of_a_clone_do_not_matter(robots: Config) -> None:
    record(robots)
    before = divide(robots, 3)
    record(robots, "\r\n")
    assert divide(robots, 3) == before
