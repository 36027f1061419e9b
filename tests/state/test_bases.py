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


def tree(place: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in (place, *place.rglob("*")) if path.is_file()}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / ".urdfsync/base/arm"
    BaseStore(folder).add(by_hash(TEXT))
    return folder


@given(st.lists(texts), st.lists(texts))
def test_what_is_kept_comes_back_as_long_as_it_is_wanted(first: list[str], more: list[str]) -> None:
    with TemporaryDirectory() as name:
        store = BaseStore(Path(name, ".urdfsync/base/arm"))
        for added in (first, more):
            store.add(by_hash(*added))
        kept = by_hash(*first, *more)
        wanted = dict(list(kept.items())[::3])
        store.prune(wanted.keys())
        for one in (store, BaseStore(Path(name, ".urdfsync/base/arm"))):
            assert {digest: one.get(digest) for digest in wanted} == wanted
            assert sum(digest in one for digest in kept) <= 2 * len(wanted)
        store.prune(())
        assert not Path(name, ".urdfsync/base/arm").exists()


@pytest.mark.parametrize("damage", [b"", b'"another text"', b'"\xff"', b"1", b'"', b'"\\ud800"'])
def test_a_text_counts_only_with_its_own_hash(folder: Path, damage: bytes) -> None:
    (folder / "texts").write_bytes(HASH.encode() + b" " + damage + b"\n")
    assert BaseStore(folder).get(HASH) is None


def test_a_folder_in_the_place_of_the_texts_keeps_none(folder: Path) -> None:
    (folder / "texts").unlink()
    (folder / "texts").mkdir()
    assert BaseStore(folder).get(HASH) is None
    with pytest.raises(OutputError, match="it can't be written"):
        BaseStore(folder).add(by_hash("other"))


def test_of_texts_that_are_too_large_nothing_is_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dependencies, "MAX_FILE", len(TEXT) - 1)
    assert BaseStore(folder).get(HASH) is None


def test_a_text_cut_short_is_lost_and_can_be_added_again(folder: Path) -> None:
    content = (folder / "texts").read_bytes()
    for end in range(len(content)):
        (folder / "texts").write_bytes(content[:end])
        store = BaseStore(folder)
        assert store.get(HASH) is None
        store.add(by_hash(TEXT, "other"))
        assert BaseStore(folder).get(HASH) == TEXT


@pytest.mark.parametrize("place", [".urdfsync", ".urdfsync/base", ".urdfsync/base/arm", ".urdfsync/base/arm/texts"])
def test_no_link_is_followed(folder: Path, tmp_path: Path, place: str) -> None:
    outside = tmp_path / "outside"
    (tmp_path / place).rename(outside)
    (tmp_path / place).symlink_to(outside)
    store, before = BaseStore(folder), tree(outside)
    assert HASH not in store
    with pytest.raises(OutputError, match="arm: error: it can't be written: a symbolic link"):
        store.add(by_hash("other"))
    store.prune(())
    assert tree(outside) == before
