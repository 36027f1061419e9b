"""Builds of the RC network domain: what is written, what is left alone, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.files import unchanged
from support.networks import LADDER, MANIFEST, ROBOT, Snapshot, edit, failure, resistor, run, run_all, said, source
from support.networks import kinds as all_kinds

from urdfsync import registry
from urdfsync.diagnostics import Severity
from urdfsync.engine.actions import Reason
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.state.record import Choice


def kinds(result: Result) -> dict[str, Reason]:
    return all_kinds(result, f"{LADDER}/")


def configure(**keys: str) -> None:
    """Set keys of the robot; the values are TOML."""
    lines = {"source": '"ladder.json"', "package": '"Ladder"', "domain": '"rcnetwork"'} | keys
    text = "\n".join(f"{key} = {value}" for key, value in lines.items())
    Path("urdfsync.toml").write_text(f"[robots.ladder]\n{text}\n")


# What a build writes


def test_a_first_build_writes_the_package_and_a_second_one_nothing(project: Path, snapshot_of: Snapshot) -> None:
    before = snapshot_of(project)
    planned = run(dry=True)
    assert snapshot_of(project) == before
    result = run()
    assert planned.actions == result.actions
    assert set(kinds(result).values()) == {Reason.CREATE}
    written = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert written == set(kinds(result))
    assert (project / LADDER / "package.order").read_text() == "Elements\nLadder\n"
    assert "R = 220.5" in (project / LADDER / "Elements/R2Parameters.mo").read_text()
    assert (project / LADDER / "Resources/step.txt").read_text().startswith("#1\ndouble signal(4, 2)\n")
    with unchanged(project):
        assert run().in_step
        assert run(full=True).in_step


@pytest.mark.parametrize(("old", "new"), [("  ", "    "), ("\n", "\r\n")], ids=["blanks", "line ends"])
def test_changed_white_space_touches_nothing(project: Path, old: str, new: str) -> None:
    """So that two machines that check out text in their own way record the same, too."""
    run()
    place = LADDER if new.isspace() and old == "  " else "."
    edit("ladder.json", old, new)
    with unchanged(project / place):
        assert run().in_step
    assert run().in_step


def test_a_changed_option_or_template_renders_again(project: Path) -> None:
    run()
    configure(prefix='"pin"')
    assert kinds(run()) == {"Ladder.mo": Reason.UPDATE}
    template = project / "own/element/parameters.mo.jinja"
    template.parent.mkdir(parents=True)
    template.write_text(
        "within << package >>.Elements;\nrecord << element.name >>Parameters\nend << element.name >>Parameters;\n"
    )
    configure(prefix='"pin"', templates='"own"')
    assert set(kinds(run())) == {f"Elements/{name}Parameters.mo" for name in ("C1", "C2", "R1", "R2")}
    template.with_name(".parameters.mo.jinja.swp").write_text("of an editor")
    assert run().in_step
    edit(template, "record", "record  ")
    assert set(kinds(run()).values()) == {Reason.UPDATE}
    assert run().in_step


def test_a_full_build_generates_what_is_recorded_as_generated(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As after a change of the program that nobody has raised the revision for."""
    run()
    domain = type(registry.domain("rcnetwork"))
    real = domain.artifacts

    def artifacts(self: Any, model: Any, *others: Any) -> Any:
        elements = {name: {**element, "ohm": 7} for name, element in model["elements"].items()}
        return real(self, {**model, "elements": elements}, *others)

    monkeypatch.setattr(domain, "artifacts", artifacts)
    assert run().in_step
    assert kinds(run(full=True))["Elements/R1Parameters.mo"] is Reason.UPDATE


def test_a_package_that_moves_takes_edits_along_and_leaves_what_is_the_users(project: Path) -> None:
    run()
    (project / LADDER / "Bench.mo").write_text("within Ladder;\nmodel Bench\nend Bench;\n")
    edit(f"{LADDER}/package.order", "Ladder\n", "Bench\nLadder\n")
    edit(f"{LADDER}/Elements/R1.mo", "end R1;", "// mine\nend R1;")
    edit(f"{LADDER}/Ladder.mo", "end Ladder;", "// mine, too\nend Ladder;")
    configure(package='"Filter"')
    result = run()
    left = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert left == {"package.mo", "package.order", "Bench.mo"}
    moved = (project / "modelica/Filter/Elements/R1.mo").read_text()
    assert moved.startswith("within Filter.Elements;\n")
    assert moved.endswith("// mine\nend R1;\n")
    assert (project / "modelica/Filter/Filter.mo").read_text().endswith("// mine, too\nend Filter;\n")
    assert (project / LADDER / "package.order").read_text() == "Bench\n"
    assert said(result) == [
        "urdfsync.toml:1: warning: the package moved from modelica/Ladder to modelica/Filter; these files are "
        "not deleted, since urdfsync did not write them: modelica/Ladder/Bench.mo, modelica/Ladder/package.mo, "
        "modelica/Ladder/package.order; take over what you need, then delete the old folder [left-behind]"
    ]
    assert run().in_step
    assert run().diagnostics == ()


def test_a_package_that_cant_move_stays(project: Path, snapshot_of: Snapshot) -> None:
    run()
    foreign = project / "modelica/Filter/Ladder.mo"
    foreign.parent.mkdir()
    foreign.write_text("mine")
    configure(package='"Filter"', **{"class": '"Ladder"'})
    before = snapshot_of(project / LADDER)
    for _ in range(2):
        assert exit_code([run()]) is Exit.CONFLICT
        assert snapshot_of(project / LADDER) == before
    foreign.unlink()
    assert exit_code([run()]) is Exit.IN_STEP
    assert not (project / LADDER).exists()


def test_a_robot_with_another_name_takes_its_state_along(project: Path) -> None:
    run()
    edit(f"{LADDER}/Elements/R1.mo", "end R1;", "// mine\nend R1;")
    source("4.7e-6", "1e-5")
    edit("urdfsync.toml", "[robots.ladder]", "[robots.filter]")
    assert [found.code for found in run(dry=True).diagnostics] == ["renamed-robot"]
    result = run()
    assert kinds(result) == {"Elements/R1.mo": Reason.KEEP, "Elements/C2Parameters.mo": Reason.UPDATE}
    assert said(result) == [
        "urdfsync.toml:1: note: robot `filter` was called `ladder`; "
        "its recorded state goes on under the new name [renamed-robot]"
    ]
    states = {path.name for path in (project / ".urdfsync/robots").iterdir()}
    assert states == {"filter.state"}
    assert run().diagnostics == ()


def test_state_of_robots_that_are_gone_is_mentioned_once_and_kept(project: Path) -> None:
    run()
    Path("urdfsync.toml").write_text(ROBOT.format("filter", "Filter") + ROBOT.format("third", "Third"))
    for _ in range(3):
        first, second = run_all()
        assert said(first) == [
            "urdfsync.toml: note: the state of `ladder` is still there, but the configuration has no such robot; "
            "bring the robot back, or delete .urdfsync/robots/ladder.* and what is left of its package [stray-state]"
        ]
        assert second.diagnostics == ()
        assert (project / LADDER / "package.mo").exists()
        assert Path(MANIFEST).exists()
        Path(MANIFEST).write_text("it need not be readable")


# Other versions


def test_a_package_for_an_older_library_is_told_while_it_waits(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run()
    domain = type(registry.domain("rcnetwork"))
    monkeypatch.setattr(domain, "revision", 2)
    monkeypatch.setattr(domain, "fits_since", 2)
    edit(f"{LADDER}/Elements/R1Parameters.mo", "100", "101")
    resistor(120)
    alone = run()
    assert kinds(alone) == {"Elements/R1Parameters.mo": Reason.CONFLICT}
    assert alone.diagnostics == (), "nothing waits for it"
    source('"R2"', '"R3"')
    (found,) = run().diagnostics
    assert (found.code, found.severity) == ("outdated-package", Severity.WARNING)
    assert f"{LADDER}/Elements/R1Parameters.mo is resolved" in found.hint
    assert run(choices={f"{LADDER}/Elements/R1Parameters.mo": Choice.KEEP}).diagnostics == ()


def test_a_recorded_model_that_this_version_can_not_generate_stops_nothing(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run()
    domain = type(registry.domain("rcnetwork"))
    real = domain.artifacts

    def artifacts(self: Any, model: Any, *others: Any) -> Any:
        if model["elements"]["R1"]["ohm"] == 100:
            raise KeyError("siemens")
        return real(self, model, *others)

    monkeypatch.setattr(domain, "artifacts", artifacts)
    resistor(120)
    assert kinds(run()) == {"Elements/R1Parameters.mo": Reason.UPDATE}
    assert run().in_step


# The packages around


def package(name: str) -> Path:
    folder = Path("modelica", name)
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f"package {name}\nend {name};\n")
    return folder


def test_parents_list_the_package_and_are_made_if_the_configuration_says_so(project: Path) -> None:
    plant = package("Plant")
    (plant / "package.order").write_text("Other\n")
    configure(package='"Plant.Ladder"')
    assert said(run()) == [
        "modelica/Plant/package.mo: warning: package `Plant` does not say that it needs Modelica; "
        'add `uses(Modelica(version="4.0.0"))` to its annotation [no-uses]'
    ]
    assert (plant / "package.order").read_text() == "Other\nLadder\n"
    assert "within Plant;" in (plant / "Ladder/package.mo").read_text()
    configure(package='"Factory.Filters.Ladder"', create_parents="true")
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


# What is refused


REFUSED: dict[str, tuple[dict[str, str], Callable[[], object]]] = {
    "urdfsync.toml:5: error: robot `ladder`: the output folder … does not exist; create it": (
        *({"output": '"../elsewhere"'}, Path),
    ),
    "urdfsync.toml:5: error: robot `ladder`: the output folder lib can't be made: lib is no folder": (
        *({"output": '"lib"'}, lambda: Path("lib").write_text("")),
    ),
    "urdfsync.toml:5: error: robot `ladder`: the output folder modelica/Plant is a Modelica package itself": (
        *({"output": '"modelica/Plant"'}, lambda: package("Plant")),
    ),
    "urdfsync.toml:3: error: robot `ladder`: the parent package `Plant` does not exist in modelica; "
    "create it, or set `create_parents = true` [no-parent]": ({"package": '"Plant.Ladder"'}, Path),
    "urdfsync.toml:3: error: robot `ladder`: package `Plant` is the single file": (
        *({"package": '"Plant.Ladder"', "create_parents": "true"}, lambda: Path("modelica/Plant.mo").write_text("")),
    ),
    "ladder.json:6: error: element `R1` needs either `ohm` or `farad` [element-value]": (
        *({}, lambda: source('"ohm": 100', '"ohm": 100, "farad": 1')),
    ),
    "urdfsync.toml:2: error: robot `ladder`: the source ladder.json does not exist; correct `source`, or export the "
    "file again [no-source]": ({}, lambda: Path("ladder.json").unlink()),
    "urdfsync.toml:5: error: robot `ladder`: the template folder own does not exist; create it, or take `templates` "
    "out [no-templates]": ({"templates": '"own"'}, Path),
    "urdfsync.toml:5: error: robot `ladder`: `prefix` names `in`, which is a node; choose another one "
    "[prefix-is-node]": ({"prefix": '"in"'}, Path),
    ".urdfsync/robots/ladder.state: error: a newer urdfsync built robot `ladder`": (
        *({}, lambda: edit(MANIFEST, "revision 1", "revision 2")),
    ),
}
"""What stops a build, by how its message begins: keys of the robot, and what is done to files."""


@pytest.mark.parametrize("message", REFUSED)
def test_what_stops_a_build_is_told_with_its_place_and_changes_nothing(project: Path, message: str) -> None:
    run()
    keys, change = REFUSED[message]
    configure(**keys)
    change()
    with unchanged(project):
        begin, _, end = message.partition("…")
        found = failure(trusted=True)
        assert found.startswith(begin)
        assert end in found


def test_a_note_on_an_option_that_is_not_set_has_the_line_of_the_robot(project: Path) -> None:
    source('"ground"', '"earth"')
    for _ in range(2):
        assert said(run()) == ["urdfsync.toml:1: note: robot `ladder`: no node is called `ground` [no-ground]"]
