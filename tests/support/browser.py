"""A real browser in which tests open pages: Chromium without a window, controlled through a pipe.

Chromium draws by a software renderer, so tests need no graphics card. `URDFSYNC_CHROMIUM` names Chromium's program.
"""

from __future__ import annotations

import base64
import contextlib
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

_PROGRAMS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "chrome")
PROGRAM = os.environ.get("URDFSYNC_CHROMIUM") or next(filter(None, map(shutil.which, _PROGRAMS)), "")
NEEDS_CHROMIUM = pytest.mark.skipif(
    not PROGRAM or os.name == "nt", reason=f"no Chromium: none of {', '.join(_PROGRAMS)}; URDFSYNC_CHROMIUM names one"
)
_FLAGS = (
    "--headless",
    "--remote-debugging-pipe",
    "--no-sandbox",  # containers of CI allow no sandbox
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--disable-extensions",
    "--disable-background-networking",
    "--hide-scrollbars",
)
_PATIENCE = 180.0
"""Seconds for an answer: the machine may be busy, and a software renderer is slow."""


class Page:
    """One page in the browser. `problems` has the errors of the page, in words."""

    def __init__(self, requests: int, answers: int) -> None:
        self._requests, self._answers = requests, answers
        self._rest, self._number, self._session = b"", 0, ""
        self.problems: list[str] = []
        self._seen = set[str]()
        target = self._call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self._call(f"{domain}.enable")

    def open(
        self,
        place: Path | str,
        *,
        width: int = 1280,
        height: int = 900,
        dark: bool = False,
        ready: str = "",
        first: str = "",
    ) -> None:
        """Open a file, or an address, in a window of this size, and wait for the promise `ready` of the page.

        The script `first` runs before the scripts of the page.
        """
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self._call("Emulation.setDeviceMetricsOverride", **metrics)
        feature = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._call("Emulation.setEmulatedMedia", features=[feature])
        script = self._call("Page.addScriptToEvaluateOnNewDocument", source=first)
        self._seen.discard("Page.loadEventFired")
        self._call("Page.navigate", url=place if isinstance(place, str) else place.resolve().as_uri())
        while "Page.loadEventFired" not in self._seen:
            self._read()
        self._call("Page.removeScriptToEvaluateOnNewDocument", **script)
        if ready:
            self.run(ready)

    def run(self, expression: str) -> Any:
        """Return the value of an expression of JavaScript, or of its promise."""
        answer = self._call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise AssertionError(f"{expression}: {_words(answer['exceptionDetails'])}")
        return answer["result"].get("value")

    def click(self, x: float, y: float) -> None:
        """Press and release the mouse at a place of the window."""
        for kind in ("mousePressed", "mouseReleased"):
            self._call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def drag(self, *places: tuple[float, float]) -> None:
        """Press the mouse at the first place of the window, move it over the others, and release it at the last."""
        kinds = ["mousePressed", *["mouseMoved"] * (len(places) - 1), "mouseReleased"]
        for kind, (x, y) in zip(kinds, (*places, places[-1]), strict=True):
            self._call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)

    def press(self, key: str) -> None:
        """Press and release a key where the focus is."""
        for kind in ("keyDown", "keyUp"):
            self._call(
                "Input.dispatchKeyEvent", type=kind, key=key, text=key if kind == "keyDown" and len(key) == 1 else ""
            )

    def picture(self, file: Path, *, whole: bool = False) -> None:
        """Save the visible part of the page as PNG."""
        answer = self._call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        file.write_bytes(base64.b64decode(answer["data"]))

    def _call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        message |= {"sessionId": self._session} if self._session else {}
        os.write(self._requests, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._read()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                result: dict[str, Any] = answer["result"]
                return result

    def _read(self) -> dict[str, Any]:
        """Return the next message; note errors of the page."""
        end = time.monotonic() + _PATIENCE
        while b"\0" not in self._rest:
            piece = os.read(self._answers, 1 << 20)
            if not piece or time.monotonic() > end:
                raise AssertionError("the browser has ended, or does not answer")
            self._rest += piece
        text, _, self._rest = self._rest.partition(b"\0")
        message: dict[str, Any] = json.loads(text)
        kind, parameters = message.get("method", ""), message.get("params", {})
        self._seen.add(kind)
        if kind == "Runtime.exceptionThrown":
            self.problems.append(_words(parameters["exceptionDetails"]))
        elif kind == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.problems.append(" ".join(str(each.get("value")) for each in parameters["args"]))
        elif kind == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.problems.append(parameters["entry"]["text"])
        elif kind == "Page.javascriptDialogOpening":
            self.problems.append(f"a dialog: {parameters['message']}")
        return message


def _words(details: dict[str, Any]) -> str:
    return str(details.get("exception", {}).get("description") or details.get("text"))


@contextlib.contextmanager
def browser() -> Iterator[Page]:
    """A page of a browser that ends with the block."""
    to_browser, from_us = os.pipe()
    from_browser, to_us = os.pipe()

    def set_pipes() -> None:  # the browser reads from 3, and writes to 4
        first, second = (os.dup(number) for number in (to_browser, to_us))
        os.dup2(first, 3)
        os.dup2(second, 4)

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = subprocess.Popen(
            [PROGRAM, *_FLAGS, f"--user-data-dir={profile}"],
            preexec_fn=set_pipes,
            pass_fds=(3, 4),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            os.close(to_browser)
            os.close(to_us)
            yield Page(from_us, from_browser)
        finally:
            process.kill()
            process.wait()
            os.close(from_us)
            os.close(from_browser)
