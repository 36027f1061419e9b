"""Numbers in the bytes of a file."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.analysis.patches.literals import find_literals, replaced

FILE = Path("arm.urdf")


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ('xyz="0 -1.5 +2e-3"', ["0", "-1.5", "+2e-3"]),
        ("a='.5' b='5.' c='1E+5'", [".5", "5.", "1E+5"]),
        ("${2*m - 1} ${a-3} ${-4}", ["2", "1", "3", "-4"]),
        ("link2 v1.2.3 0x10 1.5kg 3_000", []),
        ("[1, -2]: {k: 3}", ["1", "-2", "3"]),
        ("a;2;-3.5\r\n", ["2", "-3.5"]),
        ("name;b [kW]\na;2;-3,5\r\n", ["2", "-3,5"]),
        ("a,2,3", ["2", "3"]),
        ('<?xml version="1.0"?><a b="2"/>', ["2"]),
    ],
)
def test_what_a_number_is(text: str, numbers: list[str]) -> None:
    assert [literal.text for literal in find_literals(FILE, text.encode())] == numbers


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le", "utf-32"])
def test_all_other_bytes_stay(encoding: str) -> None:
    text = '<a x="1"/>\r\n<!-- 2 ä -->\r<b y="3"/>\n'
    content = text.encode(encoding)
    literals = find_literals(FILE, content)
    assert [(literal.text, literal.line) for literal in literals] == [("1", 1), ("2", 2), ("3", 2)]
    changed = replaced({FILE: content}, {literals[0]: "10.5", literals[2]: "-4"})
    assert changed == {FILE: text.replace('"1"', '"10.5"').replace('"3"', '"-4"').encode(encoding)}


@pytest.mark.parametrize("content", [b"PK\x03\x04\0\0 1 2", "<a x='1'/>".encode("utf-16")[:-1], b""])
def test_what_is_no_text_has_no_numbers(content: bytes) -> None:
    assert find_literals(FILE, content) == []
