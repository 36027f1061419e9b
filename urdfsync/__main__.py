"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import sys


def main() -> int:
    """Run the command line; returns the exit code."""
    try:
        from urdfsync import uptodate  # here, so that Ctrl-C during the import leaves no traceback

        try:
            code = uptodate.print_answer(sys.argv[1:])
        except Exception:  # noqa: BLE001 - whatever it is: the command does its work without
            code = None
        if code is None:
            from urdfsync import cli  # 30 ms, which a command without work does not have

            code = cli.main()
    except KeyboardInterrupt:
        return 130
    return code


if __name__ == "__main__":
    sys.exit(main())
