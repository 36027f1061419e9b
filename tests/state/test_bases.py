"""The texts that were written last: they come back as they were, or not at all."""

from __future__ import annotations

import gzip
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.files import text_digest
from urdfsync.state.bases import Bases, Passage, Stored, dumps

texts = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\r"), max_size=30)


@given(st.lists(texts))
def test_what_is_kept_comes_back(kept: list[str]) -> None:
    by_hash = {text_digest(text.encode()): text for text in kept}
    bases = Bases.loads(dumps(by_hash.items()))
    assert {digest: bases.get(digest) for digest in by_hash} == by_hash


@given(st.lists(texts, unique=True))
def test_the_same_texts_give_the_same_file(kept: list[str]) -> None:
    pairs = [(text_digest(text.encode()), text) for text in kept]
    content = dumps(pairs)
    assert content == dumps(iter(pairs))
    assert json.loads(gzip.decompress(content)) == dict(pairs)


@given(st.lists(texts, min_size=1), st.lists(st.lists(texts, min_size=1), max_size=3))
def test_what_is_added_is_kept_with_the_rest(first: list[str], more: list[list[str]]) -> None:
    by_hash = {text_digest(text.encode()): text for text in first}
    bases = Bases.loads(dumps(by_hash.items()))
    for added in more:
        news = {text_digest(text.encode()): text for text in added}
        by_hash |= news
        bases = bases.plus(news) or Bases.loads(dumps(by_hash.items()))
        for one in (bases, Bases.loads(bases.content)):
            assert {digest: one.get(digest) for digest in by_hash} == by_hash
            assert all(digest in one for digest in by_hash)


def lines(*numbers: int) -> str:
    """A long text that some numbers make another one."""
    return "".join(f"  Real x{line} = {numbers.count(line)};\n" for line in range(500))


def test_of_a_long_text_the_passage_is_kept_that_is_new() -> None:
    kept = [
        lines(),
        *(lines(number) for number in range(100, 110)),
        lines(1, 490),
        lines(*range(500)),
        lines()[:-9],
        "",
    ]
    hashes = [text_digest(text.encode()) for text in kept]
    bases = Bases.loads(dumps([(hashes[0], kept[0]), *((f"{number}", str(number)) for number in range(5000))]))
    sizes = []
    for text, digest, before in zip(kept[1:], hashes[1:], hashes, strict=False):
        more = bases.plus({digest: text}, {digest: before})
        assert more is not None
        sizes.append(len(more.content) - len(bases.content))
        bases = more
        for one in (bases, Bases.loads(bases.content)):
            assert [one.get(digest) for digest in hashes[: len(sizes) + 1]] == kept[: len(sizes) + 1]
    whole = len(dumps([(hashes[0], kept[0])]))
    assert max(sizes[:10]) < whole / 8, "one line"
    assert min(sizes[10:12]) > whole / 2, "nearly all"


@given(texts, texts, texts, texts)
def test_a_passage_gives_the_text_back(start: str, one: str, other: str, end: str) -> None:
    text, whole = start + one + end, start + other + end
    passage = Passage.of(text, "", whole)
    assert passage.text(whole) == text
    assert len(passage.new) <= len(one)


@pytest.mark.parametrize("whole", ["lost", "a passage itself", "another text"])
def test_a_passage_is_nothing_without_its_whole(whole: str) -> None:
    digest, other = text_digest(b"abc"), text_digest(b"axc")
    there: dict[str, Stored] = {"a passage itself": Passage(other, 1, "x", 1), "another text": "ayyyc"}
    bases = Bases({digest: Passage(other, 1, "b", 1)} | ({other: there[whole]} if whole in there else {}))
    assert bases.get(digest) is None
    assert digest in bases


def test_a_file_is_added_to_until_that_is_as_much_as_it_was_first() -> None:
    pairs = [(text_digest(b"%d" % number), str(number)) for number in range(1000)]
    bases: Bases | None = Bases.loads(dumps(pairs[:200]))
    assert bases is not None
    first = old = bases.content
    for number in range(200, 1000, 10):
        if (bases := bases.plus(dict(pairs[number : number + 10]))) is None:
            break
        assert bases.content.startswith(old), "what was there stays as it is"
        old = bases.content
    assert 1.9 * len(first) < len(old) <= 2 * len(first)


def test_a_file_has_not_more_parts_than_can_be_read_quickly() -> None:
    bases: Bases | None = Bases.loads(dumps((text_digest(b"%d" % number), str(number)) for number in range(1000)))
    count = 0
    while bases is not None and (bases := bases.plus({text_digest(b"%d" % count): str(count)})) is not None:
        count += 1
    assert count == 63


def test_nothing_is_added_to_a_file_that_is_lost() -> None:
    assert Bases.loads(b"").plus({text_digest(b"a"): "a"}) is None


def test_nothing_new_leaves_the_file_as_it_is() -> None:
    content = dumps([(text_digest(b"a"), "a")])
    more = Bases.loads(content).plus({})
    assert more is not None
    assert more.content == content


def test_a_file_of_which_a_later_part_is_cut_short_keeps_nothing() -> None:
    one, other = text_digest(b"one"), text_digest(b"other")
    first = dumps((digest, "one") for digest in (one, *map(str, range(99))))
    whole = Bases.loads(first).plus({other: "other"})
    assert whole is not None
    for end in range(len(first) + 1, len(whole.content)):
        kept = Bases.loads(whole.content[:end])
        assert one not in kept
        assert other not in kept


def test_what_is_not_there_is_none() -> None:
    assert Bases({}).get(text_digest(b"a")) is None
    assert Bases.loads(b"").get(text_digest(b"a")) is None


def test_a_text_counts_only_with_its_own_hash() -> None:
    one, two = text_digest(b"one"), text_digest(b"two")
    bases = Bases({one: "two", two: "two"})
    assert bases.get(one) is None
    assert bases.get(two) == "two"


def test_line_endings_do_not_make_another_text() -> None:
    assert Bases({text_digest(b"a\nb\n"): "a\r\nb\r\n"}).get(text_digest(b"a\nb\n")) == "a\r\nb\r\n"


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"[]", b'{"a": 1}', b'{"a": null}', b"\xff\xfe", b'{"a": "\xe9"}', b'{"a": "\\ud800"}', b"[" * 100_000],
    ids=["empty", "cut short", "list", "number", "null", "no text", "no UTF-8", "no character", "deep"],
)
def test_a_damaged_file_keeps_nothing(content: bytes) -> None:
    assert Bases.loads(content).get("a") is None
    assert Bases.loads(gzip.compress(content)).get("a") is None


def test_a_file_that_is_cut_short_keeps_nothing() -> None:
    digest = text_digest(b"a")
    content = dumps([(digest, "a")])
    assert Bases.loads(content).get(digest) == "a"
    assert [Bases.loads(content[:end]).get(digest) for end in range(len(content))] == [None] * len(content)


@given(st.binary(max_size=40))
def test_no_content_is_an_error(content: bytes) -> None:
    for one in (content, gzip.compress(content), gzip.compress(b'{"a": %s}' % content)):
        assert Bases.loads(one).get(text_digest(b"a")) is None
