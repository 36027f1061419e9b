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


def test_what_was_said_arrives() -> None:
    assert _ended("print('said')", 3) == "said\n"


@pytest.mark.parametrize("watching", ["sys.setprofile", "sys.settrace"])
def test_who_looks_on_is_waited_for(watching: str) -> None:
    assert _ended(f"import sys; {watching}(lambda *_: None)", 0) == "taken down\n"


def test_who_runs_the_module_goes_on() -> None:
    """Such as `python -m cProfile -m urdfsync`."""
    command = [sys.executable, "-m", "cProfile", "-s", "ncalls", "-m", "urdfsync", "library"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert "function calls" in said


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
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    variables["PYTHONPATH"] = str(Path(program.__file__).parents[1])
    command = [sys.executable, "-S", "-c", code]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (expected, "")
    return done.stdout
