"""The tutorial runs as it is: its files, edits and commands, with their output."""

from __future__ import annotations

import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT

PAGE = Path(__file__).parents[1] / "docs/tutorial.md"
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)


def commands(block: str) -> Iterator[tuple[str, str]]:
    """Each command of a console block, and its output; `…` stands for lines."""
    for part in block.split("$ ")[1:]:
        command, _, printed = part.partition("\n")
        yield command, printed


def run(folder: Path, execute: Execute, left_out: str = "") -> None:
    """Run all commands of the page except one."""
    for kind, block in _BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        if kind == "xml":
            (folder / "arm.urdf").write_text(block)
        elif kind == "diff":
            subprocess.run(["git", "apply", "-"], input=block, text=True, check=True, cwd=folder)
        elif kind == "console":
            for command, printed in commands(block):
                program, *arguments = shlex.split(command)
                assert program == "urdfsync"
                if arguments[0] == left_out:
                    continue
                done = execute(*arguments, code=None)
                pattern = re.escape(printed).replace(re.escape("    …\n"), "(?:.*\n)*")
                pattern = re.sub(r"\\-[0-9a-f]{8}(?=\\\.)", "-[0-9a-f]{8}", pattern)  # hashes of texts
                pattern = pattern.replace(re.escape("4.8 s"), r"(?:\d+\.\d s|as simulated before)")
                compiling = re.escape("arm: compiling Arm.ArmTest with rumoca\n")
                pattern = pattern.replace(compiling, f"(?:{compiling})?")
                # progress stands before the results, findings stand after them
                assert any(map(re.compile(pattern).fullmatch, (done.err + done.out, done.out + done.err))), command


@NEEDS_GIT
def test_the_tutorial(folder: Path, execute: Execute) -> None:
    run(folder, execute, left_out="simulate")


@NEEDS_GIT
@pytest.mark.slow
def test_the_tutorial_with_its_simulation(folder: Path, execute: Execute, modelica_library: Path) -> None:
    run(folder, execute)
