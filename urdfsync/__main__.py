"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import sys

from urdfsync import program

TYPE_CHECKING = False  # that of `typing`, whose import takes longer than all that a command without work does
if TYPE_CHECKING:
    from typing import NoReturn


def start() -> "NoReturn":
    """Run the command line as the only thing in this process: what the console script does."""
    program.end(main())


def main() -> int:
    """Run the command line; returns the exit code."""
    return program.carry_out(_run)


def _run() -> int:
    from urdfsync.stamping import stamp  # here, where an interruption leaves no traceback

    try:
        code = stamp.repeat(sys.argv[1:])
    except Exception:  # noqa: BLE001 - whatever it is: the command does its work without, and says what is wrong
        code = None
    if code is None:
        from urdfsync.cli import main as run

        code = run()
    return code


if __name__ == "__main__":
    sys.exit(main())  # maybe on behalf of another module, such as `cProfile`, that goes on
