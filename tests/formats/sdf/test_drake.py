"""Drake reads an SDF with libsdformat, the reference of the format: its robots have the same masses and weights.

Drake is no dependency: `pip install drake` lets these tests run.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from xml.etree.ElementTree import Element, tostring

import numpy as np
import pytest
from support.random_sdfs import example
from support.sdf_walk import changes, every_entry, judge
from support.sdfs import arm, urdf

parsing = pytest.importorskip("pydrake.multibody.parsing")
plants = pytest.importorskip("pydrake.multibody.plant")

SHAPES = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone")


def plant(text: str, kind: str) -> Any:
    read = plants.MultibodyPlant(0.0)
    parsing.Parser(read).AddModelsFromString(text, kind)
    read.Finalize()
    return read


def numbers_of(text: str, kind: str, positions: dict[str, float]) -> list[Any]:
    """Return mass matrix and weights; a robot that moves freely stands at the world's origin."""
    read = plant(text, kind)
    context, rows = read.CreateDefaultContext(), list[int]()
    joints = {read.get_joint(index).name(): read.get_joint(index) for index in read.GetJointIndices()}
    state = np.array(read.GetPositions(context))
    for name, position in positions.items():
        state[joints[name].position_start()] = position
        rows.append(joints[name].velocity_start())
    if "link0" in joints:  # Drake's own joint of a link that moves freely
        state[joints["link0"].position_start() :][:7] = (1, 0, 0, 0, 0, 0, 0)
        rows += range(joints["link0"].velocity_start(), joints["link0"].velocity_start() + 6)
    read.SetPositions(context, state)
    mass = read.CalcMassMatrixViaInverseDynamics(context)[np.ix_(rows, rows)]
    return [mass, read.CalcGravityGeneralizedForces(context)[rows]]


@pytest.mark.parametrize("seed", range(60))
def test_drake_reads_the_same_robot(seed: int) -> None:
    robot = example(seed)
    random = np.random.default_rng(seed)
    positions = {name: random.uniform(-1, 1) for name in robot.joints}
    source = numbers_of(robot.sdf, "sdf", positions)
    translation = numbers_of(urdf(robot.sdf, robot="arm")[0], "urdf", positions)
    for first, second in zip(source, translation, strict=True):
        assert np.abs(first - second).max(initial=0) <= 1e-12 * max(1.0, np.abs(first).max(initial=0))


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("mass", ["", "<mass>3</mass>"])
def test_drake_computes_the_same_inertia_of_shapes(shape: str, mass: str) -> None:
    sizes = {"box": "<size>0.1 0.2 0.3</size>", "ellipsoid": "<radii>0.1 0.2 0.3</radii>"}
    given = sizes.get(shape, "<radius>0.2</radius>" + "<length>0.5</length>" * (shape != "sphere"))
    solid = f"<pose>0.1 0.2 0.3 0.4 0.5 0.6</pose><geometry><{shape}>{given}</{shape}></geometry>"
    ball = "<density>300</density><geometry><sphere><radius>0.3</radius></sphere></geometry>"
    collisions = f'<collision name="a">{solid}</collision><collision name="b">{ball}</collision>'
    text = arm(f'<inertial auto="true"><density>500</density>{mass}</inertial>{collisions}', version="1.11")
    source, translation = (
        numbers_of(each, kind, {"turn": 0.3}) for each, kind in ((text, "sdf"), (urdf(text)[0], "urdf"))
    )
    for first, second in zip(source, translation, strict=True):
        assert np.allclose(first, second, rtol=1e-12, atol=1e-12)


def applied(root: Element) -> Iterator[Any]:
    """Yield what Drake makes of an SDF; nothing if Drake refuses it."""
    try:
        read = plant(tostring(root, "unicode"), "sdf")
    except (RuntimeError, ValueError):
        return
    context = read.CreateDefaultContext()
    positions = read.GetPositions(context)
    read.SetPositions(context, positions + np.linspace(0.1, 0.3, len(positions)))
    yield from (read.CalcMassMatrixViaInverseDynamics(context), read.CalcGravityGeneralizedForces(context), positions)
    for bound in ("Position", "Velocity", "Acceleration", "Effort"):
        yield from (getattr(read, f"Get{bound}{side}Limits")() for side in ("Lower", "Upper"))
    joints = [read.get_joint(index) for index in read.GetJointIndices()]
    yield np.array([value for joint in joints for value in joint.default_damping_vector()])


@pytest.mark.slow
def test_what_drake_applies_is_translated_or_told() -> None:
    """`tests/formats/sdf/test_whole_format.py` says what acts by sdformat's descriptions; this asks a program."""
    acting, quiet = 0, list[str]()
    for entry in every_entry():
        for _, before, after in changes(entry):
            pairs = [*zip(applied(before), applied(after), strict=False)]
            if any(np.shape(first) != np.shape(second) or (first != second).any() for first, second in pairs):
                acting += 1
                verdict = judge(entry)
                quiet += [] if any(verdict) else [entry.path]
    assert acting > 30
    assert quiet == []
