"""Faults that are put into a generated package are found by the comparison with Pinocchio, and where they are."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support import physics
from support.physics import changed, replaced
from support.urdfs import dynamics, joint, link, mimic, robot

from urdfsync.check.results import TOLERANCE
from urdfsync.domain import Quantity

pytestmark = pytest.mark.slow

EFFORT, REACTION = Quantity.EFFORT, Quantity.REACTION
POSITION, ORIENTATION = Quantity.POSITION, Quantity.ORIENTATION

FINGER = robot(
    link("base", 2.0),
    link("arm", 1.5).replace("</link>", '<visual><geometry><mesh filename="cover.stl"/></geometry></visual></link>'),
    link("finger", 0.4),
    joint("elbow", "revolute", "base", "arm", axis="0 0 1", inside=[dynamics(0.5, 0.1)]),
    joint("grip", "prismatic", "arm", "finger", axis="0 1 0", inside=[mimic("elbow", 0.3, 0.05)]),
)


def without_coupling(text: str) -> str:
    """The robot without the component by which grip follows elbow: it slides as the forces want."""
    text, parts = re.subn(r"\n  UrdfSync\.Couplings\.\w+ gripMimic\(.*?;\n", "\n", text, flags=re.DOTALL)
    text, connections = re.subn(r"  connect\(gripMimic\..*?;\n", "", text, flags=re.DOTALL)
    text, ranges = re.subn(r"\n +\w+ = m\w\w\(\{[^\n]*gripMimic\.[^\n]*", "", text)
    assert (parts, connections, ranges) == (1, 2, 6)
    return text


FAULTS: Mapping[str, tuple[str, Callable[[str], str], dict[str, set[Quantity]]]] = {
    "product": (
        "Links/ArmParameters.mo",
        replaced("ixy = 0.003", "ixy = -0.003"),
        {"joint elbow": {EFFORT}, "link base": {REACTION}},
    ),
    "product_of_root": ("Links/BaseParameters.mo", replaced("ixy = 0.004", "ixy = -0.004"), {"link base": {REACTION}}),
    "order_of_angles": (
        "Joints/GripParameters.mo",
        replaced("rpy = {0.5, -0.6, 0.7}", "rpy = {0.7, -0.6, 0.5}"),
        {
            "link finger": {POSITION, ORIENTATION},
            "robot": {Quantity.CENTRE},
            "joint elbow": {EFFORT},
            "link base": {REACTION},
        },
    ),
    "mimic": (
        "Mimic.mo",
        without_coupling,
        {"link finger": {POSITION}, "robot": {Quantity.CENTRE}, "joint elbow": {EFFORT}, "link base": {REACTION}},
    ),
    "damping": ("Joints/ElbowParameters.mo", replaced("damping = 0.5", "damping = 0"), {"joint elbow": {EFFORT}}),
    "digit": (
        "Links/FingerParameters.mo",
        replaced("mass = 0.4", "mass = 0.40000001"),
        {"robot": {Quantity.MASS, Quantity.CENTRE}, "joint elbow": {EFFORT}, "link base": {REACTION}},
    ),
}
"""File of the package, what happens to it, and where that shows."""


def test_faults_are_found_and_named(modelica_library: Path, tmp_path: Path) -> None:
    cases = []
    for name, (path, change, _) in FAULTS.items():
        cases.append(changed(physics.prepare(FINGER.encode(), name.capitalize(), complete=False), path, change))
    found = physics.compare(modelica_library, tmp_path, cases)
    assert {name: deviating(one) for name, one in zip(FAULTS, found, strict=True)} == {
        name: places for name, (_, _, places) in FAULTS.items()
    }


def deviating(comparison: physics.Deviations) -> dict[str, set[Quantity]]:
    """The quantities that differ, by element."""
    found: dict[str, set[Quantity]] = {}
    for one in comparison.deviations:
        if one.relative > TOLERANCE:
            found.setdefault(one.element, set()).add(one.quantity)
    return found
