"""Bodies that cannot be: each has one finding that says why, and what would fit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support.packages import read
from support.urdfs import joint, link, robot

from urdfsync.domain import Import, Version
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.meshes.lookup import key
from urdfsync.formats.urdf.robot import Mesh


def inertial(mass: float, *tensor: float) -> str:
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    numbers = " ".join(f'{name}="{value!r}"' for name, value in zip(names, tensor, strict=True))
    return f'<link name="a"><inertial>\n<mass value="{mass!r}"/>\n<inertia {numbers}/></inertial></link>'


TRIANGLE, NEGATIVE = "inertia-triangle", "inertia-not-positive"


@pytest.mark.parametrize(
    ("mass", "tensor", "finding"),
    [
        (0, (0, 0, 0, 0, 0, 0), ""),
        (1, (1, 0, 0, 1, 0, 2), ""),
        (1, (1, 0, 0, 1, 0, 2.000001), ""),
        (1, (1, 0, 0, 1, 0, 2.1), TRIANGLE),
        (1, (1e-9, 0, 0, 1e-9, 0, 2.1e-9), TRIANGLE),
        (1, (1, 2, 0, 1, 0, 1), NEGATIVE),
        (1, (-1, 0, 0, -1, 0, -1), NEGATIVE),
        (1, (1, 0, 0, 1, 0, 0), ""),
        (1, (0, 2e-20, 0, 0, 0, 1e-18), ""),  # a point mass, but for rounding
        (0, (0, 2e-20, 0, 0, 0, 1e-18), NEGATIVE),
    ],
)
def test_mass_properties(mass: float, tensor: tuple[float, ...], finding: str) -> None:
    diagnostics = read(robot(inertial(mass, *tensor)).encode()).diagnostics
    assert [(one.code, one.line, one.element) for one in diagnostics] == (
        [(finding, 5, "link a / inertial / inertia")] if finding else []
    )


@pytest.mark.parametrize(("tensor", "words"), [
    ((1.5, 0, 0, 1.2, 0, 1676.359), "izz = 1.67636 instead of 1676.36 would fit"),
    ((0.01, -0.3, 0, 0.012, 0, 0.01), "ixy = -0.003 instead of -0.3 would fit"),
    ((1, 0, 0, 1, 0, 2.1), ""),
    ((1.5, 0, 0, 1e-6, 0, 1.6), ""),
])  # fmt: skip
def test_a_missing_point_in_an_inertia_is_told(tensor: tuple[float, ...], words: str) -> None:
    (told,) = read(robot(inertial(1, *tensor)).encode()).diagnostics
    assert told.message.endswith(words or "kg·m², and the greatest exceeds the sum of the others")


SQUARE, MIXED = st.floats(0, 10), st.floats(-3, 3)


@given(st.tuples(SQUARE, MIXED, MIXED, SQUARE, MIXED, SQUARE))
def test_no_body_has_negative_moments_or_one_that_exceeds_the_sum_of_the_others(tensor: tuple[float, ...]) -> None:
    xx, xy, xz, yy, yz, zz = tensor
    low, middle, high = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    assume(min(abs(low), abs(low + middle - high)) > 2e-6 * max(high, 1e-3))
    codes = "".join(one.code for one in read(robot(inertial(0, *tensor)).encode()).diagnostics)
    assert codes == (NEGATIVE if low < 0 else TRIANGLE if low + middle < high else "")


BASE = link("base", 4.0)
TURN = joint("j", "revolute", "base", "arm", axis="0 0 1")


def body(mass: float, center: str, tensor: tuple[float, float, float], shape: str, place: str = "0 0 0") -> str:
    xx, yy, zz = tensor
    inertia = f'<inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><origin xyz="{center}"/><mass value="{mass}"/>{inertia}</inertial>'
    return f'<link name="arm">{inertial}<visual><origin xyz="{place}"/><geometry>{shape}</geometry></visual></link>'


ROD = '<box size="0.04 0.04 0.6"/>'
"""Of 3 kg; its centre is 0.3 m above the joint: about its centre 0.0904 kg·m², about the joint 0.3604 kg·m²."""


@pytest.mark.parametrize(("tensor", "is_told"), [
    ((0.0904, 0.0904, 0.0008), False),
    ((0.3604, 0.3604, 0.0008), True),
    ((0.2, 0.2, 0.0008), False),
])  # fmt: skip
def test_an_inertia_about_the_frame_of_the_link_is_told(tensor: tuple[float, float, float], is_told: bool) -> None:
    text = robot(BASE, body(3, "0 0 0.3", tensor, ROD, "0 0 0.3"), TURN)
    told = [one.message for one in read(text.encode()).diagnostics if one.code == "inertia-shape"]
    assert [message.partition(": ")[2] for message in told] == (
        ["the inertia fits the shapes about the link's origin, not about the centre of mass"] if is_told else []
    )


def test_a_small_collision_shape_tells_no_density() -> None:
    ball = "<collision><geometry><sphere radius='0.02'/></geometry></collision></link>"
    arm = body(2.0, "0 0 0", (0.002, 0.002, 0.002), '<box size="0.1 0.1 0.1"/>').replace("</link>", ball)
    assert [one.code for one in read(robot(BASE, arm, TURN).encode()).diagnostics] == []


@pytest.mark.parametrize(("mass", "facts", "codes"), [
    (2.0, {"bounds": [[0, 0, 0], [0.1, 0.1, 0.1]], "volume": 0.0008}, []),
    (42.0, {"bounds": [[0, 0, 0], [0.1, 0.1, 0.1]], "volume": 0.0008}, ["density"]),
    (42.0, {"bounds": [[0, 0, 0], [0.1, 0.1, 0.1]], "volume": 0.0}, []),  # an open mesh has no volume
    (42.0, {}, []),
    (0.06, {"bounds": [[0, 0, 0], [0.5, 0.5, 0.5]], "volume": 0.1}, ["density"]),
    (2.0, {"bounds": [[400, 0, 0], [400.1, 0.1, 0.1]], "volume": 0.0008}, ["center-of-mass"]),
])  # fmt: skip
def test_an_imported_mesh_tells_the_size_of_its_body(mass: float, facts: dict[str, object], codes: list[str]) -> None:
    mesh = '<mesh filename="package://p/arm.stl"/>'
    moment = 0.002 * mass
    snapshot = read(robot(BASE, body(mass, "0.05 0.05 0.05", (moment,) * 3, mesh), TURN).encode()).snapshot
    imports = {key(Mesh("package://p/arm.stl")): Import("Resources/arm.stl", "", "", facts)}
    told = DOMAIN.judgements.judge(Version(snapshot, imports))
    assert sorted(one.code for one in told) == codes
