"""On what was measured, and with which versions."""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from benchmarks.measuring import variables
from benchmarks.tools import Tools

_PROGRAMS = ("git", "ninja", "doit", "dvc")


def described(tools: Tools) -> Iterator[str]:
    """The machine, and each program with its version."""
    yield f"{_processor()}, {os.cpu_count()} cores, {_memory()}{platform.system()}"
    yield f"Python {platform.python_version()}"
    for name in _PROGRAMS:
        program = shutil.which(name, path=tools.path)
        if program:
            command = [program, "--version"]
            told = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=variables()).stdout
            found = re.search(r"\d[\w.]*\d", told)
            yield f"{name} {found[0] if found else told.strip()}"
    if tools.published:
        yield f"published tool {tools.published.version}"


def _processor() -> str:
    file = Path("/proc/cpuinfo")
    found = re.search(r"^model name\s*: (.*)$", file.read_text(), re.MULTILINE) if file.exists() else None
    return found[1].strip() if found else platform.processor() or platform.machine()


def _memory() -> str:
    total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return f"{total / 1e9:.0f} GB, "
