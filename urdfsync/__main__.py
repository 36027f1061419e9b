"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import sys


def main() -> int:
    """Run the command line; an interruption while it is still being loaded leaves no traceback either."""
    try:
        from urdfsync.cli import main as run

        return run()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
