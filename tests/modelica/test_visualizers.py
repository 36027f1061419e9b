"""The library's drawings against the definitions of URDF's shapes, and the first direction of a planar joint."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from support.modelica import URDFSYNC, Run, bench, simulate

pytestmark = pytest.mark.slow

XYZ, RPY = np.array([0.1, 0.2, -0.3]), (0.4, -0.5, 0.6)
SIZES = {
    "Box": "size = {0.1, 0.2, 0.3}",
    "Cylinder": "radius = 0.1, length = 0.5",
    "Sphere": "radius = 0.2",
    "Capsule": "radius = 0.05, length = 0.4",
    "Ellipsoid": "radii = {0.1, 0.2, 0.3}",
    "Mesh": 'uri = "1"',
}
DRAWN = {
    "box.shape": ((0, 0, 0), "xy", (0.1, 0.2, 0.3)),
    "cylinder.shape": ((0, 0, 0), "zx", (0.5, 0.2, 0.2)),
    "sphere.shape": ((0, 0, 0), "zx", (0.4, 0.4, 0.4)),
    "capsule.shape": ((0, 0, 0), "zx", (0.4, 0.1, 0.1)),
    "capsule.lowerEnd": ((0, 0, -0.2), "zx", (0.1, 0.1, 0.1)),
    "capsule.upperEnd": ((0, 0, 0.2), "zx", (0.1, 0.1, 0.1)),
    "ellipsoid.shape": ((0, 0, 0), "xy", (0.2, 0.4, 0.6)),
    "mesh.shape": ((0.5, 0, 0), "xy", (1, 1, 1)),  # it begins at its origin, and the factor 1 is no length
}
"""For each drawn shape, its centre and the axes of its length and width in the shape's frame, and its sizes."""
NORMALS = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8), (2.0, -4.0, 5.0))


def deviations(library: Path, own: Path = URDFSYNC) -> set[str]:
    """What a library draws or computes otherwise than it is defined."""
    origin = f"origin(xyz = {{{', '.join(map(str, XYZ))}}}, rpy = {{{', '.join(map(str, RPY))}}})"
    parts, ends = list[str](), list[str]()
    for kind, size in SIZES.items():
        for name, modifier in ((kind.lower(), ""), (f"hidden{kind}", "animation = false, ")):
            numbers = f"{origin}, color = {{10, 20, 30}}, {size}"
            parts.append(f"UrdfSync.Visualizers.{kind} {name}({modifier}parameters({numbers}));")
            ends.append(f"connect(world.frame_b, {name}.frame_a);")
    for k, normal in enumerate(NORMALS):
        parts.append(f"parameter Real n{k}[3] = {{{', '.join(map(str, normal))}}};")
        parts.append(f"Real u{k}[3] = (1 + time)*UrdfSync.Functions.normalTo(n{k});")
    body = "\n    ".join([*parts, "equation", *ends])
    vectors = ("r_shape", "lengthDirection", "widthDirection", "color")
    names = [f"{shape}.{vector}[{i}]" for shape in DRAWN for vector in vectors for i in (1, 2, 3)]
    names += [f"{shape}.{size}" for shape in DRAWN for size in ("length", "width", "height")]
    names += [f"u{k}[{i}]" for k in range(len(NORMALS)) for i in (1, 2, 3)]
    task = bench(body, [Run()], names, packages=(), is_animated=True)
    (series,) = simulate(library, [], [dataclasses.replace(task, pattern=r".*(shape|End)\.length")], own)

    def vector(name: str) -> Any:
        return np.array([series.values[f"{name}[{i}]"][0] for i in (1, 2, 3)])

    rotation = pin.rpy.rpyToMatrix(*RPY)
    wrong = {name.removesuffix(".length") for name in series.values if name.endswith(".length")} - DRAWN.keys()
    for shape, (centre, axes, sizes) in DRAWN.items():
        given = [series.values[f"{shape}.{size}"][0] for size in ("length", "width", "height")]
        along, across = (rotation[:, "xyz".index(axis)] for axis in axes)
        middle = vector(f"{shape}.r_shape") + given[0] / 2 * vector(f"{shape}.lengthDirection")
        pairs = [(middle, XYZ + rotation @ centre), (vector(f"{shape}.lengthDirection"), along), (given, sizes)]
        pairs += [(vector(f"{shape}.widthDirection"), across), (vector(f"{shape}.color"), (10, 20, 30))]
        wrong |= {shape for ours, theirs in pairs if not np.allclose(ours, theirs, rtol=0, atol=1e-12)}
    for k, normal in enumerate(NORMALS):
        u, n = vector(f"u{k}"), np.array(normal)
        e = np.eye(3)[int(abs(n[0]) >= 0.9 * np.linalg.norm(n))]  # u lies in the plane of n and this axis
        if not np.allclose((u @ n, u @ u, np.cross(n, e) @ u), (0, 1, 0), rtol=0, atol=1e-12) or u @ e <= 0:
            wrong.add("normalTo")
    return wrong


def test_shapes_are_drawn_where_and_as_large_as_they_are(modelica_library: Path) -> None:
    assert deviations(modelica_library) == set()


FAULTS = {
    "the length of a box": ("Visualizers/Box", "length = parameters.size[1]", "length = 0.5*parameters.size[1]"),
    "the place of a cylinder": ("Visualizers/Cylinder", "- 0.5*parameters.length", "+ 0.5*parameters.length"),
    "a hidden sphere that is drawn": ("Visualizers/Sphere", "enableAnimation and animation", "enableAnimation"),
    "an end of a capsule": ("Visualizers/Capsule", "+ 0.5*parameters.length", "- 0.5*parameters.length"),
    "the axes of an ellipsoid": (
        "Visualizers/Ellipsoid",
        "width = 2*parameters.radii[2]",
        "width = 2*parameters.radii[3]",
    ),
    "the axes of a mesh": ("Visualizers/Mesh", "widthDirection = R[:, 2]", "widthDirection = R[:, 3]"),
    "a colour": ("Visualizers/Box", "color = parameters.color", "color = {0, 0, 0}"),
    "a direction": ("Functions/normalTo", "e - (e*n)/(n*n)*n", "e - (e*n)*n"),
}
"""A file of the library, and what it says otherwise."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_the_drawings_is_found(fault: str, modelica_library: Path, tmp_path: Path) -> None:
    path, old, new = FAULTS[fault]
    shutil.copytree(URDFSYNC, tmp_path / "UrdfSync", ignore=shutil.ignore_patterns("Images", "robots"))
    file = tmp_path / "UrdfSync" / f"{path}.mo"
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new), "utf-8")
    assert deviations(modelica_library, tmp_path / "UrdfSync")
