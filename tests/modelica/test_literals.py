"""Values as Modelica source: what is read back is what was written, and no text can end its literal."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from urdfsync.modelica.literals import html, matrix, numbers_only, real, string, vector

NUMBER = re.compile(r"-?[0-9]+(\.[0-9]*)?([eE][+-]?[0-9]+)?", re.ASCII)
"""A sign and UNSIGNED-NUMBER of the Modelica language specification 3.6, section 2.4.1."""
ESCAPES = {"n": "\n", "r": "\r", "t": "\t", '"': '"', "\\": "\\"}
HARMFUL = "\0\x08\x1b\x7f\x85\u2028\u202e\u2066\ufeff\ud800\uffff"
"""Of each kind of character that becomes a space, one."""

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
TEXTS = st.text(st.characters() | st.sampled_from("\"\\\n\r\t'<>&;/*" + HARMFUL))


def read_string(literal: str) -> str:
    """What a Modelica compiler reads: STRING of the language specification 3.6, section 2.4.4. Fails if it is none."""
    assert literal[0] == '"'
    read, position = "", 1
    while literal[position] != '"':
        if literal[position] == "\\":
            position += 1
            read += ESCAPES[literal[position]]
        else:
            read += literal[position]
        position += 1
    assert position == len(literal) - 1, "the string ends before its literal does"
    return read


@given(FLOATS)
@example(5e-324)
@example(-1.7976931348623157e308)
@example(1e22)
@example(0.1 + 0.2)
def test_a_number_reads_back_bit_by_bit(value: float) -> None:
    """Without point or exponent, it fits every tool's integers."""
    literal = real(value)
    assert not literal.lstrip("-").isdigit() or abs(int(literal)) < 2**31
    assert NUMBER.fullmatch(real(value))
    assert float(real(value)).hex() == (value + 0.0).hex()  # -0.0 + 0.0 is 0.0: zero has no sign


@pytest.mark.parametrize(("value", "literal"), [
    (1.0, "1"),
    (-0.0, "0"),
    (0.1, "0.1"),
    (-1e-7, "-1e-07"),
    (1e22, "1e+22"),
    (2147483647.0, "2147483647"),
    (2147483648.0, "2147483648.0"),
    (-2147483648.0, "-2147483648.0"),
])  # fmt: skip
def test_numbers_look_as_people_write_them(value: float, literal: str) -> None:
    assert real(value) == literal


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_has_no_literal_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="no Modelica literal"):
        real(value)


def test_vectors_and_matrices() -> None:
    assert vector((1.0, -0.5, 2e-9)) == "{1, -0.5, 2e-09}"
    assert vector((255, 105, 180)) == "{255, 105, 180}"
    assert matrix([(1, 2), (2, 3)], 2) == "[1, 2; 2, 3]"
    assert matrix([], 2) == "fill(0, 0, 2)"
    with pytest.raises(ValueError, match="empty"):
        vector(())


@given(TEXTS)
@example('a"b')
@example("ends with a backslash\\")
@example('"; end x; //')
@example("no\u00a0break, \u200b\U0001f9be and \u4e2d\u6587")
def test_a_string_reads_back_but_for_control_characters(text: str) -> None:
    literal = string(text)
    expected = re.sub(
        f"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069{HARMFUL}]", " ", text
    )
    expected = re.sub("[\ud800-\udfff\ufffe]", " ", expected)
    assert read_string(literal) == expected
    assert literal.splitlines() == [literal], "a literal is one line, for every reader of lines"
    assert literal.encode("utf-8").decode("utf-8") == literal


@given(TEXTS)
def test_html_shows_the_text_and_adds_no_markup(text: str) -> None:
    inside = html(text)
    assert not re.search('[<>"\n\r]', inside)
    assert not re.search("&(?!(amp|lt|gt|quot);)", inside)
    shown = read_string(f'"{inside}"')
    for entity, character in (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&amp;", "&")):
        shown = shown.replace(entity, character)
    assert shown == read_string(string(text))


RECORD = """\
record ArmParameters "Robot \\"arm\\" 1"
  parameter Real m = 1.5e-3 "Mass";
  parameter Real r[3] = {0, -0.1, .5};
  parameter Real upper = Modelica.Constants.inf;
end ArmParameters;
"""


@pytest.mark.parametrize(("old", "new", "same"), [
    ("1.5e-3", "-7", True),
    ("-0.1", "0.25E+4", True),
    ("Modelica.Constants.inf", "-3.2", True),
    ('"Robot \\"arm\\" 1"', '"anything; 2"', True),
    ("{0, -0.1, .5}", "{0, -0.1}", False),
    ("r[3]", "r2[3]", False),
    ("upper", "lower", False),
    ("parameter Real m = 1.5e-3", "parameter Real m", False),
])  # fmt: skip
def test_texts_that_differ_in_literals_only(old: str, new: str, same: bool) -> None:
    assert numbers_only(RECORD, RECORD.replace(old, new)) is same
