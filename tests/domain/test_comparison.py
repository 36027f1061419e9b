"""Comparing two versions: equality first, deepdiff of the differences, meanings from the domain, and affected files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.domain import (
    ChangeClass,
    ChangeKind,
    Domain,
    ElementKey,
    Features,
    Import,
    Role,
    Snapshot,
    Version,
)
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Changes, by_deepdiff, compare, find_differences, of_leaves

PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 3) | st.floats(-1, 1) | st.text("ab_[]'\"", max_size=3),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text("ab_.'[", max_size=2), inner, max_size=3),
    max_leaves=6,
)


class Shelf:
    """A domain of books on a shelf: everything is a parameter, colours are not modelled."""

    def features(self, snapshot: Snapshot) -> Mapping[ElementKey, Features]:
        return {("book", name): Features({"book": book}, {}) for name, book in snapshot["books"].items()}

    def describe(self, old: Version, new: Version, renames: Mapping[ElementKey, str], _: None) -> Iterator[Change]:
        books = {renames.get(("book", name), name): book for name, book in old.snapshot["books"].items()}
        for difference in find_differences(old, new, {**old.snapshot, "books": books}, new.snapshot):
            if "secret" not in difference.path:
                kind = ChangeClass.UNMODELLED if "colour" in difference.path else ChangeClass.PARAMETER
                yield difference.change(tuple(map(str, difference.path[1:])) or ("shelf",), kind, "mm")


SHELF = cast(Domain, Shelf())


def shelf(**books: Any) -> Version:
    return Version({"name": "shelf", "books": books})


def changes(old: Version, new: Version) -> Changes:
    return compare(old, new, SHELF, None)


def lines(found: Changes) -> list[tuple[str, str, Any, Any]]:
    return [(str(change), str(change.kind), change.old, change.new) for change in found.changes]


def import_(content: str, **facts: Any) -> Import:
    return Import("Resources/a.stl", f"source of {content}", content, facts)


def test_equal_versions_have_no_changes() -> None:
    found = changes(shelf(a={"size": [1, 2]}), shelf(a={"size": [1.0, 2]}))
    assert (found.changes, found.change_class, found.noise) == ((), ChangeClass.NONE, False)


@given(PLAIN, PLAIN, st.data())
def test_what_needs_no_deepdiff_is_found_as_it_would(old: Any, new: Any, data: st.DataObject) -> None:
    new = data.draw(st.sampled_from([new, _with_other_leaves(old, data)]))
    found = of_leaves(("part", "name"), old, new)
    assert found is None or sorted(found, key=repr) == sorted(by_deepdiff(("part", "name"), old, new), key=repr)


def _with_other_leaves(value: Any, data: st.DataObject) -> Any:
    if isinstance(value, dict):
        return {key: _with_other_leaves(item, data) for key, item in value.items()}
    if isinstance(value, list):
        return [_with_other_leaves(item, data) for item in value]
    return data.draw(st.sampled_from([value, None, 1, 2.5, "c"]))


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        pytest.param(
            {"a": {"size": 1}, "b": {"size": 2}}, {"b": {"size": 2}, "c": {"size": 3}},
            [("a", "removed", {"size": 1}, None), ("c", "added", None, {"size": 3})],
            id="what comes and goes is one change",
        ),
        pytest.param(
            {"a": {"size": [1.0, 2.0, 3.0]}}, {"a": {"size": [2.0, 3.0, 3.0, 4.0]}},
            [("a / size / 0", "changed", 1.0, 2.0), ("a / size / 1", "changed", 2.0, 3.0),
             ("a / size / 3", "added", None, 4.0)],
            id="vectors are compared place by place",
        ),
        pytest.param(
            {"a": {"size": 1e-5, "pages": 2}}, {"a": {"size": 2e-5, "pages": 2.0}},
            [("a / size", "changed", 1e-5, 2e-5)],
            id="small numbers differ, and types of numbers do not",
        ),
        pytest.param(
            {"a": {"s": {"kind": "x", "p": 1}}}, {"a": {"s": {"kind": "y", "q": 1}}},
            [("a / s / kind", "changed", "x", "y"), ("a / s / p", "removed", 1, None), ("a / s / q", "added", None, 1)],
            id="mappings with little in common are compared key by key",
        ),
    ],
)  # fmt: skip
def test_differences(old: dict[str, Any], new: dict[str, Any], expected: list[tuple[str, str, Any, Any]]) -> None:
    assert lines(changes(shelf(**old), shelf(**new))) == expected


def test_a_rename_is_one_change_and_the_rest_is_compared_under_the_new_name() -> None:
    found = changes(shelf(a={"size": 7}, c={"size": 1.0}), shelf(b={"size": 7}, c={"size": 2.0}))
    assert found.renames == {("book", "a"): "b"}
    assert lines(found) == [("book a", "renamed", "a", "b"), ("c / size", "changed", 1.0, 2.0)]
    assert found.change_class is ChangeClass.STRUCTURAL


def test_imports_are_compared_by_content_and_facts() -> None:
    old = Version({"books": {}}, {"x": import_("1"), "y": import_("1"), "z": import_("1"), "w": import_("1", size=1)})
    new = Version({"books": {}}, {"v": import_("2"), "y": import_("1"), "z": import_("2"), "w": import_("1", size=2)})
    assert lines(changes(old, new)) == [
        ("v", "added", None, "2"),
        ("w", "changed", "source of 1", "source of 1"),
        ("x", "removed", "1", None),
        ("z", "changed", "1", "2"),
    ]


def test_imports_that_nobody_looked_for_are_not_compared() -> None:
    assert changes(Version({"books": {}}), Version({"books": {}}, {"x": import_("1")})).changes == ()


def test_the_domain_can_leave_a_difference_out() -> None:
    assert changes(shelf(a={"secret": 1}), shelf(a={"secret": 2})).changes == ()


def change(old: Any, new: Any) -> Change:
    return Change(("joint elbow", "origin", "xyz[2]"), ChangeKind.CHANGED, ChangeClass.PARAMETER, old, new, "")


@pytest.mark.parametrize(
    ("old", "new", "noise"),
    [
        (1.0, 1.0 + 1e-6, True),
        (1e-9, 1e-9 + 1e-15, True),
        (1.0, 1.0 + 3e-6, False),
        (1e-5, 2e-5, False),
        (0.0, 1e-17, False),
        (-1e-9, 1e-9, False),
        ("1.0", "1.0000001", False),
        (None, 1.0, False),
        (True, 1, False),
        ([1.0], [1.0000001], False),
    ],
)
def test_noise_is_a_number_that_changed_by_a_millionth_or_less(old: Any, new: Any, noise: bool) -> None:
    assert change(old, new).noise is noise
    assert Changes((change(old, new),)).noise is noise
    assert not Changes((change(old, new), change(1.0, 2.0))).noise


MODEL = Role.MODEL
A, B, C, D = (f"link {name}" for name in "abcd")
