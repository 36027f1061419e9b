"""The texts of a package: what is stale is rendered, once, and whatever else can be told without is not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from urdfsync.diff.changes import stale_files
from urdfsync.domain import Artifact, Role, Templates
from urdfsync.files import text_digest
from urdfsync.plan import FileRecord, State
from urdfsync.planning.generate import Generated
from urdfsync.planning.outputs import Outputs
from urdfsync.state.bases import Bases


class Package(Generated):
    """A package whose texts are made of path and data, and which says what was rendered."""

    def __init__(self, **numbers: int) -> None:
        super().__init__([_artifact(path, number) for path, number in numbers.items()], Templates((Path(),), ""))
        self.rendered: list[str] = []

    def content(self, path: str) -> bytes:
        self.rendered.append(path)
        return _text(path, self.artifacts[path].data["number"]).encode()


def _artifact(path: str, number: int) -> Artifact:
    return Artifact(path, Role.RECORD, "record.mo.jinja", {"number": number}, f"part {path}")


def _text(path: str, number: int) -> str:
    return f"record {path}\n  Real x = {number};\nend {path};\n"


def _hash(path: str, number: int) -> str:
    return text_digest(_text(path, number).encode())


def _record(path: str, number: int, state: State = State.GENERATED) -> dict[str, FileRecord]:
    return {path: FileRecord(f"part {path}", Role.RECORD, _hash(path, number), state)}


def _outputs(
    now: Generated,
    last: Generated | None = None,
    records: Mapping[str, FileRecord] | None = None,
    *,
    bases: Sequence[str] = (),
    aside: Mapping[str, str] | None = None,
    disk: Mapping[str, bytes] | None = None,
    older: Sequence[Generated] = (),
    again: bool = False,
) -> Outputs:
    kept = Bases({text_digest(text.encode()): text for text in bases})
    differing = stale_files(last.artifacts if last else {}, now.artifacts).render
    return Outputs(now, last, differing, (records or {}).get, kept, aside or {}, (disk or {}).get, older, again)


def test_what_is_made_of_the_same_data_is_not_rendered() -> None:
    now, last = Package(a=1), Package(a=1)
    outputs = _outputs(now, last, _record("a", 1), bases=[_text("a", 1)])
    assert outputs.digest("a") == _hash("a", 1)
    assert outputs.content("a") == _text("a", 1).encode()
    assert now.rendered == last.rendered == []


def test_the_file_on_disk_serves_if_its_base_is_lost() -> None:
    now = Package(a=1)
    disk = {"a": _text("a", 1).replace("\n", "\r\n").encode()}
    outputs = _outputs(now, Package(a=1), _record("a", 1), disk=disk)
    assert outputs.content("a") == _text("a", 1).encode(), "with its line endings normalised"
    assert now.rendered == []


@pytest.mark.parametrize("disk", [{}, {"a": b"edited"}, {"a": b"\xff"}], ids=["nothing", "edited", "no text"])
def test_without_base_and_file_it_is_rendered(disk: Mapping[str, bytes]) -> None:
    now = Package(a=1)
    assert _outputs(now, Package(a=1), _record("a", 1), disk=disk).digest("a") == _hash("a", 1)
    assert now.rendered == ["a"]


def test_a_text_that_is_kept_under_a_wrong_hash_is_rendered() -> None:
    now = Package(a=1)
    kept = Bases({_hash("a", 1): "somebody else's"})
    outputs = Outputs(now, Package(a=1), frozenset(), _record("a", 1).get, kept, {}, lambda path: None)
    assert outputs.digest("a") == _hash("a", 1)
    assert outputs.content("a") == _text("a", 1).encode()
    assert now.rendered == ["a"]


def test_what_is_made_of_other_data_is_rendered() -> None:
    now = Package(a=2)
    outputs = _outputs(now, Package(a=1), _record("a", 1), bases=[_text("a", 1)])
    assert outputs.digest("a") == _hash("a", 2)
    assert outputs.content("a") == _text("a", 2).encode()


def test_a_file_that_is_new_is_rendered() -> None:
    assert _outputs(Package(a=1, b=1), Package(a=1), _record("a", 1)).digest("b") == _hash("b", 1)


@pytest.mark.parametrize("state", [State.CONFLICT, State.WAITING, State.ORPHAN])
def test_a_base_that_is_older_than_the_last_build_says_nothing_of_it(state: State) -> None:
    """The last build would have written 2, and could not: 1 is what is recorded."""
    outputs = _outputs(Package(a=2), Package(a=2), _record("a", 1, state), bases=[_text("a", 1)])
    assert outputs.digest("a") == _hash("a", 2)


def test_the_base_of_an_edited_file_is_what_the_last_build_generated() -> None:
    now = Package(a=1)
    outputs = _outputs(now, Package(a=1), _record("a", 1, State.EDITED), bases=[_text("a", 1)], disk={"a": b"mine"})
    assert outputs.digest("a") == _hash("a", 1)
    assert now.rendered == []


def test_another_generator_or_a_full_build_renders_everything() -> None:
    for last, again in ((None, False), (Package(a=1), True)):
        now = Package(a=1)
        _outputs(now, last, _record("a", 1), bases=[_text("a", 1)], again=again).digest("a")
        assert now.rendered == ["a"]


def test_a_text_is_rendered_for_its_hash_once() -> None:
    now = Package(a=1)
    outputs = _outputs(now)
    assert outputs.digest("a") == outputs.digest("a")
    assert now.rendered == ["a"]


def test_generates() -> None:
    outputs = _outputs(Package(a=1))
    assert outputs.generates("a", _hash("a", 1))
    assert not outputs.generates("a", _hash("a", 2))
    assert not outputs.generates("b", _hash("b", 1))


OLD = _text("a", 1)
SOURCES: Mapping[str, Mapping[str, object]] = {
    "kept": {"bases": [OLD]},
    "on disk": {"disk": {"a": OLD.encode()}},
    "recorded with the model": {"aside": {"elsewhere": OLD}},
    "rendered from the last model": {"last": Package(a=1)},
    "rendered from the model of one side of a merge": {"older": [Package(b=5), Package(a=1)]},
}


@pytest.mark.parametrize("source", SOURCES.values(), ids=SOURCES)
def test_what_was_written_last_comes_from(source: Mapping[str, object]) -> None:
    assert _outputs(Package(a=2), **source).base("a", _hash("a", 1)) == OLD  # type: ignore[arg-type]


def test_what_was_written_last_may_be_what_is_generated_now() -> None:
    assert _outputs(Package(a=1)).base("a", _hash("a", 1)) == OLD


def test_a_base_is_never_a_guess() -> None:
    wrong = _outputs(
        Package(a=2), Package(a=3), disk={"a": b"mine"}, aside={"a": "other"}, bases=["third"], older=[Package(a=4)]
    )
    assert wrong.base("a", _hash("a", 1)) is None
    assert wrong.base("never generated", _hash("a", 1)) is None
