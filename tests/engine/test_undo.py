"""Undoing where no command gets: `tests/scenarios/undo.txt` has what users meet."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import R2, drop, edit, run

from urdfsync.engine.actions import Choice, UsersChoice, sides_hash
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config


@pytest.fixture
def deleted(project: Path) -> None:
    """An edited model whose element is gone, and that the user has let a build delete."""
    run()
    edit(R2, "equation", "  Real mine;\nequation")
    drop("R2")
    run()
    run(choices={R2: Choice.TAKE})
    assert not Path(R2).exists()


def test_what_a_stranger_put_beside_the_state_is_no_bug(deleted: None, execute: Execute) -> None:
    file = Path(".urdfsync/aside/ladder/index.json")
    assert file.exists()
    for text in ("", "x", "[]", '{"x.mo": {"file": "../x.mo"}}', "\ud800", "[" * 100_000):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, errors="surrogatepass")
        execute("build")


def test_a_file_that_comes_after_the_look_is_not_written_over(deleted: None) -> None:
    Path(R2).write_text("model R2\nend R2;\n")
    loaded = config.load(Path("urdfsync.toml"))
    choices = {R2: UsersChoice(Choice.UNDO, sides_hash(None, None))}
    list(build(loaded, loaded.robots, BuildOptions(choices=choices)))
    assert Path(R2).read_text() == "model R2\nend R2;\n"
