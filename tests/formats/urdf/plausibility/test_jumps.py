"""Numbers that jump from one export to the next."""

from __future__ import annotations

import pytest
from support.urdfs import dynamics, joint, limit, link, links, version

from urdfsync.formats.urdf.plausibility.judgements import find_jumps


def test_masses_that_jump_are_one_warning() -> None:
    old = version(*links(base=1.0, arm=2.0, hand=0.5, tip=None), joint("a", "fixed", "base", "arm"),
                  joint("b", "fixed", "arm", "hand"), joint("c", "fixed", "hand", "tip"))  # fmt: skip
    new = version(*links(base=9.9, claw=0.05, arm=2000.0, tip=3.0), joint("a", "fixed", "base", "arm"),
                  joint("b", "fixed", "arm", "claw"), joint("c", "fixed", "claw", "tip"))  # fmt: skip
    (found,) = find_jumps(old, new, {("link", "hand"): "claw"})
    assert (found.element, found.code) == ("link arm / inertial / mass", "mass-jump")
    assert found.message == "link arm: its mass jumps, 2 kg → 2000 kg (and 1 more like it)"
    (alone,) = find_jumps(version(link("base", 1.0)), version(link("base", 2000.0)), {})
    assert alone.message == "link base: its mass jumps, 1 kg → 2000 kg"
    assert list(find_jumps(old, old, {})) == []


@pytest.mark.parametrize(
    ("size", "ratio"), [(1000, ", by the ratio of kg and g"), (0.001, ", by the ratio of kg and g"), (500, "")]
)
def test_masses_that_jump_by_a_thousand_are_in_grams_also_of_a_small_robot(size: float, ratio: str) -> None:
    old, new = (version(*links(base=0.02 * factor, arm=0.005 * factor), joint("a", "fixed", "base", "arm"))
                for factor in (1, size))  # fmt: skip
    (found,) = find_jumps(old, new, {})
    assert found.message.endswith(f" kg (and 1 more like it){ratio}")


def two(*inside: str, xyz: str = "0 0 0.2", shape: str = "") -> list[str]:
    body = link("arm", 2.0).replace("</link>", f"{shape}</link>")
    return [link("base", 1.0), body, joint("j", "revolute", "base", "arm", xyz=xyz, inside=inside)]


BOX = "<visual><geometry><box size='0.1 0.1 0.1'/></geometry></visual>"
LARGE = BOX.replace("0.1 0.1 0.1", "100 100 100")


@pytest.mark.parametrize(("old", "new", "words"), [
    (two(limit(effort=20)), two(limit(effort=20000)), "joint j / limit / effort jumps from 20 to 20000: m and mm"),
    (two(limit(velocity=3)), two(limit(velocity=171.9)), "limit / velocity jumps from 3 to 171.9: rad and degrees"),
    (two(limit(velocity=2)), two(limit(velocity=19.1)), "velocity jumps from 2 to 19.1: rad/s and turns a minute"),
    (two(dynamics(1, 2)), two(dynamics(1000, 2)), "joint j / dynamics / damping jumps from 1 to 1000: m and mm"),
    (two(), two(xyz="0 0 200"), "joint j / origin / xyz jumps from 0.2 to 200: m and mm"),
    (two(shape=BOX), two(shape=LARGE),
     "visual 1 / geometry / size jumps from 0.1 to 100 (and 2 more like it): m and mm"),
    (two(limit(effort=20)), two(limit(effort=40)), ""),
    (two(limit(effort=0)), two(limit(effort=40)), ""),
])  # fmt: skip
def test_the_ratio_of_two_units_is_told(old: list[str], new: list[str], words: str) -> None:
    found = [one.message for one in find_jumps(version(*old), version(*new), {})]
    ending = words.replace(":", ", by the ratio of")
    assert [message.endswith(ending) for message in found] == [True] * bool(words)


def test_a_jump_back_does_not_blame_the_exporter() -> None:
    """Nobody knows which of two numbers is right: the advice is for the case that the new one is wrong."""
    for old, new in ((1.0, 2000.0), (2000.0, 1.0)):
        (mass,) = find_jumps(version(link("base", old)), version(link("base", new)), {})
        (place,) = find_jumps(version(*two(xyz=f"0 0 {old / 1000}")), version(*two(xyz=f"0 0 {old}")), {})
        assert all(found.hint.startswith("if the new one is wrong, check") for found in (mass, place))


def test_a_lost_inertial_is_told() -> None:
    bare = [two()[0], f'<link name="arm">{BOX}</link>', two()[2]]
    (found,) = find_jumps(version(*two(shape=BOX)), version(*bare), {})
    assert (found.code, found.message) == ("inertial-lost", "link arm has lost its <inertial>")
