"""The start of the program."""

from __future__ import annotations

import subprocess
import sys

COUNTED = """\
import gc
from urdfsync.__main__ import main

searches = []
gc.callbacks.append(lambda phase, _: searches.append(phase))
print(main(), len(searches))
"""


def test_a_short_command_is_not_searched_for_cycles_of_references() -> None:
    said = _carried_out(COUNTED, "library").stdout
    code, searches = said.splitlines()[-1].split()
    assert code == "0"
    assert int(searches) <= 4, "one or two begin and end before it is known that there is something to do"


def _carried_out(code: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True)
