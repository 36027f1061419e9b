"""Slow cases of hypothesis: fixed cases, or as many fresh cases as `URDFSYNC_CASES` says."""

from __future__ import annotations

import os
from collections.abc import Iterable
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from support import robots

CASES = int(os.environ.get("URDFSYNC_CASES", "0"))


def often(cases: int) -> settings:
    """Settings of a test that runs so many cases, or more if the environment says so."""
    return settings(max_examples=max(cases, CASES), suppress_health_check=list(HealthCheck))


def sampled(cases: Iterable[Any], every: int) -> list[Any]:
    """Slow cases as parameters; CI runs one in `every` of them, the others are marked `large`."""
    return [pytest.param(case, marks=[pytest.mark.large] if n % every else []) for n, case in enumerate(cases)]


def seldom(draw: st.DrawFn) -> bool:
    """True in one of ten cases."""
    return draw(st.integers(0, 9)) == 9


def small_robot(random: Random) -> str:
    """A valid robot of one to seven links, with a random part of all that a URDF can express."""
    return robots.urdf(robots.dressed(robots.random_robot(random), random))


SMALL_ROBOTS = st.randoms(use_true_random=False).map(small_robot)


@st.composite
def damaged(draw: st.DrawFn, content: bytes) -> bytes:
    """Bytes with noise: some pieces are replaced, removed, repeated or inserted, or the end is cut off."""
    for _ in range(draw(st.sampled_from((1, 1, 3, 20)))):
        at, size = draw(st.integers(0, len(content))), draw(st.sampled_from((0, 1, 4, 100)))
        noise = st.binary(max_size=8) | st.sampled_from((b"\0", b"\n", b"\r", b"\x1b", b'"', b"<", b"\x7f", b"\xff"))
        middle = draw(noise | st.just(content[at : at + size] * 3))
        content = content[:at] + middle + (b"" if seldom(draw) else content[at + size :])
    return content
