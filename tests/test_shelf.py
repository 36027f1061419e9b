"""Contents on a shelf: each comes back as it was, in whatever order they are taken."""

from __future__ import annotations

import pickle
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.files import digest
from urdfsync.shelf import Shelf, Shelved

SIZES = st.lists(st.sampled_from([0, 1, 32_767, 32_768, 400_000, 1_048_576, 1_048_577]), max_size=12)


def filled(sizes: list[int]) -> tuple[Shelf, dict[str, bytes]]:
    shelf, contents = Shelf(), {f"{n}.mo": bytes([n]) * size for n, size in enumerate(sizes)}
    for name, content in contents.items():
        shelf.put(name, content)
    return shelf, contents


@given(SIZES, st.randoms(use_true_random=False))
def test_every_content_comes_back_in_any_order(sizes: list[int], random: Random) -> None:
    shelf, contents = filled(sizes)
    for name in random.choices(list(contents), k=2 * len(contents)) if contents else ():
        assert shelf.get(name) == contents[name]


def test_what_is_put_there_later_comes_back_as_well() -> None:
    shelf = Shelf()
    for number in range(40):
        content = bytes([number]) * 50_000
        shelf.put(f"{number}", content)
        assert shelf.get(f"{number}") == content
        assert shelf.get("0") == bytes(50_000)


def test_only_what_was_put_there_is_there() -> None:
    shelf, _ = filled([1])
    assert "0.mo" in shelf
    assert "1.mo" not in shelf
    with pytest.raises(KeyError):
        shelf.get("1.mo")


def test_texts_that_resemble_each_other_take_little_room() -> None:
    shelf = Shelf()
    for number in range(2000):
        shelf.put(f"{number}.mo", b"model Link%d\n" % number + b"  Real x;\n" * 200)
    assert len(pickle.dumps(shelf)) < 1.2 * 2**20  # of 4 MB


def test_a_shelved_content_goes_to_other_processes_with_its_shelf() -> None:
    shelf, contents = filled([40_000, 1_048_576, 10])
    for name, content in contents.items():
        sent = pickle.loads(pickle.dumps(Shelved(shelf, name, digest(content))))
        assert (sent.read(), sent.hash) == (content, digest(content))
