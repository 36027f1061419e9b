"""Serves the pages of watched robots to browsers on this machine; server-sent events update them.

The server listens only on the loopback interface. The server refuses requests from pages of other sites. Such a request
has another `Origin`, or another `Host` if the site's name resolves to this machine.
"""

from __future__ import annotations

import contextlib
import functools
import threading
from collections.abc import Iterator
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import quote, unquote

import msgspec

from urdfsync.analysis.checks.robot import known_check
from urdfsync.analysis.pages.content import gather
from urdfsync.analysis.pages.page import page
from urdfsync.analysis.versions.comparison import VersionContents
from urdfsync.common.diagnostics import OutputError, UrdfsyncError, internal_error
from urdfsync.engine.options import no_progress
from urdfsync.project import config
from urdfsync.watch import events
from urdfsync.watch.daemon import WatchOptions

_ALIVE = 10.0
"""Seconds between messages, by which the server notices closed browsers."""
_MOST = 50
"""The greatest number of connections at a time; each open page has one connection."""
_IDLE = 15.0
"""Seconds that a connection may take for its request, or for an answer."""
_HEADERS = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff", "X-Frame-Options": "DENY"}


class _Robot(msgspec.Struct):
    """One robot. `build` counts builds and checks; `page_build` is that number in the page."""

    build: int = 0
    problem: str = ""
    """Why the source can't be built."""
    page: bytes = b""
    page_build: int = -1
    shown: tuple[VersionContents, ...] = ()
    """The version that the page shows, then the version before."""


class View:
    """The server. The daemon's thread calls `take`; each request has a thread of its own."""

    def __init__(self, options: WatchOptions, port: int) -> None:
        """Listen on a port; 0 is any free one. Raises OutputError if the port is not available."""
        self._file, self.robots = options.file, dict[str, _Robot]()
        self._options = msgspec.structs.replace(options.build, progress=no_progress)
        self._news, self._making, self._is_closed = threading.Condition(), threading.Lock(), False
        try:
            self._server = _Server(("127.0.0.1", port), functools.partial(_Handler, self))
        except (OSError, OverflowError) as error:
            message = f"port {port} can't be used for the view: {getattr(error, 'strerror', error)}"
            raise OutputError.of("port-taken", message, hint="name another port with `--port`") from error
        self.hosts = tuple(f"{name}:{self._server.server_port}" for name in ("127.0.0.1", "localhost"))
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self) -> None:
        """End all connections, and the server."""
        with self._news:
            self._is_closed = True
            self._news.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def take(self, event: events.Event) -> None:
        """Record an event, and notify the pages."""
        with self._news:
            match event:
                case events.Started(robots=names):
                    self.robots = {name: self.robots.get(name) or _Robot() for name in names}
                case events.Built(result) | events.Failed(result):
                    robot = self.robots[result.robot]
                    robot.build += not result.failed
                    robot.problem = "; ".join(map(str, result.diagnostics)) if result.failed else ""
                case events.CheckDone(name):
                    self.robots[name].build += 1
                case events.Waiting(name, reason, diagnostics):
                    self.robots[name].problem = ": ".join([reason, *map(str, diagnostics)])
            self._news.notify_all()

    def page(self, name: str) -> bytes:
        """Return the present page of a robot, else the last one; empty without a page."""
        robot = self.robots[name]
        with self._making:
            if (build := robot.build) == robot.page_build:
                return robot.page
            try:
                loaded = config.load(self._file)
                (configured,) = loaded.select([name])
                content = gather(loaded, configured, None, self._options, config.working_folder(), robot.shown)
                check = known_check(loaded, configured)
                robot.page, robot.page_build = page(content, check=check, build=build), build
                if not robot.shown or robot.shown[0][0] != content.version[0]:
                    robot.shown = (content.version, *robot.shown[:1])
            except Exception as error:  # noqa: BLE001 - builds go on, and the next build makes a new page
                is_known = isinstance(error, UrdfsyncError | OSError)
                robot.problem = robot.problem or str(error if is_known else internal_error(error))
        return robot.page

    def messages(self, name: str) -> Iterator[bytes]:
        """Yield messages for a page, at once and at each change."""
        told = b""
        while not self._is_closed and (state := self._state(name)):
            yield b"data: %b\n\n" % state if state != told else b":\n\n"
            told = state
            with self._news:
                self._news.wait_for(lambda: self._is_closed or self._state(name) != told, _ALIVE)  # noqa: B023 - called at once

    def _state(self, name: str) -> bytes:
        robot = self.robots.get(name)
        others = {other: f"/{quote(other)}/" for other in self.robots if other != name}
        return msgspec.json.encode([robot.build, robot.problem, others]) if robot else b""


class _Server(ThreadingHTTPServer):
    """Has a thread for each connection, and refuses too many."""

    request_queue_size = _MOST

    def __init__(self, address: tuple[str, int], handler: Any) -> None:
        self._free = threading.BoundedSemaphore(_MOST)
        super().__init__(address, handler)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Start a thread for a connection."""
        if self._free.acquire(blocking=False):
            super().process_request(request, client_address)
            return
        with contextlib.suppress(OSError):
            request.sendall(
                b"HTTP/1.0 503 Service Unavailable\r\n\r\nThere are %d connections: close a page.\n" % _MOST
            )
        self.shutdown_request(request)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Answer a connection, in its thread."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()


class _Handler(BaseHTTPRequestHandler):
    """Answers one request."""

    timeout = _IDLE

    def __init__(self, view: View, *connection: Any) -> None:
        self._view = view
        super().__init__(*connection)

    def handle(self) -> None:
        """Answer; the browser may close the connection at any time."""
        with contextlib.suppress(ConnectionError):
            super().handle()

    def do_GET(self) -> None:
        """Answer a request for a page, or for its messages."""
        view, host = self._view, self.headers.get("Host")
        name, _, rest = self.path.removeprefix("/").partition("/")
        if host not in view.hosts or self.headers.get("Origin") not in (None, f"http://{host}"):
            self._answer(HTTPStatus.FORBIDDEN, b"This is for browsers on this machine, and for no other page.")
        elif self.path == "/" and view.robots:
            self._answer(HTTPStatus.FOUND, Location=f"/{quote(next(iter(view.robots)))}/")
        elif (name := unquote(name)) not in view.robots or rest not in ("", "events"):
            self._answer(HTTPStatus.NOT_FOUND, b"There is no such robot.")
        elif rest:
            self._answer(HTTPStatus.OK, kind="text/event-stream")
            for message in view.messages(name):
                self.wfile.write(message)
        elif content := view.page(name):
            self._answer(HTTPStatus.OK, content, "text/html; charset=utf-8")
        else:
            problem = f"{name}: {view.robots[name].problem}".encode("utf-8", "replace")
            self._answer(HTTPStatus.OK, problem, Refresh="2")

    def _answer(
        self, status: HTTPStatus, content: bytes = b"", kind: str = "text/plain; charset=utf-8", **more: str
    ) -> None:
        self.send_response(status)
        for key, value in {**_HEADERS, "Content-Type": kind, **more}.items():
            self.send_header(key, value)
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_: object) -> None:
        """Write nothing: the terminal is the daemon's."""
