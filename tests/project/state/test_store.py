"""The state folder: what it has of a robot, how that gets there, and what in it is the user's."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.networks import BASES, MANIFEST, edit, resistor, run, stored

from urdfsync.project.state.expansion import Expansion, dumps
from urdfsync.project.state.store import Aside, Store, saved_name


def test_bases_follow_the_name_of_their_robot_and_go_with_it(project: Path, execute: Execute) -> None:
    run()
    before = stored()
    edit("urdfsync.toml", "[robots.ladder]", "[robots.filter]")
    run()
    assert stored(Path(".urdfsync/bases/filter")) == before
    assert not BASES.exists()
    execute("remove", "filter", "--yes")
    assert not Path(".urdfsync/bases").exists()


def test_files_for_git_stay_as_the_user_has_them(project: Path) -> None:
    ignore, attributes = Path(".urdfsync/.gitignore"), Path(".urdfsync/.gitattributes")
    run()
    assert "/bases/** merge=union -diff -text linguist-generated\n" in attributes.read_text()
    ignore.write_text(f"{ignore.read_text()}!/notes.txt\n")
    attributes.unlink()
    before = ignore.read_bytes()
    resistor(150)
    run()
    assert ignore.read_bytes() == before
    assert attributes.exists()


def test_line_ends_of_the_state_do_not_matter_but_it_has_to_be_text(project: Path) -> None:
    run()
    path = Path(MANIFEST)
    edit(path, "\n", "\r\n")
    with unchanged(project):
        assert run().in_step
    path.write_bytes(b"\xff")
    (told,) = run(dry=True).diagnostics
    assert (told.code, told.line) == ("broken-state", 1)
    assert run(dry=True).in_step


@pytest.mark.parametrize("after", [b"new", None], ids=["saved", "deleted"])
def test_what_was_loaded_is_compared_with_what_is_there(tmp_path: Path, after: bytes | None) -> None:
    store = Store(tmp_path)
    state, expanded = store.path("arm"), store.expansion("arm")
    state.parent.mkdir(parents=True)
    state.write_bytes(b"old")
    store.save(state, b"x"), store.save(expanded, b"x")
    hashes = store.hashes()
    assert Store(tmp_path).is_unchanged(hashes)
    expanded.write_bytes(b"made")
    assert not Store(tmp_path).is_unchanged(hashes)
    expanded.unlink()
    state.write_bytes(after) if after else state.unlink()
    assert not Store(tmp_path).is_unchanged(hashes)


def test_a_file_that_has_its_content_is_not_saved(tmp_path: Path) -> None:
    path = tmp_path / "arm.state"
    path.write_bytes(b"a\r\nb\r\n")
    store = Store(tmp_path)
    assert store.save(path, b"a\nb\n") == store.save(tmp_path / "none", None) == []
    assert [change.content for change in store.save(path, b"a\n")] == [b"a\n"]
    assert [change.content for change in store.save(path, None)] == [None]


def test_versions_of_what_conflicts_no_more_go_unless_somebody_has_changed_them(tmp_path: Path) -> None:
    store = Store(tmp_path)
    old, kept, new = (saved_name(f"a-b/{name}.base.mo", name.encode()) for name in "ABC")
    for name, text in {old: "A", kept: "B", f"{kept}.txt": "mine", "a-b/changed.base-12345678.mo": "mine"}.items():
        path = store.conflicts("arm") / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    changes = Store(tmp_path).save_conflicts("arm", {kept: b"B", new: b"C"})
    assert {change.path: change.content for change in changes} == {
        store.conflicts("arm") / old: None,
        store.conflicts("arm") / new: b"C",
    }


def test_robots_are_known_by_states_with_names_that_they_can_have(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert store.names() == []
    store.path("arm").parent.mkdir(parents=True)
    for name in ("leg.state", "arm.state", "my arm.state", "...state", "arm.expanded"):
        (store.path("arm").parent / name).touch()
    assert store.names() == ["arm", "leg"]


def test_what_was_never_written_is_none(tmp_path: Path) -> None:
    store = Store(tmp_path)
    found = store.load_expansion("arm"), store.bases("arm", "a"), store.base("arm", "ab"), store.aside_text("arm", "a")
    assert found == (None,) * 4
    assert store.load("arm") == ((), None)
    assert store.aside("arm") == {}


def test_what_was_put_aside_and_expanded_is_read_again(tmp_path: Path) -> None:
    aside = {"Links/a.mo": Aside("Links/a.1.mo", "0" * 16, {"1" * 16: "base"})}
    expanded = Expansion(source="arm.xacro", text="<robot/>")
    for change in (
        *Store(tmp_path).save_aside("arm", aside, {"Links/a.1.mo": b"mine"}),
        *Store(tmp_path).save(Store(tmp_path).expansion("arm"), dumps(expanded)),
    ):
        change.path.parent.mkdir(parents=True, exist_ok=True)
        change.path.write_bytes(change.content or b"")
    store = Store(tmp_path)
    assert store.aside("arm") == aside
    assert store.aside_text("arm", "Links/a.1.mo") == b"mine"
    loaded = store.load_expansion("arm")
    assert loaded is not None
    assert (loaded.source, loaded.text) == ("arm.xacro", "<robot/>")
    assert store.save_aside("arm", aside, {}) == []
    assert [change.content for change in store.save_aside("arm", {}, {})] == [None]
