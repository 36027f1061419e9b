"""One part of a row of equal parts is out of the row."""

from __future__ import annotations

import pytest
from support.packages import read
from support.urdfs import joint, limit, link, robot

WHEELS = "wheel_fl wheel_fr wheel_rl wheel_rr".split()
FINGERS = "index_1 middle_1 ring_1 little_1".split()


def told(names: list[str], masses: list[float], efforts: list[float], lengths: list[float] | None = None) -> list[str]:
    """Messages about parts of a base; each part has a joint and a tip behind it."""
    elements = [link("base", 5.0)]
    places = ("0.1 0.1 0", "0.1 -0.1 0", "-0.1 0.1 0", "-0.1 -0.1 0")
    for name, mass, effort, length, xyz in zip(names, masses, efforts, lengths or [0.2] * 4, places, strict=False):
        elements += [link(name, mass), link(f"{name}_tip", 0.2)]
        elements += [joint(f"{name}_j", "revolute", "base", name, xyz=xyz, inside=[limit(effort=effort)])]
        elements += [joint(f"{name}_k", "fixed", name, f"{name}_tip", xyz=f"{length} 0 0")]
    diagnostics = read(robot(*elements).encode()).diagnostics
    return [one.message for one in diagnostics if one.code in ("odd-one-out", "not-mirrored")]


@pytest.mark.parametrize(("names", "masses", "efforts", "words"), [
    (WHEELS, [1, 1, 1, 1], [20, 20, 20, 20], None),
    (WHEELS, [1, 1, 1, 1], [20, 20, 20, 5],
     "joint 'wheel_rr_j' differs from 'wheel_fl_j', 'wheel_fr_j', 'wheel_rl_j': its effort is 5, not 20"),
    (FINGERS, [1, 3, 1, 1], [20, 20, 20, 20],
     "link 'middle_1' differs from 'index_1', 'little_1', 'ring_1': its mass is 3, not 1 kg"),
    (FINGERS, [1, 3, 2, 1], [20, 20, 20, 20], None),  # no row: two are different
    (FINGERS, [1, 1.8, 1, 1], [20, 20, 20, 20], None),
    (FINGERS[:3], [1, 3, 1], [20, 20, 20], None),  # the wheels of a tricycle need not be equal
    (["hip_1", "knee_1", "toe_1"], [1, 3, 1], [20, 20, 20], None),
])  # fmt: skip
def test_the_odd_one_is_told_once(
    names: list[str], masses: list[float], efforts: list[float], words: str | None
) -> None:
    found = told(names, masses, efforts)
    assert found == ([words] if words else [])


def test_parts_of_another_form_are_no_row() -> None:
    assert told(FINGERS, [1, 3, 1, 1], [20] * 4, [0.2, 0.3, 0.2, 0.2]) == []


def test_a_chain_is_no_row() -> None:
    joints = [joint(f"j{k}", "revolute", f"link_{k}", f"link_{k + 1}", inside=[limit(effort=100 if k < 3 else 10)])
              for k in range(4)]  # fmt: skip
    text = robot(*(link(f"link_{k}", 1.0) for k in range(5)), *joints)
    assert [one.code for one in read(text.encode()).diagnostics] == []
