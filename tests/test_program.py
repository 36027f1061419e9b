"""How a command's process ends."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from urdfsync import program

START = """
import builtins
from urdfsync import program

class Last:
    def __del__(self):
        print("taken down", flush=True)

builtins.last = Last()
"""
"""The object goes when Python takes down its modules."""
TOLD = "import atexit; atexit.register(print, 'told', flush=True)"
AT_WORK = """
import threading, time
threading.Thread(target=lambda: (time.sleep(0.2), print("done", flush=True))).start()
"""


@pytest.mark.parametrize("code", [0, 3])
def test_it_ends_without_taking_modules_down(code: int) -> None:
    assert _ended("", code) == ""


@pytest.mark.parametrize(("asked", "said"), [(TOLD, "told"), (AT_WORK, "done")])
def test_who_wants_to_be_told_or_is_at_work_is_waited_for(asked: str, said: str) -> None:
    assert _ended(asked, 3).split("\n")[:2] == [said, "taken down"]


def test_an_interruption_is_an_exit_code() -> None:
    def interrupted() -> int:
        raise KeyboardInterrupt

    assert program.carry_out(interrupted) == 130


def _ended(before: str, expected: int) -> str:
    """What a process says that ends with this exit code; no other package is told of its start."""
    code = f"{START}\n{before}\nprogram.end({expected})"
    variables = {**os.environ, "PYTHONPATH": str(Path(program.__file__).parents[1])}
    command = [sys.executable, "-S", "-c", code]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (expected, "")
    return done.stdout
