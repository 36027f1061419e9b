"""Effects on the robot as a whole: mass, centre of mass."""

from __future__ import annotations

import pytest
from support.urdfs import joint, link, version

from urdfsync.urdf.diff.effects import effects


def test_mass_and_centre_of_mass_of_both_versions() -> None:
    turn = joint("turn", "continuous", "base", "tip", xyz="2 0 0", rpy="0 0 0", axis="0 0 1")
    massless, light, heavy = (
        version(link("base", mass, center="0 0 0"), link("tip", mass and 3.0, center="0 0 1"), turn)
        for mass in (None, 1.0, 3.0)
    )
    mass, centre = effects(light, heavy)
    assert (mass.path, mass.old, mass.new, mass.unit) == (("robot", "mass"), 4.0, 6.0, "kg")
    assert (centre.path, centre.unit) == (("robot", "centre of mass"), "m")
    assert centre.old == pytest.approx((1.5, 0, 0.75), abs=1e-15)
    assert centre.new == pytest.approx((1.0, 0, 0.5), abs=1e-15)
    assert [effect.old for effect in effects(massless, heavy)] == [0.0, None]
