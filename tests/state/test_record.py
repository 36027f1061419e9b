"""The base of a file follows from its hashes."""

from __future__ import annotations

import pytest

from urdfsync.domain import Role
from urdfsync.state.record import FileRecord, role_of


@pytest.mark.parametrize(
    ("hashes", "mine", "generated", "base"),
    [
        ((), "a", "a", None),
        (("a",), "a", "b", "a"),
        (("a",), "edited", "a", "a"),
        (("a", "b"), "b", "a", "b"),
        (("a", "b"), "edited", "a", "b"),
        (("a", "b"), "edited", "b", "a"),
        (("a", "b"), None, "c", "a"),
        (("a", "b"), object(), None, "a"),
    ],
)
def test_the_base_of_an_edited_file_is_ambiguous_where_git_united_two(
    hashes: tuple[str, ...], mine: object, generated: str | None, base: str | None
) -> None:
    record = FileRecord(hashes)
    assert record.base(mine, generated) == base
    assert record.is_ambiguous == (len(hashes) > 1)


def test_a_file_that_nothing_generates_has_its_role_by_its_path() -> None:
    roles = {"Resources/tip.stl": Role.IMPORT, "Links/package.mo": Role.PACKAGE, "package.mo": Role.PACKAGE}
    roles |= {"Links/Tip.mo": Role.RECORD, "Links/Resources/Tip.mo": Role.RECORD}
    assert {path: role_of(path) for path in roles} == roles
