"""A table leaves a TOML file, and what belongs to others stays."""

from __future__ import annotations

import pytest

from urdfsync.project.config.tomlfile import without_table

ONE = "[robots.a]\nb = 1\n"
TWO = "[robots.c]\nd = 2\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (ONE, ""),
        (ONE + TWO, TWO),
        (TWO + ONE, TWO),
        (f"{TWO}\n{ONE}", f"{TWO}"),
        (f"{ONE}\n{TWO}", TWO),
        (f"# head\n\n# of a\n{ONE}# and in a\n\n# of c\n{TWO}", f"# head\n\n# of c\n{TWO}"),
        (f"{ONE}# of c\n{TWO}", f"# of c\n{TWO}"),
        (f"{ONE}\n# stays\n\n{TWO}", f"# stays\n\n{TWO}"),
        (f"{ONE}\ne = 3\n\n{TWO}", TWO),
        (f"{ONE}\n[robots.a.renamed]\ne = 3\n\n{TWO}", TWO),
        (f'[ robots . "a" ] # it\n{TWO}', TWO),
        (f"[robots.ab]\n{TWO}", f"[robots.ab]\n{TWO}"),
        (ONE.replace("\n", "\r\n") + "\r\n" + TWO.replace("\n", "\r\n"), TWO.replace("\n", "\r\n")),
    ],
)
def test_a_table_leaves(before: str, after: str) -> None:
    assert without_table(before, "robots", "a") == after
