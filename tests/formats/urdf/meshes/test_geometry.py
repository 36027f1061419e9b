"""Moving and measuring triangles, and the points on which a body stands."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.formats.urdf.meshes.geometry import Array, bounds, support_points

coordinates = st.integers(-1000, 1000).map(lambda number: number / 100)
clouds = st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=60).map(np.array)


def _rims(radius: float, width: float, segments: int, phase: float = 0.0) -> Array:
    """The rims of a wheel that turns about y, and the middles of its sides."""
    angles = [phase + 2 * math.pi * n / segments for n in range(segments)]
    rims = [(radius * math.cos(a), y, radius * math.sin(a)) for a in angles for y in (-width / 2, width / 2)]
    return np.array([*rims, (0.0, -width / 2, 0.0), (0.0, width / 2, 0.0)])


@pytest.mark.parametrize("segments", [36, 48, 72, 100, 360, 20000])
@pytest.mark.parametrize("phase", [0.0, 0.01])
def test_wheel_keeps_both_rims(segments: int, phase: float) -> None:
    hull = np.array(support_points(_rims(0.1, 0.04, segments, phase)))
    for side in (-0.02, 0.02):
        rim = hull[hull[:, 1] == side]
        assert len(rim) >= 36
        assert np.hypot(rim[:, 0], rim[:, 2]).min() > 0.1 - 1e-6
        assert abs(np.hypot(rim[:, 0], rim[:, 2]).max() - 0.1) < 1e-6
    assert len(hull) <= 128


def test_box_keeps_its_corners_only_however_fine_its_faces_are() -> None:
    steps = np.linspace(-1.0, 1.0, 61)
    faces = [np.roll((side, a, b), axis) for side in (-1, 1) for a in steps for b in steps for axis in range(3)]
    corners = sorted([0.5 * x, 1.0 * y, 2.0 * z] for x, y, z in itertools.product((-1, 1), repeat=3))
    assert support_points(np.array(faces) * (0.5, 1.0, 2.0)) == corners


def test_points_are_rounded_to_a_micrometre() -> None:
    assert support_points(np.array([[0.12345678, 0.0, -1e-9]])) == [[0.123457, 0.0, 0.0]]


@given(clouds)
def test_support_points_are_sorted_points_of_the_cloud_with_the_same_bounds(cloud: Array) -> None:
    hull = support_points(cloud)
    assert hull == sorted(hull)
    assert {tuple(point) for point in hull} <= {tuple(point) for point in cloud.tolist()}
    assert bounds(np.array(hull)) == bounds(cloud)


@given(clouds, st.randoms(use_true_random=False))
def test_order_and_repetition_of_points_do_not_matter(cloud: Array, random: object) -> None:
    shuffled = list(cloud) * 2
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    assert support_points(np.array(shuffled)) == support_points(cloud)
