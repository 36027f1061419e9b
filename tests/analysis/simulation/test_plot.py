"""Plots: what is drawn where, and that the same result gives the same bytes."""

from __future__ import annotations

import re
from typing import Any

import msgspec
import numpy as np
import pytest
from lxml import etree

from urdfsync.analysis.simulation.results import JointResult, Range, SimulateResult

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from urdfsync.analysis.simulation.plot import draw
from urdfsync.common.diagnostics import ConfigError


def quantity(name: str, unit: str, **limits: float) -> Range:
    return Range(name, unit, 0.0, 1.0, limits.get("lower"), limits.get("upper"))


def result(*joints: JointResult) -> SimulateResult:
    series = {"time": (0.0, 1.0, 2.0), "q": (0.0, 0.5, 1.0), "w": (0.0, 1.0, 0.0)}
    return SimulateResult("arm", "Arm.ArmTest", 2.0, 1.0, 1e-6, joints, series, (), 1.0, is_known=False)


def joint(number: int, unit: str = "rad", robot: str = "robot", **limits: Any) -> JointResult:
    return JointResult(f"joint j{number}", robot, quantity("q", unit, **limits), quantity("w", f"{unit}/s"))


def texts(*joints: JointResult) -> list[str]:
    """The texts of the picture, which SVG keeps in comments."""
    return re.findall(r"<!-- (.*?) -->", draw(result(*joints), "svg").decode())


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["png", "svg"])
def test_the_same_result_gives_the_same_bytes(kind: str) -> None:
    first, second = (draw(result(*map(joint, range(8))), kind) for _ in range(2))
    assert first == second
    assert first.startswith(b"\x89PNG" if kind == "png" else b"<?xml")


@pytest.mark.slow
def test_the_last_bits_of_the_layout_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """The solver of the layout orders its variables by their addresses, so panels may move by a part in 10^9."""
    first, execute = draw(result(joint(0)), "svg"), ConstrainedLayoutEngine.execute

    def shifted(engine: ConstrainedLayoutEngine, figure: Figure) -> None:
        execute(engine, figure)
        for number, panel in enumerate(figure.axes):
            panel.set_position((np.array(panel.get_position().bounds) + 1e-9 * (number + 1)).tolist())

    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", shifted)
    assert draw(result(joint(0)), "svg") == first


def count_panels(*joints: JointResult) -> int:
    return len(re.findall(r'<g id="axes_\d+">', draw(result(*joints), "svg").decode()))


@pytest.mark.slow
def test_six_joints_of_one_unit_share_a_column() -> None:
    rotational = [joint(number) for number in range(7)]
    assert count_panels(*rotational[:6]) == 2
    assert count_panels(*rotational) == 4
    assert count_panels(rotational[0], joint(7, "m"), joint(8, robot="other")) == 6


@pytest.mark.slow
def test_a_model_without_joints_has_its_series_in_one_panel() -> None:
    assert count_panels() == 1
    assert {"q", "w"} <= set(texts())
    names = ["time", *(f"x{number}" for number in range(13))]
    many = msgspec.structs.replace(result(), series=dict.fromkeys(names, (0.0,)))
    with pytest.raises(ConfigError, match="no joints, and 13 variables: a picture has at most 12; name some"):
        draw(many, "svg")


@pytest.mark.slow
def test_what_no_joint_of_a_column_has_gets_no_panel() -> None:
    """The joints of `joint` have no effort."""
    with_effort = JointResult("joint j9", "robot", quantity("q", "m"), quantity("w", "m/s"), quantity("q", "N"))
    assert count_panels(joint(1)) == 2
    assert count_panels(joint(1), with_effort) == 5


@pytest.mark.slow
def test_joints_units_and_robots_are_named() -> None:
    found: Any = texts(joint(1), joint(2, "m", robot="cell.left"))
    assert {"Arm.ArmTest", "joint j1", "cell.left: joint j2", "position [rad]", "speed [m/s]", "time [s]"} <= {*found}


@pytest.mark.slow
@pytest.mark.parametrize("name", [r"$\frac$", "$", "a_b^{c", "%s", "<!-- -->"])
def test_a_name_is_no_formula(name: str) -> None:
    named = JointResult(f"joint {name}", name, quantity("q", "rad"), None)
    content = draw(msgspec.structs.replace(result(named), model=name), "svg").decode()
    etree.fromstring(content.encode())
    assert draw(msgspec.structs.replace(result(named), model=name), "png")


@pytest.mark.slow
def test_limits_are_drawn_where_they_are_near() -> None:
    def count_lines(**limits: Any) -> int:
        return draw(result(joint(1, **limits)), "svg").decode().count("stroke-dasharray")

    assert count_lines(lower=-0.2, upper=1.2) == count_lines() + 2
    assert count_lines(lower=-100.0, upper=100.0) == count_lines(), "they would flatten the curve"
