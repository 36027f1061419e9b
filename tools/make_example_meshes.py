"""The source of the example robots' meshes: every mesh is turned or extruded from an outline given here.

`python tools/make_example_meshes.py` writes them below `modelica/UrdfSync/Resources/robots/`. Coordinates are rounded
to a micrometre, so the bytes are the same on every machine; a test compares them with the files. All solids are closed.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
import struct
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
Vertex: TypeAlias = tuple[float, float, float]
Face: TypeAlias = tuple[int, int, int]

ROBOTS = Path(__file__).resolve().parents[1] / "modelica" / "UrdfSync" / "Resources" / "robots"
SEGMENTS = 48


@dataclasses.dataclass(frozen=True, slots=True)
class Solid:
    """A closed triangle mesh, in metres; faces are counter-clockwise seen from outside."""

    vertices: tuple[Vertex, ...]
    faces: tuple[Face, ...]

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
        """The solid shifted."""
        return Solid(tuple((a + x, b + y, c + z) for a, b, c in self.vertices), self.faces)

    def along_x(self) -> Solid:
        """The solid with its axis z laid along x, and x along y."""
        return Solid(tuple((c, a, b) for a, b, c in self.vertices), self.faces)

    def along_y(self) -> Solid:
        """The solid with its axis z laid along y, and its outline's x and y along z and x."""
        return Solid(tuple((b, c, a) for a, b, c in self.vertices), self.faces)


def _between(lower: Sequence[int], upper: Sequence[int]) -> list[Face]:
    """The faces between two rings of vertices, each counter-clockwise seen from above."""
    faces: list[Face] = []
    for i in range(len(lower)):
        j = (i + 1) % len(lower)
        faces += [(lower[i], lower[j], upper[j]), (lower[i], upper[j], upper[i])]
    return faces


def _closed(bottom: Vertex, rings: Sequence[Sequence[Vertex]], top: Vertex) -> Solid:
    """The solid through `rings`, lowest first, closed by a fan to `bottom` and one to `top`."""
    count = len(rings[0])
    vertices = [bottom, *(vertex for ring in rings for vertex in ring), top]
    indices = [range(1 + k * count, 1 + (k + 1) * count) for k in range(len(rings))]
    last = len(vertices) - 1
    faces: list[Face] = [(0, indices[0][(i + 1) % count], indices[0][i]) for i in range(count)]
    for lower, upper in itertools.pairwise(indices):
        faces += _between(lower, upper)
    faces += [(last, indices[-1][i], indices[-1][(i + 1) % count]) for i in range(count)]
    return Solid(tuple(vertices), tuple(faces))


def turn(profile: Sequence[Point]) -> Solid:
    """A solid of revolution about z; `profile` holds (radius, z) from the bottom face to the top face."""
    angles = [2 * math.pi * k / SEGMENTS for k in range(SEGMENTS)]
    rings = [[(r * math.cos(a), r * math.sin(a), z) for a in angles] for r, z in profile]
    return _closed((0.0, 0.0, profile[0][1]), rings, (0.0, 0.0, profile[-1][1]))


def extrude(outline: Sequence[Point], height: float, chamfer: float, centre: Point = (0.0, 0.0)) -> Solid:
    """A prism from z = 0 to `height` with chamfered edges.

    `outline` is counter-clockwise, and every point of it can be seen from `centre`.
    """
    inner = inset(outline, chamfer)
    levels = [(inner, 0.0), (outline, chamfer), (outline, height - chamfer), (inner, height)]
    rings = [[(x, y, z) for x, y in points] for points, z in levels]
    return _closed((*centre, 0.0), rings, (*centre, height))


def inset(outline: Sequence[Point], distance: float) -> list[Point]:
    """The outline moved inwards by `distance`, with the same number of corners."""
    result = []
    for i, (x, y) in enumerate(outline):
        (ax, ay), (bx, by) = outline[i - 1], outline[(i + 1) % len(outline)]
        before, after = math.hypot(x - ax, y - ay), math.hypot(bx - x, by - y)
        n1, n2 = ((ay - y) / before, (x - ax) / before), ((y - by) / after, (bx - x) / after)
        stretch = distance / (1 + n1[0] * n2[0] + n1[1] * n2[1])
        result.append((x + stretch * (n1[0] + n2[0]), y + stretch * (n1[1] + n2[1])))
    return result


def arc(x: float, y: float, radius: float, start: float, stop: float, steps: int = SEGMENTS // 2) -> list[Point]:
    """Points on a circle about (x, y), from angle `start` to angle `stop` in degrees."""
    angles = [math.radians(start + (stop - start) * k / steps) for k in range(steps + 1)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def hull(points: Iterable[Point]) -> list[Point]:
    """The convex hull, counter-clockwise (Andrew's monotone chain)."""

    def chain(ordered: Iterable[Point]) -> list[Point]:
        kept: list[Point] = []
        for p in ordered:
            while len(kept) > 1 and _turns_right(kept[-2], kept[-1], p):
                kept.pop()
            kept.append(p)
        return kept[:-1]

    ordered = sorted(set(points))
    return chain(ordered) + chain(reversed(ordered))


def _turns_right(a: Point, b: Point, c: Point) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 1e-12


def rounded(left: float, right: float, half_width: float, radius: float) -> list[Point]:
    """A rectangle from x = `left` to `right` and y = ±`half_width` with rounded corners."""
    corners = [(right, 1, 0), (left, 1, 90), (left, -1, 180), (right, -1, 270)]
    return [
        point
        for x, side, start in corners
        for point in arc(
            x + (radius if x == left else -radius), side * (half_width - radius), radius, start, start + 90, 8
        )
    ]


def gear(module: float, teeth: int) -> list[Point]:
    """A spur gear with straight flanks; the pitch radius is module · teeth / 2."""
    pitch = module * teeth / 2
    step = 2 * math.pi / teeth
    corners = [
        (pitch - 1.25 * module, -0.34),
        (pitch + module, -0.14),
        (pitch + module, 0.14),
        (pitch - 1.25 * module, 0.34),
    ]
    return [
        (r * math.cos((k + share) * step), r * math.sin((k + share) * step))
        for k in range(teeth)
        for r, share in corners
    ]


def stl(solid: Solid) -> bytes:
    """Binary STL in millimetres, as CAD programs write it."""
    parts = [b"binary STL, millimetres".ljust(80), struct.pack("<I", len(solid.faces))]
    for face in solid.faces:
        corners = [tuple(round(1e3 * x, 3) for x in solid.vertices[i]) for i in face]
        u, v = ([q - p for p, q in zip(corners[0], corners[k], strict=True)] for k in (1, 2))
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.hypot(*normal)
        unit = [round(x / length, 4) + 0.0 for x in normal]
        parts.append(struct.pack("<12fH", *unit, *(x for corner in corners for x in corner), 0))
    return b"".join(parts)


def obj(solid: Solid) -> bytes:
    """Wavefront OBJ in metres."""
    lines = ["# metres, z up"]
    lines += ["v " + " ".join(map(number, vertex)) for vertex in solid.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in solid.faces]
    return ("\n".join(lines) + "\n").encode()


def number(value: float) -> str:
    """A coordinate, to a micrometre."""
    return f"{round(value, 6) + 0.0:.6f}".rstrip("0").rstrip(".")


DAE = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2026-01-01T00:00:00Z</created>
    <modified>2026-01-01T00:00:00Z</modified>
    <unit name="metre" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_effects>
    <effect id="paint-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert><diffuse><color>{colour}</color></diffuse></lambert>
        </technique>
      </profile_COMMON>
    </effect>
  </library_effects>
  <library_materials>
    <material id="paint"><instance_effect url="#paint-effect"/></material>
  </library_materials>
  <library_geometries>
{geometries}
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
{nodes}
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""

GEOMETRY = """    <geometry id="{name}">
      <mesh>
        <source id="{name}-positions">
          <float_array id="{name}-array" count="{values}">{positions}</float_array>
          <technique_common>
            <accessor source="#{name}-array" count="{vertices}" stride="3">
              <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="{name}-vertices"><input semantic="POSITION" source="#{name}-positions"/></vertices>
        <triangles material="paint" count="{triangles}">
          <input semantic="VERTEX" source="#{name}-vertices" offset="0"/>
          <p>{indices}</p>
        </triangles>
      </mesh>
    </geometry>"""

NODE = """      <node id="{name}-{count}">
        <translate>{place}</translate>
        <instance_geometry url="#{name}">
          <bind_material>
            <technique_common><instance_material symbol="paint" target="#paint"/></technique_common>
          </bind_material>
        </instance_geometry>
      </node>"""


def dae(solids: Mapping[str, Solid], nodes: Sequence[tuple[str, Vertex]], colour: str) -> bytes:
    """COLLADA in metres, z up; `nodes` places each of `solids` once or more often."""
    geometries = [
        GEOMETRY.format(
            name=name,
            values=3 * len(solid.vertices),
            vertices=len(solid.vertices),
            triangles=len(solid.faces),
            positions=" ".join(number(x) for vertex in solid.vertices for x in vertex),
            indices=" ".join(str(i) for face in solid.faces for i in face),
        )
        for name, solid in solids.items()
    ]
    placed = [
        NODE.format(name=name, count=k, place=" ".join(map(number, place))) for k, (name, place) in enumerate(nodes, 1)
    ]
    return DAE.format(colour=colour, geometries="\n".join(geometries), nodes="\n".join(placed)).encode()


def disc(radius: float, height: float, chamfer: float) -> Solid:
    """A chamfered cylinder from z = 0 to `height`."""
    return turn([(radius - chamfer, 0), (radius, chamfer), (radius, height - chamfer), (radius - chamfer, height)])


def standing(outline: Sequence[Point], width: float, chamfer: float, centre: Point = (0.0, 0.0)) -> Solid:
    """A prism along y, centred; `outline` holds (x, z), counter-clockwise seen with x to the right and z up."""
    turned = [(z, x) for x, z in reversed(outline)]
    return extrude(turned, width, chamfer, (centre[1], centre[0])).along_y().moved(y=-width / 2)


def arm_meshes() -> dict[str, bytes]:
    """The meshes of the six-axis arm, by file name."""
    fillet = arc(0.118, 0.09, 0.034, 250, 180, 8)
    casting = turn(
        [(0.106, 0), (0.11, 0.004), (0.11, 0.026), *fillet, (0.084, 0.14), (0.096, 0.15), (0.096, 0.167), (0.093, 0.17)]
    )
    shoulder = hull([*arc(0.03, 0.2, 0.072, 0, 360), (-0.082, 0.03), (0.086, 0.03), (-0.082, 0.085), (0.088, 0.085)])
    plate = hull([*arc(0, 0, 0.074, 0, 360), *arc(0.44, 0, 0.062, 0, 360)])
    housing = hull(
        [
            *arc(0, 0, 0.062, 0, 360),
            (-0.1, 0.012),
            (-0.1, 0.082),
            (-0.084, 0.098),
            (0.11, 0.098),
            (0.13, 0.08),
            (0.13, 0),
        ]
    )
    tube = turn(
        [(0.055, 0), (0.058, 0.003), (0.058, 0.026), (0.055, 0.03), (0.042, 0.135), (0.042, 0.165), (0.039, 0.17)]
    )
    finger = [(0.004, 0.024), (0.034, 0.024), (0.034, 0.034), (0.019, 0.046), (0.012, 0.096), (0.004, 0.096)]
    return {
        "base_casting.stl": stl(casting),
        "carousel.obj": obj(standing(shoulder, 0.116, 0.006)),
        "upper_arm_side.dae": dae(
            {
                "plate": extrude(plate, 0.028, 0.004, (0.2, 0)).along_y(),
                "lower_boss": disc(0.056, 0.01, 0.003).along_y(),
                "upper_boss": disc(0.046, 0.01, 0.003).along_y(),
            },
            [("plate", (0, 0, 0)), ("lower_boss", (0, 0.028, 0)), ("upper_boss", (0, 0.028, 0.44))],
            "0.9 0.9 0.87 1",
        ),
        "elbow_housing.obj": obj(standing(housing, 0.112, 0.006)),
        "forearm_tube.stl": stl(tube.along_x()),
        "drive_pinion.stl": stl(extrude(gear(0.00125, 20), 0.01, 0.0003)),
        "finger.obj": obj(standing(finger, 0.024, 0.0015, (0.011, 0.034))),
    }


def wheeled_meshes() -> dict[str, bytes]:
    """The meshes of the wheeled robot, by file name."""
    groove = [(0.1, 0.017), (0.1, 0.022), (0.097, 0.023), (0.097, 0.025), (0.1, 0.026), (0.1, 0.031)]
    tyre = turn([(0.09, 0), (0.094, 0.002), (0.1, 0.009), *groove, (0.094, 0.038), (0.09, 0.04)])
    dome = turn(
        [(0.034, 0), (0.036, 0.002), (0.036, 0.026), (0.035, 0.03), (0.031, 0.036), (0.022, 0.041), (0.01, 0.043)]
    )
    shell = rounded(-0.05, 0.045, 0.085, 0.03)
    return {
        "chassis.stl": stl(extrude(rounded(-0.33, 0.19, 0.165, 0.07), 0.11, 0.014)),
        "tyre.obj": obj(tyre.moved(z=-0.02).along_y()),
        "lidar_dome.obj": obj(dome),
        "head_shell.dae": dae({"shell": extrude(shell, 0.08, 0.012)}, [("shell", (0, 0, -0.035))], "0.9 0.9 0.87 1"),
    }


def meshes() -> dict[Path, bytes]:
    """Every mesh of the examples: its path below the folder `robots`, and its bytes."""
    robots = {"six_axis_arm": arm_meshes(), "wheeled_robot": wheeled_meshes()}
    return {Path(robot, "meshes", name): content for robot, files in robots.items() for name, content in files.items()}


def main() -> None:
    """Write all meshes."""
    for path, content in meshes().items():
        (ROBOTS / path).parent.mkdir(parents=True, exist_ok=True)
        (ROBOTS / path).write_bytes(content)


if __name__ == "__main__":
    main()
