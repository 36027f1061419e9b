"""Public reports about exports that no robot could be: what is told about each (reports.txt).

The inputs are our own. `<shape>` stands for an equal visual and collision shape, `diagonal=""` for products of 0.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.packages import read

_TEXT = (Path(__file__).parent / "reports.txt").read_text(encoding="utf-8")
_SHAPE = re.compile(r"<shape>(.*?)</shape>")


def _reports() -> list[tuple[str, list[str], str]]:
    """Each report with what is told about it, and a URDF; `silent` says why nothing is told."""
    found = []
    for section in _TEXT.split("\n== ")[1:]:
        title, *lines = section.splitlines()
        told = [line.removeprefix("=> ") for line in lines if line.startswith("=> ")]
        elements = "\n".join(line for line in lines if not line.startswith("=> "))
        elements = _SHAPE.sub(r"<visual>\1</visual><collision>\1</collision>", elements)
        elements = elements.replace(' diagonal=""', ' ixy="0" ixz="0" iyz="0"')
        found.append((title, told, f'<robot name="reported">\n{elements}\n</robot>'))
    return found


@pytest.mark.parametrize(("told", "urdf"), [pytest.param(*values, id=title) for title, *values in _reports()])
def test_a_reported_export_is_told(told: list[str], urdf: str) -> None:
    reading = read(urdf.encode())
    assert reading.snapshot is not None
    found = [f"{one.code}: {one.element or one.message.partition(':')[0]}" for one in reading.diagnostics]
    assert found == [words for words in told if not words.startswith("silent: ")]


def test_most_reports_are_told() -> None:
    silent = [title for title, told, _ in _reports() if told[0].startswith("silent: ")]
    assert len(_reports()) - len(silent) > 45


NUMBER = re.compile(r'(?<=[" ])-?\d[\d.e-]*(?=[" ])')
EXTREME = st.sampled_from("0 1e200 -1e200 1e308 1e-320 -0 5e-324 1e154 1e-160 123456789 -3 0.5 1e17".split())


@given(st.sampled_from([urdf for _, _, urdf in _reports()]), st.data())
def test_any_numbers_can_be_judged(urdf: str, data: st.DataObject) -> None:
    places = data.draw(st.lists(st.sampled_from(list(NUMBER.finditer(urdf))), max_size=6, unique_by=re.Match.start))
    for place in sorted(places, key=re.Match.start, reverse=True):
        urdf = f"{urdf[: place.start()]}{data.draw(EXTREME)}{urdf[place.end() :]}"
    read(urdf.encode())
