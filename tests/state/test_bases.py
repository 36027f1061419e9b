"""The texts that were written last: they come back as they were, or not at all."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync import dependencies
from urdfsync.diagnostics import OutputError
from urdfsync.files import text_digest
from urdfsync.state.bases import BaseStore

TEXT = "record A\nend A;\n"
HASH = text_digest(TEXT.encode())
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=30)


def by_hash(*kept: str) -> dict[str, str]:
    return {text_digest(text.encode()): text for text in kept}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / ".urdfsync/base/arm"
    BaseStore(folder).add(by_hash(TEXT))
    return folder


@given(st.lists(texts), st.lists(texts))
def test_what_is_kept_comes_back_until_it_is_wanted_no_more(first: list[str], more: list[str]) -> None:
    with TemporaryDirectory() as name:
        store = BaseStore(Path(name, ".urdfsync/base/arm"))
        for added in (first, more):
            store.add(by_hash(*added))
        kept = by_hash(*first, *more)
        for one in (store, BaseStore(Path(name, ".urdfsync/base/arm"))):
            assert {digest: one.get(digest) for digest in kept} == kept
        left = dict(list(kept.items())[::2])
        store.prune(left.keys())
        assert {digest for digest in kept if digest in store} == left.keys()
        store.prune(())
        assert not Path(name, ".urdfsync/base/arm").exists()


@pytest.mark.parametrize("damage", [b"", b"record A\nend A;", b"another text", b"\xff", None])
def test_a_text_counts_only_with_its_own_hash(folder: Path, damage: bytes | None) -> None:
    (folder / HASH).unlink()
    (folder / HASH).mkdir() if damage is None else (folder / HASH).write_bytes(damage)
    assert BaseStore(folder).get(HASH) is None


def test_what_is_no_text_is_lost_even_with_the_right_hash(folder: Path) -> None:
    """A stranger may have committed it."""
    content = b"\xff\xfe"
    (folder / text_digest(content)).write_bytes(content)
    assert BaseStore(folder).get(text_digest(content)) is None


def test_of_a_text_that_is_too_large_no_more_is_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dependencies, "MAX_FILE", len(TEXT) - 1)
    assert BaseStore(folder).get(HASH) is None


@pytest.mark.parametrize("place", [".urdfsync", ".urdfsync/base", ".urdfsync/base/arm"])
def test_no_link_is_followed(folder: Path, tmp_path: Path, place: str) -> None:
    outside = tmp_path / "outside"
    (tmp_path / place).rename(outside)
    (tmp_path / place).symlink_to(outside)
    store, before = BaseStore(folder, lambda path: path.name), sorted(outside.rglob("*"))
    assert HASH not in store
    with pytest.raises(OutputError, match="arm: error: it can't be written: a symbolic link"):
        store.add(by_hash("other"))
    store.prune(())
    assert sorted(outside.rglob("*")) == before
