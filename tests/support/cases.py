"""Cases of hypothesis that take time: the same ones each time, or as many fresh ones as `URDFSYNC_CASES` says."""

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
    """Settings of a test that runs so many cases, or as many as the environment says."""
    return settings(max_examples=max(cases, CASES), suppress_health_check=list(HealthCheck))


def sampled(cases: Iterable[Any], every: int) -> list[Any]:
    """Cases that take long as parameters, of which CI runs one of so many: the others are marked as `large`."""
    return [pytest.param(case, marks=[pytest.mark.large] if n % every else []) for n, case in enumerate(cases)]


def seldom(draw: st.DrawFn) -> bool:
    """True in one of ten cases."""
    return draw(st.integers(0, 9)) == 9


def small_robot(random: Random) -> str:
    """A right robot of one to seven links, with some of all that a URDF may say."""
    return robots.urdf(robots.dressed(robots.random_robot(random), random))


SMALL_ROBOTS = st.randoms(use_true_random=False).map(small_robot)


@st.composite
def damaged(draw: st.DrawFn, content: bytes) -> bytes:
    """Bytes with noise: pieces that are replaced, gone, repeated or put in, or all cut off."""
    for _ in range(draw(st.sampled_from((1, 1, 3, 20)))):
        at, size = draw(st.integers(0, len(content))), draw(st.sampled_from((0, 1, 4, 100)))
        noise = st.binary(max_size=8) | st.sampled_from((b"\0", b"\n", b"\r", b"\x1b", b'"', b"<", b"\x7f", b"\xff"))
        middle = draw(noise | st.just(content[at : at + size] * 3))
        content = content[:at] + middle + (b"" if seldom(draw) else content[at + size :])
    return content
