"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import gc
import sys

_OBJECTS = 100_000
"""So many new objects until Python looks for reference cycles: a command and its modules have some 40,000."""


def main() -> int:
    """Run the command line; an interruption while it is still being loaded leaves no traceback either.

    Nobody looks for reference cycles in the end, since what is left goes with the process.
    """
    try:
        from urdfsync.stamping import stamp

        code = stamp.repeat(sys.argv[1:])
        if code is None:
            gc.set_threshold(_OBJECTS)
            from urdfsync.cli import main as run

            code = run()
    except KeyboardInterrupt:
        return 130
    finally:
        gc.freeze()
    return code


if __name__ == "__main__":
    sys.exit(main())
