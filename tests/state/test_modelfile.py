"""The recorded model: what comes back is what was written, whatever was known of its elements before."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import
from urdfsync.state.modelfile import Model, dumps, loads, of

names = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12)


data = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**53), 2**53) | st.floats(allow_nan=False, allow_infinity=False) | names,
    lambda inner: st.lists(inner, max_size=3).map(tuple) | st.dictionaries(names, inner, max_size=3),
    max_leaves=8,
)
snapshots = st.dictionaries(names, data, max_size=3)
plain_snapshots = snapshots.map(lambda snapshot: json.loads(json.dumps(snapshot, sort_keys=True)))


@given(
    st.builds(
        of,
        plain_snapshots,
        st.dictionaries(names, st.builds(Import, names, names, names, st.integers(0, 9), snapshots), max_size=2),
        st.dictionaries(names, names, max_size=2),
        st.none() | plain_snapshots,
    )
)
def test_a_model_that_comes_back_is_known_before(model: Model) -> None:
    again = loads(dumps(model), "arm.json")
    assert repr(again) == repr(model), "in the same order, too, and with the same kinds of numbers"


DEEP = '{"snapshot": {"a":' + "[" * 100_000 + "]" * 100_000 + '}, "imports": {}}'
EMPTY = '{{"snapshot": {{}}, "imports": {{}}, {}}}'.format
BASES = [EMPTY(f'"bases": {bases}') for bases in ("[]", '{"a": 1}', '{"a": "\\ud800"}')]

FORMATS = [EMPTY(f'"format": {number}') for number in (0, -1)]


@pytest.mark.parametrize(
    "text", ["", "[]", '{"snapshot": 1}', "<<<<<<< HEAD\n{}\n", DEEP, *BASES, *FORMATS], ids=lambda text: text[:50]
)
def test_a_broken_model_is_refused(text: str) -> None:
    with pytest.raises(StateError, match=r"arm\.json.*restore it"):
        loads(text, "arm.json")
