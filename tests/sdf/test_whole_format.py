"""Every element and attribute of SDF is translated, or a finding names it, or docs/sdf.md says that it never acts."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path

import pytest
from support.sdf_walk import every_entry, judge

_PAGE = Path(__file__).parents[2] / "docs" / "sdf.md"


def rows(heading: str) -> list[str]:
    """Return the elements that the first column of a table of the page names."""
    section = _PAGE.read_text().partition(f"## {heading}\n")[2].partition("\n## ")[0]
    first_cells = (line.split("|")[1] for line in section.splitlines() if line.startswith("|"))
    return [name for cell in first_cells for name in re.findall("`(.*?)`", cell)]


def matching(path: str, names: Collection[str]) -> list[str]:
    """Return the names that stand in a path, such as `link/pose` in `model/link/pose@degrees`."""
    return [name for name in names if re.search(rf"(^|[/@]){re.escape(name)}($|[/@])", path)]


@pytest.mark.slow
def test_every_element_and_attribute_is_translated_or_told() -> None:
    left_out, counted, never = map(rows, ("What is left out", "What is counted", "What never acts"))
    quiet, used = list[str](), set[str]()
    for entry in every_entry():
        verdict = judge(entry)
        used |= {*(acting := matching(entry.path, left_out))}
        if acting and not verdict.is_told:
            quiet.append(entry.path)
        elif verdict.is_translated or verdict.is_told:
            continue
        else:
            named, idle = matching(entry.path, counted), matching(entry.path, never)
            used |= {*named, *idle}
            quiet += [] if idle or (named and verdict.is_counted) else [entry.path]
    assert quiet == []
    assert {*left_out, *counted, *never} == used
