"""A process that reads files of strangers: its limits protect against files that exploit a fault of a library."""

from __future__ import annotations

import atexit
import contextlib
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import IO, Any, cast

import msgspec

from urdfsync.common import system
from urdfsync.common.processes import importable, is_out_of_time, reserve_stdout

_MAX_LINE = 10_000_000
_MAX_FILE = 100_000_000


class LimitedAnswer(msgspec.Struct, frozen=True):
    """A line from the process; the bytes of each file follow."""

    sizes: tuple[int, ...] = ()
    facts: tuple[dict[str, Any], ...] = ()
    problem: str = ""
    """The reason why the file can't be used; empty for a usable file."""
    hint: str = ""
    is_last: bool = False
    """Whether the process is too large to read the next file with its full memory."""


class LimitedProcess:
    """The process, which starts for the first request.

    After a request that reached a limit, the next one starts a new process. This program handles signals while the
    process reads. When this program ends, the end of stdin ends the process.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()  # scripts may call the API from several threads

    def command(self) -> tuple[Sequence[str], Mapping[str, str]]:
        """Return the command that starts the process, and variables of its environment."""
        raise NotImplementedError

    def ask(
        self, request: msgspec.Struct, contents: Sequence[bytes], seconds: float, wall_seconds: float
    ) -> tuple[LimitedAnswer, list[bytes]]:
        """Return the answer to a request, with its files; the process limits itself to `seconds` of CPU time.

        Raises TimeoutError for a request that took too long, ValueError if the process fails, or OSError if it can't
        start.
        """
        with self._lock:
            process = self._process = self._process or self._start()
            is_late = threading.Event()

            def end_late() -> None:
                is_late.set()
                process.kill()

            timer = threading.Timer(wall_seconds, end_late)
            timer.start()
            try:
                answer, files = _exchange(process, request, contents)
                if answer.is_last:
                    self.end()
            except (OSError, ValueError) as error:  # the process has ended, or the answer is invalid
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(1)  # it may end a moment after its pipes
                limit = wall_seconds if is_late.is_set() else seconds if is_out_of_time(process.returncode or 0) else 0
                self.end()
                if not limit:
                    raise ValueError("the process that reads the file fails") from error
                raise TimeoutError(f"reading the file takes more than {limit:g} s") from error
            except BaseException:  # after an interruption, the pipe may hold half an answer
                self.end()
                raise
            finally:
                timer.cancel()
        return answer, files

    def end(self) -> None:
        """End the process, if it runs."""
        process, self._process = self._process, None
        if process is not None:
            atexit.unregister(self.end)
            process.kill()
            with contextlib.suppress(OSError), process:  # closes the pipes and waits
                pass

    def _start(self) -> subprocess.Popen[bytes]:
        atexit.register(self.end)
        command, variables = self.command()
        return subprocess.Popen(  # noqa: S603 - a command of ours
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # threads need memory; libraries use deprecated parts of numpy
            env={**os.environ, **importable(), "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore", **variables},
            **system.own_group(),  # Ctrl-C reaches only the waiting program, which ends the process
        )


def answer_requests(answer: Callable[[bytes, IO[bytes]], tuple[LimitedAnswer, Sequence[bytes]]]) -> None:
    """Answer requests until stdin is closed, as the program of the process. Contents follow the line of a request."""
    requests, answers = sys.stdin.buffer, reserve_stdout()
    while line := requests.readline():
        found, files = answer(line, requests)
        found = msgspec.structs.replace(found, sizes=tuple(map(len, files)))
        answers.write(msgspec.json.encode(found) + b"\n")
        for file in files:
            answers.write(file)
        answers.flush()
    os._exit(0)  # unloading libraries takes a tenth of a second


def _exchange(
    process: subprocess.Popen[bytes], request: msgspec.Struct, contents: Sequence[bytes]
) -> tuple[LimitedAnswer, list[bytes]]:
    """Send a request to the process, and return its answer. Raises OSError or ValueError for a wrong answer."""
    stdin, stdout = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stdout)
    stdin.write(msgspec.json.encode(request) + b"\n")
    for content in contents:
        stdin.write(content)
    stdin.flush()
    answer = msgspec.json.decode(stdout.readline(_MAX_LINE), type=LimitedAnswer)
    files = [stdout.read(min(size, _MAX_FILE)) for size in answer.sizes]
    if tuple(map(len, files)) != answer.sizes:
        raise ValueError("the answer ends early, or is too large")
    return answer, files
