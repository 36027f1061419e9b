"""Files around a package: each robot adds its own part to what is there when it writes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.files import digest
from urdfsync.planning.shared import Shared, changes
from urdfsync.state.transaction import Change

ORDER = Path("Plant/package.order")
PACKAGE = Path("Plant/package.mo")


def written(files: list[Shared], disk: Mapping[Path, bytes]) -> dict[Path, bytes | None]:
    """What is written, and what every change rests on is what is there."""
    found: list[Change] = list(changes(files, disk.get))
    for change in found:
        there = disk.get(change.path)
        assert change.old == (None if there is None else digest(there))
    return {change.path: change.content for change in found}


def test_a_package_is_made_if_nobody_else_has_made_it() -> None:
    file = Shared(PACKAGE, b"package Plant\nend Plant;\n")
    assert written([file], {}) == {PACKAGE: file.content}
    assert written([file], {PACKAGE: b"package Plant // of another robot\nend Plant;\n"}) == {}


@pytest.mark.parametrize(
    ("text", "result"),
    [
        pytest.param(None, b"Arm\n", id="no file"),
        pytest.param(b"", b"Arm\n", id="empty"),
        pytest.param(b"Arm\n", None, id="already there"),
        pytest.param(b"Leg\n", b"Leg\nArm\n", id="another robot's"),
        pytest.param(b"Leg\r\nMine\r\n", b"Leg\r\nMine\r\nArm\r\n", id="its line endings"),
        pytest.param(b"caf\xe9\n", b"caf\xe9\nArm\n", id="no UTF-8"),
    ],
)
def test_a_name_is_added(text: bytes | None, result: bytes | None) -> None:
    disk = {} if text is None else {ORDER: text}
    assert written([Shared(ORDER, names=("Arm",))], disk) == ({} if result is None else {ORDER: result})


def test_only_our_own_name_is_taken_away() -> None:
    gone = Shared(ORDER, owned=("Arm",))
    assert written([gone], {ORDER: b"Leg\nArm\nMine\n"}) == {ORDER: b"Leg\nMine\n"}
    assert written([gone], {ORDER: b"Leg\n"}) == {}
    assert written([gone], {}) == {}


def test_a_file_with_nothing_left_in_it_goes() -> None:
    assert written([Shared(ORDER, owned=("Arm",))], {ORDER: b"Arm\n"}) == {ORDER: None}


NAMES = st.lists(st.sampled_from("ABCDE"), unique=True, max_size=4)


@given(robots=st.permutations("ABC"), there=st.none() | NAMES.map(lambda names: "".join(f"{n}\n" for n in names)))
def test_robots_may_be_written_in_any_order(robots: list[str], there: str | None) -> None:
    """Every robot planned before any of them wrote; nothing gets lost, and the second time there is nothing to do."""
    files = [[Shared(PACKAGE, b"package Plant\nend Plant;\n"), Shared(ORDER, names=(name,))] for name in robots]
    disk = {} if there is None else {ORDER: there.encode()}
    for part in files:
        disk |= {path: content for path, content in written(part, disk).items() if content is not None}
    names = disk[ORDER].decode().splitlines()
    assert sorted(names) == sorted({*robots, *(there or "").splitlines()})
    assert all(written(part, disk) == {} for part in files)
