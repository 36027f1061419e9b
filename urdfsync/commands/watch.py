"""`urdfsync watch`: keeps packages in step while their sources change."""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from types import FrameType
from typing import TYPE_CHECKING

from urdfsync.commands import arguments
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console
from urdfsync.project import config

if TYPE_CHECKING:
    from urdfsync.watch.daemon import Daemon

_CODES = "exit codes: 0 ended by SIGTERM or SIGHUP, 2 error, 4 watched already, 130 ended by SIGINT"
_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK", "SIGALRM")
"""Signals that end the daemon; the daemon's own timer sends the last one."""
_TIMES = (
    ("settle", "MS", 500, "milliseconds without a change before a build"),
    ("patience", "S", 30, "seconds before an invalid source is reported as an error"),
    ("rescan", "S", 30, "seconds between two reads of all files: the system may drop events, and mounts send none"),
)
_PORT = 8357
_GRACE = 10.0
"""Seconds from the first signal until the work in hand is interrupted."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "watch",
        "robots --wait --trust --jobs",
        help="keep the packages in step while their sources change",
        description="Build whenever a source, a mesh, a template or a generated file has changed, until interrupted.",
        epilog=f"example: urdfsync watch --exec 'make fmu'\n\n{_CODES}",
    )
    for name, unit, default, words in _TIMES:
        words = f"{words} (default: {default})"
        parser.add_argument(f"--{name}", type=_duration, metavar=unit, default=default, help=words)
    option = parser.add_argument
    option("--exec", metavar="CMD", default="", help="shell command to run after a build that changed files")
    option("--view", action="store_true", help="serve a page for each robot to browsers on this machine, see `report`")
    option("--open", action="store_true", help="also open the page in a browser")
    option("--port", type=int, metavar="N", default=_PORT, help=f"the page's port, 0 for any (default: {_PORT})")


def _duration(text: str) -> float:
    number = float(text)
    if not 0 <= number < float("inf"):
        raise ValueError
    return number


def run(args: argparse.Namespace, console: Console) -> int:
    """Run the daemon until a signal ends it."""
    from urdfsync.watch import events
    from urdfsync.watch.daemon import Daemon, WatchOptions  # not at the top: watchdog takes 45 ms
    from urdfsync.watch.report import Report, show_json

    with contextlib.ExitStack() as stack:
        show = listener = show_json if console.is_document else Report(console).show
        options = WatchOptions(
            file=args.config or config.find(config.working_folder()),
            robots=tuple(args.robots),
            settle=args.settle / 1000,
            give_up_after=args.patience,
            rescan=max(args.rescan, 0.1),
            command=args.exec,
            build=arguments.request(args, console),
        )
        if args.view or args.open:
            from urdfsync.watch.view import View  # with Jinja 50 ms

            view = stack.enter_context(contextlib.closing(View(options, args.port)))
            show(events.Viewing(address := f"http://{view.hosts[0]}/"))
            if args.open and not _open(address):
                message, hint = "there is no browser, or no screen", f"open {address} in one on this machine"
                show(events.Noted((Diagnostic(Severity.WARNING, "no-browser", message, hint=hint),)))

            def listener(event: events.Event) -> None:
                show(event)
                view.take(event)

        daemon = Daemon(options, listener)
        with _signals(daemon) as received:
            daemon.run()
    return Exit.INTERRUPTED if received[0] == "SIGINT" else Exit.IN_STEP


def _open(address: str) -> bool:
    """Open a page in a browser with windows: a browser in the terminal would disturb the daemon's output."""
    import webbrowser

    has_screen = sys.platform != "linux" or any(map(os.environ.get, ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY")))
    return has_screen and webbrowser.open(address)


@contextlib.contextmanager
def _signals(daemon: Daemon) -> Iterator[list[str]]:
    """Stop the daemon on a signal. The first signal lets the daemon finish its work.

    A second signal, or a timer, interrupts the work: reading a source may never end.
    """
    received: list[str] = []

    def handle(number: int, frame: FrameType | None) -> None:  # noqa: ARG001 - as signal calls it
        received.append(signal.Signals(number).name)
        if sys.platform != "win32":  # without a timer, only a second signal ends the work
            signal.setitimer(signal.ITIMER_REAL, _GRACE, _GRACE)
        daemon.stop(received[0])

    numbers = [getattr(signal, name) for name in _SIGNALS if hasattr(signal, name)]
    handled = [number for number in numbers if signal.getsignal(number) is not signal.SIG_IGN]  # `nohup` ignores SIGHUP
    before = {number: signal.signal(number, handle) for number in handled}
    try:
        yield received
    finally:
        if sys.platform != "win32":
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)
