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

SNAPSHOT = {"name": "arm", "links": {"b": {"m": 1.0}, "a": {"m": 0.1, "rgba": None}}}
IMPORTS = {"a.stl": Import("Resources/a.stl", "1f", "2f", 4, {"size": [1, 2.5]})}


def test_model_round_trip() -> None:
    model = loads(dumps(of(SNAPSHOT, IMPORTS)), "arm.json")
    assert model.snapshot == SNAPSHOT
    facts = model.imports["a.stl"]
    assert (facts.source_hash, facts.converter, facts.facts) == ("1f", 4, {"size": [1, 2.5]})


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


def test_bases_of_files_that_wait_are_recorded_with_the_model() -> None:
    texts = {"Links/B.mo": "model B\nend B;\n", "Links/A.mo": 'model A "\N{DEGREE SIGN}"\r\nend A;\n'}
    text = dumps(of(SNAPSHOT, IMPORTS, texts))
    assert loads(text, "arm.json").bases == texts
    assert text == dumps(of(SNAPSHOT, IMPORTS, dict(reversed(texts.items()))))
    assert loads(dumps(of(SNAPSHOT, IMPORTS)), "arm.json").bases == {}


def test_a_model_without_bases_is_one_of_an_older_build() -> None:
    assert loads('{"snapshot": {}, "imports": {}}', "arm.json").bases == {}


@pytest.mark.parametrize("bases", ["[]", '{"a": 1}', '{"a": "\\ud800"}'], ids=["list", "number", "no character"])
def test_broken_bases_are_refused(bases: str) -> None:
    with pytest.raises(StateError, match="this is no state of urdfsync"):
        loads(f'{{"snapshot": {{}}, "imports": {{}}, "bases": {bases}}}', "arm.json")


DEEP = '{"snapshot": {"a":' + "[" * 100_000 + "]" * 100_000 + '}, "imports": {}}'


@pytest.mark.parametrize("text", ["", "[]", '{"snapshot": 1}', "<<<<<<< HEAD\n{}\n", DEEP], ids=lambda text: text[:9])
def test_a_broken_model_is_refused(text: str) -> None:
    with pytest.raises(StateError, match=r"arm\.json.*restore it"):
        loads(text, "arm.json")


@pytest.mark.parametrize("number", [0, -1])
def test_a_format_that_never_was_is_refused(number: int) -> None:
    with pytest.raises(StateError, match="there is no format"):
        loads(f'{{"snapshot": {{}}, "imports": {{}}, "format": {number}}}', "arm.json")
