"""Effects on the robot as a whole: mass, centre of mass."""

from __future__ import annotations

from typing import Any

import pytest
import support.urdfs as urdfs
from support.packages import read

from urdfsync.domain import Version
from urdfsync.urdf.diff.effects import effects


def version(*elements: str) -> Version:
    snapshot = read(urdfs.robot(*elements).encode()).snapshot
    assert snapshot is not None
    return Version(snapshot)


def link(name: str, mass: float, center: str = "0 0 0") -> str:
    return urdfs.link(name, mass, center=center)


def joint(name: str, kind: str, parent: str, child: str, xyz: str = "0 0 0") -> str:
    limit = ['<limit lower="0" upper="1" effort="1" velocity="1"/>'] if kind in ("revolute", "prismatic") else []
    return urdfs.joint(name, kind, parent, child, xyz=xyz, rpy="0 0 0", axis="0 0 1", inside=limit)


def values(old: Version, new: Version) -> dict[str, tuple[Any, Any]]:
    return {" / ".join(effect.path): (effect.old, effect.new) for effect in effects(old, new)}


PAIR = (link("base", 1.0), link("tip", 3.0, "0 0 1"), joint("turn", "continuous", "base", "tip", "2 0 0"))


def test_mass_and_centre_of_mass_of_both_versions() -> None:
    heavier = version(link("base", 3.0), *PAIR[1:])
    found = values(version(*PAIR), heavier)
    assert found["robot / mass"] == (4.0, 6.0)
    before, after = found["robot / centre of mass"]
    assert before == pytest.approx((1.5, 0, 0.75), abs=1e-15)
    assert after == pytest.approx((1.0, 0, 0.5), abs=1e-15)
    assert [effect.unit for effect in effects(version(*PAIR), heavier)] == ["kg", "m"]
    massless = values(version('<link name="base"/>'), heavier)
    assert (massless["robot / mass"], massless["robot / centre of mass"][0]) == ((0.0, 6.0), None)
