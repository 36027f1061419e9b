"""The program's start: `urdfsync`, or `python -m urdfsync`."""

import atexit
import gc
import sys

_GARBAGE_THRESHOLD = 1_000_000
"""New objects after which Python looks for cycles: with Python's default, 700, a build takes 20 of 250 ms longer."""


def main() -> int:
    """Run the command line; returns the exit code."""
    gc.set_threshold(_GARBAGE_THRESHOLD, *gc.get_threshold()[1:])
    # collects no garbage at exit: saves 40 of 290 ms of a build, 3 of 40 ms of an up-to-date check
    atexit.register(gc.freeze)
    try:
        from urdfsync.common import noop  # imported here, so that Ctrl-C during the import leaves no traceback

        try:
            if sys.argv[1:2] == ["hook"]:
                from urdfsync.project.git import hook  # imported here, so that other commands save 6 ms

                if hook.is_answered(sys.argv[1:]):
                    return 0
            if sys.argv[1:2] == ["completion"]:
                from urdfsync.commands.shells import completion  # imported here, so that other commands save 6 ms

                if completion.answer(sys.argv[2:]):
                    return 0
            if sys.argv[1:] in (["--version"], ["--help"], ["-h"]):
                from urdfsync.commands import overview  # likewise

                trouble: str | None = overview.answer(sys.argv[1])
            else:
                trouble = noop.answer(sys.argv[1:])
        except Exception:  # noqa: BLE001 - after any error here, the command runs
            trouble = None
        if trouble == "":
            return 0
        from urdfsync.commands import cli  # a late import: a command that was answered above saves 30 ms

        return cli.main() if trouble is None else cli.tell_unwritten(trouble)
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
