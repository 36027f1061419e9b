"""`urdfsync watch`: keeps packages in step while their sources change."""

from __future__ import annotations

import argparse
import contextlib
import signal
from collections.abc import Iterator
from types import FrameType
from typing import TYPE_CHECKING

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console

if TYPE_CHECKING:
    from urdfsync.watch.daemon import Daemon

_CODES = "exit codes: 0 ended by SIGTERM or SIGHUP, 2 error, 4 watched already, 130 ended by SIGINT"
_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGALRM")
"""Signals that end the daemon; the last one comes from its own timer."""
_TIMES = (
    ("settle", "MS", 300, "milliseconds without an event before a build"),
    ("sample", "MS", 200, "milliseconds between two reads that have to show the same"),
    ("patience", "S", 30, "seconds before an invalid source is reported as an error"),
    ("rescan", "S", 30, "seconds between two reads of all files: the system may drop events, and mounts have none"),
)
_GRACE = 10.0
"""Seconds after the first signal in which the work in hand has to end."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "watch",
        "robots --robot --wait --trust --jobs",
        help="keep the packages in step while their sources change",
        description="Build whenever a source, a mesh, a template or a generated file has changed, until interrupted.",
        epilog=f"example: urdfsync watch --exec 'make fmu'\n\n{_CODES}",
    )
    for name, unit, default, words in _TIMES:
        words = f"{words} (default: {default})"
        parser.add_argument(f"--{name}", type=_duration, metavar=unit, default=default, help=words)
    command = "shell command to run after a build that changed files"
    parser.add_argument("--exec", metavar="CMD", default="", help=command)


def _duration(text: str) -> float:
    number = float(text)
    if not 0 <= number < float("inf"):
        raise ValueError
    return number


def run(args: argparse.Namespace, console: Console) -> int:
    """Run the daemon until a signal ends it."""
    from urdfsync.watch.daemon import Daemon, WatchOptions  # not at the top: watchdog takes 45 ms
    from urdfsync.watch.report import Report, show_json

    with contextlib.ExitStack() as stack:
        listener = show_json if console.is_document else stack.enter_context(Report(console)).show
        options = WatchOptions(
            file=args.config or config.find(config.working_folder()),
            robots=(*args.robots, *(args.robot or ())),
            settle=args.settle / 1000,
            sample=args.sample / 1000,
            give_up_after=args.patience,
            rescan=max(args.rescan, 0.1),
            command=args.exec,
            build=arguments.request(args, console),
        )
        daemon = Daemon(options, listener)
        with _signals(daemon) as received:
            daemon.run()
    return Exit.INTERRUPTED if received[0] == "SIGINT" else Exit.IN_STEP


@contextlib.contextmanager
def _signals(daemon: Daemon) -> Iterator[list[str]]:
    """Stop the daemon when the process is told to end. The first signal lets it finish its work.

    The second one interrupts the work, and so does the time: a source may be such that reading it never ends.
    """
    received: list[str] = []

    def handle(number: int, frame: FrameType | None) -> None:  # noqa: ARG001 - as signal calls it
        received.append(signal.Signals(number).name)
        if hasattr(signal, "setitimer"):  # else only a second signal helps
            signal.setitimer(signal.ITIMER_REAL, _GRACE, _GRACE)
        daemon.stop(received[0])

    numbers = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    handled = [number for number in numbers if signal.getsignal(number) is not signal.SIG_IGN]  # `nohup` ignores SIGHUP
    before = {number: signal.signal(number, handle) for number in handled}
    try:
        yield received
    finally:
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)
