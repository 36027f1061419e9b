"""The roles of recorded files."""

from __future__ import annotations

from urdfsync.domain import Role
from urdfsync.project.state.record import role_of


def test_a_file_that_nothing_generates_has_its_role_by_its_path() -> None:
    roles = {"Resources/tip.stl": Role.IMPORT, "Links/package.mo": Role.PACKAGE, "package.mo": Role.PACKAGE}
    roles |= {"Links/Tip.mo": Role.RECORD, "Links/Resources/Tip.mo": Role.RECORD}
    assert {path: role_of(path) for path in roles} == roles
