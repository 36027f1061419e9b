"""The start of the program."""

from __future__ import annotations

import subprocess
import sys

COUNTED = """\
import gc
from urdfsync.__main__ import main

searches = []
gc.callbacks.append(lambda phase, _: searches.append(phase))
code = main()
print(code, len(searches), gc.get_freeze_count() > 0)
"""


def test_a_short_command_is_not_searched_for_cycles_of_references() -> None:
    command = [sys.executable, "-c", COUNTED, "library"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    code, searches, frozen = said.splitlines()[-1].split()
    assert (code, frozen) == ("0", "True")
    assert int(searches) <= 4, "one or two begin and end before it is known that there is something to do"
