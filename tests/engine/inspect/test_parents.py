"""The packages around a generated one: what has to be there, and what is written beside the robot's own files."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.networks import edit, failure, kinds, make_parent, run, said, set_keys

from urdfsync.commands import cli
from urdfsync.engine.actions import Reason
from urdfsync.engine.inspect.parents import check, merge_order
from urdfsync.project import config


def package(folder: Path, order: str | None = None) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f"package {folder.name}\n  model Inner end Inner;\nend {folder.name};\n")
    if order is not None:
        (folder / "package.order").write_text(order)
    return folder


def test_the_library_is_hidden_by_nobody_but_builds_its_own_examples(project: Path) -> None:
    edit("urdfsync.toml", '"Ladder"', '"UrdfSync.Ladder"\ncreate_parents = true')
    assert failure() == (
        "urdfsync.toml:3: error: robot `ladder`: `UrdfSync` is the library that models need; a package of that name "
        "would hide it; choose another top-level package than `UrdfSync` [modelica-name]"
    )
    package(project / "modelica/UrdfSync", "Examples\n")
    examples = package(project / "modelica/UrdfSync/Examples", "")
    edit("urdfsync.toml", "UrdfSync.Ladder", "UrdfSync.Examples.Ladder")
    run()
    assert (examples / "package.order").read_text() == "Ladder\n"
    loaded = config.load(Path("urdfsync.toml"))
    assert check(loaded, loaded.robots[0], [("UrdfSync", "1")]).diagnostics == (), "no library needs itself"


def test_a_build_begins_no_order_file_beside_classes_that_it_does_not_know(project: Path) -> None:
    plant = package(project / "modelica/Plant")
    edit("urdfsync.toml", '"Ladder"', '"Plant.Ladder"')
    assert cli.main(["build", "--quiet"]) == 0
    assert (plant / "Ladder/package.order").exists()
    assert not (plant / "package.order").exists()
    (plant / "package.order").write_text("Inner\n")
    assert cli.main(["build", "--full", "--quiet"]) == 0
    assert (plant / "package.order").read_text() == "Inner\nLadder\n"
    (plant / "package.order").unlink()
    assert cli.main(["build", "--quiet"]) == 0
    assert not (plant / "package.order").exists()
    assert cli.main(["build", "--check"]) == 0


@pytest.mark.parametrize(("order", "kind"), [("Inner\n", Reason.UPDATE), ("Inner\nFilters\n", None)])
def test_the_order_of_a_package_further_above_is_told_if_it_changes(
    project: Path, order: str, kind: Reason | None
) -> None:
    plant = package(project / "modelica/Plant", order)
    edit("urdfsync.toml", '"Ladder"', '"Plant.Filters.Ladder"\ncreate_parents = true')
    assert kinds(run()).get("modelica/Plant/package.order") is kind
    assert (plant / "package.order").read_text() == "Inner\nFilters\n"


# Lines of `package.order`: ours follow the package, the user's stay


def names_in(text: str) -> list[str]:
    return [line for line in text.splitlines() if line]


@pytest.mark.parametrize(
    ("text", "names", "owned", "merged"),
    [
        pytest.param(None, "BA", "", "B\nA\n", id="a new file"),
        pytest.param("A\nB\n", "AB", "AB", "A\nB\n", id="nothing to do"),
        pytest.param("A\nMine\nB\n", "AB", "AB", "A\nMine\nB\n", id="the user's line stays"),
        pytest.param("A\nC\n", "ABC", "AC", "A\nB\nC\n", id="inserted after its neighbour"),
        pytest.param("B\nMine\n", "AB", "B", "A\nB\nMine\n", id="inserted before its neighbour"),
        pytest.param("Mine\n", "A", "", "Mine\nA\n", id="inserted last without neighbours"),
        pytest.param("Mine\n\n", "A", "", "Mine\nA\n\n", id="inserted before blank lines"),
        pytest.param("A\nMine\nB\n", "B", "AB", "Mine\nB\n", id="our line goes"),
        pytest.param("A\nMine\n", "", "A", "Mine\n", id="the user's line stays alone"),
        pytest.param("A\n", "", "A", "", id="nothing is left"),
        pytest.param("A\nMine\nB\n", "BA", "AB", "B\nMine\nA\n", id="our lines change places"),
        pytest.param("B\nA\n", "ABC", "AB", "B\nC\nA\n", id="the user moved our lines: they stay"),
        pytest.param("A\nB\nA\n", "AB", "AB", "A\nB\n", id="our line was there twice"),
        pytest.param("Mine\nMine\nA\n", "A", "A", "Mine\nMine\nA\n", id="the user's line is there twice"),
        pytest.param("B\r\nC\r\n", "ABC", "BC", "A\r\nB\r\nC\r\n", id="line endings stay"),
        pytest.param("A\nMine", "AB", "A", "A\nB\nMine\n", id="no end of line at the end"),
        pytest.param("A\nMine", "A", "A", "A\nMine", id="no end of line, nothing to do"),
        pytest.param("  A \nMine\n", "A", "A", "  A \nMine\n", id="blanks around a name"),
        pytest.param("", "AB", "", "A\nB\n", id="empty file"),
    ],
)
def test_merge_order(text: str | None, names: str, owned: str, merged: str) -> None:
    assert merge_order(text, list(names), list(owned)) == merged


ours = st.lists(st.sampled_from("ABCDEF"), unique=True)
users = st.lists(st.sampled_from(["x", "y", "z", "'quoted name'", ""]), max_size=6)


@given(before=ours, now=ours, lines=users, seed=st.randoms())
def test_invariants(before: list[str], now: list[str], lines: list[str], seed: object) -> None:
    mixed = before + lines
    seed.shuffle(mixed)  # type: ignore[attr-defined]
    text = "".join(f"{line}\n" for line in mixed)
    merged = merge_order(text, now, before)
    assert [line for line in merged.splitlines() if line not in "ABCDEF" or not line][: len(lines)] == [
        line for line in mixed if line not in "ABCDEF" or not line
    ] or not names_in(merged), "lines of the user keep their order"
    assert sorted(name for name in names_in(merged) if name in "ABCDEF") == sorted(now), "ours are there once"
    assert merge_order(merged, now, now) == merged, "a second merge changes nothing"


def test_parents_list_the_package_and_are_made_if_the_configuration_says_so(project: Path) -> None:
    plant = make_parent("Plant")
    (plant / "package.order").write_text("Other\n")
    set_keys(package='"Plant.Ladder"')
    assert said(run()) == [
        "modelica/Plant/package.mo: warning: package `Plant` does not say that it needs Modelica; "
        'add `uses(Modelica(version="4.0.0"))` to its annotation [no-uses]'
    ]
    assert (plant / "package.order").read_text() == "Other\nLadder\n"
    assert "within Plant;" in (plant / "Ladder/package.mo").read_text()
    set_keys(package='"Factory.Filters.Ladder"', create_parents="true")
    run()
    assert (plant / "package.order").read_text() == "Other\n"
    assert not (plant / "Ladder").exists()
    factory = Path("modelica/Factory")
    orders = [(factory / folder / "package.order").read_text() for folder in ("", "Filters")]
    assert orders == ["Filters\n", "Ladder\n"]
    uses = '  annotation (uses(Modelica(version="4.0.0")));'
    assert (factory / "package.mo").read_text() == f'within;\npackage Factory "Factory"\n{uses}\nend Factory;\n'
    text = 'within Factory;\npackage Filters "Filters"\nend Filters;\n'
    assert (factory / "Filters/package.mo").read_text() == text
    edit(factory / "Filters/package.mo", '"Filters"', '"All filters"')
    assert run().in_step
