"""The known name that somebody may have meant."""

from __future__ import annotations

import pytest

from urdfsync.spelling import nearest


@pytest.mark.parametrize(
    ("name", "known", "likeness", "meant"),
    [
        ("forarm", ["arm", "forearm", "hand"], 0.6, "forearm"),
        ("wheel", ["arm", "forearm", "hand"], 0.6, ""),
        ("arm", ["forearm"], 0.6, "forearm"),
        ("arm", ["forearm"], 0.7, ""),
        ("arm", [], 0.6, ""),
    ],
)
def test_the_most_like_is_proposed_if_it_is_like_enough(
    name: str, known: list[str], likeness: float, meant: str
) -> None:
    assert nearest(name, known, likeness) == meant
