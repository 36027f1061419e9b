"""How a first build grows with the links of a robot, and with the robots of a workspace.

CPU time is that of all processes. The exponent is that of its growth: 1 is linear. Memory is that of the largest
process; where robots are planned in several, that of the first process and that of the largest of the others are told
apart. All is measured in few rounds, since it takes long.
"""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.builds import first
from benchmarks.measuring import Quantity
from benchmarks.robots import write_workspace
from benchmarks.study import Row, Study, growth
from benchmarks.tools import Tools

LINKS = (1_000, 10_000)
ROBOTS = (20, 200)
EACH = 11
"""Links of each robot of a workspace."""
AT_MOST = 1.1
"""The exponent."""


def studies(tools: Tools) -> Iterator[Study]:
    """What is measured."""
    yield _links(tools)
    yield _robots(tools)


def _links(tools: Tools) -> Study:
    few, many = (f"{links:,} links" for links in LINKS)
    numbers = zip((few, many), LINKS, strict=True)
    places = {label: write_workspace(tools.folder / label, 1, links) for label, links in numbers}
    rows = (
        Row(many, few, AT_MOST, Quantity.CPU, growth(LINKS[1] / LINKS[0])),
        Row(many, few, None, Quantity.WALL, growth(LINKS[1] / LINKS[0])),
        Row(many, few, None, Quantity.PEAK, growth(LINKS[1] / LINKS[0])),
    )
    return Study("growth with links", {label: first(tools, place) for label, place in places.items()}, rows, {many})


def _robots(tools: Tools) -> Study:
    found, rows, slow = {}, [], set()
    for name, arguments in (("one process", ("--jobs", "1")), ("a process per core", ())):
        few, many = (f"{robots} robots, {name}" for robots in ROBOTS)
        for label, robots in zip((few, many), ROBOTS, strict=True):
            found[label] = first(tools, write_workspace(tools.folder / label, robots, EACH), arguments)
        slow.add(many)
        rows += [
            Row(many, few, AT_MOST, Quantity.CPU, growth(ROBOTS[1] / ROBOTS[0])),
            Row(many, few, None, Quantity.WALL, growth(ROBOTS[1] / ROBOTS[0])),
            Row(many, few, None, Quantity.PEAK),
        ]
    rows.append(Row(many, few, None, Quantity.CREW))
    return Study(f"growth with robots of {EACH} links", found, rows, slow)
