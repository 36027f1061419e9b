"""The process of one compiler: takes a job from stdin, and writes a line with each result."""

from __future__ import annotations

import sys

import msgspec

from urdfsync import processes
from urdfsync.check.compilers import COMPILERS, MISSING
from urdfsync.check.compilers.compiler import CompileJob

with processes.reserve_stdout() as answers:
    try:
        for result in COMPILERS[sys.argv[1]].work(msgspec.json.decode(sys.stdin.buffer.read(), type=CompileJob)):
            answers.write(msgspec.json.encode(result) + b"\n")
            answers.flush()  # a crash leaves what was done until then
    except ImportError as error:
        sys.stderr.write(f"{error}\n")
        sys.exit(MISSING)
