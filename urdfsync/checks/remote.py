"""Results of `check` in a folder or bucket that several machines share; the user names it, never a configuration.

Whoever can write there could also write a digest beside a forged result. So each file begins with an HMAC over the
result and its key, made with a secret that all machines of a team have. Without the secret, nothing is read or written.
"""

from __future__ import annotations

import hashlib
import hmac
import os
import platform
import threading
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec

from urdfsync.checks.results import CheckResult
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.extras import install_command

T = TypeVar("T")

SECRET = "URDFSYNC_REMOTE_SECRET"  # noqa: S105 - the variable's name
CODE = "remote-cache"
PATIENCE = 10.0
"""Seconds for one read or write; afterwards this process goes without the remote cache."""
_LEAST_SECRET = 16  # characters: a shorter one could be guessed from any file of the cache
_LARGEST = 16 * 2**20  # bytes of a result; without a limit, a stranger's file could fill the memory

_problems: dict[str, str] = {}
"""By address, why this process no longer uses a remote cache: a slow one costs `PATIENCE` once."""


class RemoteError(Exception):
    """A file of the remote cache that must not be used."""


class RemoteCache:
    """The remote cache at an address of fsspec; an empty address is a cache without results."""

    def __init__(self, address: str, *, writes: bool) -> None:
        self._address, self._writes, self._warnings = address, writes, list[str]()
        self._secret = os.environ.get(SECRET, "").encode(errors="surrogateescape")
        if address and len(self._secret) < _LEAST_SECRET:
            _problems[address] = f"the variable {SECRET} has no secret of {_LEAST_SECRET} characters or more"

    @property
    def warnings(self) -> list[Diagnostic]:
        """Why results were not read or written."""
        known = [_problems[self._address]] if self._address in _problems else []
        message = "the remote cache was not used: "  # an address may have a password
        return [Diagnostic(Severity.WARNING, CODE, message + words) for words in (*self._warnings, *known)]

    def load(self, key: str) -> CheckResult | None:
        """Return the result with this key; None without one that was written by a holder of the secret."""
        content = self._reach(lambda system, folder: _read(system, f"{folder}/{_name(key)}"))
        if not content:
            return None
        if not hmac.compare_digest(content[:32], self._sign(key, content[32:])):
            self._refuse("its signature is wrong: somebody without the secret wrote it, or it is damaged")
            return None
        try:
            result = msgspec.msgpack.decode(content[32:], type=CheckResult)
        except ValueError as error:
            self._refuse(str(error))
            return None
        if result.failed or result.differs or not result.in_step:  # no urdfsync writes these
            self._refuse("its verdict is none that is remembered")
            return None
        return result

    def save(self, key: str, result: CheckResult) -> None:
        """Write a result without faults, if the user asked for it."""
        if self._writes:
            content = msgspec.msgpack.encode(result)
            self._reach(lambda system, folder: _write(system, folder, _name(key), self._sign(key, content) + content))

    def _sign(self, key: str, content: bytes) -> bytes:
        return hmac.digest(self._secret, _name(key).encode() + content, "sha256")  # all names have the same length

    def _refuse(self, reason: str) -> None:
        self._warnings.append(f"a result there was refused: {reason}")

    def _reach(self, work: Callable[[Any, str], T]) -> T | None:
        """Do a piece of work on the file system of the address; None if it fails or takes too long."""
        if not self._address or self._address in _problems:
            return None
        values, errors = list[T](), list[Exception]()

        def reach() -> None:
            try:
                from fsspec.core import url_to_fs  # an extra

                values.append(work(*url_to_fs(self._address)))
            except Exception as error:  # noqa: BLE001 - each kind of storage has errors of its own
                errors.append(error)

        # a daemon: the process may end while the storage still does not answer
        thread = threading.Thread(target=reach, daemon=True)
        thread.start()
        thread.join(PATIENCE)
        if values:
            return values[0]
        if not errors:
            _problems[self._address] = f"no answer within {PATIENCE:g} s"
        elif isinstance(errors[0], RemoteError):
            self._refuse(str(errors[0]))
        elif isinstance(errors[0], ImportError) and errors[0].name in (None, "fsspec"):
            words = str(errors[0]) if errors[0].name is None else f"fsspec is missing; `{install_command('remote')}`"
            _problems[self._address] = words
        else:
            _problems[self._address] = f"{type(errors[0]).__name__}: {errors[0]}"
        return None


def _name(key: str) -> str:
    """Return the name of a result's file; machines of another kind have other names."""
    return hashlib.sha256(f"urdfsync check 1\0{platform.machine()}\0{key}".encode()).hexdigest()


def _read(system: Any, path: str) -> bytes:
    """Return the bytes of a file, none without a file. Raises RemoteError for a file that is too large."""
    try:
        with system.open(path, "rb") as file:
            content: bytes = file.read(_LARGEST + 1)
    except FileNotFoundError:
        return b""
    if len(content) > _LARGEST:
        raise RemoteError(f"it has more than {_LARGEST >> 20} MB")
    return content


def _write(system: Any, folder: str, name: str, content: bytes) -> None:
    system.makedirs(folder, exist_ok=True)
    # fsspec's transaction: a folder never shows half of a file; a reader would refuse it, but warn
    with system.transaction, system.open(f"{folder}/{name}", "wb") as file:
        file.write(content)
