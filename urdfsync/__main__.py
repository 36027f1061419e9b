"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import sys


def main() -> int:
    """Run the command line; an interruption while it is still being loaded leaves no traceback either."""
    try:
        from urdfsync.stamping import stamp

        code = stamp.repeat(sys.argv[1:])
        if code is None:
            from urdfsync.cli import main as run

            code = run()
    except KeyboardInterrupt:
        return 130
    return code


if __name__ == "__main__":
    sys.exit(main())
