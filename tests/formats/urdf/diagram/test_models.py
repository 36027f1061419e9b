"""The text of a robot's model has the places and lines of the layout, which `test_layout` shows to be well drawn."""

from __future__ import annotations

import itertools

from support.annotations import Call, statements
from support.packages import generate
from support.urdfs import dynamics, joint, limit, link, mimic, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.diagram.layout import layout

ZOO = robot(
    link("base", 1.0),
    *(link(f"part{k}", 1.0) for k in range(7)),
    joint("skate", "planar", "base", "part0", axis="0 0 1", inside=[dynamics(1, 2)]),
    joint("air", "floating", "part0", "part2"),
    joint("turn", "continuous", "part0", "part3", inside=[dynamics(1, 2)]),
    joint("slide", "prismatic", "part0", "part4", inside=[limit(), dynamics(1, 2)]),
    joint("bare", "prismatic", "part4", "part5", inside=[limit(), mimic("turn")]),
    joint("weld", "fixed", "part5", "part1"),
    joint("held", "revolute", "base", "part6", inside=[mimic("weld")]),
)


def corners(note: Call) -> tuple[float, ...]:
    (x1, y1), (x2, y2) = note.get("extent")
    return x1, y1, x2, y2


def test_a_model_has_the_places_and_lines_of_the_layout() -> None:
    package = generate(ZOO.encode(), Target("Bot", "Bot"))
    expected = layout(package.skeleton, Assembly(package.robot, package.options, package.target).connectors)
    places, lines, extents = {}, {}, []
    for statement, note in statements(package.texts["Bot.mo"]):
        if placement := note.get("Placement"):
            name = next(word for last, word in itertools.pairwise(statement) if "." not in (last, word))
            places[name] = corners(placement.get("transformation"))
        elif line := note.get("Line"):
            start, end = "".join(statement).removeprefix("connect(").removesuffix(")").split(",")
            lines[start, end] = tuple(line.get("points"))
        elif whole := note.get("Diagram"):
            extents.append(corners(whole.get("coordinateSystem")))
    assert extents == [expected.extent]
    assert {name: places.get(name) for name in expected.placements if name != "frame_a"} == {
        name: place for name, place in expected.placements.items() if name != "frame_a"
    }
    assert {ends: tuple(map(tuple, points)) for ends, points in lines.items()} == {
        ends: points for ends, (_, points) in expected.lines.items()
    }
