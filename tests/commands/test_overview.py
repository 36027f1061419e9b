"""The help of the program, and its version."""

from __future__ import annotations

import subprocess
import sys

import pytest
from support.commands import Execute

from urdfsync import __version__
from urdfsync.commands import cli


@pytest.mark.parametrize("option", ["--help", "-h", "--version"])
def test_version_and_help_import_no_parser_and_no_library(option: str, execute: Execute) -> None:
    light = "assert not {'argparse', 'msgspec', 'urdfsync.commands.cli'} & sys.modules.keys()"
    code = f"import sys; from urdfsync.__main__ import main; assert main() == 0; {light}"
    done = subprocess.run([sys.executable, "-c", code, option], capture_output=True, text=True, check=True)
    assert done.stdout == execute(option).out
    shown = [f"urdfsync {__version__}"] if option == "--version" else ["usage: urdfsync ", *cli._COMMANDS]
    assert all(word in done.stdout for word in shown)
