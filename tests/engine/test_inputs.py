"""All that a build starts from: a robot with another name, states that are left over, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.files import unchanged
from support.networks import LADDER, MANIFEST, ROBOT, edit, failure, make_parent, run, run_all, said, source
from support.networks import inner_kinds as kinds
from support.networks import set_keys as configure

from urdfsync.engine.actions import Reason


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
    for dry in (True, False, False):
        first, second = run_all(dry=dry)
        assert said(first) == [
            "urdfsync.toml: note: the state of `ladder` is still there, but the configuration has no such robot; "
            "bring the robot back, or delete .urdfsync/robots/ladder.* and what is left of its package [stray-state]"
        ]
        assert second.diagnostics == ()
        assert (project / LADDER / "package.mo").exists()
        assert Path(MANIFEST).exists()
        Path(MANIFEST).write_text("it need not be readable")


REFUSED: dict[str, tuple[dict[str, str], Callable[[], object]]] = {
    "urdfsync.toml:5: error: robot `ladder`: the output folder … does not exist; create it": (
        *({"output": '"../elsewhere"'}, Path),
    ),
    "urdfsync.toml:5: error: robot `ladder`: the output folder lib can't be made: lib is no folder": (
        *({"output": '"lib"'}, lambda: Path("lib").write_text("")),
    ),
    "urdfsync.toml:5: error: robot `ladder`: the output folder modelica/Plant is a Modelica package itself": (
        *({"output": '"modelica/Plant"'}, lambda: make_parent("Plant")),
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
