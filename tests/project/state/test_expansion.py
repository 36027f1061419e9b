"""The recorded text of an expanded source: it comes back as it was, or not at all."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.project.state.expansion import Expansion, dumps, loads

TEXTS = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\r"))
HASHES = st.dictionaries(TEXTS, st.none() | TEXTS)
ARM = Expansion(source="arm.xacro", files={"arm.xacro": "1", "arm.yaml": "2"}, text="<robot>\n}\n</robot>\n")


@given(
    st.builds(Expansion, format=st.just(1), source=TEXTS, files=HASHES, variables=HASHES, sum=st.just(""), text=TEXTS)
)
def test_it_comes_back(expansion: Expansion) -> None:
    found = loads(dumps(expansion))
    assert found is not None
    assert msgspec.structs.replace(found, sum="") == expansion


@given(st.binary() | TEXTS.map(lambda text: dumps(ARM).replace(b"arm", text.encode(), 1)))
def test_nothing_else_is_an_error(content: bytes) -> None:
    found = loads(content)
    assert found is None or dumps(found) == content


def test_line_ends_make_no_difference() -> None:
    found = loads(dumps(ARM).replace(b"\n", b"\r\n"))
    assert found is not None
    assert dumps(found) == dumps(ARM)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"</robot>", b"</robot>\n<!-- by hand -->"),
        (b'"arm.xacro": "1"', b'"arm.xacro": "1",\n  "arm.xacro": "3"'),  # as git unites two versions
        (b'"source"', b'"format": 2,\n "source"'),
        (b'"source"', b'"sources"'),
        (b"\n}\n", b""),
    ],
)
def test_anything_else_is_none(old: bytes, new: bytes) -> None:
    text = dumps(ARM)
    assert old in text
    assert loads(text.replace(old, new, 1)) is None
