"""The process of one compiler: takes a job from stdin, and writes a line with each result."""

from __future__ import annotations

import sys

import msgspec

from urdfsync import processes
from urdfsync.check.compilers import COMPILERS, MISSING
from urdfsync.check.compilers.compiler import CompileJob


def main() -> int:
    """Do one job; returns the exit code."""
    answers = processes.reserve_stdout()
    job = msgspec.json.decode(sys.stdin.buffer.readline(), type=CompileJob)
    processes.end_with_parent()
    try:
        for result in COMPILERS[sys.argv[1]].work(job):
            answers.write(msgspec.json.encode(result) + b"\n")
            answers.flush()
    except ImportError as error:
        sys.stderr.write(f"{error}\n")
        return MISSING
    return 0


sys.exit(main())
