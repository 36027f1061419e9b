"""All that a build starts from: a robot with another name, states that are left over, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.files import unchanged
from support.networks import MANIFEST, edit, failure, make_parent, run, said, source
from support.networks import set_keys as configure

from urdfsync.common.version import __version__

REFUSED: dict[str, tuple[dict[str, str], Callable[[], object]]] = {
    "urdfsync.toml:5: error: robot `ladder`: the output folder … does not exist; create it": (
        *({"output": '"../elsewhere"'}, Path),
    ),
    "urdfsync.toml:5: error: robot `ladder`: the output folder lib can't be created: lib is not a folder": (
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
    ".urdfsync/robots/ladder.state:2: error: urdfsync 10.1.0 wrote this state, and this is": (
        *({}, lambda: edit(MANIFEST, f'"release":"{__version__}', '"release":"10.1.0')),
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
