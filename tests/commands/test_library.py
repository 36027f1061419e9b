"""`urdfsync library`: the folder, and a line for shells."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.commands import Execute
from support.screen import Terminal

from urdfsync.commands import cli
from urdfsync.project import config


def test_library(execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    (told,) = execute("library", "--format=json").json["results"]
    assert (Path(told["folder"]) / "UrdfSync").is_dir()
    assert execute("library").out == f"{told['line']}\n"
    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    assert cli.main(["library"]) == 0
    assert screen.getvalue() == f"{Path(told['folder'])}\n{told['line']}\n"


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
@pytest.mark.parametrize(
    ("name", "before", "after"), [("a'b\"c", "", ""), ("two $HOME `id` \\n", "/lib one:/two", ":/lib one:/two")]
)
def test_the_line_of_library_is_for_eval(
    tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, name: str, before: str, after: str
) -> None:
    monkeypatch.setattr(config, "library_folder", lambda: tmp_path / name)
    script = 'eval "$1"; printf %s "$MODELICAPATH"'
    command = ["bash", "-c", script, "bash", execute("library").out]
    environment = os.environ | {"MODELICAPATH": before}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == f"{tmp_path / name}{after}"
