"""The tutorial runs as it stands: its files, its edits, its commands, and what they print."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.commands import Execute

PAGE = Path(__file__).parents[1] / "docs/tutorial.md"
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)


def commands(block: str) -> Iterator[tuple[str, str]]:
    """Each command of a console block, and what it prints; `…` stands for lines."""
    for part in block.split("$ ")[1:]:
        command, _, printed = part.partition("\n")
        yield command, printed


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed, which applies the edits")
def test_the_tutorial(folder: Path, execute: Execute) -> None:
    for kind, block in _BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        if kind == "xml":
            (folder / "arm.urdf").write_text(block)
        elif kind == "diff":
            subprocess.run(["git", "apply", "-"], input=block, text=True, check=True, cwd=folder)
        else:
            for command, printed in commands(block):
                program, *arguments = shlex.split(command)
                assert program == "urdfsync"
                done = execute(*arguments, code=None)
                pattern = re.escape(printed).replace(re.escape("    …\n"), "(?:.*\n)*")
                assert re.fullmatch(pattern, done.out + done.err), command


def test_the_readme_shows_what_the_tutorial_does() -> None:
    shown = [text for kind, text in _BLOCK.findall((PAGE.parents[1] / "README.md").read_text()) if kind == "console"]
    told = PAGE.read_text()
    assert len(shown) == 2
    for block in shown:
        for command, printed in commands(block):
            assert f"$ {command}\n{printed}" in told
